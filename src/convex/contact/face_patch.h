// SPDX-License-Identifier: MIT
//
// The patch that two faces, or an edge and a face, share when seen along a normal.

#ifndef TALUS_SRC_CONVEX_FACE_PATCH_H
#define TALUS_SRC_CONVEX_FACE_PATCH_H

#include "convex/contact/facet.h"
#include "convex/core/minkowski.h"

// A disc stands for as a polygon of so many corners: its area is 0.974 of the disc's.
enum { TL_FACE_CORNERS = 16 };

// A face of a hull, a box, a triangle or a disc, or an edge as a face of two corners, in A's frame. Its corners are
// walked from `first`, until that comes again.
typedef struct tl_face {
    const tl_convex *shape;
    const tl_frame *frame;              // to A's frame; NULL for A itself
    tl_facet facet;                     // of a hull's face; corners are half-edges
    tl_vec3d corners[TL_FACE_CORNERS];  // of the others
    uint32_t vertices[TL_FACE_CORNERS]; // their features, and those of the edges from them to the next
    uint32_t edges[TL_FACE_CORNERS];
    uint32_t first, count; // 0: the corners are the facet's
    uint32_t feature;      // the face's own, or the edge's
    tl_vec3d normal;
    double offset;
} tl_face;

// face_along.c
// The face of the shape whose normal is closest to the unit direction, or an edge where all faces are too steep. False
// when there is neither.
bool tl_face_along(const tl_convex *shape, const tl_frame *frame, const tl_vec3d *direction, tl_face *face_out);
tl_vec3d tl_face_corner(const tl_face *face, uint32_t at);
uint32_t tl_face_next(const tl_face *face, uint32_t at);
uint32_t tl_face_previous(const tl_face *face, uint32_t at);
uint32_t tl_face_vertex_feature(const tl_face *face, uint32_t at);
// Of the edge from a corner to the next.
uint32_t tl_face_edge_feature(const tl_face *face, uint32_t at);

// face_round.c
// The same of a segment, a cylinder or a cone, in its own frame; false where only a corner or a point of a rim can
// rest.
bool tl_face_round(const tl_convex *shape, tl_vec3d direction, tl_face *face_out);

typedef struct tl_point2 {
    double x, y;
} tl_point2;

typedef struct tl_patch_point {
    double x, y;       // in the plane across the normal
    double on_a, on_b; // heights along the normal
    uint32_t features[2];
    uint32_t previous; // contact of the last manifold, or TL_NO_CONTACT
} tl_patch_point;

// Points are kept until there are so many; then those that span the most stay.
enum { TL_PATCH_POINTS = 32 };

typedef struct tl_patch {
    tl_vec3d u, v, normal;
    const tl_contact_cache *last;    // may be NULL
    uint64_t known[TL_MAX_CONTACTS]; // features of its contacts, as tl_patch_key; 0: none
    tl_patch_point points[TL_PATCH_POINTS];
    uint32_t count;
    const tl_patch_point *chosen[TL_MAX_CONTACTS]; // by tl_patch_choose
    uint32_t chosen_count;
    double gap;   // metres; corners closer than this are one
    double limit; // metres; points farther apart than this are left out
} tl_patch;

// A face's plane over the patch's.
typedef struct tl_patch_heights {
    double at_origin, along_x, along_y;
} tl_patch_heights;

// face_patch.c
// Corners of the common part of both faces, seen along the patch's normal, where B's face lies at most `limit` above
// A's. A few are kept where there are many: those that span the largest area, the deepest, and those of the last
// manifold.
void tl_patch_find(const tl_face *a, const tl_face *b, double limit, const tl_contact_cache *last, tl_patch *patch);
// Adds a point unless it is too far apart or there already.
void tl_patch_add(tl_patch *patch, tl_patch_point *point);

// face_sweep.c
// Two faces of any number of corners seen in the patch's plane: calls tl_patch_add for each corner of their
// intersection, with heights by the planes, which are those of face_patch.c.
void tl_face_sweep(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch);

// face_clip.c
// The same of two faces whose corners are kept, at most TL_SMALL_FACE of each. False, and nothing is added, where
// rounding leaves a part that is not convex.
enum { TL_SMALL_FACE = 8 };
bool tl_face_clip(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch);
// The same for each level of instructions.
bool tl_face_clip_base(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch);
bool tl_face_clip_avx2(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch);

// contact_choice.c
// Chooses at most four points, which are the last ones where these still do, and one more, which is at `lowest`, where
// none of them is within `slack` metres of it.
void tl_patch_choose(tl_patch *patch, uint32_t lowest, double slack);
// Cuts it down so far that there is space for more points.
void tl_patch_thin(tl_patch *patch);
// Index of the deepest point, of count >= 1.
uint32_t tl_patch_lowest(const tl_patch *patch);

static inline bool tl_same_place(const tl_patch *patch, double x, double y, double other_x, double other_y)
{
    return fabs(x - other_x) + fabs(y - other_y) <= 2.0 * patch->gap;
}

// An empty patch across a normal. A root and a division, which should be under way before the faces are looked for.
static inline void tl_patch_start(tl_patch *patch, tl_vec3d normal)
{
    patch->normal = normal;
    patch->u = tl_vec3d_perpendicular(normal);
    patch->v = tl_vec3d_cross(normal, patch->u);
    patch->count = 0;
}

// Both features in one word; 0 where one is not known.
static inline uint64_t tl_patch_key(const uint32_t features[2])
{
    return features[0] != 0 && features[1] != 0 ? (uint64_t)features[0] << 32 | features[1] : 0;
}

// The contact of the last manifold that has a key, which is not 0.
static inline uint32_t tl_patch_find_known(const tl_patch *patch, uint64_t key)
{
    uint32_t found = TL_NO_CONTACT;
    for (uint32_t i = 0; i < TL_MAX_CONTACTS; i++) {
        found = key == patch->known[i] ? i : found;
    }
    return found;
}

static inline void tl_patch_match(const tl_patch *patch, tl_patch_point *point)
{
    uint64_t key = tl_patch_key(point->features);
    point->previous = key != 0 ? tl_patch_find_known(patch, key) : TL_NO_CONTACT;
}

static inline double tl_patch_separation(const tl_patch_point *point)
{
    return point->on_b - point->on_a;
}

static inline double tl_patch_height(const tl_patch_heights *h, tl_point2 p)
{
    return h->at_origin + h->along_x * p.x + h->along_y * p.y;
}

static inline tl_point2 tl_patch_project(const tl_patch *patch, tl_vec3d p)
{
    tl_point2 q = { tl_vec3d_dot(patch->u, p), tl_vec3d_dot(patch->v, p) };
    return q;
}

#endif
