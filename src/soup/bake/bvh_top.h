// SPDX-License-Identifier: MIT
//
// The top of the binary BVH, where many threads work on one range.

#ifndef TALUS_SRC_SOUP_BVH_TOP_H
#define TALUS_SRC_SOUP_BVH_TOP_H

#include "soup/bake/bvh_split.h"

/// Below this depth ranges are halved by count, which ends within 29 levels more: at most TL_SOUP_MAX_DEPTH in all.
enum { TL_BVH_HEURISTIC_DEPTH = 60 };

/// A subtree of so many references is built in some 5 ms.
enum { TL_BVH_SUBTREE_REFS = 1 << 13 };

/// An inner node of the top. A child is another one, or TL_BVH_SUBTREE + the index of a subtree.
typedef struct tl_bvh_top_node {
    tl_aabb box;
    uint32_t child[2];
} tl_bvh_top_node;

#define TL_BVH_SUBTREE 0x80000000u

/// A subtree that is not built yet.
typedef struct tl_bvh_subtree {
    tl_bvh_range range;
    uint32_t *link;  ///< of its parent, or the top's root
    uint32_t sum;    ///< leaf surfaces of subtrees of one number are summed up first, then those sums
    bool in_scratch; ///< its references are in the splitter's scratch, at the same indices
} tl_bvh_subtree;

typedef struct tl_bvh_top {
    tl_bvh_splitter splitter;
    tl_bvh_top_node *nodes;
    uint32_t node_count;
    uint32_t root;            ///< as a child
    tl_bvh_subtree *subtrees; ///< from left to right
    uint32_t subtree_count;
} tl_bvh_top;

/// Makes the references of all pairs, and splits them on the host's tasks until no range is much more than
/// TL_BVH_SUBTREE_REFS. The caller has set splitter (but root_half_area); `capacity` is that of both arrays of
/// references. Nodes and subtrees are the arena's. Adds `pair_count` to the stage.
tl_result tl_bvh_build_top(tl_bvh_top *top, uint32_t pair_count, uint32_t capacity, tl_stage *stage, tl_arena *arena);

#endif
