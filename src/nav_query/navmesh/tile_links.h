// SPDX-License-Identifier: MIT
//
// Linking tiles over their sides and cuts (tile_links.c).

#ifndef TALUS_SRC_NAV_QUERY_TILE_LINKS_H
#define TALUS_SRC_NAV_QUERY_TILE_LINKS_H

#include "nav_query/navmesh/navmesh.h"

/// The side of a neighbour that faces a tile's side.
static inline uint32_t tl_nav_facing_side(uint32_t side)
{
    return side == TL_NAV_SIDE_CUT ? side : side ^ 2u;
}

/// One side of a tile in a slot.
typedef struct tl_nav_tile_side {
    const tl_nav_tile *tile;
    uint32_t slot;
    uint32_t side;
} tl_nav_tile_side;

/// Links side `a` with side `b`, which faces it, both ways. Both outputs are fresh, or on TL_ERR_MEMORY untouched; zero
/// when there are no links.
tl_result tl_nav_link_sides(const tl_allocator *allocator, const tl_nav_tile_side *a, const tl_nav_tile_side *b,
                            tl_nav_side_links *a_out, tl_nav_side_links *b_out);
/// The links of both, which lead to different tiles from the same side. The output is fresh. TL_ERR_MEMORY.
tl_result tl_nav_join_sides(const tl_allocator *allocator, const tl_nav_side_links *a, const tl_nav_side_links *b,
                            tl_nav_side_links *out);
/// Drops the links that lead to a slot; returns how many.
uint32_t tl_nav_drop_links(const tl_allocator *allocator, tl_nav_side_links *side, uint32_t slot);
void tl_nav_free_side(const tl_allocator *allocator, tl_nav_side_links *side);
/// The same links in memory of their own; what they stood in is released. TL_ERR_MEMORY: nothing is changed.
tl_result tl_nav_copy_side(const tl_allocator *allocator, tl_nav_side_links *side);

#endif
