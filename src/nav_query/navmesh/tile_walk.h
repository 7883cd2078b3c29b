// SPDX-License-Identifier: MIT
//
// The tiles that a box in the plane touches: by their places, or, where the box covers more places than there are
// tiles, all of them.

#ifndef TALUS_SRC_NAV_QUERY_TILE_WALK_H
#define TALUS_SRC_NAV_QUERY_TILE_WALK_H

#include "nav_query/navmesh/navmesh.h"

typedef struct tl_nav_tile_walk {
    const tl_navmesh *navmesh;
    bool by_place;
    uint32_t slot; // the next one to look at
    int64_t first_x, last_x, last_z;
    int64_t x, z;  // the next place to look at
    uint32_t next; // at the same place, or TL_NAV_NO_SLOT
} tl_nav_tile_walk;

// Tiles along one axis that an interval touches, one cell of margin on each side for rounding.
static inline void tl_nav_tile_interval(double low, double high, double origin, const tl_navmesh *navmesh,
                                        int64_t *first_out, int64_t *last_out)
{
    double cell = (double)navmesh->cell_size;
    double size = cell * (double)navmesh->tile_size;
    double limit = (double)TL_NAV_MAX_TILE_INDEX;
    double first = floor((low - origin - cell) / size);
    double last = floor((high - origin + cell) / size);
    *first_out = (int64_t)(first < -limit ? -limit : first > limit ? limit : first);
    *last_out = (int64_t)(last < -limit ? -limit : last > limit ? limit : last);
}

static inline tl_nav_tile_walk tl_nav_tiles_over(const tl_navmesh *navmesh, tl_aabb box)
{
    tl_nav_tile_walk walk = { navmesh, false, 0, 0, 0, 0, 0, 0, TL_NAV_NO_SLOT };
    if (navmesh->tile_size > 0) {
        tl_nav_tile_interval((double)box.min.x, (double)box.max.x, (double)navmesh->origin.x, navmesh, &walk.first_x,
                             &walk.last_x);
        tl_nav_tile_interval((double)box.min.z, (double)box.max.z, (double)navmesh->origin.z, navmesh, &walk.z,
                             &walk.last_z);
        walk.x = walk.first_x;
        // Places are below 2^25 an axis: the product fits 64 bits.
        walk.by_place = (walk.last_x - walk.first_x + 1) * (walk.last_z - walk.z + 1) <= (int64_t)navmesh->slot_count;
    }
    return walk;
}

/// The slot of the next tile, or TL_NAV_NO_SLOT.
static inline uint32_t tl_nav_next_tile(tl_nav_tile_walk *walk)
{
    while (walk->by_place && (walk->next != TL_NAV_NO_SLOT || walk->z <= walk->last_z)) {
        uint32_t slot = walk->next;
        if (slot == TL_NAV_NO_SLOT) {
            slot = tl_nav_find_slot(walk->navmesh, walk->x, walk->z);
            bool ends_row = walk->x == walk->last_x;
            walk->x = ends_row ? walk->first_x : walk->x + 1;
            walk->z += ends_row ? 1 : 0;
        }
        if (slot != TL_NAV_NO_SLOT) {
            walk->next = tl_nav_next_slot(walk->navmesh, slot);
            return slot;
        }
    }
    while (!walk->by_place && walk->slot < walk->navmesh->slot_count) {
        uint32_t slot = walk->slot++;
        if (walk->navmesh->slots[slot].tile != NULL) {
            return slot;
        }
    }
    return TL_NAV_NO_SLOT;
}

#endif
