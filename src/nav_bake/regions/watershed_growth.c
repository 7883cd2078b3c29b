// SPDX-License-Identifier: MIT
//
// Growth of the watershed's regions over the floors that wait, in steps: all floors that lie beside a region join it at
// once, so the result does not depend on the order of looking. Where many wait, they are looked at in blocks, as the
// host's tasks: first all look, then all join.

#include "nav_bake/regions/watershed.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/host.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum {
    GROWTH_STEPS = 8,    // of growth at each level but the last; what is left is a new basin
    PREFETCHED = 100000, // floors: 15 bytes of each do not fit a second-level cache any more
    AHEAD = 8,           // floors that the fetching is ahead of the look
    SHARED_LOOK = 2048   // waiting floors that tasks share
};

// The region of a floor that joins it at the end of this step: not yet interior, and no longer none.
#define JOINING TL_NAV_BORDER_REGION
// Steps from a region's core are counted up to here. Beyond it the seam is drawn by direction alone.
#define FARTHEST 0xffffu

// The region that a waiting floor joins, beside it and of its area: the one whose core is nearest; ties go to the lower
// direction. 0: there is none.
static inline uint32_t nearest_region(const tl_watershed *w, uint32_t floor, uint32_t *reach_out)
{
    const tl_links links = tl_nav_links_or_self(w->compact, floor); // it has no region itself
    const uint8_t *area = w->compact->area;
    uint32_t nearest = UINT32_MAX, region = 0;
    for (int d = 0; d < 4; d++) {
        const uint32_t beside = links.to[d];
        if (tl_region_is_interior(w->region[beside]) && area[beside] == area[floor] && w->reach[beside] < nearest) {
            nearest = w->reach[beside];
            region = w->region[beside];
        }
    }
    *reach_out = nearest < FARTHEST ? nearest + 1 : FARTHEST;
    return region;
}

// Returns whether a waiting floor joins a region.
static inline bool look_for_region(tl_watershed *w, uint32_t floor)
{
    uint32_t reach;
    const uint32_t region = nearest_region(w, floor, &reach);
    if (region == 0) {
        return false;
    }
    w->reach[floor] = (uint16_t)reach;
    w->region[floor] = JOINING | region;
    w->joining.floors[w->joining.count++] = floor;
    return true;
}

// All that were found in this step join at once, so the result does not depend on the order of looking.
static void join_basins(tl_watershed *w)
{
    for (uint32_t k = 0; k < w->joining.count && !w->have_joined; k++) {
        w->region[w->joining.floors[k]] &= ~JOINING;
    }
    w->have_joined = false;
    const tl_floor_list joined = w->joining;
    w->joining = w->frontier;
    w->frontier = joined;
    w->joining.count = 0;
}

// Looks at the waiting floors beside those that joined in the last step.
static tl_result look_beside_frontier(tl_watershed *w, uint32_t level)
{
    const uint64_t most = w->compact->span_count, beside_all = 4 * (uint64_t)w->frontier.count;
    TL_TRY(tl_watershed_reserve(w, &w->joining, beside_all < most ? beside_all : most));
    for (uint32_t k = 0; k < w->frontier.count; k++) {
        uint32_t floor = w->frontier.floors[k];
        const tl_links links = tl_nav_links_or_self(w->compact, floor);
        uint8_t area = w->compact->area[floor];
        for (int d = 0; d < 4; d++) {
            uint32_t beside = links.to[d];
            if (w->region[beside] == 0 && w->compact->distance[beside] >= level && w->compact->area[beside] == area) {
                (void)look_for_region(w, beside);
            }
        }
    }
    return TL_OK;
}

// A contour line of a large field is spread over it, and what a floor's look reads is in no cache: the links of `later`
// are fetched, then what those of `sooner` lead to in the rows before and after.
static inline void prefetch_floor(const tl_watershed *w, uint32_t later, uint32_t sooner)
{
    const int16_t *step = w->compact->step;
    tl_prefetch(step + 4 * (size_t)later);
    const int32_t to_after = step[4 * (size_t)sooner + 1], to_before = step[4 * (size_t)sooner + 3];
    const uint32_t after = sooner + (uint32_t)to_after, before = sooner + (uint32_t)to_before;
    tl_prefetch(w->region + sooner);
    tl_prefetch(w->region + after);
    tl_prefetch(w->region + before);
    tl_prefetch(w->reach + after);
    tl_prefetch(w->reach + before);
}

// Looks at those of order[*begin, end) that still wait, from the end on; they stay, in order, and the others make room.
static tl_result look_here(tl_watershed *w, uint32_t *begin, uint32_t end)
{
    const uint32_t *order = w->order.floors;
    const bool is_far = w->compact->span_count > PREFETCHED && w->compact->step != NULL;
    uint32_t kept = end;
    for (uint32_t k = end; k-- > *begin;) {
        const uint32_t floor = order[k];
        if (is_far && k >= *begin + 2 * AHEAD) {
            prefetch_floor(w, order[k - 2 * AHEAD], order[k - AHEAD]);
        }
        if (w->joining.count == w->joining.capacity) {
            TL_TRY(tl_watershed_reserve(w, &w->joining, (uint64_t)w->joining.count + 1024));
        }
        if (w->region[floor] == 0 && !look_for_region(w, floor)) {
            w->order.floors[--kept] = floor;
        }
    }
    *begin = kept;
    return TL_OK;
}

// The same of one block, whose finds wait until all blocks have looked.
static void look_at_block_of_order(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_watershed *w = user;
    tl_look_block *block = &w->blocks[index];
    uint32_t *order = w->order.floors;
    tl_joining_floor *found = w->found + block->begin;
    const bool is_far = w->compact->span_count > PREFETCHED && w->compact->step != NULL;
    uint32_t kept = block->end, count = 0;
    for (uint32_t k = block->end; k-- > block->begin;) {
        const uint32_t floor = order[k];
        if (is_far && k >= block->begin + 2 * AHEAD) {
            prefetch_floor(w, order[k - 2 * AHEAD], order[k - AHEAD]);
        }
        if (w->region[floor] != 0) {
            continue;
        }
        uint32_t reach;
        const uint32_t region = nearest_region(w, floor, &reach);
        if (region != 0) {
            found[count++] = (tl_joining_floor){ floor, region, reach };
        } else {
            order[--kept] = floor;
        }
    }
    block->kept = kept;
    block->found = count;
}

static void join_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_watershed *w = user;
    const tl_look_block *block = &w->blocks[index];
    const tl_joining_floor *found = w->found + block->begin;
    uint32_t *joining = w->joining.floors + block->first;
    for (uint32_t k = 0; k < block->found; k++) {
        w->region[found[k].floor] = found[k].region;
        w->reach[found[k].floor] = (uint16_t)found[k].reach;
        joining[k] = found[k].floor;
    }
}

// The order has room for `end` floors: so have the finds now.
static tl_result reserve_found(tl_watershed *w, uint32_t end)
{
    if (w->found_capacity >= end) {
        return TL_OK;
    }
    tl_release_array(w->allocator, w->found, w->found_capacity, sizeof *w->found);
    w->found_capacity = 0;
    w->found = tl_allocate_array(w->allocator, w->order.capacity, sizeof *w->found);
    if (w->found == NULL) {
        return TL_ERR_MEMORY;
    }
    w->found_capacity = w->order.capacity;
    return TL_OK;
}

// As look_here, in blocks as the host's tasks: first all look, then all join.
static tl_result look_in_blocks(tl_watershed *w, uint32_t *begin, uint32_t end)
{
    const uint32_t size = (end - *begin - 1) / (TL_WATERSHED_BLOCKS_PER_WORKER * w->worker_count) + 1;
    const uint32_t count = tl_block_count(end - *begin, size);
    TL_TRY(reserve_found(w, end));
    for (uint32_t k = 0; k < count; k++) {
        w->blocks[k].begin = *begin + k * size;
        w->blocks[k].end = *begin + tl_block_end(k, size, end - *begin);
    }
    tl_run_tasks(w->host, look_at_block_of_order, count, w);
    uint32_t found = 0, kept = end;
    for (uint32_t k = 0; k < count; k++) {
        w->blocks[k].first = found;
        found += w->blocks[k].found;
    }
    for (uint32_t k = count; k-- > 0;) {
        const tl_look_block *block = &w->blocks[k];
        kept -= block->end - block->kept;
        memmove(w->order.floors + kept, w->order.floors + block->kept,
                (block->end - block->kept) * sizeof *w->order.floors);
    }
    TL_TRY(tl_watershed_reserve(w, &w->joining, found));
    w->joining.count = found;
    tl_run_tasks(w->host, join_block, count, w);
    w->have_joined = true;
    *begin = kept;
    return TL_OK;
}

static tl_result look_at_waiting(tl_watershed *w, uint32_t *begin, uint32_t end)
{
    return w->worker_count > 1 && end - *begin >= SHARED_LOOK ? look_in_blocks(w, begin, end)
                                                              : look_here(w, begin, end);
}

// The first step settles most floors, so few are left to be looked at; where they are many, only those beside the last
// step's are.
tl_result tl_watershed_grow(tl_watershed *w, uint32_t *begin, uint32_t end, uint32_t level)
{
    w->joining.count = w->frontier.count = 0;
    TL_TRY(look_at_waiting(w, begin, end));
    // Terminates: each step takes at least one floor from those that wait.
    for (uint32_t step = 1; w->joining.count > 0; step++) {
        join_basins(w);
        if (level != 0 && step >= GROWTH_STEPS) {
            continue;
        }
        if (end - *begin <= w->frontier.count) {
            TL_TRY(look_at_waiting(w, begin, end));
        } else {
            TL_TRY(look_beside_frontier(w, level));
        }
    }
    return TL_OK;
}
