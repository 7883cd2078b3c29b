// SPDX-License-Identifier: MIT
//
// Rings of cells for caps: many small faces whose normals the table cannot tell apart.
//
// A large face that was turned before its corners were rounded is no longer flat: it is a cap of triangles whose
// normals differ by a few roundings, and the wedges of its corners meet in all of them. Seen from a direction further
// off than that it still is one face, and the angle around the normal tells the corner. The nearer a direction comes,
// the fewer corners remain farthest, and which ones only the cap itself can tell. So the ring of a cap has levels:
// circles around the normal, each a quarter as wide as the one outside, with half as many cells. (The extent of the
// arcs on which rounding leaves one corner grows like the square root of rounding over the angle to the normal.) Each
// cell names the farthest vertex for its own middle, whatever the shape of the cap is.

#ifndef TALUS_SRC_HULL_CAP_RING_H
#define TALUS_SRC_HULL_CAP_RING_H

#include "hull/support/face_ring.h"
#include "math/vec3d.h"

typedef struct tl_hull_cap {
    tl_vec3d normal, middle; // middle: scaled as the table is, of unit length
    double radius;           // of the disc around it in which its faces' normals lie, when they are scaled too
    uint32_t vertex;         // one of it
    uint32_t cell_count;     // of the outermost level
} tl_hull_cap;

typedef struct tl_hull_caps {
    tl_hull_cap *caps;
    uint32_t count;
    uint32_t *of_vertices; // each vertex's cap, or TL_NO_FACE_RING; NULL when there are none
} tl_hull_caps;

// Finds the caps of a hull whose topology, planes and table's side and scale are there.
tl_result tl_hull_find_caps(const tl_hull *hull, tl_arena *arena, tl_stage *stage, tl_hull_caps *caps_out);

// Counts their rings.
void tl_hull_count_caps(const tl_hull_caps *caps, tl_hull_climb *climb);

// Writes the rings and their cells, behind those of the faces, and gives the caps' vertices their rings.
tl_result tl_hull_fill_caps(tl_hull *hull, const tl_hull_caps *caps, uint32_t *table, uint32_t *rings_of_vertices,
                            tl_stage *stage);

// Whether a direction lies in the disc of a cap's normals.
bool tl_is_in_cap(const tl_hull *hull, const tl_hull_cap *cap, tl_vec3 direction);

// Whether a ring's bytes may be those of a cap's, whose cells lie from `first` on and before `end`: safe to look in.
bool tl_is_cap_ring(const tl_face_ring *ring, uint32_t first, uint64_t end);

#endif
