// SPDX-License-Identifier: MIT
//
// Rings of cells for large faces: see direction_table.h.

#ifndef TALUS_SRC_HULL_FACE_RING_H
#define TALUS_SRC_HULL_FACE_RING_H

#include "hull/support/hull_support.h"

#include <math.h>

#define TL_NO_FACE_RING UINT32_MAX

// Whether a face of so many vertices has a ring.
static inline bool tl_face_has_ring(uint32_t vertex_count)
{
    return vertex_count >= 12;
}

// Cells of its ring.
static inline uint32_t tl_face_ring_cells(uint32_t vertex_count)
{
    return 4 * vertex_count;
}

// The middle of a cell, on the diamond |x| + |y| = 1 that stands for the circle.
static inline void tl_ring_cell_middle(uint32_t cell, uint32_t cell_count, double at[2])
{
    const double around = 4.0 * ((double)cell + 0.5) / (double)cell_count;
    const double t = around < 2.0 ? around - 1.0 : 3.0 - around;
    at[0] = around < 2.0 ? 1.0 - fabs(t) : fabs(t) - 1.0;
    at[1] = t;
}

// The axes of a face's ring; `first` is copied.
tl_face_ring tl_face_ring_make(const tl_hull *hull, uint32_t face, uint32_t first);

// Writes all rings and their cells, and for each vertex the ring of the largest face that it belongs to, or
// TL_NO_FACE_RING.
void tl_hull_fill_rings(tl_hull *hull, uint32_t *table, uint32_t *rings_of_vertices);

#endif
