// SPDX-License-Identifier: MIT
//
// Removing a face: its half-edges become a boundary loop as they are; then each edge without any face is cut out of
// the loops at both of its ends. No search is needed, for the ring of a vertex closes over a missing edge.

#include "halfedge/pool.h"

#include "base/assert.h"

static void unlink_edge(tl_halfedge_mesh *mesh, uint32_t edge)
{
    uint32_t twin = tl_halfedge_twin(edge);
    uint32_t from = mesh->edges[twin].vertex, to = mesh->edges[edge].vertex;
    uint32_t next = mesh->edges[edge].next, prev = mesh->edges[edge].prev;
    uint32_t twin_next = mesh->edges[twin].next, twin_prev = mesh->edges[twin].prev;
    // The half-edge after the twin starts where this one does: itself, when it is the only one there.
    if (mesh->vertices[from].edge == edge) {
        mesh->vertices[from].edge = twin_next != edge ? twin_next : TL_HALFEDGE_NONE;
    }
    if (mesh->vertices[to].edge == twin) {
        mesh->vertices[to].edge = next != twin ? next : TL_HALFEDGE_NONE;
    }
    tl_halfedge_join(mesh, prev, twin_next);
    tl_halfedge_join(mesh, twin_prev, next);
    tl_halfedge_give_edge(mesh, edge);
}

tl_result tl_halfedge_mesh_remove_face(tl_halfedge_mesh *mesh, uint32_t face)
{
    if (mesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_halfedge_is_face(mesh, face)) {
        return TL_ERR_STALE;
    }
    uint32_t start = mesh->faces[face].edge, edge = start, size = 0;
    do {
        mesh->edges[edge].face = TL_HALFEDGE_NONE;
        size++;
        edge = mesh->edges[edge].next;
    } while (edge != start);
    // To cut an edge out changes the links of its neighbours only, so the next one is remembered first.
    for (uint32_t i = 0; i < size; i++) {
        uint32_t next = mesh->edges[edge].next;
        if (mesh->edges[tl_halfedge_twin(edge)].face == TL_HALFEDGE_NONE) {
            mesh->boundary_count--;
            unlink_edge(mesh, edge);
        } else {
            mesh->boundary_count++;
        }
        edge = next;
    }
    tl_halfedge_give_face(mesh, face);
    return TL_OK;
}

tl_result tl_halfedge_mesh_remove_vertex(tl_halfedge_mesh *mesh, uint32_t vertex)
{
    if (mesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_halfedge_is_vertex(mesh, vertex)) {
        return TL_ERR_STALE;
    }
    // Every edge has a face on one side at least, and its last edge goes with its last face.
    while (mesh->vertices[vertex].edge != TL_HALFEDGE_NONE) {
        uint32_t edge = mesh->vertices[vertex].edge;
        uint32_t face = mesh->edges[edge].face;
        TL_TRY(tl_halfedge_mesh_remove_face(mesh, face != TL_HALFEDGE_NONE ? face : mesh->edges[edge ^ 1u].face));
    }
    tl_halfedge_give_vertex(mesh, vertex);
    return TL_OK;
}
