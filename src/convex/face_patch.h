// SPDX-License-Identifier: MIT
//
// The patch that two faces, or an edge and a face, share when seen along a normal.

#ifndef TALUS_SRC_CONVEX_FACE_PATCH_H
#define TALUS_SRC_CONVEX_FACE_PATCH_H

#include "convex/facet.h"
#include "convex/minkowski.h"

// A face of a hull, a box or a triangle, or an edge as a face of two corners, in A's frame. Its corners are walked from
// `first`, until that comes again.
typedef struct tl_face {
    const tl_convex *shape;
    const tl_frame *frame; // to A's frame; NULL for A itself
    tl_facet facet;        // of a hull's face; corners are half-edges
    tl_vec3d corners[4];   // of the others
    uint32_t first, count; // 0: the corners are the facet's
    tl_vec3d normal;
    double offset;
} tl_face;

// face_along.c
// The face of the shape whose normal is closest to the unit direction, or an edge where all faces are too steep. False
// when there is neither.
bool tl_face_along(const tl_convex *shape, const tl_frame *frame, tl_vec3d direction, tl_face *face_out);
tl_vec3d tl_face_corner(const tl_face *face, uint32_t at);
uint32_t tl_face_next(const tl_face *face, uint32_t at);

typedef struct tl_patch_point {
    double x, y;       // in the plane across the normal
    double on_a, on_b; // heights along the normal
} tl_patch_point;

// At most this many are kept of a patch: the deepest and those that span the largest area with it.
enum { TL_PATCH_POINTS = 4 };

typedef struct tl_patch {
    tl_vec3d u, v, normal;
    tl_patch_point points[TL_PATCH_POINTS];
    uint32_t count;
    double gap; // metres; corners closer than this are one
} tl_patch;

// Corners of the common part of both faces, seen along the normal, where B's face lies at most `limit` above A's.
void tl_patch_find(const tl_face *a, const tl_face *b, tl_vec3d normal, double limit, tl_patch *patch_out);

// Adds a point that is deeper than all; of too many, the others are chosen anew.
void tl_patch_add_deepest(tl_patch *patch, tl_vec3d on_a, tl_vec3d on_b);

#endif
