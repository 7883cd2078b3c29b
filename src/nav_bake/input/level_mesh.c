// SPDX-License-Identifier: MIT
//
// The caller's triangles: one check before all stages, and which of them are walkable by their slope.

#include "nav_bake/input/level_mesh.h"

#include "base/assert.h"
#include "base/host.h"

static tl_result check_vertex(const tl_mesh_view *mesh, uint32_t vertex, tl_report *report)
{
    tl_vec3 p = mesh->vertices[vertex];
    if (!tl_is_finite(p)) {
        return tl_report_fail(report, TL_ERR_NOT_FINITE, "vertex", vertex, "remove the vertices that are not numbers");
    }
    tl_vec3 size = tl_abs(p);
    if (tl_maxf(size.x, tl_maxf(size.y, size.z)) > TL_MAX_COORDINATE) {
        return tl_report_fail(report, TL_ERR_RANGE, "vertex", vertex, "move or scale the level towards the origin");
    }
    return TL_OK;
}

// Whether all vertices, of triangles or not, are finite and in range: mostly they are, and no corner needs a check.
static bool are_vertices_sound(const tl_mesh_view *mesh)
{
    uint32_t sound = 1;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const tl_vec3 size = tl_abs(mesh->vertices[i]); // not a number is not below anything
        sound &= (uint32_t)(size.x <= TL_MAX_COORDINATE) & (uint32_t)(size.y <= TL_MAX_COORDINATE) &
                 (uint32_t)(size.z <= TL_MAX_COORDINATE);
    }
    return sound != 0;
}

// Whether all indices are those of vertices.
static bool are_indices_sound(const tl_mesh_view *mesh)
{
    const size_t count = 3 * (size_t)mesh->triangle_count;
    uint32_t largest = 0;
    for (size_t i = 0; i < count; i++) {
        largest = mesh->indices[i] > largest ? mesh->indices[i] : largest;
    }
    return largest < mesh->vertex_count;
}

tl_result tl_level_mesh_check(const tl_mesh_view *mesh, tl_aabb *bounds_out, tl_report *report)
{
    if (mesh->triangle_count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, "triangle", TL_NO_ELEMENT, "give a mesh with triangles");
    }
    if (mesh->triangle_count > TL_MAX_MESH_TRIANGLES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "triangle", TL_MAX_MESH_TRIANGLES, "split the mesh");
    }
    // A part of a level has its vertices, which are many more than the corners.
    const bool sound = mesh->vertex_count / 3 <= mesh->triangle_count && are_vertices_sound(mesh);
    if (bounds_out == NULL && sound && are_indices_sound(mesh)) {
        return TL_OK;
    }
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count || corner[2] >= mesh->vertex_count) {
            return tl_report_fail(report, TL_ERR_INDEX, "triangle", i, "check the index buffer");
        }
        for (uint32_t k = 0; k < 3 && !sound; k++) {
            TL_TRY(check_vertex(mesh, corner[k], report));
        }
        const tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
        bounds.min = tl_min(bounds.min, tl_min(a, tl_min(b, c)));
        bounds.max = tl_max(bounds.max, tl_max(a, tl_max(b, c)));
    }
    if (bounds_out != NULL) {
        *bounds_out = bounds;
    }
    return TL_OK;
}

bool tl_triangle_is_walkable_in_double(tl_vec3 a, tl_vec3 b, tl_vec3 c, float slope_cos)
{
    const double ux = (double)b.x - (double)a.x, uy = (double)b.y - (double)a.y, uz = (double)b.z - (double)a.z;
    const double vx = (double)c.x - (double)a.x, vy = (double)c.y - (double)a.y, vz = (double)c.z - (double)a.z;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, limit = (double)slope_cos;
    // n.y / |n| > limit without root and division; what is flat is walkable at any limit.
    return ny > 0.0 && (ny * ny > limit * limit * (nx * nx + ny * ny + nz * nz) || (nx == 0.0 && nz == 0.0));
}
