// SPDX-License-Identifier: MIT
//
// The growing polytope inside of A - B that EPA walks with: triangles and their half-edges.

#ifndef TALUS_SRC_CONVEX_POLYTOPE_H
#define TALUS_SRC_CONVEX_POLYTOPE_H

#include "convex/core/minkowski.h"
#include "math/tolerance.h"

#include <assert.h>

// Euler: V vertices have 2 V - 4 triangles.
enum { TL_POLYTOPE_VERTICES = 128, TL_POLYTOPE_FACES = 2 * TL_POLYTOPE_VERTICES - 4 };

// Of curved shapes, and of vertices of large hulls that are not less.
enum { TL_POLYTOPE_NO_ID = UINT16_MAX };

// b is a - w, as in a pair's point.
typedef struct tl_polytope_vertex {
    tl_vec3d w, a;
} tl_polytope_vertex;

// Computed from a face's corners when it is wanted: to keep the planes of all faces would take as much stack as all
// else.
typedef struct tl_polytope_plane {
    tl_vec3d normal;  // outward, of any length
    double offset;    // of the plane along the normal
    double normal_sq; // square of the normal's length
} tl_polytope_plane;

// Half-edge 4 f + i leads from corner i of face f to the next, counter-clockwise from outside; i is 0, 1 or 2.
typedef struct tl_polytope {
    tl_polytope_vertex vertices[TL_POLYTOPE_VERTICES];
    // The vertices of A and B that each vertex is made of, or TL_POLYTOPE_NO_ID: [TL_POLYTOPE_VERTICES]. NULL where no
    // cache keeps the polytope. Set before tl_polytope_init.
    uint16_t (*ids)[2];
    // Metres that the face's plane is surely away from the origin, negative where the origin is outside; infinite for a
    // free slot and for a face without an area, whose points belong to its neighbours too. The polytope lies in A - B,
    // so the least of them bounds the depth.
    double keys[TL_POLYTOPE_FACES];
    double scale;                          // of the pair, when the last point was found
    uint16_t twins[4 * TL_POLYTOPE_FACES]; // the same edge in the other direction
    // The vertex that a half-edge starts at; and 4 f + 3: whether the point that is being added sees face f.
    uint8_t origins[4 * TL_POLYTOPE_FACES];
    uint8_t free_faces[TL_POLYTOPE_FACES];
    uint32_t vertex_count, face_count, free_count; // slots in use; a dead face's slot is taken again
    bool linked;                                   // twins are set
} tl_polytope;

static_assert(TL_POLYTOPE_FACES <= UINT8_MAX, "indices have eight bits");
// A query may use 32 KB of stack. A shape cast against a scene's soup has 19 KB on it beside this.
static_assert(sizeof(tl_polytope) <= 12 * 1024, "a query's stack is bounded");

// A point of A - B is off by 16 roundings of the pair's scale; a plane through three of them and the distance of a
// fourth, by 16 more each where the triangle is not thin, and four times that is assumed. Keys know what thin ones add.
#define TL_POLYTOPE_ERROR TL_DOUBLE_GAMMA(128)

// From four points that are not in one plane, and the scale of their pair. The points need not contain the origin.
void tl_polytope_init(tl_polytope *polytope, const tl_minkowski_point points[4], double scale);

uint32_t tl_polytope_nearest_face(const tl_polytope *polytope);

// Computes the key of a face from its plane.
void tl_polytope_set_key(tl_polytope *polytope, uint32_t face, tl_polytope_plane plane);

static inline const tl_polytope_vertex *tl_polytope_corner(const tl_polytope *polytope, uint32_t face, uint32_t i)
{
    return &polytope->vertices[polytope->origins[4 * face + i]];
}

// From the vectors that lead from the last corner to the first two.
static inline tl_polytope_plane tl_polytope_plane_make(tl_vec3d last, tl_vec3d to_first, tl_vec3d to_second)
{
    tl_polytope_plane plane;
    plane.normal = tl_vec3d_cross(to_first, to_second);
    plane.offset = tl_vec3d_dot(plane.normal, last);
    plane.normal_sq = tl_vec3d_dot(plane.normal, plane.normal);
    return plane;
}

static inline tl_polytope_plane tl_polytope_plane_of(const tl_polytope *polytope, uint32_t face)
{
    tl_vec3d last = tl_polytope_corner(polytope, face, 2)->w;
    return tl_polytope_plane_make(last, tl_vec3d_sub(tl_polytope_corner(polytope, face, 0)->w, last),
                                  tl_vec3d_sub(tl_polytope_corner(polytope, face, 1)->w, last));
}

// Grows to the hull with the point, which lies in front of the face by more than TL_POLYTOPE_ERROR times the scale. A
// face that the point is less than that behind is seen too. False, with nothing changed, when the polytope is full or
// rounding made the rim of what the point sees not one loop.
bool tl_polytope_add(tl_polytope *polytope, uint32_t face, const tl_minkowski_point *point, double scale);

// polytope_keep.c
// Keeps what proves that the depth is no less than `lower`, with the face that is nearest; nothing where that takes too
// many points, or a point that is no vertex. Changes the polytope.
void tl_polytope_keep(tl_polytope *polytope, uint32_t nearest, double lower, tl_polytope_cache *cache_out);

// The polytope that was kept, its points where they are now. False when it does not hold the origin. The caller has
// checked it.
bool tl_polytope_resume(tl_minkowski *pair, const tl_polytope_cache *cache, tl_polytope *polytope_out);

// Finds the twins of a polytope that was resumed. False when its faces are no closed surface.
bool tl_polytope_link(tl_polytope *polytope);

#endif
