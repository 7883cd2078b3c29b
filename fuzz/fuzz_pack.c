// SPDX-License-Identifier: MIT
//
// Untrusted bytes as a container: what opens is whole, and every chunk of it can be read.
//
// The hashes would reject all mutations. So an input whose first byte is odd is repaired first: the hashes of chunks,
// table and header are recomputed, which lets the fuzzer reach the code behind them.

#include "base/hash.h"
#include "fuzz/fuzz_input.h"
#include "pack/pack_format.h"

#include <string.h>

static void repair(uint8_t *bytes, size_t size)
{
    tl_pack_header *header = (tl_pack_header *)(void *)bytes;
    if (size < sizeof *header) {
        return;
    }
    memcpy(header->magic, TL_PACK_MAGIC, sizeof header->magic);
    header->version = TL_PACK_VERSION;
    header->chunk_count %= 16;
    header->size = size;
    uint64_t table_size = (uint64_t)header->chunk_count * sizeof(tl_pack_entry);
    if (table_size <= size - sizeof *header) {
        tl_pack_entry *table = (tl_pack_entry *)(void *)(header + 1);
        for (uint32_t i = 0; i < header->chunk_count; i++) {
            if (table[i].offset <= size && table[i].size <= size - table[i].offset) {
                table[i].hash = tl_hash_bytes(bytes + table[i].offset, (size_t)table[i].size, 0);
            }
        }
        header->table_hash = tl_hash_bytes(table, (size_t)table_size, 0);
    }
    header->header_hash = tl_hash_bytes(header, offsetof(tl_pack_header, header_hash), 0);
}

static void read_all(const tl_pack *pack)
{
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        tl_pack_chunk chunk = tl_pack_chunk_at(pack, i), found;
        const uint8_t *begin = chunk.bytes;
        const uint8_t *all = pack->bytes;
        require(begin >= all && chunk.size <= pack->size - (uint64_t)(begin - all));
        require((uintptr_t)begin % TL_PACK_ALIGNMENT == 0);
        (void)tl_hash_bytes(chunk.bytes, (size_t)chunk.size, 0);
        require(tl_pack_find(pack, chunk.type, chunk.id, &found) == TL_OK && found.type == chunk.type);
        require(tl_pack_count(pack, chunk.type) >= 1);
        if (tl_pack_meta_check(chunk.bytes, chunk.size, NULL) == TL_OK) {
            require(strlen(tl_pack_meta_name(chunk.bytes)) == ((const tl_pack_meta *)chunk.bytes)->name_size);
        }
        if (tl_pack_frame_check(chunk.bytes, chunk.size, NULL) == TL_OK) {
            double back[3];
            tl_pack_place_out(chunk.bytes, tl_pack_place_in(chunk.bytes, (const double[]){ 1, 2, 3 }), back);
        }
        (void)tl_pack_navmesh_check(chunk.bytes, chunk.size, NULL);
        if (tl_pack_volumes_check(chunk.bytes, chunk.size, NULL) == TL_OK) {
            const tl_pack_volumes *marks = chunk.bytes;
            for (uint32_t k = 0; k < marks->count; k++) {
                const tl_nav_volume volume = tl_pack_volumes_at(marks, k);
                for (uint32_t p = 0; p < volume.point_count; p++) {
                    require(volume.points[p].y == 0.0f);
                }
            }
        }
    }
    tl_navmesh *navmesh = NULL;
    if (tl_pack_load_navmesh(pack, NULL, &navmesh, NULL) == TL_OK) {
        tl_navmesh_destroy(navmesh);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0) {
        return 0;
    }
    size_t byte_count = size - 1;
    uint8_t *bytes = aligned_alloc(64, (byte_count + 63) / 64 * 64 + 64);
    require(bytes != NULL);
    memcpy(bytes, data + 1, byte_count);
    if ((data[0] & 1) != 0) {
        repair(bytes, byte_count);
    }
    tl_pack pack;
    if (tl_pack_open(bytes, byte_count, &pack, NULL) == TL_OK) {
        read_all(&pack);
    }
    free(bytes);
    return 0;
}
