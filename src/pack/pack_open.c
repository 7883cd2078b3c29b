// SPDX-License-Identifier: MIT
//
// Opening a container: whole or not at all.
//
// The order of the checks gives each fault its own name. The header's hash comes before its size is believed, so that
// an altered size is not mistaken for a truncated file; the table's hash comes before any offset is followed.

#include "base/assert.h"
#include "base/byte_order.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/range_fits.h"
#include "pack/pack_format.h"

#include <string.h>

static const tl_pack_header *pack_header(const tl_pack *pack)
{
    return pack->bytes;
}

static const tl_pack_entry *entries_of(const tl_pack *pack)
{
    return (const tl_pack_entry *)(pack_header(pack) + 1);
}

tl_result tl_pack_check_header(const void *bytes, uint64_t size, tl_report *report)
{
    const char *not_ours = "it is not a talus file";
    size_t shown = size < sizeof TL_PACK_MAGIC - 1 ? (size_t)size : sizeof TL_PACK_MAGIC - 1;
    if (memcmp(bytes, TL_PACK_MAGIC, shown) != 0) {
        return tl_report_fail(report, TL_ERR_MAGIC, "header", TL_NO_ELEMENT, not_ours);
    }
    if (size < sizeof(tl_pack_header)) {
        return tl_report_fail(report, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT, "copy or bake the file again");
    }
    const tl_pack_header *header = bytes;
    tl_pack_header turned = *header;
    tl_pack_swap_header(&turned);
    if (header->version != TL_PACK_VERSION && turned.version == TL_PACK_VERSION) {
        return tl_report_fail(report, TL_ERR_VERSION, "header", TL_NO_ELEMENT,
                              TL_BIG_ENDIAN ? "give a copy of the bytes to tl_pack_to_host_order first"
                                            : "it is no file but the memory of a machine of the other byte order; "
                                              "write it there with tl_pack_write");
    }
    if (header->version != TL_PACK_VERSION) {
        return tl_report_fail(report, TL_ERR_VERSION, "header", TL_NO_ELEMENT,
                              "bake the level again with this version");
    }
    if (header->header_hash != tl_hash_bytes(header, offsetof(tl_pack_header, header_hash), 0)) {
        return tl_report_fail(report, TL_ERR_HASH, "header", TL_NO_ELEMENT, "copy or bake the file again");
    }
    if (size < header->size) {
        return tl_report_fail(report, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT, "copy or bake the file again");
    }
    if (size > header->size) {
        return tl_report_fail(report, TL_ERR_CORRUPT, "header", TL_NO_ELEMENT, "there are bytes behind its end");
    }
    return TL_OK;
}

static bool are_zeros(const uint8_t *bytes, uint64_t begin, uint64_t end)
{
    for (uint64_t i = begin; i < end; i++) {
        if (bytes[i] != 0) {
            return false;
        }
    }
    return true;
}

static tl_result check_chunk_table(const tl_pack *pack, tl_report *report)
{
    const tl_pack_header *header = pack_header(pack);
    if (!tl_range_fits(sizeof *header, header->chunk_count, sizeof(tl_pack_entry), pack->size)) {
        return tl_report_fail(report, TL_ERR_CORRUPT, "table", TL_NO_ELEMENT, NULL);
    }
    const tl_pack_entry *table = entries_of(pack);
    uint64_t table_size = (uint64_t)header->chunk_count * sizeof *table;
    if (header->table_hash != tl_hash_bytes(table, (size_t)table_size, 0)) {
        return tl_report_fail(report, TL_ERR_HASH, "table", TL_NO_ELEMENT, "copy or bake the file again");
    }
    // Chunks stand one behind the other, without gaps but for the padding.
    uint64_t end = sizeof *header + table_size;
    for (uint32_t i = 0; i <= header->chunk_count; i++) {
        uint64_t next = i < header->chunk_count ? table[i].offset : pack->size;
        if (next != tl_pack_align(end) || next > pack->size || !are_zeros(pack->bytes, end, next)) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "table", i, "padding or an offset is wrong");
        }
        if (i < header->chunk_count) {
            if (table[i].type == 0 || table[i].size > pack->size - next) {
                return tl_report_fail(report, TL_ERR_CORRUPT, "table", i, "a chunk has no type or no room");
            }
            end = next + table[i].size;
        }
    }
    return TL_OK;
}

static tl_result check_chunks(const tl_pack *pack, tl_report *report)
{
    const tl_pack_entry *table = entries_of(pack);
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        const uint8_t *bytes = (const uint8_t *)pack->bytes + table[i].offset;
        if (table[i].hash != tl_hash_bytes(bytes, (size_t)table[i].size, 0)) {
            return tl_report_fail(report, TL_ERR_HASH, "chunk", i, "copy or bake the file again");
        }
    }
    return TL_OK;
}

tl_result tl_pack_open(const void *bytes, uint64_t size, tl_pack *pack_out, tl_report *report_out)
{
    tl_report_begin(report_out, "open pack");
    if (pack_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "pack_out", "it may not be NULL");
    }
    memset(pack_out, 0, sizeof *pack_out);
    if (bytes == NULL || (uintptr_t)bytes % TL_PACK_ALIGNMENT != 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "bytes", "give bytes aligned to 64");
    }
    if (size == 0) {
        return tl_report_fail(report_out, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT, "the file is empty");
    }
    TL_TRY(tl_pack_check_header(bytes, size, report_out));
    tl_pack pack = { bytes, size, ((const tl_pack_header *)bytes)->chunk_count };
    TL_TRY(check_chunk_table(&pack, report_out));
    TL_TRY(check_chunks(&pack, report_out));
    *pack_out = pack;
    return TL_OK;
}

tl_pack_chunk tl_pack_chunk_at(const tl_pack *pack, uint32_t index)
{
    TL_ASSERT(index < pack->chunk_count);
    const tl_pack_entry *entry = &entries_of(pack)[index];
    tl_pack_chunk chunk = { entry->type, entry->id, (const uint8_t *)pack->bytes + entry->offset, entry->size };
    return chunk;
}

tl_result tl_pack_find(const tl_pack *pack, uint32_t type, uint32_t id, tl_pack_chunk *chunk_out)
{
    if (chunk_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(chunk_out, 0, sizeof *chunk_out);
    if (pack == NULL) {
        return TL_ERR_ARGUMENT;
    }
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        const tl_pack_entry *entry = &entries_of(pack)[i];
        if (entry->type == type && entry->id == id) {
            *chunk_out = tl_pack_chunk_at(pack, i);
            return TL_OK;
        }
    }
    return TL_NOT_FOUND;
}

uint32_t tl_pack_count(const tl_pack *pack, uint32_t type)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        count += entries_of(pack)[i].type == type ? 1 : 0;
    }
    return count;
}
