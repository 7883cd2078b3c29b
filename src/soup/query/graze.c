// SPDX-License-Identifier: MIT
//
// Whether a rounded shape that just touches a triangle goes on to penetrate it.
//
// A capsule that slides on a floor touches the edge of each next triangle as it comes over it: the gap goes to zero and
// grows again, and a sweep that stopped at zero would catch on every inner edge. With c the closing speed, v the speed
// and d the distance of the cores, the gap after a time s is at least gap - c s (it is convex), and at most
// gap - c s + s^2 v^2 / 2 d: the distance to a convex set bends no more than the distance to a point. So most hits are
// known to be deep at once; for the rest Newton's iteration continues to the depth that counts.

#include "soup/query/triangle_cast.h"
#include "soup/triangle/segment_triangle.h"
#include "soup/triangle/triangle_point.h"

void tl_approach_at(const tl_query_shape *shape, tl_vec3d step, double t, const tl_vec3 corners[3],
                    tl_approach *approach_out)
{
    tl_vec3d ends[2] = { tl_vec3d_mul_add(shape->ends[0], step, t), tl_vec3d_mul_add(shape->ends[1], step, t) };
    tl_segment_triangle nearest;
    if (shape->kind == TL_QUERY_SPHERE) {
        tl_triangle_point point;
        tl_triangle_nearest(corners, ends[0], &point);
        nearest.distance_sq = point.distance_sq;
        nearest.on_segment = ends[0];
        nearest.on_triangle = point.point;
    } else if (shape->kind == TL_QUERY_CAPSULE) {
        tl_segment_triangle_nearest(ends, corners, &nearest);
    } else {
        tl_convex triangle = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f), core = *shape->convex;
        core.radius = 0.0f;
        tl_transform pose = shape->pose;
        pose.position = tl_vec3d_to_float(tl_vec3d_mul_add(tl_vec3d_from(pose.position), step, t));
        tl_separation separation;
        tl_convex_distance(&triangle, tl_transform_identity(), &core, pose, NULL, &separation);
        nearest.on_triangle = tl_vec3d_from(separation.point_a);
        nearest.on_segment = tl_vec3d_from(separation.point_b);
        nearest.distance_sq = (double)separation.distance * (double)separation.distance;
    }
    approach_out->distance = sqrt(nearest.distance_sq);
    approach_out->gap = approach_out->distance - shape->radius;
    approach_out->point = ends[0];
    approach_out->normal = tl_vec3d_make(0.0, 0.0, 0.0);
    if (approach_out->distance > 0.0) {
        approach_out->point = nearest.on_triangle;
        approach_out->normal =
            tl_vec3d_scale(tl_vec3d_sub(nearest.on_segment, nearest.on_triangle), 1.0 / approach_out->distance);
    }
}

bool tl_graze_deepens(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3], double t,
                      tl_approach at)
{
    tl_vec3d step = tl_vec3d_from(motion->step);
    double speed_sq = tl_vec3d_dot(step, step);
    for (uint32_t i = 0; i < TL_MAX_CAST_ITERATIONS; i++) {
        if (!(at.distance > 0.0)) {
            return true;
        }
        double closing = -tl_vec3d_dot(at.normal, step);
        double rest = 1.0 - t, deepest = closing * at.distance / speed_sq;
        if (at.gap - closing * rest >= -motion->touch) {
            return false;
        }
        double s = rest < deepest ? rest : deepest;
        if (at.gap - s * (closing - 0.5 * s * speed_sq / at.distance) < -motion->touch) {
            return true;
        }
        t += (at.gap + motion->touch) / closing;
        tl_approach_at(shape, step, t, corners, &at);
    }
    return true;
}
