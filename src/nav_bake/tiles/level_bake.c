// SPDX-License-Identifier: MIT
//
// A whole level: its triangles sorted into tiles once, then every tile baked alone, as tasks where the host has some.
//
// Tiles share nothing but the lattice, so their bytes do not depend on workers or order. A failure is that of
// the first tile that fails, in row-major order, whatever the number of workers.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/memory_meter.h"
#include "nav_bake/input/input_check.h"
#include "nav_bake/input/range_input.h"
#include "nav_bake/tiles/tile_bake.h"
#include "nav_bake/voxels/batches.h"

#include <string.h>

// Grids of more tiles are kept by the tiles that hold triangles.
enum { DENSE_TILES = 1 << 12 };

enum { TILES_PER_WORKER = 8, COLUMNS_PER_WORKER = 1 << 15 }; // between two calls of the progress hook, at most

#define NO_TILE UINT64_MAX

typedef struct level_worker {
    tl_nav_bake_report counts;
    uint64_t failed_tile; ///< the lowest one, or NO_TILE
    tl_report failure;    ///< its report
} level_worker;

typedef struct level_job {
    const tl_nav_def *def;
    const tl_nav_input *input;
    tl_aabb bounds;
    tl_host host; ///< with the meter's allocator
    const tl_nav_stage_sink *sink;
    uint32_t tiles_x, tiles_z; ///< of the level
    tl_nav_tile_range range;   ///< what is built
    bool is_block;             ///< a stack for each place of the range; else for each bin with triangles
    tl_triangle_bins bins;
    tl_nav_tile_stack *stacks; ///< [stack_count]
    uint64_t stack_count;
    level_worker *workers; ///< [worker_count]
    uint32_t worker_count;
} level_job;

static uint64_t tile_count_of(const level_job *job)
{
    return (uint64_t)job->range.count_x * job->range.count_z;
}

static void add_counts(tl_nav_bake_report *sum, const tl_nav_bake_report *part)
{
    sum->span_count += part->span_count;
    sum->compact_span_count += part->compact_span_count;
    sum->region_count += part->region_count;
    sum->filtered_regions += part->filtered_regions;
    sum->filtered_spans += part->filtered_spans;
    sum->filtered_area += part->filtered_area;
    sum->contour_count += part->contour_count;
    sum->unbridged_holes += part->unbridged_holes;
    sum->slit_outlines += part->slit_outlines;
    sum->repaired_contours += part->repaired_contours;
    sum->polygon_count += part->polygon_count;
    sum->vertex_count += part->vertex_count;
    sum->detail_triangle_count += part->detail_triangle_count;
    sum->limited_patches += part->limited_patches;
    sum->tile_count += part->tile_count;
}

// A tile of the range, into its stack.
static tl_result run_tile(const level_job *job, uint64_t tile, tl_nav_tile_stack *stack, tl_triangle_list list,
                          const tl_host *host, tl_nav_bake_report *counts)
{
    tl_nav_config config;
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    TL_TRY(tl_nav_config_from_def(job->def, job->bounds, job->range.x + (uint32_t)(tile % job->range.count_x),
                                  job->range.z + (uint32_t)(tile / job->range.count_x), &config, &counts->base));
    const bool keep = job->sink != NULL;
    tl_result result = tl_nav_tile_run(&config, job->input, list, host, keep ? &stages : NULL, stack, counts);
    if (keep) {
        tl_nav_stages_hand_over(&stages, job->def->host.allocator);
        if (result == TL_OK) {
            job->sink->take(&config, &stages, job->sink->user);
        }
        tl_nav_stages_free(&stages);
    }
    return result;
}

static tl_result bake_one_tile(uint32_t bin, uint32_t worker_index, void *user)
{
    level_job *job = user;
    level_worker *worker = &job->workers[worker_index];
    tl_triangle_list list = tl_triangle_bins_get(&job->bins, bin);
    if (list.count == 0) {
        return TL_OK;
    }
    tl_host host = { job->host.allocator, NULL, NULL };
    const uint64_t tile = tl_triangle_bins_place(&job->bins, bin);
    tl_result result = run_tile(job, tile, &job->stacks[job->is_block ? tile : bin], list, &host, &worker->counts);
    if (result != TL_OK && tile < worker->failed_tile) {
        worker->failed_tile = tile;
        worker->failure = worker->counts.base;
        if (worker->failure.element == NULL) {
            worker->failure.element = "tile";
            worker->failure.element_index = tile;
        }
    }
    return result;
}

// Tiles for each worker between two calls of the progress hook: a column takes up to a microsecond and a half.
static uint32_t tiles_a_batch(const level_job *job)
{
    const uint64_t side = job->def->tile_size + 16u, tiles = COLUMNS_PER_WORKER / (side * side);
    return tiles < 1 ? 1 : tiles > TILES_PER_WORKER ? TILES_PER_WORKER : (uint32_t)tiles;
}

static tl_result run_tiles(level_job *job, tl_report *report)
{
    tl_report_begin(report, "tiles");
    tl_result result =
        tl_run_batches(&job->host, "tiles", bake_one_tile, (uint32_t)job->bins.bin_count, tiles_a_batch(job), job);
    const level_worker *first = &job->workers[0];
    for (uint32_t w = 1; w < job->worker_count; w++) {
        first = job->workers[w].failed_tile < first->failed_tile ? &job->workers[w] : first;
    }
    if (first->failed_tile != NO_TILE) {
        *report = first->failure;
    }
    return result;
}

// The columns of the level's lattice fall into tiles, each with the border that it sees of its neighbours.
static tl_result sort_triangles(level_job *job, tl_report *report)
{
    tl_nav_config config;
    TL_TRY(tl_nav_config_from_def(job->def, job->bounds, 0, 0, &config, report));
    tl_report_begin(report, "sort triangles");
    const uint32_t size = job->def->tile_size;
    tl_nav_lattice lattice = { config.lattice.origin, (int32_t)(job->range.x * size), (int32_t)(job->range.z * size) };
    tl_lattice_map map = tl_lattice_map_make(&lattice, config.cell_size, config.cell_height);
    const bool sparse = tile_count_of(job) > DENSE_TILES;
    tl_bin_grid grid = { job->range.count_x, job->range.count_z, size, size, config.border_size, sparse };
    tl_triangle_list all = { NULL, job->input->mesh.triangle_count };
    tl_result result = tl_triangle_bins_init(&job->input->mesh, all, &map, &grid, job->host.allocator, &job->bins);
    return result == TL_ERR_LIMIT
               ? tl_report_field(report, result, "tile_size", "raise tile_size: triangles lie in too many tiles")
               : result;
}

static tl_result allocate_stacks(level_job *job, uint64_t count)
{
    job->stacks = tl_allocate_array(job->host.allocator, count, sizeof *job->stacks);
    if (job->stacks == NULL) {
        return TL_ERR_MEMORY;
    }
    job->stack_count = count;
    memset(job->stacks, 0, (size_t)count * sizeof *job->stacks);
    return TL_OK;
}

static tl_result bake_level_tiles(level_job *job, tl_nav_bake_report *report)
{
    if (job->def->tile_size == 0) {
        tl_triangle_list all = { NULL, job->input->mesh.triangle_count };
        TL_TRY(allocate_stacks(job, 1));
        return run_tile(job, 0, &job->stacks[0], all, &job->host, report);
    }
    TL_TRY(sort_triangles(job, &report->base));
    TL_TRY(allocate_stacks(job, job->is_block ? tile_count_of(job) : job->bins.bin_count));
    job->worker_count = tl_worker_count(&job->host);
    job->workers = tl_allocate_array(job->host.allocator, job->worker_count, sizeof *job->workers);
    if (job->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(job->workers, 0, job->worker_count * sizeof *job->workers);
    for (uint32_t w = 0; w < job->worker_count; w++) {
        job->workers[w].failed_tile = NO_TILE;
    }
    tl_result result = run_tiles(job, &report->base);
    for (uint32_t w = 0; w < job->worker_count; w++) {
        add_counts(report, &job->workers[w].counts);
    }
    return result;
}

// The grid of the level, and the range, which must lie in it; NULL: all tiles.
static tl_result take_range(level_job *job, const tl_nav_tile_range *range, tl_report *report)
{
    TL_TRY(tl_nav_tile_grid(job->def, job->bounds, &job->tiles_x, &job->tiles_z, report));
    const tl_nav_tile_range all = { 0, 0, job->tiles_x, job->tiles_z };
    const tl_nav_tile_range wanted = range != NULL ? *range : all;
    if (wanted.x > all.count_x || wanted.count_x > all.count_x - wanted.x || wanted.z > all.count_z ||
        wanted.count_z > all.count_z - wanted.z) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "range", "ask tl_nav_tile_grid how many tiles there are");
    }
    job->range = wanted;
    job->is_block = range != NULL;
    if (job->is_block && tile_count_of(job) > TL_NAV_MAX_TILES) {
        return tl_report_field(report, TL_ERR_LIMIT, "range", "bake fewer tiles at once, up to TL_NAV_MAX_TILES");
    }
    return TL_OK;
}

static tl_result bake_tile_range(level_job *job, const tl_nav_tile_range *range, tl_nav_bake_report *report)
{
    TL_TRY(tl_nav_input_check(job->input, &job->host, &job->bounds, &report->base));
    TL_TRY(take_range(job, range, &report->base));
    return tile_count_of(job) > 0 ? bake_level_tiles(job, report) : allocate_stacks(job, 0);
}

static void begin_job(level_job *job, const tl_nav_def *def, const tl_nav_input *input, tl_memory_meter *meter)
{
    tl_memory_meter_init(meter, def->host.allocator);
    memset(job, 0, sizeof *job);
    job->def = def;
    job->input = input;
    job->host = def->host;
    job->host.allocator = &meter->allocator;
}

static void end_job(level_job *job, tl_memory_meter *meter, const tl_nav_bake_report *report,
                    tl_nav_bake_report *report_out)
{
    for (uint64_t t = 0; job->stacks != NULL && t < job->stack_count; t++) {
        tl_nav_tile_stack_free(&job->stacks[t]);
    }
    tl_release_array(job->host.allocator, job->stacks, job->stack_count, sizeof *job->stacks);
    tl_release_array(job->host.allocator, job->workers, job->worker_count, sizeof *job->workers);
    tl_triangle_bins_free(&job->bins);
    if (report_out != NULL) {
        *report_out = *report;
        report_out->base.peak_bytes = tl_memory_meter_peak(meter);
    }
}

// Those that hold polygons, in an array of their number.
static tl_result keep_tiles(level_job *job, uint32_t tile_count, tl_nav_tiles *tiles_out)
{
    tiles_out->tiles = tl_allocate_array(job->host.allocator, tile_count, sizeof *tiles_out->tiles);
    if (tiles_out->tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t t = 0; t < job->stack_count; t++) {
        for (uint32_t i = 0; i < job->stacks[t].count; i++) {
            tl_blob_hand_over(job->stacks[t].tiles[i], job->def->host.allocator);
            tiles_out->tiles[tiles_out->tile_count++] = job->stacks[t].tiles[i];
            job->stacks[t].tiles[i] = NULL;
        }
    }
    tiles_out->allocator = tl_allocator_or_default(job->def->host.allocator);
    tiles_out->tiles_x = job->tiles_x;
    tiles_out->tiles_z = job->tiles_z;
    return TL_OK;
}

tl_result tl_nav_bake(const tl_nav_def *def, const tl_nav_input *input, tl_nav_tiles *tiles_out,
                      tl_nav_bake_report *report_out)
{
    tl_report *base = tl_nav_bake_report_begin(report_out, "check");
    TL_REFUSE_NULL(tiles_out, base);
    memset(tiles_out, 0, sizeof *tiles_out);
    TL_REFUSE_NULL(input, base);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_memory_meter meter;
    level_job job;
    begin_job(&job, def, input, &meter);
    tl_result result = bake_tile_range(&job, NULL, &report);
    if (result == TL_OK) {
        result = keep_tiles(&job, report.tile_count, tiles_out);
    }
    end_job(&job, &meter, &report, report_out);
    return result;
}

// Where the columns of a range lie, border included, and one column more on each side.
tl_result tl_nav_range_window(const tl_nav_def *def, const tl_nav_tile_range *range, tl_aabb *window, tl_report *report)
{
    tl_nav_config first, last;
    TL_TRY(tl_nav_config_from_def(def, def->bounds, range->x, range->z, &first, report));
    TL_TRY(tl_nav_config_from_def(def, def->bounds, range->x + range->count_x - 1, range->z + range->count_z - 1, &last,
                                  report));
    *window = tl_aabb_union(first.bounds, last.bounds);
    const tl_vec3 column = { def->cell_size, 0.0f, def->cell_size };
    window->min = tl_sub(window->min, column);
    window->max = tl_add(window->max, column);
    return TL_OK;
}

// A few tiles of a level whose bounds are given: only the triangles that can reach them are read.
static tl_result bake_part(level_job *job, const tl_nav_tile_range *range, tl_nav_bake_report *report)
{
    const tl_nav_input *whole = job->input;
    tl_aabb window;
    tl_range_input part;
    TL_TRY(take_range(job, range, &report->base));
    TL_TRY(tl_nav_range_window(job->def, range, &window, &report->base));
    const tl_triangle_list all = { NULL, whole->mesh.triangle_count };
    tl_result result = tl_range_input_make(whole, all, window, job->host.allocator, &part);
    if (result == TL_OK && part.input.mesh.triangle_count == 0) {
        result = allocate_stacks(job, tile_count_of(job)); // tiles without triangles are no tiles
    } else if (result == TL_OK) {
        job->input = &part.input;
        result = bake_tile_range(job, range, report);
        job->input = whole;
        tl_report *base = &report->base;
        if (result != TL_OK && base->element != NULL && strcmp(base->element, "triangle") == 0 &&
            base->element_index < part.input.mesh.triangle_count) {
            base->element_index = part.triangles[base->element_index];
        }
    }
    tl_range_input_free(&part, job->host.allocator);
    return result;
}

static void hand_over_stacks(level_job *job, tl_nav_tile_block *block_out)
{
    block_out->allocator = tl_allocator_or_default(job->def->host.allocator);
    for (uint64_t t = 0; t < job->stack_count; t++) {
        tl_nav_tile_stack *stack = &job->stacks[t];
        for (uint32_t i = 0; i < stack->count; i++) {
            tl_blob_hand_over(stack->tiles[i], &block_out->allocator);
        }
        stack->allocator = block_out->allocator;
    }
    block_out->range = job->range;
    block_out->stacks = job->stacks;
    job->stacks = NULL;
}

tl_result tl_nav_bake_range(const tl_nav_def *def, const tl_nav_input *input, tl_nav_tile_range range,
                            const tl_nav_stage_sink *sink, tl_nav_tile_block *block_out, tl_nav_bake_report *report_out)
{
    tl_report *base = tl_nav_bake_report_begin(report_out, "check");
    TL_REFUSE_NULL(block_out, base);
    memset(block_out, 0, sizeof *block_out);
    TL_REFUSE_NULL(input, base);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_memory_meter meter;
    level_job job;
    begin_job(&job, def, input, &meter);
    job.sink = sink;
    const bool part = !tl_aabb_is_empty(def->bounds) && def->tile_size > 0 && range.count_x > 0 && range.count_z > 0;
    tl_result result = part ? bake_part(&job, &range, &report) : bake_tile_range(&job, &range, &report);
    if (result == TL_OK) {
        hand_over_stacks(&job, block_out);
    }
    end_job(&job, &meter, &report, report_out);
    return result;
}

void tl_nav_tile_block_free(tl_nav_tile_block *block)
{
    if (block == NULL) {
        return;
    }
    const uint64_t count = (uint64_t)block->range.count_x * block->range.count_z;
    for (uint64_t t = 0; block->stacks != NULL && t < count; t++) {
        tl_nav_tile_stack_free(&block->stacks[t]);
    }
    tl_release_array(&block->allocator, block->stacks, count, sizeof *block->stacks);
    memset(block, 0, sizeof *block);
}

void tl_nav_tiles_free(tl_nav_tiles *tiles)
{
    if (tiles != NULL) {
        tl_blob_array_free(&tiles->allocator, tiles->tiles, tiles->tile_count);
        memset(tiles, 0, sizeof *tiles);
    }
}
