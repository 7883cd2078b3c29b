// SPDX-License-Identifier: MIT
//
// What is computed once a ray: slab constants with their rounding already added, and the shear that turns the ray into
// an axis.
//
// Below, u is TL_FLOAT_ROUNDING, M the largest distance along an axis from the ray's origin to a corner of the soup's
// box, and one corner_error is 8 u M (with a margin for its own rounding). All bounds are absolute distances:
//
// Sheared corners. x' = X - S Z with X = P.x - O.x and S = D.x / D.z, |S| <= 1. X and Z round once each, S three times
// (a segment's direction is rounded first), S Z and the difference once: |error| <= u (|X| + 5 |S Z| + |x'|)
// <= u (2 |X| + 6 |Z|) <= 8 u M.
//
// Slab planes. t = q (cell inv) + (G - O) inv. inv has two roundings, cell inv a third, its product with q a fourth
// (none when fused); G - O has one, its product with inv is the fourth; the sum and the pad round once each. With
// q cell <= 2 M the error is at most (4 * 2 + 4 + 2) u M |inv| = 14 u M |inv|. The pad is 24 u M |inv|. What is left,
// 10 u M, covers the rounding of the reported t (u M) with which boxes are compared, and the error before it.
//
// A direction component that is tiny or zero is replaced by 2^-60 of the largest, which keeps all numbers finite: over
// the whole way through the soup's box that moves the ray by at most 2^-59 M.
//
// Source of the shear: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013. Where that paper decides
// in float and mends zeros, here float only rejects.

#include "soup/ray.h"

#include "math/tolerance.h"

#include <float.h>

#define CORNER_ERROR     TL_FLOAT_GAMMA(8.1)
#define PLANE_PAD        3.0f           // in corner errors
#define SMALLEST_INCLINE 8.6736174e-19f // 2^-60

// Directions whose largest component is within these bounds are used as they are; others are scaled by a power of two.
#define DIRECTION_MIN 9.765625e-4f // 2^-10
#define DIRECTION_MAX 1024.0f

// Beyond this distance the products of the filters could overflow; every box and leaf then passes.
#define FILTER_MAX 1e15f

static double largest_of(const double v[3])
{
    double x = fabs(v[0]), y = fabs(v[1]), z = fabs(v[2]);
    double xy = x > y ? x : y;
    return xy > z ? xy : z;
}

// A power of two that brings `largest` to [1, 2).
static double power_scale(double largest)
{
    int exponent;
    (void)frexp(largest, &exponent);
    return ldexp(1.0, 1 - exponent);
}

static float reach_of(tl_vec3 origin, tl_aabb bounds)
{
    tl_vec3 below = tl_abs(tl_sub(origin, bounds.min));
    tl_vec3 above = tl_abs(tl_sub(origin, bounds.max));
    tl_vec3 reach = tl_max(below, above);
    return tl_maxf(tl_maxf(reach.x, reach.y), reach.z);
}

static void prepare_boxes(tl_ray_job *job, const float direction[3], float largest)
{
    const float origin[3] = { job->origin.x, job->origin.y, job->origin.z };
    const float grid[3] = { job->soup->grid_origin.x, job->soup->grid_origin.y, job->soup->grid_origin.z };
    const float cell[3] = { job->soup->grid_cell.x, job->soup->grid_cell.y, job->soup->grid_cell.z };
    float smallest = largest * SMALLEST_INCLINE;
    for (uint32_t i = 0; i < 3; i++) {
        float d = fabsf(direction[i]) < smallest ? smallest : direction[i];
        float inverse = 1.0f / d;
        float base = (grid[i] - origin[i]) * inverse;
        float pad = job->corner_error * PLANE_PAD * fabsf(inverse);
        bool forward = d > 0.0f;
        job->plane_scale[i] = cell[i] * inverse;
        job->near_base[i] = base - pad;
        job->far_base[i] = base + pad;
        job->near_row[i] = (uint8_t)(2 * i + (forward ? 0 : 1));
        job->far_row[i] = (uint8_t)(2 * i + (forward ? 1 : 0));
    }
}

// The origin is so far away that float filters cannot work: everything is handed to the exact part.
static void pass_everything(tl_ray_job *job)
{
    for (uint32_t i = 0; i < 3; i++) {
        job->plane_scale[i] = 0.0f;
        job->near_base[i] = -1.0f;
        job->far_base[i] = FLT_MAX;
        job->near_row[i] = (uint8_t)(2 * i);
        job->far_row[i] = (uint8_t)(2 * i + 1);
    }
    job->corner_error = INFINITY;
}

bool tl_ray_prepare(tl_ray_job *job)
{
    if (!tl_is_finite(job->origin) || !tl_is_finite(job->target) || !(job->t >= 0.0f)) {
        return false;
    }
    const double origin[3] = { (double)job->origin.x, (double)job->origin.y, (double)job->origin.z };
    const double target[3] = { (double)job->target.x, (double)job->target.y, (double)job->target.z };
    for (int i = 0; i < 3; i++) {
        job->direction[i] = job->is_segment ? target[i] - origin[i] : target[i];
    }
    double largest = largest_of(job->direction);
    if (largest == 0.0) {
        return false;
    }
    double scale = largest >= (double)DIRECTION_MIN && largest <= (double)DIRECTION_MAX ? 1.0 : power_scale(largest);
    float direction[3];
    for (int i = 0; i < 3; i++) {
        direction[i] = (float)(job->direction[i] * scale);
    }
    job->box_scale = (float)(1.0 / scale);
    job->triangle = UINT32_MAX;
    job->box_limit = job->t * job->box_scale + FLT_MIN;

    double ax = fabs(job->direction[0]), ay = fabs(job->direction[1]), az = fabs(job->direction[2]);
    job->axis_z = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    job->axis_x = (job->axis_z + 1) % 3;
    job->axis_y = (job->axis_z + 2) % 3;
    job->shear[0] = job->direction[job->axis_x] / job->direction[job->axis_z];
    job->shear[1] = job->direction[job->axis_y] / job->direction[job->axis_z];
    job->shear_x = (float)job->shear[0];
    job->shear_y = (float)job->shear[1];

    float reach = reach_of(job->origin, job->soup->bounds);
    job->corner_error = reach * CORNER_ERROR + FLT_MIN;
    if (reach < FILTER_MAX) {
        prepare_boxes(job, direction, (float)(largest * scale));
    } else {
        pass_everything(job);
    }
    return true;
}
