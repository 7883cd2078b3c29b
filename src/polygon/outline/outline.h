// SPDX-License-Identifier: MIT
//
// From a contour as it comes to outlines that can be triangulated.

#ifndef TALUS_SRC_POLYGON_OUTLINE_H
#define TALUS_SRC_POLYGON_OUTLINE_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/sweep.h"

#include <talus/polygon.h>

/// A place of the contour. Points at the same x and z are one node, except in a plain outline, which has none, and
/// except where the contour passes on two floors: those stay two nodes.
typedef struct tl_outline_nodes {
    tl_lattice_point *points;
    int32_t *heights;
    uint8_t *is_border; // some vertex there is flagged TL_CONTOUR_BORDER_VERTEX
    uint32_t count;
    uint32_t capacity;
} tl_outline_nodes;

/// Closed walks around the contour's floor, each weakly simple as tl_triangulate wants it, with disjoint insides.
typedef struct tl_outline {
    tl_outline_nodes nodes;
    uint32_t walk_count;
    uint32_t *walk_first; // [walk_count + 1] into corners
    uint32_t *corners;    // nodes in order
    uint32_t *edges; // the contour's edge that leaves each corner, TL_NO_EDGE_OF_CONTOUR where it runs none that way
    bool is_plain;   // one walk, over all nodes in order
    tl_outline_sweep sweep; // of one walk over all vertices of the contour in order, when it is known
    uint32_t faults;        // TL_CONTOUR_FAULT_ bits
    uint32_t fault_vertex;
    int64_t area2; // of the contour as it came
} tl_outline;

#define TL_NO_EDGE_OF_CONTOUR UINT32_MAX

/// The vertices of one contour. NULL in a set without vertices, whose contours are all empty: nothing may be added to a
/// null pointer, not even 0.
static inline const tl_contour_vertex *tl_contour_begin(const tl_contour_set *set, const tl_contour *contour)
{
    return set->vertices != NULL ? set->vertices + contour->first_vertex : NULL;
}

/// Fills `outline_out`, all in `arena`. Vertices at one place whose heights differ by more than `merge_height` are on
/// different floors: a run there and back between them is a wall, not a bridge. TL_ERR_MEMORY is the only error: a
/// contour beyond repair has no walks and the bit TL_CONTOUR_FAULT_REFUSED.
tl_result tl_outline_prepare(tl_arena *arena, const tl_contour_vertex *vertices, uint32_t count, uint32_t merge_height,
                             tl_outline *outline_out);

/// Makes one node of the nodes at one place, the first of them. places[i], unless `places` is NULL, becomes the new
/// number of node i. Its memory is taken from `arena`.
tl_result tl_outline_unite_nodes(tl_arena *arena, tl_outline_nodes *nodes, uint32_t *places);

/// A directed edge between two nodes.
typedef struct tl_outline_edge {
    uint32_t from, to;
} tl_outline_edge;

/// Splits edges where they touch or cross until they meet only in nodes: *edges becomes the new list, nodes grow.
/// Sets fault bits in *faults and the first faulty edge, TL_CONTOUR_FAULT_REFUSED when it takes too many crossings.
/// Where a sweep showed that the edges meet in nodes only, *sweep has it, with nodes as places; else its counts are 0.
tl_result tl_outline_split_contacts(tl_arena *arena, tl_outline_nodes *nodes, tl_outline_edge **edges, uint32_t *count,
                                    uint32_t *faults, uint32_t *fault_edge, tl_outline_sweep *sweep);

/// Finds the faces of the plane that a closed walk of edges, which meet only in nodes, cuts out and winds around, and
/// writes their outlines as walks.
tl_result tl_outline_trace_faces(tl_arena *arena, const tl_outline_edge *edges, uint32_t count, tl_outline *outline);

#endif
