// SPDX-License-Identifier: MIT
//
// What is computed once a ray for the float filters: slab constants with their rounding already added, and the shear
// that turns the ray into an axis.
//
// Below, u is TL_FLOAT_ROUNDING, M the largest distance along an axis from the ray's origin to a corner of the soup's
// box, and one corner_error is 8 u M (with a margin for its own rounding). All bounds are absolute distances:
//
// Sheared corners. x' = X - S Z with X = P.x - O.x and S = D.x / D.z, |S| <= 1. X and Z round once each, S three times
// (a segment's direction, the inverse, the product), S Z and the difference once: |error| <= u (|X| + 5 |S Z| + |x'|)
// <= u (2 |X| + 6 |Z|) <= 8 u M.
//
// Slab planes. t = p inv - O inv, with p the plane. inv has two roundings (a segment's direction, the division), each
// product one, the difference one: |error| <= 4 u (|p| + |O|) |inv| <= 4 u (2 |O| + M) |inv|. The pad is
// 16 u (|O| + M) |inv|; it rounds, and so does O inv with the pad, which takes 2 u (|O| + M) of it. What is left,
// 6 u |O| + 10 u M, covers the rounding of the reported t (u t) with which boxes are compared, and the error before it,
// which grows with the t of a triangle's farthest corner.
//
// A direction component that is tiny or zero is replaced by 2^-60 of the largest, which keeps all numbers finite: over
// the whole way through the soup's box that moves the ray by at most 2^-59 M.
//
// Source of the shear: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013. Where that paper decides
// in float and mends zeros, here float only rejects.

#ifndef TALUS_SRC_SOUP_RAY_PREPARE_H
#define TALUS_SRC_SOUP_RAY_PREPARE_H

#include "math/simd.h"
#include "math/tolerance.h"
#include "soup/ray.h"

#include <float.h>

#define TL_RAY_CORNER_ERROR     TL_FLOAT_GAMMA(8.1)
#define TL_RAY_PLANE_ERROR      TL_FLOAT_GAMMA(16.2)
#define TL_RAY_SMALLEST_INCLINE 8.6736174e-19f // 2^-60

// Directions whose largest component is within these bounds are used as they are; others are scaled by a power of two.
#define TL_RAY_DIRECTION_MIN 9.765625e-4f // 2^-10
#define TL_RAY_DIRECTION_MAX 1024.0f

// Beyond this distance the products of the filters could overflow; every box and leaf then passes.
#define TL_RAY_FILTER_MAX 1e15f

// What the filters need, in registers. Lanes of the first three are axes, those of the next two axis_x, axis_y, axis_z.
typedef struct tl_ray_vectors {
    tl_f32x4 plane_scale, near_base, far_base;
    tl_f32x4 origin;
    tl_f32x4 shear; // the third is 1
    float per_depth, reach, corner_error;
    uint32_t backward;
    const uint32_t *axes;
} tl_ray_vectors;

// Axes x, y, z of the shear by the axes along which a direction is largest; z is the lowest of them.
static inline const uint32_t *tl_ray_axes(uint32_t largest_mask)
{
    static const uint32_t axes[8][4] = { { 1, 2, 0, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 1, 2, 0, 3 },
                                         { 0, 1, 2, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 1, 2, 0, 3 } };
    return axes[largest_mask];
}

// Slabs, shear and error of a direction whose largest component is `largest` in all lanes, within the bounds above.
static inline void tl_ray_find_vectors(const tl_soup *soup, tl_f32x4 origin, tl_f32x4 direction, tl_f32x4 largest,
                                       tl_ray_vectors *v)
{
    tl_f32x4 size = tl_f32x4_abs(direction);
    tl_f32x4 smallest = tl_f32x4_mul(largest, tl_f32x4_all(TL_RAY_SMALLEST_INCLINE));
    tl_f32x4 inclined = tl_f32x4_if_less(size, smallest, smallest, direction);
    tl_f32x4 inverse = tl_f32x4_div(tl_f32x4_all(1.0f), inclined);

    tl_f32x4 below = tl_f32x4_abs(tl_f32x4_sub(origin, tl_f32x4_load(&soup->bounds_min.x)));
    tl_f32x4 above = tl_f32x4_abs(tl_f32x4_sub(origin, tl_f32x4_load(&soup->bounds_max.x)));
    tl_f32x4 reach = tl_f32x4_max_of_three(tl_f32x4_max(below, above));
    tl_f32x4 plane_error = tl_f32x4_mul(tl_f32x4_add(tl_f32x4_abs(origin), reach), tl_f32x4_all(TL_RAY_PLANE_ERROR));
    tl_f32x4 pad = tl_f32x4_mul(tl_f32x4_add(plane_error, tl_f32x4_all(FLT_MIN)), tl_f32x4_abs(inverse));
    tl_f32x4 base = tl_f32x4_mul(origin, inverse);
    v->plane_scale = inverse;
    v->near_base = tl_f32x4_sub(tl_f32x4_sub(tl_f32x4_all(0.0f), base), pad);
    v->far_base = tl_f32x4_sub(pad, base);
    v->backward = tl_f32x4_signs(inclined);

    v->axes = tl_ray_axes(tl_f32x4_less_equal(largest, size) & 7u);
    v->per_depth = tl_f32x4_get_z(tl_f32x4_permute(inverse, v->axes));
    v->origin = tl_f32x4_permute(origin, v->axes);
    v->shear = tl_f32x4_mul(tl_f32x4_permute(direction, v->axes), tl_f32x4_all(v->per_depth));
    v->reach = tl_f32x4_get_x(reach);
    v->corner_error = v->reach * TL_RAY_CORNER_ERROR + FLT_MIN;
}

static inline void tl_ray_set_axes(tl_ray_job *job, const uint32_t *axes)
{
    job->axis_x = axes[0];
    job->axis_y = axes[1];
    job->axis_z = axes[2];
}

static inline void tl_ray_store_vectors(tl_ray_job *job, const tl_ray_vectors *v)
{
    tl_f32x4_store(job->plane_scale, v->plane_scale);
    tl_f32x4_store(job->near_base, v->near_base);
    tl_f32x4_store(job->far_base, v->far_base);
    job->backward = v->backward;
    tl_ray_set_axes(job, v->axes);
    job->shear_x = tl_f32x4_get_x(v->shear);
    job->shear_y = tl_f32x4_get_y(v->shear);
    job->per_depth = v->per_depth;
    job->reach = v->reach;
    job->corner_error = v->corner_error;
}

static inline void tl_ray_load_vectors(const tl_ray_job *job, tl_ray_vectors *v)
{
    v->plane_scale = tl_f32x4_load(job->plane_scale);
    v->near_base = tl_f32x4_load(job->near_base);
    v->far_base = tl_f32x4_load(job->far_base);
    v->backward = job->backward;
    v->axes = tl_ray_axes(1u << job->axis_z);
    v->origin = tl_f32x4_permute(tl_f32x4_load(job->origin.lane), v->axes);
    v->shear = tl_f32x4_make(job->shear_x, job->shear_y, 1.0f, 0.0f);
    v->per_depth = job->per_depth;
    v->reach = job->reach;
    v->corner_error = job->corner_error;
}

static inline void tl_ray_begin(tl_ray_job *job, float box_scale, float box_limit)
{
    job->is_exact = false;
    job->triangle = UINT32_MAX;
    job->box_scale = box_scale;
    job->box_limit = box_limit;
}

/// tl_ray_prepare, with what the filters need in registers instead of the job.
static inline bool tl_ray_prepare_vectors(tl_ray_job *job, const tl_vec3 *origin_point, const tl_vec3 *target_point,
                                          tl_ray_vectors *v)
{
    tl_f32x4 origin = tl_f32x4_load_three(&origin_point->x);
    tl_f32x4 target = tl_f32x4_load_three(&target_point->x);
    tl_f32x4 direction = job->is_segment ? tl_f32x4_sub(target, origin) : target;
    tl_f32x4_store(job->origin.lane, origin);
    tl_f32x4_store(job->target.lane, target);
    tl_f32x4 size = tl_f32x4_abs(direction);
    tl_f32x4 largest = tl_f32x4_max_of_three(size);
    // A NaN or infinity anywhere fails the first compare.
    tl_f32x4 magnitude = tl_f32x4_add(tl_f32x4_abs(origin), size);
    bool usual = (tl_f32x4_less_equal(magnitude, tl_f32x4_all(TL_RAY_FILTER_MAX)) &
                  tl_f32x4_less_equal(tl_f32x4_all(TL_RAY_DIRECTION_MIN), largest) &
                  tl_f32x4_less_equal(largest, tl_f32x4_all(TL_RAY_DIRECTION_MAX))) == 15u;
    if (!usual) {
        bool possible = tl_ray_prepare_unusual(job);
        tl_ray_load_vectors(job, v);
        return possible;
    }
    tl_ray_begin(job, 1.0f, job->t + FLT_MIN);
    tl_ray_find_vectors(job->soup, origin, direction, largest, v);
    tl_ray_set_axes(job, v->axes);
    job->reach = v->reach;
    return job->t >= 0.0f;
}

#endif
