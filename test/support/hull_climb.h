// SPDX-License-Identifier: MIT
//
// How good a start of a support query is: deterministic, unlike its time.

#ifndef TALUS_TEST_HULL_CLIMB_H
#define TALUS_TEST_HULL_CLIMB_H

#include "hull/support/direction_table.h"
#include "math/predicates.h"

// Steps of a climb on the half-edges from where the table lets it start.
static inline uint32_t hull_climb_steps(const tl_hull *hull, tl_vec3 d)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t vertex = tl_hull_table_start(hull, d), steps = 0;
    for (;;) {
        uint32_t first = tl_hull_vertex_edge(hull, vertex), edge = first, best = vertex;
        do {
            const uint32_t twin = tl_hull_edge_twin(hull, edge), other = tl_hull_edge_origin(hull, twin);
            best = tl_compare_along(d, vertices[other], vertices[best]) > 0 ? other : best;
            edge = tl_hull_edge_next(hull, twin);
        } while (edge != first);
        if (best == vertex) {
            return steps;
        }
        vertex = best;
        steps++;
    }
}

#endif
