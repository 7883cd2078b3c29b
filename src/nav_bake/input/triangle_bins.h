// SPDX-License-Identifier: MIT
//
// The triangles of each part of a lattice: of the bands of rows of a heightfield, of the tiles of a level.

#ifndef TALUS_SRC_NAV_BAKE_TRIANGLE_BINS_H
#define TALUS_SRC_NAV_BAKE_TRIANGLE_BINS_H

#include "nav_bake/input/lattice_map.h"

/// Some triangles of a mesh, by index; NULL indices: all.
typedef struct tl_triangle_list {
    const uint32_t *indices;
    uint32_t count;
} tl_triangle_list;

static inline uint32_t tl_triangle_list_get(const tl_triangle_list *list, uint32_t i)
{
    return list->indices != NULL ? list->indices[i] : i;
}

/// A grid of bins over columns: bin (x, z) covers the columns [x * size_x - margin, (x + 1) * size_x + margin) of the
/// map's lattice, and so on z.
typedef struct tl_bin_grid {
    uint32_t count_x, count_z;
    uint32_t size_x, size_z; ///< columns, > 0
    uint32_t margin;         ///< columns
    bool sparse;             ///< keep only the bins that hold triangles
} tl_bin_grid;

/// The bins that are kept: all, or of a sparse grid those with triangles, so that memory and time follow what is there
/// and not the ground that the grid covers. In rows, x fastest.
typedef struct tl_triangle_bins {
    uint32_t *first;     ///< [bin_count + 1]
    uint32_t *triangles; ///< ascending within each bin
    uint64_t bin_count;  ///< bins that are kept
    uint32_t *places;    ///< [bin_count] z * count_x + x of each, ascending; NULL: a bin's place is its index
    const tl_allocator *allocator;
} tl_triangle_bins;

/// Puts each triangle into every bin that its box overlaps. At most 2^31 bins. TL_ERR_LIMIT when that makes 2^32
/// entries or more, or more than TL_NAV_MAX_TILES bins of a sparse grid.
tl_result tl_triangle_bins_init(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map,
                                const tl_bin_grid *grid, const tl_allocator *allocator, tl_triangle_bins *bins);
void tl_triangle_bins_free(tl_triangle_bins *bins);

/// Where the bin lies in the grid.
static inline uint64_t tl_triangle_bins_place(const tl_triangle_bins *bins, uint64_t bin)
{
    return bins->places != NULL ? bins->places[bin] : bin;
}

static inline tl_triangle_list tl_triangle_bins_get(const tl_triangle_bins *bins, uint64_t bin)
{
    tl_triangle_list list = { bins->triangles + bins->first[bin], bins->first[bin + 1] - bins->first[bin] };
    return list;
}

#endif
