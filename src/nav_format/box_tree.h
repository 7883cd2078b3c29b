// SPDX-License-Identifier: MIT
//
// The BVH over a tile's polygons.

#ifndef TALUS_SRC_NAV_FORMAT_BOX_TREE_H
#define TALUS_SRC_NAV_FORMAT_BOX_TREE_H

#include "base/arena.h"

#include <talus/nav_tile.h>

/// The box of a polygon's corners and surface.
tl_aabb tl_nav_polygon_box(const tl_nav_tile *tile, uint32_t polygon);

/// Fills the tile's nodes: 2 * polygon_count - 1 of them. The tile's corners and detail must be there.
/// TL_ERR_MEMORY. O(n log n).
tl_result tl_nav_bake_box_tree(tl_nav_tile *tile, tl_arena *arena);

#endif
