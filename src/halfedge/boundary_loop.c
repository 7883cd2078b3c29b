// SPDX-License-Identifier: MIT
//
// Boundary loops, found without marking half-edges: the lowest half-edge of a loop stands for it, and each half-edge
// walks both ways round the loop until it meets a lower one.
//
// One way alone is quadratic on a loop whose numbers run along it. Both ways at once, a half-edge walks no farther than
// its nearer lower one, which is at most the smaller of the two parts that it divides the stretch between its lower
// ones into; and to halve again and again is L log L (the argument of union by size).

#include "halfedge/boundary_loop.h"

#include "base/exact_floats.h"

bool tl_halfedge_is_lowest_of_loop(const tl_halfedge_mesh *mesh, uint32_t half_edge, uint64_t *steps)
{
    uint32_t after = half_edge, before = half_edge;
    do {
        after = mesh->edges[after].next;
        before = mesh->edges[before].prev;
        *steps += 2;
        if (after < half_edge || before < half_edge) {
            return false;
        }
    } while (after != half_edge);
    return true;
}

uint32_t tl_halfedge_mesh_next_boundary_loop(const tl_halfedge_mesh *mesh, uint32_t from)
{
    uint64_t steps = 0;
    for (uint32_t start = from; start < mesh->edge_end; start++) {
        if (tl_halfedge_is_edge(mesh, start) && mesh->edges[start].face == TL_HALFEDGE_NONE &&
            tl_halfedge_is_lowest_of_loop(mesh, start, &steps)) {
            return start;
        }
    }
    return TL_HALFEDGE_NONE;
}
