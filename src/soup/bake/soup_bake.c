// SPDX-License-Identifier: MIT
//
// From a triangle list to a soup: weld, pair, build the tree, encode.

#include "soup/bake/soup_bake.h"

#include "base/assert.h"
#include "base/host.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

// Bytes a triangle of the largest stage, measured: a matching of all triangles, or the tree.
enum { STAGE_BYTES = 136 };

tl_soup_def tl_default_soup_def(void)
{
    tl_soup_def def = { true, TL_SOUP_BVH, TL_SOUP_FAST, 0.0f, { NULL, NULL, NULL }, TL_DEF_COOKIE };
    return def;
}

static tl_result check_input(const tl_mesh_view *view, const tl_soup_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_soup_def()", report));
    if (view == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "view", "give the triangles");
    }
    if (!(def->split_budget >= 0.0f && def->split_budget <= 1.0f)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "split_budget", "make it a share from 0 to 1");
    }
    if (def->partition != TL_SOUP_BVH && def->partition != TL_SOUP_KD_TREE) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "partition", "make it TL_SOUP_BVH or TL_SOUP_KD_TREE");
    }
    if (def->layout != TL_SOUP_FAST && def->layout != TL_SOUP_COMPACT) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "layout", "make it TL_SOUP_FAST or TL_SOUP_COMPACT");
    }
    if (view->triangle_count > TL_MAX_SOUP_TRIANGLES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "triangle", TL_MAX_SOUP_TRIANGLES,
                              "split the level into several soups");
    }
    return TL_OK;
}

// The welded mesh, which also checks every index and vertex. Duplicates stay: each is a triangle that can be hit.
static tl_result weld(const tl_mesh_view *view, const tl_host *host, tl_mesh *mesh, tl_soup_report *report)
{
    tl_mesh_def mesh_def = tl_default_mesh_def();
    mesh_def.keep_duplicates = true;
    mesh_def.host = *host;
    tl_mesh_report mesh_report;
    tl_result result = tl_mesh_bake(view, &mesh_def, mesh, &mesh_report);
    report->base = mesh_report.base;
    report->degenerate_triangles = mesh_report.degenerate_triangles;
    if (result == TL_ERR_EMPTY && view->triangle_count > 0 && mesh_report.degenerate_triangles > 0) {
        return tl_report_fail(&report->base, TL_ERR_DEGENERATE, NULL, TL_NO_ELEMENT,
                              "no triangle has area: check the scale and the export of the level");
    }
    return result;
}

static tl_result bake_welded(const tl_mesh_view *view, const tl_mesh *mesh, const tl_soup_def *def, tl_arena *arena,
                             tl_soup **soup_out, tl_soup_report *report)
{
    const tl_host *host = &def->host;
    report->base.stage = "pair triangles";
    TL_TRY(tl_progress_update(host, "pair triangles", 0, 1));
    // One block for all stages, so that each reuses the pages of the one before.
    if (!tl_arena_reserve(arena, (uint64_t)mesh->triangle_count * STAGE_BYTES)) {
        return TL_ERR_MEMORY;
    }
    tl_triangle_pair *pairs = NULL;
    uint32_t pair_count = 0;
    TL_TRY(tl_pair_triangles(mesh, def->pair_triangles, host, arena, &pairs, &pair_count));
    TL_TRY(tl_progress_update(host, "pair triangles", 1, 1));

    report->base.stage = "build BVH";
    TL_TRY(tl_progress_update(host, "build BVH", 0, 1));
    tl_bvh tree;
    TL_TRY(def->partition == TL_SOUP_KD_TREE ? tl_kd_build(mesh, pairs, pair_count, def, arena, &tree)
                                             : tl_bvh_build(mesh, pairs, pair_count, def, arena, &tree));
    TL_TRY(tl_progress_update(host, "build BVH", 1, 1));

    report->base.stage = "bake soup";
    TL_TRY(tl_progress_update(host, "bake soup", 0, 1));
    const tl_soup_parts parts = { view, mesh, pairs, pair_count, &tree };
    TL_TRY(tl_soup_encode(&parts, def, arena, soup_out));
    report->triangle_count = (*soup_out)->triangle_count;
    report->pair_count = (*soup_out)->pair_count;
    report->single_count = (*soup_out)->single_count;
    return TL_OK;
}

tl_result tl_soup_bake(const tl_mesh_view *view, const tl_soup_def *def, tl_soup **soup_out, tl_soup_report *report_out)
{
    tl_soup_def used = def != NULL ? *def : tl_default_soup_def();
    tl_soup_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "weld");
    tl_soup *soup = NULL;
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_result result = soup_out != NULL ? check_input(view, &used, &report.base)
                                        : tl_report_field(&report.base, TL_ERR_ARGUMENT, "soup_out", "give a pointer");
    if (result == TL_OK) {
        result = weld(view, &used.host, &mesh, &report);
    }
    if (result == TL_OK) {
        tl_arena arena;
        tl_arena_init(&arena, used.host.allocator);
        result = bake_welded(view, &mesh, &used, &arena, &soup, &report);
        uint64_t soup_bytes = soup != NULL ? soup->blob.size : 0;
        uint64_t held = mesh.block_size + arena.peak_bytes + soup_bytes;
        report.base.peak_bytes = held > report.base.peak_bytes ? held : report.base.peak_bytes;
        tl_arena_free(&arena);
    }
    tl_mesh_free(&mesh);
    if (result == TL_OK) {
        // The last progress update may still cancel.
        result = tl_progress_update(&used.host, "bake soup", 1, 1);
    }
    if (result != TL_OK) {
        tl_blob_free(soup);
        soup = NULL;
    }
    if (soup_out != NULL) {
        *soup_out = soup;
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}
