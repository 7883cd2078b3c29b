// SPDX-License-Identifier: MIT
//
// Preparing unusual rays: directions of any length down to denormals and up to the largest float, and origins beyond
// the range of the float filters. Everything else, and the error analysis, is in ray_prepare.h.

#include "soup/ray/ray_prepare.h"

// A power of two that brings `largest` to [1, 2), or to [512, 1024) when it is large: its inverse is then a float.
static double power_scale(double largest)
{
    int exponent;
    (void)frexp(largest, &exponent);
    return ldexp(1.0, exponent > 1 ? 10 - exponent : 1 - exponent);
}

// The origin is too far away for float filters: everything passes to the exact part.
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
    job->backward = 0;
    job->outside = 0;
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
    double scale = power_scale(largest);
    job->box_scale = (float)(1.0 / scale);
    job->box_limit = job->t < FLT_MAX ? job->t * job->box_scale + FLT_MIN : INFINITY;
    tl_f32x4 scaled = tl_f32x4_make((float)(direction[0] * scale), (float)(direction[1] * scale),
                                    (float)(direction[2] * scale), 0.0f);
    tl_f32x4 size = tl_f32x4_abs(scaled);
    tl_ray_prepare_filters(job, tl_f32x4_load(job->origin.lane), scaled, size, tl_f32x4_max_of_three(size));
    if (!(job->reach < TL_RAY_FILTER_MAX)) {
        pass_everything(job);
    }
    return true;
}

bool tl_ray_prepare(tl_ray_job *job, tl_vec3 origin, tl_vec3 target)
{
    return tl_ray_prepare_inline(job, &origin, &target);
}
