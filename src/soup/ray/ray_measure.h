// SPDX-License-Identifier: MIT
//
// Where a ray meets the plane of a triangle that it hits: t, u, v and the normal, in double.
//
// With corner a, sides p and q from it, c = a - origin, d the direction and n = p x q, Cramer's rule (Moller and
// Trumbore, 1997) gives
//
//   t = n.c / n.d,  u = (c x d).q / n.d,  v = -(c x d).p / n.d
//
// with one division, and the normal comes with it. An axis is a vector of four lanes, p, q, c and d, so both cross
// products are one, the four sums need no lane of another vector, and the chain that a ray waits for is short. Nothing
// is fused, so every instruction set gives the same bits. ray_decide.c does the same for the triangles that the filters
// leave in doubt.
//
// Error of t, with u = TL_DOUBLE_ROUNDING, L the largest coordinate of p and q, M that of c, D that of d. A component
// of n sums two products of at most L^2, and four roundings go into each: it is off by 8 u L^2. So n.d is off by
// 3 (8 u L^2 D + 2 L^2 D 4 u) = 48 u L^2 D, and n.c by 48 u L^2 M. The hit lies on the triangle, so |t| D <= M + L.
// Together t is off by 48 u L^2 (2 M + L) / |n.d|, which is 48 u L^2 (2 M + L) / |n.c| of itself: that is much only
// when the ray grazes the triangle's plane, or begins in it. Then t is computed exactly (ray_decide.c).
//
// Coincident triangles may be measured from different corners, and then their t round differently. They are all within
// the error of the true t. So where t, taken twice that off to either side, rounds to the same float, it is the t of
// all of them: but for one hit in some hundred thousand, one of them is measured.

#ifndef TALUS_SRC_SOUP_RAY_MEASURE_H
#define TALUS_SRC_SOUP_RAY_MEASURE_H

#include "math/simd4d.h"
#include "math/tolerance.h"
#include "soup/ray/ray_job.h"

#include <stddef.h>
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
    tl_f64x4 normal[3]; ///< an axis each: n in lane 0
    tl_f64x4 sums;      ///< n.d, -n.c, and those of u and v
} tl_ray_crossing;

/// Corners in the order of the view, axis k of each at [k * stride].
static TL_ALWAYS_INLINE tl_ray_crossing tl_ray_cross_plane(const tl_ray_job *job, const float *const corner[3],
                                                           uint32_t stride)
{
    tl_f32x4 origin = tl_f32x4_load(job->origin.lane);
    tl_f32x4 start = job->is_segment ? origin : tl_f32x4_all(0.0f); // of d
    tl_f32x4 xy = tl_f32x4_zip_low(origin, start), z = tl_f32x4_zip_high(origin, start);
    tl_f64x4 side[3], turned[3]; // p, q, c, d and q, p, d, c
    for (uint32_t k = 0; k < 3; k++) {
        size_t at = k * (size_t)stride;
        tl_f32x4 end = tl_f32x4_gather_four(corner[1] + at, corner[2] + at, corner[0] + at, &job->target.lane[k]);
        tl_f32x4 from = k == 0   ? tl_f32x4_twice_z_and_low(end, xy)
                        : k == 1 ? tl_f32x4_twice_z_and_high(end, xy)
                                 : tl_f32x4_twice_z_and_low(end, z);
        side[k] = tl_f64x4_sub(tl_f64x4_of_floats(end), tl_f64x4_of_floats(from));
        turned[k] = tl_f64x4_swap_lanes(side[k]);
    }
    tl_ray_crossing crossing;
    tl_f64x4 part[3]; // of the sums
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
        crossing.normal[k] = tl_f64x4_sub(tl_f64x4_mul(side[i], turned[j]), tl_f64x4_mul(side[j], turned[i]));
        part[k] = tl_f64x4_mul(crossing.normal[k], tl_f64x4_swap_halves(turned[k]));
    }
    crossing.sums = tl_f64x4_add(tl_f64x4_add(part[0], part[1]), part[2]);
    return crossing;
}

/// The normal of length 1; zero for a needle too thin for doubles to tell. By the operations of tl_triangle_normal.
static TL_ALWAYS_INLINE tl_vec3 tl_ray_unit_normal(const double n[3])
{
    double length_sq = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    double scale = length_sq > 0.0 ? 1.0 / sqrt(length_sq) : 0.0;
    return tl_vec3_make((float)(n[0] * scale), (float)(n[1] * scale), (float)(n[2] * scale));
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

/// Whether a t that is as exact as promised is that of every triangle with these corners. `least` is what
/// tl_ray_least_across has for them.
static inline bool tl_ray_t_is_common(double along, double across, double least)
{
    const double inverse = 1.0 / along, t = fabs(across * inverse);
    // Roundings of this bound take an eighth of it at most.
    const double off = 2.25 * TL_RAY_T_ERROR * least * fabs(inverse);
    return (float)(t - off) == (float)(t + off);
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
    double normal[3]; ///< n
    double along, across;
    float t, u, v;
    bool back;
    bool behind; ///< the origin
} tl_ray_place;

/// Where the ray's line meets the first or second triangle of pair (bit & 3) of a leaf of n, which it surely meets; its
/// id word is `id`. False when t must be computed exactly. Bounds of the whole leaf bound this triangle's coordinates.
static TL_ALWAYS_INLINE bool tl_ray_find_place(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n,
                                               uint32_t bit, uint32_t id, tl_ray_place *out)
{
    uint32_t pair = bit & 3u, second = bit >> 2;
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    const float *floats = (const float *)(const void *)(ids + 2 * (size_t)n);
    // Where slots a, e and c begin, in bytes of a word, as in tl_leaf_find_corners.
    uint32_t slots = pair * 0x10101u + n * (0x10200u + (second << 8));
    const uint8_t *shift = tl_ray_corner_shifts[tl_id_order(id)];
    const float *corner[3];
    for (int k = 0; k < 3; k++) {
        corner[k] = floats + (slots >> shift[k] & 0xffu);
    }
    tl_ray_crossing crossing = tl_ray_cross_plane(job, corner, 4 * n);
    double along = tl_f64x4_get_x(crossing.sums), across = tl_f64x4_get_y(crossing.sums); // -n.c
    if (!tl_ray_t_is_safe(across, (double)leaf->extent, (double)job->reach)) {
        return false;
    }
    float place[4]; // 1, -t, u, v
    tl_f64x4_store_floats(place, tl_f64x4_mul(crossing.sums, tl_f64x4_all(1.0 / along)));
    if (!(fabsf(place[1]) < TL_RAY_T_MAX)) {
        return false;
    }
    out->behind = (along > 0.0) == (across > 0.0);
    for (int k = 0; k < 3; k++) {
        out->normal[k] = tl_f64x4_get_x(crossing.normal[k]);
    }
    out->t = -place[1];
    out->u = place[2];
    out->v = place[3];
    tl_ray_keep_inside(&out->u, &out->v);
    out->along = along;
    out->across = across;
    out->back = along > 0.0;
    return true;
}

/// Describes the best hit of a job.
static TL_ALWAYS_INLINE void tl_ray_describe_inline(const tl_ray_job *job, tl_ray_hit *hit)
{
    memset((char *)hit + offsetof(tl_ray_hit, material), 0, sizeof *hit - offsetof(tl_ray_hit, material));
    hit->t = job->t;
    hit->triangle = job->triangle;
    hit->u = job->u;
    hit->v = job->v;
    hit->normal = tl_ray_unit_normal(job->normal);
    hit->material = tl_soup_material(job->soup, job->triangle);
    hit->back = job->back;
}

#endif
