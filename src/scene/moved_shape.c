// SPDX-License-Identifier: MIT
//
// Shapes in the spaces of instances: the box that is cast through the BVH, and poses.
//
// In an instance's space the shape's position is off as a ray's origin is, its motion as a direction, and its rotation
// by four roundings: each of its points by 4 u of its distance from the shape's own origin, at most
// 4 u (|middle| + |half| + |position|). A cast may stop early by another 16 u (|half|). So the box is widened by 32 u
// of all of these, and half extents are rounded with them.

#include "scene/moved_shape.h"

#include "base/min_max.h"
#include "math/tolerance.h"
#include "scene/instance_box.h"

#include <float.h>

tl_result tl_moved_shape_make(const tl_convex *convex, tl_transform pose, tl_vec3 motion, tl_moved_shape *shape_out)
{
    if (!tl_is_finite(motion) || !tl_pose_is_finite(pose)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!(convex->radius >= 0.0f)) {
        return TL_ERR_ARGUMENT;
    }
    tl_aabb bounds = tl_convex_bounds(convex, pose);
    if (!tl_is_finite(bounds.min) || !tl_is_finite(bounds.max)) {
        return TL_ERR_NOT_FINITE;
    }
    shape_out->convex = convex;
    shape_out->pose = pose;
    shape_out->bounds = bounds;
    tl_vec3d low = tl_vec3d_from(bounds.min), high = tl_vec3d_from(bounds.max), step = tl_vec3d_from(motion);
    shape_out->middle = tl_vec3d_to_float(tl_vec3d_scale(tl_vec3d_add(low, high), 0.5));
    tl_vec3d half = tl_vec3d_scale(tl_vec3d_sub(high, low), 0.5);
    double size = tl_scene_size(shape_out->middle) + tl_vec3d_size(half) + tl_scene_size(pose.position);
    double wider = (double)TL_SCENE_WIDEN * (size + tl_vec3d_size(step)) + (double)FLT_MIN;
    half = tl_vec3d_add(half, tl_vec3d_make(wider, wider, wider));
    shape_out->half = tl_vec3d_to_float(tl_vec3d_scale(half, 1.0 + (double)TL_FLOAT_OUTWARD));
    double x = tl_max_f64(fabs(low.x), fabs(high.x)) + fabs(step.x);
    double y = tl_max_f64(fabs(low.y), fabs(high.y)) + fabs(step.y);
    double z = tl_max_f64(fabs(low.z), fabs(high.z)) + fabs(step.z);
    shape_out->reach = tl_max_f64(x, tl_max_f64(y, z));
    return TL_OK;
}

tl_transform tl_scene_pose_to_instance(const tl_scene_record *record, tl_transform pose)
{
    tl_transform seen = { pose.rotation, tl_scene_point_to_instance(record, pose.position) };
    TL_ASSERT(!tl_scene_is_scaled(record));
    if (tl_scene_has_matrix(record)) {
        tl_quatd q = tl_quatd_between(tl_quatd_from(record->pose.rotation), tl_quatd_from(pose.rotation));
        double scale = 1.0 / sqrt(q.length_sq);
        tl_quat rotation = { (float)(q.x * scale), (float)(q.y * scale), (float)(q.z * scale), (float)(q.w * scale) };
        seen.rotation = rotation;
    }
    return seen;
}
