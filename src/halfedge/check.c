// SPDX-License-Identifier: MIT
//
// Every invariant of the editable mesh, counted twice: what the loops reach must be what the pools hold.

#include "base/arena.h"
#include "base/assert.h"

#include <talus/halfedge.h>

#include <string.h>

typedef struct census {
    uint32_t vertices, half_edges, faces, boundary;
} census;

static bool check_free_lists(const tl_halfedge_mesh *mesh, const census *live)
{
    uint32_t count = 0, limit = mesh->vertex_end;
    for (uint32_t v = mesh->free_vertex; v != TL_HALFEDGE_NONE; v = mesh->vertices[v].link) {
        if (v >= mesh->vertex_end || mesh->vertices[v].link == TL_HALFEDGE_LIVE || count++ >= limit) {
            return false;
        }
    }
    if (count + live->vertices != mesh->vertex_end) {
        return false;
    }
    count = 0;
    for (uint32_t f = mesh->free_face; f != TL_HALFEDGE_NONE; f = mesh->faces[f].link) {
        if (f >= mesh->face_end || mesh->faces[f].link == TL_HALFEDGE_LIVE || count++ >= mesh->face_end) {
            return false;
        }
    }
    if (count + live->faces != mesh->face_end) {
        return false;
    }
    count = 0;
    for (uint32_t e = mesh->free_edge; e != TL_HALFEDGE_NONE; e = mesh->edges[e].next) {
        if (e >= mesh->edge_end || e % 2 != 0 || tl_halfedge_is_edge(mesh, e) || tl_halfedge_is_edge(mesh, e + 1) ||
            count++ >= mesh->edge_end) {
            return false;
        }
    }
    return 2 * (uint64_t)count + live->half_edges == mesh->edge_end;
}

static bool check_edge(const tl_halfedge_mesh *mesh, uint32_t e)
{
    const tl_halfedge_edge *edge = &mesh->edges[e], *twin = &mesh->edges[e ^ 1u];
    if (!tl_halfedge_is_vertex(mesh, edge->vertex) || !tl_halfedge_is_edge(mesh, e ^ 1u) ||
        edge->vertex == twin->vertex || !tl_halfedge_is_edge(mesh, edge->next) ||
        !tl_halfedge_is_edge(mesh, edge->prev)) {
        return false;
    }
    if (edge->face == TL_HALFEDGE_NONE ? twin->face == TL_HALFEDGE_NONE : !tl_halfedge_is_face(mesh, edge->face)) {
        return false;
    }
    return mesh->edges[edge->next].prev == e && mesh->edges[edge->prev].next == e &&
           mesh->edges[edge->next].face == edge->face && tl_halfedge_origin(mesh, edge->next) == edge->vertex;
}

// The face's loop, marking its half-edges; how many.
static uint32_t walk_face(const tl_halfedge_mesh *mesh, uint32_t face, uint8_t *seen)
{
    uint32_t start = mesh->faces[face].edge, edge = start, count = 0;
    if (!tl_halfedge_is_edge(mesh, start)) {
        return 0;
    }
    do {
        if (mesh->edges[edge].face != face || (seen[edge] & 1u)) {
            return 0;
        }
        seen[edge] |= 1u;
        count++;
        edge = mesh->edges[edge].next;
    } while (edge != start);
    return count >= 3 ? count : 0;
}

static uint32_t walk_ring(const tl_halfedge_mesh *mesh, uint32_t vertex, uint8_t *seen)
{
    uint32_t start = mesh->vertices[vertex].edge, edge = start, count = 0;
    if (!tl_halfedge_is_edge(mesh, start)) {
        return 0;
    }
    do {
        if (tl_halfedge_origin(mesh, edge) != vertex || (seen[edge] & 2u)) {
            return 0;
        }
        seen[edge] |= 2u;
        count++;
        edge = tl_halfedge_around(mesh, edge);
    } while (edge != start);
    return count;
}

static bool check_links(const tl_halfedge_mesh *mesh, uint8_t *seen, census *live)
{
    for (uint32_t e = 0; e < mesh->edge_end; e++) {
        if (tl_halfedge_is_edge(mesh, e)) {
            if (!check_edge(mesh, e)) {
                return false;
            }
            live->half_edges++;
            live->boundary += mesh->edges[e].face == TL_HALFEDGE_NONE;
        }
    }
    uint32_t in_faces = 0, in_rings = 0;
    for (uint32_t f = 0; f < mesh->face_end; f++) {
        if (tl_halfedge_is_face(mesh, f)) {
            uint32_t count = walk_face(mesh, f, seen);
            if (count == 0) {
                return false;
            }
            in_faces += count;
            live->faces++;
        }
    }
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        if (!tl_halfedge_is_vertex(mesh, v)) {
            continue;
        }
        live->vertices++;
        if (mesh->vertices[v].edge != TL_HALFEDGE_NONE) {
            uint32_t count = walk_ring(mesh, v, seen);
            if (count == 0) {
                return false;
            }
            in_rings += count;
        }
    }
    return in_faces + live->boundary == live->half_edges && in_rings == live->half_edges;
}

tl_result tl_halfedge_mesh_check(const tl_halfedge_mesh *mesh)
{
    if (mesh->vertex_end > mesh->vertex_capacity || mesh->edge_end > mesh->edge_capacity ||
        mesh->face_end > mesh->face_capacity || mesh->edge_end % 2 != 0) {
        return TL_ERR_CORRUPT;
    }
    uint8_t *seen = tl_allocate_array(&mesh->allocator, mesh->edge_end, sizeof *seen);
    if (seen == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(seen, 0, mesh->edge_end);
    census live = { 0, 0, 0, 0 };
    bool sound = check_links(mesh, seen, &live) && check_free_lists(mesh, &live) &&
                 live.vertices == mesh->vertex_count && live.half_edges == mesh->half_edge_count &&
                 live.faces == mesh->face_count && live.boundary == mesh->boundary_count;
    tl_release_array(&mesh->allocator, seen, mesh->edge_end, sizeof *seen);
    return sound ? TL_OK : TL_ERR_CORRUPT;
}
