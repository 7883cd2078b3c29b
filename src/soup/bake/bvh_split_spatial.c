// SPDX-License-Identifier: MIT
//
// Spatial splits (SBVH): a plane clips the references that straddle it, and each side keeps the box of its own part. A
// large floor beside many small props then no longer widens every box around it.
//
// A part's box must hold the whole part: crossings are computed in double and rounded outward by an ulp of float.
//
// Source: Stich, Friedrich, Dietrich, Spatial Splits in Bounding Volume Hierarchies, 2009.

#include "soup/bake/bvh_split.h"

#include <float.h>
#include <string.h>

// Twice as many bins found no better planes.
enum { SPATIAL_BINS = 8 };

// Where the children of an object split overlap by less than this share of the root, or references are few, clipping
// gains little. With this instead of 1e-5, and any number, rays visited as many nodes, and a bake took a third of the
// time.
#define WORTHWHILE_OVERLAP 8e-3f
enum { MIN_SPATIAL_REFS = 32 };

// Below this depth references are only sorted.
enum { MAX_SPATIAL_DEPTH = 40 };

// Bins of one axis, and the space of each.
typedef struct spatial_bins {
    tl_box4 slab[SPATIAL_BINS];
    tl_box4 box[SPATIAL_BINS];
    uint32_t begin[SPATIAL_BINS]; // references whose first bin this is
    uint32_t end[SPATIAL_BINS];   // references whose last bin this is
    float base, width;            // width 0: no bins along this axis
} spatial_bins;

static inline float bound_below(double value)
{
    float f = (float)value;
    return f - fabsf(f) * FLT_EPSILON - FLT_MIN;
}

static inline float bound_above(double value)
{
    float f = (float)value;
    return f + fabsf(f) * FLT_EPSILON + FLT_MIN;
}

// The box of the point at which an edge crosses the plane.
static tl_aabb crossing_box(tl_vec3 a, tl_vec3 b, uint32_t axis, float position)
{
    double from = (double)tl_component(a, axis);
    double t = ((double)position - from) / ((double)tl_component(b, axis) - from);
    double x = (double)a.x + ((double)b.x - (double)a.x) * t;
    double y = (double)a.y + ((double)b.y - (double)a.y) * t;
    double z = (double)a.z + ((double)b.z - (double)a.z) * t;
    tl_aabb box = { tl_vec3_make(bound_below(x), bound_below(y), bound_below(z)),
                    tl_vec3_make(bound_above(x), bound_above(y), bound_above(z)) };
    return box;
}

void tl_bvh_clip_reference(const tl_bvh_splitter *splitter, const tl_bvh_ref *ref, uint32_t axis, float position,
                           tl_aabb *left_out, tl_aabb *right_out)
{
    // The pair's edges: around a, b, c, d, and the diagonal a, c. A single has d == a, whose edges repeat.
    static const uint8_t edges[5][2] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 2 } };
    const tl_triangle_pair *pair = &splitter->pairs[ref->pair];
    tl_vec3 corner[4];
    tl_aabb left = tl_aabb_empty(), right = tl_aabb_empty();
    for (uint32_t k = 0; k < 4; k++) {
        corner[k] = splitter->mesh->vertices[pair->corner[k]];
        float place = tl_component(corner[k], axis);
        if (place <= position) {
            left = tl_aabb_add_point(left, corner[k]);
        }
        if (place >= position) {
            right = tl_aabb_add_point(right, corner[k]);
        }
    }
    for (uint32_t i = 0; i < 5; i++) {
        tl_vec3 a = corner[edges[i][0]], b = corner[edges[i][1]];
        float from = tl_component(a, axis), to = tl_component(b, axis);
        if ((from < position && to > position) || (from > position && to < position)) {
            tl_aabb box = crossing_box(a, b, axis, position);
            left = tl_aabb_union(left, box);
            right = tl_aabb_union(right, box);
        }
    }
    tl_aabb whole = { ref->min, ref->max };
    tl_set_component(&left.max, axis, tl_minf(tl_component(left.max, axis), position));
    tl_set_component(&right.min, axis, tl_maxf(tl_component(right.min, axis), position));
    *left_out = tl_aabb_intersection(left, whole);
    *right_out = tl_aabb_intersection(right, whole);
}

static inline float plane_at(float base, float width, uint32_t bin)
{
    return base + width * (float)bin;
}

static void begin_bins(const tl_bvh_range *range, uint32_t axis, spatial_bins *bins)
{
    bins->base = tl_component(range->box.min, axis);
    bins->width = (tl_component(range->box.max, axis) - bins->base) / (float)SPATIAL_BINS;
    // Bins must be wider than the rounding of their planes.
    if (!(bins->width > 4.0f * FLT_EPSILON * fabsf(bins->base) && bins->width > FLT_MIN &&
          1.0f / bins->width < FLT_MAX)) {
        bins->width = 0.0f;
        return;
    }
    for (uint32_t bin = 0; bin < SPATIAL_BINS; bin++) {
        tl_aabb slab = range->box;
        tl_set_component(&slab.min, axis, plane_at(bins->base, bins->width, bin));
        tl_set_component(&slab.max, axis, plane_at(bins->base, bins->width, bin + 1));
        bins->slab[bin] = tl_box4_of(slab);
        bins->box[bin] = tl_box4_empty();
        bins->begin[bin] = 0;
        bins->end[bin] = 0;
    }
}

// The boxes of references are cut by the planes, not the triangles: that finds the same planes, in a quarter of the
// time. The triangles are clipped where a plane is applied.
static void fill_spatial_bins(const tl_bvh_splitter *splitter, const tl_bvh_range *range, spatial_bins bins[3])
{
    float base[4] = { 0 }, per_metre[4] = { 0 };
    for (uint32_t axis = 0; axis < 3; axis++) {
        begin_bins(range, axis, &bins[axis]);
        base[axis] = bins[axis].base;
        per_metre[axis] = bins[axis].width > 0.0f ? 1.0f / bins[axis].width : 0.0f;
    }
    for (uint32_t i = 0; i < range->count; i++) {
        const float *row = (const float *)(const void *)&splitter->refs[range->first + i];
        tl_box4 box = tl_box4_load(row, row + 4);
        int32_t first[4], last[4];
        tl_box4_cells(box, base, per_metre, (float)(SPATIAL_BINS - 1), first);
        tl_box4_cells(tl_box4_load(row + 4, row + 4), base, per_metre, (float)(SPATIAL_BINS - 1), last);
        for (uint32_t axis = 0; axis < 3; axis++) {
            spatial_bins *along = &bins[axis];
            along->begin[first[axis]]++;
            along->end[last[axis]]++;
            if (first[axis] == last[axis]) {
                along->box[first[axis]] = tl_box4_union(along->box[first[axis]], box);
                continue;
            }
            for (int32_t bin = first[axis]; bin <= last[axis]; bin++) {
                tl_box4 part = tl_box4_intersection(box, along->slab[bin]);
                along->box[bin] = tl_box4_union(along->box[bin], part);
            }
        }
    }
}

static float side_cost(tl_box4 box, uint32_t count)
{
    return count > 0 ? tl_box4_half_area(box) * tl_bvh_blocks(count) : 0.0f;
}

// Costs of all planes between bins; the cheapest that fits the spare capacity goes to `best`.
static void evaluate_bins(const spatial_bins *bins, const tl_bvh_range *range, uint32_t axis, tl_bvh_split *best)
{
    float right_cost[SPATIAL_BINS];
    uint32_t right_count[SPATIAL_BINS];
    tl_box4 box = tl_box4_empty();
    uint32_t count = 0;
    for (uint32_t bin = SPATIAL_BINS - 1; bin > 0; bin--) {
        box = tl_box4_union(box, bins->box[bin]);
        count += bins->end[bin];
        right_cost[bin] = side_cost(box, count);
        right_count[bin] = count;
    }
    box = tl_box4_empty();
    count = 0;
    for (uint32_t bin = 1; bin < SPATIAL_BINS; bin++) {
        box = tl_box4_union(box, bins->box[bin - 1]);
        count += bins->begin[bin - 1];
        float cost = side_cost(box, count) + right_cost[bin];
        bool parts = count > 0 && right_count[bin] > 0 && count < range->count && right_count[bin] < range->count;
        if (parts && count + right_count[bin] <= range->capacity && cost < best->cost) {
            best->spatial = true;
            best->axis = axis;
            best->position = plane_at(bins->base, bins->width, bin);
            best->cost = cost;
        }
    }
}

void tl_bvh_improve_by_spatial_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, tl_bvh_split *split)
{
    if (!split->found || range->capacity == range->count || range->count < MIN_SPATIAL_REFS ||
        range->depth > MAX_SPATIAL_DEPTH) {
        return;
    }
    tl_aabb shared = tl_aabb_intersection(tl_box4_to_aabb(split->box[0]), tl_box4_to_aabb(split->box[1]));
    float overlap = tl_aabb_is_empty(shared) ? 0.0f : tl_aabb_half_area(shared);
    if (overlap <= splitter->root_half_area * WORTHWHILE_OVERLAP) {
        return;
    }
    spatial_bins bins[3];
    fill_spatial_bins(splitter, range, bins);
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (bins[axis].width > 0.0f) {
            evaluate_bins(&bins[axis], range, axis, split);
        }
    }
}

// Which parts a reference has: bit 0 left, bit 1 right.
static uint32_t parts_of(const tl_bvh_splitter *splitter, const tl_bvh_ref *ref, const tl_bvh_split *split,
                         tl_aabb *left, tl_aabb *right)
{
    tl_aabb whole = { ref->min, ref->max };
    *left = whole;
    *right = whole;
    if (tl_component(ref->max, split->axis) <= split->position) {
        return 1;
    }
    if (tl_component(ref->min, split->axis) >= split->position) {
        return 2;
    }
    tl_bvh_clip_reference(splitter, ref, split->axis, split->position, left, right);
    return (tl_aabb_is_empty(*left) ? 0u : 1u) | (tl_aabb_is_empty(*right) ? 0u : 2u);
}

static void swap_refs(tl_bvh_ref *a, tl_bvh_ref *b)
{
    tl_bvh_ref swap = *a;
    *a = *b;
    *b = swap;
}

bool tl_bvh_apply_spatial_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, const tl_bvh_split *split,
                                uint32_t *left_count_out, uint32_t *right_count_out)
{
    tl_bvh_ref *refs = splitter->refs + range->first;
    tl_aabb left, right;
    uint32_t whole_left = 0, cut = 0;
    for (uint32_t i = 0; i < range->count; i++) {
        uint32_t parts = parts_of(splitter, &refs[i], split, &left, &right);
        whole_left += parts == 1;
        cut += parts == 3;
    }
    uint32_t left_count = whole_left + cut;
    uint32_t right_count = range->count - whole_left;
    // The bins only estimated these counts; a split that does not separate the references would not end.
    if (left_count == 0 || right_count == 0 || left_count >= range->count || right_count >= range->count ||
        left_count + right_count > range->capacity) {
        return false;
    }
    // Left ones to the front, right ones to the back, those to be clipped between them.
    uint32_t low = 0, high = range->count;
    for (uint32_t i = 0; i < high;) {
        uint32_t parts = parts_of(splitter, &refs[i], split, &left, &right);
        if (parts == 1) {
            swap_refs(&refs[i++], &refs[low++]);
        } else if (parts == 2) {
            swap_refs(&refs[i], &refs[--high]);
        } else {
            i++;
        }
    }
    memmove(refs + high + cut, refs + high, (size_t)(range->count - high) * sizeof *refs);
    for (uint32_t i = 0; i < cut; i++) {
        tl_bvh_ref ref = refs[low + i];
        (void)parts_of(splitter, &ref, split, &left, &right);
        tl_bvh_ref left_part = { left.min, ref.pair, left.max, 0 };
        tl_bvh_ref right_part = { right.min, ref.pair, right.max, 0 };
        refs[low + i] = left_part;
        refs[low + cut + i] = right_part;
    }
    *left_count_out = left_count;
    *right_count_out = right_count;
    return true;
}
