// SPDX-License-Identifier: MIT
//
// Which binary nodes become the children of a wide node.

#ifndef TALUS_SRC_SOUP_BVH_COLLAPSE_H
#define TALUS_SRC_SOUP_BVH_COLLAPSE_H

#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

typedef struct tl_bvh_collapse {
    const tl_bvh *tree;
    const struct tl_collapse_plan *plans;
    const float *chance; ///< by binary node (bvh_order.h)
} tl_bvh_collapse;

/// Plans the collapse of a tree on the tasks of the stage's host, and writes into each inner node the index of its
/// plan. Memory is the arena's.
tl_result tl_bvh_plan_collapse(tl_bvh *tree, tl_stage *stage, tl_arena *arena, tl_bvh_collapse *cut_out);

/// The children of the wide node that stands for the binary node `root`, in their order; returns how many.
uint32_t tl_bvh_collapsed_children(const tl_bvh_collapse *cut, uint32_t root, uint32_t children[TL_SOUP_WIDTH]);

#endif
