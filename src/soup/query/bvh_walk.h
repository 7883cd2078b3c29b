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
// Boxes are plain floats in arrays over the lanes, so that a compiler vectorizes a query's loop over sixteen lanes
// without an instruction set of its own: unlike rays, these queries spend their time in leaves.

#ifndef TALUS_SRC_SOUP_BVH_WALK_H
#define TALUS_SRC_SOUP_BVH_WALK_H

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
    float min[3][TL_WALK_WIDTH]; ///< of a lane without a child INFINITY
    float max[3][TL_WALK_WIDTH]; ///< of a lane without a child -INFINITY
    uint32_t mask;               ///< bit i: lane i has a child
    uint32_t child[TL_WALK_WIDTH];
} tl_walk_boxes;

typedef struct tl_walk {
    const tl_soup *soup;
    uint32_t count;
    // The bits of the key above the child word: keys are never negative, so their bits have the order of their values.
    uint64_t entries[TL_WALK_STACK_SIZE];
} tl_walk;

static inline bool tl_walk_is_leaf(uint32_t child)
{
    return (child & TL_CHILD_LEAF) != 0;
}

/// The root comes first, with key 0.
static inline void tl_walk_begin(tl_walk *walk, const tl_soup *soup)
{
    walk->soup = soup;
    walk->count = 1;
    walk->entries[0] = 0;
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

static inline void tl_walk_read_compact_boxes(const tl_compact_node *node, tl_walk_boxes *boxes)
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        for (uint32_t lane = 0; lane < TL_WALK_WIDTH; lane++) {
            bool is_child = (node->mask >> lane & 1u) != 0;
            boxes->min[axis][lane] = is_child ? tl_compact_plane(node, axis, node->plane[2 * axis][lane]) : INFINITY;
            boxes->max[axis][lane] =
                is_child ? tl_compact_plane(node, axis, node->plane[2 * axis + 1][lane]) : -INFINITY;
        }
    }
    memcpy(boxes->child, node->child, sizeof boxes->child);
    boxes->mask = node->mask;
}

/// The boxes of a node's children.
static inline void tl_walk_read_boxes(const tl_walk *walk, uint32_t node_index, tl_walk_boxes *boxes)
{
    if (walk->soup->layout == TL_SOUP_COMPACT) {
        tl_walk_read_compact_boxes(&tl_compact_nodes(walk->soup)[node_index], boxes);
        return;
    }
    const tl_soup_node *node = &tl_soup_nodes(walk->soup)[node_index];
    for (uint32_t axis = 0; axis < 3; axis++) {
        memcpy(boxes->min[axis], node->plane[2 * axis], sizeof boxes->min[axis]);
        memcpy(boxes->max[axis], node->plane[2 * axis + 1], sizeof boxes->max[axis]);
    }
    boxes->mask = 0;
    for (uint32_t lane = 0; lane < TL_WALK_WIDTH; lane++) {
        boxes->child[lane] = node->child[lane];
        boxes->mask |= (uint32_t)(node->child[lane] != 0) << lane;
    }
}

static inline tl_aabb tl_walk_box(const tl_walk_boxes *boxes, uint32_t lane)
{
    tl_aabb box = { { boxes->min[0][lane], boxes->min[1][lane], boxes->min[2][lane] },
                    { boxes->max[0][lane], boxes->max[1][lane], boxes->max[2][lane] } };
    return box;
}

/// Pushes the children in `mask`, the one with the smallest key (>= 0) on top; of equal keys, and when
/// `keys` is NULL, the lowest lane.
static inline void tl_walk_enter(tl_walk *walk, const tl_walk_boxes *boxes, uint32_t mask, const float *keys)
{
    uint64_t *base = walk->entries + walk->count;
    uint32_t count = 0;
    for (uint32_t lane = TL_WALK_WIDTH; lane-- > 0;) {
        if ((mask & boxes->mask) >> lane & 1u) {
            uint32_t bits = 0;
            if (keys != NULL) {
                memcpy(&bits, &keys[lane], sizeof bits);
            }
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
    const tl_soup_leaf *leaf; ///< in the soup, or in `buffer`
    tl_leaf_view view;
    uint32_t child;      ///< its word
    uint32_t lane_count; ///< some lanes may hold no triangle
    tl_leaf_buffer buffer;
} tl_walk_leaf;

/// One triangle of a leaf.
typedef struct tl_walk_triangle {
    tl_vec3 corners[3]; ///< as in the view
    uint32_t triangle;
    const tl_walk_leaf *leaf;
    uint32_t lane; ///< its place in the leaf
} tl_walk_triangle;

static inline void tl_walk_open_leaf(const tl_soup *soup, uint32_t child, tl_walk_leaf *leaf)
{
    leaf->leaf = tl_open_leaf(soup, child, &leaf->buffer);
    leaf->view = tl_view_leaf(leaf->leaf);
    leaf->child = child;
    leaf->lane_count = 2 * leaf->view.pair_count;
}

/// False when the lane holds no triangle.
static inline bool tl_walk_read_triangle(const tl_walk_leaf *leaf, uint32_t lane, tl_walk_triangle *triangle)
{
    if (leaf->view.ids[lane] == TL_ID_NONE) {
        return false;
    }
    tl_leaf_corners(&leaf->view, lane, triangle->corners);
    triangle->triangle = leaf->view.ids[lane] & TL_ID_INDEX;
    triangle->leaf = leaf;
    triangle->lane = lane;
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
