// SPDX-License-Identifier: MIT
//
// The words of a navmesh tile.

#include "base/byte_order.h"
#include "base/exact_floats.h"
#include "nav_format/tile_layout.h"

static const tl_word_run TILE_HEAD[] = {
    { 4, 2 },  // magic, version
    { 8, 1 },  // size
    { 4, 16 }, // tile_x .. side_end
    { 8, 1 },  // area
    { 4, 14 }, // origin .. bounds
    { 8, 14 }, // offsets
};

void tl_nav_tile_swap_words(tl_byte_swap *swap)
{
    // Bytes of a word, in the order of the arrays.
    static const uint8_t WIDTHS[TL_NAV_TILE_ARRAYS] = { 4, 4, 4, 4, 4, 8, 1, 4, 4, 4, 2, 4, 4, 4 };
    tl_nav_tile head;
    tl_nav_extent extents[TL_NAV_TILE_ARRAYS];
    tl_swap_head(swap, TILE_HEAD, sizeof TILE_HEAD / sizeof TILE_HEAD[0], &head, sizeof head);
    tl_nav_tile_extents(&head, extents);
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        tl_swap_words(swap, extents[i].offset, extents[i].size / WIDTHS[i], WIDTHS[i]);
    }
}
