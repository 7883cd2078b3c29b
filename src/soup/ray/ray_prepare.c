// SPDX-License-Identifier: MIT
//
// Preparing unusual rays: directions of any length down to denormals and up to the largest float, and origins beyond
// the range of the float filters. Everything else, and the error analysis, is in ray_prepare.h.

#include "soup/ray/ray_prepare.h"

#include "soup/ray/ray_measure.h"

#include <string.h>

// Of a longer ray a denormal t is too coarse for the intervals of ray_walk.inl.
#define BOX_SCALE_MAX 0x1p70f

// By the bits of doubles: no float is a denormal one.
double tl_ray_power_scale(double largest)
{
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    uint64_t exponent = bits >> 52, wanted = exponent > 1023 ? 1023 + 9 : 1023;
    bits = (1023 + wanted - exponent) << 52;
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return scale;
}

// The origin is too far away for float filters: everything passes to the exact part, unless the origin can be moved
// (ray_approach.c).
static void pass_everything(tl_ray_job *job)
{
    for (uint32_t i = 0; i < 3; i++) {
        job->plane_scale[i] = FLT_MIN; // not 0: the infinite planes of a lane without a child stay infinite
        job->near_base[i] = -1.0f;
        job->far_base[i] = FLT_MAX;
        // Sidedness must be a number, so that the error outweighs it.
        job->leaf_origin[i] = 0.0f;
        job->shear[i] = 0.0f;
    }
    job->has_intervals = false;
    job->backward = 0;
    job->outside = 7;
    job->corner_error = INFINITY;
}

bool tl_ray_prepare_unusual(tl_ray_job *job)
{
    tl_vec3 from = job->origin.point;
    tl_vec3 to = job->target.point;
    if (!tl_is_finite(from) || !tl_is_finite(to) || !(job->t >= 0.0f)) {
        return false;
    }
    const double origin[3] = { (double)from.x, (double)from.y, (double)from.z };
    const double target[3] = { (double)to.x, (double)to.y, (double)to.z };
    double direction[3], largest = 0.0;
    for (int i = 0; i < 3; i++) {
        direction[i] = job->is_segment ? target[i] - origin[i] : target[i];
        largest = fabs(direction[i]) > largest ? fabs(direction[i]) : largest;
    }
    if (largest == 0.0) {
        return false;
    }
    double scale = tl_ray_power_scale(largest);
    job->is_exact = false;
    job->triangle = UINT32_MAX;
    job->box_t.start = 0.0;
    job->box_t.scale = (float)(1.0 / scale);
    // Half the spacing of denormals is 2^-150. In two factors, so that no operand is one of them.
    job->box_t.margin = job->box_t.scale * 0x1p-75f * 0x1p-74f + FLT_MIN;
    job->box_limit = tl_ray_box_limit(job, job->t);
    tl_f32x4 scaled = tl_f32x4_make((float)(direction[0] * scale), (float)(direction[1] * scale),
                                    (float)(direction[2] * scale), 0.0f);
    tl_f32x4 size = tl_f32x4_abs(scaled);
    tl_ray_prepare_filters(job, tl_f32x4_load(job->origin.lane), scaled, size, tl_f32x4_max_of_three(size));
    job->has_intervals = job->reach < TL_RAY_INTERVALS_MAX && job->box_t.scale < BOX_SCALE_MAX &&
                         job->reach < TL_RAY_T_MAX * job->box_t.scale;
    if (!(job->reach < TL_RAY_FILTER_MAX)) {
        pass_everything(job);
    }
    return true;
}

bool tl_ray_prepare(tl_ray_job *job, tl_vec3 origin, tl_vec3 target)
{
    return tl_ray_prepare_inline(job, &origin, &target);
}
