// SPDX-License-Identifier: MIT
//
// Every invariant of the editable mesh, counted twice: what the loops reach must be what the pools hold.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <talus/halfedge.h>

#include <string.h>

typedef struct census {
    uint32_t vertices, half_edges, faces, boundary;
} census;

static tl_result wrong_entry(tl_report *report, const char *element, uint64_t index)
{
    return tl_report_fail(report, TL_ERR_CORRUPT, element, index, "change a mesh through its functions only");
}

static tl_result wrong_count(tl_report *report, const char *field)
{
    return tl_report_field(report, TL_ERR_CORRUPT, field, "change a mesh through its functions only");
}

static bool check_free_vertices(const tl_halfedge_mesh *mesh, uint32_t live)
{
    uint32_t count = 0;
    for (uint32_t v = mesh->free_vertex; v != TL_HALFEDGE_NONE; v = mesh->vertices[v].link) {
        if (v >= mesh->vertex_end || mesh->vertices[v].link == TL_HALFEDGE_LIVE || count++ >= mesh->vertex_end) {
            return false;
        }
    }
    return count + live == mesh->vertex_end;
}

static bool check_free_faces(const tl_halfedge_mesh *mesh, uint32_t live)
{
    uint32_t count = 0;
    for (uint32_t f = mesh->free_face; f != TL_HALFEDGE_NONE; f = mesh->faces[f].link) {
        if (f >= mesh->face_end || mesh->faces[f].link == TL_HALFEDGE_LIVE || count++ >= mesh->face_end) {
            return false;
        }
    }
    return count + live == mesh->face_end;
}

static bool check_free_edges(const tl_halfedge_mesh *mesh, uint32_t live)
{
    uint32_t count = 0;
    for (uint32_t e = mesh->free_edge; e != TL_HALFEDGE_NONE; e = mesh->edges[e].next) {
        if (e >= mesh->edge_end || e % 2 != 0 || tl_halfedge_is_edge(mesh, e) || tl_halfedge_is_edge(mesh, e + 1) ||
            count++ >= mesh->edge_end) {
            return false;
        }
    }
    return 2 * (uint64_t)count + live == mesh->edge_end;
}

static bool check_half_edge(const tl_halfedge_mesh *mesh, uint32_t e)
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

static uint32_t walk_vertex_ring(const tl_halfedge_mesh *mesh, uint32_t vertex, uint8_t *seen)
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

static tl_result check_half_edges(const tl_halfedge_mesh *mesh, census *live, tl_report *report)
{
    for (uint32_t e = 0; e < mesh->edge_end; e++) {
        if (tl_halfedge_is_edge(mesh, e)) {
            if (!check_half_edge(mesh, e)) {
                return wrong_entry(report, "half-edge", e);
            }
            live->half_edges++;
            live->boundary += mesh->edges[e].face == TL_HALFEDGE_NONE;
        }
    }
    return TL_OK;
}

static tl_result check_face_loops(const tl_halfedge_mesh *mesh, uint8_t *seen, census *live, tl_report *report)
{
    uint32_t in_faces = 0;
    for (uint32_t f = 0; f < mesh->face_end; f++) {
        if (tl_halfedge_is_face(mesh, f)) {
            uint32_t count = walk_face(mesh, f, seen);
            if (count == 0) {
                return wrong_entry(report, "face", f);
            }
            in_faces += count;
            live->faces++;
        }
    }
    return in_faces + live->boundary == live->half_edges ? TL_OK : wrong_count(report, "faces");
}

static tl_result check_vertex_rings(const tl_halfedge_mesh *mesh, uint8_t *seen, census *live, tl_report *report)
{
    uint32_t in_rings = 0;
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        if (!tl_halfedge_is_vertex(mesh, v)) {
            continue;
        }
        live->vertices++;
        if (mesh->vertices[v].edge != TL_HALFEDGE_NONE) {
            uint32_t count = walk_vertex_ring(mesh, v, seen);
            if (count == 0) {
                return wrong_entry(report, "vertex", v);
            }
            in_rings += count;
        }
    }
    return in_rings == live->half_edges ? TL_OK : wrong_count(report, "vertices");
}

static tl_result check_pool_counts(const tl_halfedge_mesh *mesh, const census *live, tl_report *report)
{
    const struct {
        const char *field;
        bool right;
    } table[] = {
        { "free_vertex", check_free_vertices(mesh, live->vertices) },
        { "free_face", check_free_faces(mesh, live->faces) },
        { "free_edge", check_free_edges(mesh, live->half_edges) },
        { "vertex_count", live->vertices == mesh->vertex_count },
        { "half_edge_count", live->half_edges == mesh->half_edge_count },
        { "face_count", live->faces == mesh->face_count },
        { "boundary_count", live->boundary == mesh->boundary_count },
    };
    for (size_t i = 0; i < TL_COUNT_OF(table); i++) {
        if (!table[i].right) {
            return wrong_count(report, table[i].field);
        }
    }
    return TL_OK;
}

static tl_result check_halfedge_mesh(const tl_halfedge_mesh *mesh, uint8_t *seen, tl_report *report)
{
    census live = { 0, 0, 0, 0 };
    TL_TRY(check_half_edges(mesh, &live, report));
    TL_TRY(check_face_loops(mesh, seen, &live, report));
    TL_TRY(check_vertex_rings(mesh, seen, &live, report));
    return check_pool_counts(mesh, &live, report);
}

tl_result tl_halfedge_mesh_check(const tl_halfedge_mesh *mesh, tl_report *report_out)
{
    tl_report_begin(report_out, "check half-edge mesh");
    if (mesh == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "mesh", "give a mesh");
    }
    if (mesh->vertex_end > mesh->vertex_capacity || mesh->edge_end > mesh->edge_capacity ||
        mesh->face_end > mesh->face_capacity || mesh->edge_end % 2 != 0) {
        return wrong_count(report_out, "capacity");
    }
    uint8_t *seen = tl_allocate_array(&mesh->allocator, mesh->edge_end, sizeof *seen);
    if (seen == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(seen, 0, mesh->edge_end);
    tl_result result = check_halfedge_mesh(mesh, seen, report_out);
    tl_release_array(&mesh->allocator, seen, mesh->edge_end, sizeof *seen);
    return result;
}
