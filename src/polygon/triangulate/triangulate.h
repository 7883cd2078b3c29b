// SPDX-License-Identifier: MIT
//
// Triangulation of one outline by cutting off corners, shortest partition edge first.

#ifndef TALUS_SRC_POLYGON_TRIANGULATE_H
#define TALUS_SRC_POLYGON_TRIANGULATE_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/sweep.h"
#include "polygon/outline/trace_steps.h"

#define TL_NO_EDGE UINT32_MAX

/// How it is found out which ears are free. All ways give the same triangles in the same order.
typedef enum tl_ear_test {
    TL_EARS_BY_SIZE, ///< the one that is faster for so many points
    TL_EARS_BY_LIST, ///< a search among the reflex vertices
    TL_EARS_BY_MESH  ///< a triangulation of what is left
} tl_ear_test;

/// What to triangulate.
typedef struct tl_triangulate_input {
    const tl_lattice_point *points;
    uint32_t count;
    const tl_outline_sweep *sweep; // over the edges from each point to the next, or NULL: not known
    const tl_step_tracer *tracer;  // or NULL
    tl_ear_test ear_test;
    uint32_t *places_out; // NULL: triangles come in the order they were cut. Else by the corner that was cut, so that
                          // neighbours lie near one another, and this is [triangle] its place in that order
} tl_triangulate_input;

/// Cuts a weakly simple outline of `count` >= 3 points into count - 2 triangles, all of positive area.
///
/// Edges may coincide there and back (bridges to holes) and points may coincide, but no point lies inside an edge, no
/// two edges cross, and no point is a spike's tip: what tl_outline_prepare hands out.
/// Triangle t has the corners triangles_out[3t .. 3t + 2], indices of points, in the order (before, cut corner, after);
/// triangles come in the order they were cut, unless places_out is given. Edge k of triangle t runs from corner k to
/// the next one, and its number is 3t + k. twins_out[3t + k] is the number of the same partition edge seen from the
/// other triangle, or TL_NO_EDGE on the outline. TL_ERR_SELF_INTERSECTION: no valid partition was left, so the outline
/// was not as described.
tl_result tl_triangulate(tl_arena *scratch, const tl_triangulate_input *input, uint32_t *triangles_out,
                         uint32_t *twins_out);

/// The edge of the same triangle that begins where `edge` ends.
static inline uint32_t tl_triangle_edge_next(uint32_t edge)
{
    return edge % 3 < 2 ? edge + 1 : edge - 2;
}

#endif
