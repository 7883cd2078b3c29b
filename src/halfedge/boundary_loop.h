// SPDX-License-Identifier: MIT
//
// Boundary loops, each named by its lowest half-edge.

#ifndef TALUS_SRC_HALFEDGE_BOUNDARY_LOOP_H
#define TALUS_SRC_HALFEDGE_BOUNDARY_LOOP_H

#include <talus/halfedge.h>

// Whether no half-edge of a half-edge's loop is lower. Adds to `steps` how many were looked at.
bool tl_halfedge_is_lowest_of_loop(const tl_halfedge_mesh *mesh, uint32_t half_edge, uint64_t *steps);

#endif
