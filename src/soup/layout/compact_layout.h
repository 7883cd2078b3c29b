// SPDX-License-Identifier: MIT
//
// The compact bytes of a soup: half of the memory, the same answers.
//
//   tl_soup | tl_compact_node[node_count] | tl_compact_pair[reference_count] | uint32 groups[] | float vertices[3][] |
//   zeros | uint32 coincident[] | uint16 materials[]
//
// - Vertices are shared. A pair names its four by 16 bits each, counted from a vertex that 64 pairs have in common. A
//   vertex that is used again too far away is stored again, which is rare: leaves lie in the order of the tree.
// - A node's boxes are quantized to bytes: steps of a power of two from the node's own corner. They are rounded
//   outward, so they only let in more; and a plane, origin + byte * scale, rounds once, fused or not, so it is the same
//   float on every machine.
// - A leaf is one to four consecutive pairs. Its readers expand it to the plain form (tl_soup_leaf) first: the leaf
//   code, and with it every answer, is that of the plain layout.
//
// Source of the node: Ylitie, Karras, Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs,
// 2017, section 3; here without their implicit children, which would save 40 bytes of 192 and cost a shuffle a visit.

#ifndef TALUS_SRC_SOUP_COMPACT_LAYOUT_H
#define TALUS_SRC_SOUP_COMPACT_LAYOUT_H

#include "soup/layout/soup_layout.h"

enum {
    TL_COMPACT_GROUP = 64,     ///< pairs that count their vertices from the same one
    TL_COMPACT_STEPS = 255,    ///< the largest step of a plane
    TL_COMPACT_WINDOW = 65536, ///< vertices that a pair can name
};

typedef struct tl_compact_node {
    float origin[3];
    float scale[3]; ///< powers of two, normal floats
    uint32_t mask;  ///< bit i: lane i has a child
    uint32_t zero;
    uint8_t plane[6][TL_SOUP_WIDTH]; ///< as in tl_soup_node
    uint32_t child[TL_SOUP_WIDTH];   ///< as in tl_soup_node
} tl_compact_node;

static_assert(sizeof(tl_compact_node) == 192, "a node is three cache lines");

typedef struct tl_compact_pair {
    uint32_t ids[2];
    uint16_t corner[4]; ///< a, c, b, d: the order of a leaf's arrays
} tl_compact_pair;

static_assert(sizeof(tl_compact_pair) == TL_SOUP_LEAF_ALIGN, "leaves are whole numbers of their units");

static inline const tl_compact_node *tl_compact_nodes(const tl_soup *soup)
{
    return (const tl_compact_node *)(const void *)((const char *)soup + soup->node_offset);
}

static inline const tl_compact_pair *tl_compact_pairs(const tl_soup *soup)
{
    return (const tl_compact_pair *)(const void *)((const char *)soup + soup->leaf_offset);
}

static inline const uint32_t *tl_compact_groups(const tl_soup *soup)
{
    return (const uint32_t *)(const void *)((const char *)soup + soup->group_offset);
}

static inline const float *tl_compact_vertices(const tl_soup *soup)
{
    return (const float *)(const void *)((const char *)soup + soup->vertex_offset);
}

/// The number of groups of so many pairs.
static inline uint32_t tl_compact_group_count(uint32_t pair_count)
{
    return pair_count / TL_COMPACT_GROUP + (pair_count % TL_COMPACT_GROUP != 0);
}

/// The vertex from which pair `index` counts its vertices.
static inline const float *tl_compact_base(const tl_soup *soup, uint32_t index)
{
    return tl_compact_vertices(soup) + 3 * (size_t)tl_compact_groups(soup)[index / TL_COMPACT_GROUP];
}

/// A plane in metres.
static inline float tl_compact_plane(const tl_compact_node *node, uint32_t axis, uint8_t step)
{
    return node->origin[axis] + (float)step * node->scale[axis];
}

/// Computes the arrays' offsets in the head from its counts, and returns the end of the last array. No overflow for any
/// counts.
static inline uint64_t tl_soup_place_arrays(tl_soup *head)
{
    bool compact = head->layout == TL_SOUP_COMPACT;
    head->node_offset = sizeof(tl_soup);
    head->leaf_offset =
        head->node_offset + (uint64_t)head->node_count * (compact ? sizeof(tl_compact_node) : sizeof(tl_soup_node));
    uint64_t end = head->leaf_offset + head->leaf_bytes;
    head->group_offset = compact ? end : 0;
    end += compact ? (uint64_t)tl_compact_group_count(head->reference_count) * sizeof(uint32_t) : 0;
    head->vertex_offset = compact ? end : 0;
    end += (compact ? (uint64_t)head->vertex_count * sizeof(tl_vec3) : 0) + TL_SOUP_TAIL_BYTES;
    head->coincident_offset = head->coincident_words != 0 ? end : 0;
    head->material_offset = end + (uint64_t)head->coincident_words * sizeof(uint32_t);
    return head->material_offset + (head->has_materials ? (uint64_t)head->source_triangle_count * sizeof(uint16_t) : 0);
}

/// An expanded leaf.
typedef struct tl_leaf_buffer {
    _Alignas(16) tl_soup_leaf head;
    uint32_t words[(2 + 12) * TL_SOUP_LEAF_PAIRS];
} tl_leaf_buffer;

/// Expands pairs [first, first + count) into the plain form.
static inline const tl_soup_leaf *tl_expand_pairs(const tl_soup *soup, uint32_t first, uint32_t count,
                                                  tl_leaf_buffer *buffer)
{
    buffer->head.tagged_count = TL_LEAF_TAG | count;
    buffer->head.extent = 0.0f;
    uint32_t *ids = buffer->words;
    float *floats = (float *)(void *)(ids + 2 * (size_t)count);
    for (uint32_t i = 0; i < count; i++) {
        const tl_compact_pair *pair = &tl_compact_pairs(soup)[first + i];
        const float *base = tl_compact_base(soup, first + i);
        const float *v[4];
        ids[i] = pair->ids[0];
        ids[count + i] = pair->ids[1];
        for (uint32_t k = 0; k < 4; k++) {
            v[k] = base + 3 * (size_t)pair->corner[k];
        }
        for (uint32_t axis = 0; axis < 3; axis++) {
            float a = v[0][axis], c = v[1][axis], b = v[2][axis], d = v[3][axis];
            float low = tl_minf(a, c), high = tl_maxf(a, c);
            float first_extent = tl_maxf(high, b) - tl_minf(low, b), second_extent = tl_maxf(high, d) - tl_minf(low, d);
            buffer->head.extent = tl_maxf(buffer->head.extent, tl_maxf(first_extent, second_extent));
            for (uint32_t k = 0; k < 4; k++) {
                floats[(4 * axis + k) * count + i] = v[k][axis];
            }
        }
    }
    return &buffer->head;
}

/// The leaf that a child word names, in the plain form: in place, or expanded into `buffer`.
static inline const tl_soup_leaf *tl_open_leaf(const tl_soup *soup, uint32_t child, tl_leaf_buffer *buffer)
{
    uint64_t offset = tl_child_leaf_offset(child);
    if (soup->layout == TL_SOUP_FAST) {
        return tl_soup_leaf_at(soup, offset);
    }
    return tl_expand_pairs(soup, (uint32_t)(offset / sizeof(tl_compact_pair)), tl_child_pair_count(child), buffer);
}

#endif
