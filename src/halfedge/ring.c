// SPDX-License-Identifier: MIT
//
// Adjacency queries: the edge between two vertices, the edges, neighbours and faces around a vertex, the vertices of a
// face.

#include "base/exact_floats.h"

#include <talus/halfedge.h>

uint32_t tl_halfedge_mesh_find_edge(const tl_halfedge_mesh *mesh, uint32_t from, uint32_t to)
{
    if (!tl_halfedge_is_vertex(mesh, from) || !tl_halfedge_is_vertex(mesh, to)) {
        return TL_HALFEDGE_NONE;
    }
    uint32_t a = mesh->vertices[from].edge, b = mesh->vertices[to].edge;
    if (a == TL_HALFEDGE_NONE || b == TL_HALFEDGE_NONE) {
        return TL_HALFEDGE_NONE;
    }
    // Around both ends at once, until one ring is through: that one has the lower degree. A hash table of edges would
    // be as fast for a star of many edges and slower everywhere else.
    uint32_t a_start = a, b_start = b;
    do {
        if (mesh->edges[a].vertex == to) {
            return a;
        }
        if (mesh->edges[b].vertex == from) {
            return tl_halfedge_twin(b);
        }
        a = tl_halfedge_around(mesh, a);
        b = tl_halfedge_around(mesh, b);
    } while (a != a_start && b != b_start);
    return TL_HALFEDGE_NONE;
}

uint32_t tl_halfedge_mesh_vertex_edges(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t *edges_out,
                                       uint32_t capacity)
{
    if (!tl_halfedge_is_vertex(mesh, vertex) || mesh->vertices[vertex].edge == TL_HALFEDGE_NONE) {
        return 0;
    }
    uint32_t start = mesh->vertices[vertex].edge, edge = start, count = 0;
    do {
        if (count < capacity) {
            edges_out[count] = edge;
        }
        count++;
        edge = tl_halfedge_around(mesh, edge);
    } while (edge != start);
    return count;
}

uint32_t tl_halfedge_mesh_vertex_neighbours(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t *vertices_out,
                                            uint32_t capacity)
{
    uint32_t count = tl_halfedge_mesh_vertex_edges(mesh, vertex, vertices_out, capacity);
    for (uint32_t i = 0; i < count && i < capacity; i++) {
        vertices_out[i] = tl_halfedge_target(mesh, vertices_out[i]);
    }
    return count;
}

uint32_t tl_halfedge_mesh_vertex_faces(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t *faces_out,
                                       uint32_t capacity)
{
    if (!tl_halfedge_is_vertex(mesh, vertex) || mesh->vertices[vertex].edge == TL_HALFEDGE_NONE) {
        return 0;
    }
    uint32_t start = mesh->vertices[vertex].edge, edge = start, count = 0;
    do {
        uint32_t face = tl_halfedge_left_face(mesh, edge);
        if (face != TL_HALFEDGE_NONE && count < capacity) {
            faces_out[count] = face;
        }
        count += face != TL_HALFEDGE_NONE;
        edge = tl_halfedge_around(mesh, edge);
    } while (edge != start);
    return count;
}

uint32_t tl_halfedge_mesh_face_vertices(const tl_halfedge_mesh *mesh, uint32_t face, uint32_t *vertices_out,
                                        uint32_t capacity)
{
    if (!tl_halfedge_is_face(mesh, face)) {
        return 0;
    }
    // The face's half-edge points to its first vertex.
    uint32_t start = mesh->faces[face].edge, edge = start, count = 0;
    do {
        if (count < capacity) {
            vertices_out[count] = mesh->edges[edge].vertex;
        }
        count++;
        edge = mesh->edges[edge].next;
    } while (edge != start);
    return count;
}
