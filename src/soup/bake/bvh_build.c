// SPDX-License-Identifier: MIT
//
// A binary BVH over pairs, built from the top down by the surface area heuristic (SAH) with binned costs. The 16-wide
// BVH is collapsed from it (bvh_collapse.c): no greedy rule chooses sixteen children well, and a good one chooses two.
//
// A leaf holds up to four pairs and costs one test whatever it holds, so costs count blocks of four, not pairs.
//
// References lie in one array; a range is split in place. With spatial splits a range grows, so spare capacity lies
// behind it, shared out in proportion to the counts. A node's index follows from its range alone (tl_bvh_leaf_index),
// so any number of threads can build subtrees without a lock, and the tree is always the same.
//
// Sources: MacDonald, Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990 (SAH); Wald, On fast Construction
// of SAH-based Bounding Volume Hierarchies, 2007 (binning); Stich, Friedrich, Dietrich, Spatial Splits in Bounding
// Volume Hierarchies, 2009 (SBVH).

#include "base/assert.h"
#include "base/host.h"
#include "soup/bake/bvh_collapse.h"
#include "soup/bake/bvh_split.h"
#include "soup/bake/bvh_top.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

// Both halves of a clipped pair may end in one leaf, which then keeps one reference with both boxes.
static uint32_t drop_repeated(tl_bvh_ref *refs, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t k = 0;
        while (k < kept && refs[k].pair != refs[i].pair) {
            k++;
        }
        if (k == kept) {
            refs[kept++] = refs[i];
        } else {
            refs[k].min = tl_min(refs[k].min, refs[i].min);
            refs[k].max = tl_max(refs[k].max, refs[i].max);
        }
    }
    return kept;
}

static uint32_t make_leaf(const tl_bvh_top *top, const tl_bvh_range *range)
{
    uint32_t index = tl_bvh_leaf_index(range->first);
    tl_bvh_node *node = &top->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = range->box;
    node->first = range->first;
    node->count = drop_repeated(top->splitter.refs + range->first, range->count);
    return index;
}

static bool leaf_is_better(const tl_bvh_range *range, const tl_bvh_split *split)
{
    if (range->count > TL_SOUP_LEAF_PAIRS) {
        return false;
    }
    return range->count == 1 || !split->found ||
           tl_aabb_half_area(range->box) * (1.0f - TL_BVH_TRAVERSAL_COST) <= split->cost;
}

static uint32_t build_bvh_range(const tl_bvh_top *top, tl_bvh_range range)
{
    tl_bvh_split split;
    split.found = false;
    if (range.count > 1 && range.depth < TL_BVH_HEURISTIC_DEPTH) {
        split = tl_bvh_find_split(&top->splitter, &range);
    }
    if (leaf_is_better(&range, &split)) {
        return make_leaf(top, &range);
    }
    tl_bvh_range left, right;
    tl_bvh_apply_split(&top->splitter, &range, &split, &left, &right);
    uint32_t index = tl_bvh_split_index(right.first);
    tl_bvh_node *node = &top->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = range.box;
    node->left = build_bvh_range(top, left);
    node->right = build_bvh_range(top, right);
    return index;
}

typedef struct subtree_tasks {
    const tl_bvh_top *top;
    tl_bvh_part *parts;
} subtree_tasks;

static void build_subtree(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const subtree_tasks *tasks = user;
    const tl_bvh_top *top = tasks->top;
    const tl_bvh_subtree *subtree = &top->subtrees[index];
    const tl_bvh_range *range = &subtree->range;
    if (subtree->in_scratch) {
        memcpy(top->splitter.refs + range->first, top->splitter.scratch + range->first,
               (size_t)range->count * sizeof(tl_bvh_ref));
    }
    *subtree->link = build_bvh_range(top, *range);
    tasks->parts[index] = tl_bvh_sum_part(top->nodes, *subtree->link);
}

tl_result tl_bvh_build(const tl_mesh *mesh, const tl_triangle_pair *pairs, uint32_t pair_count, const tl_soup_def *def,
                       tl_arena *arena, tl_bvh *tree_out)
{
    uint32_t spare = (uint32_t)((double)pair_count * (double)def->split_budget);
    uint32_t capacity = pair_count + spare;
    tl_bvh_top top;
    top.splitter.mesh = mesh;
    top.splitter.pairs = pairs;
    top.splitter.refs = TL_PUSH(arena, tl_bvh_ref, capacity);
    top.nodes = TL_PUSH(arena, tl_bvh_node, 2 * (uint64_t)capacity);
    tl_bvh_part *parts = TL_PUSH(arena, tl_bvh_part, tl_bvh_max_subtrees(pair_count));
    tl_arena_mark mark = tl_arena_get_mark(arena);
    top.splitter.scratch = TL_PUSH(arena, tl_bvh_ref, capacity);
    if (top.splitter.refs == NULL || top.nodes == NULL || parts == NULL || top.splitter.scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_bvh_build_top(&top, pair_count, capacity, &def->host, arena));
    subtree_tasks tasks = { &top, parts };
    tl_run_tasks(&def->host, build_subtree, top.subtree_count, &tasks);
    tree_out->ref_count = 0;
    for (uint32_t i = 0; i < top.subtree_count; i++) {
        tree_out->ref_count += parts[i].ref_count;
    }
    tree_out->refs = top.splitter.refs;
    tree_out->nodes = top.nodes;
    tree_out->node_capacity = 2 * (uint64_t)capacity;
    tree_out->root = top.root;
    tree_out->parts = parts;
    tree_out->part_count = top.subtree_count;
    tl_arena_rollback(arena, mark);
    return TL_OK;
}
