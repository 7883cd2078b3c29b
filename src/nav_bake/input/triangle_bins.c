// SPDX-License-Identifier: MIT
//
// Triangles sorted into bins (tiles, or bands of rows) by counting, so that the level is read twice in all and not once
// for each bin.

#include "nav_bake/input/triangle_bins.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

typedef struct bin_range {
    uint32_t x0, x1, z0, z1; ///< inclusive; empty when x1 < x0
} bin_range;

// Bins along one axis whose columns [i * size - margin, (i + 1) * size + margin) meet [min, max], points that only
// touch included.
static bool bins_along(double min, double max, uint32_t count, uint32_t size, uint32_t margin, uint32_t *first_out,
                       uint32_t *last_out)
{
    const double low = -(double)margin, high = (double)count * (double)size + (double)margin;
    if (max < low || min > high) {
        return false;
    }
    // Cut to the grid, so the conversions hold; one column more on each side costs nothing. 2^30 + 2^16 is below 2^31.
    int32_t begin = (int32_t)(min > low ? min : low) - 1 - (int32_t)margin;
    uint32_t end = (uint32_t)((int32_t)(max < high ? max : high) + 1 + (int32_t)margin);
    uint32_t first = begin > 0 ? (uint32_t)begin / size : 0, last = end / size;
    *first_out = first;
    *last_out = last < count ? last : count - 1;
    return true;
}

static bin_range triangle_range(const tl_mesh_view *mesh, uint32_t triangle, const tl_lattice_map *map,
                                const tl_bin_grid *grid)
{
    const uint32_t *corner = mesh->indices + 3 * (size_t)triangle;
    tl_aabb box = tl_aabb_empty();
    for (int k = 0; k < 3; k++) {
        box = tl_aabb_add_point(box, mesh->vertices[corner[k]]);
    }
    // The map is monotone: the ends of the range are those of the box.
    const double min_x = tl_lattice_map_x(map, box.min.x), max_x = tl_lattice_map_x(map, box.max.x);
    const double min_z = tl_lattice_map_z(map, box.min.z), max_z = tl_lattice_map_z(map, box.max.z);
    bin_range range = { 1, 0, 0, 0 };
    uint32_t x0, x1, z0, z1;
    if (bins_along(min_x, max_x, grid->count_x, grid->size_x, grid->margin, &x0, &x1) &&
        bins_along(min_z, max_z, grid->count_z, grid->size_z, grid->margin, &z0, &z1)) {
        range = (bin_range){ x0, x1, z0, z1 };
    }
    return range;
}

static tl_result count_triangles(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map,
                                 const tl_bin_grid *grid, tl_triangle_bins *bins)
{
    uint64_t total = 0;
    memset(bins->first, 0, (bins->bin_count + 1) * sizeof *bins->first);
    for (uint32_t i = 0; i < list.count; i++) {
        bin_range range = triangle_range(mesh, tl_triangle_list_get(&list, i), map, grid);
        if (range.x1 < range.x0) {
            continue;
        }
        total += (uint64_t)(range.x1 - range.x0 + 1) * (range.z1 - range.z0 + 1);
        if (total > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
        for (uint32_t z = range.z0; z <= range.z1; z++) {
            for (uint32_t x = range.x0; x <= range.x1; x++) {
                bins->first[(uint64_t)z * grid->count_x + x + 1]++;
            }
        }
    }
    for (uint64_t b = 0; b < bins->bin_count; b++) {
        bins->first[b + 1] += bins->first[b];
    }
    return TL_OK;
}

// Fills from each bin's start, which moves to its end, and so to the next bin's start; then moves all back by one.
static void fill_bins(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map,
                      const tl_bin_grid *grid, tl_triangle_bins *bins)
{
    for (uint32_t i = 0; i < list.count; i++) {
        uint32_t triangle = tl_triangle_list_get(&list, i);
        bin_range range = triangle_range(mesh, triangle, map, grid);
        if (range.x1 < range.x0) {
            continue;
        }
        for (uint32_t z = range.z0; z <= range.z1; z++) {
            for (uint32_t x = range.x0; x <= range.x1; x++) {
                bins->triangles[bins->first[(uint64_t)z * grid->count_x + x]++] = triangle;
            }
        }
    }
    memmove(bins->first + 1, bins->first, bins->bin_count * sizeof *bins->first);
    bins->first[0] = 0;
}

tl_result tl_triangle_bins_init(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map,
                                const tl_bin_grid *grid, const tl_allocator *allocator, tl_triangle_bins *bins_out)
{
    tl_triangle_bins *bins = bins_out;
    memset(bins, 0, sizeof *bins);
    bins->allocator = allocator;
    bins->bin_count = (uint64_t)grid->count_x * grid->count_z;
    bins->first = tl_allocate_array(allocator, bins->bin_count + 1, sizeof *bins->first);
    if (bins->first == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = count_triangles(mesh, list, map, grid, bins);
    if (result == TL_OK) {
        bins->triangles = tl_allocate_array(allocator, bins->first[bins->bin_count], sizeof *bins->triangles);
        result = bins->triangles != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    if (result != TL_OK) {
        tl_release_array(allocator, bins->first, bins->bin_count + 1, sizeof *bins->first);
        memset(bins, 0, sizeof *bins);
        return result;
    }
    fill_bins(mesh, list, map, grid, bins);
    return TL_OK;
}

void tl_triangle_bins_free(tl_triangle_bins *bins)
{
    if (bins->first != NULL) {
        tl_release_array(bins->allocator, bins->triangles, bins->first[bins->bin_count], sizeof *bins->triangles);
        tl_release_array(bins->allocator, bins->first, bins->bin_count + 1, sizeof *bins->first);
    }
    memset(bins, 0, sizeof *bins);
}
