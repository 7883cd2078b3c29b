// SPDX-License-Identifier: MIT
//
// Is an ear free? A triangulation of what is left of an outline, in which that is seen from the ear's own triangles.

#ifndef TALUS_SRC_POLYGON_EAR_MESH_H
#define TALUS_SRC_POLYGON_EAR_MESH_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/sweep.h"

#define TL_NO_EAR_EDGE UINT32_MAX

/// Edge 4t + k runs from corner k of triangle t to the next, k < 3.
typedef struct tl_ear_edge {
    uint32_t origin; // vertex
    uint32_t twin;   // TL_NO_EAR_EDGE on the outline
} tl_ear_edge;

/// A vertex of an outline that ears are cut off from. Of three vertices that make a triangle each one but the first and
/// the last of all is the middle one just once, in order of the outline, so the triangle lies there: what a cut reads
/// and writes is a few cache lines near one another, though cuts come from anywhere.
typedef struct tl_ear_vertex {
    _Alignas(64) tl_lattice_point position;
    uint32_t previous, next; // in what is left of the outline; of a vertex that was cut off, its ear's other corners
    uint32_t across;         // the vertex whose ear lies across the edge that starts here, or TL_NO_EAR_VERTEX
    uint32_t across_before;  // of a vertex that was cut off: the same of the edge that ended here
    uint32_t cut;            // number of the cut, or TL_NO_EAR_VERTEX
    bool is_reflex;          // or straight
    uint32_t outer;          // mesh: the edge from here to the next vertex
    tl_ear_edge edges[3];    // mesh: a triangle
} tl_ear_vertex;

_Static_assert(sizeof(tl_ear_vertex) == 64, "a cache line");

#define TL_NO_EAR_VERTEX UINT32_MAX

/// Triangulates a weakly simple outline, as tl_triangulate takes it: `outer` and `edges` of the vertices, whose
/// positions are known. `sweep`: over its edges, edge i from point i to the next; NULL when it is not known.
/// TL_ERR_SELF_INTERSECTION: it is not weakly simple.
tl_result tl_ear_mesh_init(tl_ear_vertex *vertices, uint32_t count, tl_arena *scratch, const tl_lattice_point *points,
                           const tl_outline_sweep *sweep);

/// Whether the corner b between vertex a and the next one, which has a turn > 0, can be cut off: no vertex lies in the
/// triangle but where its corners are. `from` and `to`: the points of the new edge, a's and the next one's.
bool tl_ear_mesh_is_free(const tl_ear_vertex *vertices, uint32_t a, uint32_t b, tl_lattice_point from,
                         tl_lattice_point to);

/// Cuts off a free ear. More than three vertices are left.
void tl_ear_mesh_cut(tl_ear_vertex *vertices, uint32_t a, uint32_t b);

static inline tl_ear_edge *tl_ear_edge_at(tl_ear_vertex *vertices, uint32_t edge)
{
    return &vertices[edge >> 2].edges[edge & 3];
}

static inline uint32_t tl_ear_edge_origin(const tl_ear_vertex *vertices, uint32_t edge)
{
    return vertices[edge >> 2].edges[edge & 3].origin;
}

static inline uint32_t tl_ear_edge_twin(const tl_ear_vertex *vertices, uint32_t edge)
{
    return vertices[edge >> 2].edges[edge & 3].twin;
}

static inline uint32_t tl_ear_edge_next(uint32_t edge)
{
    return (edge & 3) == 2 ? edge - 2 : edge + 1;
}

static inline uint32_t tl_ear_edge_previous(uint32_t edge)
{
    return (edge & 3) == 0 ? edge + 2 : edge - 1;
}

#endif
