// SPDX-License-Identifier: MIT
//
// The decomposition: distances on a grid, cuts until the tolerance holds, merging, and what the caller is told.
//
// V-HACD cuts voxels, so its hulls are off by a voxel, and a volume decides, which says nothing about the farthest
// point. CoACD measures what collisions notice, the largest distance, but from samples, by a tree search with random
// rollouts, of closed manifold meshes. Here the mesh itself is cut, a grid of true distances compares hundreds of
// planes at once, and branch and bound proves what a hull reaches. A hull is measured against the whole body, not
// against its own piece: it may reach into its neighbour for nothing, so fewer parts keep the same tolerance.

#include "base/assert.h"
#include "base/memory_meter.h"
#include "base/min_max.h"
#include "base/radix_sort.h"
#include "decompose/decomposer.h"
#include "math/tolerance.h"

#include <math.h>
#include <string.h>

enum {
    FEWEST_GRID_CELLS = 4096,
    MOST_GRID_CELLS = 1 << 26,
    TOLERANCE_ROUNDINGS = 64, // of the largest coordinate: cuts and distances are each off by a few
    THICKNESS_SHARE = 16,     // of the tolerance, by default
    FINAL_PROOF_BUDGET = 1 << 15,
    FINAL_PRECISION_SHARE = 16, // of the tolerance: a closer bound helps no one
};

tl_decompose_def tl_default_decompose_def(void)
{
    tl_decompose_def def;
    memset(&def, 0, sizeof def);
    def.relative_tolerance = 0.025f;
    def.max_vertices = 256;
    def.solid = TL_SOLID_ENCLOSED;
    def.max_cells = 1u << 20;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

void tl_decomposition_free(tl_decomposition *decomposition)
{
    if (decomposition == NULL) {
        return;
    }
    for (uint32_t i = 0; i < decomposition->part_count; i++) {
        tl_blob_free(decomposition->parts[i].hull);
    }
    tl_release_array(&decomposition->allocator, decomposition->parts, decomposition->part_count,
                     sizeof *decomposition->parts);
    memset(decomposition, 0, sizeof *decomposition);
}

static tl_result check_decompose_def(const tl_decompose_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_decompose_def()", report));
    if (!(def->tolerance >= 0.0f) || !isfinite(def->tolerance)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "tolerance", "give metres, 0 or more");
    }
    if (def->tolerance == 0.0f && !(def->relative_tolerance > 0.0f && def->relative_tolerance <= 1.0f)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "relative_tolerance", "make it > 0 and at most 1");
    }
    if (def->max_vertices != 0 && def->max_vertices < 4) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_vertices", "give 0 for no limit, or at least 4");
    }
    if (!(def->thickness >= 0.0f) || !isfinite(def->thickness)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "thickness", "give metres, 0 or more");
    }
    if (def->solid != TL_SOLID_ENCLOSED && def->solid != TL_SOLID_SURFACE) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "solid", "give one of tl_solid_rule");
    }
    if (def->max_cells < FEWEST_GRID_CELLS || def->max_cells > MOST_GRID_CELLS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_cells", "give 4,096 to 67,108,864");
    }
    return TL_OK;
}

// The tolerance in metres, and that the coordinates' rounding allows it.
static tl_result choose_tolerance(tl_decomposer *d, const tl_soup *soup)
{
    const tl_aabb box = tl_soup_bounds(soup);
    const tl_vec3 size = tl_max(tl_abs(box.min), tl_abs(box.max)), extent = tl_sub(box.max, box.min);
    const float longest = tl_maxf(extent.x, tl_maxf(extent.y, extent.z));
    const float largest = tl_maxf(size.x, tl_maxf(size.y, size.z));
    const float tolerance = d->def->tolerance > 0.0f ? d->def->tolerance : d->def->relative_tolerance * longest;
    if (!(tolerance >= (float)TOLERANCE_ROUNDINGS * TL_FLOAT_ROUNDING * largest)) {
        return tl_report_field(&d->report->base, TL_ERR_RANGE, "tolerance",
                               "make it larger, or move the mesh to the origin");
    }
    d->tolerance = (double)tolerance;
    d->thickness = d->def->thickness > 0.0f ? d->def->thickness : tolerance / (float)THICKNESS_SHARE;
    d->report->tolerance = tolerance;
    // Flat parts thicker than the tolerance would be cut again and again, and never keep it.
    return d->thickness <= tolerance
               ? TL_OK
               : tl_report_field(&d->report->base, TL_ERR_ARGUMENT, "thickness", "make it at most the tolerance");
}

// The whole mesh, in the pieces that hang together, where they are few.
static tl_result begin_with_pieces(tl_decomposer *d, const tl_soup *soup, uint32_t triangle_count)
{
    tl_part whole, made[TL_MAX_PART_PIECES];
    uint32_t made_count = 0;
    TL_TRY(tl_part_from_soup(soup, triangle_count, d->allocator, &whole));
    tl_result result = tl_part_divide(&whole, d->allocator, made, &made_count);
    for (uint32_t i = 0; i < made_count; i++) {
        result = result == TL_OK ? tl_decomposer_add(d, &made[i]) : result;
        if (result != TL_OK) {
            tl_part_free(&made[i], d->allocator);
        }
    }
    return result;
}

typedef struct part_finish {
    const tl_decomposer *d;
    tl_convex_part *parts;
    const tl_sort_item *order;
    tl_result *results;
} part_finish;

// The hull that the caller gets, and both of its bounds.
static tl_result finish_part(const tl_decomposer *d, const tl_part *part, tl_convex_part *out)
{
    const tl_concavity_goal goal = { 0.0, (double)INFINITY, d->tolerance / (double)FINAL_PRECISION_SHARE,
                                     FINAL_PROOF_BUDGET };
    tl_hull_def def = tl_default_hull_def();
    tl_hull_report report;
    tl_concavity concavity;
    def.max_vertices = d->def->max_vertices;
    def.thickness = d->thickness;
    def.host.allocator = d->allocator;
    TL_TRY(tl_hull_bake(tl_hull_vertices(part->hull), part->hull->vertex_count, &def, &out->hull, &report));
    TL_TRY(tl_concavity_prove(out->hull, &d->grid, &goal, d->allocator, &concavity));
    out->concavity = part->is_whole ? tl_min_f64(concavity.bound, part->concavity) : concavity.bound;
    out->max_outside = report.max_outside + (double)part->cut_count * d->grid.noise;
    return TL_OK;
}

static void finish_one(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const part_finish *f = user;
    f->results[index] = finish_part(f->d, &f->d->parts[f->order[index].value], &f->parts[index]);
}

// The parts by volume, the largest first.
static void order_parts(const tl_decomposer *d, tl_sort_item *items)
{
    for (uint32_t i = 0; i < d->part_count; i++) {
        const float volume = (float)d->parts[i].hull->mass.volume;
        items[i] = (tl_sort_item){ UINT32_MAX - tl_float_sort_key(volume), i, 0 };
    }
    tl_radix_sort(items, items + d->part_count, d->part_count);
}

static void sum_up(tl_decomposition *out, tl_decompose_report *report)
{
    for (uint32_t i = 0; i < out->part_count; i++) {
        const tl_convex_part *part = &out->parts[i];
        out->concavity = tl_max_f64(out->concavity, part->concavity);
        out->max_outside = tl_max_f64(out->max_outside, part->max_outside);
        out->hull_volume += part->hull->mass.volume;
        report->parts_over_tolerance += part->concavity > (double)report->tolerance;
    }
}

static tl_result finish_parts(tl_decomposer *d, tl_decomposition *out)
{
    tl_stage stage;
    const uint32_t count = d->part_count;
    tl_arena arena;
    tl_arena_init(&arena, d->allocator);
    tl_sort_item *order = TL_PUSH(&arena, tl_sort_item, 2 * (uint64_t)count);
    part_finish f = { d, NULL, order, TL_PUSH(&arena, tl_result, count) };
    out->parts = tl_allocate_array(d->allocator, count, sizeof *out->parts);
    tl_result result = order != NULL && f.results != NULL && out->parts != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        out->part_count = count;
        memset(out->parts, 0, count * sizeof *out->parts);
        f.parts = out->parts;
        order_parts(d, order);
        d->report->base.stage = "proof";
        result = tl_stage_begin(&stage, &d->def->host, "proof", count);
        result = result == TL_OK ? tl_stage_run(&stage, finish_one, count, &f, 1, count) : result;
        for (uint32_t i = 0; i < count && result == TL_OK; i++) {
            result = f.results[i];
        }
    }
    tl_arena_free(&arena);
    TL_TRY(result);
    sum_up(out, d->report);
    return tl_stage_end(&stage);
}

static tl_result decompose_soup(tl_decomposer *d, const tl_soup *soup, uint32_t triangle_count, tl_arena *arena,
                                tl_decomposition *out)
{
    tl_stage stage;
    TL_TRY(choose_tolerance(d, soup));
    d->report->base.stage = "distances";
    TL_TRY(tl_stage_begin(&stage, &d->def->host, "distances", 1));
    TL_TRY(tl_distance_grid_build(soup, d->def, d->tolerance, d->thickness, arena, &stage, &d->grid));
    TL_TRY(tl_stage_end(&stage));
    d->report->cell = (float)d->grid.cell;
    TL_TRY(begin_with_pieces(d, soup, triangle_count));
    TL_TRY(tl_decomposer_cut(d));
    TL_TRY(tl_decomposer_merge(d));
    return finish_parts(d, out);
}

// Bakes the soup that distances are measured to, decomposes it, and frees all but the result.
static tl_result decompose_mesh(const tl_mesh_view *view, const tl_decompose_def *def, tl_decomposition *out,
                                tl_decompose_report *report)
{
    tl_soup_def soup_def = tl_default_soup_def();
    soup_def.quality = TL_SOUP_QUALITY_FAST;
    soup_def.host = def->host;
    tl_soup *soup;
    tl_soup_report soup_report;
    const tl_result baked = tl_soup_bake(view, &soup_def, &soup, &soup_report);
    if (baked != TL_OK) {
        report->base = soup_report.base;
        return baked;
    }
    report->degenerate_triangles = soup_report.degenerate_triangles;
    tl_decomposer d;
    memset(&d, 0, sizeof d);
    d.def = def;
    d.allocator = def->host.allocator;
    d.report = report;
    tl_arena arena;
    tl_arena_init(&arena, d.allocator);
    const tl_result result = decompose_soup(&d, soup, soup_report.triangle_count, &arena, out);
    tl_arena_free(&arena);
    for (uint32_t i = 0; i < d.part_count; i++) {
        tl_part_free(&d.parts[i], d.allocator);
    }
    tl_release_array(d.allocator, d.parts, d.part_capacity, sizeof *d.parts);
    tl_blob_free(soup);
    return result;
}

tl_result tl_decomposition_bake(const tl_mesh_view *view, const tl_decompose_def *def,
                                tl_decomposition *decomposition_out, tl_decompose_report *report_out)
{
    const tl_decompose_def defaults = tl_default_decompose_def();
    tl_decompose_report unused;
    tl_decompose_report *report = report_out != NULL ? report_out : &unused;
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, "decomposition");
    TL_REFUSE_NULL(decomposition_out, &report->base);
    memset(decomposition_out, 0, sizeof *decomposition_out);
    TL_REFUSE_NULL(view, &report->base);
    def = def != NULL ? def : &defaults;
    TL_TRY(check_decompose_def(def, &report->base));
    tl_memory_meter meter;
    tl_memory_meter_init(&meter, def->host.allocator);
    tl_decompose_def metered = *def;
    metered.host.allocator = &meter.allocator;
    decomposition_out->allocator = meter.host;
    const tl_result result = decompose_mesh(view, &metered, decomposition_out, report);
    for (uint32_t i = 0; i < decomposition_out->part_count; i++) {
        tl_blob_hand_over(decomposition_out->parts[i].hull, &meter.host);
    }
    if (result != TL_OK) {
        tl_decomposition_free(decomposition_out);
    }
    report->base.peak_bytes = tl_memory_meter_peak(&meter);
    return result;
}
