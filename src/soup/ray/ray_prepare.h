// SPDX-License-Identifier: MIT
//
// What is computed once a ray for the float filters: slab constants that include their rounding errors, and the shear
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
// 16 u (|O| + M) |inv|; it rounds, and so does O inv with the pad, which takes 2 u (|O| + M) of it. The rest,
// 6 u |O| + 10 u M, covers the rounding of the reported t (u t) with which boxes are compared, and the error before it.
//
// A direction component that is tiny or zero is replaced by 2^-70, which keeps all numbers finite. The largest
// component is 2^-20 at least, so over the whole length of the soup's box that moves the ray by at most 2^-49 M. It is
// 2^20 at most, so the pad of a box is FLT_MIN 2^-20 = 2^-146 at least, and three products that underflow err by 2^-150
// each. Other directions are scaled by a power of two to these bounds, which is exact; a box t is then as much larger
// as the direction is smaller, and t itself is computed from the ray as it was given.
//
// Source of the shear: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013. That paper decides in
// float and repairs zeros; here float only rejects. The slab test is Kay's and Kajiya's, Ray Tracing Complex Scenes,
// 1986.

#ifndef TALUS_SRC_SOUP_RAY_PREPARE_H
#define TALUS_SRC_SOUP_RAY_PREPARE_H

#include "math/simd.h"
#include "math/tolerance.h"
#include "soup/ray/ray_job.h"

#include <float.h>

#define TL_RAY_CORNER_ERROR     TL_FLOAT_GAMMA(8.1)
#define TL_RAY_PLANE_ERROR      TL_FLOAT_GAMMA(16.2)
#define TL_RAY_SMALLEST_INCLINE 8.4703295e-22f // 2^-70

// Directions whose largest component is within these bounds are used as they are; others are scaled by a power of two.
#define TL_RAY_DIRECTION_MIN 9.5367431640625e-7f // 2^-20
#define TL_RAY_DIRECTION_MAX 1048576.0f          // 2^20

// Within this reach R a lane's sum of weights times depths, 24 R^3, does not overflow times |per_depth| <= 2^20.
#define TL_RAY_INTERVALS_MAX 0x1p33f

// From farther away than this times the soup's size a ray's walk begins close to it (ray_approach.c): a slab's pad
// would be a ten-thousandth of that size.
#define TL_RAY_FAR 64.0f

// Beyond this distance the products of the filters could overflow; every box and leaf then passes.
#define TL_RAY_FILTER_MAX 1e15f

// Axes x, y, z of the shear by the axes along which a direction is largest; z is the lowest of them. The axes follow
// each other as x, y, z do.
static inline const uint32_t *tl_ray_axes(uint32_t largest_mask)
{
    static const uint32_t axes[8][4] = { { 1, 2, 0, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 1, 2, 0, 3 },
                                         { 0, 1, 2, 3 }, { 1, 2, 0, 3 }, { 2, 0, 1, 3 }, { 1, 2, 0, 3 } };
    return axes[largest_mask];
}

// Slabs, shear and error of a direction whose largest component is within the bounds above; `size` are its absolute
// values and `largest` their largest in all lanes. The division comes first, since the ray waits for it.
static TL_ALWAYS_INLINE tl_f32x4 tl_ray_prepare_filters(tl_ray_job *job, tl_f32x4 origin, tl_f32x4 direction,
                                                        tl_f32x4 size, tl_f32x4 largest)
{
    tl_f32x4 smallest = tl_f32x4_all(TL_RAY_SMALLEST_INCLINE);
    tl_f32x4 inclined = tl_f32x4_if_less(size, smallest, smallest, direction);
    tl_f32x4 inverse = tl_f32x4_div(tl_f32x4_all(1.0f), inclined);

    tl_f32x4 above_min = tl_f32x4_sub(origin, tl_f32x4_load(&job->soup->bounds_min.x));
    tl_f32x4 below_max = tl_f32x4_sub(tl_f32x4_load(&job->soup->bounds_max.x), origin);
    job->outside = tl_f32x4_signs(tl_f32x4_or(above_min, below_max)) & 7u;
    tl_f32x4 reach = tl_f32x4_max_of_three(tl_f32x4_max(tl_f32x4_abs(above_min), tl_f32x4_abs(below_max)));
    tl_f32x4 range = tl_f32x4_add(tl_f32x4_abs(origin), reach);
    tl_f32x4 plane_error = tl_f32x4_mul_add(range, tl_f32x4_all(TL_RAY_PLANE_ERROR), tl_f32x4_all(FLT_MIN));
    tl_f32x4 pad = tl_f32x4_mul(plane_error, tl_f32x4_abs(inverse));
    tl_f32x4_store(job->plane_scale, inverse);
    tl_f32x4_store(job->near_base, tl_f32x4_mul_sub_from(origin, inverse, tl_f32x4_neg(pad)));
    tl_f32x4_store(job->far_base, tl_f32x4_mul_sub_from(origin, inverse, pad));
    job->backward = tl_f32x4_signs(inclined) & 7u;

    const uint32_t *axes = tl_ray_axes(tl_f32x4_less_equal(largest, size) & 7u);
    job->axes = axes;
    tl_f32x4 per_depth = tl_f32x4_permute(inverse, axes);
    job->per_depth = tl_f32x4_get_z(per_depth);
    tl_f32x4_store(job->leaf_origin, tl_f32x4_permute(origin, axes));
    tl_f32x4_store(job->shear, tl_f32x4_mul(tl_f32x4_permute(direction, axes), tl_f32x4_all(job->per_depth)));
    job->reach = tl_f32x4_get_x(reach);
    job->corner_error = job->reach * TL_RAY_CORNER_ERROR + FLT_MIN;
    return range;
}

/// The power of two that brings `largest` to [1, 2), or to [512, 1024) when it is large: its inverse is then a float.
double tl_ray_power_scale(double largest);

/// Whether a ray that begins outside the soup's box may meet it, by the test of a node's boxes.
static TL_ALWAYS_INLINE bool tl_ray_meets_bounds(tl_ray_job *job)
{
    tl_f32x4 low = tl_f32x4_load(&job->soup->bounds_min.x), high = tl_f32x4_load(&job->soup->bounds_max.x);
    tl_f32x4 scale = tl_f32x4_load(job->plane_scale);
    tl_f32x4 enter = tl_f32x4_mul_add(tl_f32x4_choose(scale, low, high), scale, tl_f32x4_load(job->near_base));
    tl_f32x4 leave = tl_f32x4_mul_add(tl_f32x4_choose(scale, high, low), scale, tl_f32x4_load(job->far_base));
    float first = tl_f32x4_get_x(tl_f32x4_max_of_three(enter)), last = tl_f32x4_least_of_three(leave);
    if ((first > last) | (last < 0.0f) | (first > job->box_limit)) {
        return false;
    }
    float size = tl_f32x4_get_x(tl_f32x4_max_of_three(tl_f32x4_sub(high, low)));
    return !(job->reach > TL_RAY_FAR * size) || tl_ray_approach(job);
}

/// tl_ray_prepare.
static TL_ALWAYS_INLINE bool tl_ray_prepare_inline(tl_ray_job *job, const tl_vec3 *origin_point,
                                                   const tl_vec3 *target_point)
{
    tl_f32x4 origin = tl_f32x4_load_three(&origin_point->x);
    tl_f32x4 target = tl_f32x4_load_three(&target_point->x);
    tl_f32x4 direction = job->is_segment ? tl_f32x4_sub(target, origin) : target;
    tl_f32x4_store(job->origin.lane, origin);
    tl_f32x4_store(job->target.lane, target);
    tl_f32x4 size = tl_f32x4_abs(direction);
    tl_f32x4 largest = tl_f32x4_max_of_three(size);
    tl_f32x4 range = tl_ray_prepare_filters(job, origin, direction, size, largest);
    // A NaN or infinity anywhere fails.
    bool usual = (tl_f32x4_ascending(tl_f32x4_all(TL_RAY_DIRECTION_MIN), largest, tl_f32x4_all(TL_RAY_DIRECTION_MAX)) &
                  tl_f32x4_less_equal(tl_f32x4_add(range, size), tl_f32x4_all(TL_RAY_INTERVALS_MAX))) == 15u;
    if (!usual) {
        return tl_ray_prepare_unusual(job);
    }
    static const tl_ray_box_t unscaled = { 0.0, 1.0f, FLT_MIN };
    job->box_t = unscaled;
    job->has_intervals = true;
    job->is_exact = false;
    job->triangle = UINT32_MAX;
    job->box_limit = job->t + FLT_MIN;
    return job->t >= 0.0f;
}

#endif
