// SPDX-License-Identifier: MIT
//
// The floors that wait for a region, sorted by level, a few levels at a time: a counting sort, as the host's tasks.
//
// Each block of the field has a place of its own in each level, the room of all floors that it held there at first, so
// blocks sort at once, and the order is the same for any number of them. What has a region by then leaves gaps, which
// are closed at the end.

#include "nav_bake/regions/watershed.h"

#include "base/assert.h"
#include "base/host.h"

#include <string.h>

enum {
    MIN_FIELD_BLOCK = 8192, // floors
    MAX_FIELD_BLOCKS = 16,  // as each counts all levels
    COUNTS_A_LINE = 64 / sizeof(uint32_t)
};

tl_result tl_watershed_reserve(const tl_watershed *w, tl_floor_list *list, uint64_t count)
{
    if (count <= list->capacity) {
        return TL_OK;
    }
    const uint64_t most = w->compact->span_count, more = (uint64_t)list->capacity + list->capacity / 2;
    uint64_t capacity = count > more ? count : more;
    capacity = capacity < most ? capacity : most;
    uint32_t *grown = tl_allocate_array(w->allocator, capacity, sizeof *grown);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    if (list->count > 0) {
        memcpy(grown, list->floors, list->count * sizeof *grown);
    }
    tl_release_array(w->allocator, list->floors, list->capacity, sizeof *list->floors);
    list->floors = grown;
    list->capacity = (uint32_t)capacity;
    return TL_OK;
}

static uint32_t level_of(const tl_watershed *w, uint32_t floor)
{
    uint32_t level = w->compact->distance[floor] / 2u;
    return level < w->level_count ? w->level_count - 1 - level : 0;
}

// Whether a floor waits for a region; those of the tile's border never do.
static inline bool waits(const tl_watershed *w, uint32_t floor)
{
    return w->region[floor] == 0 && w->compact->area[floor] != TL_NAV_NULL_AREA;
}

// Counts the floors of a block that wait, by level.
static void count_waiting(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_watershed *w = user;
    const uint32_t end = tl_block_end(index, w->field_block, w->compact->span_count);
    uint32_t *sizes = w->block_sizes + (size_t)index * w->level_stride;
    memset(sizes, 0, w->level_stride * sizeof *sizes);
    for (uint32_t i = index * w->field_block; i < end; i++) {
        if (waits(w, i)) {
            sizes[level_of(w, i)]++;
        }
    }
}

tl_result tl_watershed_measure(tl_watershed *w, tl_arena *arena)
{
    const uint32_t half = (w->compact->max_distance + 1u) / 2, count = w->compact->span_count;
    const uint32_t most = w->worker_count < MAX_FIELD_BLOCKS ? w->worker_count : MAX_FIELD_BLOCKS;
    w->level_count = half > 0 ? half : 1;
    w->level_stride = (w->level_count + COUNTS_A_LINE - 1) / COUNTS_A_LINE * COUNTS_A_LINE;
    w->field_block = count / most + 1 > MIN_FIELD_BLOCK ? count / most + 1 : MIN_FIELD_BLOCK;
    w->field_block_count = tl_block_count(count, w->field_block);
    const uint64_t counts = (uint64_t)w->field_block_count * w->level_stride;
    w->block_sizes = TL_PUSH(arena, uint32_t, counts);
    w->block_next = TL_PUSH(arena, uint32_t, counts);
    w->level_size = TL_PUSH_ZERO(arena, uint32_t, w->level_count);
    w->level_end = TL_PUSH(arena, uint32_t, w->level_count);
    if (w->block_sizes == NULL || w->block_next == NULL || w->level_size == NULL || w->level_end == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_run_tasks(w->host, count_waiting, w->field_block_count, w);
    for (uint32_t b = 0; b < w->field_block_count; b++) {
        for (uint32_t k = 0; k < w->level_count; k++) {
            w->level_size[k] += w->block_sizes[(size_t)b * w->level_stride + k];
        }
    }
    return TL_OK;
}

static void sort_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_watershed *w = user;
    const uint32_t end = tl_block_end(index, w->field_block, w->compact->span_count);
    const uint32_t first_level = w->sort_first, levels = w->sort_end - w->sort_first;
    uint32_t *order = w->order.floors, *next = w->block_next + (size_t)index * w->level_stride;
    for (uint32_t i = index * w->field_block; i < end; i++) {
        if (!waits(w, i)) {
            continue;
        }
        const uint32_t level = level_of(w, i);
        if (level - first_level < levels) {
            order[next[level]++] = i;
        }
    }
}

// Moves what all blocks have left of the levels together, and sets where each level ends.
static void close_gaps(tl_watershed *w, uint32_t begin)
{
    uint32_t *order = w->order.floors, position = begin, room = begin;
    for (uint32_t k = w->sort_first; k < w->sort_end; k++) {
        for (uint32_t b = 0; b < w->field_block_count; b++) {
            const size_t at = (size_t)b * w->level_stride + k;
            const uint32_t size = w->block_next[at] - room;
            memmove(order + position, order + room, size * sizeof *order);
            room += w->block_sizes[at];
            position += size;
        }
        w->level_end[k] = position;
    }
    w->order.count = position;
}

tl_result tl_watershed_sort(tl_watershed *w, uint32_t first, uint32_t end)
{
    const uint32_t begin = w->order.count;
    uint32_t position = begin;
    for (uint32_t k = first; k < end; k++) {
        for (uint32_t b = 0; b < w->field_block_count; b++) {
            const size_t at = (size_t)b * w->level_stride + k;
            w->block_next[at] = position;
            position += w->block_sizes[at];
        }
        w->level_end[k] = position;
    }
    if (position == begin) {
        return TL_OK; // there may be no order yet to move within
    }
    TL_TRY(tl_watershed_reserve(w, &w->order, position));
    w->sort_first = first;
    w->sort_end = end;
    tl_run_tasks(w->host, sort_block, w->field_block_count, w);
    close_gaps(w, begin);
    return TL_OK;
}
