// SPDX-License-Identifier: MIT
//
// The top of the binary BVH, where many threads work on one range.

#ifndef TALUS_SRC_SOUP_BVH_TOP_H
#define TALUS_SRC_SOUP_BVH_TOP_H

#include "soup/bake/bvh_split.h"

/// Below this depth ranges are halved by count, which ends within 29 levels more: at most TL_SOUP_MAX_DEPTH in all.
enum { TL_BVH_HEURISTIC_DEPTH = 60 };

/// A subtree that is not built yet.
typedef struct tl_bvh_subtree {
    tl_bvh_range range;
    uint32_t *link;  ///< where its root's index goes
    bool in_scratch; ///< its references are in the splitter's scratch, at the same indices
} tl_bvh_subtree;

typedef struct tl_bvh_top {
    tl_bvh_splitter splitter;
    tl_bvh_node *nodes;
    uint32_t root;
    tl_bvh_subtree *subtrees; ///< from left to right
    uint32_t subtree_count;
} tl_bvh_top;

/// The largest number of subtrees.
uint32_t tl_bvh_max_subtrees(uint32_t pair_count);

/// Makes the references of all pairs, and splits them on the host's tasks until no range is much more than a 64th of
/// the whole. The caller has set splitter (but root_half_area) and nodes; `capacity` is that of both arrays of
/// references.
tl_result tl_bvh_build_top(tl_bvh_top *top, uint32_t pair_count, uint32_t capacity, const tl_host *host,
                           tl_arena *arena);

// A leaf is known by where its references begin, an inner node by where its right part begins. Both are unique among
// nodes of their kind, and the latter is never 0.
static inline uint32_t tl_bvh_leaf_index(uint32_t first)
{
    return 2 * first;
}

static inline uint32_t tl_bvh_split_index(uint32_t right_first)
{
    return 2 * right_first - 1;
}

#endif
