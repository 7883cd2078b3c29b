// SPDX-License-Identifier: MIT
//
// Three pools with free lists: arrays that double, entries that are linked when they are free. A removed index is the
// next one to be given out, so memory follows the peak and not the number of edits.
//
// Half-edges come in pairs: the twin of e is e ^ 1, which needs no field and cannot go stale.

#include "halfedge/pool.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

#define FIRST_POOL_CAPACITY 32u

void tl_halfedge_mesh_init(tl_halfedge_mesh *mesh, const tl_allocator *allocator)
{
    memset(mesh, 0, sizeof *mesh);
    mesh->allocator = tl_allocator_or_default(allocator);
    mesh->free_vertex = mesh->free_edge = mesh->free_face = TL_HALFEDGE_NONE;
}

void tl_halfedge_mesh_destroy(tl_halfedge_mesh *mesh)
{
    if (mesh != NULL && mesh->allocator.release != NULL) {
        tl_release_array(&mesh->allocator, mesh->vertices, mesh->vertex_capacity, sizeof *mesh->vertices);
        tl_release_array(&mesh->allocator, mesh->edges, mesh->edge_capacity, sizeof *mesh->edges);
        tl_release_array(&mesh->allocator, mesh->faces, mesh->face_capacity, sizeof *mesh->faces);
        tl_allocator allocator = mesh->allocator;
        tl_halfedge_mesh_init(mesh, &allocator);
    }
}

void tl_halfedge_mesh_clear(tl_halfedge_mesh *mesh)
{
    mesh->vertex_end = mesh->edge_end = mesh->face_end = 0;
    mesh->vertex_count = mesh->half_edge_count = mesh->face_count = mesh->boundary_count = 0;
    mesh->free_vertex = mesh->free_edge = mesh->free_face = TL_HALFEDGE_NONE;
}

// Grows a pool to hold `more` entries behind `used`.
static tl_result grow_pool(tl_halfedge_mesh *mesh, void **array, uint32_t *capacity, uint32_t used, uint32_t more,
                           size_t size)
{
    if (more <= *capacity - used) {
        return TL_OK;
    }
    if (more > TL_MAX_HALFEDGE_ENTRIES - used) {
        return TL_ERR_LIMIT;
    }
    uint32_t wanted = *capacity < FIRST_POOL_CAPACITY ? FIRST_POOL_CAPACITY : *capacity;
    while (wanted < used + more) {
        wanted = wanted > TL_MAX_HALFEDGE_ENTRIES / 2 ? TL_MAX_HALFEDGE_ENTRIES : wanted * 2;
    }
    void *larger = tl_allocate_array(&mesh->allocator, wanted, size);
    if (larger == NULL) {
        return TL_ERR_MEMORY;
    }
    if (used > 0) {
        memcpy(larger, *array, used * size);
    }
    tl_release_array(&mesh->allocator, *array, *capacity, size);
    *array = larger;
    *capacity = wanted;
    return TL_OK;
}

tl_result tl_halfedge_mesh_add_vertex(tl_halfedge_mesh *mesh, tl_vec3 position, uint32_t *vertex_out)
{
    if (mesh == NULL || vertex_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t index = mesh->free_vertex;
    if (index != TL_HALFEDGE_NONE) {
        mesh->free_vertex = mesh->vertices[index].link;
    } else {
        void *vertices = mesh->vertices;
        TL_TRY(grow_pool(mesh, &vertices, &mesh->vertex_capacity, mesh->vertex_end, 1, sizeof *mesh->vertices));
        mesh->vertices = vertices;
        index = mesh->vertex_end++;
    }
    tl_halfedge_vertex *vertex = &mesh->vertices[index];
    vertex->position = position;
    vertex->edge = TL_HALFEDGE_NONE;
    vertex->link = TL_HALFEDGE_LIVE;
    vertex->mark = 0;
    mesh->vertex_count++;
    *vertex_out = index;
    return TL_OK;
}

tl_result tl_halfedge_reserve(tl_halfedge_mesh *mesh, uint32_t faces, uint32_t edges)
{
    // One free pair or face may serve the first request; the others are counted in full.
    void *array = mesh->faces;
    if (mesh->free_face == TL_HALFEDGE_NONE || faces > 1) {
        TL_TRY(grow_pool(mesh, &array, &mesh->face_capacity, mesh->face_end, faces, sizeof *mesh->faces));
        mesh->faces = array;
    }
    uint32_t free_pairs = (mesh->edge_end - mesh->half_edge_count) / 2;
    if (edges > free_pairs) {
        if (edges > TL_MAX_HALFEDGE_ENTRIES / 2) {
            return TL_ERR_LIMIT;
        }
        array = mesh->edges;
        TL_TRY(grow_pool(mesh, &array, &mesh->edge_capacity, mesh->edge_end, 2 * (edges - free_pairs),
                         sizeof *mesh->edges));
        mesh->edges = array;
    }
    return TL_OK;
}

uint32_t tl_halfedge_take_face(tl_halfedge_mesh *mesh)
{
    uint32_t index = mesh->free_face;
    if (index != TL_HALFEDGE_NONE) {
        mesh->free_face = mesh->faces[index].link;
    } else {
        TL_ASSERT(mesh->face_end < mesh->face_capacity);
        index = mesh->face_end++;
    }
    mesh->faces[index].link = TL_HALFEDGE_LIVE;
    mesh->face_count++;
    return index;
}

uint32_t tl_halfedge_take_edge(tl_halfedge_mesh *mesh, uint32_t from, uint32_t to)
{
    uint32_t index = mesh->free_edge;
    if (index != TL_HALFEDGE_NONE) {
        mesh->free_edge = mesh->edges[index].next;
    } else {
        TL_ASSERT(mesh->edge_capacity - mesh->edge_end >= 2);
        index = mesh->edge_end;
        mesh->edge_end += 2;
    }
    mesh->edges[index].vertex = to;
    mesh->edges[index + 1].vertex = from;
    mesh->edges[index].face = mesh->edges[index + 1].face = TL_HALFEDGE_NONE;
    mesh->half_edge_count += 2;
    return index;
}

void tl_halfedge_give_vertex(tl_halfedge_mesh *mesh, uint32_t vertex)
{
    mesh->vertices[vertex].link = mesh->free_vertex;
    mesh->free_vertex = vertex;
    mesh->vertex_count--;
}

void tl_halfedge_give_face(tl_halfedge_mesh *mesh, uint32_t face)
{
    mesh->faces[face].link = mesh->free_face;
    mesh->free_face = face;
    mesh->face_count--;
}

void tl_halfedge_give_edge(tl_halfedge_mesh *mesh, uint32_t edge)
{
    edge &= ~1u;
    mesh->edges[edge].vertex = mesh->edges[edge + 1].vertex = TL_HALFEDGE_NONE;
    mesh->edges[edge].next = mesh->free_edge;
    mesh->free_edge = edge;
    mesh->half_edge_count -= 2;
}
