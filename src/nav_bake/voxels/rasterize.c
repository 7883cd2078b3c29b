// SPDX-License-Identifier: MIT
//
// Triangles to the solid spans of their columns, a band of rows at a time.
//
// A band has so few columns that its unsorted spans and its sort stay in the second-level cache; bands are independent,
// so they may run as tasks and the bytes are the same. Its spans are merged by a rule without order (span_buffer.c).
// Source of the voxelization: Mikko Mononen, Recast (rcRasterizeTriangles), by another method (voxelize.c).

#include "nav_bake/voxels/rasterize.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/input/level_mesh.h"
#include "nav_bake/input/row_bins.h"
#include "nav_bake/voxels/batches.h"
#include "nav_bake/voxels/voxelize.h"

#include <string.h>

enum {
    BAND_COLUMNS = 6144,      // of some 35 bytes each, with their spans: 210 KB
    MIN_BAND_ROWS = 16,       // as each band sees a row more on both sides,
    MAX_TALL_WIDTH = 1 << 17, // unless they are so long that it takes much memory
    SHARED_BAND_ROWS = 12,    // where there would be fewer bands than workers,
    LEAST_BAND_ROWS = 6,      // or else so few
    BANDS_PER_WORKER = 4      // where there would be fewer; and between two calls of the progress hook
};

struct tl_raster_worker {
    tl_span_buffer buffer;
    double *heights;      ///< [TL_VOXEL_HEIGHTS_PER_CELL * line]
    uint32_t *first_span; ///< [width + 1] of a row
};

static tl_result prepare_worker(const tl_rasterizer *r, tl_raster_worker *worker, uint32_t columns)
{
    if (worker->heights == NULL) {
        worker->buffer.allocator = r->allocator;
        worker->buffer.walkable_climb = r->config->walkable_climb;
        worker->heights =
            tl_allocate_array(r->allocator, TL_VOXEL_HEIGHTS_PER_CELL * (uint64_t)r->line, sizeof(double));
        worker->first_span =
            tl_allocate_array(r->allocator, (uint64_t)r->config->width + 1, sizeof *worker->first_span);
        if (worker->heights == NULL || worker->first_span == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_voxel_heights_init(worker->heights, r->line);
    }
    return tl_span_buffer_begin(&worker->buffer, columns);
}

// The area of the block's triangle i, the mesh's `triangle`.
static inline uint32_t area_of(const tl_rasterizer *r, const tl_triangle_block *block, uint32_t i, uint32_t triangle)
{
    bool walkable = block->slope[i] == TL_SLOPE_WALKABLE;
    if (block->slope[i] == TL_SLOPE_UNDECIDED) {
        const uint32_t *corner = r->mesh->indices + 3 * (size_t)triangle;
        const tl_vec3 *vertices = r->mesh->vertices;
        walkable = tl_triangle_is_walkable(vertices[corner[0]], vertices[corner[1]], vertices[corner[2]],
                                           r->config->walkable_slope_cos);
    }
    if (!walkable) {
        return TL_NAV_NULL_AREA;
    }
    return r->areas != NULL ? r->areas[triangle] : TL_NAV_WALKABLE_AREA;
}

static tl_result voxelize_list(const tl_rasterizer *r, const tl_voxel_band *band, tl_triangle_list list)
{
    const tl_block_questions *ask = tl_block_questions_best();
    tl_triangle_block block;
    for (uint32_t first = 0, count; first < list.count; first += count) {
        count = tl_triangle_block_fill(&block, r->mesh, &list, first);
        ask->map(&r->map, r->config->walkable_slope_cos, &block);
        ask->place(band, &block);
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t area = area_of(r, &block, i, tl_triangle_list_get(&list, first + i));
            TL_TRY(tl_voxelize_triangle(band, &block, i, area));
        }
    }
    return TL_OK;
}

tl_result tl_rasterizer_run(tl_rasterizer *rasterizer, uint32_t band_index, uint32_t worker_index,
                            tl_row_source *rows_out)
{
    const tl_rasterizer *r = rasterizer;
    const tl_nav_config *config = r->config;
    tl_raster_worker *worker = &r->workers[worker_index];
    uint32_t begin = band_index * r->rows_per_band;
    uint32_t end = config->height - begin < r->rows_per_band ? config->height : begin + r->rows_per_band;
    begin -= begin < r->margin ? begin : r->margin;
    end += config->height - end < r->margin ? config->height - end : r->margin;
    TL_TRY(prepare_worker(r, worker, config->width * (end - begin)));

    tl_voxel_band band = {
        config->width, begin,           end - begin,    config->height, config->height_voxels, config->border_size == 0,
        r->line,       worker->heights, &worker->buffer
    };
    tl_triangle_list list = r->band_count > 1 ? tl_triangle_bins_get(&r->bins, band_index) : r->list;
    TL_TRY(voxelize_list(r, &band, list));
    const tl_span_rows rows = { NULL, NULL, config->width, config->height, begin };
    *rows_out = (tl_row_source){ rows, &worker->buffer, begin, worker->first_span };
    return TL_OK;
}

// How many bands give all workers something to do: a few for each, of a multiple of their number, unless the bands
// become so low that the rows which two of them see count for much.
static uint32_t bands_to_share(uint32_t height, uint32_t workers)
{
    const uint32_t most = height / SHARED_BAND_ROWS, few = height / LEAST_BAND_ROWS;
    if (workers == 1) {
        return 1;
    }
    if (most <= workers) {
        return few < workers ? few : workers;
    }
    const uint32_t whole = most - most % workers;
    return whole / workers < BANDS_PER_WORKER ? whole : workers * BANDS_PER_WORKER;
}

// Bands of equal height, of about so many columns: a tile that is a little larger is not cut in two.
static uint32_t rows_of_bands(uint32_t width, uint32_t height, uint32_t workers)
{
    const uint64_t wanted = ((uint64_t)width * height + BAND_COLUMNS / 2) / BAND_COLUMNS;
    const uint32_t most = height < TL_MAX_ROW_BINS ? height : TL_MAX_ROW_BINS;
    const uint32_t bands = wanted < 1 ? 1 : wanted < most ? (uint32_t)wanted : most;
    uint32_t rows = (height - 1) / bands + 1;
    rows = rows < MIN_BAND_ROWS && width <= MAX_TALL_WIDTH ? MIN_BAND_ROWS : rows;
    const uint32_t shared = bands_to_share(height, workers);
    const uint32_t rows_to_share = shared > 1 ? (height - 1) / shared + 1 : height;
    return rows < rows_to_share ? rows : rows_to_share;
}

static tl_result init(tl_rasterizer *r, const tl_host *host)
{
    const tl_nav_config *config = r->config;
    r->worker_count = tl_worker_count(host);
    r->rows_per_band = rows_of_bands(config->width, config->height, r->worker_count);
    r->band_count = (config->height - 1) / r->rows_per_band + 1;
    const uint64_t rows_seen = (uint64_t)r->rows_per_band + 2 * (uint64_t)r->margin;
    r->line = rows_seen > config->width ? (uint32_t)rows_seen : config->width;
    r->map = tl_lattice_map_make(&config->lattice, config->cell_size, config->cell_height);
    r->workers = tl_allocate_array(r->allocator, r->worker_count, sizeof *r->workers);
    if (r->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(r->workers, 0, r->worker_count * sizeof *r->workers);
    if (r->band_count > 1) {
        const tl_row_grid grid = { r->band_count, r->rows_per_band, r->margin };
        return tl_row_bins_init(r->mesh, r->list, &r->map, grid, host, &r->bins);
    }
    return TL_OK;
}

tl_result tl_rasterizer_init(tl_rasterizer *rasterizer, const tl_nav_config *config, const tl_mesh_view *mesh,
                             const uint8_t *areas, tl_triangle_list list, uint32_t margin, const tl_host *host)
{
    tl_rasterizer *r = rasterizer;
    memset(r, 0, sizeof *r);
    r->config = config;
    r->mesh = mesh;
    r->areas = areas;
    r->list = list;
    r->margin = margin;
    r->allocator = host != NULL ? host->allocator : NULL;
    tl_result result = init(r, host);
    if (result != TL_OK) {
        tl_rasterizer_free(r);
    }
    return result;
}

void tl_rasterizer_free(tl_rasterizer *rasterizer)
{
    tl_rasterizer *r = rasterizer;
    for (uint32_t w = 0; r->workers != NULL && w < r->worker_count; w++) {
        tl_raster_worker *worker = &r->workers[w];
        tl_span_buffer_free(&worker->buffer);
        tl_release_array(r->allocator, worker->heights, TL_VOXEL_HEIGHTS_PER_CELL * (uint64_t)r->line, sizeof(double));
        tl_release_array(r->allocator, worker->first_span, (uint64_t)r->config->width + 1, sizeof *worker->first_span);
    }
    tl_release_array(r->allocator, r->workers, r->worker_count, sizeof *r->workers);
    tl_triangle_bins_free(&r->bins);
    memset(r, 0, sizeof *r);
}

// ---- The heightfield ---------------------------------------------------------------------------------------

typedef struct band_spans {
    tl_nav_span *spans;
    uint32_t count;
} band_spans;

typedef struct field_job {
    tl_rasterizer rasterizer;
    tl_nav_heightfield *field;
    band_spans *bands; ///< [band_count]
} field_job;

// The spans of all of the buffer's columns; `first_span` has room for one more than these.
static tl_result keep_band(tl_span_buffer *buffer, uint32_t *first_span, const tl_allocator *allocator,
                           band_spans *band)
{
    const tl_nav_span *spans;
    TL_TRY(tl_span_buffer_merge(buffer, first_span, &spans));
    band->count = first_span[buffer->column_count];
    band->spans = tl_allocate_array(allocator, band->count, sizeof *band->spans);
    if (band->spans == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(band->spans, spans, band->count * sizeof *band->spans);
    return TL_OK;
}

static tl_result rasterize_band(uint32_t index, uint32_t worker, void *user)
{
    field_job *job = user;
    tl_nav_heightfield *field = job->field;
    tl_row_source rows; // of the band alone: there is no margin
    TL_TRY(tl_rasterizer_run(&job->rasterizer, index, worker, &rows));
    const uint32_t columns = rows.buffer->column_count;
    uint32_t *first_span = tl_allocate_array(&field->allocator, (uint64_t)columns + 1, sizeof *first_span);
    if (first_span == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_result result = keep_band(rows.buffer, first_span, &field->allocator, &job->bands[index]);
    if (result == TL_OK) {
        memcpy(field->first_span + (size_t)rows.first_row * field->width, first_span, columns * sizeof *first_span);
    }
    tl_release_array(&field->allocator, first_span, (uint64_t)columns + 1, sizeof *first_span);
    return result;
}

// One array of all spans, in the order of the bands; positions within a band become positions in the field.
static tl_result join_bands(field_job *job)
{
    tl_nav_heightfield *field = job->field;
    const uint32_t band_count = job->rasterizer.band_count;
    uint64_t total = 0;
    for (uint32_t b = 0; b < band_count; b++) {
        total += job->bands[b].count;
    }
    if (total >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    field->span_count = (uint32_t)total;
    const uint64_t columns = (uint64_t)field->width * field->height;
    field->first_span[columns] = field->span_count;
    if (band_count == 1) {
        field->spans = job->bands[0].spans;
        job->bands[0].spans = NULL;
        return TL_OK;
    }
    field->spans = tl_allocate_array(&field->allocator, total, sizeof *field->spans);
    if (field->spans == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint64_t columns_per_band = (uint64_t)field->width * job->rasterizer.rows_per_band;
    uint32_t done = 0;
    for (uint32_t b = 0; b < band_count; b++) {
        band_spans *band = &job->bands[b];
        const uint64_t first = b * columns_per_band, left = columns - first;
        for (uint64_t c = 0; c < columns_per_band && c < left; c++) {
            field->first_span[first + c] += done;
        }
        memcpy(field->spans + done, band->spans, band->count * sizeof *band->spans);
        done += band->count;
        tl_release_array(&field->allocator, band->spans, band->count, sizeof *band->spans);
        band->spans = NULL;
    }
    return TL_OK;
}

static tl_result rasterize(field_job *job, const tl_host *host)
{
    tl_nav_heightfield *field = job->field;
    const uint32_t band_count = job->rasterizer.band_count;
    field->first_span =
        tl_allocate_array(&field->allocator, (uint64_t)field->width * field->height + 1, sizeof *field->first_span);
    job->bands = tl_allocate_array(&field->allocator, band_count, sizeof *job->bands);
    if (job->bands != NULL) {
        memset(job->bands, 0, band_count * sizeof *job->bands);
    }
    if (field->first_span == NULL || job->bands == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_run_batches(host, "rasterize", rasterize_band, band_count, BANDS_PER_WORKER, job));
    return join_bands(job);
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
    field->allocator = tl_allocator_or_default(host != NULL ? host->allocator : NULL);

    field_job job;
    memset(&job, 0, sizeof job);
    job.field = field;
    tl_result result = tl_rasterizer_init(&job.rasterizer, config, mesh, areas, list, 0, host);
    if (result == TL_OK) {
        result = rasterize(&job, host);
        for (uint32_t b = 0; job.bands != NULL && b < job.rasterizer.band_count; b++) {
            tl_release_array(&field->allocator, job.bands[b].spans, job.bands[b].count, sizeof *job.bands[b].spans);
        }
        tl_release_array(&field->allocator, job.bands, job.rasterizer.band_count, sizeof *job.bands);
        tl_rasterizer_free(&job.rasterizer);
    }
    if (result != TL_OK) {
        tl_nav_heightfield_free(field);
    }
    if (result == TL_ERR_LIMIT) {
        tl_report_field(report, result, "cell_size",
                        "set tile_size, or raise cell_size: there are more spans than 32 bits can count");
    }
    return result;
}

tl_result tl_nav_rasterize(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                           const tl_host *host, tl_nav_heightfield *heightfield_out, tl_report *report_out)
{
    tl_report_begin(report_out, "rasterize");
    TL_REFUSE_NULL(heightfield_out, report_out);
    memset(heightfield_out, 0, sizeof *heightfield_out);
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(mesh, report_out);
    TL_TRY(tl_level_mesh_check(mesh, host, NULL, report_out));
    tl_triangle_list all = { NULL, mesh->triangle_count };
    return tl_nav_rasterize_list(config, mesh, areas, all, host, heightfield_out, report_out);
}
