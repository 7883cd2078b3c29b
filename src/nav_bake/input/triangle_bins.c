// SPDX-License-Identifier: MIT
//
// Triangles sorted into bins by counting, so that the level is read a few times in all, not once for each bin.

#include "nav_bake/input/triangle_bins.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/radix_sort.h"

#include <string.h>
#include <talus/nav_tile.h>

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
    const tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
    // The map is monotone: the ends of the range are those of the box.
    const double min_z = tl_lattice_map_z(map, tl_minf(a.z, tl_minf(b.z, c.z)));
    const double max_z = tl_lattice_map_z(map, tl_maxf(a.z, tl_maxf(b.z, c.z)));
    bin_range range = { 1, 0, 0, 0 };
    uint32_t x0, x1, z0, z1;
    const double min_x = tl_lattice_map_x(map, tl_minf(a.x, tl_minf(b.x, c.x)));
    const double max_x = tl_lattice_map_x(map, tl_maxf(a.x, tl_maxf(b.x, c.x)));
    if (!bins_along(min_z, max_z, grid->count_z, grid->size_z, grid->margin, &z0, &z1) ||
        !bins_along(min_x, max_x, grid->count_x, grid->size_x, grid->margin, &x0, &x1)) {
        return range;
    }
    return (bin_range){ x0, x1, z0, z1 };
}

// The bins of a sparse grid that hold triangles: a hash table from places to bins, by linear probing, at most half
// full.
typedef struct place_table {
    uint32_t *places; // NO_PLACE: free
    uint32_t *bins;
    uint64_t mask;
    uint64_t count;
} place_table;

#define NO_PLACE UINT32_MAX

enum { FIRST_PLACES = 1024 };

static bool place_table_make(place_table *table, uint64_t size, const tl_allocator *allocator)
{
    table->places = tl_allocate_array(allocator, 2 * size, sizeof *table->places);
    if (table->places == NULL) {
        return false;
    }
    table->bins = table->places + size;
    table->mask = size - 1;
    table->count = 0;
    memset(table->places, 0xff, (size_t)size * sizeof *table->places);
    return true;
}

static void place_table_free(place_table *table, const tl_allocator *allocator)
{
    if (table->places != NULL) {
        tl_release_array(allocator, table->places, 2 * (table->mask + 1), sizeof *table->places);
        table->places = NULL;
    }
}

// The slot of a place, or the free one where it goes.
static uint64_t place_slot(const place_table *table, uint32_t place)
{
    uint64_t slot = tl_hash_mix(place) & table->mask;
    while (table->places[slot] != NO_PLACE && table->places[slot] != place) {
        slot = (slot + 1) & table->mask;
    }
    return slot;
}

static tl_result add_place(place_table *table, uint32_t place, const tl_allocator *allocator)
{
    uint64_t slot = place_slot(table, place);
    if (table->places[slot] == place) {
        return TL_OK;
    }
    if (table->count >= TL_NAV_MAX_TILES) {
        return TL_ERR_LIMIT;
    }
    if (2 * (table->count + 1) > table->mask + 1) {
        place_table grown;
        if (!place_table_make(&grown, 2 * (table->mask + 1), allocator)) {
            return TL_ERR_MEMORY;
        }
        for (uint64_t i = 0; i <= table->mask; i++) {
            if (table->places[i] != NO_PLACE) {
                grown.places[place_slot(&grown, table->places[i])] = table->places[i];
            }
        }
        grown.count = table->count;
        place_table_free(table, allocator);
        *table = grown;
        slot = place_slot(table, place);
    }
    table->places[slot] = place;
    table->count++;
    return TL_OK;
}

// What the bins are made from.
typedef struct bin_source {
    const tl_mesh_view *mesh;
    tl_triangle_list list;
    const tl_lattice_map *map;
    const tl_bin_grid *grid;
    place_table table; // of a sparse grid
} bin_source;

// The bins of the list's triangle i.
static bin_range listed_range(const bin_source *source, uint32_t i)
{
    return triangle_range(source->mesh, tl_triangle_list_get(&source->list, i), source->map, source->grid);
}

static uint32_t bin_at(const bin_source *source, uint32_t x, uint32_t z)
{
    const uint32_t place = z * source->grid->count_x + x;
    return source->table.places == NULL ? place : source->table.bins[place_slot(&source->table, place)];
}

static tl_result add_places_of(bin_source *source, bin_range range, const tl_allocator *allocator)
{
    for (uint32_t z = range.z0; z <= range.z1; z++) {
        for (uint32_t x = range.x0; x <= range.x1; x++) {
            TL_TRY(add_place(&source->table, z * source->grid->count_x + x, allocator));
        }
    }
    return TL_OK;
}

// Finds the bins to keep, and numbers them by their places.
static tl_result keep_bins(bin_source *source, tl_triangle_bins *bins)
{
    const tl_allocator *allocator = bins->allocator;
    if (!place_table_make(&source->table, FIRST_PLACES, allocator)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < source->list.count; i++) {
        const bin_range range = listed_range(source, i);
        if (range.x1 >= range.x0) {
            TL_TRY(add_places_of(source, range, allocator));
        }
    }
    place_table *table = &source->table;
    const uint64_t count = table->count;
    bins->bin_count = count;
    bins->places = tl_allocate_array(allocator, count, sizeof *bins->places);
    tl_sort_item *items = tl_allocate_array(allocator, 2 * count, sizeof *items);
    if (items != NULL && bins->places != NULL) {
        uint32_t next = 0;
        for (uint64_t slot = 0; slot <= table->mask; slot++) {
            if (table->places[slot] != NO_PLACE) {
                items[next++] = (tl_sort_item){ table->places[slot], (uint32_t)slot, 0 };
            }
        }
        tl_radix_sort(items, items + count, (uint32_t)count);
        for (uint32_t bin = 0; bin < count; bin++) {
            bins->places[bin] = (uint32_t)items[bin].key;
            table->bins[items[bin].value] = bin;
        }
    }
    const bool made = items != NULL && bins->places != NULL;
    tl_release_array(allocator, items, 2 * count, sizeof *items);
    return made ? TL_OK : TL_ERR_MEMORY;
}

static tl_result count_triangles(const bin_source *source, tl_triangle_bins *bins)
{
    uint64_t total = 0;
    memset(bins->first, 0, (size_t)(bins->bin_count + 1) * sizeof *bins->first);
    for (uint32_t i = 0; i < source->list.count; i++) {
        const bin_range range = listed_range(source, i);
        if (range.x1 < range.x0) {
            continue;
        }
        total += (uint64_t)(range.x1 - range.x0 + 1) * (range.z1 - range.z0 + 1);
        if (total > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
        for (uint32_t z = range.z0; z <= range.z1; z++) {
            for (uint32_t x = range.x0; x <= range.x1; x++) {
                bins->first[(uint64_t)bin_at(source, x, z) + 1]++;
            }
        }
    }
    for (uint64_t b = 0; b < bins->bin_count; b++) {
        bins->first[b + 1] += bins->first[b];
    }
    return TL_OK;
}

// Fills from each bin's start, which moves to its end, and so to the next bin's start; then moves all back by one.
static void fill_bins(const bin_source *source, tl_triangle_bins *bins)
{
    for (uint32_t i = 0; i < source->list.count; i++) {
        const uint32_t triangle = tl_triangle_list_get(&source->list, i);
        const bin_range range = listed_range(source, i);
        if (range.x1 < range.x0) {
            continue;
        }
        for (uint32_t z = range.z0; z <= range.z1; z++) {
            for (uint32_t x = range.x0; x <= range.x1; x++) {
                bins->triangles[bins->first[bin_at(source, x, z)]++] = triangle;
            }
        }
    }
    memmove(bins->first + 1, bins->first, (size_t)bins->bin_count * sizeof *bins->first);
    bins->first[0] = 0;
}

static tl_result make_bins(bin_source *source, tl_triangle_bins *bins)
{
    if (source->grid->sparse) {
        TL_TRY(keep_bins(source, bins));
    }
    uint32_t *first = tl_allocate_array(bins->allocator, bins->bin_count + 1, sizeof *first);
    if (first == NULL) {
        return TL_ERR_MEMORY;
    }
    bins->first = first;
    tl_result result = count_triangles(source, bins);
    if (result == TL_OK) {
        bins->triangles = tl_allocate_array(bins->allocator, first[bins->bin_count], sizeof *bins->triangles);
        result = bins->triangles != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    if (result == TL_OK) {
        fill_bins(source, bins);
    }
    return result;
}

tl_result tl_triangle_bins_init(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map,
                                const tl_bin_grid *grid, const tl_allocator *allocator, tl_triangle_bins *bins)
{
    memset(bins, 0, sizeof *bins);
    bins->allocator = allocator;
    bins->bin_count = (uint64_t)grid->count_x * grid->count_z;
    bin_source source = { mesh, list, map, grid, { NULL, NULL, 0, 0 } };
    tl_result result = make_bins(&source, bins);
    place_table_free(&source.table, allocator);
    if (result != TL_OK) {
        tl_triangle_bins_free(bins);
    }
    return result;
}

void tl_triangle_bins_free(tl_triangle_bins *bins)
{
    if (bins->triangles != NULL) {
        tl_release_array(bins->allocator, bins->triangles, bins->first[bins->bin_count], sizeof *bins->triangles);
    }
    tl_release_array(bins->allocator, bins->first, bins->bin_count + 1, sizeof *bins->first);
    tl_release_array(bins->allocator, bins->places, bins->bin_count, sizeof *bins->places);
    memset(bins, 0, sizeof *bins);
}
