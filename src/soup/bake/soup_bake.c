// SPDX-License-Identifier: MIT
//
// From a triangle list to a soup: weld, merge triangles that coincide, pair, build the tree, encode.

#include "soup/bake/soup_bake.h"

#include "base/assert.h"
#include "base/memory_meter.h"
#include "base/stage.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

tl_soup_def tl_default_soup_def(void)
{
    tl_soup_def def = { true, TL_SOUP_BVH,          TL_SOUP_FAST, TL_SOUP_QUALITY_DEFAULT,
                        0.0f, { NULL, NULL, NULL }, TL_DEF_COOKIE };
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
    if (def->quality != TL_SOUP_QUALITY_DEFAULT && def->quality != TL_SOUP_QUALITY_FAST &&
        def->quality != TL_SOUP_QUALITY_HIGH) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "quality", "make it one of tl_soup_quality");
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

// From here on the mesh is its vertices: pairs know which triangles of the view they hold.
static tl_result keep_vertices(tl_mesh *mesh, tl_stage *stage)
{
    const uint64_t bytes = (uint64_t)mesh->vertex_count * sizeof *mesh->vertices;
    tl_mesh kept = *mesh;
    kept.indices = NULL;
    kept.materials = NULL;
    kept.source_triangles = NULL;
    kept.block_size = (size_t)bytes;
    kept.block = tl_allocate(&mesh->allocator, kept.block_size, TL_BLOB_ALIGNMENT);
    if (kept.block == NULL) {
        return TL_ERR_MEMORY;
    }
    kept.vertices = kept.block;
    tl_result result = tl_stage_copy(stage, kept.vertices, mesh->vertices, bytes);
    tl_mesh_free(mesh);
    *mesh = kept;
    return result;
}

// The share of references that spatial splits may add, where they pay.
static float split_budget_of(tl_soup_quality quality)
{
    return quality == TL_SOUP_QUALITY_HIGH ? 0.5f : 0.2f;
}

// Arenas for what is needed to the end, and for two trees, of which one is thrown away.
typedef struct bake_arenas {
    tl_arena main, tree[2];
} bake_arenas;

static tl_result build_soup_tree(const tl_soup_def *def, tl_bvh_input *input, const tl_host *host, bake_arenas *arenas,
                                 tl_bvh *tree)
{
    const bool chooses = def->quality != TL_SOUP_QUALITY_FAST && def->split_budget == 0.0f;
    tl_stage stage;
    if (def->partition == TL_SOUP_KD_TREE || !chooses) {
        input->split_budget = def->split_budget;
        TL_TRY(tl_stage_begin(&stage, host, "build BVH", 2 * (uint64_t)input->pair_count));
        TL_TRY(def->partition == TL_SOUP_KD_TREE ? tl_kd_build(input, &stage, &arenas->main, tree)
                                                 : tl_bvh_build(input, &stage, &arenas->main, tree));
    } else {
        input->split_budget = split_budget_of(def->quality);
        TL_TRY(tl_stage_begin(&stage, host, "build BVH", 4 * (uint64_t)input->pair_count));
        TL_TRY(tl_bvh_build_better(input, &stage, arenas->tree, tree));
    }
    return tl_stage_end(&stage);
}

// The mesh is left as its vertices.
static tl_result bake_welded(const tl_mesh_view *view, tl_mesh *mesh, const tl_soup_def *def, const tl_host *host,
                             bake_arenas *arenas, tl_soup **soup_out, tl_soup_report *report)
{
    tl_arena *arena = &arenas->main;
    const uint64_t triangles = mesh->triangle_count;
    tl_stage stage;
    report->base.stage = "pair triangles";
    TL_TRY(tl_stage_begin(&stage, host, "pair triangles", triangles));
    tl_coincident coincident;
    TL_TRY(tl_merge_coincident(mesh, view->triangle_count, &stage, arena, &coincident));
    tl_bvh_input input = { mesh, NULL, 0, 0.0f };
    tl_triangle_pair *pairs = NULL;
    TL_TRY(tl_pair_triangles(mesh, def->pair_triangles, &stage, arena, &pairs, &input.pair_count));
    tl_order_coincident(&coincident, view->triangle_count, pairs, input.pair_count);
    TL_TRY(keep_vertices(mesh, &stage));
    TL_TRY(tl_stage_end(&stage));
    input.pairs = pairs;

    report->base.stage = "build BVH";
    tl_bvh tree;
    TL_TRY(build_soup_tree(def, &input, host, arenas, &tree));

    report->base.stage = "bake soup";
    TL_TRY(tl_stage_begin(&stage, host, "bake soup", triangles));
    const tl_soup_parts parts = { view, mesh, pairs, input.pair_count, coincident, &tree };
    TL_TRY(tl_soup_encode(&parts, def->layout, &stage, arena, soup_out));
    report->triangle_count = (*soup_out)->triangle_count;
    report->pair_count = (*soup_out)->pair_count;
    report->single_count = (*soup_out)->single_count;
    report->coincident_count = tl_soup_get_stats(*soup_out).coincident_count;
    // The last progress call may still cancel.
    return tl_stage_end(&stage);
}

static tl_result bake_checked(const tl_mesh_view *view, const tl_soup_def *def, tl_soup **soup_out,
                              tl_soup_report *report)
{
    tl_memory_meter meter;
    tl_memory_meter_init(&meter, def->host.allocator);
    tl_host host = def->host;
    host.allocator = &meter.allocator;
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_result result = weld(view, &host, &mesh, report);
    if (result == TL_OK) {
        bake_arenas arenas;
        tl_arena_init(&arenas.main, host.allocator);
        tl_arena_init(&arenas.tree[0], host.allocator);
        tl_arena_init(&arenas.tree[1], host.allocator);
        result = bake_welded(view, &mesh, def, &host, &arenas, soup_out, report);
        tl_arena_free(&arenas.main);
        tl_arena_free(&arenas.tree[0]);
        tl_arena_free(&arenas.tree[1]);
    }
    tl_mesh_free(&mesh);
    report->base.peak_bytes = tl_memory_meter_peak(&meter);
    tl_blob_hand_over(*soup_out, def->host.allocator);
    return result;
}

tl_result tl_soup_bake(const tl_mesh_view *view, const tl_soup_def *def, tl_soup **soup_out, tl_soup_report *report_out)
{
    tl_soup_def used = def != NULL ? *def : tl_default_soup_def();
    tl_soup_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "weld");
    tl_soup *soup = NULL;
    tl_result result = soup_out != NULL ? check_input(view, &used, &report.base)
                                        : tl_report_field(&report.base, TL_ERR_ARGUMENT, "soup_out", "give a pointer");
    if (result == TL_OK) {
        result = bake_checked(view, &used, &soup, &report);
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
