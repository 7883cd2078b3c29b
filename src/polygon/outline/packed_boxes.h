// SPDX-License-Identifier: MIT
//
// A packed tree of boxes in the plane: which of many boxes does a segment meet?

#ifndef TALUS_SRC_POLYGON_PACKED_BOXES_H
#define TALUS_SRC_POLYGON_PACKED_BOXES_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

/// Closed; of points: both corners are the same.
typedef struct tl_lattice_box {
    tl_lattice_point low, high;
} tl_lattice_box;

enum { TL_PACKED_BOXES_LEVELS = 12, TL_PACKED_BOXES_CHILDREN = 8 };

typedef struct tl_packed_boxes {
    tl_lattice_box *boxes; // the items' in the tree's order, then level by level those above, the top last
    uint32_t *items;       // [count] in the tree's order
    uint32_t level_first[TL_PACKED_BOXES_LEVELS + 1];
    uint32_t levels; // 1: items alone
} tl_packed_boxes;

/// Builds a tree over `count` > 0 boxes, in `arena`. O(n). False: out of memory.
bool tl_packed_boxes_build(tl_packed_boxes *tree, tl_arena *arena, const tl_lattice_box *boxes, uint32_t count);

/// A walk over the boxes that a segment meets, in the tree's order.
typedef struct tl_packed_boxes_walk {
    const tl_packed_boxes *tree;
    tl_lattice_point a, b;
    int32_t margin;
    uint32_t depth;
    uint32_t stack[TL_PACKED_BOXES_LEVELS * TL_PACKED_BOXES_CHILDREN]; // places in `boxes`
} tl_packed_boxes_walk;

/// Boxes count as larger by `margin` to all sides.
void tl_packed_boxes_begin(tl_packed_boxes_walk *walk, const tl_packed_boxes *tree, tl_lattice_point a,
                           tl_lattice_point b, int32_t margin);
/// The next item; false: that was all.
bool tl_packed_boxes_next(tl_packed_boxes_walk *walk, uint32_t *item_out);

#endif
