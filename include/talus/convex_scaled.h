// SPDX-License-Identifier: MIT
//
// A convex shape at a scale, without a copy of its hull or points: what physics engines call a scaled shape.
//
//   tl_scaled_convex tall;
//   tl_scaled_convex_make(&crate, tl_vec3_make(1, 2, 1), &tall, NULL);
//   tl_convex_distance(&tall.shape, pose_a, &other, pose_b, NULL, &apart);
//
// Corners are multiplied by the scale, each coordinate rounded once, and all lengths of an answer are those of the
// scaled shape. Boxes, triangles, capsules, cylinders and cones stay what they are; hulls, points and custom shapes
// become custom ones, which have no features and no cache. For a hull that is asked often, bake a scaled copy:
// tl_hull_transform.

#ifndef TALUS_CONVEX_SCALED_H
#define TALUS_CONVEX_SCALED_H

#include <talus/convex.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The size of a factor is at most this, and at least its inverse.
#define TL_MAX_SCALE 1e6f

/// A shape at a scale. Not to be moved or copied: the shape may point here.
typedef struct tl_scaled_convex {
    tl_convex shape;     ///< what all queries take
    const tl_convex *of; ///< private
    tl_vec3 scale;       ///< private
} tl_scaled_convex;

/// Makes a shape at a scale: factors along the shape's own axes, mirrored where negative; all zero: 1. The shape, which
/// must outlive it, is borrowed.
///
/// What has a radius takes one size of factor for all axes, since no radius makes an ellipsoid; a cylinder or a cone
/// too, or one across and another along its axis, where that runs along x, y or z.
/// TL_ERR_ARGUMENT: NULL, or a rounded shape at other factors (field "scale"); TL_ERR_NOT_FINITE; TL_ERR_RANGE: a
/// factor that is 0, unless all are, or whose size is beyond TL_MAX_SCALE or below its inverse. `*scaled_out` is then
/// zeroed. `report_out` may be NULL.
TL_API tl_result tl_scaled_convex_make(const tl_convex *shape, tl_vec3 scale, tl_scaled_convex *scaled_out,
                                       tl_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
