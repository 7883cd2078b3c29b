// SPDX-License-Identifier: MIT
//
// The support function on the editable mesh: hill climbing with a hint, as in Chou's article, with its defects
// corrected. Source: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013.
//
// Comparisons are exact, so there is no epsilon that would depend on the model's size, and a climb strictly gains and
// ends. When no neighbour is higher the vertex is a maximum of the surface around it, hence of the convex body, with
// one exception: within a flat face all neighbours may be level, and then this may as well be the minimum.

#include "math/predicates.h"

#include <talus/halfedge.h>

static uint32_t scan(const tl_halfedge_mesh *mesh, tl_vec3 direction, bool with_edges)
{
    uint32_t best = TL_HALFEDGE_NONE;
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        const tl_halfedge_vertex *vertex = &mesh->vertices[v];
        if (vertex->link != TL_HALFEDGE_LIVE || (with_edges && vertex->edge == TL_HALFEDGE_NONE)) {
            continue;
        }
        if (best == TL_HALFEDGE_NONE ||
            tl_compare_along(direction, vertex->position, mesh->vertices[best].position) > 0) {
            best = v;
        }
    }
    return best;
}

// Some vertex that has a face; there is one.
static uint32_t any_vertex(const tl_halfedge_mesh *mesh)
{
    uint32_t face = 0;
    while (mesh->faces[face].link != TL_HALFEDGE_LIVE) {
        face++;
    }
    return mesh->edges[mesh->faces[face].edge].vertex;
}

uint32_t tl_halfedge_mesh_support(const tl_halfedge_mesh *mesh, tl_vec3 direction, uint32_t hint)
{
    if (mesh->face_count == 0) {
        return scan(mesh, direction, false);
    }
    bool usable = tl_halfedge_is_vertex(mesh, hint) && mesh->vertices[hint].edge != TL_HALFEDGE_NONE;
    uint32_t vertex = usable ? hint : any_vertex(mesh);
    for (;;) {
        uint32_t start = mesh->vertices[vertex].edge, edge = start, best = vertex;
        bool lower = false;
        do {
            uint32_t other = mesh->edges[edge].vertex;
            int order = tl_compare_along(direction, mesh->vertices[other].position, mesh->vertices[best].position);
            best = order > 0 ? other : best;
            lower = lower || order < 0;
            edge = tl_halfedge_around(mesh, edge);
        } while (edge != start);
        if (best == vertex) {
            return lower ? vertex : scan(mesh, direction, true);
        }
        vertex = best;
    }
}
