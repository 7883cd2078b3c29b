// SPDX-License-Identifier: MIT
//
// A binary BVH over pairs, built from the top down by the surface area heuristic (SAH) with binned costs. The 16-wide
// BVH is collapsed from it (bvh_collapse.c): no greedy rule chooses sixteen children well, and a good one chooses two.
//
// A leaf holds up to four pairs and costs one test whatever it holds, so costs count blocks of four, not pairs.
//
// References lie in one array; a range is split in place. With spatial splits a range grows, so spare capacity lies
// behind it, shared out in proportion to the counts. Each task builds a subtree into nodes of its worker, since nobody
// knows how many there will be, and keeps a copy of the right size; then all lie one behind the other in preorder. So
// any number of threads build subtrees without a lock, the tree is always the same, and no memory waits for nodes that
// there might be.
//
// Sources: MacDonald, Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990 (SAH); Wald, On fast Construction
// of SAH-based Bounding Volume Hierarchies, 2007 (binning); Stich, Friedrich, Dietrich, Spatial Splits in Bounding
// Volume Hierarchies, 2009 (SBVH).

#include "base/assert.h"
#include "base/host.h"
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

static bool leaf_is_better(const tl_bvh_range *range, const tl_bvh_split *split)
{
    if (range->count > TL_SOUP_LEAF_PAIRS) {
        return false;
    }
    return range->count == 1 || !split->found ||
           tl_aabb_half_area(range->box) * (1.0f - TL_BVH_TRAVERSAL_COST) <= split->cost;
}

// Nodes of a worker's subtree.
typedef struct node_list {
    tl_bvh_node *nodes;
    uint64_t count, capacity;
} node_list;

// A subtree that is built; its indices count from its own first node.
typedef struct built_subtree {
    tl_bvh_node *nodes; // NULL: out of memory
    uint32_t count;
    uint32_t ref_count; // in leaves
    uint32_t place;     // where its first node goes
} built_subtree;

typedef struct subtree_tasks {
    const tl_bvh_top *top;
    const tl_allocator *allocator;
    node_list *lists; // of workers
    built_subtree *built;
    tl_bvh_node *nodes; // of the whole tree
} subtree_tasks;

// Leaf or split? Splits the range where that is better.
static bool split_bvh_range(const tl_bvh_top *top, const tl_bvh_range *range, tl_bvh_range *left, tl_bvh_range *right)
{
    tl_bvh_split split;
    split.found = false;
    if (range->count > 1 && range->depth < TL_BVH_HEURISTIC_DEPTH) {
        split = tl_bvh_find_split(&top->splitter, range);
    }
    if (leaf_is_better(range, &split)) {
        return false;
    }
    tl_bvh_apply_split(&top->splitter, range, &split, left, right);
    return true;
}

// In preorder. The right parts of nodes on the path wait on a stack, which is as deep as the tree at most.
static bool build_bvh_range(const subtree_tasks *tasks, node_list *list, tl_bvh_range range, uint32_t *ref_count)
{
    struct {
        tl_bvh_range range;
        uint32_t parent;
    } waiting[TL_SOUP_MAX_DEPTH];
    uint32_t depth = 0;
    list->count = 0;
    *ref_count = 0;
    for (;;) {
        if (list->count == list->capacity) {
            tl_bvh_node *grown = tl_grow_array(tasks->allocator, list->nodes, &list->capacity, sizeof *grown);
            if (grown == NULL) {
                return false;
            }
            list->nodes = grown;
        }
        const uint32_t index = (uint32_t)list->count++;
        tl_bvh_node *node = &list->nodes[index];
        tl_bvh_range left, right;
        node->box = range.box;
        if (split_bvh_range(tasks->top, &range, &left, &right)) {
            TL_ASSERT(depth < TL_SOUP_MAX_DEPTH);
            node->kind = 0;
            waiting[depth].range = right;
            waiting[depth++].parent = index;
            range = left;
            continue;
        }
        const uint32_t kept = drop_repeated(tasks->top->splitter.refs + range.first, range.count);
        node->link = range.first;
        node->kind = TL_BVH_LEAF + kept;
        *ref_count += kept;
        if (depth == 0) {
            return true;
        }
        range = waiting[--depth].range;
        list->nodes[waiting[depth].parent].link = (uint32_t)list->count;
    }
}

static void build_subtree(uint32_t index, uint32_t worker, void *user)
{
    const subtree_tasks *tasks = user;
    const tl_bvh_top *top = tasks->top;
    const tl_bvh_subtree *subtree = &top->subtrees[index];
    const tl_bvh_range *range = &subtree->range;
    node_list *list = &tasks->lists[worker];
    built_subtree *built = &tasks->built[index];
    if (subtree->in_scratch) {
        memcpy(top->splitter.refs + range->first, top->splitter.scratch + range->first,
               (size_t)range->count * sizeof(tl_bvh_ref));
    }
    if (build_bvh_range(tasks, list, *range, &built->ref_count)) {
        built->nodes = tl_allocate_array(tasks->allocator, list->count, sizeof *built->nodes);
        built->count = (uint32_t)list->count;
        if (built->nodes != NULL) {
            memcpy(built->nodes, list->nodes, (size_t)list->count * sizeof *built->nodes);
        }
    }
}

// Moves a subtree's nodes to their place.
static void place_subtree(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const subtree_tasks *tasks = user;
    built_subtree *built = &tasks->built[index];
    tl_bvh_node *to = tasks->nodes + built->place;
    for (uint32_t i = 0; i < built->count; i++) {
        to[i] = built->nodes[i];
        to[i].link += tl_bvh_leaf_count(&to[i]) == 0 ? built->place : 0;
    }
    tl_release_array(tasks->allocator, built->nodes, built->count, sizeof *built->nodes);
    built->nodes = NULL;
}

// Writes the nodes of the top in preorder, and leaves room for the subtrees.
static uint32_t place_top(const subtree_tasks *tasks)
{
    const tl_bvh_top *top = tasks->top;
    struct {
        uint32_t child, parent;
    } waiting[TL_SOUP_MAX_DEPTH];
    uint32_t depth = 0, next = 0, child = top->root;
    for (;;) {
        if (child < TL_BVH_SUBTREE) {
            tl_bvh_node node = { top->nodes[child].box, 0, 0 };
            TL_ASSERT(depth < TL_SOUP_MAX_DEPTH);
            waiting[depth].child = top->nodes[child].child[1];
            waiting[depth++].parent = next;
            tasks->nodes[next++] = node;
            child = top->nodes[child].child[0];
            continue;
        }
        built_subtree *built = &tasks->built[child - TL_BVH_SUBTREE];
        built->place = next;
        next += built->count;
        if (depth == 0) {
            return next;
        }
        child = waiting[--depth].child;
        tasks->nodes[waiting[depth].parent].link = next;
    }
}

// Sums are added up in an order that depends on the mesh alone.
static tl_result sum_surfaces(const subtree_tasks *tasks, tl_stage *stage, tl_bvh *tree)
{
    const tl_bvh_top *top = tasks->top;
    double sum = 0.0, part = 0.0;
    tree->inner_surface = 0.0;
    for (uint32_t i = 0; i < top->node_count; i++) {
        tree->inner_surface += (double)tl_aabb_half_area(top->nodes[i].box);
    }
    for (uint32_t i = 0; i < top->subtree_count; i++) {
        const built_subtree *built = &tasks->built[i];
        if (i > 0 && top->subtrees[i].sum != top->subtrees[i - 1].sum) {
            sum += part;
            part = 0.0;
        }
        TL_TRY(tl_stage_tick(stage, TL_STAGE_STEP / 16 * (uint64_t)i + TL_STAGE_STEP - 1));
        for (uint32_t k = built->place; k < built->place + built->count; k++) {
            double surface = (double)tl_aabb_half_area(tasks->nodes[k].box);
            if (tl_bvh_leaf_count(&tasks->nodes[k]) > 0) {
                part += surface;
            } else {
                tree->inner_surface += surface;
            }
        }
    }
    tree->leaf_surface = sum + part;
    return TL_OK;
}

// The subtrees that tasks have built, as one tree.
static tl_result join_subtrees(subtree_tasks *tasks, tl_stage *stage, tl_arena *arena, tl_bvh *tree)
{
    const uint32_t count = tasks->top->subtree_count;
    uint64_t node_count = count - 1;
    tree->ref_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (tasks->built[i].nodes == NULL) {
            return TL_ERR_MEMORY;
        }
        node_count += tasks->built[i].count;
        tree->ref_count += tasks->built[i].ref_count;
    }
    // One block, of the right size.
    (void)tl_arena_reserve(arena, count * sizeof(tl_bvh_part) + node_count * sizeof(tl_bvh_node) + 128);
    tl_bvh_part *parts = TL_PUSH(arena, tl_bvh_part, count);
    tree->nodes = TL_PUSH(arena, tl_bvh_node, node_count);
    if (parts == NULL || tree->nodes == NULL) {
        return TL_ERR_MEMORY;
    }
    tasks->nodes = tree->nodes;
    tree->node_count = place_top(tasks);
    TL_ASSERT(tree->node_count == node_count);
    TL_TRY(tl_stage_run(stage, place_subtree, count, tasks, 32, 0));
    for (uint32_t i = 0; i < count; i++) {
        parts[i] = (tl_bvh_part){ tasks->built[i].place, tasks->built[i].count };
    }
    tree->parts = parts;
    tree->part_count = count;
    return sum_surfaces(tasks, stage, tree);
}

static tl_result build_subtrees(subtree_tasks *tasks, const tl_bvh_input *input, tl_stage *stage, tl_arena *scratch)
{
    const uint32_t workers = tl_worker_count(stage != NULL ? stage->host : NULL);
    node_list *lists = TL_PUSH_ZERO(scratch, node_list, workers);
    tasks->built = TL_PUSH_ZERO(scratch, built_subtree, tasks->top->subtree_count);
    if (lists == NULL || tasks->built == NULL) {
        return TL_ERR_MEMORY;
    }
    tasks->lists = lists;
    tl_result result = tl_stage_run(stage, build_subtree, tasks->top->subtree_count, tasks, 4,
                                    input->pair_count - input->pair_count / 4);
    for (uint32_t i = 0; i < workers; i++) {
        tl_release_array(tasks->allocator, lists[i].nodes, lists[i].capacity, sizeof *lists[i].nodes);
    }
    return result;
}

// The tree's references are in `arena` already; `scratch` is for what only the build needs.
static tl_result build_bvh_tree(const tl_bvh_input *input, tl_bvh_top *top, tl_stage *stage, tl_arena *arena,
                                tl_arena *scratch, tl_bvh *tree)
{
    const uint32_t capacity = input->pair_count + (uint32_t)((double)input->pair_count * (double)input->split_budget);
    tl_arena moved; // freed before the nodes of all subtrees lie side by side
    tl_arena_init(&moved, &arena->allocator);
    top->splitter.refs = TL_PUSH(arena, tl_bvh_ref, capacity);
    top->splitter.scratch = TL_PUSH(&moved, tl_bvh_ref, capacity);
    subtree_tasks tasks = { .top = top, .allocator = &arena->allocator };
    tl_result result = TL_ERR_MEMORY;
    if (top->splitter.refs != NULL && top->splitter.scratch != NULL) {
        result = tl_bvh_build_top(top, input->pair_count, capacity, stage, scratch);
    }
    if (result == TL_OK) {
        result = build_subtrees(&tasks, input, stage, scratch);
    }
    tl_arena_free(&moved);
    if (result == TL_OK) {
        result = join_subtrees(&tasks, stage, arena, tree);
    }
    for (uint32_t i = 0; tasks.built != NULL && i < top->subtree_count; i++) {
        tl_release_array(tasks.allocator, tasks.built[i].nodes, tasks.built[i].count, sizeof *tasks.built[i].nodes);
    }
    tree->refs = top->splitter.refs;
    return result;
}

tl_result tl_bvh_build(const tl_bvh_input *input, tl_stage *stage, tl_arena *arena, tl_bvh *tree_out)
{
    tl_bvh_top top;
    memset(&top, 0, sizeof top);
    top.splitter.mesh = input->mesh;
    top.splitter.pairs = input->pairs;
    tl_arena scratch;
    tl_arena_init(&scratch, &arena->allocator);
    tl_result result = build_bvh_tree(input, &top, stage, arena, &scratch, tree_out);
    tl_arena_free(&scratch);
    return result;
}
