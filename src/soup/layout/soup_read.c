// SPDX-License-Identifier: MIT
//
// Reading a soup without a search: its counts, its triangles and its pairs in order.

#include "soup/layout/compact_layout.h"

#include "base/assert.h"

#include <string.h>

uint64_t tl_soup_size(const tl_soup *soup)
{
    TL_ASSERT(soup != NULL);
    return soup->blob.size;
}

tl_aabb tl_soup_bounds(const tl_soup *soup)
{
    TL_ASSERT(soup != NULL);
    tl_aabb bounds = { soup->bounds_min, soup->bounds_max };
    return bounds;
}

tl_soup_stats tl_soup_get_stats(const tl_soup *soup)
{
    TL_ASSERT(soup != NULL);
    tl_soup_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.size = soup->blob.size;
    stats.source_triangle_count = soup->source_triangle_count;
    stats.triangle_count = soup->triangle_count;
    stats.pair_count = soup->pair_count;
    stats.single_count = soup->single_count;
    stats.coincident_count = soup->triangle_count - (2 * soup->pair_count + soup->single_count);
    stats.reference_count = soup->reference_count;
    stats.leaf_count = soup->leaf_count;
    stats.node_count = soup->node_count;
    stats.layout = (tl_soup_layout)soup->layout;
    stats.depth = soup->depth;
    stats.node_bytes = soup->leaf_offset - soup->node_offset;
    stats.leaf_bytes = soup->leaf_bytes;
    stats.vertex_bytes = (uint64_t)soup->vertex_count * sizeof(tl_vec3);
    stats.material_bytes = soup->has_materials ? (uint64_t)soup->source_triangle_count * sizeof(uint16_t) : 0;
    return stats;
}

// Opens what a cursor points to: a leaf, or in the compact layout, where a pair does not know its leaf, a pair. Returns
// its size in bytes.
static uint64_t open_at(const tl_soup *soup, uint64_t offset, tl_leaf_buffer *buffer, tl_leaf_view *view)
{
    if (soup->layout == TL_SOUP_COMPACT) {
        *view = tl_view_leaf(tl_expand_pairs(soup, (uint32_t)(offset / sizeof(tl_compact_pair)), 1, buffer));
        return sizeof(tl_compact_pair);
    }
    *view = tl_view_leaf(tl_soup_leaf_at(soup, offset));
    return tl_leaf_size(view->pair_count);
}

// A cursor is the offset of a leaf, a multiple of 16 below 2^34, plus a lane, which is below 8, and above both which of
// the triangles that coincide there comes next.
#define CURSOR_PLACE ((uint64_t)1 << 40)

static uint64_t leaf_of_cursor(uint64_t cursor)
{
    return cursor % CURSOR_PLACE & ~(uint64_t)(TL_SOUP_LEAF_ALIGN - 1);
}

bool tl_soup_next_triangle(const tl_soup *soup, uint64_t *cursor, tl_soup_triangle *triangle_out)
{
    TL_ASSERT(soup != NULL && cursor != NULL && triangle_out != NULL);
    while (leaf_of_cursor(*cursor) < soup->leaf_bytes) {
        uint64_t offset = leaf_of_cursor(*cursor), place = *cursor / CURSOR_PLACE;
        uint32_t lane = (uint32_t)(*cursor % CURSOR_PLACE - offset);
        tl_leaf_buffer buffer;
        tl_leaf_view leaf;
        uint64_t size = open_at(soup, offset, &buffer, &leaf);
        uint32_t id = leaf.ids[lane];
        const bool counts = id != TL_ID_NONE && (id & TL_ID_COPY) == 0;
        const uint32_t *coincident = counts ? tl_soup_coincident(soup, id) : NULL;
        if (coincident != NULL) {
            id = coincident[place];
        }
        if (coincident != NULL && (id & TL_ID_LAST) == 0) {
            *cursor += CURSOR_PLACE;
        } else {
            *cursor = lane + 1 < 2 * leaf.pair_count ? offset + lane + 1 : offset + size;
        }
        if (counts) {
            tl_leaf_corners(&leaf, lane, id, triangle_out->corners);
            triangle_out->triangle = id & TL_ID_INDEX;
            triangle_out->material = tl_soup_material(soup, triangle_out->triangle);
            return true;
        }
    }
    return false;
}

bool tl_soup_next_pair(const tl_soup *soup, uint64_t *cursor, tl_soup_pair *pair_out)
{
    TL_ASSERT(soup != NULL && cursor != NULL && pair_out != NULL);
    while (leaf_of_cursor(*cursor) < soup->leaf_bytes) {
        uint64_t offset = leaf_of_cursor(*cursor);
        uint32_t i = (uint32_t)(*cursor - offset);
        tl_leaf_buffer buffer;
        tl_leaf_view leaf;
        uint64_t size = open_at(soup, offset, &buffer, &leaf);
        uint32_t n = leaf.pair_count;
        *cursor = i + 1 < n ? *cursor + 1 : offset + size;
        if ((leaf.ids[i] & TL_ID_COPY) != 0) {
            continue;
        }
        bool single = leaf.ids[n + i] == TL_ID_NONE;
        pair_out->corners[0] = tl_leaf_slot(&leaf, i, 0);
        pair_out->corners[1] = tl_leaf_slot(&leaf, i, 1);
        pair_out->corners[2] = tl_leaf_slot(&leaf, i, 2);
        pair_out->corners[3] = tl_leaf_slot(&leaf, n + i, 1);
        pair_out->triangles[0] = tl_soup_lowest_triangle(soup, leaf.ids[i]);
        pair_out->triangles[1] = single ? TL_NO_TRIANGLE : tl_soup_lowest_triangle(soup, leaf.ids[n + i]);
        return true;
    }
    return false;
}
