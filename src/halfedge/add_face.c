// SPDX-License-Identifier: MIT
//
// Adding a face: first everything that could refuse it, then memory, then the links; so a refused face has changed
// nothing.
//
// At each corner the face has an edge coming in and one going out, and each of the two is new or already there as a
// boundary half-edge. If both are there but other fans lie between them in the ring, these fans move to another gap of
// the vertex; if there is no other gap, the two edges are the ends of one fan, which would close beside the others.
// Source: the patch relinking of OpenMesh (Botsch, Steinberg, Bischoff, Kobbelt, 2002).

#include "halfedge/pool.h"

#include "base/assert.h"

// A boundary half-edge that points to the vertex, or none when it has no gap.
static uint32_t find_gap(const tl_halfedge_mesh *mesh, uint32_t vertex)
{
    uint32_t start = mesh->vertices[vertex].edge, edge = start;
    do {
        uint32_t incoming = tl_halfedge_twin(edge);
        if (mesh->edges[incoming].face == TL_HALFEDGE_NONE) {
            return incoming;
        }
        edge = tl_halfedge_around(mesh, edge);
    } while (edge != start);
    return TL_HALFEDGE_NONE;
}

// The boundary half-edge into the corner at which the fan of the boundary half-edge `outgoing` begins.
static uint32_t other_end_of_fan(const tl_halfedge_mesh *mesh, uint32_t outgoing)
{
    uint32_t incoming = tl_halfedge_twin(outgoing);
    while (mesh->edges[incoming].face != TL_HALFEDGE_NONE) {
        incoming = tl_halfedge_twin(mesh->edges[incoming].next);
    }
    return incoming;
}

// Edges of a face that are looked up once; those of a larger face are looked up again where they are needed.
enum { KNOWN_EDGES = 64 };

typedef struct new_face {
    const uint32_t *vertices;
    uint32_t count;
    uint32_t missing;            // edges that are not there yet
    uint32_t known[KNOWN_EDGES]; // the half-edge from each vertex to the next, or none
} new_face;

static uint32_t find_face_side(const tl_halfedge_mesh *mesh, const new_face *face, uint32_t i)
{
    return tl_halfedge_mesh_find_edge(mesh, face->vertices[i], face->vertices[i + 1 < face->count ? i + 1 : 0]);
}

static uint32_t face_side(const tl_halfedge_mesh *mesh, const new_face *face, uint32_t i)
{
    return i < KNOWN_EDGES ? face->known[i] : find_face_side(mesh, face, i);
}

static tl_result check_face_vertices(tl_halfedge_mesh *mesh, const new_face *face)
{
    if (mesh == NULL || face->vertices == NULL || face->count < 3) {
        return TL_ERR_ARGUMENT;
    }
    for (uint32_t i = 0; i < face->count; i++) {
        if (!tl_halfedge_is_vertex(mesh, face->vertices[i])) {
            return TL_ERR_STALE;
        }
    }
    if (++mesh->stamp == 0) {
        for (uint32_t v = 0; v < mesh->vertex_end; v++) {
            mesh->vertices[v].mark = 0;
        }
        mesh->stamp = 1;
    }
    for (uint32_t i = 0; i < face->count; i++) {
        tl_halfedge_vertex *vertex = &mesh->vertices[face->vertices[i]];
        if (vertex->mark == mesh->stamp) {
            return TL_ERR_DEGENERATE;
        }
        vertex->mark = mesh->stamp;
    }
    return TL_OK;
}

// What the edges say; which are there.
static tl_result check_face_edges(const tl_halfedge_mesh *mesh, new_face *face)
{
    face->missing = 0;
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t edge = find_face_side(mesh, face, i);
        if (i < KNOWN_EDGES) {
            face->known[i] = edge;
        }
        if (edge == TL_HALFEDGE_NONE) {
            face->missing++;
        } else if (mesh->edges[edge].face != TL_HALFEDGE_NONE) {
            bool single = mesh->edges[tl_halfedge_twin(edge)].face == TL_HALFEDGE_NONE;
            return single ? TL_ERR_WINDING : TL_ERR_NON_MANIFOLD;
        }
    }
    return TL_OK;
}

static tl_result check_face_corner(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t incoming, uint32_t outgoing)
{
    if (incoming == TL_HALFEDGE_NONE && outgoing == TL_HALFEDGE_NONE) {
        bool isolated = mesh->vertices[vertex].edge == TL_HALFEDGE_NONE;
        return isolated || find_gap(mesh, vertex) != TL_HALFEDGE_NONE ? TL_OK : TL_ERR_NON_MANIFOLD;
    }
    if (incoming != TL_HALFEDGE_NONE && outgoing != TL_HALFEDGE_NONE && mesh->edges[incoming].next != outgoing &&
        other_end_of_fan(mesh, outgoing) == incoming) {
        return TL_ERR_NON_MANIFOLD;
    }
    return TL_OK;
}

static tl_result check_face_corners(const tl_halfedge_mesh *mesh, const new_face *face)
{
    uint32_t incoming = face_side(mesh, face, face->count - 1);
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t outgoing = face_side(mesh, face, i);
        TL_TRY(check_face_corner(mesh, face->vertices[i], incoming, outgoing));
        incoming = outgoing;
    }
    return TL_OK;
}

// Brings `outgoing` right behind `incoming`: the fans between them go to the gap at the other end of outgoing's fan.
static void close_up(tl_halfedge_mesh *mesh, uint32_t incoming, uint32_t outgoing)
{
    uint32_t first = mesh->edges[incoming].next, last = mesh->edges[outgoing].prev;
    if (first == outgoing) {
        return;
    }
    uint32_t gap = other_end_of_fan(mesh, outgoing);
    uint32_t behind_gap = mesh->edges[gap].next;
    tl_halfedge_join(mesh, gap, first);
    tl_halfedge_join(mesh, last, behind_gap);
    tl_halfedge_join(mesh, incoming, outgoing);
}

// Links the boundary around a corner whose edges have just been made where they were missing.
static void link_corner(tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t incoming, bool incoming_new,
                        uint32_t outgoing, bool outgoing_new)
{
    uint32_t in = tl_halfedge_twin(outgoing), out = tl_halfedge_twin(incoming); // the sides without the face
    if (incoming_new && outgoing_new) {
        if (mesh->vertices[vertex].edge == TL_HALFEDGE_NONE) {
            tl_halfedge_join(mesh, in, out);
            mesh->vertices[vertex].edge = outgoing;
        } else {
            uint32_t gap = find_gap(mesh, vertex);
            uint32_t behind_gap = mesh->edges[gap].next;
            tl_halfedge_join(mesh, gap, out);
            tl_halfedge_join(mesh, in, behind_gap);
        }
    } else if (incoming_new) {
        tl_halfedge_join(mesh, mesh->edges[outgoing].prev, out);
    } else if (outgoing_new) {
        tl_halfedge_join(mesh, in, mesh->edges[incoming].next);
    } else {
        close_up(mesh, incoming, outgoing);
    }
    tl_halfedge_join(mesh, incoming, outgoing);
}

static uint32_t link_face(tl_halfedge_mesh *mesh, const new_face *face)
{
    uint32_t index = tl_halfedge_take_face(mesh), count = face->count;
    const uint32_t *vertices = face->vertices;
    // The edge into the first corner, then each edge out of a corner; a corner is linked when both are there.
    uint32_t last = face_side(mesh, face, count - 1);
    bool last_new = last == TL_HALFEDGE_NONE;
    if (last_new) {
        last = tl_halfedge_take_edge(mesh, vertices[count - 1], vertices[0]);
    }
    uint32_t incoming = last;
    bool incoming_new = last_new;
    mesh->faces[index].edge = last;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t outgoing = i + 1 < count ? face_side(mesh, face, i) : last;
        bool outgoing_new = i + 1 < count ? outgoing == TL_HALFEDGE_NONE : last_new;
        if (outgoing == TL_HALFEDGE_NONE) {
            outgoing = tl_halfedge_take_edge(mesh, vertices[i], vertices[i + 1]);
        }
        link_corner(mesh, vertices[i], incoming, incoming_new, outgoing, outgoing_new);
        mesh->edges[outgoing].face = index;
        if (outgoing_new) {
            mesh->boundary_count++; // its other side
        } else {
            mesh->boundary_count--; // this side was open
        }
        incoming = outgoing;
        incoming_new = outgoing_new;
    }
    return index;
}

tl_result tl_halfedge_mesh_add_face(tl_halfedge_mesh *mesh, const uint32_t *vertices, uint32_t count,
                                    uint32_t *face_out)
{
    new_face face;
    face.vertices = vertices;
    face.count = count;
    TL_TRY(check_face_vertices(mesh, &face));
    TL_TRY(check_face_edges(mesh, &face));
    TL_TRY(check_face_corners(mesh, &face));
    TL_TRY(tl_halfedge_reserve(mesh, 1, face.missing));
    uint32_t index = link_face(mesh, &face);
    if (face_out != NULL) {
        *face_out = index;
    }
    return TL_OK;
}

tl_result tl_halfedge_mesh_add_triangle(tl_halfedge_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t *face_out)
{
    uint32_t vertices[3] = { a, b, c };
    return tl_halfedge_mesh_add_face(mesh, vertices, 3, face_out);
}
