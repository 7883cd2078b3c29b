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
    { 4, 16 }, // origin .. node_steps
    { 4, 14 }, // offsets, zero
};

static const tl_word_run TILE_NODE[] = { { 2, 6 }, { 4, 1 } };

void tl_nav_tile_swap_words(tl_byte_swap *swap)
{
    tl_nav_tile head;
    tl_nav_extent extents[TL_NAV_TILE_ARRAYS];
    tl_swap_head(swap, TILE_HEAD, sizeof TILE_HEAD / sizeof TILE_HEAD[0], &head, sizeof head);
    const uint8_t link = (head.wide & TL_NAV_WIDE_LINKS) != 0 ? 4 : 2;
    const uint8_t first = (head.wide & TL_NAV_WIDE_FIRSTS) != 0 ? 4 : 2;
    const uint8_t flags = (head.wide & TL_NAV_WIDE_FLAGS) != 0 ? 8 : 1;
    const uint8_t corner = (head.wide & TL_NAV_WIDE_CORNERS) != 0 ? 4 : 2;
    const uint8_t coordinate = (head.wide & TL_NAV_WIDE_LATTICE) != 0 ? 4 : 2;
    const uint8_t triangle = (head.wide & TL_NAV_WIDE_TRIANGLES) != 0 ? 2 : 1;
    // Bytes of a word, in the order of the arrays; nodes, the first, have two kinds.
    const uint8_t widths[TL_NAV_TILE_ARRAYS] = { 0,     first, link, corner,   coordinate, flags, 1,
                                                 first, first, 4,    triangle, 4,          4 };
    tl_nav_tile_extents(&head, extents);
    tl_swap_elements(swap, extents[0].offset, head.node_count, TILE_NODE, 2);
    for (uint32_t i = 1; i < TL_NAV_TILE_ARRAYS; i++) {
        tl_swap_words(swap, extents[i].offset, extents[i].size / widths[i], widths[i]);
    }
}
