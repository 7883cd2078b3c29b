// SPDX-License-Identifier: MIT
//
// The shape of a query, in the world and in an instance's space.

#ifndef TALUS_SRC_SCENE_MOVED_SHAPE_H
#define TALUS_SRC_SCENE_MOVED_SHAPE_H

#include "scene/scene_walk.h"

typedef struct tl_moved_shape {
    const tl_convex *convex;
    tl_transform pose;
    tl_aabb bounds; ///< world
    tl_vec3 middle;
    tl_vec3 half; ///< of a box around the middle, wider than the bounds by all errors (instance_box.c)
    double reach; ///< metres: no coordinate of the moving shape is larger
} tl_moved_shape;

/// TL_ERR_NOT_FINITE (pose, motion, or a shape that has no finite box), TL_ERR_ARGUMENT (a radius that is negative or
/// NaN).
tl_result tl_moved_shape_make(const tl_convex *convex, tl_transform pose, tl_vec3 motion, tl_moved_shape *shape_out);

/// The pose in an instance's space: position and rotation rounded once; unchanged where the instance is not rotated or
/// moved. Not of a scaled one.
tl_transform tl_scene_pose_to_instance(const tl_scene_record *record, tl_transform pose);

#endif
