// SPDX-License-Identifier: MIT
//
// Cleaning: refuses vertices that cannot be computed with, and names them; drops and counts triangles that have no area
// or repeat another.
//
// "No area" is decided exactly: three points are collinear in space when all three coordinate-plane projections are,
// and each projection is an exact orientation. A relative threshold would drop needles that rays can hit, and leak
// there.

#include "mesh/clean.h"

#include "base/assert.h"
#include "base/hash.h"
#include "math/predicates.h"
#include "mesh/weld.h"

#include <string.h>

tl_result tl_mesh_view_check_indices(const tl_mesh_view *view, tl_report *report)
{
    if (view == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "view", "give a mesh view");
    }
    if (view->triangle_count > 0 && view->indices == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "view.indices", "give 3 a triangle");
    }
    if (view->triangle_count > TL_MAX_MESH_TRIANGLES) {
        return tl_report_field(report, TL_ERR_LIMIT, "view.triangle_count",
                               "split the mesh: its indices would not fit 32 bits");
    }
    return TL_OK;
}

tl_result tl_mesh_view_check(const tl_mesh_view *view, tl_report *report)
{
    TL_TRY(tl_mesh_view_check_indices(view, report));
    if (view->vertex_count > 0 && view->vertices == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "view.vertices", "give as many as vertex_count says");
    }
    if (view->vertex_count > TL_MAX_MESH_VERTICES) {
        return tl_report_field(report, TL_ERR_LIMIT, "view.vertex_count",
                               "split the mesh: its indices would not fit 32 bits");
    }
    return TL_OK;
}

static tl_result check_mesh_vertex(const tl_mesh_view *view, uint32_t vertex, tl_report *report)
{
    tl_vec3 p = view->vertices[vertex];
    if (!tl_is_finite(p)) {
        return tl_report_fail(report, TL_ERR_NOT_FINITE, "vertex", vertex, "repair or remove this vertex");
    }
    tl_vec3 size = tl_abs(p);
    if (!(size.x <= TL_MAX_COORDINATE && size.y <= TL_MAX_COORDINATE && size.z <= TL_MAX_COORDINATE)) {
        return tl_report_fail(report, TL_ERR_RANGE, "vertex", vertex, "keep coordinates within +-1e12");
    }
    return TL_OK;
}

tl_result tl_check_triangles(const tl_mesh_view *view, tl_stage *stage, uint32_t *used, tl_report *report)
{
    memset(used, 0xff, (size_t)view->vertex_count * sizeof *used);
    for (uint32_t triangle = 0; triangle < view->triangle_count; triangle++) {
        TL_TRY(tl_stage_tick(stage, triangle));
        for (uint32_t corner = 0; corner < 3; corner++) {
            uint32_t vertex = view->indices[3 * (size_t)triangle + corner];
            if (vertex >= view->vertex_count) {
                return tl_report_fail(report, TL_ERR_INDEX, "triangle", triangle,
                                      "make its indices smaller than the vertex count");
            }
            if (used[vertex] == TL_WELD_UNUSED) {
                TL_TRY(check_mesh_vertex(view, vertex, report));
                used[vertex] = TL_WELD_PENDING;
            }
        }
    }
    return TL_OK;
}

static bool has_area(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return tl_orient2d(a.x, a.y, b.x, b.y, c.x, c.y) != 0 || tl_orient2d(a.y, a.z, b.y, b.z, c.y, c.z) != 0 ||
           tl_orient2d(a.z, a.x, b.z, b.x, c.z, c.x) != 0;
}

// The three representatives, rotated so that the smallest comes first: equal for triangles that repeat one another.
static void canonical_corners(const tl_mesh_view *view, const uint32_t *representative, uint32_t triangle,
                              uint32_t corners[3])
{
    uint32_t v[3];
    for (uint32_t k = 0; k < 3; k++) {
        v[k] = representative[view->indices[3 * (size_t)triangle + k]];
    }
    uint32_t first = v[1] < v[0] ? (v[2] < v[1] ? 2 : 1) : (v[2] < v[0] ? 2 : 0);
    for (uint32_t k = 0; k < 3; k++) {
        corners[k] = v[(first + k) % 3];
    }
}

typedef struct triangle_set {
    uint32_t *slots; // a kept triangle or TL_NO_TRIANGLE; linear probing
    uint64_t mask;
} triangle_set;

static bool triangle_set_make(triangle_set *set, uint32_t count, tl_arena *arena)
{
    uint64_t size = 16;
    while (size / 2 < count) {
        size *= 2;
    }
    set->slots = TL_PUSH(arena, uint32_t, size);
    set->mask = size - 1;
    if (set->slots != NULL) {
        memset(set->slots, 0xff, (size_t)size * sizeof *set->slots);
    }
    return set->slots != NULL;
}

// Whether an equal triangle was there before; if not, adds this one.
static bool repeats_earlier(triangle_set *set, const tl_mesh_view *view, const uint32_t *representative,
                            uint32_t triangle, const uint32_t corners[3])
{
    uint64_t hash = tl_hash_mix(tl_hash_mix(((uint64_t)corners[0] << 32) | corners[1]) ^ corners[2]);
    for (uint64_t slot = hash & set->mask;; slot = (slot + 1) & set->mask) {
        uint32_t other = set->slots[slot];
        if (other == TL_NO_TRIANGLE) {
            set->slots[slot] = triangle;
            return false;
        }
        uint32_t other_corners[3];
        canonical_corners(view, representative, other, other_corners);
        if (memcmp(corners, other_corners, sizeof other_corners) == 0) {
            return true;
        }
    }
}

static bool is_degenerate(const tl_mesh_view *view, const uint32_t corners[3])
{
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0] ||
           !has_area(view->vertices[corners[0]], view->vertices[corners[1]], view->vertices[corners[2]]);
}

// Tasks drop degenerate triangles from blocks; what is left of these moves together afterwards.
enum { BLOCK_TRIANGLES = 1 << 11, CLEAN_BATCH = 3 };

typedef struct cleaner {
    const tl_mesh_view *view;
    const uint32_t *representative;
    uint32_t *kept;   // each block's from where its triangles begin
    uint32_t *counts; // kept, of each block
} cleaner;

static void clean_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const cleaner *c = user;
    uint32_t end = tl_block_end(block, BLOCK_TRIANGLES, c->view->triangle_count), first = block * BLOCK_TRIANGLES;
    uint32_t count = 0;
    for (uint32_t triangle = first; triangle < end; triangle++) {
        uint32_t corners[3];
        canonical_corners(c->view, c->representative, triangle, corners);
        if (!is_degenerate(c->view, corners)) {
            c->kept[first + count++] = triangle;
        }
    }
    c->counts[block] = count;
}

tl_result tl_clean_triangles(const tl_cleaning *cleaning, tl_arena *arena, uint32_t *kept, uint32_t *kept_count_out,
                             tl_mesh_report *report)
{
    const tl_mesh_view *view = cleaning->view;
    const uint32_t *representative = cleaning->representative;
    const bool keep_duplicates = cleaning->keep_duplicates;
    uint32_t blocks = tl_block_count(view->triangle_count, BLOCK_TRIANGLES);
    cleaner c = { view, representative, kept, TL_PUSH(arena, uint32_t, blocks) };
    triangle_set set = { NULL, 0 };
    if (c.counts == NULL || (!keep_duplicates && !triangle_set_make(&set, view->triangle_count, arena))) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_run(cleaning->stage, clean_block, blocks, &c, CLEAN_BATCH, view->triangle_count / 2));
    uint32_t sound = 0;
    for (uint32_t block = 0; block < blocks; block++) {
        memmove(kept + sound, kept + (size_t)block * BLOCK_TRIANGLES, c.counts[block] * sizeof *kept);
        sound += c.counts[block];
    }
    report->degenerate_triangles += view->triangle_count - sound;
    uint32_t count = keep_duplicates ? sound : 0;
    for (uint32_t i = 0; i < sound && !keep_duplicates; i++) {
        uint32_t corners[3];
        TL_TRY(tl_stage_tick(cleaning->stage, i));
        canonical_corners(view, representative, kept[i], corners);
        if (repeats_earlier(&set, view, representative, kept[i], corners)) {
            report->duplicate_triangles++;
        } else {
            kept[count++] = kept[i];
        }
    }
    *kept_count_out = count;
    return TL_OK;
}
