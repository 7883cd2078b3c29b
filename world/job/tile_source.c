// SPDX-License-Identifier: MIT

#include "world/job/tile_source.h"

#include "world/bytes/little_endian.h"
#include "world/job/tile_sums.h"

#include <stdlib.h>
#include <string.h>

#define CELL_MASK ((UINT64_C(1) << 40) - 1)

// Counts the cells of each tile in first_cell[tile + 1], or with `fill` puts them where first_cell[tile] says.
static void pass_over_cells(tl_world_source *source, bool fill)
{
    const tl_world_plan *plan = source->plan;
    for (uint32_t s = 0; s < source->segments.count; s++) {
        const tl_world_segment *segment = &source->segments.items[s];
        for (uint64_t c = 0; c < segment->head.cells; c++) {
            tl_nav_tile_range range;
            if (!tl_world_grid_tiles_of_cell(&plan->grid, &segment->cells[c], &range)) {
                continue;
            }
            for (uint32_t z = range.z; z < range.z + range.count_z; z++) {
                for (uint64_t t = tl_world_plan_find(plan, range.x, z);
                     t < plan->tile_count && plan->tiles[t].z == z && plan->tiles[t].x < range.x + range.count_x; t++) {
                    if (fill) {
                        source->cells[source->first_cell[t]++] = (uint64_t)s << 40 | c;
                    } else {
                        source->first_cell[t + 1]++;
                    }
                }
            }
        }
    }
}

static bool list_cells(tl_world_source *source)
{
    const uint64_t tiles = source->plan->tile_count;
    source->first_cell = calloc((size_t)tiles + 1, sizeof *source->first_cell);
    if (source->first_cell == NULL) {
        return false;
    }
    pass_over_cells(source, false);
    for (uint64_t t = 0; t < tiles; t++) {
        source->first_cell[t + 1] += source->first_cell[t];
    }
    source->cells = malloc((size_t)source->first_cell[tiles] * sizeof *source->cells + 1);
    if (source->cells == NULL) {
        return false;
    }
    // Filling moves each tile's start to its end, which is the next one's start.
    pass_over_cells(source, true);
    memmove(source->first_cell + 1, source->first_cell, (size_t)tiles * sizeof *source->first_cell);
    source->first_cell[0] = 0;
    return true;
}

tl_result tl_world_source_open(const char *job, const tl_world_plan *plan, tl_world_source *source_out,
                               tl_io_error *error_out)
{
    memset(source_out, 0, sizeof *source_out);
    source_out->plan = plan;
    char *folder = tl_world_job_path(job, "store");
    tl_result result = TL_ERR_MEMORY;
    if (folder != NULL) {
        result = tl_world_segments_open(folder, plan->inputs, plan->input_count, &source_out->segments, error_out);
    }
    free(folder);
    if (result == TL_OK && !list_cells(source_out)) {
        result = TL_ERR_MEMORY;
    }
    return result == TL_ERR_MEMORY ? tl_io_fail(error_out, result, job, 0, "", "out of memory") : result;
}

void tl_world_source_close(tl_world_source *source)
{
    tl_world_segments_close(&source->segments);
    free(source->first_cell);
    free(source->cells);
    memset(source, 0, sizeof *source);
}

static bool grow_window(tl_world_window *window)
{
    const uint64_t wanted = window->capacity > 0 ? 2 * window->capacity : 4096;
    if (wanted > TL_MAX_MESH_TRIANGLES || wanted > SIZE_MAX / 64) {
        return false;
    }
    tl_vec3 *vertices = realloc(window->vertices, 3 * (size_t)wanted * sizeof *vertices);
    window->vertices = vertices != NULL ? vertices : window->vertices;
    uint32_t *indices = realloc(window->indices, 3 * (size_t)wanted * sizeof *indices);
    window->indices = indices != NULL ? indices : window->indices;
    uint8_t *areas = realloc(window->areas, (size_t)wanted);
    window->areas = areas != NULL ? areas : window->areas;
    if (vertices == NULL || indices == NULL || areas == NULL) {
        return false;
    }
    for (uint64_t i = 3 * window->capacity; i < 3 * wanted; i++) {
        indices[i] = (uint32_t)i;
    }
    window->capacity = wanted;
    return true;
}

static bool push_record(tl_world_window *window, const double origin[3], const unsigned char *record)
{
    if (window->count == window->capacity && !grow_window(window)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        window->vertices[3 * (size_t)window->count + (size_t)k] =
            tl_vec3_make((float)(origin[0] + (double)tl_get_float(record + 12 * k)),
                         (float)(origin[1] + (double)tl_get_float(record + 12 * k + 4)),
                         (float)(origin[2] + (double)tl_get_float(record + 12 * k + 8)));
    }
    window->areas[window->count++] = record[36];
    return true;
}

// The records of a cell that can touch the tile; their hashes are added to `sum`.
static bool take_records(const tl_world_source *source, const tl_world_tile *tile, const tl_world_segment_cell *cell,
                         tl_world_window *window, tl_content_hash *sum)
{
    const tl_world_grid *grid = &source->plan->grid;
    double origin[3], from[3];
    tl_world_cell_origin(&cell->cell, grid->cell_size, origin);
    for (int i = 0; i < 3; i++) {
        from[i] = origin[i] - grid->origin[i];
    }
    for (uint32_t i = 0; i < cell->count; i++) {
        const unsigned char *record = window->records + (size_t)i * TL_WORLD_RECORD_BYTES;
        tl_nav_tile_range range;
        if (!tl_world_grid_tiles_of_record(grid, origin, record, &range) || tile->x < range.x || tile->z < range.z ||
            tile->x >= range.x + range.count_x || tile->z >= range.z + range.count_z) {
            continue;
        }
        *sum = tl_content_hash_add(*sum, tl_world_record_hash(&cell->cell, record));
        if (!push_record(window, from, record)) {
            return false;
        }
    }
    return true;
}

static bool hold_records(tl_world_window *window, uint64_t count)
{
    if (count > window->record_capacity) {
        unsigned char *grown =
            count < SIZE_MAX / 64 ? realloc(window->records, (size_t)count * TL_WORLD_RECORD_BYTES) : NULL;
        if (grown == NULL) {
            return false;
        }
        window->records = grown;
        window->record_capacity = count;
    }
    return true;
}

tl_result tl_world_window_gather(const tl_world_source *source, uint64_t tile_index, tl_world_window *window,
                                 tl_io_error *error_out)
{
    const tl_world_tile *tile = &source->plan->tiles[tile_index];
    tl_content_hash sum = { 0, 0 };
    window->count = 0;
    for (uint64_t i = source->first_cell[tile_index]; i < source->first_cell[tile_index + 1]; i++) {
        const tl_world_segment *segment = &source->segments.items[source->cells[i] >> 40];
        const tl_world_segment_cell *cell = &segment->cells[source->cells[i] & CELL_MASK];
        if (!hold_records(window, cell->count)) {
            return tl_io_fail(error_out, TL_ERR_MEMORY, segment->path, 0, "", "out of memory");
        }
        const tl_result result =
            tl_world_segment_read(segment, source->cells[i] & CELL_MASK, window->records, error_out);
        if (result != TL_OK) {
            return result;
        }
        if (!take_records(source, tile, cell, window, &sum)) {
            return tl_io_fail(error_out, TL_ERR_MEMORY, segment->path, 0, "give smaller tiles",
                              "out of memory for the triangles of tile %u,%u", tile->x, tile->z);
        }
    }
    const tl_content_hash key = tl_world_tile_key(tl_world_grid_hash(&source->plan->grid), tile, sum);
    if (window->count != tile->triangles || !tl_content_hash_equal(key, tile->key)) {
        return tl_io_fail(error_out, TL_ERR_STALE, NULL, 0, "run 'talus world plan' again",
                          "tile %u,%u: the store does not hold the triangles that were planned", tile->x, tile->z);
    }
    return TL_OK;
}

tl_nav_input tl_world_window_input(const tl_world_window *window)
{
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh.vertices = window->vertices;
    input.mesh.vertex_count = 3 * window->count;
    input.mesh.indices = window->indices;
    input.mesh.triangle_count = window->count;
    input.areas = window->areas;
    return input;
}

void tl_world_window_free(tl_world_window *window)
{
    free(window->vertices);
    free(window->indices);
    free(window->areas);
    free(window->records);
    memset(window, 0, sizeof *window);
}
