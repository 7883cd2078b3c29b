// SPDX-License-Identifier: MIT
//
// Chooses the formula for a shape. Characters and triggers are spheres, capsules and boxes, and a formula is several
// times as fast as GJK on a triangle; rounded boxes, cylinders and hulls are rare enough to take GJK.

#include "soup/query/query_shape.h"

#include "math/predicates.h"
#include "soup/triangle/box_triangle.h"
#include "soup/triangle/segment_triangle.h"
#include "soup/triangle/triangle_point.h"

#include <string.h>

static bool has_finite_corners(const tl_convex *convex)
{
    uint32_t count = convex->kind == TL_CONVEX_INLINE ? convex->point_count : 2;
    bool corners =
        convex->kind != TL_CONVEX_HULL && convex->kind != TL_CONVEX_POINTS && convex->kind != TL_CONVEX_CUSTOM;
    for (uint32_t i = 0; corners && i < count; i++) {
        if (!tl_is_finite(convex->corners[i])) {
            return false;
        }
    }
    return true;
}

tl_result tl_query_shape_make(const tl_convex *convex, tl_transform pose, tl_query_shape *shape_out)
{
    if (!tl_pose_is_finite(pose) || !has_finite_corners(convex)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!(convex->radius >= 0.0f)) {
        return TL_ERR_ARGUMENT;
    }
    memset(shape_out, 0, sizeof *shape_out);
    shape_out->kind = TL_QUERY_CONVEX;
    shape_out->convex = convex;
    shape_out->pose = pose;
    shape_out->radius = (double)convex->radius;
    shape_out->bounds = tl_convex_bounds(convex, pose);
    if (!tl_is_finite(shape_out->bounds.min) || !tl_is_finite(shape_out->bounds.max)) {
        return TL_ERR_NOT_FINITE;
    }
    shape_out->middle = tl_aabb_center(shape_out->bounds);
    tl_frame frame = tl_frame_from(pose);
    if (convex->kind == TL_CONVEX_INLINE && convex->point_count <= 2) {
        shape_out->kind = convex->point_count == 1 ? TL_QUERY_SPHERE : TL_QUERY_CAPSULE;
        shape_out->ends[0] = tl_frame_point(&frame, tl_vec3d_from(convex->corners[0]));
        shape_out->ends[1] = tl_frame_point(&frame, tl_vec3d_from(convex->corners[convex->point_count - 1]));
    } else if (convex->kind == TL_CONVEX_BOX && convex->radius == 0.0f) {
        shape_out->kind = TL_QUERY_BOX;
        shape_out->box_frame = frame;
        shape_out->box_frame.origin = tl_frame_point(&frame, tl_vec3d_from(convex->corners[0]));
        shape_out->box_half[0] = (double)convex->corners[1].x;
        shape_out->box_half[1] = (double)convex->corners[1].y;
        shape_out->box_half[2] = (double)convex->corners[1].z;
    }
    return TL_OK;
}

bool tl_query_shape_touches(const tl_query_shape *shape, const tl_vec3 corners[3])
{
    if (shape->kind == TL_QUERY_SPHERE) {
        tl_triangle_point nearest;
        tl_triangle_nearest(corners, shape->ends[0], &nearest);
        return nearest.distance_sq <= shape->radius * shape->radius;
    }
    if (shape->kind == TL_QUERY_CAPSULE) {
        tl_segment_triangle nearest;
        tl_segment_triangle_nearest(shape->ends, corners, &nearest);
        return nearest.distance_sq <= shape->radius * shape->radius;
    }
    if (shape->kind == TL_QUERY_BOX) {
        tl_vec3d local[3];
        for (int k = 0; k < 3; k++) {
            local[k] = tl_frame_rotate_back(&shape->box_frame,
                                            tl_vec3d_sub(tl_vec3d_from(corners[k]), shape->box_frame.origin));
        }
        return tl_box_touches_triangle(shape->box_half, local);
    }
    tl_convex triangle = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f);
    return tl_convex_overlap(&triangle, tl_transform_identity(), shape->convex, shape->pose, NULL);
}

tl_seen tl_query_shape_sees(const tl_query_shape *shape, const tl_vec3 corners[3])
{
    int side = tl_orient3d(corners[0], corners[1], corners[2], shape->middle);
    return side > 0 ? TL_SEEN_FRONT : side < 0 ? TL_SEEN_BACK : TL_SEEN_BOTH;
}
