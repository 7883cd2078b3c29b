// SPDX-License-Identifier: MIT
//
// A binary tree over pairs by the surface area heuristic, from the top down, with binned costs. The wide tree is cut
// from it (soup_bake.c): choosing sixteen children at once has no good greedy rule, choosing two has.
//
// A leaf holds up to four pairs and costs one test whatever it holds, so costs count blocks of four, not pairs.
//
// References live in one array; a range is split in place. With spatial splits a range grows, so it has spare room
// behind it, handed down in proportion to the counts. A node's place follows from its range alone (see node_of_leaf),
// so subtrees can be built by any number of threads, without a lock, and always give the same tree.
//
// Sources: Ingo Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007 (binning); Martin Stich,
// Heiko Friedrich, Andreas Dietrich, Spatial Splits in Bounding Volume Hierarchies, 2009.

#include "base/assert.h"
#include "base/host.h"
#include "soup/soup_build.h"
#include "soup/soup_layout.h"
#include "soup/tree_split.h"

#include <string.h>

// Below this depth ranges are halved by count, which ends within 29 levels more: at most TL_SOUP_MAX_DEPTH in all.
enum { HEURISTIC_DEPTH = 60 };
static_assert(HEURISTIC_DEPTH + 32 <= TL_SOUP_MAX_DEPTH, "a range of 2^32 references ends within the depth limit");

// Subtrees that tasks build: the top is split on the calling thread until ranges are a 64th of the whole. A range far
// smaller than that is built at once, so there are at most TASK_SHARE * SMALL_SHARE of the others.
enum { TASK_SHARE = 64, SMALL_SHARE = 16, MIN_TASK_REFS = 512 };

// A child box costs this share of a leaf test to look at.
#define TRAVERSAL_COST 0.25f

typedef struct subtree {
    tl_tree_range range;
    uint32_t *parent_link; // where its root's index goes
} subtree;

typedef struct builder {
    tl_tree_splitter splitter;
    tl_tree_node *nodes;
    uint32_t task_refs; // a range of so many or fewer becomes a task
    subtree *subtrees;
    uint32_t subtree_count;
    uint32_t subtree_capacity;
    uint32_t root;
} builder;

// A leaf begins at a place of its own; an inner node belongs to the place at which its right part begins. Both are
// unique among nodes of their kind, and the latter is never 0.
static uint32_t node_of_leaf(uint32_t first)
{
    return 2 * first;
}

static uint32_t node_of_split(uint32_t right_first)
{
    return 2 * right_first - 1;
}

// Both parts of a pair that was cut may end in one leaf: one of them is enough.
static uint32_t drop_repeated(tl_tree_ref *refs, uint32_t count)
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

static uint32_t make_leaf(builder *b, const tl_tree_range *range)
{
    uint32_t index = node_of_leaf(range->first);
    tl_tree_node *node = &b->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = range->box;
    node->first = range->first;
    node->count = drop_repeated(b->splitter.refs + range->first, range->count);
    return index;
}

static bool leaf_is_better(const tl_tree_range *range, const tl_tree_split *split)
{
    if (range->count > TL_SOUP_LEAF_PAIRS) {
        return false;
    }
    return range->count == 1 || !split->found || tl_aabb_half_area(range->box) * (1.0f - TRAVERSAL_COST) <= split->cost;
}

static uint32_t build_range(builder *b, tl_tree_range range)
{
    tl_tree_split split;
    split.found = false;
    if (range.count > 1 && range.depth < HEURISTIC_DEPTH) {
        split = tl_tree_find_split(&b->splitter, &range);
    }
    if (leaf_is_better(&range, &split)) {
        return make_leaf(b, &range);
    }
    tl_tree_range left, right;
    tl_tree_apply_split(&b->splitter, &range, &split, &left, &right);
    uint32_t index = node_of_split(right.first);
    tl_tree_node *node = &b->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = range.box;
    node->left = build_range(b, left);
    node->right = build_range(b, right);
    return index;
}

// The same for the top of the tree, but ranges of a task's size are put on the list.
static void build_top(builder *b, tl_tree_range range, uint32_t *parent_link)
{
    if (range.count <= b->task_refs) {
        if (range.count < b->task_refs / SMALL_SHARE || b->subtree_count == b->subtree_capacity) {
            *parent_link = build_range(b, range);
        } else {
            subtree waiting = { range, parent_link };
            b->subtrees[b->subtree_count++] = waiting;
        }
        return;
    }
    tl_tree_split split;
    split.found = false;
    if (range.depth < HEURISTIC_DEPTH) {
        split = tl_tree_find_split(&b->splitter, &range);
    }
    tl_tree_range left, right;
    tl_tree_apply_split(&b->splitter, &range, &split, &left, &right);
    uint32_t index = node_of_split(right.first);
    tl_tree_node *node = &b->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = range.box;
    *parent_link = index;
    build_top(b, left, &node->left);
    build_top(b, right, &node->right);
}

static void build_subtree(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    builder *b = user;
    *b->subtrees[index].parent_link = build_range(b, b->subtrees[index].range);
}

static uint32_t count_references(const tl_tree_node *nodes, uint32_t root)
{
    uint32_t stack[TL_SOUP_MAX_DEPTH + 1];
    uint32_t stack_count = 0;
    uint32_t count = 0;
    stack[stack_count++] = root;
    while (stack_count > 0) {
        const tl_tree_node *node = &nodes[stack[--stack_count]];
        count += node->count;
        if (node->count == 0) {
            stack[stack_count++] = node->right;
            stack[stack_count++] = node->left;
        }
    }
    return count;
}

tl_result tl_tree_build(const tl_mesh *mesh, const tl_pair *pairs, uint32_t pair_count, const tl_soup_def *def,
                        tl_arena *arena, tl_tree *tree_out)
{
    uint32_t spare = (uint32_t)((double)pair_count * (double)def->split_budget);
    uint32_t capacity = pair_count + spare;
    builder b;
    memset(&b, 0, sizeof b);
    tl_tree_ref *refs = TL_PUSH(arena, tl_tree_ref, capacity);
    b.nodes = TL_PUSH(arena, tl_tree_node, 2 * (uint64_t)capacity);
    b.splitter.scratch = TL_PUSH(arena, tl_tree_ref, capacity);
    b.subtree_capacity = 2 * TASK_SHARE * SMALL_SHARE;
    b.subtrees = TL_PUSH(arena, subtree, b.subtree_capacity);
    if (refs == NULL || b.splitter.scratch == NULL || b.nodes == NULL || b.subtrees == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < pair_count; i++) {
        refs[i] = tl_tree_reference(mesh, pairs, i);
    }
    tl_tree_range whole = tl_tree_measure_range(refs, 0, pair_count, capacity, 0);
    b.splitter.mesh = mesh;
    b.splitter.pairs = pairs;
    b.splitter.refs = refs;
    b.splitter.root_half_area = tl_aabb_half_area(whole.box);
    b.task_refs = pair_count / TASK_SHARE > MIN_TASK_REFS ? pair_count / TASK_SHARE : MIN_TASK_REFS;
    build_top(&b, whole, &b.root);
    tl_run_tasks(&def->host, build_subtree, b.subtree_count, &b);
    tree_out->refs = refs;
    tree_out->nodes = b.nodes;
    tree_out->root = b.root;
    tree_out->parts = NULL;
    tree_out->part_count = 0;
    tree_out->ref_count = count_references(b.nodes, b.root);
    return TL_OK;
}
