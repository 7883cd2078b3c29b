// SPDX-License-Identifier: MIT
//
// A tile of some of a tile's polygons.

#ifndef TALUS_SRC_NAV_FORMAT_TILE_SUBSET_H
#define TALUS_SRC_NAV_FORMAT_TILE_SUBSET_H

#include <talus/nav_tile.h>

/// How a tile is divided.
typedef struct tl_nav_layering {
    const uint32_t *layers;   ///< by polygon
    const uint32_t *ordinals; ///< by corner, of edges between two layers (tl_nav_cut)
} tl_nav_layering;

/// The layer of that number, which has a polygon; links to other layers become cuts. Errors as tl_nav_tile_subset.
tl_result tl_nav_tile_layer(const tl_nav_tile *tile, const tl_nav_layering *layering, uint32_t layer,
                            const tl_allocator *allocator, tl_nav_tile **tile_out, tl_report *report);

#endif
