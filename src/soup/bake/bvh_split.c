// SPDX-License-Identifier: MIT
//
// Object splits: references are sorted into bins by the centroids of their boxes, and the plane between two bins with
// the least surface area heuristic wins: the sum over both sides of surface times blocks of four.
// Source: Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007.

#include "soup/bake/bvh_split.h"

#include "base/assert.h"

#include <string.h>

static inline tl_box4 box_of_ref(const tl_bvh_ref *ref)
{
    static_assert(sizeof(tl_bvh_ref) == 8 * sizeof(float), "two rows of four");
    const float *row = (const float *)(const void *)ref;
    return tl_box4_load(row, row + 4);
}

static inline void find_cells(const tl_bvh_grid *grid, tl_box4 box, int32_t cells[4])
{
    tl_box4_cells(tl_box4_middle(box), grid->base, grid->scale, (float)(grid->count - 1), cells);
}

// Few references get few bins: a bin costs time whether it is used or not. Twice as many bins made no measurable
// difference to rays.
static uint32_t choose_bin_count(uint32_t count)
{
    uint32_t bins = 4 + count / 8;
    return bins < TL_BVH_BINS ? bins : TL_BVH_BINS;
}

tl_bvh_grid tl_bvh_make_grid(const tl_bvh_range *range)
{
    tl_bvh_grid grid = { .count = choose_bin_count(range->count) };
    for (uint32_t axis = 0; axis < 3; axis++) {
        grid.base[axis] = tl_component(range->centroids.min, axis);
        float extent = tl_component(range->centroids.max, axis) - grid.base[axis];
        float per_metre = (float)grid.count / extent;
        // Where the quotient overflows, no float lies between the centroids either.
        grid.scale[axis] = extent > 0.0f && per_metre < INFINITY ? per_metre : 0.0f;
    }
    return grid;
}

void tl_bvh_fill_bins(const tl_bvh_ref *refs, uint32_t count, const tl_bvh_grid *grid, tl_bvh_bins *bins_out)
{
    tl_box4 empty = tl_box4_empty();
    for (uint32_t axis = 0; axis < 3; axis++) {
        for (uint32_t bin = 0; bin < grid->count; bin++) {
            bins_out->bin[axis][bin].box = empty;
            bins_out->bin[axis][bin].count = 0;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        int32_t cells[4];
        tl_box4 box = box_of_ref(&refs[i]);
        find_cells(grid, box, cells);
        for (uint32_t axis = 0; axis < 3; axis++) {
            tl_box4 *bin_box = &bins_out->bin[axis][cells[axis]].box;
            *bin_box = tl_box4_union(*bin_box, box);
            bins_out->bin[axis][cells[axis]].count++;
        }
    }
}

void tl_bvh_add_bins(const tl_bvh_bins *part, const tl_bvh_grid *grid, tl_bvh_bins *sum)
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        for (uint32_t bin = 0; bin < grid->count; bin++) {
            sum->bin[axis][bin].box = tl_box4_union(sum->bin[axis][bin].box, part->bin[axis][bin].box);
            sum->bin[axis][bin].count += part->bin[axis][bin].count;
        }
    }
}

uint32_t tl_bvh_count_left(const tl_bvh_bins *bins, const tl_bvh_split *split)
{
    uint32_t count = 0;
    for (uint32_t bin = 0; bin < split->bin; bin++) {
        count += bins->bin[split->axis][bin].count;
    }
    return count;
}

static void choose_along(const tl_bvh_bins *bins, uint32_t axis, uint32_t bin_count, tl_bvh_split *best)
{
    float right_cost[TL_BVH_BINS];
    tl_box4 right_box[TL_BVH_BINS];
    tl_box4 box = tl_box4_empty();
    uint32_t count = 0;
    for (uint32_t bin = bin_count - 1; bin > 0; bin--) {
        box = tl_box4_union(box, bins->bin[axis][bin].box);
        count += bins->bin[axis][bin].count;
        right_box[bin] = box;
        right_cost[bin] = count > 0 ? tl_box4_half_area(box) * tl_bvh_blocks(count) : -1.0f;
    }
    box = tl_box4_empty();
    count = 0;
    for (uint32_t bin = 1; bin < bin_count; bin++) {
        box = tl_box4_union(box, bins->bin[axis][bin - 1].box);
        count += bins->bin[axis][bin - 1].count;
        // Behind an empty bin the split is the one before.
        if (bins->bin[axis][bin - 1].count == 0 || right_cost[bin] < 0.0f) {
            continue;
        }
        float cost = tl_box4_half_area(box) * tl_bvh_blocks(count) + right_cost[bin];
        if (!best->found || cost < best->cost) {
            best->found = true;
            best->axis = axis;
            best->bin = bin;
            best->cost = cost;
            best->box[0] = box;
            best->box[1] = right_box[bin];
        }
    }
}

tl_bvh_split tl_bvh_choose_plane(const tl_bvh_bins *bins, const tl_bvh_grid *grid)
{
    tl_bvh_split best;
    best.found = false;
    best.spatial = false;
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (grid->scale[axis] > 0.0f) {
            choose_along(bins, axis, grid->count, &best);
        }
    }
    return best;
}

tl_bvh_split tl_bvh_find_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range)
{
    tl_bvh_grid grid = tl_bvh_make_grid(range);
    tl_bvh_bins bins;
    tl_bvh_fill_bins(splitter->refs + range->first, range->count, &grid, &bins);
    tl_bvh_split best = tl_bvh_choose_plane(&bins, &grid);
    tl_bvh_improve_by_spatial_split(splitter, range, &best);
    return best;
}

// Without branches, since the side is unpredictable. References keep their order within a side, and so their locality
// in memory.
uint32_t tl_bvh_divide(const tl_bvh_ref *refs, uint32_t count, const tl_bvh_grid *grid, const tl_bvh_split *split,
                       tl_bvh_ref *left, tl_bvh_ref *right, tl_box4 centroids[2])
{
    tl_bvh_ref *next[2] = { left, right };
    for (uint32_t i = 0; i < count; i++) {
        tl_bvh_ref ref = refs[i];
        tl_box4 box = box_of_ref(&ref);
        int32_t cells[4];
        find_cells(grid, box, cells);
        uint32_t side = (uint32_t)(cells[split->axis] >= (int32_t)split->bin);
        *next[side]++ = ref;
        centroids[side] = tl_box4_union(centroids[side], tl_box4_middle(box));
    }
    return (uint32_t)(next[0] - left);
}

tl_bvh_range tl_bvh_measure_range(const tl_bvh_ref *refs, uint32_t first, uint32_t count, uint32_t capacity,
                                  uint32_t depth)
{
    tl_box4 box = tl_box4_empty(), centroids = tl_box4_empty();
    for (uint32_t i = 0; i < count; i++) {
        tl_box4 of_ref = box_of_ref(&refs[first + i]);
        box = tl_box4_union(box, of_ref);
        centroids = tl_box4_union(centroids, tl_box4_middle(of_ref));
    }
    tl_bvh_range range = { tl_box4_to_aabb(box), tl_box4_to_aabb(centroids), first, count, capacity, depth };
    return range;
}

void tl_bvh_share_range(const tl_bvh_range *range, uint32_t left_count, uint32_t right_count, tl_bvh_range *left_out,
                        tl_bvh_range *right_out)
{
    uint32_t count = left_count + right_count;
    TL_ASSERT(left_count > 0 && right_count > 0 && count <= range->capacity);
    uint64_t spare = range->capacity - count;
    uint32_t left_capacity = left_count + (uint32_t)(spare * left_count / count);
    *left_out =
        (tl_bvh_range){ tl_aabb_empty(), tl_aabb_empty(), range->first, left_count, left_capacity, range->depth + 1 };
    *right_out = (tl_bvh_range){
        tl_aabb_empty(), tl_aabb_empty(), range->first + left_capacity, right_count, range->capacity - left_capacity,
        range->depth + 1
    };
}

void tl_bvh_apply_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, const tl_bvh_split *split,
                        tl_bvh_range *left_out, tl_bvh_range *right_out)
{
    tl_bvh_ref *refs = splitter->refs + range->first;
    if (split->found && !split->spatial) {
        tl_bvh_ref *right = splitter->scratch + range->first;
        tl_bvh_grid grid = tl_bvh_make_grid(range);
        tl_box4 centroids[2] = { tl_box4_empty(), tl_box4_empty() };
        uint32_t left_count = tl_bvh_divide(refs, range->count, &grid, split, refs, right, centroids);
        tl_bvh_share_range(range, left_count, range->count - left_count, left_out, right_out);
        memcpy(splitter->refs + right_out->first, right, (size_t)right_out->count * sizeof *refs);
        left_out->box = tl_box4_to_aabb(split->box[0]);
        left_out->centroids = tl_box4_to_aabb(centroids[0]);
        right_out->box = tl_box4_to_aabb(split->box[1]);
        right_out->centroids = tl_box4_to_aabb(centroids[1]);
        return;
    }
    uint32_t left_count, right_count;
    if (!split->found || !tl_bvh_apply_spatial_split(splitter, range, split, &left_count, &right_count)) {
        left_count = range->count / 2;
        right_count = range->count - left_count;
    }
    tl_bvh_share_range(range, left_count, right_count, left_out, right_out);
    memmove(splitter->refs + right_out->first, refs + left_count, (size_t)right_count * sizeof *refs);
    *left_out = tl_bvh_measure_range(splitter->refs, range->first, left_count, left_out->capacity, range->depth + 1);
    *right_out =
        tl_bvh_measure_range(splitter->refs, right_out->first, right_count, right_out->capacity, range->depth + 1);
}
