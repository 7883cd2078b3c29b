// SPDX-License-Identifier: MIT
//
// How much of the plane polygons and tiles cover, summed up so that a random number finds its polygon.

#ifndef TALUS_SRC_NAV_QUERY_AREA_TABLE_H
#define TALUS_SRC_NAV_QUERY_AREA_TABLE_H

#include "nav_query/navmesh/navmesh.h"

/// The areas of a tile's polygons, twice, in squares of the lattice. Freed with tl_nav_areas_free. TL_ERR_MEMORY.
tl_result tl_nav_areas_make(const tl_allocator *allocator, const tl_nav_tile *tile, tl_nav_areas *areas_out);
void tl_nav_areas_free(const tl_allocator *allocator, tl_nav_areas *areas, uint32_t polygon_count);

/// The sum of those of the polygons before one, which may be polygon_count: of all.
static inline uint64_t tl_nav_area_before(const tl_nav_slot *slot, uint32_t polygon)
{
    return slot->areas.is_wide ? slot->areas.sums.wide[polygon] : slot->areas.sums.narrow[polygon];
}

static inline uint64_t tl_nav_area_of(const tl_nav_slot *slot, uint32_t polygon)
{
    return tl_nav_area_before(slot, polygon + 1) - tl_nav_area_before(slot, polygon);
}

/// Sums up all slots anew; the table has room for capacity + 1 numbers.
void tl_nav_area_table_fill(uint64_t *table, uint32_t capacity, const tl_nav_slot *slots, uint32_t slot_count);
/// The tile of a slot comes in (sign 1) or leaves (-1).
void tl_nav_area_table_change(tl_navmesh *navmesh, uint32_t slot, int sign);
uint64_t tl_nav_area_table_sum(const tl_navmesh *navmesh);
/// The slot in which square number `*at` lies, below the sum of all; `*at` becomes the square's number within the slot.
uint32_t tl_nav_area_table_find(const tl_navmesh *navmesh, uint64_t *at);

#endif
