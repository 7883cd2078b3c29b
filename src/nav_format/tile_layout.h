// SPDX-License-Identifier: MIT
//
// Where the arrays of a tile lie, given their counts. Writer and checker share it, so a tile's offsets are never
// interpreted: they are computed anew and compared.

#ifndef TALUS_SRC_NAV_FORMAT_TILE_LAYOUT_H
#define TALUS_SRC_NAV_FORMAT_TILE_LAYOUT_H

#include <talus/nav_tile.h>

enum { TL_NAV_TILE_ARRAYS = 13 };

/// One array of the tile: [offset, offset + size), padding up to `end`.
typedef struct tl_nav_extent {
    uint64_t offset, size, end;
} tl_nav_extent;

/// The arrays in their order, from the counts and widths in `tile`. The last one's end is the blob's size.
/// No overflow for any counts: each array is below 2^38 bytes.
void tl_nav_tile_extents(const tl_nav_tile *tile, tl_nav_extent extents_out[TL_NAV_TILE_ARRAYS]);

/// The size of the largest blob whose offsets fit.
#define TL_NAV_MAX_TILE_SIZE (8 * (uint64_t)UINT32_MAX)

static inline bool tl_nav_needs_wide_links(const tl_nav_tile *tile)
{
    return tile->polygon_count > TL_NAV_MAX_SHORT_LINK + 1u || tile->portal_count > TL_NAV_MAX_SHORT_LINK;
}

static inline bool tl_nav_needs_wide_firsts(const tl_nav_tile *tile)
{
    return tile->corner_count > UINT16_MAX || tile->detail_vertex_count > UINT16_MAX ||
           tile->detail_triangle_count > UINT16_MAX;
}

/// Writes the extents' offsets into the tile's header.
void tl_nav_tile_set_offsets(tl_nav_tile *tile, const tl_nav_extent extents[TL_NAV_TILE_ARRAYS]);

#endif
