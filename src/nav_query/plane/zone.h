// SPDX-License-Identifier: MIT
//
// Zones of the plane: what comes into them.

#ifndef TALUS_SRC_NAV_QUERY_ZONE_H
#define TALUS_SRC_NAV_QUERY_ZONE_H

#include <talus/nav_around.h>

/// A zone that was looked at once.
typedef struct tl_nav_zone_test {
    tl_vec3 center;
    double radius_sq;
    const tl_vec3 *points; ///< NULL: the circle
    uint32_t point_count;
    int hand;           ///< of the outline: 1 when its inside is on the left of its edges, else -1
    float min_x, min_z; ///< its box
    float max_x, max_z;
} tl_nav_zone_test;

/// TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT: a negative radius, an outline that is not convex.
tl_result tl_nav_zone_begin(const tl_nav_zone *zone, tl_nav_zone_test *test_out);

/// Whether a stretch comes within the circle: by one of its ends, or, where the centre lies beside it, by its line.
static inline bool tl_nav_comes_near(const tl_nav_zone_test *test, tl_vec3 a, tl_vec3 b)
{
    double ex = (double)b.x - (double)a.x;
    double ez = (double)b.z - (double)a.z;
    double px = (double)test->center.x - (double)a.x;
    double pz = (double)test->center.z - (double)a.z;
    double along = ex * px + ez * pz;
    double length_sq = ex * ex + ez * ez;
    if (!(along > 0.0)) {
        return px * px + pz * pz <= test->radius_sq;
    }
    if (along >= length_sq) {
        px -= ex;
        pz -= ez;
        return px * px + pz * pz <= test->radius_sq;
    }
    double across = ex * pz - ez * px;
    return across * across <= test->radius_sq * length_sq;
}

bool tl_nav_outline_meets_segment(const tl_nav_zone_test *test, tl_vec3 a, tl_vec3 b);

/// Whether the stretch from a to b comes into the zone.
static inline bool tl_nav_zone_meets_segment(const tl_nav_zone_test *test, tl_vec3 a, tl_vec3 b)
{
    return test->points == NULL ? tl_nav_comes_near(test, a, b) : tl_nav_outline_meets_segment(test, a, b);
}

/// Whether a convex polygon (its inside left of its edges) does.
bool tl_nav_zone_meets_polygon(const tl_nav_zone_test *test, const tl_vec3 *corners, uint32_t count);

#endif
