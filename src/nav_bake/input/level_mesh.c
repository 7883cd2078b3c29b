// SPDX-License-Identifier: MIT
//
// The caller's triangles: one check before all stages, and which of them are walkable by their slope.

#include "nav_bake/input/level_mesh.h"

#include "base/assert.h"
#include "base/host.h"
#include "math/tolerance.h"

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

tl_result tl_level_mesh_check(const tl_mesh_view *mesh, tl_aabb *bounds_out, tl_report *report)
{
    if (mesh->triangle_count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, "triangle", TL_NO_ELEMENT, "give a mesh with triangles");
    }
    if (mesh->triangle_count > TL_MAX_MESH_TRIANGLES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "triangle", TL_MAX_MESH_TRIANGLES, "split the mesh");
    }
    const bool sound = are_vertices_sound(mesh);
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t vertex = mesh->indices[3 * i + k];
            if (vertex >= mesh->vertex_count) {
                return tl_report_fail(report, TL_ERR_INDEX, "triangle", i, "check the index buffer");
            }
            if (!sound) {
                TL_TRY(check_vertex(mesh, vertex, report));
            }
            if (bounds_out != NULL) {
                bounds = tl_aabb_add_point(bounds, mesh->vertices[vertex]);
            }
        }
    }
    if (bounds_out != NULL) {
        *bounds_out = bounds;
    }
    return TL_OK;
}

/// Relative noise of the comparison: the limit's cosine was rounded to float once, and the triangle's own slope comes
/// from coordinates that were. A slope of exactly the limit lies within it, and is not below the limit.
#define SLOPE_COS_NOISE ((double)TL_FLOAT_GAMMA(2))

bool tl_triangle_is_walkable(tl_vec3 a, tl_vec3 b, tl_vec3 c, float slope_cos)
{
    double ux = (double)b.x - (double)a.x, uz = (double)b.z - (double)a.z;
    double vx = (double)c.x - (double)a.x, vz = (double)c.z - (double)a.z;
    double ny = uz * vx - ux * vz;
    if (!(ny > 0.0)) {
        return false; // walls and ceilings: the most of a level
    }
    double uy = (double)b.y - (double)a.y, vy = (double)c.y - (double)a.y;
    double nx = uy * vz - uz * vy, nz = ux * vy - uy * vx;
    double limit = (double)slope_cos * (1.0 + SLOPE_COS_NOISE);
    limit = limit < 1.0 ? limit : 1.0; // what is exactly flat is walkable at any limit
    // n.y / |n| >= limit without root and division; both sides are positive.
    return ny * ny >= limit * limit * (nx * nx + ny * ny + nz * nz);
}
