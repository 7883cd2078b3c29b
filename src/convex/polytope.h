// SPDX-License-Identifier: MIT
//
// The growing polytope inside of A - B that EPA walks with: triangles, each with its three neighbours.

#ifndef TALUS_SRC_CONVEX_POLYTOPE_H
#define TALUS_SRC_CONVEX_POLYTOPE_H

#include "convex/proxy.h"

#include <assert.h>

// A query may use 32 KB of stack. Euler: V vertices have 2 V - 4 triangles.
enum { TL_POLYTOPE_VERTICES = 176, TL_POLYTOPE_FACES = 2 * TL_POLYTOPE_VERTICES - 4 };

// b is a - w; that the sum is rounded once more moves a witness by less than the points' own error.
typedef struct tl_polytope_vertex {
    tl_vec3d w, a;
} tl_polytope_vertex;

typedef struct tl_polytope_face {
    tl_vec3d normal;       // unit, outward
    uint16_t vertices[3];  // counter-clockwise from outside
    uint16_t neighbors[3]; // across the edge from vertices[i] to vertices[i + 1]
    bool live, visible;
} tl_polytope_face;

typedef struct tl_polytope {
    tl_polytope_vertex vertices[TL_POLYTOPE_VERTICES];
    tl_polytope_face faces[TL_POLYTOPE_FACES];
    double distances[TL_POLYTOPE_FACES]; // of the face's plane from the origin; infinite for dead ones
    uint32_t vertex_count, face_count;   // slots in use; a dead face's slot is taken again
    uint32_t free_count;
    uint16_t free_faces[TL_POLYTOPE_FACES];
    double coplanar; // metres; a point less than this behind a face's plane sees the face
} tl_polytope;

// What a query has on its stack beside it is less than 6 KB.
static_assert(sizeof(tl_polytope) <= 26 * 1024, "a query's stack is bounded");

// From four points that are not in one plane. The points need not contain the origin.
void tl_polytope_init(tl_polytope *polytope, const tl_pair_point points[4], double coplanar);

uint32_t tl_polytope_nearest_face(const tl_polytope *polytope);

// Grows to the hull with the point, which lies more than `coplanar` in front of the face. False, with nothing changed,
// when it is full or rounding made the rim of what the point sees not one simple loop.
bool tl_polytope_add(tl_polytope *polytope, uint32_t face, const tl_pair_point *point);

#endif
