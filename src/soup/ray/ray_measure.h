// SPDX-License-Identifier: MIT
//
// Where a ray meets the plane of a triangle that it hits: t, u, v and the normal, in double.
//
// With corner a, sides p and q from it, c = a - origin, d the direction and n = p x q, Cramer's rule (Moller and
// Trumbore, 1997) gives
//
//   t = n.c / n.d,  u = (c x d).q / n.d,  v = -(c x d).p / n.d
//
// in four lanes, with one division, and the normal comes with it. Nothing is fused, so every instruction set gives the
// same bits. ray_decide.c does the same for the triangles that the filters leave in doubt.
//
// Error of t, with u = TL_DOUBLE_ROUNDING, L the largest coordinate of p and q, M that of c, D that of d. A component
// of n sums two products of at most L^2, and four roundings go into each: it is off by 8 u L^2. So n.d is off by
// 3 (8 u L^2 D + 2 L^2 D 4 u) = 48 u L^2 D, and n.c by 48 u L^2 M. The hit lies on the triangle, so |t| D <= M + L.
// Together t is off by 48 u L^2 (2 M + L) / |n.d|, which is 48 u L^2 (2 M + L) / |n.c| of itself: that is much only
// when the ray grazes the triangle's plane, or begins in it. Then t is computed exactly (ray_decide.c).

#ifndef TALUS_SRC_SOUP_RAY_MEASURE_H
#define TALUS_SRC_SOUP_RAY_MEASURE_H

#include "math/simd4d.h"
#include "math/tolerance.h"
#include "soup/ray/ray_job.h"

#include <string.h>

/// Share of t that errors may move it before it is rounded: an eighth of an ulp of float.
#define TL_RAY_T_ERROR 7.450580596923828e-9 // 2^-27
// 48 u in units of that. The margin covers the rounding of the bound itself, and of L and M in float.
#define TL_RAY_ACROSS_BOUND (1.01 * 48.0 * TL_DOUBLE_ROUNDING / TL_RAY_T_ERROR)
// A t that is not near FLT_MAX.
#define TL_RAY_T_MAX 1e37f

// 8 * tl_soup_corner_slots.
static const uint8_t tl_ray_corner_shifts[8][4] = { { 0, 8, 16 }, { 0, 8, 16 }, { 8, 16, 0 }, { 16, 0, 8 },
                                                    { 0, 16, 8 }, { 16, 8, 0 }, { 8, 0, 16 }, { 0, 8, 16 } };

typedef struct tl_ray_crossing {
    tl_f64x4 normal; ///< n
    tl_f64x4 sums;   ///< n.d, n.c, and those of u and -v
} tl_ray_crossing;

/// Corners in the order of the view, axis k of each at [k * stride].
static TL_ALWAYS_INLINE tl_ray_crossing tl_ray_cross_plane(const tl_ray_job *job, const float *const corner[3],
                                                           uint32_t stride)
{
    tl_f64x4 origin = tl_f64x4_from_floats(job->origin.lane);
    tl_f64x4 direction = tl_f64x4_from_floats(job->target.lane);
    direction = job->is_segment ? tl_f64x4_sub(direction, origin) : direction;
    tl_f64x4 a = tl_f64x4_gather_three(corner[0], stride);
    tl_f64x4 p = tl_f64x4_sub(tl_f64x4_gather_three(corner[1], stride), a);
    tl_f64x4 q = tl_f64x4_sub(tl_f64x4_gather_three(corner[2], stride), a);
    tl_f64x4 c = tl_f64x4_sub(a, origin);
    tl_ray_crossing crossing;
    crossing.normal = tl_f64x4_cross(p, q);
    tl_f64x4 moment = tl_f64x4_cross(c, direction);
    crossing.sums = tl_f64x4_sums(tl_f64x4_mul(crossing.normal, direction), tl_f64x4_mul(crossing.normal, c),
                                  tl_f64x4_mul(moment, q), tl_f64x4_mul(moment, p));
    return crossing;
}

/// The normal of length 1; zero for a needle too thin for doubles to tell. By the operations of tl_triangle_normal.
static TL_ALWAYS_INLINE tl_vec3 tl_ray_unit_normal(tl_f64x4 normal)
{
    double length_sq = tl_f64x4_sum(tl_f64x4_mul(normal, normal));
    float unit[4];
    tl_f64x4_store_floats(unit, tl_f64x4_mul(normal, tl_f64x4_all(length_sq > 0.0 ? 1.0 / sqrt(length_sq) : 0.0)));
    return tl_vec3_make(unit[0], unit[1], unit[2]);
}

/// The least |n.c| with which t is as exact as promised, for a triangle with sides up to `wide` along an axis, `reach`
/// away.
static inline double tl_ray_least_across(double wide, double reach)
{
    return TL_RAY_ACROSS_BOUND * (wide * wide) * (2.0 * reach + wide);
}

/// Whether t is as exact as promised.
static inline bool tl_ray_t_is_safe(double across, double wide, double reach)
{
    return tl_ray_least_across(wide, reach) <= fabs(across);
}

/// Clamps u and v to the triangle: their rounding error may lead out of it.
static inline void tl_ray_keep_inside(float *u, float *v)
{
    *u = *u > 0.0f ? *u : 0.0f;
    *u = *u < 1.0f ? *u : 1.0f;
    *v = *v > 0.0f ? *v : 0.0f;
    *v = *v < 1.0f - *u ? *v : 1.0f - *u;
}

/// A triangle that the filters have proven to be hit, and where.
typedef struct tl_ray_place {
    tl_f64x4 normal; ///< n
    float t, u, v;
    uint32_t triangle;
    bool back;
} tl_ray_place;

/// Where the ray meets the first or second triangle of pair (bit & 3) of a leaf of n, which it surely meets in front of
/// its origin. False when t must be computed exactly. Bounds of the whole leaf bound this triangle's coordinates.
static TL_ALWAYS_INLINE bool tl_ray_find_place(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n,
                                               uint32_t bit, tl_ray_place *out)
{
    uint32_t pair = bit & 3u, second = bit >> 2;
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    uint32_t id = ids[pair + (second != 0 ? n : 0)];
    const float *floats = (const float *)(const void *)(ids + 2 * (size_t)n);
    // Where slots a, e and c begin, in bytes of a word, as in tl_leaf_find_corners.
    uint32_t slots = pair * 0x10101u + n * (0x10200u + (second << 8));
    const uint8_t *shift = tl_ray_corner_shifts[tl_id_order(id)];
    const float *corner[3];
    for (int k = 0; k < 3; k++) {
        corner[k] = floats + (slots >> shift[k] & 0xffu);
    }
    tl_ray_crossing crossing = tl_ray_cross_plane(job, corner, 4 * n);
    double along = tl_f64x4_get_x(crossing.sums);
    if (!tl_ray_t_is_safe(tl_f64x4_get_y(crossing.sums), (double)leaf->extent, (double)job->reach)) {
        return false;
    }
    float place[4]; // 1, t, u, -v
    tl_f64x4_store_floats(place, tl_f64x4_mul(crossing.sums, tl_f64x4_all(1.0 / along)));
    if (!(place[1] < TL_RAY_T_MAX)) {
        return false;
    }
    out->normal = crossing.normal;
    out->t = place[1];
    out->u = place[2];
    out->v = -place[3];
    tl_ray_keep_inside(&out->u, &out->v);
    out->triangle = id & TL_ID_INDEX;
    out->back = along > 0.0;
    return true;
}

/// Describes the pending triangle. False, and nothing done, when its t must be computed exactly.
static TL_ALWAYS_INLINE bool tl_ray_measure(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, uint32_t bit,
                                            tl_ray_hit *hit)
{
    tl_ray_place place;
    if (!tl_ray_find_place(job, leaf, n, bit, &place)) {
        return false;
    }
    memset(hit, 0, sizeof *hit);
    hit->t = place.t;
    hit->triangle = place.triangle;
    hit->u = place.u;
    hit->v = place.v;
    hit->normal = tl_ray_unit_normal(place.normal);
    hit->material = tl_soup_material(job->soup, place.triangle);
    hit->back = place.back;
    return true;
}

#endif
