// SPDX-License-Identifier: MIT
//
// Stages: store (read each input), sums (what each tile has of each segment), tiles (keys), write.

#include "world/job/plan_world.h"

#include "world/job/segment_set.h"
#include "world/job/tile_sums.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FOLDERS = 256, BATCH = 4 };

// What a tile costs, in columns of its window: these; what lies along the outlines of its triangles, as many times; and
// each triangle by itself. N triangles that cover a window have outlines of sqrt(N) of its sides, whatever their sizes.
// Fitted to the times of four jobs, of 15 to 1,900 triangles a tile (terrain, a town of houses, levels of games): the
// mean error is 20% of the mean time, without outlines 23%.
enum { COLUMNS_AN_OUTLINE = 20, COLUMNS_A_TRIANGLE = 2 };

typedef struct planning {
    const tl_world_plan_def *def;
    tl_world_inputs inputs;
    tl_world_storing storing;
    tl_world_plan plan;
    tl_world_segments segments;
    tl_world_tile_sums *sums; // [segments.count]
    char *sums_folder, *store_folder;
    tl_io_error *errors; // of the items of a loop
    tl_result *results;
    tl_io_error *error;
} planning;

static tl_result lacks_memory(planning *job)
{
    return tl_io_fail(job->error, TL_ERR_MEMORY, job->def->job, 0, "", "out of memory");
}

// ---- A loop over items on all workers: the first failure counts, in the order of items ----------------------

typedef struct plan_loop {
    planning *job;
    tl_result (*run)(planning *job, uint32_t item, tl_io_error *error);
    uint32_t first;
} plan_loop;

static void run_item(uint32_t index, uint32_t worker, void *user)
{
    plan_loop *loop = user;
    (void)worker;
    const uint32_t item = loop->first + index;
    memset(&loop->job->errors[index], 0, sizeof loop->job->errors[index]);
    loop->job->results[index] = loop->run(loop->job, item, &loop->job->errors[index]);
}

static uint32_t batch_size(const planning *job)
{
    const tl_tasks *tasks = job->def->nav.host.tasks;
    return BATCH * (tasks != NULL ? tasks->worker_count : 1);
}

static tl_result run_loop(planning *job, const char *stage, uint32_t count,
                          tl_result (*run)(planning *job, uint32_t item, tl_io_error *error))
{
    const tl_host *host = &job->def->nav.host;
    plan_loop loop = { job, run, 0 };
    const uint32_t batch = batch_size(job);
    for (; loop.first < count; loop.first += batch) {
        const uint32_t part = count - loop.first < batch ? count - loop.first : batch;
        if (host->tasks != NULL && part > 1) {
            host->tasks->run(run_item, part, &loop, host->tasks->user);
        } else {
            for (uint32_t i = 0; i < part; i++) {
                run_item(i, 0, &loop);
            }
        }
        for (uint32_t i = 0; i < part; i++) {
            if (job->results[i] != TL_OK) {
                *job->error = job->errors[i];
                return job->results[i];
            }
        }
        if (host->progress != NULL && !host->progress->update(stage, loop.first + part, count, host->progress->user)) {
            return tl_io_fail(job->error, TL_ERR_CANCELLED, NULL, 0, "", "cancelled");
        }
    }
    return TL_OK;
}

// ---- Stages ------------------------------------------------------------------------------------------------

static tl_result make_folder(planning *job, const char *part)
{
    char *path = tl_world_job_path(job->def->job, part);
    const tl_result result = path != NULL ? tl_folder_make(path, job->error) : lacks_memory(job);
    free(path);
    return result;
}

static tl_result make_folders(planning *job)
{
    tl_result result = tl_folder_make(job->def->job, job->error);
    static const char *const parts[] = { "store", "sums", "tiles" };
    for (int i = 0; i < 3 && result == TL_OK; i++) {
        result = make_folder(job, parts[i]);
    }
    for (unsigned i = 0; i < FOLDERS && result == TL_OK; i++) {
        char name[16];
        snprintf(name, sizeof name, "tiles/%02x", i);
        result = make_folder(job, name);
    }
    job->store_folder = tl_world_job_path(job->def->job, "store");
    job->sums_folder = tl_world_job_path(job->def->job, "sums");
    job->errors = calloc(batch_size(job), sizeof *job->errors);
    job->results = calloc(batch_size(job), sizeof *job->results);
    if (result == TL_OK &&
        (job->store_folder == NULL || job->sums_folder == NULL || job->errors == NULL || job->results == NULL)) {
        result = lacks_memory(job);
    }
    return result;
}

static tl_result store_one(planning *job, uint32_t item, tl_io_error *error)
{
    const tl_host *host = job->inputs.count == 1 ? &job->def->nav.host : NULL; // progress is the caller's thread's
    return tl_world_store_input(&job->inputs.items[item], &job->storing, host, &job->plan.inputs[item], error);
}

// The power of two that is next below a tile's edge.
static double choose_cell_size(const tl_nav_def *def)
{
    int exponent;
    frexp((double)def->cell_size * (double)def->tile_size, &exponent);
    const int least = -20, most = 20;
    return ldexp(1.0, exponent - 1 < least ? least : exponent - 1 > most ? most : exponent - 1);
}

static tl_result store_inputs(planning *job)
{
    const tl_world_plan_def *def = job->def;
    tl_result result = tl_world_inputs_read(def->input, &def->reading, &job->inputs, job->error);
    if (result != TL_OK) {
        return result;
    }
    job->plan.inputs = calloc((size_t)job->inputs.count + 1, sizeof *job->plan.inputs);
    if (job->plan.inputs == NULL) {
        return lacks_memory(job);
    }
    job->plan.input_count = job->inputs.count;
    const uint32_t workers = def->nav.host.tasks != NULL ? def->nav.host.tasks->worker_count : 1;
    const uint32_t at_once = workers < job->inputs.count ? workers : job->inputs.count;
    const tl_world_storing storing = { job->store_folder, choose_cell_size(&def->nav), def->memory / at_once };
    job->storing = storing;
    return run_loop(job, "store", job->inputs.count, store_one);
}

static void add_up_inputs(planning *job, tl_world_plan_report *report)
{
    for (uint32_t i = 0; i < job->plan.input_count; i++) {
        const tl_world_stored *input = &job->plan.inputs[i];
        job->plan.vertices += input->vertices;
        job->plan.triangles += input->triangles;
        job->plan.degenerate += input->degenerate;
        report->inputs_read += !input->was_there;
    }
    report->inputs = job->plan.input_count;
    report->triangles = job->plan.triangles;
    report->degenerate = job->plan.degenerate;
}

static void choose_origin_of_world(const tl_world_plan_def *def, const double bounds[6], double origin[3])
{
    const double far_out = 16384.0, step = 1024.0; // a multiple of the cells' edges, so that all offsets stay exact
    for (int i = 0; i < 3; i++) {
        const bool is_far = fmax(-bounds[i], bounds[i + 3]) > far_out;
        origin[i] = def->has_origin ? def->origin[i]
                    : is_far        ? step * round(0.5 * (bounds[i] + bounds[i + 3]) / step)
                                    : 0.0;
    }
}

static tl_result find_bounds(planning *job, double bounds[6])
{
    for (int i = 0; i < 3; i++) {
        bounds[i] = HUGE_VAL;
        bounds[i + 3] = -HUGE_VAL;
    }
    uint64_t triangles = 0;
    for (uint32_t s = 0; s < job->segments.count; s++) {
        const tl_world_segment_head *head = &job->segments.items[s].head;
        triangles += head->triangles;
        for (int i = 0; i < 3 && head->triangles > 0; i++) {
            bounds[i] = fmin(bounds[i], head->bounds[i]);
            bounds[i + 3] = fmax(bounds[i + 3], head->bounds[i + 3]);
        }
    }
    return triangles > 0 ? TL_OK
                         : tl_io_fail(job->error, TL_ERR_EMPTY, job->def->input, 0, "check the inputs",
                                      "none of the %llu triangles has area", (unsigned long long)job->plan.triangles);
}

// Where a float's step is a good part of a cell, tiles would be baked from a coarser world than was given.
static tl_result check_size(planning *job, const double bounds[6], const double origin[3])
{
    double size = 0.0;
    for (int i = 0; i < 6; i++) {
        size = fmax(size, fabs(bounds[i] - origin[i % 3]));
    }
    if (size * 0x1p-23 > 0.25 * (double)job->def->nav.cell_size && tl_aabb_is_empty(job->def->nav.bounds)) {
        return tl_io_fail(
            job->error, TL_ERR_RANGE, job->def->input, 0, "plan parts of it, each with its --bounds and --origin",
            "the world reaches %.0f m from its origin, where floats are coarser than a quarter cell", size);
    }
    return TL_OK;
}

static tl_result make_grid(planning *job)
{
    double bounds[6], origin[3];
    tl_result result =
        tl_world_segments_open(job->store_folder, job->plan.inputs, job->plan.input_count, &job->segments, job->error);
    if (result == TL_OK) {
        result = find_bounds(job, bounds);
    }
    if (result != TL_OK) {
        return result;
    }
    choose_origin_of_world(job->def, bounds, origin);
    result = check_size(job, bounds, origin);
    if (result != TL_OK) {
        return result;
    }
    tl_aabb *box = &job->plan.bounds;
    box->min =
        tl_vec3_make((float)(bounds[0] - origin[0]), (float)(bounds[1] - origin[1]), (float)(bounds[2] - origin[2]));
    box->max =
        tl_vec3_make((float)(bounds[3] - origin[0]), (float)(bounds[4] - origin[1]), (float)(bounds[5] - origin[2]));
    tl_nav_def nav = job->def->nav;
    nav.bounds = tl_aabb_is_empty(nav.bounds) ? *box : nav.bounds;
    tl_report report;
    memset(&report, 0, sizeof report);
    result = tl_world_grid_make(&nav, origin, job->storing.cell_size, &job->plan.grid, &report);
    if (result != TL_OK) {
        return tl_io_fail(job->error, result, NULL, 0, report.advice != NULL ? report.advice : "", "%s%s%s",
                          report.field != NULL ? report.field : "", report.field != NULL ? ": " : "",
                          tl_result_text(result));
    }
    return TL_OK;
}

static tl_result sum_one(planning *job, uint32_t item, tl_io_error *error)
{
    char segment[TL_CONTENT_TEXT_BYTES], grid[TL_CONTENT_TEXT_BYTES], name[128];
    tl_content_hash_text(job->segments.inputs[item], segment);
    tl_content_hash_text(tl_world_grid_hash(&job->plan.grid), grid);
    // A part that was written anew under its name, after an interruption, may hold others: its checksum tells.
    const tl_world_segment *store = &job->segments.items[item];
    const uint64_t last = store->head.cells > 0 ? store->cells[store->head.cells - 1].checksum : 0;
    snprintf(name, sizeof name, "%s.%u.%016llx.%.16s.sums", segment, job->segments.numbers[item],
             (unsigned long long)last, grid);
    char *path = tl_world_job_path(job->sums_folder, name);
    if (path == NULL) {
        return tl_io_fail(error, TL_ERR_MEMORY, job->sums_folder, 0, "", "out of memory");
    }
    const tl_result result = tl_world_tile_sums_get(&job->plan.grid, store, path, &job->sums[item], error);
    free(path);
    return result;
}

// Pairs, then pairs of pairs: each row is moved log2(segments) times.
static tl_result add_up_sums(planning *job)
{
    for (uint32_t step = 1; step < job->segments.count; step *= 2) {
        for (uint32_t i = 0; i + step < job->segments.count; i += 2 * step) {
            if (!tl_world_tile_sums_add(&job->sums[i], &job->sums[i + step])) {
                return lacks_memory(job);
            }
        }
    }
    return TL_OK;
}

static tl_result make_tiles(planning *job)
{
    const tl_world_tile_sums *sums = &job->sums[0];
    const tl_world_grid *grid = &job->plan.grid;
    job->plan.tiles = malloc((size_t)sums->count * sizeof *job->plan.tiles + 1);
    if (job->plan.tiles == NULL) {
        return lacks_memory(job);
    }
    const tl_content_hash settings = tl_world_grid_hash(grid);
    const double side = (double)grid->def.tile_size + 2.0 * grid->margin;
    for (uint64_t i = 0; i < sums->count; i++) {
        const tl_world_tile_sum *row = &sums->rows[i];
        tl_world_tile tile = { row->tile % grid->tiles_x, row->tile / grid->tiles_x, row->triangles, 0, { 0, 0 } };
        const double triangles = (double)row->triangles;
        const double cost =
            side * side + (double)COLUMNS_AN_OUTLINE * side * sqrt(triangles) + (double)COLUMNS_A_TRIANGLE * triangles;
        tile.cost = cost < 4e9 ? (uint32_t)cost : UINT32_C(4000000000);
        tile.key = tl_world_tile_key(settings, &tile, row->sum);
        job->plan.tiles[i] = tile;
    }
    job->plan.tile_count = sums->count;
    return TL_OK;
}

static tl_result find_tiles(planning *job)
{
    job->sums = calloc((size_t)job->segments.count + 1, sizeof *job->sums);
    if (job->sums == NULL) {
        return lacks_memory(job);
    }
    tl_result result = run_loop(job, "sums", job->segments.count, sum_one);
    if (result == TL_OK) {
        result = add_up_sums(job);
    }
    return result == TL_OK ? make_tiles(job) : result;
}

static tl_result write_plan(planning *job)
{
    const char *input = job->def->input;
    size_t length = strlen(input);
    while (length > 1 && input[length - 1] == '/') {
        length--;
    }
    size_t first = length;
    while (first > 0 && input[first - 1] != '/') {
        first--;
    }
    job->plan.name = malloc(length - first + 1);
    char *path = tl_world_job_path(job->def->job, "plan");
    tl_result result;
    if (job->plan.name == NULL || path == NULL) {
        result = lacks_memory(job);
    } else {
        memcpy(job->plan.name, input + first, length - first);
        job->plan.name[length - first] = '\0';
        result = tl_world_plan_write(&job->plan, path, job->error);
    }
    free(path);
    return result;
}

static tl_result run_stages(planning *job, tl_world_plan_report *report)
{
    tl_result result = make_folders(job);
    if (result == TL_OK) {
        result = store_inputs(job);
    }
    if (result == TL_OK) {
        add_up_inputs(job, report);
        result = make_grid(job);
    }
    if (result == TL_OK) {
        result = find_tiles(job);
    }
    if (result == TL_OK) {
        result = write_plan(job);
    }
    report->segments = job->segments.count;
    report->tiles = job->plan.tile_count;
    report->tiles_x = job->plan.grid.tiles_x;
    report->tiles_z = job->plan.grid.tiles_z;
    memcpy(report->origin, job->plan.grid.origin, sizeof report->origin);
    for (uint32_t s = 0; s < job->segments.count; s++) {
        const tl_world_segment_head *head = &job->segments.items[s].head;
        report->store_bytes +=
            TL_WORLD_SEGMENT_HEADER + head->triangles * TL_WORLD_RECORD_BYTES + head->cells * TL_WORLD_SEGMENT_CELL + 8;
    }
    return result;
}

tl_result tl_world_plan_make(const tl_world_plan_def *def, tl_world_plan_report *report_out, tl_io_error *error_out)
{
    planning job;
    memset(&job, 0, sizeof job);
    memset(report_out, 0, sizeof *report_out);
    job.def = def;
    job.error = error_out;
    const tl_result result = run_stages(&job, report_out);
    for (uint32_t i = 0; job.sums != NULL && i < job.segments.count; i++) {
        tl_world_tile_sums_free(&job.sums[i]);
    }
    free(job.sums);
    free(job.errors);
    free(job.results);
    free(job.sums_folder);
    free(job.store_folder);
    tl_world_segments_close(&job.segments);
    tl_world_plan_free(&job.plan);
    tl_world_inputs_free(&job.inputs);
    return result;
}
