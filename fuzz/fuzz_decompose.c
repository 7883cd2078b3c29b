// SPDX-License-Identifier: MIT
//
// Any few triangles with any settings into convex parts. A bake fails by name, or all that it promises holds: sound
// hulls, no corner of the mesh farther outside of all of them than it says, no point of them farther from the surface
// where only that is solid, no more parts than allowed; and the same bytes when tasks run backwards.

#include "fuzz/fuzz_input.h"

#include <math.h>
#include <string.h>
#include <talus/decompose.h>
#include <talus/soup.h>

enum { MAX_VERTICES = 24, MAX_TRIANGLES = 24, SAMPLES = 24 };

typedef struct body {
    fuzz_bytes bytes;
    tl_vec3 vertices[MAX_VERTICES];
    uint32_t indices[3 * MAX_TRIANGLES];
    tl_mesh_view view;
    tl_decompose_def def;
    bool backwards; // decomposed once more, by other tasks
    tl_decomposition parts;
    tl_decompose_report report;
    tl_soup *soup;
    double noise; // metres, of the distances measured here
} body;

static void read_triangles(body *b)
{
    const uint32_t vertex_count = 3 + next_byte(&b->bytes) % (MAX_VERTICES - 2),
                   count = 1 + next_byte(&b->bytes) % MAX_TRIANGLES;
    for (uint32_t i = 0; i < vertex_count; i++) {
        const float x = next_grid_coordinate(&b->bytes), y = next_grid_coordinate(&b->bytes);
        b->vertices[i] = tl_vec3_make(x, y, next_grid_coordinate(&b->bytes));
    }
    for (uint32_t i = 0; i < 3 * count; i++) {
        b->indices[i] = next_byte(&b->bytes) % vertex_count;
    }
    const tl_mesh_view view = { b->vertices, vertex_count, b->indices, count, NULL };
    b->view = view;
}

// Tolerances from a sixteenth of the usual size up, for the time grows with the parts; the grid stays small.
static void read_def(body *b)
{
    b->def = tl_default_decompose_def();
    const uint8_t tolerance = next_byte(&b->bytes), limits = next_byte(&b->bytes);
    b->def.tolerance = tolerance % 2 == 0 ? 0.0f : 0.125f * (float)(8 + tolerance);
    b->def.relative_tolerance = 0.03125f * (float)(2 + tolerance % 16);
    b->def.max_parts = limits % 8;
    b->def.max_vertices = limits / 8 % 4 == 0 ? 0 : 4u + limits / 8;
    b->def.thickness = 0.25f * (float)(next_byte(&b->bytes) % 5);
    b->def.solid = (tl_solid_rule)(limits / 64 % 2);
    b->def.max_cells = 4096u << next_byte(&b->bytes) % 2;
    b->backwards = next_byte(&b->bytes) % 4 == 1;
}

static void run_backwards(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    (void)user;
    for (uint32_t i = count; i-- > 0;) {
        task(i, i % 2, task_user);
    }
}

static void require_same_backwards(body *b)
{
    const tl_tasks tasks = { run_backwards, 2, NULL };
    tl_decompose_def def = b->def;
    tl_decomposition again;
    def.host.tasks = &tasks;
    require(tl_decomposition_bake(&b->view, &def, &again, NULL) == TL_OK);
    require(again.part_count == b->parts.part_count && again.hull_volume == b->parts.hull_volume);
    for (uint32_t i = 0; i < again.part_count; i++) {
        const tl_hull *hull = b->parts.parts[i].hull, *other = again.parts[i].hull;
        require(hull->blob.size == other->blob.size && memcmp(hull, other, (size_t)hull->blob.size) == 0);
        require(again.parts[i].concavity == b->parts.parts[i].concavity);
    }
    tl_decomposition_free(&again);
}

// How far a point lies outside of a hull at least: heights over planes are no more than the distance.
static double outside_of(const tl_hull *hull, tl_vec3 p)
{
    double height = -(double)INFINITY;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        const tl_hull_plane plane = tl_hull_face_plane(hull, f);
        height = fmax(height, plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y +
                                  plane.normal[2] * (double)p.z - plane.offset);
    }
    return height;
}

static void require_covered(const body *b)
{
    for (uint32_t t = 0; t < b->view.triangle_count; t++) {
        const uint32_t *corner = b->indices + 3 * (size_t)t;
        const tl_vec3 p = b->vertices[corner[0]], q = b->vertices[corner[1]], r = b->vertices[corner[2]];
        const tl_vec3 points[4] = { p, q, r, tl_scale(tl_add(tl_add(p, q), r), 1.0f / 3.0f) };
        if (tl_length(tl_cross(tl_sub(q, p), tl_sub(r, p))) == 0.0f) {
            continue; // without area, or near it: left out
        }
        for (uint32_t k = 0; k < 4; k++) {
            double outside = (double)INFINITY;
            for (uint32_t i = 0; i < b->parts.part_count; i++) {
                outside = fmin(outside, outside_of(b->parts.parts[i].hull, points[k]));
            }
            require(outside <= b->parts.max_outside + b->noise);
        }
    }
}

// Mixtures of a hull's vertices, which lie in it, are no farther from the surface than its concavity.
static void require_near(const body *b, const tl_convex_part *part)
{
    const tl_vec3 *vertices = tl_hull_vertices(part->hull);
    const uint32_t count = part->hull->vertex_count;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        const tl_vec3 edge = tl_lerp(vertices[i % count], vertices[(7 * i + 3) % count], 0.5f);
        const tl_vec3 p = tl_lerp(edge, vertices[(11 * i + 5) % count], 0.0625f * (float)(i % 16));
        tl_soup_point nearest;
        require(tl_soup_nearest(b->soup, p, INFINITY, NULL, &nearest) == TL_OK);
        require((double)nearest.distance <= part->concavity + b->noise);
    }
}

static void require_promises(body *b)
{
    const tl_aabb box = tl_soup_bounds(b->soup);
    const tl_vec3 size = tl_max(tl_abs(box.min), tl_abs(box.max));
    b->noise = 4e-6 * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    uint32_t over = 0;
    for (uint32_t i = 0; i < b->parts.part_count; i++) {
        const tl_convex_part *part = &b->parts.parts[i];
        require(tl_hull_check(part->hull, part->hull->blob.size, NULL) == TL_OK);
        require(b->def.max_vertices == 0 || part->hull->vertex_count <= b->def.max_vertices);
        over += part->concavity > (double)b->report.tolerance;
        if (b->def.solid == TL_SOLID_SURFACE) {
            require_near(b, part);
        }
    }
    require(b->parts.part_count > 0 && over == b->report.parts_over_tolerance);
    require(b->def.max_parts == 0 || b->parts.part_count <= b->def.max_parts);
    require_covered(b);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static body b;
    memset(&b, 0, sizeof b);
    b.bytes = (fuzz_bytes){ data, size };
    read_def(&b);
    read_triangles(&b);
    const tl_result result = tl_decomposition_bake(&b.view, &b.def, &b.parts, &b.report);
    if (result == TL_OK) {
        require(tl_soup_bake(&b.view, NULL, &b.soup, NULL) == TL_OK);
        require_promises(&b);
        if (b.backwards) {
            require_same_backwards(&b);
        }
        tl_blob_free(b.soup);
    } else {
        require(result == TL_ERR_DEGENERATE || result == TL_ERR_NOT_FINITE || result == TL_ERR_RANGE ||
                result == TL_ERR_LIMIT || (result == TL_ERR_ARGUMENT && b.def.thickness > b.report.tolerance));
        require(b.parts.part_count == 0 && b.parts.parts == NULL);
    }
    tl_decomposition_free(&b.parts);
    return 0;
}
