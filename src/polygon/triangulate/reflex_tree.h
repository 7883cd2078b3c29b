// SPDX-License-Identifier: MIT
//
// Is a triangle free of an outline's reflex vertices? A k-d tree over points that are removed one by one.

#ifndef TALUS_SRC_POLYGON_REFLEX_TREE_H
#define TALUS_SRC_POLYGON_REFLEX_TREE_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

typedef struct tl_reflex_node {
    int32_t min_x, max_x, min_z, max_z;
    uint32_t alive; // points left in this leaf, or children with any left
    uint32_t first; // of its points in `points`
    uint32_t right; // second child; the first one is the next node. 0: a leaf
    uint32_t parent;
} tl_reflex_node;

/// A point in the tree, with its position at hand.
typedef struct tl_reflex_point {
    tl_lattice_point position;
    uint32_t number;
} tl_reflex_point;

typedef struct tl_reflex_tree {
    uint32_t node_count;
    tl_reflex_node *nodes;
    tl_reflex_point *points; // leaf after leaf; the living ones of a leaf come first
    uint32_t *leaf;          // [number] of each point in the tree
} tl_reflex_tree;

/// Builds the tree over the positions with is_reflex[i] set. O(n log n). False: out of memory.
bool tl_reflex_tree_init(tl_reflex_tree *tree, tl_arena *arena, const tl_lattice_point *positions,
                         const uint8_t *is_reflex, uint32_t count);

/// Takes a point out. It must be in.
void tl_reflex_tree_remove(tl_reflex_tree *tree, uint32_t point);

/// Whether a point of the tree lies in the closed triangle (a, b, c), which has a turn > 0. Points at the place of one
/// of its corners do not count: they are the corners themselves or the far sides of bridges, whose interior angles lie
/// outside.
bool tl_reflex_tree_any_in_triangle(const tl_reflex_tree *tree, tl_lattice_point a, tl_lattice_point b,
                                    tl_lattice_point c);

#endif
