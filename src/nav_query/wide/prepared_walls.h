// SPDX-License-Identifier: MIT
//
// The walls around each polygon, kept with the navmesh (prepared_walls.c).

#ifndef TALUS_SRC_NAV_QUERY_PREPARED_WALLS_H
#define TALUS_SRC_NAV_QUERY_PREPARED_WALLS_H

#include "nav_query/wide/wall_cell.h"

#include <talus/nav_wide.h>

/// Where a polygon's walls and pairs begin; they end where the next one's do.
typedef struct tl_nav_kept_cell {
    uint32_t wall, pair;
    float within; ///< metres: at more, a wall forbids all of the polygon, and others may be missing
} tl_nav_kept_cell;

/// Of all polygons of a slot.
struct tl_nav_kept_walls {
    tl_nav_kept_cell *cells; ///< [polygon_count + 1]
    uint32_t *side_first;    ///< [corner_count + 1], by corner of the tile: the hits of the side that starts there
    tl_nav_wall_pair *pairs;
    tl_nav_near_wall *walls;
    tl_nav_wall_hit *hits;
    uint64_t size; ///< bytes of the block that this and all arrays stand in
};

#endif
