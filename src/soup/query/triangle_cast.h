// SPDX-License-Identifier: MIT
//
// Sweeping a shape against one triangle.

#ifndef TALUS_SRC_SOUP_TRIANGLE_CAST_H
#define TALUS_SRC_SOUP_TRIANGLE_CAST_H

#include "soup/query/query_shape.h"

/// A shape counts as rounded when its radius exceeds this many times what counts as touching: its normals then follow
/// from its core.
#define TL_ROUND_RADIUS 16.0

typedef struct tl_motion {
    tl_vec3 step;
    double touch; ///< metres: shapes that never penetrate deeper than this pass
} tl_motion;

typedef struct tl_triangle_cast {
    double t;       ///< share of the motion
    bool overlap;   ///< at the start; then t is 0
    double depth;   ///< overlap: metres
    tl_vec3 point;  ///< on the triangle
    tl_vec3 normal; ///< unit, from the triangle to the shape
    tl_convex_status status;
} tl_triangle_cast;

/// False when the shape does not hit the triangle, or surely only after `t_limit` (>= 0).
bool tl_triangle_cast_shape(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3],
                            double t_limit, tl_triangle_cast *cast_out);

/// The same for spheres and capsules with a radius (capsule_cast.c).
bool tl_triangle_cast_capsule(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3],
                              double t_limit, tl_triangle_cast *cast_out);

/// Penetration depth and normal of a shape that overlaps a triangle.
void tl_triangle_cast_overlap(const tl_query_shape *shape, const tl_vec3 corners[3], tl_triangle_cast *cast_out);

/// The separation of a moved shape and a triangle.
typedef struct tl_approach {
    tl_vec3d normal; ///< unit, from the triangle to the shape; zero when the shape's core meets the triangle
    tl_vec3d point;  ///< on the triangle
    double distance; ///< metres, of the core: the shape without its radius
    double gap;      ///< metres: distance less the radius
} tl_approach;

void tl_approach_at(const tl_query_shape *shape, tl_vec3d step, double t, const tl_vec3 corners[3],
                    tl_approach *approach_out);

/// Whether a rounded shape that touches a triangle at the time t (`at` is its approach then) later penetrates it deeper
/// than what counts as touching.
bool tl_graze_deepens(const tl_query_shape *shape, const tl_motion *motion, const tl_vec3 corners[3], double t,
                      tl_approach at);

#endif
