// SPDX-License-Identifier: MIT
//
// Distances from segments to a convex shape, and the steps of finding the walls near it (visible_walls.c,
// walls_near_shape.c).

#ifndef TALUS_SRC_NAV_QUERY_WALLS_NEAR_SHAPE_H
#define TALUS_SRC_NAV_QUERY_WALLS_NEAR_SHAPE_H

#include "base/min_max.h"
#include "nav_query/wide/clearance.h"

/// A convex shape and its box, grown by the distance and some slack.
typedef struct tl_nav_shape {
    const tl_nav_spot *corners;
    uint32_t count;
    double distance_sq;
    double low_x, low_z, high_x, high_z;
} tl_nav_shape;

static inline tl_nav_shape tl_nav_shape_make(const tl_nav_spot *corners, uint32_t count, double distance, double slack)
{
    tl_nav_shape reach = {
        corners, count, distance * distance, corners[0].x, corners[0].z, corners[0].x, corners[0].z
    };
    for (uint32_t i = 1; i < count; i++) {
        reach.low_x = tl_min_f64(corners[i].x, reach.low_x);
        reach.low_z = tl_min_f64(corners[i].z, reach.low_z);
        reach.high_x = tl_max_f64(corners[i].x, reach.high_x);
        reach.high_z = tl_max_f64(corners[i].z, reach.high_z);
    }
    reach.low_x -= distance + slack;
    reach.low_z -= distance + slack;
    reach.high_x += distance + slack;
    reach.high_z += distance + slack;
    return reach;
}

/// Whether a segment lies outside of the box.
static inline bool tl_nav_shape_is_far(const tl_nav_shape *reach, tl_nav_segment segment)
{
    return tl_max_f64(segment.b.x, segment.a.x) < reach->low_x ||
           tl_min_f64(segment.b.x, segment.a.x) > reach->high_x ||
           tl_max_f64(segment.b.z, segment.a.z) < reach->low_z || tl_min_f64(segment.b.z, segment.a.z) > reach->high_z;
}

/// The squared distance from a shape to a segment that does not lie inside of it; infinite when it is surely too far.
static inline double tl_nav_shape_distance_sq(const tl_nav_shape *reach, tl_nav_segment segment)
{
    double best_sq = (double)INFINITY;
    if (tl_nav_shape_is_far(reach, segment)) {
        return best_sq;
    }
    for (uint32_t i = 0; i < (reach->count > 2 ? reach->count : 1); i++) {
        tl_nav_segment side = { reach->corners[i], reach->corners[i + 1 < reach->count ? i + 1 : 0] };
        best_sq = tl_min_f64(tl_nav_segments_distance_sq(side, segment), best_sq);
    }
    return best_sq;
}

/// Whether a wall is nearer than `distance` to all of a convex outline: what it forbids is convex, so the corners tell.
static inline bool tl_nav_wall_covers(tl_nav_segment wall, const tl_nav_spot *corners, uint32_t count, double distance)
{
    bool covers = distance > 0.0;
    for (uint32_t i = 0; covers && i < count; i++) {
        tl_nav_spot nearest;
        covers = tl_nav_nearest_of_segment(wall, corners[i], &nearest) < distance * distance;
    }
    return covers;
}

/// Begins a list of walls in the scratch memory.
void tl_nav_begin_walls(tl_nav_clearance *clearance, tl_nav_near_walls *near);
/// Adds the walls around a shape that lies in a polygon. False: out of scratch memory.
bool tl_nav_add_visible_walls(tl_nav_clearance *clearance, tl_nav_met at, const tl_nav_spot *shape, uint32_t count,
                              double distance, tl_nav_near_walls *near);
/// Sorts the list and takes its memory.
void tl_nav_end_walls(tl_nav_clearance *clearance, const tl_nav_near_walls *near);

#endif
