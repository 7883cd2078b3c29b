// SPDX-License-Identifier: MIT
//
// BVH traversal for every query but rays: boxes of a node's children, a stack of children to visit, and the triangles
// of a leaf. Only this file knows the bytes of a node; queries above it do not.
//
//   tl_walk_begin(&walk, soup);
//   while (tl_walk_next(&walk, limit, &child)) {
//       if (tl_walk_is_leaf(child)) { its triangles; `limit` may shrink }
//       else { tl_walk_boxes boxes; tl_walk_read_boxes(&walk, child, &boxes);
//              compute a key a lane and the mask of lanes to enter; tl_walk_enter(&walk, &boxes, mask, keys); }
//   }
//
// Boxes are plain floats in arrays over the lanes, read where they lie in the node, so that a compiler vectorizes a
// query's loop over sixteen lanes without an instruction set of its own: unlike rays, these queries spend their time in
// leaves.
//
// A walk may see the soup at a scale: then boxes and corners are multiplied as they are read. Products are rounded, and
// rounding keeps the order of numbers, so a box still holds all corners that it held. It is widened by the rounding of
// corners nevertheless: splits clip boxes, and a triangle whose corners moved may leave the clipped part.

#ifndef TALUS_SRC_SOUP_BVH_WALK_H
#define TALUS_SRC_SOUP_BVH_WALK_H

#include "base/compiler.h"
#include "base/lowest_bit.h"
#include "math/tolerance.h"
#include "soup/layout/compact_layout.h"

#include <float.h>
#include <string.h>

enum {
    TL_WALK_WIDTH = TL_SOUP_WIDTH,
    // Each node on the path leaves all but one of its children on the stack.
    TL_WALK_STACK_SIZE = (TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + TL_SOUP_WIDTH
};

/// The children of a node.
typedef struct tl_walk_boxes {
    const float *planes;   ///< in the node, or in `expanded`; see tl_walk_min, tl_walk_max
    const uint32_t *child; ///< words, one a lane
    uint32_t mask;         ///< bit i: lane i has a child
    float expanded[6 * TL_WALK_WIDTH];
} tl_walk_boxes;

/// The low sides of the boxes along an axis, one a lane; of a lane without a child INFINITY.
static inline const float *tl_walk_min(const tl_walk_boxes *boxes, uint32_t axis)
{
    return boxes->planes + 2 * (size_t)axis * TL_WALK_WIDTH;
}

/// The high sides; of a lane without a child -INFINITY.
static inline const float *tl_walk_max(const tl_walk_boxes *boxes, uint32_t axis)
{
    return boxes->planes + (2 * (size_t)axis + 1) * TL_WALK_WIDTH;
}

/// A scale, with what follows from it. NULL where one is taken: the soup as it is.
typedef struct tl_walk_scale {
    float by[3];
    float wider[3]; ///< metres by which scaled boxes are widened
    bool mirrored;  ///< an odd number of factors is negative: two corners change places, and fronts stay fronts
} tl_walk_scale;

typedef struct tl_walk {
    const tl_soup *soup;
    const tl_walk_scale *scale; ///< may be NULL
    uint32_t count;
    // The bits of the key above the child word: keys are never negative, so their bits have the order of their values.
    uint64_t entries[TL_WALK_STACK_SIZE];
} tl_walk;

static inline bool tl_walk_is_leaf(uint32_t child)
{
    return (child & TL_CHILD_LEAF) != 0;
}

/// The root comes first, with key 0.
static inline void tl_walk_begin_scaled(tl_walk *walk, const tl_soup *soup, const tl_walk_scale *scale)
{
    walk->soup = soup;
    walk->scale = scale;
    walk->count = 1;
    walk->entries[0] = 0;
}

static inline void tl_walk_begin(tl_walk *walk, const tl_soup *soup)
{
    tl_walk_begin_scaled(walk, soup, NULL);
}

/// Pops the next child whose key is not above `limit`. False: none is left.
static inline bool tl_walk_next(tl_walk *walk, float limit, uint32_t *child_out)
{
    uint32_t bits;
    memcpy(&bits, &limit, sizeof bits);
    uint64_t last = (uint64_t)bits << 32 | UINT32_MAX;
    while (walk->count > 0) {
        uint64_t entry = walk->entries[--walk->count];
        if (entry <= last) {
            *child_out = (uint32_t)entry;
            return true;
        }
    }
    return false;
}

/// Scales the boxes of children; those of lanes without one stay empty.
void tl_walk_scale_boxes(const tl_walk_scale *scale, tl_walk_boxes *boxes);

/// Scales a triangle's corners.
void tl_walk_scale_corners(const tl_walk_scale *scale, tl_vec3 corners[3]);

static inline void tl_walk_read_compact_boxes(const tl_compact_node *node, tl_walk_boxes *boxes)
{
    for (uint32_t row = 0; row < 6; row++) {
        const float none = row % 2 == 0 ? INFINITY : -INFINITY;
        for (uint32_t lane = 0; lane < TL_WALK_WIDTH; lane++) {
            const float plane = tl_compact_plane(node, row / 2, node->plane[row][lane]);
            boxes->expanded[row * TL_WALK_WIDTH + lane] = node->child[lane] != 0 ? plane : none;
        }
    }
    boxes->planes = boxes->expanded;
    boxes->child = node->child;
    boxes->mask = node->mask;
}

static inline void tl_walk_read_plain_boxes(const tl_soup_node *node, tl_walk_boxes *boxes)
{
    boxes->planes = node->plane[0];
    boxes->child = node->child;
    boxes->mask = 0;
    for (uint32_t lane = 0; lane < TL_WALK_WIDTH; lane++) {
        boxes->mask |= (uint32_t)(node->child[lane] != 0) << lane;
    }
}

/// The boxes of a node's children.
static inline void tl_walk_read_boxes(const tl_walk *walk, uint32_t node_index, tl_walk_boxes *boxes)
{
    if (walk->soup->layout == TL_SOUP_COMPACT) {
        tl_walk_read_compact_boxes(&tl_compact_nodes(walk->soup)[node_index], boxes);
    } else {
        tl_walk_read_plain_boxes(&tl_soup_nodes(walk->soup)[node_index], boxes);
    }
    if (walk->scale != NULL) {
        tl_walk_scale_boxes(walk->scale, boxes);
    }
}

static inline tl_aabb tl_walk_box(const tl_walk_boxes *boxes, uint32_t lane)
{
    tl_aabb box = { { tl_walk_min(boxes, 0)[lane], tl_walk_min(boxes, 1)[lane], tl_walk_min(boxes, 2)[lane] },
                    { tl_walk_max(boxes, 0)[lane], tl_walk_max(boxes, 1)[lane], tl_walk_max(boxes, 2)[lane] } };
    return box;
}

/// Pushes the children in `mask`, the lowest lane on top.
static inline void tl_walk_enter_all(tl_walk *walk, const tl_walk_boxes *boxes, uint32_t mask)
{
    for (uint32_t left = mask & boxes->mask; left != 0;) {
        const uint32_t lane = tl_highest_bit(left);
        left ^= 1u << lane;
        walk->entries[walk->count++] = boxes->child[lane];
    }
}

/// Pushes the children in `mask`, the one with the smallest key (>= 0) on top; of equal keys the lowest lane.
static inline void tl_walk_enter(tl_walk *walk, const tl_walk_boxes *boxes, uint32_t mask, const float *keys)
{
    uint64_t *base = walk->entries + walk->count;
    uint32_t count = 0;
    for (uint32_t lane = TL_WALK_WIDTH; lane-- > 0;) {
        if ((mask & boxes->mask) >> lane & 1u) {
            uint32_t bits;
            memcpy(&bits, &keys[lane], sizeof bits);
            uint64_t entry = (uint64_t)bits << 32 | boxes->child[lane];
            uint32_t place = count++;
            for (; place > 0 && base[place - 1] >> 32 < bits; place--) {
                base[place] = base[place - 1];
            }
            base[place] = entry;
        }
    }
    walk->count += count;
}

/// An open leaf.
typedef struct tl_walk_leaf {
    const tl_soup *soup;
    const tl_soup_leaf *leaf; ///< in the soup, or in `buffer`
    const tl_walk_scale *scale;
    tl_leaf_view view;
    uint32_t child;      ///< its word
    uint32_t lane_count; ///< some lanes may hold no triangle
    tl_leaf_buffer buffer;
} tl_walk_leaf;

/// One triangle of a leaf.
typedef struct tl_walk_triangle {
    tl_vec3 corners[3]; ///< as in the view; where the walk has a scale, as it makes them
    uint32_t triangle;
    const tl_walk_leaf *leaf;
    uint32_t lane;              ///< its place in the leaf
    const uint32_t *coincident; ///< the id word among those of its lane; NULL: it is alone there
} tl_walk_triangle;

static inline void tl_walk_open_leaf(const tl_walk *walk, uint32_t child, tl_walk_leaf *leaf)
{
    leaf->soup = walk->soup;
    leaf->leaf = tl_open_leaf(walk->soup, child, &leaf->buffer);
    leaf->scale = walk->scale;
    leaf->view = tl_view_leaf(leaf->leaf);
    leaf->child = child;
    leaf->lane_count = 2 * leaf->view.pair_count;
}

/// A triangle's id word.
static inline uint32_t tl_walk_id(const tl_walk_triangle *triangle)
{
    return triangle->coincident != NULL ? *triangle->coincident : triangle->leaf->view.ids[triangle->lane];
}

#if defined(__wasm__) // code is downloaded there: one copy
#define TL_WALK_READ TL_NOINLINE
#else
#define TL_WALK_READ
#endif

/// Reads the triangle of an id word of its lane.
static inline TL_WALK_READ void tl_walk_read_word(tl_walk_triangle *triangle, uint32_t id)
{
    const tl_walk_leaf *leaf = triangle->leaf;
    tl_leaf_corners(&leaf->view, triangle->lane, id, triangle->corners);
    if (leaf->scale != NULL) {
        tl_walk_scale_corners(leaf->scale, triangle->corners);
    }
    triangle->triangle = id & TL_ID_INDEX;
}

/// The first triangle of a lane. False when it holds none.
static inline bool tl_walk_read_triangle(const tl_walk_leaf *leaf, uint32_t lane, tl_walk_triangle *triangle)
{
    const uint32_t id = leaf->view.ids[lane];
    if (id == TL_ID_NONE) {
        return false;
    }
    triangle->leaf = leaf;
    triangle->lane = lane;
    triangle->coincident = tl_soup_coincident(leaf->soup, id);
    tl_walk_read_word(triangle, triangle->coincident != NULL ? *triangle->coincident : id);
    return true;
}

/// The next triangle that coincides with this one. False when it was the last of its lane.
static inline bool tl_walk_next_coincident(tl_walk_triangle *triangle)
{
    if (triangle->coincident == NULL || (*triangle->coincident & TL_ID_LAST) != 0) {
        return false;
    }
    tl_walk_read_word(triangle, *++triangle->coincident);
    return true;
}

static inline tl_aabb tl_walk_triangle_box(const tl_walk_triangle *triangle)
{
    const tl_vec3 *c = triangle->corners;
    tl_aabb box = { tl_min(tl_min(c[0], c[1]), c[2]), tl_max(tl_max(c[0], c[1]), c[2]) };
    return box;
}

/// Whether spatial splits have copied some triangle into several leaves.
static inline bool tl_walk_has_copies(const tl_soup *soup)
{
    return soup->reference_count != soup->pair_count + soup->single_count;
}

#endif
