// SPDX-License-Identifier: MIT
//
// A convex shape in the world, prepared for tests against many triangles.

#ifndef TALUS_SRC_SOUP_QUERY_SHAPE_H
#define TALUS_SRC_SOUP_QUERY_SHAPE_H

#include "math/vec3d.h"
#include "soup/ray/ray_filter.h"

#include <talus/convex.h>

/// Shapes with a formula of their own; GJK serves all others.
typedef enum tl_query_kind { TL_QUERY_SPHERE, TL_QUERY_CAPSULE, TL_QUERY_BOX, TL_QUERY_CONVEX } tl_query_kind;

typedef struct tl_query_shape {
    tl_query_kind kind;
    const tl_convex *convex;
    tl_transform pose;
    tl_aabb bounds;
    tl_vec3 middle;     ///< of the bounds: for culling, triangles are seen from here
    tl_vec3d ends[2];   ///< sphere: both the centre; capsule: of its segment, world
    double radius;      ///< sphere, capsule
    tl_frame box_frame; ///< box to world, its centre the origin
    double box_half[3]; ///< box
} tl_query_shape;

/// TL_ERR_NOT_FINITE (a pose, or a shape that has no finite box) or TL_ERR_ARGUMENT (a radius that is negative or NaN).
tl_result tl_query_shape_make(const tl_convex *convex, tl_transform pose, tl_query_shape *shape_out);

/// Whether the shape and a triangle share a point, as well as can be told in double.
bool tl_query_shape_touches(const tl_query_shape *shape, const tl_vec3 corners[3]);

/// The side of a triangle that the shape's middle sees, exactly.
tl_seen tl_query_shape_sees(const tl_query_shape *shape, const tl_vec3 corners[3]);

#endif
