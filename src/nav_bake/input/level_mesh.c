// SPDX-License-Identifier: MIT
//
// The caller's triangles: one check before all stages, and which of them are walkable by their slope.

#include "nav_bake/input/level_mesh.h"

#include "base/assert.h"
#include "base/host.h"
#include "math/box4.h"

// Blocks of triangles, each of which may be a task.
enum { MAX_SCAN_BLOCKS = 64, MIN_SCAN_BLOCK = 2048 };

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

// The first triangle that is not sound, if any.
static tl_result name_bad_triangle(const tl_mesh_view *mesh, tl_report *report)
{
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count || corner[2] >= mesh->vertex_count) {
            return tl_report_fail(report, TL_ERR_INDEX, "triangle", i, "check the index buffer");
        }
        for (uint32_t k = 0; k < 3; k++) {
            TL_TRY(check_vertex(mesh, corner[k], report));
        }
    }
    return TL_OK;
}

typedef struct mesh_block {
    tl_aabb bounds; ///< of the block's triangles
    bool is_sound;  ///< all indices are those of vertices, all their coordinates finite and in range
} mesh_block;

typedef struct mesh_scan {
    const tl_mesh_view *mesh;
    uint32_t block_size; ///< triangles
    mesh_block blocks[MAX_SCAN_BLOCKS];
} mesh_scan;

static inline tl_box4 box_of_point(tl_vec3 p)
{
    return tl_box4_of((tl_aabb){ p, p });
}

// Of equal bounds, 0 and -0, the last is kept, so that blocks in order give what all triangles do.
static void scan_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    mesh_scan *scan = user;
    const tl_mesh_view *mesh = scan->mesh;
    const uint32_t *end = mesh->indices + 3 * (size_t)tl_block_end(index, scan->block_size, mesh->triangle_count);
    mesh_block *block = &scan->blocks[index];
    tl_box4 box = tl_box4_empty();
    float noise = 0.0f; // until something is infinite or no number
    block->is_sound = false;
    for (const uint32_t *corner = mesh->indices + 3 * (size_t)index * scan->block_size; corner < end; corner += 3) {
        if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count || corner[2] >= mesh->vertex_count) {
            return;
        }
        const tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
        const tl_vec3 sum = tl_add(a, tl_add(b, c));
        noise += 0.0f * (sum.x + sum.y + sum.z);
        const tl_box4 last_two = tl_box4_union(box_of_point(b), box_of_point(c));
        box = tl_box4_union(box, tl_box4_union(box_of_point(a), last_two));
    }
    const tl_aabb bounds = tl_box4_to_aabb(box);
    const tl_vec3 size = tl_max(tl_abs(bounds.min), tl_abs(bounds.max));
    block->bounds = bounds;
    block->is_sound = noise == 0.0f && tl_maxf(size.x, tl_maxf(size.y, size.z)) <= TL_MAX_COORDINATE;
}

tl_result tl_level_mesh_check(const tl_mesh_view *mesh, const tl_host *host, tl_aabb *bounds_out, tl_report *report)
{
    if (mesh->triangle_count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, "triangle", TL_NO_ELEMENT, "give a mesh with triangles");
    }
    if (mesh->triangle_count > TL_MAX_MESH_TRIANGLES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "triangle", TL_MAX_MESH_TRIANGLES, "split the mesh");
    }
    mesh_scan scan;
    scan.mesh = mesh;
    scan.block_size = mesh->triangle_count / MAX_SCAN_BLOCKS + 1;
    scan.block_size = scan.block_size > MIN_SCAN_BLOCK ? scan.block_size : MIN_SCAN_BLOCK;
    const uint32_t block_count = tl_block_count(mesh->triangle_count, scan.block_size);
    tl_run_tasks(host, scan_block, block_count, &scan);
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t k = 0; k < block_count; k++) {
        if (!scan.blocks[k].is_sound) {
            return name_bad_triangle(mesh, report);
        }
        bounds.min = tl_min(bounds.min, scan.blocks[k].bounds.min);
        bounds.max = tl_max(bounds.max, scan.blocks[k].bounds.max);
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
