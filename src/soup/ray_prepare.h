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
// product one, the difference one: |error| <= 4 u (|p| + |O|) |inv|. The pad is 8 u (|P| + |O| + M) |inv|, P the
// farther of the soup's sides along the axis; it rounds, and so does O inv with the pad, which takes 2 u of it. 2 u
// (|P| + |O|) |inv| and 8 u M |inv| are left for the rounding of the reported t (u t) with which boxes are compared,
// and the error before it, which grows with the t of a triangle's farthest corner.
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
#define TL_RAY_SMALLEST_INCLINE 8.6736174e-19f // 2^-60

// Directions whose largest component is within these bounds are used as they are; others are scaled by a power of two.
#define TL_RAY_DIRECTION_MIN 9.765625e-4f // 2^-10
#define TL_RAY_DIRECTION_MAX 1024.0f

// Beyond this distance the products of the filters could overflow; every box and leaf then passes.
#define TL_RAY_FILTER_MAX 1e15f

static inline tl_f32x4 tl_f32x4_of(tl_vec3 v)
{
    return tl_f32x4_make(v.x, v.y, v.z, 0.0f);
}

// Slabs, shear and error of a direction whose largest component is `largest` in all lanes, within the bounds above.
// False when the origin is too far away.
static inline bool tl_ray_prepare_filters(tl_ray_job *job, tl_f32x4 origin, tl_f32x4 direction, tl_f32x4 largest)
{
    // Axis z by the lanes that are largest: the lowest of them.
    static const uint8_t lowest[8] = { 0, 0, 1, 0, 2, 0, 1, 0 };
    static const uint8_t next[5] = { 0, 1, 2, 0, 1 };
    tl_f32x4 size = tl_f32x4_abs(direction);
    uint32_t z = lowest[tl_f32x4_less_equal(largest, size) & 7u];
    job->axis_z = z;
    job->axis_x = next[z + 1];
    job->axis_y = next[z + 2];

    tl_f32x4 low = tl_f32x4_load(&job->soup->bounds_min.x), high = tl_f32x4_load(&job->soup->bounds_max.x);
    tl_f32x4 below = tl_f32x4_abs(tl_f32x4_sub(origin, low));
    tl_f32x4 above = tl_f32x4_abs(tl_f32x4_sub(origin, high));
    tl_f32x4 reach = tl_f32x4_max_of_three(tl_f32x4_max(below, above));
    tl_f32x4 error = tl_f32x4_add(tl_f32x4_mul(reach, tl_f32x4_all(TL_RAY_CORNER_ERROR)), tl_f32x4_all(FLT_MIN));

    tl_f32x4 smallest = tl_f32x4_mul(largest, tl_f32x4_all(TL_RAY_SMALLEST_INCLINE));
    tl_f32x4 inclined = tl_f32x4_if_less(size, smallest, smallest, direction);
    tl_f32x4 inverse = tl_f32x4_div(tl_f32x4_all(1.0f), inclined);
    tl_f32x4 base = tl_f32x4_mul(origin, inverse);
    tl_f32x4 far_side = tl_f32x4_max(tl_f32x4_abs(low), tl_f32x4_abs(high));
    tl_f32x4 size_sum = tl_f32x4_add(far_side, tl_f32x4_abs(origin));
    tl_f32x4 plane_error = tl_f32x4_add(tl_f32x4_mul(size_sum, tl_f32x4_all(TL_RAY_CORNER_ERROR)), error);
    tl_f32x4 pad = tl_f32x4_mul(plane_error, tl_f32x4_abs(inverse));
    tl_f32x4_store(job->plane_scale, inverse);
    tl_f32x4_store(job->near_base, tl_f32x4_sub(tl_f32x4_sub(tl_f32x4_all(0.0f), base), pad));
    tl_f32x4_store(job->far_base, tl_f32x4_sub(pad, base));
    job->backward = tl_f32x4_signs(inclined);

    float d[4], i[4], e[4], r[4];
    tl_f32x4_store(d, direction);
    tl_f32x4_store(i, inverse);
    tl_f32x4_store(e, error);
    tl_f32x4_store(r, reach);
    job->shear_x = d[job->axis_x] * i[z];
    job->shear_y = d[job->axis_y] * i[z];
    job->per_depth = i[z];
    job->reach = r[0];
    job->corner_error = e[0];
    return r[0] < TL_RAY_FILTER_MAX;
}

/// tl_ray_prepare.
static inline bool tl_ray_prepare_inline(tl_ray_job *job, tl_vec3 origin_point, tl_vec3 target_point)
{
    tl_f32x4 origin = tl_f32x4_of(origin_point);
    tl_f32x4 target = tl_f32x4_of(target_point);
    tl_f32x4 direction = job->is_segment ? tl_f32x4_sub(target, origin) : target;
    tl_f32x4_store(job->origin.lane, origin);
    tl_f32x4_store(job->target.lane, target);
    tl_f32x4 largest = tl_f32x4_max_of_three(tl_f32x4_abs(direction));
    tl_f32x4 magnitude = tl_f32x4_add(tl_f32x4_abs(origin), tl_f32x4_abs(direction));
    // A NaN or infinity anywhere fails the first compare.
    bool usual = (tl_f32x4_less_equal(magnitude, tl_f32x4_all(TL_RAY_FILTER_MAX)) &
                  tl_f32x4_less_equal(tl_f32x4_all(TL_RAY_DIRECTION_MIN), largest) &
                  tl_f32x4_less_equal(largest, tl_f32x4_all(TL_RAY_DIRECTION_MAX))) == 15u;
    if (!usual) {
        return tl_ray_prepare_unusual(job);
    }
    job->is_exact = false;
    job->triangle = UINT32_MAX;
    job->is_waiting = false;
    job->box_scale = 1.0f;
    job->box_limit = job->t + FLT_MIN;
    (void)tl_ray_prepare_filters(job, origin, direction, largest);
    return job->t >= 0.0f;
}

#endif
