// SPDX-License-Identifier: MIT
//
// A baked hull as an editable mesh: to cut it, to add to it, to walk it with the mesh's own functions.

#include "base/arena.h"
#include "base/assert.h"

#include <talus/hull.h>

static tl_result add_hull_vertices(const tl_hull *hull, tl_halfedge_mesh *mesh)
{
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        uint32_t index;
        TL_TRY(tl_halfedge_mesh_add_vertex(mesh, tl_hull_vertices(hull)[v], &index));
        TL_ASSERT(index == v); // an empty mesh hands its indices out in order
    }
    return TL_OK;
}

// A face's half-edges are consecutive.
static tl_result add_hull_faces(const tl_hull *hull, tl_halfedge_mesh *mesh, uint32_t *corners)
{
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t k = 0; k < face.count; k++) {
            corners[k] = tl_hull_edge_origin(hull, face.first + k);
        }
        TL_TRY(tl_halfedge_mesh_add_face(mesh, corners, face.count, NULL));
    }
    return TL_OK;
}

tl_result tl_hull_to_halfedge(const tl_hull *hull, tl_halfedge_mesh *mesh)
{
    if (hull == NULL || mesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_halfedge_mesh_clear(mesh);
    uint32_t max_corners = hull->vertex_count; // of a face
    uint32_t *corners = tl_allocate_array(&mesh->allocator, max_corners, sizeof *corners);
    if (corners == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = add_hull_vertices(hull, mesh);
    result = result == TL_OK ? add_hull_faces(hull, mesh, corners) : result;
    tl_release_array(&mesh->allocator, corners, max_corners, sizeof *corners);
    if (result != TL_OK) {
        tl_halfedge_mesh_clear(mesh);
    }
    return result;
}
