// SPDX-License-Identifier: MIT
//
// The Minkowski difference A - B of two shapes, in A's frame, and its support points. The shapes overlap when it
// contains the origin; their distance or depth is that of the origin from its surface.

#ifndef TALUS_SRC_CONVEX_MINKOWSKI_H
#define TALUS_SRC_CONVEX_MINKOWSKI_H

#include "convex/core/placed_pair.h"

#include <talus/convex.h>

// A point of A - B, in A's frame. The point of B is a - w: that the sum is rounded once more moves it by less than its
// own error.
typedef struct tl_minkowski_point {
    tl_vec3d w; // a - b
    tl_vec3d a;
    uint32_t vertex_a, vertex_b; // TL_NO_VERTEX for curved and custom shapes
} tl_minkowski_point;

typedef struct tl_minkowski {
    const tl_convex *a, *b;
    tl_frame b_to_a;
    tl_frame a_to_world;
    // A support direction is rounded to float, so a support value is short of the true one by at most
    // |direction| times this: the size of both shapes times one rounding of the direction.
    double direction_error;
    double origin_size;      // of b_to_a's origin
    double scale;            // what rounding is relative to: the largest coordinates that went into a point so far
    uint32_t last_a, last_b; // hints
    uint32_t scan_limit;     // hulls of so many vertices are scanned, whatever the hint
    uint32_t depth_steps;    // budget of the search for a depth
    bool is_placed;          // `placed` is set
    tl_placed_pair placed;
} tl_minkowski;

// False when a pose or what a shape holds itself is not finite; the pair is of no use then.
bool tl_minkowski_init(tl_minkowski *pair, const tl_convex *a, const tl_transform *pose_a, const tl_convex *b,
                       const tl_transform *pose_b);

// Vertices that are likely to be the next support points, or TL_NO_VERTEX for both. Where a hint is right it is faster
// than any scan.
void tl_minkowski_set_hints(tl_minkowski *pair, uint32_t vertex_a, uint32_t vertex_b);

// For queries that ask for several support points: places the vertices of hulls that have few.
void tl_minkowski_place_hulls(tl_minkowski *pair);

// Moves B, along A's axes.
static inline void tl_minkowski_shift(tl_minkowski *pair, tl_vec3d by)
{
    pair->b_to_a.origin = tl_vec3d_add(pair->b_to_a.origin, by);
    pair->is_placed = false;
}

// From the middle of B to the middle of A, roughly; any direction but zero when they coincide.
tl_vec3d tl_minkowski_offset(const tl_minkowski *pair);

// The point of A - B farthest along the direction, which is not zero.
void tl_minkowski_support(tl_minkowski *pair, tl_vec3d direction, tl_minkowski_point *point_out);

// How far A - B reaches along a unit normal, or two: the support's value, which is no less than the true one but for
// rounding in double.
double tl_minkowski_reach(tl_minkowski *pair, tl_vec3d normal);
void tl_minkowski_reach_of_two(tl_minkowski *pair, const tl_vec3d normals[2], double reach_out[2]);

// The point of A - B of two vertices; false when a shape has no such vertex.
bool tl_minkowski_vertex(tl_minkowski *pair, uint32_t vertex_a, uint32_t vertex_b, tl_minkowski_point *point_out);

// The same of a simplex of 1 .. 4 points; false where it has none, too.
bool tl_minkowski_simplex(tl_minkowski *pair, const tl_simplex_cache *cache, tl_minkowski_point points_out[4]);

// The same of many.
bool tl_minkowski_vertices(tl_minkowski *pair, const uint16_t (*vertices)[2], uint32_t count,
                           tl_minkowski_point *points_out);

// The same of w alone, of 2 .. TL_KEPT_POINTS.
bool tl_minkowski_place(tl_minkowski *pair, const uint16_t (*vertices)[2], uint32_t count,
                        tl_placed_points *points_out);

// A vertex of A that these found.
tl_vec3d tl_minkowski_vertex_of_a(const tl_minkowski *pair, uint32_t vertex);

// The sum of a hull's largest coordinates: no vertex has a greater one.
static inline double tl_hull_size(const tl_hull *hull)
{
    return tl_vec3d_size(tl_vec3d_from(tl_max(tl_abs(hull->bounds.min), tl_abs(hull->bounds.max))));
}

static inline tl_vec3 tl_minkowski_to_world(const tl_minkowski *pair, tl_vec3d p)
{
    return tl_vec3d_to_float(tl_frame_point(&pair->a_to_world, p));
}

#endif
