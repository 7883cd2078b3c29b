// SPDX-License-Identifier: MIT
//
// Watershed partition: regions are the basins of the distance field, seen upside down.
//
// The water falls two half columns at a time. At each level the regions that exist grow over the floors that have just
// come above the water, breadth first; what they do not reach within a few steps is the top of a new basin, and is
// flooded as a region of its own, one level ahead. A flood stops a floor short of other regions, so that the next
// level's growth settles the seam between them evenly.
// Source: Vincent, Soille, "Watersheds in digital spaces", 1991; Mononen, Recast (levels, growth limit, seam rule).
//
// Why it is fast here: all floors are sorted by level once, and wait in that one array. Growth keeps a frontier (the
// floors that joined in the last step), where Recast looks at each waiting floor in each step and gathers the field
// anew every eight levels. Steps are simultaneous in both, so the regions are the same, but for two things: leftovers
// of a level always seed before newer floors, and a field without any inner floor (corridors of one or two columns) is
// divided too, where Recast drops it.

#include "nav_build/regions.h"

#include "base/assert.h"
#include "nav_build/links.h"

enum {
    GROWTH_STEPS = 8, // of growth at each level but the last; what is left is a new basin
};

// The region of a floor that joins it at the end of this step: not yet interior, and no longer none.
#define JOINING TL_NAV_BORDER_REGION
// Steps from a region's core are counted up to here. Beyond it the seam is drawn by direction alone.
#define FARTHEST 0xffffu

typedef struct watershed {
    const tl_nav_compact *compact;
    uint32_t *region;
    uint16_t *reach;    // [span_count] growth steps from the region's flooded core
    uint32_t *order;    // walkable floors by level, highest first, then by index
    uint32_t *level_at; // [level_count + 1] level k, from the highest, begins at order[level_at[k]]
    uint32_t level_count;
    uint32_t *joining;  // floors that join in this step
    uint32_t *frontier; // floors that joined in the last step; the stack while flooding
    uint32_t joining_count, frontier_count;
    uint32_t next_region;
} watershed;

static inline bool is_interior(uint32_t region)
{
    return region != 0 && !tl_region_is_border(region);
}

// A waiting floor beside a region of its area will join it: the one whose core is nearest; ties go to the lower
// direction.
static void look_for_region(watershed *w, uint32_t floor)
{
    const tl_links links = tl_nav_links(w->compact, floor);
    uint8_t area = w->compact->area[floor];
    uint32_t nearest = UINT32_MAX, region = 0;
    for (int d = 0; d < 4; d++) {
        uint32_t beside = links.to[d];
        if (beside != TL_NAV_NO_SPAN && is_interior(w->region[beside]) && w->compact->area[beside] == area &&
            w->reach[beside] < nearest) {
            nearest = w->reach[beside];
            region = w->region[beside];
        }
    }
    if (region != 0) {
        w->reach[floor] = (uint16_t)(nearest < FARTHEST ? nearest + 1 : FARTHEST);
        w->region[floor] = JOINING | region;
        w->joining[w->joining_count++] = floor;
    }
}

// All that were found in this step join at once, so the result does not depend on the order of looking.
static void join(watershed *w)
{
    for (uint32_t k = 0; k < w->joining_count; k++) {
        w->region[w->joining[k]] &= ~JOINING;
    }
    uint32_t *joined = w->joining;
    w->joining = w->frontier;
    w->frontier = joined;
    w->frontier_count = w->joining_count;
    w->joining_count = 0;
}

static void look_beside_frontier(watershed *w, uint32_t level)
{
    for (uint32_t k = 0; k < w->frontier_count; k++) {
        uint32_t floor = w->frontier[k];
        const tl_links links = tl_nav_links(w->compact, floor);
        uint8_t area = w->compact->area[floor];
        for (int d = 0; d < 4; d++) {
            uint32_t beside = links.to[d];
            if (beside != TL_NAV_NO_SPAN && w->region[beside] == 0 && w->compact->distance[beside] >= level &&
                w->compact->area[beside] == area) {
                look_for_region(w, beside);
            }
        }
    }
}

// Grows the regions over the waiting floors: order[begin, end), all at `level` or above it.
static void grow(watershed *w, uint32_t begin, uint32_t end, uint32_t level)
{
    for (uint32_t k = begin; k < end; k++) {
        if (w->region[w->order[k]] == 0) {
            look_for_region(w, w->order[k]);
        }
    }
    // Terminates: each step takes at least one floor from those that wait.
    for (uint32_t step = 1; w->joining_count > 0; step++) {
        join(w);
        if (level == 0 || step < GROWTH_STEPS) {
            look_beside_frontier(w, level);
        }
    }
}

// Whether another region than `own` lies beside the floor, or round a corner from it.
static bool touches_other_region(const watershed *w, uint32_t floor, uint32_t own)
{
    const tl_nav_compact *compact = w->compact;
    uint8_t area = compact->area[floor];
    for (uint32_t d = 0; d < 4; d++) {
        uint32_t beside = tl_nav_beside(compact, floor, d);
        if (beside == TL_NAV_NO_SPAN || compact->area[beside] != area || tl_region_is_border(w->region[beside])) {
            continue;
        }
        if (w->region[beside] != 0 && w->region[beside] != own) {
            return true;
        }
        uint32_t diagonal = tl_nav_beside(compact, beside, (d + 1) & 3);
        if (diagonal != TL_NAV_NO_SPAN && compact->area[diagonal] == area && w->region[diagonal] != 0 &&
            w->region[diagonal] != own && !tl_region_is_border(w->region[diagonal])) {
            return true;
        }
    }
    return false;
}

// Floods from a seed over floors at or above `level`. False: the seed itself touches another region, nothing is taken.
static bool flood(watershed *w, uint32_t seed, uint32_t level)
{
    const tl_nav_compact *compact = w->compact;
    uint32_t own = w->next_region, taken = 0;
    // A floor on the stack has the region, and so is pushed once: the stack holds at most span_count.
    uint32_t *stack = w->frontier, stack_count = 0;
    stack[stack_count++] = seed;
    w->region[seed] = own;
    w->reach[seed] = 0;
    while (stack_count > 0) {
        uint32_t floor = stack[--stack_count];
        if (touches_other_region(w, floor, own)) {
            w->region[floor] = 0;
            continue;
        }
        taken++;
        const tl_links links = tl_nav_links(compact, floor);
        for (int d = 0; d < 4; d++) {
            uint32_t beside = links.to[d];
            if (beside != TL_NAV_NO_SPAN && w->region[beside] == 0 && compact->distance[beside] >= level &&
                compact->area[beside] == compact->area[floor]) {
                w->region[beside] = own;
                w->reach[beside] = 0;
                stack[stack_count++] = beside;
            }
        }
    }
    return taken > 0;
}

static uint32_t level_of(const watershed *w, uint32_t floor)
{
    uint32_t level = w->compact->distance[floor] / 2u;
    return level < w->level_count ? w->level_count - 1 - level : 0;
}

// Counting sort of the walkable floors, without those of the tile's border.
static tl_result sort_by_level(watershed *w, tl_arena *arena)
{
    const tl_nav_compact *compact = w->compact;
    uint32_t half = (compact->max_distance + 1u) / 2;
    w->level_count = half > 0 ? half : 1;
    w->level_at = TL_PUSH_ZERO(arena, uint32_t, w->level_count + 2);
    if (w->level_at == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t *next = w->level_at + 1; // becomes the begin of each level, one place ahead of where it is counted
    for (uint32_t i = 0; i < compact->span_count; i++) {
        if (compact->area[i] != TL_NAV_NULL_AREA && w->region[i] == 0) {
            next[level_of(w, i) + 1]++;
        }
    }
    for (uint32_t k = 1; k <= w->level_count; k++) {
        next[k] += next[k - 1];
    }
    w->order = TL_PUSH(arena, uint32_t, next[w->level_count]);
    if (w->order == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < compact->span_count; i++) {
        if (compact->area[i] != TL_NAV_NULL_AREA && w->region[i] == 0) {
            w->order[next[level_of(w, i)]++] = i;
        }
    }
    return TL_OK;
}

// Moves the floors that still wait to the end of order[begin, end), in order. Returns where they begin.
static uint32_t keep_leftovers(watershed *w, uint32_t begin, uint32_t end)
{
    uint32_t kept = end;
    for (uint32_t k = end; k-- > begin;) {
        if (w->region[w->order[k]] == 0) {
            w->order[--kept] = w->order[k];
        }
    }
    return kept;
}

static void run_levels(watershed *w)
{
    uint32_t begin = 0;
    for (uint32_t k = 0; k < w->level_count; k++) {
        uint32_t level = 2 * (w->level_count - 1 - k);
        uint32_t flood_level = level >= 2 ? level - 2 : 0;
        uint32_t end = w->level_at[k + 1];
        grow(w, begin, end, level);
        for (uint32_t j = begin; j < end; j++) {
            if (w->region[w->order[j]] == 0 && flood(w, w->order[j], flood_level)) {
                w->next_region++;
            }
        }
        begin = keep_leftovers(w, begin, end);
    }
    grow(w, begin, w->level_at[w->level_count], 0);
}

tl_result tl_regions_watershed(tl_region_work *work)
{
    watershed w = { 0 };
    w.compact = work->compact;
    w.region = work->region;
    w.next_region = 1;
    TL_TRY(sort_by_level(&w, work->arena));
    uint32_t count = work->compact->span_count;
    w.reach = TL_PUSH_ZERO(work->arena, uint16_t, count);
    w.joining = TL_PUSH(work->arena, uint32_t, count);
    w.frontier = TL_PUSH(work->arena, uint32_t, count);
    if (w.reach == NULL || w.joining == NULL || w.frontier == NULL) {
        return TL_ERR_MEMORY;
    }
    run_levels(&w);
    work->region_count = w.next_region;
    return TL_OK;
}
