// SPDX-License-Identifier: MIT
//
// The BVH over a tile's polygons.

#ifndef TALUS_SRC_NAV_FORMAT_BOX_TREE_H
#define TALUS_SRC_NAV_FORMAT_BOX_TREE_H

#include "base/arena.h"

#include <talus/nav_tile.h>

/// The box of a polygon's corners and surface.
tl_aabb tl_nav_polygon_box(const tl_nav_tile *tile, uint32_t polygon);

/// The box of all polygons.
tl_aabb tl_nav_tile_surface_bounds(const tl_nav_tile *tile);
/// The least steps with which 16 bits reach over the bounds, as tl_nav_tile.node_steps has them.
uint32_t tl_nav_steps_over(tl_aabb bounds);
/// Sets the box of a leaf: its polygon's, outward.
void tl_nav_set_leaf_box(const tl_nav_tile *tile, tl_nav_tile_node *leaf);
/// Sets the box of an inner node: what its children's have together.
void tl_nav_set_inner_box(tl_nav_tile_node *inner, const tl_nav_tile_node *a, const tl_nav_tile_node *b);

/// Fills the tile's nodes, 2 * polygon_count - 1 of them, and its bounds. The tile's corners and detail must be there.
/// TL_ERR_MEMORY. O(n log n).
tl_result tl_nav_bake_box_tree(tl_nav_tile *tile, tl_arena *arena);

#endif
