// SPDX-License-Identifier: MIT
//
// The compact heightfield: the floors above the solid spans, and which lies beside which.
// Source: Mikko Mononen, Recast (rcBuildCompactHeightfield).
//
// Runs of rows are opened as tasks (open_floors.c), each into a piece of its own; then the pieces are joined and the
// floors linked (link_floors.c). The spans come from a heightfield, or straight from the rasterizer, a band at a time:
// then no heightfield is ever whole, and its spans are read while they are in the cache.

#include "nav_bake/floors/compact.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/floors/open_floors.h"
#include "nav_bake/voxels/batches.h"

#include <string.h>

enum { COLUMNS_PER_TASK = 16384, OPEN_TASKS_PER_WORKER = 4 };

typedef struct open_worker {
    tl_open_scratch scratch;
    tl_floors floors; ///< of one run of rows, where there are several
} open_worker;

// The floors of one run of rows.
typedef struct open_piece {
    tl_floors floors;
    uint32_t first; ///< where they begin among all
} open_piece;

typedef struct open_job {
    const tl_nav_config *config; ///< with the filters to apply
    const tl_span_rows *rows;    ///< of the whole field, or NULL: the rasterizer's
    tl_rasterizer *rasterizer;
    tl_nav_compact *compact;
    uint32_t rows_per_task, task_count;
    open_piece *pieces;   ///< [task_count]
    open_worker *workers; ///< [worker_count]
    uint32_t worker_count;
    const tl_allocator *allocator;
} open_job;

// The floors of one run of rows. A piece that has to wait for others has as much room as it needs.
static tl_result open_rows(open_job *job, tl_row_source *source, uint32_t begin, uint32_t end, open_worker *worker,
                           tl_floors *piece)
{
    tl_floors *all = job->task_count == 1 ? piece : &worker->floors;
    all->count = 0;
    worker->scratch.allocator = job->allocator;
    TL_TRY(tl_open_rows(job->config, source, begin, end, &worker->scratch, all,
                        job->compact->first_span + (size_t)begin * job->compact->width + 1));
    if (all != piece) {
        TL_TRY(tl_floors_allocate(piece, all->count, job->allocator));
        tl_floors_append(piece, all);
    }
    return TL_OK;
}

static tl_result open_task(uint32_t index, uint32_t worker, void *user)
{
    open_job *job = user;
    const uint32_t begin = index * job->rows_per_task,
                   end = tl_block_end(index, job->rows_per_task, job->compact->height);
    tl_row_source source;
    memset(&source, 0, sizeof source);
    if (job->rows != NULL) {
        source.rows = *job->rows;
    } else {
        TL_TRY(tl_rasterizer_run(job->rasterizer, index, worker, &source));
    }
    return open_rows(job, &source, begin, end, &job->workers[worker], &job->pieces[index].floors);
}

static tl_result allocate_job(open_job *job, const tl_host *host)
{
    tl_nav_compact *compact = job->compact;
    const uint64_t columns = (uint64_t)compact->width * compact->height;
    job->worker_count = tl_worker_count(host);
    compact->first_span = tl_allocate_array(&compact->allocator, columns + 1, sizeof *compact->first_span);
    job->pieces = tl_allocate_array(job->allocator, job->task_count, sizeof *job->pieces);
    job->workers = tl_allocate_array(job->allocator, job->worker_count, sizeof *job->workers);
    if (job->pieces != NULL) {
        memset(job->pieces, 0, job->task_count * sizeof *job->pieces);
    }
    if (job->workers != NULL) {
        memset(job->workers, 0, job->worker_count * sizeof *job->workers);
    }
    return compact->first_span && job->pieces && job->workers ? TL_OK : TL_ERR_MEMORY;
}

static void free_workers(open_job *job)
{
    for (uint32_t w = 0; job->workers != NULL && w < job->worker_count; w++) {
        tl_open_scratch_free(&job->workers[w].scratch);
        tl_floors_release(&job->workers[w].floors, job->allocator);
    }
    tl_release_array(job->allocator, job->workers, job->worker_count, sizeof *job->workers);
    job->workers = NULL;
}

static void free_pieces(open_job *job)
{
    for (uint32_t k = 0; job->pieces != NULL && k < job->task_count; k++) {
        tl_floors_release(&job->pieces[k].floors, job->allocator);
    }
    tl_release_array(job->allocator, job->pieces, job->task_count, sizeof *job->pieces);
    job->pieces = NULL;
}

// Copies a piece to its place among all floors, and frees it; positions in it become positions in the field.
static void join_piece(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    open_job *job = user;
    tl_nav_compact *compact = job->compact;
    open_piece *piece = &job->pieces[index];
    const uint32_t begin = index * job->rows_per_task, end = tl_block_end(index, job->rows_per_task, compact->height);
    uint32_t *ends = compact->first_span + (size_t)begin * compact->width + 1;
    const size_t columns = (size_t)(end - begin) * compact->width;
    for (size_t c = 0; c < columns && piece->first > 0; c++) {
        ends[c] += piece->first;
    }
    tl_floors place = { compact->floor + piece->first, compact->clearance + piece->first, compact->area + piece->first,
                        0, piece->floors.count };
    tl_floors_append(&place, &piece->floors);
    tl_floors_release(&piece->floors, job->allocator);
}

// All pieces in the order of the rows.
static tl_result join_floor_pieces(open_job *job, const tl_host *host)
{
    tl_nav_compact *compact = job->compact;
    uint64_t count = 0;
    for (uint32_t k = 0; k < job->task_count; k++) {
        job->pieces[k].first = (uint32_t)count;
        count += job->pieces[k].floors.count;
        if (count >= TL_NAV_NO_SPAN) {
            return TL_ERR_LIMIT;
        }
    }
    compact->span_count = (uint32_t)count;
    compact->floor = tl_allocate_array(&compact->allocator, count, sizeof *compact->floor);
    compact->clearance = tl_allocate_array(&compact->allocator, count, sizeof *compact->clearance);
    compact->area = tl_allocate_array(&compact->allocator, count, sizeof *compact->area);
    if (compact->floor == NULL || compact->clearance == NULL || compact->area == NULL) {
        return TL_ERR_MEMORY;
    }
    compact->first_span[0] = 0;
    tl_run_tasks(host, join_piece, job->task_count, job);
    return TL_OK;
}

static tl_result open_all(open_job *job, const tl_host *host, uint64_t *span_count_out)
{
    TL_TRY(allocate_job(job, host));
    TL_TRY(tl_run_batches(host, job->rows == NULL ? "rasterize" : "compact", open_task, job->task_count,
                          OPEN_TASKS_PER_WORKER, job));
    for (uint32_t w = 0; w < job->worker_count; w++) {
        *span_count_out += job->workers[w].scratch.span_count;
    }
    free_workers(job);
    if (job->rasterizer != NULL) {
        tl_rasterizer_free(job->rasterizer);
    }
    TL_TRY(join_floor_pieces(job, host));
    return tl_nav_link_floors(host, job->compact);
}

static tl_result finish_compact(open_job *job, tl_result result, tl_report *report)
{
    free_workers(job);
    free_pieces(job);
    if (result != TL_OK) {
        tl_nav_compact_free(job->compact);
    }
    return result == TL_ERR_LIMIT ? tl_report_field(report, result, "cell_size",
                                                    "set tile_size, or raise cell_size: a field has too many floors")
                                  : result;
}

static open_job start_job(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact)
{
    open_job job;
    memset(&job, 0, sizeof job);
    memset(compact, 0, sizeof *compact);
    compact->width = config->width;
    compact->height = config->height;
    compact->border_size = config->border_size;
    compact->walkable_height = config->walkable_height;
    compact->walkable_climb = config->walkable_climb;
    compact->lattice = config->lattice;
    compact->bounds = config->bounds;
    compact->cell_size = config->cell_size;
    compact->cell_height = config->cell_height;
    compact->allocator = tl_allocator_or_default(host != NULL ? host->allocator : NULL);
    job.config = config;
    job.compact = compact;
    job.allocator = &compact->allocator;
    return job;
}

tl_result tl_nav_open_triangles(const tl_nav_config *config, const tl_nav_input *input, tl_triangle_list list,
                                const tl_host *host, tl_nav_compact *compact_out, uint64_t *span_count,
                                tl_report *report)
{
    tl_report_begin(report, "rasterize");
    tl_rasterizer rasterizer;
    open_job job = start_job(config, host, compact_out);
    tl_result result = tl_rasterizer_init(&rasterizer, config, &input->mesh, input->areas, list,
                                          config->filter_ledge_spans ? 1 : 0, host);
    if (result == TL_OK) {
        job.rasterizer = &rasterizer;
        job.rows_per_task = rasterizer.rows_per_band;
        job.task_count = rasterizer.band_count;
        result = open_all(&job, host, span_count);
        tl_rasterizer_free(&rasterizer);
    }
    return finish_compact(&job, result, report);
}

tl_result tl_nav_filter_and_compact(const tl_nav_config *config, const tl_nav_heightfield *heightfield,
                                    const tl_host *host, tl_nav_compact *compact_out, tl_report *report_out)
{
    tl_report_begin(report_out, "compact");
    TL_REFUSE_NULL(compact_out, report_out);
    memset(compact_out, 0, sizeof *compact_out);
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(heightfield, report_out);
    const tl_nav_heightfield *field = heightfield;
    if (config->width != field->width || config->height != field->height) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "heightfield",
                               "give the config that it was rasterized with");
    }
    open_job job = start_job(config, host, compact_out);
    const tl_span_rows rows = { field->spans, field->first_span, field->width, field->height, 0 };
    const uint32_t per_task = COLUMNS_PER_TASK / field->width;
    uint64_t span_count = 0;
    job.rows = &rows;
    job.rows_per_task = per_task > 0 ? per_task : 1;
    job.task_count = (field->height - 1) / job.rows_per_task + 1;
    return finish_compact(&job, open_all(&job, host, &span_count), report_out);
}

tl_result tl_nav_bake_compact(const tl_nav_config *config, const tl_nav_heightfield *heightfield, const tl_host *host,
                              tl_nav_compact *compact_out, tl_report *report_out)
{
    if (config == NULL) {
        return tl_nav_filter_and_compact(config, heightfield, host, compact_out, report_out); // which refuses it
    }
    tl_nav_config as_it_is = *config;
    as_it_is.filter_low_hanging_obstacles = false;
    as_it_is.filter_ledge_spans = false;
    as_it_is.filter_walkable_low_height_spans = false;
    return tl_nav_filter_and_compact(&as_it_is, heightfield, host, compact_out, report_out);
}

void tl_nav_compact_free(tl_nav_compact *compact)
{
    if (compact == NULL) {
        return;
    }
    const tl_allocator *allocator = &compact->allocator;
    const uint64_t columns = (uint64_t)compact->width * compact->height, count = compact->span_count;
    tl_release_array(allocator, compact->first_span, columns + 1, sizeof *compact->first_span);
    tl_release_array(allocator, compact->floor, count, sizeof *compact->floor);
    tl_release_array(allocator, compact->clearance, count, sizeof *compact->clearance);
    tl_release_array(allocator, compact->area, count, sizeof *compact->area);
    tl_release_array(allocator, compact->step, 4 * count, sizeof *compact->step);
    tl_release_array(allocator, compact->neighbour, 4 * count, sizeof *compact->neighbour);
    tl_release_array(allocator, compact->distance, count, sizeof *compact->distance);
    tl_release_array(allocator, compact->region, count, sizeof *compact->region);
    memset(compact, 0, sizeof *compact);
}
