// SPDX-License-Identifier: MIT
//
// The floors that obstacles have marked, in runs.
//
// A tile's bytes follow from its floors and from what is marked of them. So where an obstacle moves under a roof or
// inside a wall, or only its box reaches a tile, nothing has to be baked: a fifth of the tiles of 64 cells that edits
// of a city reach, a third of 32. Rejected: a hash of the marks, which may say "the same" of others.

#include "nav_obstacles/tile_marks.h"

#include "base/arena.h"
#include "base/host.h"
#include "base/min_max.h"

#include <string.h>

enum {
    MARKS_BLOCK = 64, // floors that are compared at once
    FIRST_RUNS = 64
};

// The next run from floor `at` on; its count is 0 where there is none.
static tl_marked_run next_marked_run(const uint8_t *base_area, const uint8_t *area, uint32_t count, uint32_t at)
{
    while (count - at >= MARKS_BLOCK && memcmp(base_area + at, area + at, MARKS_BLOCK) == 0) {
        at += MARKS_BLOCK;
    }
    while (at < count && base_area[at] == area[at]) {
        at++;
    }
    tl_marked_run run = { at, 0, at < count ? area[at] : 0u };
    while (at < count && area[at] == run.area && base_area[at] != area[at]) {
        at++;
    }
    run.count = at - run.first;
    return run;
}

bool tl_tile_marks_hold(const tl_tile_marks *marks, const uint8_t *base_area, const uint8_t *area, uint32_t count)
{
    uint32_t at = 0;
    for (uint32_t r = 0; r < marks->run_count; r++) {
        const tl_marked_run run = next_marked_run(base_area, area, count, at), *held = &marks->runs[r];
        if (run.first != held->first || run.count != held->count || run.area != held->area) {
            return false;
        }
        at = run.first + run.count;
    }
    return memcmp(base_area + at, area + at, count - at) == 0;
}

// The first run that ends behind a floor.
static uint32_t first_run_behind(const tl_tile_marks *marks, uint32_t floor)
{
    uint32_t low = 0, high = marks->run_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (marks->runs[middle].first + marks->runs[middle].count <= floor) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

void tl_tile_marks_apply(const tl_tile_marks *marks, const uint8_t *base_area, uint32_t first, uint32_t count,
                         uint8_t *area_out)
{
    const uint32_t end = first + count;
    memcpy(area_out, base_area, count);
    for (uint32_t r = first_run_behind(marks, first); r < marks->run_count && marks->runs[r].first < end; r++) {
        const tl_marked_run *run = &marks->runs[r];
        const uint32_t from = tl_max_u32(run->first, first), to = tl_min_u32(run->first + run->count, end);
        memset(area_out + (from - first), (int)run->area, to - from);
    }
}

tl_result tl_tile_marks_find(const uint8_t *base_area, const uint8_t *area, uint32_t count,
                             const tl_allocator *allocator, tl_tile_marks *marks_out)
{
    tl_marked_run first_runs[FIRST_RUNS]; // mostly all; else they are looked for once more
    tl_tile_marks marks = { NULL, 0 };
    *marks_out = marks;
    for (uint32_t at = 0; at < count;) {
        const tl_marked_run run = next_marked_run(base_area, area, count, at);
        if (run.count > 0 && marks.run_count < FIRST_RUNS) {
            first_runs[marks.run_count] = run;
        }
        marks.run_count += run.count > 0;
        at = run.first + run.count;
    }
    if (marks.run_count == 0) {
        return TL_OK;
    }
    marks.runs = tl_allocate_array(allocator, marks.run_count, sizeof *marks.runs);
    if (marks.runs == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t known = marks.run_count < FIRST_RUNS ? marks.run_count : FIRST_RUNS;
    memcpy(marks.runs, first_runs, known * sizeof *marks.runs);
    for (uint32_t at = marks.runs[known - 1].first + marks.runs[known - 1].count; known < marks.run_count; known++) {
        marks.runs[known] = next_marked_run(base_area, area, count, at);
        at = marks.runs[known].first + marks.runs[known].count;
    }
    *marks_out = marks;
    return TL_OK;
}

void tl_tile_marks_free(tl_tile_marks *marks, const tl_allocator *allocator)
{
    tl_release_array(allocator, marks->runs, marks->run_count, sizeof *marks->runs);
    memset(marks, 0, sizeof *marks);
}
