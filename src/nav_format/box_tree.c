// SPDX-License-Identifier: MIT
//
// The BVH over a tile's polygons: median split on the axis along which the centres extend most.
//
// Nodes stand depth-first with the index behind each subtree, so a range query is one loop without a stack, and an
// ordered query still finds both children. The median bounds the depth by log2 of the polygons, so that queries can
// hold their stack in an array; the surface-area heuristic was rejected, because floors are flat and alike in size.

#include "nav_format/box_tree.h"

#include "base/assert.h"
#include "base/radix_sort.h"

tl_aabb tl_nav_polygon_box(const tl_nav_tile *tile, uint32_t polygon)
{
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon); // the corners among its vertices
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        box = tl_aabb_add_point(box, surface.vertices[i]);
    }
    return box;
}

typedef struct tree_build {
    const tl_aabb *boxes; // by polygon
    tl_sort_item *items;
    tl_sort_item *scratch;
    tl_nav_tile_node *nodes;
} tree_build;

static float axis_of(tl_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

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
    tl_nav_tile_node *out = &build->nodes[node];
    if (end - begin == 1) {
        out->polygon = build->items[begin].value;
        out->box = build->boxes[out->polygon];
        out->skip = node + 1;
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
    out->box = tl_aabb_union(build->nodes[node + 1].box, build->nodes[second].box);
    out->polygon = TL_NO_POLYGON;
    out->skip = behind;
    return behind;
}

tl_result tl_nav_bake_box_tree(tl_nav_tile *tile, tl_arena *arena)
{
    uint32_t count = tile->polygon_count;
    tl_aabb *boxes = TL_PUSH(arena, tl_aabb, count);
    tree_build build = { boxes, TL_PUSH(arena, tl_sort_item, count), TL_PUSH(arena, tl_sort_item, count),
                         (tl_nav_tile_node *)((char *)tile + tile->nodes) };
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
    return TL_OK;
}
