// SPDX-License-Identifier: MIT
//
// From the binary tree to the blob: wide nodes are cut from it (tree_cut.c), and pairs are written into leaves.

#include "soup/soup_bake.h"
#include "base/assert.h"
#include "soup/soup_build.h"

#include <float.h>
#include <string.h>

// Finds the wide nodes breadth first, and with them all sizes.
static void cut_tree(tl_baker *b)
{
    b->roots[0] = b->tree->root;
    b->node_count = 1;
    uint32_t level_end = 1;
    b->depth = 1;
    for (uint32_t i = 0; i < b->node_count; i++) {
        if (i == level_end) {
            level_end = b->node_count;
            b->depth++;
        }
        uint32_t children[TL_SOUP_WIDTH];
        uint32_t count = tl_tree_cut_children(&b->cut, b->roots[i], children);
        for (uint32_t k = 0; k < count; k++) {
            const tl_tree_node *child = &b->tree->nodes[children[k]];
            if (child->count > 0) {
                b->leaf_count++;
                b->leaf_bytes +=
                    b->layout == TL_SOUP_COMPACT ? child->count * sizeof(tl_compact_pair) : tl_leaf_size(child->count);
            } else {
                b->roots[b->node_count++] = children[k];
            }
        }
    }
}

static void write_box(tl_aabb box, uint32_t lane, tl_soup_node *node)
{
    const float planes[6] = { box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z };
    for (uint32_t i = 0; i < 6; i++) {
        node->plane[i][lane] = planes[i];
    }
}

static float triangle_extent(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    tl_vec3 size = tl_sub(tl_max(tl_max(a, b), c), tl_min(tl_min(a, b), c));
    return tl_maxf(tl_maxf(size.x, size.y), size.z);
}

static void write_corner(float *const *arrays, uint32_t i, tl_vec3 corner)
{
    arrays[0][i] = corner.x;
    arrays[1][i] = corner.y;
    arrays[2][i] = corner.z;
}

uint32_t tl_bake_id(const tl_baker *b, const tl_pair *pair, uint32_t k, bool is_copy)
{
    if (pair->triangle[k] == TL_NO_TRIANGLE) {
        return TL_ID_NONE;
    }
    return b->mesh->source_triangles[pair->triangle[k]] | (is_copy ? TL_ID_COPY : 0) | (uint32_t)pair->order[k] << 29;
}

static void write_leaf(tl_baker *b, const tl_tree_node *node, tl_soup_leaf *leaf)
{
    uint32_t n = node->count;
    leaf->tagged_count = TL_LEAF_TAG | n;
    uint32_t *ids = (uint32_t *)(void *)(leaf + 1);
    float *floats = (float *)(void *)(ids + 2 * (size_t)n);
    float *a[3], *c[3], *e[3];
    for (uint32_t axis = 0; axis < 3; axis++) {
        a[axis] = floats + (size_t)(4 * axis) * n;
        c[axis] = a[axis] + n;
        e[axis] = c[axis] + n;
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t index = b->tree->refs[node->first + i].pair;
        const tl_pair *pair = &b->pairs[index];
        bool is_copy = b->written[index];
        b->written[index] = 1;
        tl_vec3 corner[4];
        for (uint32_t k = 0; k < 4; k++) {
            corner[k] = b->mesh->vertices[pair->corner[k]];
        }
        write_corner(a, i, corner[0]);
        write_corner(e, i, corner[1]);
        write_corner(c, i, corner[2]);
        write_corner(e, n + i, corner[3]);
        for (uint32_t k = 0; k < 2; k++) {
            ids[k * n + i] = tl_bake_id(b, pair, k, is_copy);
        }
        leaf->extent = tl_maxf(leaf->extent, tl_maxf(triangle_extent(corner[0], corner[1], corner[2]),
                                                     triangle_extent(corner[0], corner[2], corner[3])));
    }
}

static void write_tree(tl_baker *b, tl_soup *soup)
{
    tl_soup_node *nodes = (tl_soup_node *)(void *)((char *)soup + soup->node_offset);
    uint32_t next_node = 1;
    uint64_t leaf_offset = 0;
    for (uint32_t i = 0; i < b->node_count; i++) {
        uint32_t children[TL_SOUP_WIDTH];
        uint32_t count = tl_tree_cut_children(&b->cut, b->roots[i], children);
        for (uint32_t k = 0; k < count; k++) {
            const tl_tree_node *child = &b->tree->nodes[children[k]];
            write_box(child->box, k, &nodes[i]);
            if (child->count > 0) {
                nodes[i].child[k] = tl_child_of_leaf(leaf_offset, child->count);
                write_leaf(b, child, (tl_soup_leaf *)(void *)((char *)soup + soup->leaf_offset + leaf_offset));
                leaf_offset += tl_leaf_size(child->count);
            } else {
                nodes[i].child[k] = next_node++;
            }
        }
        for (uint32_t k = count; k < TL_SOUP_WIDTH; k++) {
            write_box(tl_aabb_empty(), k, &nodes[i]);
        }
    }
    TL_ASSERT(next_node == b->node_count && leaf_offset == b->leaf_bytes);
}

// The material of all triangles, or whether they need a table.
static bool needs_material_table(const tl_mesh_view *view, uint32_t *uniform_out)
{
    *uniform_out = view->materials != NULL ? view->materials[0] : 0;
    for (uint32_t i = 1; view->materials != NULL && i < view->triangle_count; i++) {
        if (view->materials[i] != view->materials[0]) {
            *uniform_out = 0;
            return true;
        }
    }
    return false;
}

static void fill_head(const tl_baker *b, const tl_compact_plan *plan, tl_soup *soup)
{
    memset(soup, 0, sizeof *soup);
    soup->has_materials = needs_material_table(b->view, &soup->uniform_material);
    soup->layout = b->layout;
    soup->leaf_bytes = b->leaf_bytes;
    soup->vertex_count = plan->vertex_count;
    soup->source_triangle_count = b->view->triangle_count;
    soup->triangle_count = b->mesh->triangle_count;
    soup->pair_count = b->mesh->triangle_count - b->pair_count;
    soup->single_count = b->pair_count - soup->pair_count;
    soup->reference_count = b->tree->ref_count;
    soup->leaf_count = b->leaf_count;
    soup->node_count = b->node_count;
    soup->depth = b->depth;
    tl_aabb bounds = b->mesh->bounds;
    soup->bounds_min = bounds.min;
    soup->bounds_max = bounds.max;
}

tl_result tl_soup_bake(const tl_mesh_view *view, const tl_mesh *mesh, const tl_pair *pairs, uint32_t pair_count,
                       const tl_tree *tree, const tl_soup_def *def, tl_arena *arena, tl_soup **soup_out)
{
    tl_baker b = { .view = view, .mesh = mesh, .pairs = pairs, .pair_count = pair_count, .tree = tree };
    b.layout = def->layout;
    // A wide node stands for a binary inner node, of which there are fewer than references; or for a lone leaf.
    b.roots = TL_PUSH(arena, uint32_t, tree->ref_count);
    b.written = TL_PUSH_ZERO(arena, uint8_t, pair_count);
    if (b.roots == NULL || b.written == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_tree_cut_plan(tree, arena, &b.cut));
    cut_tree(&b);
    if (b.leaf_bytes / TL_SOUP_LEAF_ALIGN > TL_MAX_LEAF_UNITS) {
        return TL_ERR_LIMIT;
    }
    tl_compact_plan plan = { 0 };
    if (def->layout == TL_SOUP_COMPACT) {
        TL_TRY(tl_compact_plan_vertices(&b, arena, &plan));
    }
    tl_soup head;
    fill_head(&b, &plan, &head);
    tl_soup *soup = tl_blob_allocate(def->host.allocator, TL_SOUP_MAGIC, TL_SOUP_VERSION, tl_soup_place_arrays(&head));
    if (soup == NULL) {
        return TL_ERR_MEMORY;
    }
    head.blob = soup->blob;
    *soup = head;
    if (def->layout == TL_SOUP_COMPACT) {
        tl_compact_write(&b, &plan, soup);
    } else {
        write_tree(&b, soup);
    }
    if (soup->has_materials) {
        memcpy((char *)soup + soup->material_offset, view->materials, (size_t)view->triangle_count * sizeof(uint16_t));
    }
    *soup_out = soup;
    return TL_OK;
}
