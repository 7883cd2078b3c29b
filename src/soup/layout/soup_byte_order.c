// SPDX-License-Identifier: MIT
//
// The words of a soup, in both layouts.

#include "base/byte_order.h"
#include "base/exact_floats.h"
#include "soup/layout/compact_layout.h"

static const tl_word_run SOUP_HEAD[] = {
    { 4, 2 },  // magic, version
    { 8, 1 },  // size
    { 4, 8 },  // source_triangle_count .. depth
    { 4, 10 }, // bounds with their padding, materials
    { 8, 4 },  // offsets
    { 4, 2 },  // layout, vertex_count
    { 8, 3 },  // offsets
    { 4, 10 }, // coincident_words, reserved
};

static const tl_word_run COMPACT_NODE[] = { { 4, 8 }, { 1, 6 * TL_SOUP_WIDTH }, { 4, TL_SOUP_WIDTH } };
static const tl_word_run COMPACT_PAIR[] = { { 4, 2 }, { 2, 4 } };

void tl_soup_swap_words(tl_byte_swap *swap)
{
    tl_soup head;
    tl_swap_head(swap, SOUP_HEAD, sizeof SOUP_HEAD / sizeof SOUP_HEAD[0], &head, sizeof head);
    // The offsets follow from the counts, as everywhere.
    tl_soup_place_arrays(&head);
    if (head.layout == TL_SOUP_COMPACT) {
        tl_swap_elements(swap, head.node_offset, head.node_count, COMPACT_NODE, 3);
        tl_swap_elements(swap, head.leaf_offset, head.leaf_bytes / sizeof(tl_compact_pair), COMPACT_PAIR, 2);
        tl_swap_words(swap, head.group_offset, tl_compact_group_count(head.reference_count), 4);
        tl_swap_words(swap, head.vertex_offset, 3 * (uint64_t)head.vertex_count, 4);
    } else {
        // Leaves are ids and floats, nodes floats and child words: all of four bytes.
        tl_swap_words(swap, head.node_offset, (uint64_t)head.node_count * (sizeof(tl_soup_node) / 4), 4);
        tl_swap_words(swap, head.leaf_offset, head.leaf_bytes / 4, 4);
    }
    tl_swap_words(swap, head.coincident_offset, head.coincident_words, 4);
    tl_swap_words(swap, head.material_offset, head.has_materials != 0 ? head.source_triangle_count : 0, 2);
}
