// SPDX-License-Identifier: MIT
//
// The top of the binary BVH, built in parallel within a range. Few ranges are large there, so tasks take blocks of
// their references: each block fills bins of its own, which add up in any order; the chosen plane tells from a block's
// bins how many of its references go left, so every block knows where to write before any of them does. References move
// between two arrays, one pass a level. All ranges of a level are split together, so that there are few parallel loops.
//
// A range that a spatial split clips, or that is halved, is one task: such ranges are rare, or nearly done.
//
// The top has two parts. Down to a 64th of the whole, ranges are as many as tasks need. Below, ranges of large meshes
// are split further, only so that progress is called often. How surfaces are summed up depends on the first part alone.

#include "soup/bake/bvh_top.h"

#include "base/assert.h"
#include "base/radix_sort.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

static_assert(TL_BVH_HEURISTIC_DEPTH + 32 <= TL_SOUP_MAX_DEPTH,
              "a range of 2^32 references ends within the depth limit");

// The first part of the top ends where a range is a 64th of the whole.
enum { TASK_SHARE = 64, MIN_TASK_REFS = 1024 };

// A block takes less than a tenth of a millisecond; so many are run for each worker between two progress calls.
enum { BLOCK_REFS = 1024, REF_BLOCK_BATCH = 64 };

// A range of the level that is being split.
typedef struct top_range {
    tl_bvh_subtree subtree;
    tl_bvh_grid grid;
    tl_bvh_split split;
    uint32_t first_block, block_count;
    tl_bvh_range left, right;
} top_range;

typedef struct top_block {
    uint32_t range;
    uint32_t first, count;            // references
    uint32_t left_first, right_first; // where its references go
    tl_bvh_bins bins;
    tl_box4 centroids[2];
} top_block;

typedef struct top_builder {
    tl_bvh_top *top;
    tl_stage *stage;
    uint32_t max_subtrees;
    uint32_t part_refs;   // ranges of no more are done in this part of the top
    uint64_t level_share; // of the stage
    top_range *ranges;
    tl_bvh_subtree *next; // ranges of the next level
    uint32_t range_count;
    top_block *blocks;
    uint32_t block_count;
} top_builder;

static tl_bvh_splitter splitter_of(const top_builder *b, const top_range *r)
{
    tl_bvh_splitter s = b->top->splitter;
    if (r->subtree.in_scratch) {
        s.refs = b->top->splitter.scratch;
        s.scratch = b->top->splitter.refs;
    }
    return s;
}

static void lay_blocks(top_builder *b)
{
    b->block_count = 0;
    for (uint32_t i = 0; i < b->range_count; i++) {
        top_range *r = &b->ranges[i];
        const tl_bvh_range *range = &r->subtree.range;
        r->first_block = b->block_count;
        for (uint32_t done = 0; done < range->count; done += BLOCK_REFS) {
            top_block *block = &b->blocks[b->block_count++];
            block->range = i;
            block->first = range->first + done;
            block->count = range->count - done < BLOCK_REFS ? range->count - done : BLOCK_REFS;
        }
        r->block_count = b->block_count - r->first_block;
    }
}

static void make_references(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const top_builder *b = user;
    const tl_bvh_splitter *s = &b->top->splitter;
    top_block *block = &b->blocks[index];
    for (uint32_t i = block->first; i < block->first + block->count; i++) {
        s->refs[i] = tl_bvh_reference(s->mesh, s->pairs, i);
    }
    tl_bvh_range measured = tl_bvh_measure_range(s->refs, block->first, block->count, block->count, 0);
    block->centroids[0] = tl_box4_of(measured.box);
    block->centroids[1] = tl_box4_of(measured.centroids);
}

static void fill_block_bins(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const top_builder *b = user;
    top_block *block = &b->blocks[index];
    const top_range *r = &b->ranges[block->range];
    tl_bvh_fill_bins(splitter_of(b, r).refs + block->first, block->count, &r->grid, &block->bins);
}

static void choose_range_split(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const top_builder *b = user;
    top_range *r = &b->ranges[index];
    const tl_bvh_range *range = &r->subtree.range;
    tl_bvh_splitter splitter = splitter_of(b, r);
    top_block *blocks = &b->blocks[r->first_block];
    tl_bvh_bins bins = blocks[0].bins;
    for (uint32_t i = 1; i < r->block_count; i++) {
        tl_bvh_add_bins(&blocks[i].bins, &r->grid, &bins);
    }
    r->split = tl_bvh_choose_plane(&bins, &r->grid);
    r->split.found = r->split.found && range->depth < TL_BVH_HEURISTIC_DEPTH;
    tl_bvh_improve_by_spatial_split(&splitter, range, &r->split);
    if (!r->split.found || r->split.spatial) {
        return;
    }
    uint32_t left_count = tl_bvh_count_left(&bins, &r->split);
    tl_bvh_share_range(range, left_count, range->count - left_count, &r->left, &r->right);
    uint32_t left_first = r->left.first, right_first = r->right.first;
    for (uint32_t i = 0; i < r->block_count; i++) {
        uint32_t left = tl_bvh_count_left(&blocks[i].bins, &r->split);
        blocks[i].left_first = left_first;
        blocks[i].right_first = right_first;
        left_first += left;
        right_first += blocks[i].count - left;
    }
}

static void part_block(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const top_builder *b = user;
    top_block *block = &b->blocks[index];
    top_range *r = &b->ranges[block->range];
    tl_bvh_splitter s = splitter_of(b, r);
    if (r->split.found && !r->split.spatial) {
        block->centroids[0] = tl_box4_empty();
        block->centroids[1] = tl_box4_empty();
        tl_bvh_divide(s.refs + block->first, block->count, &r->grid, &r->split, s.scratch + block->left_first,
                      s.scratch + block->right_first, block->centroids);
    } else if (index == r->first_block) {
        tl_bvh_apply_split(&s, &r->subtree.range, &r->split, &r->left, &r->right);
    }
}

// The node of a range that was split; its sides are the next level's, or subtrees.
static void end_range(top_builder *b, const top_range *r, tl_bvh_subtree sides[2])
{
    sides[0].range = r->left;
    sides[1].range = r->right;
    *r->subtree.link = b->top->node_count;
    tl_bvh_top_node *node = &b->top->nodes[b->top->node_count++];
    node->box = r->subtree.range.box;
    bool moved = r->split.found && !r->split.spatial;
    for (uint32_t side = 0; side < 2; side++) {
        sides[side].link = &node->child[side];
        sides[side].sum = r->subtree.sum;
        sides[side].in_scratch = r->subtree.in_scratch != moved;
    }
    if (moved) {
        tl_box4 centroids[2] = { tl_box4_empty(), tl_box4_empty() };
        for (uint32_t i = 0; i < r->block_count; i++) {
            centroids[0] = tl_box4_union(centroids[0], b->blocks[r->first_block + i].centroids[0]);
            centroids[1] = tl_box4_union(centroids[1], b->blocks[r->first_block + i].centroids[1]);
        }
        for (uint32_t side = 0; side < 2; side++) {
            sides[side].range.box = tl_box4_to_aabb(r->split.box[side]);
            sides[side].range.centroids = tl_box4_to_aabb(centroids[side]);
        }
    }
}

static tl_result split_level(top_builder *b)
{
    tl_bvh_top *top = b->top;
    for (uint32_t i = 0; i < b->range_count; i++) {
        b->ranges[i].grid = tl_bvh_make_grid(&b->ranges[i].subtree.range);
    }
    lay_blocks(b);
    TL_TRY(tl_stage_run(b->stage, fill_block_bins, b->block_count, b, REF_BLOCK_BATCH, b->level_share / 2));
    // Without spatial splits this is too little work for tasks.
    if (b->ranges[0].subtree.range.capacity > b->ranges[0].subtree.range.count) {
        TL_TRY(tl_stage_run(b->stage, choose_range_split, b->range_count, b, 1, 0));
    } else {
        tl_run_tasks(NULL, choose_range_split, b->range_count, b);
    }
    TL_TRY(tl_stage_run(b->stage, part_block, b->block_count, b, REF_BLOCK_BATCH, b->level_share / 2));
    uint32_t next_count = 0;
    for (uint32_t i = 0; i < b->range_count; i++) {
        tl_bvh_subtree sides[2];
        end_range(b, &b->ranges[i], sides);
        for (uint32_t side = 0; side < 2; side++) {
            if (sides[side].range.count > b->part_refs) {
                b->next[next_count++] = sides[side];
            } else {
                top->subtrees[top->subtree_count++] = sides[side];
            }
        }
    }
    for (uint32_t i = 0; i < next_count; i++) {
        b->ranges[i].subtree = b->next[i];
    }
    b->range_count = next_count;
    return TL_OK;
}

static tl_result measure_all(top_builder *b, uint32_t pair_count, uint32_t capacity, tl_bvh_range *whole_out)
{
    tl_bvh_range whole = { tl_aabb_empty(), tl_aabb_empty(), 0, pair_count, capacity, 0 };
    b->ranges[0].subtree.range = whole;
    b->range_count = 1;
    lay_blocks(b);
    TL_TRY(tl_stage_run(b->stage, make_references, b->block_count, b, REF_BLOCK_BATCH, b->level_share));
    tl_box4 box = tl_box4_empty(), centroids = tl_box4_empty();
    for (uint32_t i = 0; i < b->block_count; i++) {
        box = tl_box4_union(box, b->blocks[i].centroids[0]);
        centroids = tl_box4_union(centroids, b->blocks[i].centroids[1]);
    }
    whole.box = tl_box4_to_aabb(box);
    whole.centroids = tl_box4_to_aabb(centroids);
    *whole_out = whole;
    return TL_OK;
}

static uint32_t task_size(uint32_t pair_count)
{
    return pair_count / TASK_SHARE > MIN_TASK_REFS ? pair_count / TASK_SHARE : MIN_TASK_REFS;
}

// Splits the ranges until they are small enough, or the next level could give too many subtrees.
static tl_result split_ranges(top_builder *b, uint32_t part_refs, uint32_t max_subtrees)
{
    tl_bvh_top *top = b->top;
    b->part_refs = part_refs;
    while (b->range_count > 0 && b->ranges[0].subtree.range.count > part_refs &&
           top->subtree_count + 2 * b->range_count <= max_subtrees) {
        TL_TRY(split_level(b));
    }
    for (uint32_t i = 0; i < b->range_count; i++) {
        top->subtrees[top->subtree_count++] = b->ranges[i].subtree;
    }
    b->range_count = 0;
    return TL_OK;
}

// From left to right: by where they begin. Links them.
static void sort_subtrees(tl_bvh_top *top, tl_sort_item *items, tl_sort_item *scratch, tl_bvh_subtree *sorted)
{
    for (uint32_t i = 0; i < top->subtree_count; i++) {
        tl_sort_item item = { top->subtrees[i].range.first, i, 0 };
        items[i] = item;
    }
    tl_radix_sort(items, scratch, top->subtree_count);
    for (uint32_t i = 0; i < top->subtree_count; i++) {
        sorted[i] = top->subtrees[items[i].value];
        *sorted[i].link = TL_BVH_SUBTREE + i;
    }
    top->subtrees = sorted;
}

// Takes the subtrees of the first part of the top, and the large ones as ranges of the second.
static void begin_second_part(top_builder *b, const tl_bvh_subtree *parts, tl_bvh_subtree *subtrees)
{
    const uint32_t count = b->top->subtree_count;
    b->top->subtrees = subtrees;
    b->top->subtree_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_bvh_subtree *to = parts[i].range.count > TL_BVH_SUBTREE_REFS ? &b->ranges[b->range_count++].subtree
                                                                        : &subtrees[b->top->subtree_count++];
        *to = parts[i];
        to->sum = i;
    }
}

// `sorted` has room for max_subtrees.
static tl_result build_top(top_builder *b, uint32_t pair_count, uint32_t capacity, tl_bvh_subtree *sorted,
                           tl_arena *scratch)
{
    tl_bvh_top *top = b->top;
    const uint32_t task_refs = task_size(pair_count), max_tasks = 16 * (pair_count / task_refs + 1);
    const uint32_t max_ranges = capacity / (task_refs < TL_BVH_SUBTREE_REFS ? task_refs : TL_BVH_SUBTREE_REFS) + 1;
    tl_bvh_subtree *unsorted = TL_PUSH(scratch, tl_bvh_subtree, b->max_subtrees);
    tl_sort_item *items = TL_PUSH(scratch, tl_sort_item, 2 * (uint64_t)b->max_subtrees);
    b->ranges = TL_PUSH(scratch, top_range, max_ranges);
    b->next = TL_PUSH(scratch, tl_bvh_subtree, 2 * (uint64_t)max_ranges);
    b->blocks = TL_PUSH(scratch, top_block, (uint64_t)capacity / BLOCK_REFS + max_ranges);
    if (unsorted == NULL || items == NULL || b->ranges == NULL || b->next == NULL || b->blocks == NULL) {
        return TL_ERR_MEMORY;
    }
    top->subtrees = unsorted;
    tl_bvh_subtree whole = { .link = &top->root };
    TL_TRY(measure_all(b, pair_count, capacity, &whole.range));
    top->splitter.root_half_area = tl_aabb_half_area(whole.range.box);
    b->ranges[0].subtree = whole;
    b->range_count = 1;
    TL_TRY(split_ranges(b, task_refs, max_tasks));
    sort_subtrees(top, items, items + b->max_subtrees, sorted);
    begin_second_part(b, sorted, unsorted);
    TL_TRY(split_ranges(b, TL_BVH_SUBTREE_REFS, b->max_subtrees));
    sort_subtrees(top, items, items + b->max_subtrees, sorted);
    return TL_OK;
}

// How many levels the top has where ranges are halved.
static uint32_t expected_levels(uint32_t pair_count)
{
    const uint32_t end = task_size(pair_count) < TL_BVH_SUBTREE_REFS ? task_size(pair_count) : TL_BVH_SUBTREE_REFS;
    uint32_t levels = 1;
    for (uint32_t count = pair_count; count > end; count /= 2) {
        levels++;
    }
    return levels;
}

tl_result tl_bvh_build_top(tl_bvh_top *top, uint32_t pair_count, uint32_t capacity, tl_stage *stage, tl_arena *arena)
{
    top_builder b = { .top = top, .stage = stage };
    b.max_subtrees = 16 * (pair_count / task_size(pair_count) + 1) + 16 * (pair_count / TL_BVH_SUBTREE_REFS + 1);
    b.level_share = pair_count / expected_levels(pair_count);
    tl_bvh_subtree *sorted = TL_PUSH(arena, tl_bvh_subtree, b.max_subtrees);
    top->nodes = TL_PUSH(arena, tl_bvh_top_node, b.max_subtrees);
    top->node_count = 0;
    top->subtree_count = 0;
    if (sorted == NULL || top->nodes == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_arena scratch;
    tl_arena_init(&scratch, &arena->allocator);
    tl_result result = build_top(&b, pair_count, capacity, sorted, &scratch);
    tl_arena_free(&scratch);
    return result;
}
