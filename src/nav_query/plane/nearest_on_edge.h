// SPDX-License-Identifier: MIT
//
// Where an edge comes nearest to a point, in the plane.

#ifndef TALUS_SRC_NAV_QUERY_NEAREST_ON_EDGE_H
#define TALUS_SRC_NAV_QUERY_NEAREST_ON_EDGE_H

#include <talus/vec.h>

/// Where an edge comes nearest to a point.
typedef struct tl_nav_plan_point {
    double t; ///< [0, 1] of the way from the edge's start to its end
    double distance_sq;
} tl_nav_plan_point;

static inline tl_nav_plan_point tl_nav_nearest_on_edge(const tl_vec3 *start, const tl_vec3 *end, double x, double z)
{
    double ex = (double)end->x - (double)start->x;
    double ez = (double)end->z - (double)start->z;
    double px = x - (double)start->x;
    double pz = z - (double)start->z;
    double along = ex * px + ez * pz;
    double length_sq = ex * ex + ez * ez;
    tl_nav_plan_point nearest = { 0.0, 0.0 };
    if (along > 0.0 && length_sq > 0.0) {
        nearest.t = along < length_sq ? along / length_sq : 1.0;
    }
    px -= nearest.t * ex;
    pz -= nearest.t * ez;
    nearest.distance_sq = px * px + pz * pz;
    return nearest;
}

/// The point of an edge at t: its ends' own bits at 0 and 1.
static inline tl_vec3 tl_nav_point_on_edge(const tl_vec3 *start, const tl_vec3 *end, double t)
{
    if (t <= 0.0) {
        return *start;
    }
    if (t >= 1.0) {
        return *end;
    }
    return tl_vec3_make((float)((double)start->x + t * ((double)end->x - (double)start->x)),
                        (float)((double)start->y + t * ((double)end->y - (double)start->y)),
                        (float)((double)start->z + t * ((double)end->z - (double)start->z)));
}

#endif
