// SPDX-License-Identifier: MIT
//
// halfedge.h.

#include "contract.h"

#include <string.h>

// A tetrahedron without its last face. What fails on the way is the call's result.
static tl_result make_mesh(contract_run *run, tl_halfedge_mesh *mesh)
{
    static const uint32_t faces[3][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 } };
    tl_halfedge_mesh_init(mesh, run->host->allocator);
    tl_result result = TL_OK;
    for (uint32_t v = 0; v < 4 && result == TL_OK; v++) {
        uint32_t index;
        result = tl_halfedge_mesh_add_vertex(
            mesh, tl_vec3_make(v == 1 ? 1.0f : 0.0f, v == 2 ? 1.0f : 0.0f, v == 3 ? 1.0f : 0.0f), &index);
    }
    for (int f = 0; f < 3 && result == TL_OK; f++) {
        result = tl_halfedge_mesh_add_face(mesh, faces[f], 3, NULL);
    }
    return result;
}

static tl_result done(contract_run *run, tl_halfedge_mesh *mesh, tl_result result)
{
    run->is_clear = true; // outputs are indices, set on success only
    run->answer = (uint64_t)mesh->half_edge_count << 32 | mesh->vertex_count;
    tl_halfedge_mesh_destroy(mesh);
    return result;
}

CONTRACT_DEFINE_FREE(mesh_destroy, tl_halfedge_mesh, tl_halfedge_mesh_destroy)

static tl_result add_vertex(contract_run *run)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    uint32_t vertex;
    if (result == TL_OK) {
        result =
            tl_halfedge_mesh_add_vertex(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh, tl_vec3_make(1.0f, 2.0f, 3.0f),
                                        run->what == CONTRACT_NULL_OUTPUT ? NULL : &vertex);
    }
    return done(run, &mesh, result);
}

static tl_result remove_vertex(contract_run *run)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    if (result == TL_OK) {
        result = tl_halfedge_mesh_remove_vertex(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh,
                                                run->what == CONTRACT_STALE ? 4 : 3);
    }
    return done(run, &mesh, result);
}

static tl_result add_face(contract_run *run)
{
    static const uint32_t last[3] = { 2, 0, 3 }, stale[3] = { 2, 0, 4 };
    const bool no_mesh = run->what == CONTRACT_NULL_INPUT && run->variant == 0;
    const bool no_vertices = run->what == CONTRACT_NULL_INPUT && run->variant == 1;
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    if (result == TL_OK) {
        result = tl_halfedge_mesh_add_face(no_mesh ? NULL : &mesh,
                                           no_vertices                   ? NULL
                                           : run->what == CONTRACT_STALE ? stale
                                                                         : last,
                                           3, NULL);
    }
    return done(run, &mesh, result);
}

static tl_result add_triangle(contract_run *run)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    if (result == TL_OK) {
        result = tl_halfedge_mesh_add_triangle(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh, 2, 0,
                                               run->what == CONTRACT_STALE ? 4 : 3, NULL);
    }
    return done(run, &mesh, result);
}

static tl_result remove_face(contract_run *run)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    if (result == TL_OK) {
        result = tl_halfedge_mesh_remove_face(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh,
                                              run->what == CONTRACT_STALE ? 3 : 2);
    }
    return done(run, &mesh, result);
}

static tl_result check(contract_run *run)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    if (result == TL_OK) {
        mesh.edges[0].next ^= run->what == CONTRACT_BAD_BYTES ? 1u : 0u;
        result = tl_halfedge_mesh_check(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh, run->report);
    }
    return done(run, &mesh, result);
}

typedef uint32_t list_fn(const tl_halfedge_mesh *mesh, uint32_t element, uint32_t *indices_out, uint32_t capacity);

// Functions that return a count and write what fits: incomplete when the count exceeds the capacity.
static tl_result list(contract_run *run, list_fn *function)
{
    tl_halfedge_mesh mesh;
    tl_result result = make_mesh(run, &mesh);
    uint32_t indices[8] = { 0 };
    const uint32_t all = function(&mesh, 1, indices, 8);
    const uint32_t capacity = run->what == CONTRACT_NO_BUFFER ? 0 : run->what == CONTRACT_SHORT_BUFFER ? all - 1 : 8;
    run->count = function(&mesh, 1, run->what == CONTRACT_NO_BUFFER ? NULL : indices, capacity);
    result = result == TL_OK && run->count > capacity ? TL_INCOMPLETE : result;
    result = done(run, &mesh, result);
    run->answer = contract_hash(indices, sizeof indices, run->count);
    return result;
}

static tl_result vertex_edges(contract_run *run)
{
    return list(run, tl_halfedge_mesh_vertex_edges);
}

static tl_result vertex_neighbours(contract_run *run)
{
    return list(run, tl_halfedge_mesh_vertex_neighbours);
}

static tl_result vertex_faces(contract_run *run)
{
    return list(run, tl_halfedge_mesh_vertex_faces);
}

static tl_result face_vertices(contract_run *run)
{
    return list(run, tl_halfedge_mesh_face_vertices);
}

enum {
    ADD_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_MEMORY),
    REMOVE_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE),
    LIST_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER)
};

const contract_entry CONTRACT_TABLE_halfedge[] = {
    { "tl_halfedge_mesh_init", 0, 0, 0, NULL, NULL, "sets a struct of the caller's" },
    { "tl_halfedge_mesh_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, mesh_destroy, NULL },
    { "tl_halfedge_mesh_clear", 0, 0, 0, NULL, NULL, "returns nothing; the mesh is the caller's duty" },
    { "tl_halfedge_mesh_add_vertex",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1, NULL,
      add_vertex, NULL },
    { "tl_halfedge_mesh_remove_vertex", REMOVE_CASES, 1, 0, NULL, remove_vertex, NULL },
    { "tl_halfedge_mesh_add_face", ADD_CASES, 2, 0, NULL, add_face, NULL },
    { "tl_halfedge_mesh_add_triangle", ADD_CASES, 1, 0, NULL, add_triangle, NULL },
    { "tl_halfedge_mesh_remove_face", REMOVE_CASES, 1, 0, NULL, remove_face, NULL },
    { "tl_halfedge_mesh_find_edge", 0, 0, 0, NULL, NULL, "returns an index; the mesh is the caller's duty" },
    { "tl_halfedge_mesh_vertex_edges", LIST_CASES, 0, 0, NULL, vertex_edges, NULL },
    { "tl_halfedge_mesh_vertex_neighbours", LIST_CASES, 0, 0, NULL, vertex_neighbours, NULL },
    { "tl_halfedge_mesh_vertex_faces", LIST_CASES, 0, 0, NULL, vertex_faces, NULL },
    { "tl_halfedge_mesh_face_vertices", LIST_CASES, 0, 0, NULL, face_vertices, NULL },
    { "tl_halfedge_mesh_next_boundary_loop", 0, 0, 0, NULL, NULL, "returns an index; the mesh is the caller's duty" },
    { "tl_halfedge_mesh_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(BAD_BYTES),
      1, 0, NULL, check, NULL },
    { "tl_halfedge_mesh_support", 0, 0, 0, NULL, NULL, "returns an index; the mesh is the caller's duty" },
    { 0 },
};
