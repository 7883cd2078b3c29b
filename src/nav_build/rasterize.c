// SPDX-License-Identifier: MIT
//
// Triangles to a heightfield of solid spans, a band of rows at a time.
//
// A band has so few columns that its unsorted spans and its sort stay in the second-level cache; bands are independent,
// so they may run as tasks and the bytes are the same. Its spans are merged by a rule without order (span_buffer.c).
// Source of the voxelization: Mikko Mononen, Recast (rcRasterizeTriangles), by another method (voxelize.c).

#include "nav_build/rasterize.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_build/level_mesh.h"

#include <string.h>

enum {
    BAND_COLUMNS = 16384,  // 4 items each, twice, of 8 bytes: 1 MB
    BATCHES_PER_WORKER = 4 // bands between two calls of the progress hook, a worker
};

typedef struct band_spans {
    tl_nav_span *spans;
    uint32_t count;
    tl_result result;
} band_spans;

typedef struct worker_scratch {
    tl_span_buffer buffer;
    double *heights; ///< [TL_VOXEL_HEIGHTS_PER_COLUMN * width]
} worker_scratch;

typedef struct raster_job {
    const tl_nav_config *config;
    const tl_mesh_view *mesh;
    const uint8_t *areas;
    const tl_allocator *allocator;
    tl_triangle_list list;
    tl_triangle_bins bins; ///< by band; not made when there is one band
    tl_lattice_map map;
    uint32_t rows_per_band;
    uint32_t band_count;
    band_spans *bands;       ///< [band_count]
    worker_scratch *workers; ///< [worker_count]
    uint32_t worker_count;
    uint32_t first_band; ///< of the batch at hand
    tl_nav_heightfield *heightfield;
} raster_job;

static tl_result prepare_worker(raster_job *job, worker_scratch *scratch, uint32_t columns)
{
    const uint64_t width = job->config->width;
    if (scratch->heights == NULL) {
        scratch->buffer.allocator = job->allocator;
        scratch->buffer.walkable_climb = job->config->walkable_climb;
        scratch->heights = tl_allocate_array(job->allocator, TL_VOXEL_HEIGHTS_PER_COLUMN * width, sizeof(double));
        if (scratch->heights == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_voxel_heights_init(scratch->heights, job->config->width);
    }
    return tl_span_buffer_begin(&scratch->buffer, columns);
}

static tl_result voxelize_list(const raster_job *job, const tl_voxel_band *band, tl_triangle_list list)
{
    const tl_nav_config *config = job->config;
    const tl_mesh_view *mesh = job->mesh;
    for (uint32_t i = 0; i < list.count; i++) {
        uint32_t triangle = tl_triangle_list_get(&list, i);
        const uint32_t *corner = mesh->indices + 3 * (size_t)triangle;
        tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
        uint32_t area = TL_NAV_NULL_AREA;
        if (tl_triangle_is_walkable(a, b, c, config->walkable_slope_cos)) {
            area = job->areas != NULL ? job->areas[triangle] : TL_NAV_WALKABLE_AREA;
        }
        TL_TRY(tl_voxelize_triangle(band, tl_lattice_map_point(&job->map, a), tl_lattice_map_point(&job->map, b),
                                    tl_lattice_map_point(&job->map, c), area));
    }
    return TL_OK;
}

static tl_result rasterize_band(raster_job *job, uint32_t band_index, worker_scratch *scratch)
{
    const tl_nav_config *config = job->config;
    uint32_t first_row = band_index * job->rows_per_band;
    uint32_t rows = config->height - first_row < job->rows_per_band ? config->height - first_row : job->rows_per_band;
    TL_TRY(prepare_worker(job, scratch, config->width * rows));

    tl_voxel_band band = {
        config->width,    first_row,       rows, config->height, config->height_voxels, config->border_size == 0,
        scratch->heights, &scratch->buffer
    };
    tl_triangle_list list = job->band_count > 1 ? tl_triangle_bins_get(&job->bins, band_index) : job->list;
    TL_TRY(voxelize_list(job, &band, list));

    const tl_nav_span *spans;
    band_spans *result = &job->bands[band_index];
    uint64_t first_column = (uint64_t)first_row * config->width;
    tl_span_buffer_merge(&scratch->buffer, job->heightfield->first_span + first_column + 1, &spans, &result->count);
    result->spans = tl_allocate_array(job->allocator, result->count, sizeof *spans);
    if (result->spans == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(result->spans, spans, result->count * sizeof *spans);
    return TL_OK;
}

static void rasterize_band_task(uint32_t index, uint32_t worker, void *task_user)
{
    raster_job *job = task_user;
    uint32_t band = job->first_band + index;
    job->bands[band].result = rasterize_band(job, band, &job->workers[worker]);
}

// All bands, in batches so that the progress hook is called here between them.
static tl_result rasterize_bands(raster_job *job, const tl_host *host)
{
    uint32_t batch = job->band_count;
    if (host != NULL && host->progress != NULL) {
        batch = job->worker_count * BATCHES_PER_WORKER;
    }
    for (job->first_band = 0; job->first_band < job->band_count; job->first_band += batch) {
        TL_TRY(tl_progress_update(host, "rasterize", job->first_band, job->band_count));
        uint32_t left = job->band_count - job->first_band;
        uint32_t count = left < batch ? left : batch;
        tl_run_tasks(host, rasterize_band_task, count, job);
        for (uint32_t i = 0; i < count; i++) {
            TL_TRY(job->bands[job->first_band + i].result);
        }
        if (left <= batch) {
            break;
        }
    }
    return tl_progress_update(host, "rasterize", job->band_count, job->band_count);
}

// One array of all spans, in the order of the bands; counts become positions.
static tl_result join_bands(raster_job *job)
{
    tl_nav_heightfield *field = job->heightfield;
    uint64_t total = 0;
    for (uint32_t b = 0; b < job->band_count; b++) {
        total += job->bands[b].count;
    }
    if (total >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    field->span_count = (uint32_t)total;
    if (job->band_count == 1) {
        field->spans = job->bands[0].spans;
        job->bands[0].spans = NULL;
    } else {
        field->spans = tl_allocate_array(job->allocator, total, sizeof *field->spans);
        if (field->spans == NULL) {
            return TL_ERR_MEMORY;
        }
        uint64_t done = 0;
        for (uint32_t b = 0; b < job->band_count; b++) {
            band_spans *band = &job->bands[b];
            memcpy(field->spans + done, band->spans, band->count * sizeof *band->spans);
            done += band->count;
            tl_release_array(job->allocator, band->spans, band->count, sizeof *band->spans);
            band->spans = NULL;
        }
    }
    const uint64_t columns = (uint64_t)field->width * field->height;
    field->first_span[0] = 0;
    for (uint64_t c = 0; c < columns; c++) {
        field->first_span[c + 1] += field->first_span[c];
    }
    return TL_OK;
}

static tl_result start_job(raster_job *job, const tl_host *host)
{
    const tl_nav_config *config = job->config;
    uint32_t rows = BAND_COLUMNS / config->width;
    job->rows_per_band = rows > 0 ? rows : 1;
    job->band_count = (config->height - 1) / job->rows_per_band + 1;
    job->worker_count = tl_worker_count(host);
    job->map = tl_lattice_map_make(&config->lattice, config->cell_size, config->cell_height);

    const uint64_t columns = (uint64_t)config->width * config->height;
    job->heightfield->first_span = tl_allocate_array(job->allocator, columns + 1, sizeof(uint32_t));
    job->bands = tl_allocate_array(job->allocator, job->band_count, sizeof *job->bands);
    job->workers = tl_allocate_array(job->allocator, job->worker_count, sizeof *job->workers);
    if (job->bands != NULL) {
        memset(job->bands, 0, job->band_count * sizeof *job->bands);
    }
    if (job->workers != NULL) {
        memset(job->workers, 0, job->worker_count * sizeof *job->workers);
    }
    if (job->heightfield->first_span == NULL || job->bands == NULL || job->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    if (job->band_count > 1) {
        tl_bin_grid grid = { 1, job->band_count, config->width, job->rows_per_band, 0 };
        return tl_triangle_bins_build(job->mesh, job->list, &job->map, &grid, job->allocator, &job->bins);
    }
    return TL_OK;
}

static void end_job(raster_job *job)
{
    for (uint32_t w = 0; job->workers != NULL && w < job->worker_count; w++) {
        tl_span_buffer_free(&job->workers[w].buffer);
        tl_release_array(job->allocator, job->workers[w].heights,
                         TL_VOXEL_HEIGHTS_PER_COLUMN * (uint64_t)job->config->width, sizeof(double));
    }
    for (uint32_t b = 0; job->bands != NULL && b < job->band_count; b++) {
        tl_release_array(job->allocator, job->bands[b].spans, job->bands[b].count, sizeof(tl_nav_span));
    }
    tl_release_array(job->allocator, job->workers, job->worker_count, sizeof *job->workers);
    tl_release_array(job->allocator, job->bands, job->band_count, sizeof *job->bands);
    tl_triangle_bins_free(&job->bins);
}

tl_result tl_nav_rasterize_list(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                                tl_triangle_list list, const tl_host *host, tl_nav_heightfield *heightfield_out,
                                tl_report *report)
{
    tl_nav_heightfield *field = heightfield_out;
    memset(field, 0, sizeof *field);
    field->width = config->width;
    field->height = config->height;
    field->lattice = config->lattice;
    field->bounds = config->bounds;
    field->cell_size = config->cell_size;
    field->cell_height = config->cell_height;
    field->allocator = host != NULL ? host->allocator : NULL;

    raster_job job;
    memset(&job, 0, sizeof job);
    job.config = config;
    job.mesh = mesh;
    job.areas = areas;
    job.list = list;
    job.allocator = field->allocator;
    job.heightfield = field;

    tl_result result = start_job(&job, host);
    result = result == TL_OK ? rasterize_bands(&job, host) : result;
    result = result == TL_OK ? join_bands(&job) : result;
    end_job(&job);
    if (result != TL_OK) {
        tl_nav_heightfield_free(field);
    }
    if (result == TL_ERR_LIMIT) {
        tl_report_fail(report, result, "cell_size", TL_NO_ELEMENT,
                       "set tile_size, or raise cell_size: there are more spans than 32 bits can count");
    }
    return result;
}

tl_result tl_nav_rasterize(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                           const tl_host *host, tl_nav_heightfield *heightfield_out, tl_report *report_out)
{
    tl_report_begin(report_out, "rasterize");
    memset(heightfield_out, 0, sizeof *heightfield_out);
    TL_TRY(tl_level_mesh_check(mesh, NULL, report_out));
    tl_triangle_list all = { NULL, mesh->triangle_count };
    return tl_nav_rasterize_list(config, mesh, areas, all, host, heightfield_out, report_out);
}
