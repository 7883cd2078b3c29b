// SPDX-License-Identifier: MIT
//
// Tiles share nothing, so each is a task: gather its window, prove it is the planned one, bake, write. What one fails
// at is told, and the others go on.

#include "world/job/bake_tiles.h"

#include "world/bytes/thread_clock.h"
#include "world/job/tile_file.h"
#include "world/job/tile_source.h"
#include "world/job/tile_times.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILES_PER_WORKER = 4 }; // between two calls of the progress hook

typedef struct bake_worker {
    tl_world_window window;
} bake_worker;

typedef struct bake_item {
    tl_result result;
    bool was_there;
    uint64_t bytes;
    uint64_t nanoseconds; // of the worker's processor
    tl_io_error error;
} bake_item;

typedef struct bake_job {
    const tl_world_bake_def *def;
    tl_world_plan plan;
    tl_world_source source;
    uint64_t *tiles; // of the shard, by falling cost
    uint64_t tile_count, first;
    bake_worker *workers;
    uint32_t worker_count;
    const uint64_t *batch; // the tiles of a batch, in `tiles`
    bake_item *items;      // one for each
    tl_world_times times;
    unsigned char *records; // of a batch's times
} bake_job;

tl_result tl_world_plan_of_job(const char *job, tl_world_plan *plan_out, tl_io_error *error_out)
{
    memset(plan_out, 0, sizeof *plan_out);
    char *path = tl_world_job_path(job, "plan");
    if (path == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, job, 0, "", "out of memory");
    }
    tl_result result = TL_OK;
    if (!tl_file_look(path, NULL)) {
        result = tl_io_fail(error_out, TL_ERR_IO, job, 0, "begin with 'talus world plan INPUT -o JOB'",
                            tl_file_look(job, NULL) ? "is not planned, or not to its end" : "there is no such job");
    } else {
        result = tl_world_plan_read(path, plan_out, error_out);
    }
    free(path);
    return result;
}

tl_result tl_world_inputs_unchanged(const tl_world_plan *plan, tl_io_error *error_out)
{
    for (uint32_t i = 0; i < plan->input_count; i++) {
        const tl_world_stored *input = &plan->inputs[i];
        tl_file_facts facts;
        if (tl_file_look(input->path, &facts) &&
            (facts.size != input->facts.size || facts.changed != input->facts.changed)) {
            return tl_io_fail(error_out, TL_ERR_STALE, input->path, 0,
                              "run 'talus world plan' again, or go on with --as-planned", "changed since the plan");
        }
    }
    return TL_OK;
}

// The core names the tile's failure; this one names the tile.
static tl_result fail_tile(const tl_world_tile *tile, tl_result result, const tl_report *report, tl_io_error *error)
{
    const bool has_element = report->element != NULL && report->element_index != TL_NO_ELEMENT;
    char element[64] = "";
    if (has_element) {
        snprintf(element, sizeof element, "%s %llu: ", report->element, (unsigned long long)report->element_index);
    }
    return tl_io_fail(error, result, NULL, 0, report->advice != NULL ? report->advice : "", "tile %u,%u: %s%s", tile->x,
                      tile->z, element, tl_result_text(result));
}

static tl_result bake_window(const bake_job *job, const tl_world_tile *tile, const tl_world_window *window,
                             const char *path, bake_item *item)
{
    tl_nav_def def = job->plan.grid.def; // its host is empty: one tile runs on one thread
    const tl_nav_input input = tl_world_window_input(window);
    const tl_nav_tile_range range = { tile->x, tile->z, 1, 1 };
    tl_nav_tile_block block;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_result result = tl_nav_bake_range(&def, &input, range, NULL, &block, &report);
    if (result != TL_OK) {
        return fail_tile(tile, result, &report.base, &item->error);
    }
    result = tl_world_tile_write(path, tile, &block.stacks[0], &item->error);
    for (uint32_t i = 0; i < block.stacks[0].count; i++) {
        item->bytes += block.stacks[0].tiles[i]->blob.size;
    }
    tl_nav_tile_block_free(&block);
    return result;
}

static void bake_item_task(uint32_t index, uint32_t worker, void *user)
{
    bake_job *job = user;
    bake_item *item = &job->items[index];
    const uint64_t tile_index = job->batch[index];
    const tl_world_tile *tile = &job->plan.tiles[tile_index];
    memset(item, 0, sizeof *item);
    char *path = tl_world_tile_path(job->def->job, tile->key);
    if (path == NULL) {
        item->result = tl_io_fail(&item->error, TL_ERR_MEMORY, job->def->job, 0, "", "out of memory");
        return;
    }
    item->was_there = tl_world_tile_is_there(path, tile);
    if (!item->was_there) {
        const uint64_t began = tl_thread_nanoseconds();
        tl_world_window *window = &job->workers[worker].window;
        item->result = tl_world_window_gather(&job->source, tile_index, window, &item->error);
        if (item->result == TL_OK) {
            item->result = bake_window(job, tile, window, path, item);
        }
        item->nanoseconds = tl_thread_nanoseconds() - began;
    }
    free(path);
}

static void count_items(bake_job *job, uint32_t count, tl_world_bake_report *report, tl_result *first,
                        tl_io_error *error_out)
{
    for (uint32_t i = 0; i < count; i++) {
        const bake_item *item = &job->items[i];
        if (item->result == TL_OK) {
            report->there += item->was_there;
            report->baked += !item->was_there;
            report->triangles += item->was_there ? 0 : job->plan.tiles[job->batch[i]].triangles;
            report->bytes += item->bytes;
            continue;
        }
        report->failed++;
        if (*first == TL_OK) {
            *first = item->result;
            *error_out = item->error;
        }
        if (job->def->fail != NULL) {
            job->def->fail(&item->error, job->def->user);
        }
    }
}

// Of the tiles of a batch that were baked now.
static tl_result note_times(bake_job *job, uint32_t count, tl_io_error *error_out)
{
    size_t noted = 0;
    for (uint32_t i = 0; i < count; i++) {
        const bake_item *item = &job->items[i];
        if (item->result == TL_OK && !item->was_there) {
            tl_world_time_encode(&job->plan.tiles[job->batch[i]], item->nanoseconds,
                                 job->records + TL_WORLD_TIME_RECORD * noted++);
        }
    }
    return noted > 0 ? tl_world_times_append(&job->times, job->def->job, job->def->shard.index, job->records, noted,
                                             error_out)
                     : TL_OK;
}

static bool is_tile_there(const char *job, const tl_world_tile *tile)
{
    char *path = tl_world_tile_path(job, tile->key);
    const bool there = path != NULL && tl_world_tile_is_there(path, tile);
    free(path);
    return there;
}

uint64_t tl_world_deal_size(uint64_t left, uint32_t workers, uint32_t processes)
{
    const uint64_t share = left / (2 * (uint64_t)processes), most = (uint64_t)TILES_PER_WORKER * workers;
    const uint64_t size = share < workers ? workers : share < most ? share : most;
    return size < left ? size : left;
}

// The next tiles of the list, or the dealer's; 0: it is at its end.
static uint32_t next_batch(bake_job *job)
{
    const tl_world_dealer *dealer = job->def->dealer;
    uint64_t wanted = (uint64_t)TILES_PER_WORKER * job->worker_count;
    if (dealer != NULL) {
        wanted = tl_world_deal_size(job->tile_count - job->first, job->worker_count, dealer->processes);
        job->first = dealer->take(wanted, dealer->user);
        job->first = job->first < job->tile_count ? job->first : job->tile_count;
    }
    const uint64_t left = job->tile_count - job->first;
    const uint64_t count = left < wanted ? left : wanted;
    job->batch = job->tiles + job->first;
    job->first += count;
    return (uint32_t)count;
}

static tl_result bake_all(bake_job *job, tl_world_bake_report *report, tl_io_error *error_out)
{
    const tl_host *host = &job->def->host;
    const tl_world_dealer *dealer = job->def->dealer;
    tl_result first = TL_OK;
    for (;;) {
        const uint32_t count = next_batch(job);
        if (count == 0) {
            return first;
        }
        report->tiles += dealer != NULL ? count : 0;
        if (host->tasks != NULL) {
            host->tasks->run(bake_item_task, count, job, host->tasks->user);
        } else {
            for (uint32_t i = 0; i < count; i++) {
                bake_item_task(i, 0, job);
            }
        }
        count_items(job, count, report, &first, error_out);
        const tl_result noted = note_times(job, count, error_out);
        if (noted != TL_OK) {
            return noted;
        }
        const uint64_t done = dealer != NULL ? dealer->done(count, dealer->user) : job->first;
        if (host->progress != NULL && !host->progress->update("tiles", done, job->tile_count, host->progress->user)) {
            return tl_io_fail(error_out, TL_ERR_CANCELLED, NULL, 0, "", "cancelled");
        }
    }
}

// Leaves only the tiles that are not there.
static void drop_tiles_there(bake_job *job, tl_world_bake_report *report)
{
    uint64_t count = 0;
    for (uint64_t i = 0; i < job->tile_count; i++) {
        if (is_tile_there(job->def->job, &job->plan.tiles[job->tiles[i]])) {
            report->there++;
        } else {
            job->tiles[count++] = job->tiles[i];
        }
    }
    job->tile_count = count;
}

// A dealer's numbers are places in the whole list, which stays as it is.
static bool lacks_a_tile(const bake_job *job)
{
    for (uint64_t i = 0; i < job->tile_count; i++) {
        if (!is_tile_there(job->def->job, &job->plan.tiles[job->tiles[i]])) {
            return true;
        }
    }
    return false;
}

static tl_result bake_shard(bake_job *job, tl_world_bake_report *report, tl_io_error *error_out)
{
    const tl_world_bake_def *def = job->def;
    tl_result result = tl_world_plan_of_job(def->job, &job->plan, error_out);
    if (result == TL_OK && !def->as_planned) {
        result = tl_world_inputs_unchanged(&job->plan, error_out);
    }
    if (result != TL_OK) {
        return result;
    }
    job->worker_count = def->host.tasks != NULL ? def->host.tasks->worker_count : 1;
    job->tiles = tl_world_shard_tiles(&job->plan, &def->shard, &job->tile_count);
    job->workers = calloc(job->worker_count, sizeof *job->workers);
    job->items = calloc((size_t)job->worker_count * TILES_PER_WORKER, sizeof *job->items);
    job->records = malloc((size_t)job->worker_count * TILES_PER_WORKER * TL_WORLD_TIME_RECORD);
    if (job->tiles == NULL || job->workers == NULL || job->items == NULL || job->records == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, def->job, 0, "", "out of memory");
    }
    if (def->dealer == NULL) {
        report->tiles = job->tile_count;
        drop_tiles_there(job, report);
    }
    // With nothing to do no store is opened. A process that cannot open it takes no tile: the others bake them.
    if (def->dealer != NULL ? lacks_a_tile(job) : job->tile_count > 0) {
        result = tl_world_source_open(def->job, &job->plan, &job->source, error_out);
    }
    return result == TL_OK ? bake_all(job, report, error_out) : result;
}

tl_result tl_world_bake(const tl_world_bake_def *def, tl_world_bake_report *report_out, tl_io_error *error_out)
{
    bake_job job;
    memset(&job, 0, sizeof job);
    memset(report_out, 0, sizeof *report_out);
    job.def = def;
    const tl_result result = bake_shard(&job, report_out, error_out);
    for (uint32_t w = 0; job.workers != NULL && w < job.worker_count; w++) {
        tl_world_window_free(&job.workers[w].window);
    }
    free(job.workers);
    free(job.items);
    free(job.records);
    free(job.times.path);
    free(job.tiles);
    tl_world_source_close(&job.source);
    tl_world_plan_free(&job.plan);
    return result;
}

static void count_time(const tl_world_tile *tile, uint64_t time, tl_world_status *status)
{
    status->timed += time > 0;
    status->nanoseconds += time;
    if (time > status->longest) {
        status->longest = time;
        status->longest_x = tile->x;
        status->longest_z = tile->z;
    }
}

static void look_at_tiles(const char *job, const tl_world_plan *plan, const uint64_t *tiles, uint64_t count,
                          const uint64_t *times, tl_world_status *status_out)
{
    uint64_t missing = UINT64_MAX;
    for (uint64_t i = 0; i < count; i++) {
        const tl_world_tile *tile = &plan->tiles[tiles[i]];
        const bool there = is_tile_there(job, tile);
        status_out->cost += tile->cost;
        status_out->cost_there += there ? tile->cost : 0;
        status_out->there += there;
        missing = !there && tiles[i] < missing ? tiles[i] : missing;
        count_time(tile, times[tiles[i]], status_out);
    }
    if (missing != UINT64_MAX) {
        status_out->missing_x = plan->tiles[missing].x;
        status_out->missing_z = plan->tiles[missing].z;
    }
    status_out->inputs = plan->input_count;
    status_out->triangles = plan->triangles;
    status_out->tiles = count;
    status_out->tiles_x = plan->grid.tiles_x;
    status_out->tiles_z = plan->grid.tiles_z;
}

tl_result tl_world_look(const char *job, const tl_world_shard *shard, tl_world_status *status_out,
                        tl_io_error *error_out)
{
    memset(status_out, 0, sizeof *status_out);
    tl_world_plan plan;
    uint64_t count = 0, *tiles = NULL, *times = NULL;
    tl_result result = tl_world_plan_of_job(job, &plan, error_out);
    if (result == TL_OK) {
        result = tl_world_times_read(job, &plan, &times, error_out);
    }
    if (result == TL_OK) {
        tiles = tl_world_shard_tiles(&plan, shard, &count);
        result = tiles != NULL ? TL_OK : tl_io_fail(error_out, TL_ERR_MEMORY, job, 0, "", "out of memory");
    }
    if (result == TL_OK) {
        look_at_tiles(job, &plan, tiles, count, times, status_out);
    }
    free(tiles);
    free(times);
    tl_world_plan_free(&plan);
    return result;
}
