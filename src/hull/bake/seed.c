// SPDX-License-Identifier: MIT
//
// The initial simplex of quickhull, a tetrahedron, and which result input without volume gets.
//
// The two extreme points of the box that are farthest apart, then the point farthest from their line, then the one
// farthest from that plane: a fat tetrahedron leaves few points outside. Distances are approximate here; that the four
// are independent is decided exactly.

#include "hull/bake/quickhull.h"

#include "base/assert.h"
#include "base/lowest_bit.h"
#include "base/min_max.h"
#include "math/predicates.h"
#include "math/tolerance.h"
#include "math/vec3d.h"

static tl_vec3d point_difference(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3d_sub(tl_vec3d_from(a), tl_vec3d_from(b));
}

// The first point at each end of each axis: low x, high x, low y, ...
static void find_extremes(const tl_quickhull *hull, uint32_t extreme[6])
{
    tl_vec3 low = hull->box.min, high = hull->box.max;
    uint32_t missing = 0x3f;
    for (uint32_t i = 0; missing != 0; i++) {
        TL_ASSERT(i < hull->point_count); // each end of the box is some point's
        tl_vec3 p = hull->points[i];
        uint32_t at = (uint32_t)(p.x == low.x) | (uint32_t)(p.x == high.x) << 1 | (uint32_t)(p.y == low.y) << 2 |
                      (uint32_t)(p.y == high.y) << 3 | (uint32_t)(p.z == low.z) << 4 | (uint32_t)(p.z == high.z) << 5;
        for (at &= missing; at != 0; at &= at - 1) {
            extreme[tl_lowest_bit(at)] = i;
            missing &= ~(1u << tl_lowest_bit(at));
        }
    }
}

static void farthest_extremes(const tl_quickhull *hull, uint32_t *a_out, uint32_t *b_out)
{
    uint32_t extreme[6];
    find_extremes(hull, extreme);
    double best = -1.0;
    for (int i = 0; i < 6; i++) {
        for (int j = i + 1; j < 6; j++) {
            tl_vec3d d = point_difference(hull->points[extreme[i]], hull->points[extreme[j]]);
            if (tl_vec3d_dot(d, d) > best) {
                best = tl_vec3d_dot(d, d);
                *a_out = extreme[i];
                *b_out = extreme[j];
            }
        }
    }
}

// The point with the largest distance from the line a, b; its distance.
static uint32_t farthest_from_line(const tl_quickhull *hull, uint32_t a, uint32_t b, double *distance_out)
{
    tl_vec3d along = point_difference(hull->points[b], hull->points[a]);
    uint32_t best = a;
    double best_sq = -1.0;
    for (uint32_t i = 0; i < hull->point_count; i++) {
        tl_vec3d n = tl_vec3d_cross(along, point_difference(hull->points[i], hull->points[a]));
        double value = tl_vec3d_dot(n, n);
        if (value > best_sq) {
            best_sq = value;
            best = i;
        }
    }
    *distance_out = sqrt(best_sq / tl_vec3d_dot(along, along));
    return best;
}

// The point with the largest distance from the plane a, b, c, and how thick the cloud is across the plane.
static uint32_t farthest_from_plane(const tl_quickhull *hull, const uint32_t seed[3], double *thickness_out)
{
    tl_vec3 a = hull->points[seed[0]];
    tl_vec3d n = tl_vec3d_cross(point_difference(hull->points[seed[1]], a), point_difference(hull->points[seed[2]], a));
    uint32_t best = seed[0];
    double best_value = -1.0, low = 0.0, high = 0.0;
    for (uint32_t i = 0; i < hull->point_count; i++) {
        double value = tl_vec3d_dot(n, point_difference(hull->points[i], a));
        low = tl_min_f64(low, value);
        high = tl_max_f64(high, value);
        if (fabs(value) > best_value) {
            best_value = fabs(value);
            best = i;
        }
    }
    *thickness_out = (high - low) / sqrt(tl_vec3d_dot(n, n));
    return best;
}

tl_result tl_quickhull_seed(tl_quickhull *hull, double flatness, uint32_t seed[4], uint32_t *rank_out)
{
    // One rounding moves a point_coordinate by at most TL_FLOAT_ROUNDING times the largest.
    tl_vec3 largest = tl_max(tl_abs(hull->box.min), tl_abs(hull->box.max));
    double noise = flatness * (double)TL_FLOAT_ROUNDING * (double)tl_maxf(largest.x, tl_maxf(largest.y, largest.z));
    tl_vec3d extent = point_difference(hull->box.max, hull->box.min);
    double size = fmax(extent.x, fmax(extent.y, extent.z));
    *rank_out = 0;
    seed[0] = seed[1] = seed[2] = seed[3] = 0;
    if (size == 0.0 || size <= noise) {
        return TL_ERR_COINCIDENT;
    }
    farthest_extremes(hull, &seed[0], &seed[1]);
    *rank_out = 1;
    double distance;
    seed[2] = farthest_from_line(hull, seed[0], seed[1], &distance);
    tl_vec3 a = hull->points[seed[0]], b = hull->points[seed[1]];
    bool straight = distance <= noise || tl_is_collinear(a, b, hull->points[seed[2]]);
    // The approximate farthest may be an exactly collinear one where the cloud is thinner than double rounding.
    for (uint32_t i = 0; flatness == 0.0 && straight && i < hull->point_count; i++) {
        straight = tl_is_collinear(a, b, hull->points[i]);
        seed[2] = i;
    }
    if (straight) {
        return TL_ERR_COLLINEAR;
    }
    *rank_out = 2;
    seed[3] = farthest_from_plane(hull, seed, &distance);
    tl_vec3 c = hull->points[seed[2]];
    bool flat = distance <= noise || tl_orient3d(a, b, c, hull->points[seed[3]]) == 0;
    for (uint32_t i = 0; flatness == 0.0 && flat && i < hull->point_count; i++) {
        flat = tl_orient3d(a, b, c, hull->points[i]) == 0;
        seed[3] = i;
    }
    if (flat) {
        return TL_ERR_COPLANAR;
    }
    *rank_out = 3;
    return TL_OK;
}
