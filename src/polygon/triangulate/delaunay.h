// SPDX-License-Identifier: MIT
//
// From any triangulation of an outline to its constrained Delaunay triangulation.

#ifndef TALUS_SRC_POLYGON_DELAUNAY_H
#define TALUS_SRC_POLYGON_DELAUNAY_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

/// Flips edges between triangles until none has a corner of its other triangle inside the circle through the corners of
/// one. `corners` are 3 a triangle, indices of points; twins as tl_triangulate gives them; edges without a twin stay.
/// The result does not depend on the triangulation at the start but where four corners lie on one circle.
/// TL_ERR_MEMORY is the only error.
tl_result tl_make_delaunay(tl_arena *scratch, const tl_lattice_point *points, uint32_t *corners, uint32_t *twins,
                           uint32_t triangle_count);

/// Whether d lies strictly inside the circle through a, b, c. The turns of a, b, c and of a, c, d are > 0.
bool tl_in_circle(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c, tl_lattice_point d);

#endif
