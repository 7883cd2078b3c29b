// SPDX-License-Identifier: MIT
//
// Refit: rewrites the corners of moved vertices, and the boxes from the leaves up.
//
// Pairs and tree stay what they were, so queries answer as on a soup that is baked anew, only more slowly the farther
// its triangles have moved apart. Nodes are numbered breadth first, so children lie behind their parents, and one pass
// from the last node to the first fits all boxes. Where spatial splits had clipped a pair's box, each copy gets the
// whole box.
//
// Everything is checked before anything is written.

#include "base/assert.h"
#include "base/host.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

// A pair's corners in their slots: a, c, and e of either triangle.
typedef struct moved_pair {
    tl_vec3 slot[2][3]; // of each triangle: a, e, c
    bool single;
} moved_pair;

static bool position_in_range(tl_vec3 v)
{
    return fabsf(v.x) <= TL_MAX_COORDINATE && fabsf(v.y) <= TL_MAX_COORDINATE && fabsf(v.z) <= TL_MAX_COORDINATE;
}

static bool is_same_position(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Of triangles that coincide the lowest stands for all.
static moved_pair move_pair(const tl_soup *soup, const tl_mesh_view *view, const tl_leaf_view *leaf, uint32_t pair)
{
    moved_pair moved;
    memset(&moved, 0, sizeof moved);
    moved.single = leaf->ids[leaf->pair_count + pair] == TL_ID_NONE;
    for (uint32_t half = 0; half < (moved.single ? 1u : 2u); half++) {
        uint32_t id = leaf->ids[half * leaf->pair_count + pair];
        const uint32_t *index = view->indices + 3 * (size_t)tl_soup_lowest_triangle(soup, id);
        for (uint32_t k = 0; k < 3; k++) {
            moved.slot[half][tl_soup_corner_slots[tl_id_order(id)][k]] = view->vertices[index[k]];
        }
    }
    return moved;
}

static tl_result check_triangle(const tl_mesh_view *view, uint32_t triangle, tl_report *report)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t index = view->indices[3 * (size_t)triangle + k];
        if (index >= view->vertex_count) {
            return tl_report_fail(report, TL_ERR_INDEX, "triangle", triangle, "check the index buffer");
        }
        if (!tl_is_finite(view->vertices[index])) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "vertex", index, "check the code that moves the vertices");
        }
        if (!position_in_range(view->vertices[index])) {
            return tl_report_fail(report, TL_ERR_RANGE, "vertex", index, "keep coordinates within 1e12 m");
        }
    }
    return TL_OK;
}

// Every triangle of a lane, and whether those that coincided still do.
static tl_result check_moved_lane(const tl_soup *soup, const tl_mesh_view *view, uint32_t id, tl_report *report)
{
    const uint32_t *word = tl_soup_coincident(soup, id);
    tl_vec3 slots[3];
    for (bool first = true, last = false; !last; first = false) {
        id = word != NULL ? *word : id;
        last = word == NULL || (*word++ & TL_ID_LAST) != 0;
        const uint32_t triangle = id & TL_ID_INDEX;
        TL_TRY(check_triangle(view, triangle, report));
        for (uint32_t k = 0; k < 3; k++) {
            const tl_vec3 corner = view->vertices[view->indices[3 * (size_t)triangle + k]];
            tl_vec3 *slot = &slots[tl_soup_corner_slots[tl_id_order(id)][k]];
            *slot = first ? corner : *slot;
            if (!is_same_position(corner, *slot)) {
                return tl_report_fail(report, TL_ERR_ARGUMENT, "triangle", triangle,
                                      "it came apart from one it lay on: move equal vertices equally, or bake anew");
            }
        }
    }
    return TL_OK;
}

static tl_result check_moved_leaf(const tl_soup *soup, const tl_mesh_view *view, const tl_leaf_view *leaf,
                                  tl_report *report)
{
    for (uint32_t i = 0; i < 2 * leaf->pair_count; i++) {
        if (leaf->ids[i] != TL_ID_NONE) {
            TL_TRY(check_moved_lane(soup, view, leaf->ids[i], report));
        }
    }
    for (uint32_t i = 0; i < leaf->pair_count; i++) {
        moved_pair moved = move_pair(soup, view, leaf, i);
        bool together = is_same_position(moved.slot[0][0], moved.slot[1][0]) &&
                        is_same_position(moved.slot[0][2], moved.slot[1][2]);
        if (!moved.single && !together) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "triangle", tl_soup_lowest_triangle(soup, leaf->ids[i]),
                                  "it came apart from its neighbour: move equal vertices equally, or bake anew");
        }
    }
    return TL_OK;
}

static tl_result check_view(const tl_soup *soup, const tl_mesh_view *view, tl_report *report)
{
    if (soup->layout != TL_SOUP_FAST) {
        return tl_report_fail(report, TL_ERR_UNSUPPORTED, "soup", TL_NO_ELEMENT,
                              "bake soups that move with TL_SOUP_FAST");
    }
    if (view->triangle_count != soup->source_triangle_count) {
        return tl_report_fail(report, TL_ERR_ARGUMENT, "triangle", view->triangle_count,
                              "give the triangles that the soup was baked from");
    }
    for (uint64_t offset = 0; offset < soup->leaf_bytes;) {
        tl_leaf_view leaf = tl_view_leaf(tl_soup_leaf_at(soup, offset));
        TL_TRY(check_moved_leaf(soup, view, &leaf, report));
        offset += tl_leaf_size(leaf.pair_count);
    }
    return TL_OK;
}

static float extent_of(const tl_vec3 v[3])
{
    tl_vec3 size = tl_sub(tl_max(tl_max(v[0], v[1]), v[2]), tl_min(tl_min(v[0], v[1]), v[2]));
    return tl_maxf(tl_maxf(size.x, size.y), size.z);
}

static void write_slot(const tl_leaf_view *leaf, uint32_t lane, uint32_t slot, tl_vec3 at)
{
    // The soup is writable; the view's pointers are const for the queries.
    const float *slots[3];
    tl_leaf_slots(leaf, lane, slots);
    float *corner = (float *)(uintptr_t)slots[slot];
    size_t stride = tl_leaf_stride(leaf);
    corner[0] = at.x;
    corner[stride] = at.y;
    corner[2 * stride] = at.z;
}

static tl_aabb refit_leaf(const tl_soup *soup, const tl_mesh_view *view, tl_soup_leaf *head)
{
    tl_leaf_view leaf = tl_view_leaf(head);
    tl_aabb box = tl_aabb_empty();
    head->extent = 0.0f;
    for (uint32_t i = 0; i < leaf.pair_count; i++) {
        moved_pair moved = move_pair(soup, view, &leaf, i);
        if (moved.single) { // its fourth corner is the first
            moved.slot[1][0] = moved.slot[1][1] = moved.slot[0][0];
            moved.slot[1][2] = moved.slot[0][2];
        }
        for (uint32_t slot = 0; slot < 3; slot++) {
            write_slot(&leaf, i, slot, moved.slot[0][slot]);
            box = tl_aabb_add_point(box, moved.slot[0][slot]);
        }
        write_slot(&leaf, leaf.pair_count + i, 1, moved.slot[1][1]);
        box = tl_aabb_add_point(box, moved.slot[1][1]);
        head->extent = tl_maxf(head->extent, tl_maxf(extent_of(moved.slot[0]), extent_of(moved.slot[1])));
    }
    return box;
}

static tl_aabb box_of_node(const tl_soup_node *node)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < TL_SOUP_WIDTH; i++) {
        if (node->child[i] != 0) {
            tl_aabb lane = { { node->plane[0][i], node->plane[2][i], node->plane[4][i] },
                             { node->plane[1][i], node->plane[3][i], node->plane[5][i] } };
            box = tl_aabb_union(box, lane);
        }
    }
    return box;
}

tl_result tl_soup_refit(tl_soup *soup, const tl_mesh_view *moved, tl_report *report_out)
{
    tl_report_begin(report_out, "refit soup");
    if (soup == NULL || moved == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, soup == NULL ? "soup" : "moved", "give a soup and a view");
    }
    TL_TRY(check_view(soup, moved, report_out));
    tl_soup_node *nodes = (tl_soup_node *)(void *)((char *)soup + soup->node_offset);
    for (uint32_t i = soup->node_count; i-- > 0;) {
        for (uint32_t lane = 0; lane < TL_SOUP_WIDTH; lane++) {
            uint32_t child = nodes[i].child[lane];
            if (child == 0) {
                continue;
            }
            char *leaf = (char *)soup + soup->leaf_offset + tl_child_leaf_offset(child);
            tl_aabb box = (child & TL_CHILD_LEAF) != 0 ? refit_leaf(soup, moved, (tl_soup_leaf *)(void *)leaf)
                                                       : box_of_node(&nodes[child]);
            const float planes[6] = { box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z };
            for (uint32_t k = 0; k < 6; k++) {
                nodes[i].plane[k][lane] = planes[k];
            }
        }
    }
    tl_aabb bounds = box_of_node(&nodes[0]);
    soup->bounds_min = bounds.min;
    soup->bounds_max = bounds.max;
    return TL_OK;
}
