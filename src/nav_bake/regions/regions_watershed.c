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

#include "nav_bake/regions/regions.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum {
    GROWTH_STEPS = 8,       // of growth at each level but the last; what is left is a new basin
    FIELDS_SHARE = 4,       // at least a quarter of the field's floors is sorted at a time,
    SORTED_AT_ONCE = 16384, // and at least so many
    PREFETCHED = 100000,    // floors: 15 bytes of each do not fit a second-level cache any more
    AHEAD = 8               // floors that the fetching is ahead of the look
};

// The region of a floor that joins it at the end of this step: not yet interior, and no longer none.
#define JOINING TL_NAV_BORDER_REGION
// Steps from a region's core are counted up to here. Beyond it the seam is drawn by direction alone.
#define FARTHEST 0xffffu

// Floors that wait for something. Grows as needed: mostly it holds one contour line of the field.
typedef struct floor_list {
    uint32_t *floors;
    uint32_t count, capacity;
} floor_list;

typedef struct watershed {
    const tl_nav_compact *compact;
    const tl_allocator *allocator;
    uint32_t *region;
    // [span_count] growth steps from the region's flooded core. Of floors with a region only, and the distances of
    // those are no longer asked for: where it may be, it is the same array.
    uint16_t *reach;
    floor_list order;     // walkable floors of some levels, highest first, then by index; before them, what is left
    uint32_t *level_size; // [level_count] floors of level k, counted from the highest
    uint32_t *level_end;  // [level_count] where it ends in the order
    uint32_t level_count;
    floor_list joining;  // floors that join in this step
    floor_list frontier; // floors that joined in the last step; the stack while flooding
    uint32_t next_region;
} watershed;

// Room for `count` floors in all.
static tl_result reserve_spans(const watershed *w, floor_list *list, uint64_t count)
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

static inline bool is_interior(uint32_t region)
{
    return region != 0 && !tl_region_is_border(region);
}

// A waiting floor beside a region of its area will join it: the one whose core is nearest; ties go to the lower
// direction. Returns whether it does.
static inline bool look_for_region(watershed *w, uint32_t floor)
{
    const tl_links links = tl_nav_links_or_self(w->compact, floor); // it has no region itself
    const uint8_t *area = w->compact->area;
    uint32_t nearest = UINT32_MAX, region = 0;
    for (int d = 0; d < 4; d++) {
        const uint32_t beside = links.to[d];
        if (is_interior(w->region[beside]) && area[beside] == area[floor] && w->reach[beside] < nearest) {
            nearest = w->reach[beside];
            region = w->region[beside];
        }
    }
    if (region == 0) {
        return false;
    }
    w->reach[floor] = (uint16_t)(nearest < FARTHEST ? nearest + 1 : FARTHEST);
    w->region[floor] = JOINING | region;
    w->joining.floors[w->joining.count++] = floor;
    return true;
}

// All that were found in this step join at once, so the result does not depend on the order of looking.
static void join_basins(watershed *w)
{
    for (uint32_t k = 0; k < w->joining.count; k++) {
        w->region[w->joining.floors[k]] &= ~JOINING;
    }
    const floor_list joined = w->joining;
    w->joining = w->frontier;
    w->frontier = joined;
    w->joining.count = 0;
}

// Looks at the waiting floors beside those that joined in the last step.
static tl_result look_beside_frontier(watershed *w, uint32_t level)
{
    const uint64_t most = w->compact->span_count, beside_all = 4 * (uint64_t)w->frontier.count;
    TL_TRY(reserve_spans(w, &w->joining, beside_all < most ? beside_all : most));
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
static inline void prefetch_floor(const watershed *w, uint32_t later, uint32_t sooner)
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
static tl_result look_at_waiting(watershed *w, uint32_t *begin, uint32_t end)
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
            TL_TRY(reserve_spans(w, &w->joining, (uint64_t)w->joining.count + 1024));
        }
        if (w->region[floor] == 0 && !look_for_region(w, floor)) {
            w->order.floors[--kept] = floor;
        }
    }
    *begin = kept;
    return TL_OK;
}

// Grows the regions over the waiting floors: order[*begin, end), all at `level` or above it. Those that still wait in
// the end are among order[*begin, end) then, in order. The first step settles most, so few are left to be looked at;
// where they are many, only those beside the last step's are.
static tl_result grow_basins(watershed *w, uint32_t *begin, uint32_t end, uint32_t level)
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

// Whether a floor is of another region than `own`.
static inline bool is_of_other(const watershed *w, uint32_t floor, uint8_t area, uint32_t own)
{
    const uint32_t region = w->region[floor];
    return is_interior(region) && region != own && w->compact->area[floor] == area;
}

// Whether another region than `own` lies beside the floor, or round a corner from it.
static bool touches_other_region(const watershed *w, uint32_t floor, uint32_t own)
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
static tl_result flood(watershed *w, uint32_t seed, uint32_t level, uint32_t *taken_out)
{
    const tl_nav_compact *compact = w->compact;
    uint32_t own = w->next_region, taken = 0;
    // A floor on the stack has the region, and so is pushed once: the stack holds at most span_count.
    floor_list *stack = &w->frontier;
    stack->count = 0;
    TL_TRY(reserve_spans(w, stack, 1));
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
            TL_TRY(reserve_spans(w, stack, (uint64_t)stack->capacity + 4));
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

static uint32_t level_of(const watershed *w, uint32_t floor)
{
    uint32_t level = w->compact->distance[floor] / 2u;
    return level < w->level_count ? w->level_count - 1 - level : 0;
}

// Whether a floor waits for a region; those of the tile's border never do.
static inline bool waits(const watershed *w, uint32_t floor)
{
    return w->region[floor] == 0 && w->compact->area[floor] != TL_NAV_NULL_AREA;
}

// Counts the floors that wait, by level.
static void count_waiting(const watershed *w, uint32_t *sizes)
{
    memset(sizes, 0, w->level_count * sizeof *sizes);
    for (uint32_t i = 0; i < w->compact->span_count; i++) {
        sizes[level_of(w, i)] += waits(w, i);
    }
}

// How many floors each level has, at level_size[level].
static tl_result measure_levels(watershed *w, tl_arena *arena)
{
    uint32_t half = (w->compact->max_distance + 1u) / 2;
    w->level_count = half > 0 ? half : 1;
    w->level_size = TL_PUSH(arena, uint32_t, w->level_count);
    w->level_end = TL_PUSH(arena, uint32_t, w->level_count);
    if (w->level_size == NULL || w->level_end == NULL) {
        return TL_ERR_MEMORY;
    }
    count_waiting(w, w->level_size);
    return TL_OK;
}

// Appends the floors that wait in the levels [first, end) to the order: a counting sort. Each level has the room of all
// that it held at first; what floods have taken since leaves gaps, which are closed at once.
static tl_result sort_levels(watershed *w, uint32_t first, uint32_t end)
{
    const uint32_t count = w->compact->span_count, begin = w->order.count;
    uint32_t *next = w->level_end; // where the next floor of a level goes, then where the level ends
    uint32_t position = begin;
    for (uint32_t k = first; k < end; k++) {
        next[k] = position;
        position += w->level_size[k];
    }
    if (position == begin) {
        return TL_OK; // there may be no order yet to move within
    }
    TL_TRY(reserve_spans(w, &w->order, position));
    uint32_t *order = w->order.floors;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t level = level_of(w, i);
        if (level >= first && level < end && waits(w, i)) {
            order[next[level]++] = i;
        }
    }
    position = begin;
    for (uint32_t k = first, room = begin; k < end; k++) {
        const uint32_t size = next[k] - room;
        memmove(order + position, order + room, size * sizeof *order);
        room += w->level_size[k];
        position += size;
        next[k] = position;
    }
    w->order.count = position;
    return TL_OK;
}

// Moves the floors that still wait to the end of order[begin, end), in order. Returns where they begin.
static uint32_t keep_leftovers(watershed *w, uint32_t begin, uint32_t end)
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
static uint32_t last_level(const watershed *w, uint32_t first)
{
    const uint32_t share = w->compact->span_count / FIELDS_SHARE,
                   most = share > SORTED_AT_ONCE ? share : SORTED_AT_ONCE;
    uint32_t end = first + 1;
    for (uint64_t sum = w->level_size[first]; end < w->level_count && sum + w->level_size[end] <= most; end++) {
        sum += w->level_size[end];
    }
    return end;
}

static tl_result run_level(watershed *w, uint32_t *begin, uint32_t k)
{
    const uint32_t level = 2 * (w->level_count - 1 - k), flood_level = level >= 2 ? level - 2 : 0;
    const uint32_t end = w->level_end[k];
    TL_TRY(grow_basins(w, begin, end, level));
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

static tl_result run_levels(watershed *w)
{
    for (uint32_t k = 0; k < w->level_count;) {
        const uint32_t end = last_level(w, k);
        uint32_t begin = 0;
        TL_TRY(sort_levels(w, k, end));
        for (; k < end; k++) {
            TL_TRY(run_level(w, &begin, k));
        }
        if (begin > 0) {
            w->order.count -= begin;
            memmove(w->order.floors, w->order.floors + begin, w->order.count * sizeof *w->order.floors);
        }
    }
    uint32_t begin = 0;
    return grow_basins(w, &begin, w->order.count, 0);
}

static void free_list(const watershed *w, floor_list *list)
{
    tl_release_array(w->allocator, list->floors, list->capacity, sizeof *list->floors);
}

tl_result tl_regions_watershed(tl_region_work *work)
{
    watershed w = { 0 };
    w.compact = work->compact;
    w.allocator = &work->arena->allocator;
    w.region = work->region;
    w.next_region = 1;
    w.reach = work->scrap != NULL ? work->scrap : TL_PUSH(work->arena, uint16_t, work->compact->span_count);
    if (w.reach == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(measure_levels(&w, work->arena));
    tl_result result = run_levels(&w);
    free_list(&w, &w.order);
    free_list(&w, &w.joining);
    free_list(&w, &w.frontier);
    work->region_count = w.next_region;
    return result;
}
