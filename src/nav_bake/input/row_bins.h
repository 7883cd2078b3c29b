// SPDX-License-Identifier: MIT
//
// The triangles of each band of rows of a heightfield.

#ifndef TALUS_SRC_NAV_BAKE_ROW_BINS_H
#define TALUS_SRC_NAV_BAKE_ROW_BINS_H

#include "nav_bake/input/triangle_bins.h"

#define TL_MAX_ROW_BINS 0xffffu

/// Bin i covers the rows [i * size - margin, (i + 1) * size + margin) of the map's lattice.
typedef struct tl_row_grid {
    uint32_t count; ///< 1 to TL_MAX_ROW_BINS
    uint32_t size;  ///< rows, > 0
    uint32_t margin;
} tl_row_grid;

/// Puts each triangle into every bin whose rows it overlaps, at any x, as the host's tasks. TL_ERR_LIMIT when that
/// makes 2^32 entries or more. tl_triangle_bins_free frees them.
tl_result tl_row_bins_init(const tl_mesh_view *mesh, tl_triangle_list list, const tl_lattice_map *map, tl_row_grid grid,
                           const tl_host *host, tl_triangle_bins *bins);

#endif
