// SPDX-License-Identifier: MIT
//
// Places along the borders of a navmesh, and where ways from there may land.

#ifndef TALUS_SRC_NAV_LINKS_LEDGES_H
#define TALUS_SRC_NAV_LINKS_LEDGES_H

#include "nav_links/trajectory.h"

/// A place on a border edge.
typedef struct tl_nav_ledge_point {
    tl_nav_ref polygon;
    tl_vec3 point;    ///< on the surface
    tl_vec3 out;      ///< unit, in the plane, away from the polygon
    float off_middle; ///< metres from the middle of its edge
} tl_nav_ledge_point;

/// Goes through all border edges, and along each at `spacing` or less, evenly. Writes the first `capacity`; returns the
/// true count. `*edge_count_out`: border edges.
uint64_t tl_nav_sample_ledges(const tl_navmesh *navmesh, float spacing, tl_nav_ledge_point *points, uint64_t capacity,
                              uint64_t *edge_count_out);

/// Ways that start at one place: one down, and a jump in each of three directions.
#define TL_NAV_WAYS_A_PLACE 4u

typedef enum tl_nav_way_fate {
    TL_NAV_WAY_NONE, ///< nothing to land on
    TL_NAV_WAY_TOO_FAST,
    TL_NAV_WAY_BLOCKED,
    TL_NAV_WAY_FREE
} tl_nav_way_fate;

typedef struct tl_nav_way_try {
    tl_nav_found_link link;
    float cost; ///< metres, straight from start to end
    float rank; ///< ways of less rank are kept first
    tl_nav_way_fate fate;
} tl_nav_way_try;

/// What all tries share.
typedef struct tl_nav_landing_search {
    const tl_nav_links_def *def;
    const tl_navmesh *navmesh;
    tl_nav_walker walker;
    float radius, lift; ///< of the agent
    float cell;
} tl_nav_landing_search;

/// Finds where ways from a place land, and proves them.
void tl_nav_try_ways(const tl_nav_landing_search *search, const tl_nav_ledge_point *place,
                     tl_nav_way_try tries[TL_NAV_WAYS_A_PLACE]);

#endif
