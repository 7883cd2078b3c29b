// SPDX-License-Identifier: MIT
//
// Exact comparisons, where float arithmetic cannot tell which vertex is farther.
//
// Hill climbing on the half-edges: Chou's function with its defects corrected.
// Source: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013.
//
// A vertex of a convex body that no neighbour exceeds is a farthest one, and all farthest vertices are those of one
// corner, edge or face. Each step strictly gains, so there are at most V steps.

#include "hull/support/hull_support.h"

#include "base/lowest_bit.h"
#include "math/predicates.h"

// The lowest vertex of the whole loop of a face.
static uint32_t lowest_of_face(const tl_hull *hull, uint32_t half_edge)
{
    // A face's loop begins with its lowest vertex.
    return tl_hull_edge_origin(hull, tl_hull_face_first(hull, tl_hull_edge_face(hull, half_edge)));
}

// The lowest of the farthest among all.
static uint32_t scan_exact(const tl_hull *hull, tl_vec3 direction)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t vertex = 0;
    for (uint32_t v = 1; v < hull->vertex_count; v++) {
        vertex = tl_compare_along(direction, vertices[v], vertices[vertex]) > 0 ? v : vertex;
    }
    return vertex;
}

// Merged faces lack edges that a climb needs; the blocks have those of the exact hull. Level neighbours are rare, and
// then the lowest of all vertices as far is looked for among all.
static uint32_t climb_merged(const tl_hull *hull, tl_vec3 direction, uint32_t vertex)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    bool level = false;
    for (uint32_t at = vertex, better = vertex; at != TL_NO_VERTEX;) {
        const uint32_t last = blocks[at].link[TL_CLIMB_LANES - 1];
        const bool more = (last & TL_CLIMB_MORE) != 0;
        for (uint32_t lane = 0; lane < TL_CLIMB_LANES - (more ? 1 : 0); lane++) {
            const uint32_t other = blocks[at].link[lane];
            const int order = tl_compare_along(direction, vertices[other], vertices[better]);
            level = order > 0 ? false : level || (order == 0 && other != better);
            better = order > 0 ? other : better;
        }
        at = more ? last & ~TL_CLIMB_MORE : better != vertex ? better : TL_NO_VERTEX;
        if (!more) {
            level = level && better == vertex;
            vertex = better;
        }
    }
    return level ? scan_exact(hull, direction) : vertex;
}

uint32_t tl_hull_climb_exact(const tl_hull *hull, tl_vec3 direction, uint32_t vertex)
{
    if (hull->merge_distance > 0.0f) {
        return hull->vertex_count <= TL_HULL_FEW ? scan_exact(hull, direction) : climb_merged(hull, direction, vertex);
    }
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (;;) {
        uint32_t start = tl_hull_vertex_edge(hull, vertex);
        uint32_t edge = start, better = vertex, lowest = vertex;
        do {
            uint32_t next = tl_hull_edge_next(hull, edge);
            uint32_t other = tl_hull_edge_origin(hull, next);
            int order = tl_compare_along(direction, vertices[other], vertices[better]);
            if (order > 0) {
                better = other;
            } else if (order == 0 && better == vertex) {
                // The edge is level; when the edge after it is too, so is the face.
                uint32_t after = tl_hull_edge_origin(hull, tl_hull_edge_next(hull, next));
                bool level_face = tl_compare_along(direction, vertices[after], vertices[vertex]) == 0;
                uint32_t candidate = level_face ? lowest_of_face(hull, edge) : other;
                lowest = candidate < lowest ? candidate : lowest;
            }
            edge = tl_hull_edge_next(hull, tl_hull_edge_twin(hull, edge));
        } while (edge != start);
        if (better == vertex) {
            return lowest;
        }
        vertex = better;
    }
}

uint32_t tl_hull_decide_exact(const tl_hull *hull, float x, float y, float z, uint64_t candidates)
{
    const tl_vec3 direction = { x, y, z };
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t vertex = tl_lowest_bit(candidates);
    for (uint64_t left = candidates & (candidates - 1); left != 0; left &= left - 1) {
        uint32_t other = tl_lowest_bit(left);
        // The rows of a scan are padded with the last vertex, whose own bit is lower.
        if (other < hull->vertex_count && tl_compare_along(direction, vertices[other], vertices[vertex]) > 0) {
            vertex = other;
        }
    }
    return vertex;
}
