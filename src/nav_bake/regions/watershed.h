// SPDX-License-Identifier: MIT
//
// What the parts of the watershed share: floors sorted by level, growth, floods.

#ifndef TALUS_SRC_NAV_BAKE_WATERSHED_H
#define TALUS_SRC_NAV_BAKE_WATERSHED_H

#include "nav_bake/regions/regions.h"

enum { TL_WATERSHED_BLOCKS_PER_WORKER = 2 };

/// Floors that wait for something. Grows as needed: mostly it holds one contour line of the field.
typedef struct tl_floor_list {
    uint32_t *floors;
    uint32_t count, capacity;
} tl_floor_list;

/// A floor that a task has found a region for.
typedef struct tl_joining_floor {
    uint32_t floor, region;
    uint32_t reach;
} tl_joining_floor;

/// Some of the waiting floors, order[begin, end): a task.
typedef struct tl_look_block {
    uint32_t begin, end;
    uint32_t kept;  ///< order[kept, end) still wait
    uint32_t found; ///< how many do not
    uint32_t first; ///< where these begin in the list of those that join
} tl_look_block;

typedef struct tl_watershed {
    const tl_nav_compact *compact;
    const tl_allocator *allocator;
    const tl_host *host; ///< whose tasks share the work
    uint32_t worker_count;
    uint32_t *region;
    /// [span_count] growth steps from the region's flooded core. Of floors with a region only, and the distances of
    /// those are no longer asked for: where it may be, it is the same array.
    uint16_t *reach;
    tl_floor_list order;  ///< walkable floors of some levels, highest first, then by index; before them, what is left
    uint32_t *level_size; ///< [level_count] floors of level k, counted from the highest
    uint32_t *level_end;  ///< [level_count] where it ends in the order
    uint32_t level_count;
    tl_floor_list joining;  ///< floors that join in this step
    bool have_joined;       ///< at once, and do not wait for its end
    tl_floor_list frontier; ///< floors that joined in the last step; the stack while flooding
    uint32_t next_region;
    // Where tasks share the sorting: blocks of the field, each of which counts, and then sorts, its own floors.
    uint32_t field_block, field_block_count; ///< floors of a block; how many blocks
    uint32_t *block_sizes, *block_next;      ///< [field_block_count][level_stride]
    uint32_t level_stride;                   ///< level_count and more, whole cache lines
    uint32_t sort_first, sort_end;           ///< the levels that are sorted
    // Where they share the looks at waiting floors:
    tl_joining_floor *found; ///< [found_capacity] what blocks of them found, each from its place in the order on
    uint32_t found_capacity;
    tl_look_block *blocks; ///< [TL_WATERSHED_BLOCKS_PER_WORKER * worker_count]
} tl_watershed;

/// Makes room for `count` floors in all.
tl_result tl_watershed_reserve(const tl_watershed *w, tl_floor_list *list, uint64_t count);

/// How many floors each level has.
tl_result tl_watershed_measure(tl_watershed *w, tl_arena *arena);

/// Appends the floors that wait in the levels [first, end) to the order.
tl_result tl_watershed_sort(tl_watershed *w, uint32_t first, uint32_t end);

/// Grows the regions over the waiting floors: order[*begin, end), all at `level` or above it. Those that still wait in
/// the end are among order[*begin, end) then, in order.
tl_result tl_watershed_grow(tl_watershed *w, uint32_t *begin, uint32_t end, uint32_t level);

static inline bool tl_region_is_interior(uint32_t region)
{
    return region != 0 && !tl_region_is_border(region);
}

#endif
