// SPDX-License-Identifier: MIT
//
// The BVH over a tile's polygons: median split on the axis along which the centres extend most.
//
// Nodes stand depth-first with the index behind each subtree, so a range query is one loop without a stack, and an
// ordered query still finds both children. The median bounds the depth by log2 of the polygons, so that queries can
// hold their stack in an array; the surface-area heuristic was rejected, because floors are flat and alike in size.
// Which polygons stand where is decided by their boxes as floats; boxes of nodes have 16 bits a side, outward.

#include "nav_format/box_tree.h"

#include "base/assert.h"
#include "base/radix_sort.h"

#include <string.h>

tl_aabb tl_nav_polygon_box(const tl_nav_tile *tile, uint32_t polygon)
{
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon); // the corners among its vertices
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        box = tl_aabb_add_point(box, surface.vertices[i]);
    }
    return box;
}

tl_aabb tl_nav_tile_surface_bounds(const tl_nav_tile *tile)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        bounds = tl_aabb_union(bounds, tl_nav_polygon_box(tile, p));
    }
    return bounds;
}

static float axis_of(tl_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

uint32_t tl_nav_steps_over(tl_aabb bounds)
{
    uint32_t steps = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float low = axis_of(bounds.min, axis), high = axis_of(bounds.max, axis);
        uint32_t exponent = 0; // a step of 0
        float step = 0.0f;
        while (exponent < 254 && !(low + (float)UINT16_MAX * step >= high)) {
            exponent++;
            const uint32_t bits = exponent << 23;
            memcpy(&step, &bits, sizeof step);
        }
        steps |= exponent << 8 * axis;
    }
    return steps;
}

// The last step that is not above a value, or the first that is not below it. By halving: what a step is in metres is
// rounded as tl_nav_tile_node_box rounds it.
static uint16_t step_at(float base, float step, float value, bool is_below)
{
    uint32_t low = 0, high = step > 0.0f ? UINT16_MAX : 0;
    while (low < high) {
        const uint32_t middle = (low + high + (is_below ? 1 : 0)) / 2;
        const float at = base + (float)middle * step;
        if (is_below ? at <= value : at < value) {
            low = middle + (is_below ? 0 : 1);
        } else {
            high = middle - (is_below ? 1 : 0);
        }
    }
    return (uint16_t)low;
}

void tl_nav_set_leaf_box(const tl_nav_tile *tile, tl_nav_tile_node *leaf)
{
    const tl_aabb box = tl_nav_polygon_box(tile, leaf->link & ~TL_NAV_NODE_LEAF);
    const tl_vec3 steps = tl_nav_tile_node_steps(tile);
    for (int axis = 0; axis < 3; axis++) {
        const float base = axis_of(tile->bounds.min, axis), step = axis_of(steps, axis);
        leaf->min[axis] = step_at(base, step, axis_of(box.min, axis), true);
        leaf->max[axis] = step_at(base, step, axis_of(box.max, axis), false);
    }
}

void tl_nav_set_inner_box(tl_nav_tile_node *inner, const tl_nav_tile_node *a, const tl_nav_tile_node *b)
{
    for (int axis = 0; axis < 3; axis++) {
        inner->min[axis] = a->min[axis] < b->min[axis] ? a->min[axis] : b->min[axis];
        inner->max[axis] = a->max[axis] > b->max[axis] ? a->max[axis] : b->max[axis];
    }
}

void tl_nav_tile_fit_boxes(tl_nav_tile *tile)
{
    tile->bounds = tl_nav_tile_surface_bounds(tile);
    tile->node_steps = tl_nav_steps_over(tile->bounds);
    tl_nav_tile_node *nodes = tl_nav_tile_to_write(tile, tile->nodes);
    for (uint32_t i = tile->node_count; i > 0; i--) {
        if ((nodes[i - 1].link & TL_NAV_NODE_LEAF) != 0) {
            tl_nav_set_leaf_box(tile, &nodes[i - 1]);
        } else {
            tl_nav_set_inner_box(&nodes[i - 1], &nodes[i], &nodes[tl_nav_tile_node_skip(nodes, i)]);
        }
    }
}

typedef struct tree_build {
    const tl_aabb *boxes; // by polygon
    tl_sort_item *items;
    tl_sort_item *scratch;
    tl_nav_tile_node *nodes;
} tree_build;

// Doubled centres: the halving would change no order.
static float center2(tl_aabb box, int axis)
{
    return axis_of(box.min, axis) + axis_of(box.max, axis);
}

static int widest_axis(const tree_build *build, uint32_t begin, uint32_t end)
{
    int widest = 0;
    float widest_spread = -1.0f;
    for (int axis = 0; axis < 3; axis++) {
        float low = center2(build->boxes[build->items[begin].value], axis);
        float high = low;
        for (uint32_t i = begin + 1; i < end; i++) {
            float center = center2(build->boxes[build->items[i].value], axis);
            low = center < low ? center : low;
            high = center > high ? center : high;
        }
        if (high - low > widest_spread) {
            widest = axis;
            widest_spread = high - low;
        }
    }
    return widest;
}

// Builds the subtree of items [begin, end) at `node` and returns the index behind it. The depth of the recursion is
// that of the tree: at most 1 + log2(2^28).
static uint32_t build_box_subtree(tree_build *build, uint32_t node, uint32_t begin, uint32_t end)
{
    if (end - begin == 1) {
        build->nodes[node].link = TL_NAV_NODE_LEAF | build->items[begin].value;
        return node + 1;
    }
    int axis = widest_axis(build, begin, end);
    for (uint32_t i = begin; i < end; i++) {
        uint32_t polygon = build->items[i].value;
        build->items[i].key = (uint64_t)tl_float_sort_key(center2(build->boxes[polygon], axis)) << 32 | polygon;
    }
    tl_radix_sort(build->items + begin, build->scratch, end - begin);
    uint32_t middle = begin + (end - begin) / 2;
    uint32_t second = build_box_subtree(build, node + 1, begin, middle);
    uint32_t behind = build_box_subtree(build, second, middle, end);
    build->nodes[node].link = behind;
    return behind;
}

tl_result tl_nav_bake_box_tree(tl_nav_tile *tile, tl_arena *arena)
{
    uint32_t count = tile->polygon_count;
    tl_aabb *boxes = TL_PUSH(arena, tl_aabb, count);
    tree_build build = { boxes, TL_PUSH(arena, tl_sort_item, count), TL_PUSH(arena, tl_sort_item, count),
                         tl_nav_tile_to_write(tile, tile->nodes) };
    if (boxes == NULL || build.items == NULL || build.scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < count; p++) {
        boxes[p] = tl_nav_polygon_box(tile, p);
        tl_sort_item item = { 0, p, 0 };
        build.items[p] = item;
    }
    uint32_t behind = build_box_subtree(&build, 0, 0, count);
    TL_ASSERT(behind == tile->node_count);
    (void)behind;
    tl_nav_tile_fit_boxes(tile);
    return TL_OK;
}
