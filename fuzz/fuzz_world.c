// SPDX-License-Identifier: MIT
//
// Untrusted bytes as the files of a world's job: plan, segment, tile, manifest. What is read is whole: every count and
// place in it holds. The first byte says which file, and whether its checksums are made right first, so that what is
// behind them is reached.

#define _GNU_SOURCE // memfd_create

#include "world/bytes/content_hash.h"
#include "world/bytes/little_endian.h"
#include "world/input/input_list.h"
#include "world/job/plan_file.h"
#include "world/job/tile_file.h"
#include "world/store/segment_file.h"
#include "world/store/triangle_record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { MAX_FILE = 1 << 16, TAIL = 8 };

static unsigned char bytes[MAX_FILE];
static char path[64];

// The file that readers open: memory under a name.
static void put_file(size_t size)
{
    static int file = -1;
    if (file < 0) {
        file = memfd_create("world", 0);
        snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    }
    if (file < 0 || ftruncate(file, 0) != 0 || pwrite(file, bytes, size, 0) != (ssize_t)size) {
        abort();
    }
}

static void mend_plan(size_t size)
{
    if (size >= 32) {
        memcpy(bytes, "TLWPLAN\n", 8);
        tl_put_u64(bytes + 16, size);
        tl_put_u64(bytes + size - TAIL, tl_content_checksum(bytes, size - TAIL));
    }
}

static void mend_segment(size_t size)
{
    if (size < TL_WORLD_SEGMENT_HEADER + TAIL) {
        return;
    }
    memcpy(bytes, "TLWSEG\r\n", 8);
    // As many cells as fit behind the records that the header asks for.
    const size_t room = size - TL_WORLD_SEGMENT_HEADER - TAIL;
    const uint64_t triangles = tl_get_u64(bytes + 24) % (room / TL_WORLD_RECORD_BYTES + 1);
    const size_t rest = room - (size_t)triangles * TL_WORLD_RECORD_BYTES;
    const size_t cells = rest / TL_WORLD_SEGMENT_CELL;
    tl_put_u64(bytes + 24, triangles);
    tl_put_u64(bytes + 32, cells);
    tl_put_u64(bytes + 184, tl_content_checksum(bytes, 184));
    unsigned char *index = bytes + TL_WORLD_SEGMENT_HEADER + triangles * TL_WORLD_RECORD_BYTES;
    tl_put_u64(index + cells * TL_WORLD_SEGMENT_CELL, tl_content_checksum(index, cells * TL_WORLD_SEGMENT_CELL));
}

static void mend_tile(size_t size)
{
    if (size >= TL_WORLD_TILE_HEADER) {
        memcpy(bytes, "TLWTILE\n", 8);
        tl_put_u64(bytes + 40, size);
        tl_put_u64(bytes + 48, tl_content_checksum(bytes + TL_WORLD_TILE_HEADER, size - TL_WORLD_TILE_HEADER));
        tl_put_u64(bytes + 56, tl_content_checksum(bytes, 56));
    }
}

static void read_plan(size_t size)
{
    tl_world_plan plan;
    if (tl_world_plan_decode(bytes, size, "plan", &plan, NULL) == TL_OK) {
        uint64_t sum = strlen(plan.name);
        for (uint32_t i = 0; i < plan.input_count; i++) {
            sum += strlen(plan.inputs[i].path);
        }
        for (uint64_t i = 0; i < plan.tile_count; i++) {
            sum += plan.tiles[i].cost;
        }
        if (sum == UINT64_MAX) {
            abort();
        }
    }
    tl_world_plan_free(&plan);
}

static void read_segment(size_t size)
{
    static unsigned char records[MAX_FILE];
    put_file(size);
    tl_world_segment segment;
    if (tl_world_segment_open(path, true, &segment, NULL) != TL_OK) {
        return;
    }
    for (uint64_t i = 0; i < segment.head.cells; i++) {
        if (segment.cells[i].count > sizeof records / TL_WORLD_RECORD_BYTES) {
            abort(); // more than the file holds
        }
        (void)tl_world_segment_read(&segment, i, records, NULL);
    }
    tl_world_segment_close(&segment);
}

static void read_tile(size_t size)
{
    put_file(size);
    tl_world_tile tile;
    memset(&tile, 0, sizeof tile);
    if (size >= TL_WORLD_TILE_HEADER) { // the one that the file says it is
        tile.key.low = tl_get_u64(bytes + 16);
        tile.key.high = tl_get_u64(bytes + 24);
        tile.x = tl_get_u32(bytes + 32);
        tile.z = tl_get_u32(bytes + 36);
    }
    tl_world_layers layers;
    if (tl_world_tile_read(path, &tile, true, &layers, NULL) == TL_OK) {
        if (!tl_world_tile_is_there(path, &tile)) {
            abort();
        }
        (void)tl_world_layers_check(&layers, path, &tile, NULL);
    }
    tl_world_layers_free(&layers);
}

static void read_manifest(size_t size)
{
    put_file(size);
    const tl_world_reading reading = { TL_UP_Y, 1.0f };
    tl_world_inputs inputs;
    memset(&inputs, 0, sizeof inputs);
    if (tl_world_manifest_read(path, &reading, &inputs, NULL) == TL_OK) {
        for (uint32_t i = 0; i < inputs.count; i++) {
            if (inputs.items[i].path == NULL) {
                abort();
            }
        }
    }
    tl_world_inputs_free(&inputs);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1 || size > MAX_FILE) {
        return 0;
    }
    const uint8_t which = data[0] & 3;
    const bool is_mended = (data[0] & 4) != 0;
    size--;
    memcpy(bytes, data + 1, size);
    switch (which) {
    case 0:
        if (is_mended) {
            mend_plan(size);
        }
        read_plan(size);
        break;
    case 1:
        if (is_mended) {
            mend_segment(size);
        }
        read_segment(size);
        break;
    case 2:
        if (is_mended) {
            mend_tile(size);
        }
        read_tile(size);
        break;
    default:
        read_manifest(size);
    }
    return 0;
}
