// SPDX-License-Identifier: MIT
//
// Triangles sorted into bands of rows by counting, as the host's tasks.
//
// The triangles are cut into blocks. Each block counts for itself how many of its triangles every band has; from that
// follows where in each band's list the block's share begins, and all blocks fill their shares at once. So a list is
// ascending, and the same, for any number of blocks.

#include "nav_bake/input/row_bins.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

#include <string.h>

enum { MIN_BIN_BLOCK = 1024, BLOCKS_PER_WORKER = 4, LINE = 64 / sizeof(uint32_t), AT_ONCE = 64 };
// Rows that a triangle may reach farther than its corners: half of one, where a wall on the field's far side is moved
// inwards; and far more than what is lost when a row is divided by the bin's height.
#define REACH 0.75

// The bins of a triangle: [first, end).
typedef struct row_range {
    uint16_t first, end;
} row_range;

typedef struct row_binning {
    const tl_mesh_view *mesh;
    tl_triangle_list list;
    const tl_lattice_map *map;
    tl_row_grid grid;
    uint32_t block_size, block_count;
    row_range *ranges;   ///< [list.count]
    uint32_t *places;    ///< [block_count][stride] triangles of a block in each bin, then where its next one goes
    uint32_t stride;     ///< whole cache lines, so that no two workers write into one
    uint32_t *triangles; ///< of all bins
} row_binning;

// The rows, in metres, of the list's triangles [begin, end).
static void find_rows_reached(const row_binning *b, uint32_t begin, uint32_t end, float *restrict min,
                              float *restrict max)
{
    const tl_vec3 *vertices = b->mesh->vertices;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t *corner = b->mesh->indices + 3 * (size_t)tl_triangle_list_get(&b->list, i);
        const float z0 = vertices[corner[0]].z, z1 = vertices[corner[1]].z, z2 = vertices[corner[2]].z;
        min[i - begin] = tl_minf(z0, tl_minf(z1, z2));
        max[i - begin] = tl_maxf(z0, tl_maxf(z1, z2));
    }
}

// Bins from rows: without branches, so that compilers make it as wide as the machine's registers. The map is monotone:
// the ends of a range are those of the box.
static void find_row_bins(const row_binning *b, const float *restrict min, const float *restrict max, uint32_t count,
                          row_range *restrict ranges)
{
    const tl_lattice_map map = *b->map;
    const double bins = (double)b->grid.count, per_bin = 1.0 / (double)b->grid.size;
    const double reach = (double)b->grid.margin + REACH;
    for (uint32_t i = 0; i < count; i++) {
        const double first = (tl_lattice_map_z(&map, min[i]) - reach) * per_bin;
        const double end = (tl_lattice_map_z(&map, max[i]) + reach) * per_bin + 1.0;
        ranges[i].first = (uint16_t)(int32_t)tl_min_f64(tl_max_f64(first, 0.0), bins);
        ranges[i].end = (uint16_t)(int32_t)tl_min_f64(tl_max_f64(end, 0.0), bins);
    }
}

static void count_rows_of_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    row_binning *b = user;
    const uint32_t end = tl_block_end(index, b->block_size, b->list.count);
    uint32_t *counts = b->places + (size_t)index * b->stride;
    memset(counts, 0, b->stride * sizeof *counts);
    for (uint32_t begin = index * b->block_size, some; begin < end; begin += some) {
        float min[AT_ONCE], max[AT_ONCE];
        row_range *ranges = b->ranges + begin;
        some = end - begin < AT_ONCE ? end - begin : AT_ONCE;
        find_rows_reached(b, begin, begin + some, min, max);
        find_row_bins(b, min, max, some, ranges);
        for (uint32_t i = 0; i < some; i++) {
            for (uint32_t bin = ranges[i].first; bin < ranges[i].end; bin++) {
                counts[bin]++;
            }
        }
    }
}

static void fill_rows_of_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const row_binning *b = user;
    const uint32_t end = tl_block_end(index, b->block_size, b->list.count);
    uint32_t *next = b->places + (size_t)index * b->stride;
    for (uint32_t i = index * b->block_size; i < end; i++) {
        const uint32_t triangle = tl_triangle_list_get(&b->list, i);
        for (uint32_t bin = b->ranges[i].first; bin < b->ranges[i].end; bin++) {
            b->triangles[next[bin]++] = triangle;
        }
    }
}

// From how many triangles each block has in each bin, to where the first of them goes.
static tl_result place_blocks(const row_binning *b, uint32_t *first)
{
    uint64_t total = 0;
    for (uint32_t bin = 0; bin < b->grid.count; bin++) {
        first[bin] = (uint32_t)total;
        for (uint32_t k = 0; k < b->block_count; k++) {
            uint32_t *place = &b->places[(size_t)k * b->stride + bin];
            const uint32_t count = *place;
            *place = (uint32_t)total;
            total += count;
        }
        if (total > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
    }
    first[b->grid.count] = (uint32_t)total;
    return TL_OK;
}

static tl_result make_row_bins(row_binning *b, const tl_host *host, tl_triangle_bins *bins)
{
    const tl_allocator *allocator = bins->allocator;
    bins->first = tl_allocate_array(allocator, bins->bin_count + 1, sizeof *bins->first);
    b->ranges = tl_allocate_array(allocator, b->list.count, sizeof *b->ranges);
    b->places = tl_allocate_array(allocator, (uint64_t)b->block_count * b->stride, sizeof *b->places);
    if (bins->first == NULL || b->ranges == NULL || b->places == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_run_tasks(host, count_rows_of_block, b->block_count, b);
    TL_TRY(place_blocks(b, bins->first));
    bins->triangles = tl_allocate_array(allocator, bins->first[bins->bin_count], sizeof *bins->triangles);
    if (bins->triangles == NULL) {
        return TL_ERR_MEMORY;
    }
    b->triangles = bins->triangles;
    tl_run_tasks(host, fill_rows_of_block, b->block_count, b);
    return TL_OK;
}

// Counts of blocks take no more memory than triangles do.
static uint32_t choose_block_size(uint32_t triangles, uint32_t bins, uint32_t workers)
{
    const uint32_t wanted = workers > 1 ? triangles / BLOCKS_PER_WORKER / workers + 1 : triangles;
    const uint32_t least = bins > MIN_BIN_BLOCK ? bins : MIN_BIN_BLOCK;
    return wanted > least ? wanted : least;
}

tl_result tl_row_bins_init(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map, tl_row_grid grid,
                           const tl_host *host, tl_triangle_bins *bins)
{
    TL_ASSERT(grid.count >= 1 && grid.count <= TL_MAX_ROW_BINS && grid.size > 0);
    memset(bins, 0, sizeof *bins);
    bins->allocator = host != NULL ? host->allocator : NULL;
    bins->bin_count = grid.count;
    row_binning b = { mesh, list, map, grid, 0, 0, NULL, NULL, 0, NULL };
    b.block_size = choose_block_size(list.count, grid.count, tl_worker_count(host));
    b.block_count = tl_block_count(list.count, b.block_size);
    b.stride = (grid.count + LINE - 1) / LINE * LINE;
    const tl_result result = make_row_bins(&b, host, bins);
    tl_release_array(bins->allocator, b.ranges, list.count, sizeof *b.ranges);
    tl_release_array(bins->allocator, b.places, (uint64_t)b.block_count * b.stride, sizeof *b.places);
    if (result != TL_OK) {
        tl_triangle_bins_free(bins);
    }
    return result;
}
