// SPDX-License-Identifier: MIT
//
// The working form of the hull build: triangles over the input points, each with the points that lie outside of it.
//
// Invariant after each step: the live triangles bound a convex body, weakly (neighbours may be coplanar), and every
// point that is not on its surface or inside is filed under a triangle that it lies strictly in front of.

#ifndef TALUS_SRC_HULL_QUICKHULL_H
#define TALUS_SRC_HULL_QUICKHULL_H

#include "base/arena.h"
#include "hull/side_plane.h"

#include <talus/hull.h>

#define TL_NONE UINT32_MAX

// Half-edge k of triangle f is 3 * f + k and runs from vertex k to vertex (k + 1) % 3.
typedef struct tl_quickhull_face {
    tl_side_plane plane;
    double farthest_value;
    uint32_t vertex[3];
    uint32_t across[3];      // the twin of each half-edge
    uint32_t first_conflict; // head of a list linked by next_conflict
    uint32_t farthest;       // its point with the largest value; lowest index on ties
    uint32_t stamp;          // the step that last asked whether it is visible
    bool visible;
    bool live;
    bool queued;
} tl_quickhull_face;

// Farthest-first order, when the number of vertices is limited.
typedef struct tl_quickhull_entry {
    double distance;
    uint32_t face;
    uint32_t point;
} tl_quickhull_entry;

typedef struct tl_quickhull {
    tl_arena *arena;
    const tl_vec3 *points;
    uint32_t point_count;
    double extent[3]; // of the points' box
    double max_abs;   // largest absolute coordinate

    tl_quickhull_face *faces;
    uint32_t face_count; // used entries, dead ones included
    uint32_t face_capacity;
    uint32_t live_faces;
    uint32_t free_face; // list of dead faces linked by vertex[0]

    uint32_t *next_conflict; // [point_count]
    uint32_t *cone_face;     // [point_count] the new face whose horizon edge starts at this vertex

    // One step's scratch, grown with the faces.
    uint32_t *visible; // faces that see the new point
    uint32_t visible_count;
    uint32_t *horizon; // half-edges of visible faces whose twins are not visible
    uint32_t horizon_count;
    uint32_t *created;
    uint32_t created_count;
    uint32_t stamp;

    // Faces that wait: a ring, or a heap when farthest_first.
    uint32_t *ring; // [face_capacity]
    uint32_t ring_first, ring_count;
    bool farthest_first;
    tl_quickhull_entry *heap;
    uint32_t heap_count, heap_capacity;
} tl_quickhull;

// The hull as polygons, in final numbering, before it is baked.
typedef struct tl_hull_polygons {
    uint32_t vertex_count, face_count, half_edge_count;
    uint32_t *points; // [vertex_count] ascending
    tl_hull_half_edge *half_edges;
    tl_hull_face *faces;
} tl_hull_polygons;

static inline uint32_t tl_half_edge_face(uint32_t half_edge)
{
    return half_edge / 3;
}

static inline uint32_t tl_half_edge_next(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

// A live face without neighbours; the caller has made room by tl_quickhull_reserve.
uint32_t tl_quickhull_new_face(tl_quickhull *hull, uint32_t a, uint32_t b, uint32_t c);
void tl_quickhull_free_face(tl_quickhull *hull, uint32_t face);
// Room for `more` new faces, here and in the scratch.
tl_result tl_quickhull_reserve(tl_quickhull *hull, uint32_t more);

// seed.c: the first tetrahedron, and the named result of input without volume.
tl_result tl_quickhull_seed(tl_quickhull *hull, double flatness, uint32_t seed_out[4], uint32_t *rank_out);

// conflict_list.c
void tl_quickhull_file_all(tl_quickhull *hull, const uint32_t seed[4]);
// Files the points of the visible faces under the created ones.
void tl_quickhull_refile(tl_quickhull *hull);
tl_result tl_quickhull_enqueue(tl_quickhull *hull, uint32_t face);
// The next face with a point outside, or TL_NONE.
uint32_t tl_quickhull_dequeue(tl_quickhull *hull);

// horizon.c: replaces all that is visible from the face's farthest point by a cone. Leaves `visible` for the refiling.
tl_result tl_quickhull_add_point(tl_quickhull *hull, uint32_t face);

// face_merge.c
tl_result tl_quickhull_merge_faces(tl_quickhull *hull, tl_hull_polygons *polygons_out);

// thicken.c: copies of the points moved to both sides along the directions that they lack.
tl_result tl_quickhull_thicken(tl_quickhull *hull, const uint32_t seed[4], uint32_t rank, float thickness,
                               uint32_t *copies_out);

// bake.c
tl_result tl_hull_bake(const tl_hull_polygons *polygons, const tl_vec3 *points, uint32_t copies, tl_arena *arena,
                       tl_hull **hull_out);

#endif
