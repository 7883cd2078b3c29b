// SPDX-License-Identifier: MIT
//
// The growing polytope inside of A - B that EPA walks with: triangles, each with its three neighbours.

#ifndef TALUS_SRC_CONVEX_POLYTOPE_H
#define TALUS_SRC_CONVEX_POLYTOPE_H

#include "convex/proxy.h"

#include <assert.h>

// Euler: V vertices have 2 V - 4 triangles. So many fit eight bits, and a face one cache line.
enum { TL_POLYTOPE_VERTICES = 128, TL_POLYTOPE_FACES = 2 * TL_POLYTOPE_VERTICES - 4 };

// b is a - w, as in a pair's point.
typedef struct tl_polytope_vertex {
    tl_vec3d w, a;
} tl_polytope_vertex;

typedef struct tl_polytope_face {
    tl_vec3d normal;      // outward, of any length
    double offset;        // of the plane along the normal
    double normal_sq;     // square of the normal's length
    uint8_t vertices[3];  // counter-clockwise from outside
    uint8_t neighbors[3]; // across the edge from vertices[i] to vertices[i + 1]
    bool seen;
} tl_polytope_face;

typedef struct tl_polytope {
    tl_polytope_vertex vertices[TL_POLYTOPE_VERTICES];
    tl_polytope_face faces[TL_POLYTOPE_FACES];
    // Squared distance of the face's plane from the origin, negative where the origin is outside; infinite for a free
    // slot and for a face without an area, whose points belong to its neighbours too.
    double keys[TL_POLYTOPE_FACES];
    uint32_t vertex_count, face_count; // slots in use; a dead face's slot is taken again
    uint32_t free_count;
    uint8_t free_faces[TL_POLYTOPE_FACES];
} tl_polytope;

static_assert(TL_POLYTOPE_FACES <= UINT8_MAX, "indices have eight bits");
// A query may use 32 KB of stack. What it has on it beside this is less than 6 KB.
static_assert(sizeof(tl_polytope) <= 26 * 1024, "a query's stack is bounded");

// From four points that are not in one plane. The points need not contain the origin.
void tl_polytope_init(tl_polytope *polytope, const tl_pair_point points[4]);

uint32_t tl_polytope_nearest_face(const tl_polytope *polytope);

// The face's plane with its normal of unit length. The face has an area.
static inline tl_vec3d tl_polytope_plane(const tl_polytope *polytope, uint32_t face, double *distance_out)
{
    const tl_polytope_face *f = &polytope->faces[face];
    double scale = 1.0 / sqrt(f->normal_sq);
    *distance_out = f->offset * scale;
    return tl_vec3d_scale(f->normal, scale);
}

// Grows to the hull with the point, which lies more than `coplanar` metres in front of the face. A face that the point
// is less than `coplanar` behind is seen too. False, with nothing changed, when the polytope is full or rounding made
// the rim of what the point sees not one loop.
bool tl_polytope_add(tl_polytope *polytope, uint32_t face, const tl_pair_point *point, double coplanar);

#endif
