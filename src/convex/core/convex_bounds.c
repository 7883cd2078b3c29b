// SPDX-License-Identifier: MIT
//
// The box of a shape: six support points, moved out by what rounding may have kept from them.

#include "base/assert.h"
#include "convex/core/minkowski.h"
#include "math/tolerance.h"

#include <float.h>

// A rotated point and a shift.
#define BOUNDS_POINT_ERROR TL_DOUBLE_GAMMA(24)

static double axis_component(tl_vec3d v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// The farthest coordinate along an axis, or against it; from beyond.
static float farthest_coordinate(tl_minkowski *pair, int axis, double sign)
{
    tl_vec3d direction = tl_vec3d_make(axis == 0 ? -sign : 0.0, axis == 1 ? -sign : 0.0, axis == 2 ? -sign : 0.0);
    tl_minkowski_point support;
    tl_minkowski_support(pair, direction, &support);
    tl_vec3d point = tl_vec3d_neg(support.w); // A is the origin
    double size = tl_vec3d_size(point) + (double)pair->b->radius;
    double at = axis_component(point, axis) +
                sign * ((double)pair->b->radius + pair->direction_error + BOUNDS_POINT_ERROR * size);
    return (float)(at + sign * (fabs(at) * TL_FLOAT_OUTWARD + (double)FLT_MIN));
}

tl_aabb tl_convex_bounds(const tl_convex *shape, tl_transform pose)
{
    TL_ASSERT(shape != NULL);
    // The origin as shape A: then B's support points are in the world.
    const tl_transform at_origin = tl_transform_identity();
    tl_convex origin = tl_convex_sphere(tl_vec3_make(0.0f, 0.0f, 0.0f), 0.0f);
    tl_minkowski pair;
    if (!tl_minkowski_init(&pair, &origin, &at_origin, shape, &pose)) {
        return tl_aabb_empty();
    }
    tl_aabb box;
    box.min = tl_vec3_make(farthest_coordinate(&pair, 0, -1.0), farthest_coordinate(&pair, 1, -1.0),
                           farthest_coordinate(&pair, 2, -1.0));
    box.max = tl_vec3_make(farthest_coordinate(&pair, 0, 1.0), farthest_coordinate(&pair, 1, 1.0),
                           farthest_coordinate(&pair, 2, 1.0));
    return box;
}
