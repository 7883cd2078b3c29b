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
// Why it is fast here: floors are sorted by level, a few levels at a time, and wait in that one array. Growth keeps a
// frontier (the floors that joined in the last step), where Recast looks at each waiting floor in each step and gathers
// the field anew every eight levels. Steps are simultaneous in both, so the regions are the same, but for two things:
// leftovers of a level always seed before newer floors, and a field without any inner floor (corridors of one or two
// columns) is divided too, where Recast drops it.

#include "nav_bake/regions/watershed.h"

#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum {
    FIELDS_SHARE = 4,      // at least a quarter of the field's floors is sorted at a time,
    SORTED_AT_ONCE = 16384 // and at least so many
};

// Whether a floor is of another region than `own`.
static inline bool is_of_other(const tl_watershed *w, uint32_t floor, uint8_t area, uint32_t own)
{
    const uint32_t region = w->region[floor];
    return tl_region_is_interior(region) && region != own && w->compact->area[floor] == area;
}

// Whether another region than `own` lies beside the floor, or round a corner from it.
static bool touches_other_region(const tl_watershed *w, uint32_t floor, uint32_t own)
{
    const tl_nav_compact *compact = w->compact;
    const uint8_t area = compact->area[floor];
    const tl_links links = tl_nav_links_or_self(compact, floor); // it is of its own region itself
    for (uint32_t d = 0; d < 4; d++) {
        const uint32_t beside = links.to[d];
        if (is_of_other(w, beside, area, own)) {
            return true;
        }
        if (compact->area[beside] != area || tl_region_is_border(w->region[beside])) {
            continue;
        }
        const uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, (d + 1) & 3);
        if (diagonal != TL_NAV_NO_SPAN && is_of_other(w, diagonal, area, own)) {
            return true;
        }
    }
    return false;
}

// Floods from a seed over floors at or above `level`. Takes nothing when the seed itself touches another region.
static tl_result flood(tl_watershed *w, uint32_t seed, uint32_t level, uint32_t *taken_out)
{
    const tl_nav_compact *compact = w->compact;
    uint32_t own = w->next_region, taken = 0;
    // A floor on the stack has the region, and so is pushed once: the stack holds at most span_count.
    tl_floor_list *stack = &w->frontier;
    stack->count = 0;
    TL_TRY(tl_watershed_reserve(w, stack, 1));
    stack->floors[stack->count++] = seed;
    w->region[seed] = own;
    while (stack->count > 0) {
        uint32_t floor = stack->floors[--stack->count];
        if (touches_other_region(w, floor, own)) {
            w->region[floor] = 0;
            continue;
        }
        taken++;
        w->reach[floor] = 0;
        if (stack->capacity - stack->count < 4 && stack->capacity < compact->span_count) {
            TL_TRY(tl_watershed_reserve(w, stack, (uint64_t)stack->capacity + 4));
        }
        const tl_links links = tl_nav_links_or_self(compact, floor); // it has a region itself
        for (int d = 0; d < 4; d++) {
            uint32_t beside = links.to[d];
            if (w->region[beside] == 0 && compact->distance[beside] >= level &&
                compact->area[beside] == compact->area[floor]) {
                w->region[beside] = own;
                stack->floors[stack->count++] = beside;
            }
        }
    }
    *taken_out = taken;
    return TL_OK;
}

// Moves the floors that still wait to the end of order[begin, end), in order. Returns where they begin.
static uint32_t keep_leftovers(tl_watershed *w, uint32_t begin, uint32_t end)
{
    uint32_t kept = end;
    for (uint32_t k = end; k-- > begin;) {
        if (w->region[w->order.floors[k]] == 0) {
            w->order.floors[--kept] = w->order.floors[k];
        }
    }
    return kept;
}

// One past the last of the levels from `first` on that are sorted at a time: few passes over the field, and an order
// that is small beside it.
static uint32_t last_level(const tl_watershed *w, uint32_t first)
{
    const uint32_t share = w->compact->span_count / FIELDS_SHARE,
                   most = share > SORTED_AT_ONCE ? share : SORTED_AT_ONCE;
    uint32_t end = first + 1;
    for (uint64_t sum = w->level_size[first]; end < w->level_count && sum + w->level_size[end] <= most; end++) {
        sum += w->level_size[end];
    }
    return end;
}

static tl_result run_level(tl_watershed *w, uint32_t *begin, uint32_t k)
{
    const uint32_t level = 2 * (w->level_count - 1 - k), flood_level = level >= 2 ? level - 2 : 0;
    const uint32_t end = w->level_end[k];
    TL_TRY(tl_watershed_grow(w, begin, end, level));
    for (uint32_t j = *begin; j < end; j++) {
        uint32_t taken = 0;
        if (w->region[w->order.floors[j]] == 0) {
            TL_TRY(flood(w, w->order.floors[j], flood_level, &taken));
        }
        w->next_region += taken > 0;
    }
    *begin = keep_leftovers(w, *begin, end);
    return TL_OK;
}

static tl_result run_levels(tl_watershed *w)
{
    for (uint32_t k = 0; k < w->level_count;) {
        const uint32_t end = last_level(w, k);
        uint32_t begin = 0;
        TL_TRY(tl_watershed_sort(w, k, end));
        for (; k < end; k++) {
            TL_TRY(run_level(w, &begin, k));
        }
        if (begin > 0) {
            w->order.count -= begin;
            memmove(w->order.floors, w->order.floors + begin, w->order.count * sizeof *w->order.floors);
        }
    }
    uint32_t begin = 0;
    return tl_watershed_grow(w, &begin, w->order.count, 0);
}

static void free_list(const tl_watershed *w, tl_floor_list *list)
{
    tl_release_array(w->allocator, list->floors, list->capacity, sizeof *list->floors);
}

tl_result tl_regions_watershed(tl_region_work *work)
{
    tl_watershed w = { 0 };
    w.compact = work->compact;
    w.allocator = &work->arena->allocator;
    w.region = work->region;
    w.next_region = 1;
    w.reach = work->scrap != NULL ? work->scrap : TL_PUSH(work->arena, uint16_t, work->compact->span_count);
    if (w.reach == NULL) {
        return TL_ERR_MEMORY;
    }
    w.host = work->host;
    w.worker_count = tl_worker_count(work->host);
    w.blocks = TL_PUSH(work->arena, tl_look_block, TL_WATERSHED_BLOCKS_PER_WORKER * (uint64_t)w.worker_count);
    if (w.blocks == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_watershed_measure(&w, work->arena));
    tl_result result = run_levels(&w);
    tl_release_array(w.allocator, w.found, w.found_capacity, sizeof *w.found);
    free_list(&w, &w.order);
    free_list(&w, &w.joining);
    free_list(&w, &w.frontier);
    work->region_count = w.next_region;
    return result;
}
