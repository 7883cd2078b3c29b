// SPDX-License-Identifier: MIT
//
// Is an ear free? A triangulation of what is left of an outline, in which that is seen from the ear's own triangles.

#ifndef TALUS_SRC_POLYGON_EAR_MESH_H
#define TALUS_SRC_POLYGON_EAR_MESH_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/sweep.h"

#define TL_NO_EAR_EDGE UINT32_MAX

/// Edge 4t + k runs from corner k of triangle t to the next, k < 3; the fourth place fills a cache line's half.
typedef struct tl_ear_edge {
    uint32_t origin; // vertex
    uint32_t twin;   // TL_NO_EAR_EDGE on the outline
} tl_ear_edge;

typedef struct tl_ear_mesh {
    const tl_lattice_point *points;
    tl_ear_edge *edges;
    uint32_t *outer; // [vertex] the edge from it to the next vertex of the outline
} tl_ear_mesh;

/// Triangulates a weakly simple outline, as tl_triangulate takes it. `sweep`: over its edges, edge i from point i to
/// the next; NULL when it is not known. The mesh lies in `arena`. TL_ERR_SELF_INTERSECTION: it is not weakly simple.
tl_result tl_ear_mesh_init(tl_ear_mesh *mesh, tl_arena *arena, const tl_lattice_point *points, uint32_t count,
                           const tl_outline_sweep *sweep);

/// Whether the corner b between vertex a and the next one, which has a turn > 0, can be cut off: no vertex lies in the
/// triangle but where its corners are. `from` and `to`: the points of the new edge, a's and the next one's.
bool tl_ear_mesh_is_free(const tl_ear_mesh *mesh, uint32_t a, uint32_t b, tl_lattice_point from, tl_lattice_point to);

/// Cuts off a free ear. More than three vertices are left.
void tl_ear_mesh_cut(tl_ear_mesh *mesh, uint32_t a, uint32_t b);

static inline uint32_t tl_ear_edge_next(uint32_t edge)
{
    return (edge & 3) == 2 ? edge - 2 : edge + 1;
}

static inline uint32_t tl_ear_edge_previous(uint32_t edge)
{
    return (edge & 3) == 0 ? edge + 2 : edge - 1;
}

#endif
