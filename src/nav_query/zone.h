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

/// Whether the stretch from a to b comes into the zone.
bool tl_nav_zone_meets_segment(const tl_nav_zone_test *test, tl_vec3 a, tl_vec3 b);
/// Whether a convex polygon (its inside left of its edges) does.
bool tl_nav_zone_meets_polygon(const tl_nav_zone_test *test, const tl_vec3 *corners, uint32_t count);

#endif
