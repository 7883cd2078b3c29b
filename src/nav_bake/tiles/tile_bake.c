// SPDX-License-Identifier: MIT
//
// One tile, from triangles to the baked blob: the pipeline's table of contents.
// Source of the order of stages: Mikko Mononen, Recast.
//
// Intermediate data is freed as soon as its last reader is done: a band of solid spans when its floors are known, the
// distance field after the regions, the contours after the polygons, the compact heightfield after the detail mesh.

#include "nav_bake/tiles/tile_bake.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/memory_meter.h"
#include "nav_bake/floors/compact.h"
#include "nav_bake/floors/erode.h"
#include "nav_bake/input/input_check.h"
#include "nav_bake/regions/distance_field.h"
#include "nav_bake/regions/regions.h"

#include <string.h>

typedef struct tile_job {
    const tl_nav_config *config;
    const tl_nav_input *input;
    tl_triangle_list list;
    tl_host host;
    bool keep;            // all intermediate data
    bool keep_distance;   // the distance field at least
    tl_floor_bands bands; // for erosion and the distance field
    tl_nav_stages *stages;
    tl_nav_tile *tile;       // until it is in the stack
    tl_nav_tile_stack stack; // it alone, or its layers
    tl_nav_bake_report *report;
} tile_job;

// The filtered heightfield, for the caller.
static tl_result keep_heightfield(tile_job *job)
{
    const tl_nav_config *config = job->config;
    tl_nav_heightfield *heightfield = &job->stages->heightfield;
    TL_TRY(tl_nav_rasterize_list(config, &job->input->mesh, job->input->areas, job->list, &job->host, heightfield,
                                 &job->report->base));
    if (config->filter_low_hanging_obstacles) {
        tl_nav_filter_low_hanging_obstacles(config, heightfield);
    }
    if (config->filter_ledge_spans) {
        tl_nav_filter_ledge_spans(config, heightfield);
    }
    if (config->filter_walkable_low_height_spans) {
        tl_nav_filter_walkable_low_height_spans(config, heightfield);
    }
    job->report->span_count += heightfield->span_count;
    return TL_OK;
}

// Straight from the triangles, a band at a time, unless the heightfield is kept.
static tl_result bake_floors(tile_job *job)
{
    const tl_nav_config *config = job->config;
    const tl_nav_input *input = job->input;
    tl_nav_compact *compact = &job->stages->compact;
    tl_report *report = &job->report->base;
    tl_report_begin(report, "rasterize");
    if (job->keep) {
        TL_TRY(keep_heightfield(job));
        TL_TRY(tl_nav_bake_compact(config, &job->stages->heightfield, &job->host, compact, report));
    } else {
        TL_TRY(tl_nav_open_triangles(config, input, job->list, &job->host, compact, &job->report->span_count, report));
        tl_release_array(&compact->allocator, compact->clearance, compact->span_count, sizeof *compact->clearance);
        compact->clearance = NULL; // links were its last reader
    }
    job->report->compact_span_count += compact->span_count;
    return TL_OK;
}

static tl_result erode_floors(tile_job *job)
{
    tl_report_begin(&job->report->base, "erode");
    TL_TRY(tl_progress_update(&job->host, "erode", 0, 1));
    TL_TRY(tl_nav_erode_bands(job->config, &job->host, &job->bands, &job->stages->compact));
    return tl_progress_update(&job->host, "erode", 1, 1);
}

static tl_result mark_areas(tile_job *job)
{
    const tl_nav_input *input = job->input;
    tl_report_begin(&job->report->base, "areas");
    for (uint32_t i = 0; i < input->volume_count; i++) {
        TL_TRY(tl_progress_update(&job->host, "areas", i, input->volume_count));
        tl_nav_mark_volume_area(&job->stages->compact, &input->volumes[i]);
    }
    return tl_progress_update(&job->host, "areas", input->volume_count, input->volume_count);
}

static tl_result measure_distances(tile_job *job)
{
    if (job->config->partition != TL_NAV_WATERSHED) {
        return TL_OK;
    }
    tl_report_begin(&job->report->base, "distance field");
    TL_TRY(tl_progress_update(&job->host, "distance field", 0, 1));
    TL_TRY(tl_nav_distance_of_bands(&job->host, &job->bands, &job->stages->compact));
    return tl_progress_update(&job->host, "distance field", 1, 1);
}

static tl_result bake_regions(tile_job *job)
{
    tl_nav_compact *compact = &job->stages->compact;
    TL_TRY(tl_nav_divide_regions(job->config, &job->host, compact, job->keep_distance, &job->report->base));
    job->report->region_count += compact->region_count > 0 ? compact->region_count - 1 : 0;
    job->report->filtered_regions += compact->region_stats.filtered_regions;
    job->report->filtered_spans += compact->region_stats.filtered_spans;
    job->report->filtered_area +=
        (double)compact->region_stats.filtered_spans * (double)compact->cell_size * (double)compact->cell_size;
    return TL_OK;
}

static tl_result bake_contours(tile_job *job)
{
    tl_nav_contours *contours = &job->stages->contours;
    TL_TRY(tl_nav_bake_contours(job->config, &job->stages->compact, &job->host, contours, &job->report->base));
    job->report->contour_count += contours->set.contour_count;
    job->report->unbridged_holes += contours->unbridged_count;
    job->report->slit_outlines += contours->slit_count;
    return TL_OK;
}

static tl_result bake_polygon_mesh(tile_job *job)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = job->config->max_verts_per_poly;
    def.method = job->config->polygon_method;
    def.host = job->host;
    tl_polygon_report report;
    tl_result result = tl_polygon_mesh_bake(&job->stages->contours.set, &def, &job->stages->polygons, &report);
    job->report->base = report.base;
    TL_TRY(result);
    job->report->repaired_contours += report.repaired_contours;
    job->report->polygon_count += report.polygon_count;
    job->report->vertex_count += report.vertex_count;
    if (!job->keep) {
        tl_nav_contours_free(&job->stages->contours);
    }
    return TL_OK;
}

static tl_result bake_detail(tile_job *job)
{
    tl_nav_detail *detail = &job->stages->detail;
    TL_TRY(tl_nav_bake_detail(job->config, &job->stages->compact, &job->stages->polygons, &job->host, detail,
                              &job->report->base));
    job->report->detail_triangle_count += detail->triangle_count;
    job->report->limited_patches += detail->limited_patches;
    if (!job->keep) {
        tl_nav_compact_free(&job->stages->compact);
    }
    return TL_OK;
}

// The tile as it is, in the layer that all its polygons belong to.
static tl_result stack_whole(tile_job *job, uint32_t layer)
{
    job->stack.tiles = tl_allocate_array(job->host.allocator, 1, sizeof *job->stack.tiles);
    if (job->stack.tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    job->tile->layer = layer;
    job->stack.allocator = tl_allocator_or_default(job->host.allocator);
    job->stack.tiles[0] = job->tile;
    job->stack.count = 1;
    job->tile = NULL;
    return TL_OK;
}

static tl_result divide_tile(tile_job *job, uint32_t *layers)
{
    const tl_polygon_mesh *polygons = &job->stages->polygons;
    TL_TRY(tl_nav_assign_layers(job->config, polygons, job->host.allocator, layers, NULL));
    bool is_whole = true;
    for (uint32_t p = 1; p < polygons->polygon_count; p++) {
        is_whole = is_whole && layers[p] == layers[0];
    }
    if (is_whole) {
        return stack_whole(job, layers[0]);
    }
    TL_TRY(tl_nav_tile_divide(job->tile, layers, job->host.allocator, &job->stack, &job->report->base));
    tl_blob_free(job->tile);
    job->tile = NULL;
    return TL_OK;
}

static tl_result stack_tile(tile_job *job)
{
    if (job->config->layer_height == 0) {
        return stack_whole(job, 0);
    }
    const uint32_t count = job->stages->polygons.polygon_count;
    uint32_t *layers = tl_allocate_array(job->host.allocator, count, sizeof *layers);
    const tl_result result = layers != NULL ? divide_tile(job, layers) : TL_ERR_MEMORY;
    tl_release_array(job->host.allocator, layers, count, sizeof *layers);
    return result;
}

// What was made, or nothing of it.
static tl_result hand_over(tile_job *job, tl_result result, tl_nav_tile_stack *stack_out)
{
    tl_blob_free(job->tile);
    if (result != TL_OK) {
        tl_nav_tile_stack_free(&job->stack);
    }
    *stack_out = job->stack;
    return result;
}

static tl_result bake_tile(tile_job *job)
{
    const tl_nav_config *config = job->config;
    tl_report_begin(&job->report->base, "tile");
    TL_TRY(tl_progress_update(&job->host, "tile", 0, 1));
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &job->stages->polygons;
    source.detail = &job->stages->detail;
    source.tile_x = (int32_t)config->tile_x;
    source.tile_z = (int32_t)config->tile_z;
    source.tile_size = config->border_size > 0 ? config->width - 2 * config->border_size : 0;
    source.origin = config->lattice.origin;
    source.agent_height = config->agent_height;
    source.agent_radius = config->agent_radius;
    source.agent_max_climb = config->agent_max_climb;
    TL_TRY(tl_nav_tile_encode(&source, job->host.allocator, &job->tile, &job->report->base));
    TL_TRY(stack_tile(job));
    job->report->tile_count += job->stack.count;
    return tl_progress_update(&job->host, "tile", 1, 1);
}

static tl_result finish_tile(tile_job *job)
{
    TL_TRY(bake_regions(job));
    TL_TRY(bake_contours(job));
    TL_TRY(bake_polygon_mesh(job));
    TL_TRY(bake_detail(job));
    return job->stages->polygons.polygon_count > 0 ? bake_tile(job) : TL_OK;
}

static tl_result bake_from_triangles(tile_job *job)
{
    TL_TRY(bake_floors(job));
    TL_TRY(tl_floor_bands_make(&job->stages->compact, &job->host, &job->bands));
    TL_TRY(erode_floors(job));
    TL_TRY(mark_areas(job));
    TL_TRY(measure_distances(job));
    tl_floor_bands_free(&job->bands);
    return finish_tile(job);
}

tl_report *tl_nav_bake_report_begin(tl_nav_bake_report *report, const char *stage)
{
    if (report == NULL) {
        return NULL;
    }
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, stage);
    return &report->base;
}

tl_result tl_nav_tile_run(const tl_nav_config *config, const tl_nav_input *input, tl_triangle_list list,
                          const tl_host *host, tl_nav_stages *stages, tl_nav_tile_stack *stack_out,
                          tl_nav_bake_report *report)
{
    tl_nav_stages scratch;
    memset(&scratch, 0, sizeof scratch);
    tile_job job;
    memset(&job, 0, sizeof job);
    job.config = config;
    job.input = input;
    job.list = list;
    job.host = *host;
    job.keep = job.keep_distance = stages != NULL;
    job.stages = stages != NULL ? stages : &scratch;
    job.report = report;
    const tl_result result = bake_from_triangles(&job);
    tl_floor_bands_free(&job.bands);
    tl_nav_stages_free(&scratch);
    return hand_over(&job, result, stack_out);
}

void tl_nav_stages_hand_over(tl_nav_stages *stages, const tl_allocator *allocator)
{
    const tl_allocator host = tl_allocator_or_default(allocator);
    stages->heightfield.allocator = host;
    stages->compact.allocator = host;
    stages->contours.allocator = host;
    stages->polygons.allocator = host;
    stages->detail.allocator = host;
}

static tl_result check_tile_arguments(const tl_nav_config *config, const tl_nav_input *input, const tl_host *host,
                                      tl_nav_tile **tile_out, tl_report *report)
{
    tl_report_begin(report, "check");
    TL_REFUSE_NULL(tile_out, report);
    TL_REFUSE_NULL(config, report);
    TL_REFUSE_NULL(input, report);
    return tl_nav_input_check(input, host, NULL, report);
}

tl_result tl_nav_tile_bake(const tl_nav_config *config, const tl_nav_input *input, const tl_host *host,
                           tl_nav_stages *stages_out, tl_nav_tile **tile_out, tl_nav_bake_report *report_out)
{
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    tl_memory_meter meter;
    tl_memory_meter_init(&meter, allocator);
    tl_host metered = { &meter.allocator, host != NULL ? host->tasks : NULL, host != NULL ? host->progress : NULL };

    if (tile_out != NULL) {
        *tile_out = NULL;
    }
    if (stages_out != NULL) {
        memset(stages_out, 0, sizeof *stages_out);
    }
    tl_result result = check_tile_arguments(config, input, &metered, tile_out, &report.base);
    if (result == TL_OK) {
        tl_triangle_list all = { NULL, input->mesh.triangle_count };
        tl_nav_config whole = *config;
        tl_nav_tile_stack stack;
        whole.layer_height = 0;
        result = tl_nav_tile_run(&whole, input, all, &metered, stages_out != NULL ? &stages : NULL, &stack, &report);
        *tile_out = stack.count > 0 ? stack.tiles[0] : NULL;
        tl_blob_hand_over(*tile_out, allocator);
        tl_release_array(&meter.allocator, stack.tiles, stack.count, sizeof *stack.tiles);
    }
    if (result == TL_OK && stages_out != NULL) {
        tl_nav_stages_hand_over(&stages, allocator);
        *stages_out = stages;
    } else {
        tl_nav_stages_free(&stages);
    }
    report.base.peak_bytes = tl_memory_meter_peak(&meter);
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}

tl_result tl_nav_tile_bake_from_distance(const tl_nav_config *config, tl_nav_compact *compact, bool has_distance,
                                         const tl_host *host, tl_nav_tile_stack *stack_out,
                                         tl_nav_bake_report *report_out)
{
    static const tl_host plain = { NULL, NULL, NULL };
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    stages.compact = *compact;
    tile_job job;
    memset(&job, 0, sizeof job);
    job.config = config;
    job.host = host != NULL ? *host : plain;
    job.keep = true; // the floors are the caller's
    job.stages = &stages;
    job.report = &report;
    tl_result result = TL_OK;
    if (!has_distance && config->partition == TL_NAV_WATERSHED) {
        result = tl_nav_distance_field(&job.host, &stages.compact, &report.base);
    }
    result = result == TL_OK ? finish_tile(&job) : result;
    const tl_nav_compact *worked = &stages.compact;
    tl_release_array(&compact->allocator, worked->distance, worked->span_count, sizeof *worked->distance);
    tl_release_array(&compact->allocator, worked->region, worked->span_count, sizeof *worked->region);
    compact->distance = NULL;
    compact->region = NULL;
    memset(&stages.compact, 0, sizeof stages.compact);
    tl_nav_stages_free(&stages);
    if (report_out != NULL) {
        *report_out = report;
    }
    return hand_over(&job, result, stack_out);
}

tl_result tl_nav_tile_bake_from_compact(const tl_nav_config *config, tl_nav_compact *compact, const tl_host *host,
                                        tl_nav_tile_stack *stack_out, tl_nav_bake_report *report_out)
{
    tl_report *base = tl_nav_bake_report_begin(report_out, "regions");
    TL_REFUSE_NULL(stack_out, base);
    memset(stack_out, 0, sizeof *stack_out);
    TL_REFUSE_NULL(config, base);
    TL_REFUSE_NULL(compact, base);
    return tl_nav_tile_bake_from_distance(config, compact, false, host, stack_out, report_out);
}
