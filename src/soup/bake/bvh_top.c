// SPDX-License-Identifier: MIT
//
// The top of the binary BVH, built in parallel within a range. Few ranges are large there, so tasks take blocks of
// their references: each block fills bins of its own, which add up in any order; the chosen plane tells from a block's
// bins how many of its references go left, so every block knows where to write before any of them does. References move
// between two arrays, one pass a level. All ranges of a level are split together, so that there are few parallel loops.
//
// A range that a spatial split clips, or that is halved, is one task: such ranges are rare, or nearly done.

#include "soup/bake/bvh_top.h"

#include "base/host.h"
#include "base/radix_sort.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

static_assert(TL_BVH_HEURISTIC_DEPTH + 32 <= TL_SOUP_MAX_DEPTH,
              "a range of 2^32 references ends within the depth limit");

// The top ends where a range is a 64th of the whole.
enum { TASK_SHARE = 64, MIN_TASK_REFS = 1024 };

// Spatial splits may double the references.
enum { MAX_LEVEL_RANGES = 2 * TASK_SHARE };

enum { BLOCK_REFS = 4096 };

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
    top_range *ranges;
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
    uint32_t index = tl_bvh_split_index(r->right.first);
    tl_bvh_node *node = &b->top->nodes[index];
    memset(node, 0, sizeof *node);
    node->box = r->subtree.range.box;
    *r->subtree.link = index;
    sides[0].link = &node->left;
    sides[1].link = &node->right;
    bool moved = r->split.found && !r->split.spatial;
    for (uint32_t side = 0; side < 2; side++) {
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

static void split_level(top_builder *b, uint32_t task_refs, const tl_host *host)
{
    tl_bvh_top *top = b->top;
    for (uint32_t i = 0; i < b->range_count; i++) {
        b->ranges[i].grid = tl_bvh_make_grid(&b->ranges[i].subtree.range);
    }
    lay_blocks(b);
    tl_run_tasks(host, fill_block_bins, b->block_count, b);
    // Without spatial splits this is too little work for tasks.
    tl_run_tasks(b->ranges[0].subtree.range.capacity > b->ranges[0].subtree.range.count ? host : NULL,
                 choose_range_split, b->range_count, b);
    tl_run_tasks(host, part_block, b->block_count, b);
    tl_bvh_subtree next[MAX_LEVEL_RANGES];
    uint32_t next_count = 0;
    for (uint32_t i = 0; i < b->range_count; i++) {
        tl_bvh_subtree sides[2];
        end_range(b, &b->ranges[i], sides);
        for (uint32_t side = 0; side < 2; side++) {
            if (sides[side].range.count > task_refs) {
                next[next_count++] = sides[side];
            } else {
                top->subtrees[top->subtree_count++] = sides[side];
            }
        }
    }
    for (uint32_t i = 0; i < next_count; i++) {
        b->ranges[i].subtree = next[i];
    }
    b->range_count = next_count;
}

static tl_bvh_range measure_all(top_builder *b, uint32_t pair_count, uint32_t capacity, const tl_host *host)
{
    tl_bvh_range whole = { tl_aabb_empty(), tl_aabb_empty(), 0, pair_count, capacity, 0 };
    b->ranges[0].subtree.range = whole;
    b->range_count = 1;
    lay_blocks(b);
    tl_run_tasks(host, make_references, b->block_count, b);
    tl_box4 box = tl_box4_empty(), centroids = tl_box4_empty();
    for (uint32_t i = 0; i < b->block_count; i++) {
        box = tl_box4_union(box, b->blocks[i].centroids[0]);
        centroids = tl_box4_union(centroids, b->blocks[i].centroids[1]);
    }
    whole.box = tl_box4_to_aabb(box);
    whole.centroids = tl_box4_to_aabb(centroids);
    return whole;
}

static uint32_t task_size(uint32_t pair_count)
{
    return pair_count / TASK_SHARE > MIN_TASK_REFS ? pair_count / TASK_SHARE : MIN_TASK_REFS;
}

// From left to right: by where they begin.
static void sort_subtrees(tl_bvh_top *top, tl_sort_item *items, tl_sort_item *scratch, tl_bvh_subtree *sorted)
{
    for (uint32_t i = 0; i < top->subtree_count; i++) {
        tl_sort_item item = { top->subtrees[i].range.first, i, 0 };
        items[i] = item;
    }
    tl_radix_sort(items, scratch, top->subtree_count);
    for (uint32_t i = 0; i < top->subtree_count; i++) {
        sorted[i] = top->subtrees[items[i].value];
    }
    top->subtrees = sorted;
}

uint32_t tl_bvh_max_subtrees(uint32_t pair_count)
{
    return 16 * (pair_count / task_size(pair_count) + 1);
}

tl_result tl_bvh_build_top(tl_bvh_top *top, uint32_t pair_count, uint32_t capacity, const tl_host *host,
                           tl_arena *arena)
{
    uint32_t task_refs = task_size(pair_count), max_subtrees = tl_bvh_max_subtrees(pair_count);
    uint32_t max_ranges = capacity / task_refs + 1;
    top_builder b = { .top = top };
    tl_bvh_subtree *sorted = TL_PUSH(arena, tl_bvh_subtree, max_subtrees);
    tl_arena_mark mark = tl_arena_get_mark(arena);
    top->subtrees = TL_PUSH(arena, tl_bvh_subtree, max_subtrees);
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, 2 * max_subtrees);
    b.ranges = TL_PUSH(arena, top_range, max_ranges);
    b.blocks = TL_PUSH(arena, top_block, (uint64_t)capacity / BLOCK_REFS + max_ranges);
    if (sorted == NULL || top->subtrees == NULL || items == NULL || b.ranges == NULL || b.blocks == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_bvh_subtree whole = { measure_all(&b, pair_count, capacity, host), &top->root, false };
    top->splitter.root_half_area = tl_aabb_half_area(whole.range.box);
    top->subtree_count = 0;
    b.ranges[0].subtree = whole;
    b.range_count = 1;
    // Ends early when the next level could give too many subtrees.
    while (b.range_count > 0 && b.ranges[0].subtree.range.count > task_refs &&
           top->subtree_count + 2 * b.range_count <= max_subtrees) {
        split_level(&b, task_refs, host);
    }
    for (uint32_t i = 0; i < b.range_count; i++) {
        top->subtrees[top->subtree_count++] = b.ranges[i].subtree;
    }
    sort_subtrees(top, items, items + max_subtrees, sorted);
    tl_arena_rollback(arena, mark);
    return TL_OK;
}
