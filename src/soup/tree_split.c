// SPDX-License-Identifier: MIT
//
// Object splits: references are sorted into bins by the middle of their boxes, and the plane between two bins with the
// least sum of surface times blocks wins.
// Source: Ingo Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007.

#include "soup/tree_split.h"

#include "base/assert.h"

#include <string.h>

enum { MAX_BINS = 32 };

typedef struct object_bins {
    tl_aabb box[3][MAX_BINS];
    uint32_t count[3][MAX_BINS];
} object_bins;

// Doubled middle of a box: the factor of two is the same for all.
static inline float middle(const tl_tree_ref *ref, uint32_t axis)
{
    return tl_component(ref->min, axis) + tl_component(ref->max, axis);
}

static inline uint32_t bin_of(const tl_tree_ref *ref, uint32_t axis, float base, float scale, uint32_t bin_count)
{
    float place = (middle(ref, axis) - base) * scale;
    uint32_t bin = place > 0.0f ? (uint32_t)place : 0;
    return bin < bin_count ? bin : bin_count - 1;
}

static inline void grow(tl_aabb *box, const tl_tree_ref *ref)
{
    box->min = tl_min(box->min, ref->min);
    box->max = tl_max(box->max, ref->max);
}

static tl_aabb middle_bounds(const tl_tree_ref *refs, uint32_t count)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        bounds = tl_aabb_add_point(bounds, tl_add(refs[i].min, refs[i].max));
    }
    return bounds;
}

// Few references get few bins: the cost of a bin is paid whether it is used or not.
static uint32_t choose_bin_count(uint32_t count)
{
    uint32_t bins = 4 + count / 4;
    return bins < MAX_BINS ? bins : MAX_BINS;
}

static void evaluate_axis(const tl_aabb *boxes, const uint32_t *counts, uint32_t axis, uint32_t bin_count,
                          tl_tree_split *best)
{
    float right_cost[MAX_BINS];
    tl_aabb right_box[MAX_BINS];
    tl_aabb box = tl_aabb_empty();
    uint32_t count = 0;
    for (uint32_t bin = bin_count - 1; bin > 0; bin--) {
        if (counts[bin] > 0) {
            box = tl_aabb_union(box, boxes[bin]);
            count += counts[bin];
        }
        right_box[bin] = box;
        right_cost[bin] = count > 0 ? tl_aabb_half_area(box) * tl_tree_blocks(count) : -1.0f;
    }
    box = tl_aabb_empty();
    count = 0;
    for (uint32_t bin = 1; bin < bin_count; bin++) {
        if (counts[bin - 1] > 0) {
            box = tl_aabb_union(box, boxes[bin - 1]);
            count += counts[bin - 1];
        }
        if (count == 0 || right_cost[bin] < 0.0f) {
            continue;
        }
        float cost = tl_aabb_half_area(box) * tl_tree_blocks(count) + right_cost[bin];
        if (!best->found || cost < best->cost) {
            best->found = true;
            best->axis = axis;
            best->bin = bin;
            best->cost = cost;
            tl_aabb shared = tl_aabb_intersection(box, right_box[bin]);
            best->overlap = tl_aabb_is_empty(shared) ? 0.0f : tl_aabb_half_area(shared);
        }
    }
}

tl_tree_split tl_tree_find_split(const tl_tree_splitter *splitter, const tl_tree_range *range)
{
    const tl_tree_ref *refs = splitter->refs + range->first;
    tl_tree_split best;
    memset(&best, 0, sizeof best);
    best.bin_count = choose_bin_count(range->count);
    tl_aabb middles = middle_bounds(refs, range->count);
    float base[3], scale[3];
    object_bins bins;
    for (uint32_t axis = 0; axis < 3; axis++) {
        base[axis] = tl_component(middles.min, axis);
        float extent = tl_component(middles.max, axis) - base[axis];
        float per_metre = (float)best.bin_count / extent;
        // Extents so small that the quotient overflows cannot be parted by a float either.
        scale[axis] = extent > 0.0f && per_metre < INFINITY ? per_metre : 0.0f;
        for (uint32_t bin = 0; bin < best.bin_count; bin++) {
            bins.box[axis][bin] = tl_aabb_empty();
            bins.count[axis][bin] = 0;
        }
    }
    for (uint32_t i = 0; i < range->count; i++) {
        for (uint32_t axis = 0; axis < 3; axis++) {
            uint32_t bin = bin_of(&refs[i], axis, base[axis], scale[axis], best.bin_count);
            grow(&bins.box[axis][bin], &refs[i]);
            bins.count[axis][bin]++;
        }
    }
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (scale[axis] > 0.0f) {
            evaluate_axis(bins.box[axis], bins.count[axis], axis, best.bin_count, &best);
        }
    }
    best.base = base[best.axis];
    best.scale = scale[best.axis];
    tl_tree_improve_by_spatial_split(splitter, range, &best);
    return best;
}

static bool goes_left(const tl_tree_ref *ref, const tl_tree_split *split)
{
    return bin_of(ref, split->axis, split->base, split->scale, split->bin_count) < split->bin;
}

// References that belong left to the front, in place; returns how many.
static uint32_t partition(tl_tree_ref *refs, uint32_t count, const tl_tree_split *split)
{
    uint32_t low = 0;
    uint32_t high = count;
    for (;;) {
        while (low < high && goes_left(&refs[low], split)) {
            low++;
        }
        while (low < high && !goes_left(&refs[high - 1], split)) {
            high--;
        }
        if (low >= high) {
            return low;
        }
        tl_tree_ref swap = refs[low];
        refs[low] = refs[high - 1];
        refs[high - 1] = swap;
    }
}

static tl_aabb box_of(const tl_tree_ref *refs, uint32_t count)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        grow(&box, &refs[i]);
    }
    return box;
}

void tl_tree_apply_split(const tl_tree_splitter *splitter, const tl_tree_range *range, const tl_tree_split *split,
                         tl_tree_range *left_out, tl_tree_range *right_out)
{
    tl_tree_ref *refs = splitter->refs + range->first;
    uint32_t left_count, right_count;
    if (!split->spatial || !tl_tree_apply_spatial_split(splitter, range, split, &left_count, &right_count)) {
        left_count = split->found && !split->spatial ? partition(refs, range->count, split) : range->count / 2;
        right_count = range->count - left_count;
    }
    TL_ASSERT(left_count > 0 && right_count > 0 && left_count + right_count <= range->capacity);
    uint32_t count = left_count + right_count;
    uint64_t spare = range->capacity - count;
    uint32_t left_capacity = left_count + (uint32_t)(spare * left_count / count);
    if (left_capacity > left_count) {
        memmove(refs + left_capacity, refs + left_count, (size_t)right_count * sizeof *refs);
    }
    tl_tree_range left = { box_of(refs, left_count), range->first, left_count, left_capacity, range->depth + 1 };
    tl_tree_range right = { box_of(refs + left_capacity, right_count), range->first + left_capacity, right_count,
                            range->capacity - left_capacity, range->depth + 1 };
    *left_out = left;
    *right_out = right;
}
