// SPDX-License-Identifier: MIT
//
// Which binary nodes become the children of a wide node.

#ifndef TALUS_SRC_SOUP_TREE_CUT_H
#define TALUS_SRC_SOUP_TREE_CUT_H

#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

typedef struct tl_tree_cut {
    const tl_tree *tree;
    const struct tl_tree_plan *plans;
    uint32_t inner_count; ///< binary nodes that are no leaves; there are no more wide nodes, but for a lone leaf's
    const float *chance;  ///< by binary node (tree_order.h)
} tl_tree_cut;

/// A whole subtree as a part.
tl_tree_part tl_tree_sum_part(const tl_tree_node *nodes, uint32_t root);

/// Plans the cut of a tree on the host's tasks, and writes into its inner nodes which plan is theirs. Memory is the
/// arena's.
tl_result tl_tree_cut_plan(const tl_tree *tree, const tl_host *host, tl_arena *arena, tl_tree_cut *cut_out);

/// The children of the wide node that stands for the binary node `root`, in their order; returns how many.
uint32_t tl_tree_cut_children(const tl_tree_cut *cut, uint32_t root, uint32_t children[TL_SOUP_WIDTH]);

#endif
