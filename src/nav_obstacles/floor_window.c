// SPDX-License-Identifier: MIT
//
// The floors of some columns, from a tile's packed ones: what lies before them is passed over a run at a time, and its
// floors are counted but not unpacked. An obstacle's columns are a twentieth of a tile, and on levels of several
// storeys most edits mark no floor of the tiles that they reach: to see that takes no more than this.

#include "nav_obstacles/floor_window.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_obstacles/packed_runs.h"

#include <string.h>

static tl_result make_window_room(tl_window_block *block, uint64_t size, const tl_allocator *allocator)
{
    if (block->size >= size) {
        return TL_OK;
    }
    tl_release_array(allocator, block->bytes, block->size, 1);
    block->size = 0;
    block->bytes = tl_allocate_array(allocator, size, 1);
    if (block->bytes == NULL) {
        return TL_ERR_MEMORY;
    }
    block->size = size;
    return TL_OK;
}

// Finds where the columns' floors begin, in the window and in the tile. `counts`: [width] scratch.
static void find_columns(tl_floor_window *window, const tl_packed_floors *packed, tl_obstacle_window columns,
                         uint16_t *counts)
{
    tl_nav_compact *compact = &window->compact;
    tl_run_reader reader = tl_run_reader_make(packed->bytes, sizeof *counts);
    uint32_t *first_span = compact->first_span, count = 0;
    uint64_t column = 0, floor = 0;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint64_t begin = (uint64_t)(columns.first_z + z) * packed->frame.width + columns.first_x;
        floor += tl_run_reader_sum(&reader, begin - column);
        window->row_floor[z] = (uint32_t)floor;
        tl_run_reader_read(&reader, compact->width, counts);
        for (uint32_t x = 0; x < compact->width; x++) {
            *first_span++ = count;
            count += counts[x];
            floor += counts[x];
        }
        column = begin + compact->width;
    }
    *first_span = count;
    compact->span_count = count;
}

static void read_floors(tl_floor_window *window, const tl_packed_floors *packed, uint8_t *base_area)
{
    tl_nav_compact *compact = &window->compact;
    tl_run_reader floors = tl_run_reader_make(packed->bytes + packed->floors_at, sizeof *compact->floor);
    tl_run_reader areas = tl_run_reader_make(packed->bytes + packed->areas_at, 1);
    uint32_t at = 0;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width, count = row[compact->width] - row[0];
        if (count > 0) {
            tl_run_reader_skip(&floors, window->row_floor[z] - at);
            tl_run_reader_skip(&areas, window->row_floor[z] - at);
            tl_run_reader_read(&floors, count, compact->floor + row[0]);
            tl_run_reader_read(&areas, count, base_area + row[0]);
            at = window->row_floor[z] + count;
        }
    }
}

static tl_result read_window(tl_floor_window *window, const tl_packed_floors *packed, tl_obstacle_window columns,
                             const tl_allocator *allocator)
{
    tl_nav_compact *compact = &window->compact;
    compact->width = columns.end_x - columns.first_x;
    compact->height = columns.end_z - columns.first_z;
    compact->lattice.first_x += (int32_t)columns.first_x;
    compact->lattice.first_z += (int32_t)columns.first_z;
    const uint64_t count = (uint64_t)compact->width * compact->height + 1;
    const uint64_t words = count + compact->height;
    TL_TRY(make_window_room(&window->columns, words * sizeof(uint32_t) + compact->width * sizeof(uint16_t), allocator));
    compact->first_span = (uint32_t *)window->columns.bytes;
    window->row_floor = compact->first_span + count;
    find_columns(window, packed, columns, (uint16_t *)(window->row_floor + compact->height));

    const uint64_t floors = compact->span_count;
    TL_TRY(make_window_room(&window->floors, (floors + 1) * (sizeof *compact->floor + 3), allocator));
    compact->floor = (uint16_t *)window->floors.bytes;
    compact->area = (uint8_t *)(compact->floor + floors);
    uint8_t *base_area = compact->area + floors;
    window->marked = base_area + floors;
    window->base_area = base_area;
    read_floors(window, packed, base_area);
    memcpy(compact->area, base_area, (size_t)floors);
    return TL_OK;
}

tl_result tl_floor_window_read(tl_floor_window *window, const tl_packed_floors *packed, tl_obstacle_window columns,
                               const tl_allocator *allocator)
{
    window->compact = packed->frame;
    window->compact.width = window->compact.height = window->compact.span_count = 0;
    if (tl_obstacle_window_is_empty(&columns)) {
        return TL_OK;
    }
    const tl_result result = read_window(window, packed, columns, allocator);
    if (result != TL_OK) {
        window->compact.width = window->compact.height = window->compact.span_count = 0;
    }
    return result;
}

bool tl_floor_window_holds(const tl_floor_window *window, const tl_tile_marks *marks)
{
    const tl_nav_compact *compact = &window->compact;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width, first = row[0];
        const uint32_t count = row[compact->width] - first;
        tl_tile_marks_apply(marks, window->base_area + first, window->row_floor[z], count, window->marked);
        if (memcmp(window->marked, compact->area + first, count) != 0) {
            return false;
        }
    }
    return true;
}

void tl_floor_window_paste(const tl_floor_window *window, uint8_t *area)
{
    const tl_nav_compact *compact = &window->compact;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width;
        memcpy(area + window->row_floor[z], compact->area + row[0], row[compact->width] - row[0]);
    }
}

uint64_t tl_floor_window_bytes(const tl_floor_window *window)
{
    return window->columns.size + window->floors.size;
}

void tl_floor_window_free(tl_floor_window *window, const tl_allocator *allocator)
{
    tl_release_array(allocator, window->columns.bytes, window->columns.size, 1);
    tl_release_array(allocator, window->floors.bytes, window->floors.size, 1);
    memset(window, 0, sizeof *window);
}
