// SPDX-License-Identifier: MIT
//
// Sweeping any convex shape against one triangle: tl_convex_cast, and tl_convex_penetration for shapes that overlap at
// the start.

#include "soup/query/triangle_cast.h"

#include "soup/triangle/segment_triangle.h"
#include "soup/triangle/triangle_point.h"

#include <string.h>

// The plane's normal, towards the shape's middle: for an overlap so shallow that it has no direction of its own.
static tl_vec3 face_way_out(const tl_query_shape *shape, const tl_vec3 corners[3])
{
    tl_vec3 normal = tl_triangle_normal(corners);
    return tl_query_shape_sees(shape, corners) == TL_SEEN_BACK ? tl_neg(normal) : normal;
}

static bool measure_capsule(const tl_query_shape *shape, const tl_vec3 corners[3], tl_triangle_cast *cast_out)
{
    tl_segment_triangle nearest;
    tl_segment_triangle_nearest(shape->ends, corners, &nearest);
    double distance = sqrt(nearest.distance_sq);
    if (!(distance > 0.0)) {
        return false;
    }
    tl_vec3d away = tl_vec3d_sub(nearest.on_segment, nearest.on_triangle);
    cast_out->depth = shape->radius > distance ? shape->radius - distance : 0.0;
    cast_out->point = tl_vec3d_to_float(nearest.on_triangle);
    cast_out->normal = tl_vec3d_to_float(tl_vec3d_scale(away, 1.0 / distance));
    return true;
}

void tl_triangle_cast_overlap(const tl_query_shape *shape, const tl_vec3 corners[3], tl_triangle_cast *cast_out)
{
    memset(cast_out, 0, sizeof *cast_out);
    cast_out->overlap = true;
    if ((shape->kind == TL_QUERY_SPHERE || shape->kind == TL_QUERY_CAPSULE) &&
        measure_capsule(shape, corners, cast_out)) {
        return;
    }
    tl_convex triangle = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f);
    tl_penetration penetration;
    tl_convex_penetration(&triangle, tl_transform_identity(), shape->convex, shape->pose, NULL, &penetration);
    cast_out->status = penetration.status;
    cast_out->depth = (double)penetration.depth;
    cast_out->point = penetration.point_a;
    cast_out->normal = penetration.normal;
    if (tl_length_sq(penetration.normal) == 0.0f) {
        cast_out->normal = face_way_out(shape, corners);
    }
}

bool tl_triangle_cast_shape(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3],
                            double t_limit, tl_triangle_cast *cast_out)
{
    tl_convex triangle = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f);
    tl_convex_hit hit;
    if (!tl_convex_cast(&triangle, tl_transform_identity(), shape->convex, shape->pose, motion->step, &hit) ||
        (double)hit.t > t_limit) {
        return false;
    }
    memset(cast_out, 0, sizeof *cast_out);
    if (hit.initial_overlap) {
        tl_triangle_cast_overlap(shape, corners, cast_out);
        if (cast_out->depth > motion->touch) {
            return true;
        }
        cast_out->overlap = false;
        cast_out->depth = 0.0;
    } else {
        cast_out->t = (double)hit.t;
        cast_out->point = hit.point;
        cast_out->normal = hit.normal;
        cast_out->status = hit.status;
    }
    // Along this plane it would penetrate no deeper than what counts as touching.
    double closing = -tl_vec3d_dot(tl_vec3d_from(cast_out->normal), tl_vec3d_from(motion->step));
    if (!(closing * (1.0 - cast_out->t) > motion->touch)) {
        return false;
    }
    if (shape->radius <= TL_ROUND_RADIUS * motion->touch) {
        return true;
    }
    tl_approach at;
    tl_approach_at(shape, tl_vec3d_from(motion->step), cast_out->t, corners, &at);
    return tl_graze_deepens(shape, motion, corners, cast_out->t, at);
}
