// SPDX-License-Identifier: MIT
//
// Reading a soup without a ray: its counts, its triangles and pairs one after the other, those in a box, its tree.

#include "soup/soup_layout.h"

#include "base/assert.h"

#include <string.h>

uint64_t tl_soup_size(const tl_soup *soup)
{
    return soup->blob.size;
}

tl_aabb tl_soup_bounds(const tl_soup *soup)
{
    tl_aabb bounds = { soup->bounds_min, soup->bounds_max };
    return bounds;
}

tl_soup_stats tl_soup_get_stats(const tl_soup *soup)
{
    tl_soup_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.size = soup->blob.size;
    stats.source_triangle_count = soup->source_triangle_count;
    stats.triangle_count = soup->triangle_count;
    stats.pair_count = soup->pair_count;
    stats.single_count = soup->single_count;
    stats.reference_count = soup->reference_count;
    stats.leaf_count = soup->leaf_count;
    stats.node_count = soup->node_count;
    stats.depth = soup->depth;
    stats.node_bytes = (uint64_t)soup->node_count * sizeof(tl_soup_node);
    stats.leaf_bytes = soup->leaf_bytes;
    stats.material_bytes = soup->has_materials ? (uint64_t)soup->source_triangle_count * sizeof(uint16_t) : 0;
    return stats;
}

static void read_triangle(const tl_soup *soup, const tl_leaf_view *leaf, uint32_t lane, tl_soup_triangle *triangle)
{
    tl_leaf_corners(leaf, lane, triangle->corners);
    triangle->triangle = leaf->ids[lane] & TL_ID_INDEX;
    triangle->material = tl_soup_material(soup, triangle->triangle);
}

// A cursor is the offset of a leaf, a multiple of 16, plus a lane, which is below 8.
static uint64_t leaf_of_cursor(uint64_t cursor)
{
    return cursor & ~(uint64_t)(TL_SOUP_LEAF_ALIGN - 1);
}

bool tl_soup_next_triangle(const tl_soup *soup, uint64_t *cursor, tl_soup_triangle *triangle_out)
{
    TL_ASSERT(soup != NULL && cursor != NULL && triangle_out != NULL);
    while (leaf_of_cursor(*cursor) < soup->leaf_bytes) {
        uint64_t offset = leaf_of_cursor(*cursor);
        uint32_t lane = (uint32_t)(*cursor - offset);
        tl_leaf_view leaf = tl_view_leaf(tl_soup_leaf_at(soup, offset));
        *cursor = lane + 1 < 2 * leaf.pair_count ? *cursor + 1 : offset + tl_leaf_size(leaf.pair_count);
        if (leaf.ids[lane] != TL_ID_NONE && (leaf.ids[lane] & TL_ID_COPY) == 0) {
            read_triangle(soup, &leaf, lane, triangle_out);
            return true;
        }
    }
    return false;
}

bool tl_soup_next_pair(const tl_soup *soup, uint64_t *cursor, tl_soup_pair *pair_out)
{
    TL_ASSERT(soup != NULL && cursor != NULL && pair_out != NULL);
    while (leaf_of_cursor(*cursor) < soup->leaf_bytes) {
        uint64_t offset = leaf_of_cursor(*cursor);
        uint32_t i = (uint32_t)(*cursor - offset);
        tl_leaf_view leaf = tl_view_leaf(tl_soup_leaf_at(soup, offset));
        uint32_t n = leaf.pair_count;
        *cursor = i + 1 < n ? *cursor + 1 : offset + tl_leaf_size(n);
        if ((leaf.ids[i] & TL_ID_COPY) != 0) {
            continue;
        }
        bool single = leaf.ids[n + i] == TL_ID_NONE;
        pair_out->corners[0] = tl_leaf_slot(&leaf, i, 0);
        pair_out->corners[1] = tl_leaf_slot(&leaf, i, 1);
        pair_out->corners[2] = tl_leaf_slot(&leaf, i, 2);
        pair_out->corners[3] = tl_leaf_slot(&leaf, n + i, 1);
        pair_out->triangles[0] = leaf.ids[i] & TL_ID_INDEX;
        pair_out->triangles[1] = single ? TL_NO_TRIANGLE : leaf.ids[n + i] & TL_ID_INDEX;
        return true;
    }
    return false;
}

// A child's box in doubles, by the same expression by which the baker rounded it outward: it holds the child's corners.
typedef struct child_box {
    double min[3], max[3];
} child_box;

static child_box read_box(const tl_soup *soup, const tl_soup_node *node, uint32_t lane)
{
    const float origin[3] = { soup->grid_origin.x, soup->grid_origin.y, soup->grid_origin.z };
    const float cell[3] = { soup->grid_cell.x, soup->grid_cell.y, soup->grid_cell.z };
    child_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = (double)origin[i] + (double)node->plane[2 * i][lane] * (double)cell[i];
        box.max[i] = (double)origin[i] + (double)node->plane[2 * i + 1][lane] * (double)cell[i];
    }
    return box;
}

static bool boxes_overlap(const child_box *a, tl_aabb b)
{
    return a->min[0] <= (double)b.max.x && a->max[0] >= (double)b.min.x && a->min[1] <= (double)b.max.y &&
           a->max[1] >= (double)b.min.y && a->min[2] <= (double)b.max.z && a->max[2] >= (double)b.min.z;
}

static bool report_leaf(const tl_soup *soup, uint32_t child, tl_aabb box, tl_soup_triangle_fn *found, void *user)
{
    tl_leaf_view leaf = tl_view_leaf(tl_soup_leaf_at(soup, tl_child_leaf_offset(child)));
    for (uint32_t lane = 0; lane < 2 * leaf.pair_count; lane++) {
        if (leaf.ids[lane] == TL_ID_NONE) {
            continue;
        }
        tl_soup_triangle triangle;
        read_triangle(soup, &leaf, lane, &triangle);
        tl_aabb own = { tl_min(tl_min(triangle.corners[0], triangle.corners[1]), triangle.corners[2]),
                        tl_max(tl_max(triangle.corners[0], triangle.corners[1]), triangle.corners[2]) };
        if (tl_aabb_overlaps(own, box) && !found(&triangle, user)) {
            return false;
        }
    }
    return true;
}

bool tl_soup_triangles_in_box(const tl_soup *soup, tl_aabb box, tl_soup_triangle_fn *found, void *user)
{
    TL_ASSERT(soup != NULL && found != NULL);
    // Each node on the way down leaves at most fifteen siblings behind.
    uint32_t stack[(TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + TL_SOUP_WIDTH];
    uint32_t stack_count = 0;
    stack[stack_count++] = 0;
    while (stack_count > 0) {
        uint32_t child = stack[--stack_count];
        if ((child & TL_CHILD_LEAF) != 0) {
            if (!report_leaf(soup, child, box, found, user)) {
                return false;
            }
            continue;
        }
        const tl_soup_node *node = &tl_soup_nodes(soup)[child];
        for (uint32_t lane = TL_SOUP_WIDTH; lane-- > 0;) {
            child_box bounds = read_box(soup, node, lane);
            if (node->child[lane] != 0 && boxes_overlap(&bounds, box)) {
                stack[stack_count++] = node->child[lane];
            }
        }
    }
    return true;
}

typedef struct box_entry {
    uint32_t node, lane, depth;
} box_entry;

bool tl_soup_tree_boxes(const tl_soup *soup, uint32_t max_depth, tl_soup_tree_box_fn *visit, void *user)
{
    TL_ASSERT(soup != NULL && visit != NULL);
    if (!visit(tl_soup_bounds(soup), 0, false, user)) {
        return false;
    }
    box_entry stack[(TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + TL_SOUP_WIDTH];
    uint32_t stack_count = 0;
    uint32_t node = 0;
    uint32_t depth = 0;
    const tl_soup_node *nodes = tl_soup_nodes(soup);
    for (;;) {
        for (uint32_t lane = TL_SOUP_WIDTH; depth < max_depth && lane-- > 0;) {
            if (nodes[node].child[lane] != 0) {
                box_entry entry = { node, lane, depth + 1 };
                stack[stack_count++] = entry;
            }
        }
        bool inner = false;
        while (!inner) {
            if (stack_count == 0) {
                return true;
            }
            box_entry entry = stack[--stack_count];
            uint32_t child = nodes[entry.node].child[entry.lane];
            child_box b = read_box(soup, &nodes[entry.node], entry.lane);
            tl_aabb box = { tl_vec3_make((float)b.min[0], (float)b.min[1], (float)b.min[2]),
                            tl_vec3_make((float)b.max[0], (float)b.max[1], (float)b.max[2]) };
            inner = (child & TL_CHILD_LEAF) == 0;
            if (!visit(box, entry.depth, !inner, user)) {
                return false;
            }
            node = child;
            depth = entry.depth;
        }
    }
}
