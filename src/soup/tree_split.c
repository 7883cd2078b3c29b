// SPDX-License-Identifier: MIT
//
// Object splits: references are sorted into bins by the middle of their boxes, and the plane between two bins with the
// least sum of surface times blocks wins.
// Source: Ingo Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007.

#include "soup/tree_split.h"

#include "base/assert.h"
#include "math/box4.h"

#include <string.h>

enum { MAX_BINS = 16 };

typedef struct object_bin {
    tl_box4 box;
    uint32_t count;
} object_bin;

// What both sides of a split, or a range, are known by.
typedef struct bounds {
    tl_box4 box, middles;
} bounds;

// Where the bins of an axis begin, and bins a metre of doubled middle; 0 where no plane parts the references.
typedef struct bin_grid {
    float base[4], scale[4];
    uint32_t count;
} bin_grid;

static inline tl_box4 box_of(const tl_tree_ref *ref)
{
    static_assert(sizeof(tl_tree_ref) == 8 * sizeof(float), "two rows of four");
    const float *row = (const float *)(const void *)ref;
    return tl_box4_load(row, row + 4);
}

static inline bounds no_bounds(void)
{
    bounds b = { tl_box4_empty(), tl_box4_empty() };
    return b;
}

static inline void grow(bounds *b, const tl_tree_ref *ref)
{
    tl_box4 box = box_of(ref);
    b->box = tl_box4_union(b->box, box);
    b->middles = tl_box4_union(b->middles, tl_box4_middle(box));
}

static inline void find_cells(const bin_grid *grid, const tl_tree_ref *ref, int32_t cells[4])
{
    tl_box4_cells(tl_box4_middle(box_of(ref)), grid->base, grid->scale, (float)(grid->count - 1), cells);
}

// Few references get few bins: the cost of a bin is paid whether it is used or not. Twice as many bins made no
// difference to rays that could be measured.
static uint32_t choose_bin_count(uint32_t count)
{
    uint32_t bins = 4 + count / 8;
    return bins < MAX_BINS ? bins : MAX_BINS;
}

static bin_grid make_grid(tl_aabb middles, uint32_t count)
{
    bin_grid grid = { .count = choose_bin_count(count) };
    for (uint32_t axis = 0; axis < 3; axis++) {
        grid.base[axis] = tl_component(middles.min, axis);
        float extent = tl_component(middles.max, axis) - grid.base[axis];
        float per_metre = (float)grid.count / extent;
        // Extents so small that the quotient overflows cannot be parted by a float either.
        grid.scale[axis] = extent > 0.0f && per_metre < INFINITY ? per_metre : 0.0f;
    }
    return grid;
}

static void evaluate_axis(const object_bin *bins, uint32_t axis, uint32_t bin_count, tl_tree_split *best)
{
    float right_cost[MAX_BINS];
    tl_box4 right_box[MAX_BINS];
    tl_box4 box = tl_box4_empty();
    uint32_t count = 0;
    for (uint32_t bin = bin_count - 1; bin > 0; bin--) {
        box = tl_box4_union(box, bins[bin].box);
        count += bins[bin].count;
        right_box[bin] = box;
        right_cost[bin] = count > 0 ? tl_aabb_half_area(tl_box4_to_aabb(box)) * tl_tree_blocks(count) : -1.0f;
    }
    box = tl_box4_empty();
    count = 0;
    for (uint32_t bin = 1; bin < bin_count; bin++) {
        box = tl_box4_union(box, bins[bin - 1].box);
        count += bins[bin - 1].count;
        // Behind an empty bin the plane is where it was.
        if (bins[bin - 1].count == 0 || right_cost[bin] < 0.0f) {
            continue;
        }
        float cost = tl_aabb_half_area(tl_box4_to_aabb(box)) * tl_tree_blocks(count) + right_cost[bin];
        if (!best->found || cost < best->cost) {
            best->found = true;
            best->axis = axis;
            best->bin = bin;
            best->cost = cost;
            tl_aabb shared = tl_aabb_intersection(tl_box4_to_aabb(box), tl_box4_to_aabb(right_box[bin]));
            best->overlap = tl_aabb_is_empty(shared) ? 0.0f : tl_aabb_half_area(shared);
        }
    }
}

tl_tree_split tl_tree_find_split(const tl_tree_splitter *splitter, const tl_tree_range *range)
{
    const tl_tree_ref *refs = splitter->refs + range->first;
    tl_tree_split best;
    memset(&best, 0, sizeof best);
    bin_grid grid = make_grid(range->middles, range->count);
    object_bin bins[3][MAX_BINS];
    for (uint32_t axis = 0; axis < 3; axis++) {
        for (uint32_t bin = 0; bin < grid.count; bin++) {
            bins[axis][bin].box = tl_box4_empty();
            bins[axis][bin].count = 0;
        }
    }
    for (uint32_t i = 0; i < range->count; i++) {
        int32_t cells[4];
        find_cells(&grid, &refs[i], cells);
        tl_box4 box = box_of(&refs[i]);
        for (uint32_t axis = 0; axis < 3; axis++) {
            object_bin *bin = &bins[axis][cells[axis]];
            bin->box = tl_box4_union(bin->box, box);
            bin->count++;
        }
    }
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (grid.scale[axis] > 0.0f) {
            evaluate_axis(bins[axis], axis, grid.count, &best);
        }
    }
    tl_tree_improve_by_spatial_split(splitter, range, &best);
    return best;
}

// References of lower bins to the front, in place; returns how many.
static uint32_t partition(tl_tree_ref *refs, uint32_t count, const bin_grid *grid, const tl_tree_split *split,
                          bounds *left, bounds *right)
{
    uint32_t low = 0, high = count;
    int32_t cells[4], first_right = (int32_t)split->bin;
    for (;;) {
        for (; low < high; low++) {
            find_cells(grid, &refs[low], cells);
            if (cells[split->axis] >= first_right) {
                break;
            }
            grow(left, &refs[low]);
        }
        for (; low < high; high--) {
            find_cells(grid, &refs[high - 1], cells);
            if (cells[split->axis] < first_right) {
                break;
            }
            grow(right, &refs[high - 1]);
        }
        if (low >= high) {
            return low;
        }
        tl_tree_ref swap = refs[low];
        refs[low] = refs[high - 1];
        refs[high - 1] = swap;
    }
}

static bounds measure(const tl_tree_ref *refs, uint32_t count)
{
    bounds b = no_bounds();
    for (uint32_t i = 0; i < count; i++) {
        grow(&b, &refs[i]);
    }
    return b;
}

static tl_tree_range make_range(const bounds *b, uint32_t first, uint32_t count, uint32_t capacity, uint32_t depth)
{
    tl_tree_range range = { tl_box4_to_aabb(b->box), tl_box4_to_aabb(b->middles), first, count, capacity, depth };
    return range;
}

tl_tree_range tl_tree_measure_range(const tl_tree_ref *refs, uint32_t first, uint32_t count, uint32_t capacity,
                                    uint32_t depth)
{
    bounds b = measure(refs + first, count);
    return make_range(&b, first, count, capacity, depth);
}

void tl_tree_apply_split(const tl_tree_splitter *splitter, const tl_tree_range *range, const tl_tree_split *split,
                         tl_tree_range *left_out, tl_tree_range *right_out)
{
    tl_tree_ref *refs = splitter->refs + range->first;
    uint32_t left_count, right_count;
    bounds left = no_bounds(), right = no_bounds();
    if (split->found && !split->spatial) {
        bin_grid grid = make_grid(range->middles, range->count);
        left_count = partition(refs, range->count, &grid, split, &left, &right);
        right_count = range->count - left_count;
    } else {
        if (!split->spatial || !tl_tree_apply_spatial_split(splitter, range, split, &left_count, &right_count)) {
            left_count = range->count / 2;
            right_count = range->count - left_count;
        }
        left = measure(refs, left_count);
        right = measure(refs + left_count, right_count);
    }
    TL_ASSERT(left_count > 0 && right_count > 0 && left_count + right_count <= range->capacity);
    uint32_t count = left_count + right_count;
    uint64_t spare = range->capacity - count;
    uint32_t left_capacity = left_count + (uint32_t)(spare * left_count / count);
    if (left_capacity > left_count) {
        memmove(refs + left_capacity, refs + left_count, (size_t)right_count * sizeof *refs);
    }
    *left_out = make_range(&left, range->first, left_count, left_capacity, range->depth + 1);
    *right_out = make_range(&right, range->first + left_capacity, right_count, range->capacity - left_capacity,
                            range->depth + 1);
}
