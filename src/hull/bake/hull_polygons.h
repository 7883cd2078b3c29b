// SPDX-License-Identifier: MIT
//
// A hull as polygons, between quickhull's triangles and the baked bytes: what is left out, merged, measured and
// encoded.

#ifndef TALUS_SRC_HULL_HULL_POLYGONS_H
#define TALUS_SRC_HULL_HULL_POLYGONS_H

#include "base/arena.h"
#include "base/stage.h"

#include <talus/hull.h>

#define TL_NONE UINT32_MAX

// In final numbering.
typedef struct tl_hull_polygons {
    uint32_t vertex_count, face_count, half_edge_count;
    uint32_t *points; // [vertex_count] ascending
    tl_hull_half_edge *half_edges;
    tl_hull_face *faces;
    // Of merged faces, else zero.
    const struct tl_hull_polygons *exact; // what they were merged from, with the same vertices
    uint32_t *plane_faces;                // [face_count] the exact face whose plane a face has
    float merge_distance;                 // metres; a face's corners lie within this of its plane
} tl_hull_polygons;

// hull_simplify.c: leaves out corners that the def's distances make superfluous. `polygons` are the exact hull, and
// then that of the corners which stay; `max_outside` how far the others lie outside of it.
tl_result tl_hull_simplify(const tl_vec3 *points, const tl_hull_def *def, tl_arena *arena, tl_hull_polygons *polygons,
                           double *max_outside);

// hull_encode.c
tl_result tl_hull_encode(const tl_hull_polygons *polygons, const tl_vec3 *points, const tl_hull *named, uint32_t copies,
                         tl_arena *arena, tl_stage *stage, tl_hull **hull_out);

// hull_mass.c: for density 1, from the vertices and loops.
// TL_ERR_CANCELLED is the only error; a NULL stage is silent.
tl_result tl_hull_measure_mass(const tl_hull *hull, tl_stage *stage, tl_hull_mass *mass_out);

// hull_plane.c
// The loop of a face: words that name its corners among the vertices, `stride` bytes from one to the next.
typedef struct tl_hull_loop {
    const tl_vec3 *vertices;
    const char *words;
    uint32_t word_bytes, stride, count;
} tl_hull_loop;
tl_hull_loop tl_hull_loop_of(const tl_hull *hull, uint32_t face);
// The plane of a face, from its corners, which lie in it exactly.
tl_hull_plane tl_hull_fit_plane(tl_hull_loop loop);
// For TL_HULL_HAS_SIDES: whether a corner of some face, off the edge between, lies in a neighbour's plane.
bool tl_hull_has_sides(const tl_hull *hull);

#endif
