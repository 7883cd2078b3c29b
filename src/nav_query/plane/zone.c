// SPDX-License-Identifier: MIT
//
// Whether something overlaps a zone. Circles: by the distance of their centre, in double. Outlines: two convex sets are
// disjoint exactly when an edge of one of them separates them; sides are decided exactly, so that touching counts in
// spite of rounding.
// Source: Gottschalk, Lin, Manocha, OBBTree, 1996, for the separating axis.

#include "nav_query/plane/zone.h"

#include "nav_query/plane/side.h"

tl_nav_zone tl_nav_zone_circle(tl_vec3 center, float radius)
{
    tl_nav_zone zone = { center, radius, NULL, 0 };
    return zone;
}

tl_nav_zone tl_nav_zone_polygon(const tl_vec3 *points, uint32_t point_count)
{
    tl_nav_zone zone = { { 0.0f, 0.0f, 0.0f }, 0.0f, points, point_count };
    return zone;
}

// Whether all points lie on one hand of each edge, or on its line: -1 left, 1 right, as tl_nav_side_of has it; 0: they
// do not, or lie on one line.
static int hand_of(const tl_vec3 *points, uint32_t count)
{
    int hand = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < count; k++) {
            int side = tl_nav_side_of(points[i], points[i + 1 < count ? i + 1 : 0], points[k]);
            if (side * hand < 0) {
                return 0;
            }
            hand = side != 0 ? side : hand;
        }
    }
    return hand;
}

static tl_result begin_outline(const tl_nav_zone *zone, tl_nav_zone_test *test)
{
    if (zone->point_count < 3 || zone->point_count > TL_NAV_MAX_ZONE_POINTS) {
        return TL_ERR_ARGUMENT;
    }
    test->min_x = test->max_x = zone->points[0].x;
    test->min_z = test->max_z = zone->points[0].z;
    for (uint32_t i = 0; i < zone->point_count; i++) {
        tl_vec3 point = zone->points[i];
        if (!isfinite(point.x) || !isfinite(point.z)) {
            return TL_ERR_NOT_FINITE;
        }
        test->min_x = tl_minf(test->min_x, point.x);
        test->min_z = tl_minf(test->min_z, point.z);
        test->max_x = tl_maxf(test->max_x, point.x);
        test->max_z = tl_maxf(test->max_z, point.z);
    }
    test->hand = -hand_of(zone->points, zone->point_count);
    return test->hand != 0 ? TL_OK : TL_ERR_ARGUMENT;
}

tl_result tl_nav_zone_begin(const tl_nav_zone *zone, tl_nav_zone_test *test_out)
{
    test_out->center = zone->center;
    test_out->radius_sq = (double)zone->radius * (double)zone->radius;
    test_out->points = zone->points;
    test_out->point_count = zone->point_count;
    test_out->hand = 0;
    if (zone->points != NULL) {
        return begin_outline(zone, test_out);
    }
    if (!isfinite(zone->center.x) || !isfinite(zone->center.z) || !isfinite(zone->radius)) {
        return TL_ERR_NOT_FINITE;
    }
    // Outward: the sums are rounded.
    float margin =
        zone->radius + (float)TL_FLOAT_OUTWARD * (zone->radius + fabsf(zone->center.x) + fabsf(zone->center.z));
    test_out->min_x = zone->center.x - margin;
    test_out->min_z = zone->center.z - margin;
    test_out->max_x = zone->center.x + margin;
    test_out->max_z = zone->center.z + margin;
    return zone->radius >= 0.0f ? TL_OK : TL_ERR_ARGUMENT;
}

// Whether the line of an edge of `a`, whose inside is on the side `hand` of it, has all of `b` beyond it.
static bool parts(const tl_vec3 *a, uint32_t a_count, int hand, const tl_vec3 *b, uint32_t b_count)
{
    for (uint32_t i = 0; i < a_count; i++) {
        tl_vec3 from = a[i];
        tl_vec3 to = a[i + 1 < a_count ? i + 1 : 0];
        uint32_t beyond = 0;
        while (beyond < b_count && hand * tl_nav_side_of(from, to, b[beyond]) > 0) {
            beyond++;
        }
        if (beyond == b_count) {
            return true;
        }
    }
    return false;
}

bool tl_nav_outline_meets_segment(const tl_nav_zone_test *test, tl_vec3 a, tl_vec3 b)
{
    const tl_vec3 ends[2] = { a, b };
    return !parts(test->points, test->point_count, test->hand, ends, 2) &&
           !parts(ends, 2, 1, test->points, test->point_count);
}

bool tl_nav_zone_meets_polygon(const tl_nav_zone_test *test, const tl_vec3 *corners, uint32_t count)
{
    if (test->points != NULL) {
        return !parts(test->points, test->point_count, test->hand, corners, count) &&
               !parts(corners, count, 1, test->points, test->point_count);
    }
    bool is_over = true;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = corners[i];
        tl_vec3 b = corners[i + 1 < count ? i + 1 : 0];
        if (tl_nav_comes_near(test, a, b)) {
            return true;
        }
        is_over = is_over && tl_nav_side_of(a, b, test->center) <= 0;
    }
    return is_over;
}
