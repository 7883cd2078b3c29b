// SPDX-License-Identifier: MIT
//
// Sweeping a sphere or capsule against one triangle, by conservative advancement.
//
// The distance of two convex sets is a convex function of their motion. So the line through its value at t, with the
// slope that the two nearest points give, lies below it, and where that line reaches the radius the capsule is not
// later than its true contact: Newton's iteration, which converges from the free side only. A face takes one step, an
// edge or a corner about four, a grazing motion many, up to TL_MAX_CAST_ITERATIONS. The closed form (a ray against the
// Minkowski sum of triangle and segment, rounded: five polygons, nine cylinders, six spheres) takes as long and has
// seams between its pieces.
//
// It starts where the capsule reaches the triangle's plane, for the same reason. A grazing shape may touch and
// penetrate no deeper (graze.c): then it passes.
//
// Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996 (conservative advancement).

#include "soup/query/triangle_cast.h"
#include "soup/triangle/triangle_point.h"

#include <string.h>

// A gap of this share of what counts as touching is closed.
#define CLOSED_SHARE 0.125

// The earliest time, >= 0, at which the capsule can be at the plane; INFINITY: never.
static double reach_plane(const tl_query_shape *shape, tl_vec3d step, double touch, const tl_vec3 corners[3])
{
    tl_vec3d a = tl_vec3d_from(corners[0]);
    tl_vec3d normal =
        tl_vec3d_cross(tl_vec3d_sub(tl_vec3d_from(corners[1]), a), tl_vec3d_sub(tl_vec3d_from(corners[2]), a));
    double length = tl_vec3d_length(normal);
    double first = tl_vec3d_dot(normal, tl_vec3d_sub(shape->ends[0], a));
    double second = tl_vec3d_dot(normal, tl_vec3d_sub(shape->ends[1], a));
    double low = first < second ? first : second, high = first < second ? second : first;
    double speed = tl_vec3d_dot(normal, step);
    double gap = low > 0.0 ? low : high < 0.0 ? -high : 0.0;
    double closing = low > 0.0 ? -speed : speed;
    gap -= (shape->radius + touch) * length;
    if (!(gap > 0.0)) {
        return 0.0; // at the plane, or a needle that has none
    }
    return closing > 0.0 ? gap / closing : (double)INFINITY;
}

bool tl_triangle_cast_capsule(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3],
                              double t_limit, tl_triangle_cast *cast_out)
{
    tl_vec3d step = tl_vec3d_from(motion->step);
    double touch = motion->touch;
    double t = reach_plane(shape, step, touch, corners);
    if (t > t_limit) {
        return false;
    }
    tl_approach a;
    tl_approach_at(shape, step, t, corners, &a);
    memset(cast_out, 0, sizeof *cast_out);
    if (t == 0.0 && a.gap < -touch) {
        tl_triangle_cast_overlap(shape, corners, cast_out);
        return true;
    }
    for (uint32_t i = 0;; i++) {
        double closing = -tl_vec3d_dot(a.normal, step);
        if (a.gap - closing * (1.0 - t) >= -touch) {
            return false; // it penetrates no deeper along this plane
        }
        if (a.gap <= CLOSED_SHARE * touch || i == TL_MAX_CAST_ITERATIONS) {
            cast_out->status = i == TL_MAX_CAST_ITERATIONS ? TL_CONVEX_ITERATIONS : TL_CONVEX_CONVERGED;
            break;
        }
        t += a.gap / closing;
        if (t > t_limit) {
            return false;
        }
        tl_approach_at(shape, step, t, corners, &a);
    }
    if (!tl_graze_deepens(shape, motion, corners, t, a)) {
        return false;
    }
    cast_out->t = t;
    cast_out->point = tl_vec3d_to_float(a.point);
    cast_out->normal = tl_vec3d_to_float(a.normal);
    return true;
}
