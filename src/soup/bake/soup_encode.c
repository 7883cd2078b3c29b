// SPDX-License-Identifier: MIT
//
// From the binary BVH to the blob: wide nodes are collapsed from it (bvh_collapse.c) level by level, which gives every
// node and leaf its place; then the host's tasks write them, in any order. The blob is not zeroed first: a task writes
// all bytes of its own nodes and leaves, and so touches their pages first.

#include "soup/bake/soup_encode.h"

#include "base/assert.h"
#include "base/host.h"

#include <float.h>
#include <string.h>

// Wide nodes a task.
enum { BLOCK_NODES = 64 };

// The nodes of tasks: from `first` to below `end`.
typedef struct node_range {
    tl_soup_encoder *baker;
    uint32_t first, end;
} node_range;

static node_range block_of(const node_range *range, uint32_t block)
{
    node_range r = { range->baker, range->first + block * BLOCK_NODES,
                     range->first + tl_block_end(block, BLOCK_NODES, range->end - range->first) };
    return r;
}

static void find_children(const tl_soup_encoder *b, tl_wide_node *wide)
{
    wide->child_count = tl_bvh_collapsed_children(&b->cut, wide->root, wide->child);
    wide->leaf_count = 0;
    wide->leaf_bytes = 0;
    for (uint32_t k = 0; k < wide->child_count; k++) {
        uint32_t pairs = b->tree->nodes[wide->child[k]].count;
        if (pairs > 0) {
            wide->child[k] |= TL_WIDE_LEAF;
            wide->leaf_count++;
            wide->leaf_bytes += b->layout == TL_SOUP_COMPACT ? pairs * (uint32_t)sizeof(tl_compact_pair)
                                                             : (uint32_t)tl_leaf_size(pairs);
        }
    }
    wide->inner_count = wide->child_count - wide->leaf_count;
}

static void find_children_of_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    node_range range = block_of(user, block);
    for (uint32_t i = range.first; i < range.end; i++) {
        find_children(range.baker, &range.baker->wide[i]);
    }
}

// Gives a node's children their places: behind the children of all nodes before it.
static void place_children(tl_soup_encoder *b, tl_wide_node *wide)
{
    wide->first_inner = b->node_count;
    wide->leaf_offset = b->leaf_bytes;
    b->leaf_bytes += wide->leaf_bytes;
    b->leaf_count += wide->leaf_count;
    for (uint32_t k = 0; k < wide->child_count; k++) {
        if ((wide->child[k] & TL_WIDE_LEAF) == 0) {
            b->wide[b->node_count++].root = wide->child[k];
        }
    }
}

// Finds the wide nodes breadth first, and with them all sizes.
static void cut_tree(tl_soup_encoder *b, const tl_host *host)
{
    b->wide[0].root = b->tree->root;
    b->node_count = 1;
    for (node_range level = { b, 0, 1 }; level.first < level.end; level.first = level.end, level.end = b->node_count) {
        b->depth++;
        tl_run_tasks(host, find_children_of_block, tl_block_count(level.end - level.first, BLOCK_NODES), &level);
        for (uint32_t i = level.first; i < level.end; i++) {
            place_children(b, &b->wide[i]);
        }
    }
}

// Marks all but the first reference to a pair, in the order of the leaves.
static tl_result mark_copies(const tl_soup_encoder *b, tl_arena *arena)
{
    uint8_t *met = TL_PUSH_ZERO(arena, uint8_t, b->pair_count);
    if (met == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < b->node_count; i++) {
        const tl_wide_node *wide = &b->wide[i];
        for (uint32_t k = 0; k < wide->child_count; k++) {
            const tl_bvh_node *leaf = &b->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF];
            for (uint32_t r = 0; r < leaf->count; r++) {
                tl_bvh_ref *ref = &b->tree->refs[leaf->first + r];
                ref->is_copy = met[ref->pair];
                met[ref->pair] = 1;
            }
        }
    }
    return TL_OK;
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

static void write_leaf_corner(float *const *arrays, uint32_t i, tl_vec3 corner)
{
    arrays[0][i] = corner.x;
    arrays[1][i] = corner.y;
    arrays[2][i] = corner.z;
}

uint32_t tl_encode_id(const tl_soup_encoder *b, const tl_bvh_ref *ref, uint32_t k)
{
    const tl_triangle_pair *pair = &b->pairs[ref->pair];
    if (pair->triangle[k] == TL_NO_TRIANGLE) {
        return TL_ID_NONE;
    }
    return b->mesh->source_triangles[pair->triangle[k]] | (ref->is_copy ? TL_ID_COPY : 0) |
           (uint32_t)pair->order[k] << 29;
}

static void write_leaf(const tl_soup_encoder *b, const tl_bvh_node *node, tl_soup_leaf *leaf)
{
    uint32_t n = node->count;
    memset(leaf, 0, tl_leaf_size(n));
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
        const tl_bvh_ref *ref = &b->tree->refs[node->first + i];
        const tl_triangle_pair *pair = &b->pairs[ref->pair];
        tl_vec3 corner[4];
        for (uint32_t k = 0; k < 4; k++) {
            corner[k] = b->mesh->vertices[pair->corner[k]];
        }
        write_leaf_corner(a, i, corner[0]);
        write_leaf_corner(e, i, corner[1]);
        write_leaf_corner(c, i, corner[2]);
        write_leaf_corner(e, n + i, corner[3]);
        for (uint32_t k = 0; k < 2; k++) {
            ids[k * n + i] = tl_encode_id(b, ref, k);
        }
        leaf->extent = tl_maxf(leaf->extent, tl_maxf(triangle_extent(corner[0], corner[1], corner[2]),
                                                     triangle_extent(corner[0], corner[2], corner[3])));
    }
}

static void write_node(const tl_soup_encoder *b, uint32_t index)
{
    const tl_wide_node *wide = &b->wide[index];
    tl_soup_node *node = (tl_soup_node *)(void *)((char *)b->soup + b->soup->node_offset) + index;
    uint32_t next_node = wide->first_inner;
    uint64_t leaf_offset = wide->leaf_offset;
    memset(node, 0, sizeof *node);
    for (uint32_t k = 0; k < wide->child_count; k++) {
        const tl_bvh_node *child = &b->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF];
        write_box(child->box, k, node);
        if ((wide->child[k] & TL_WIDE_LEAF) != 0) {
            node->child[k] = tl_child_of_leaf(leaf_offset, child->count);
            write_leaf(b, child, (tl_soup_leaf *)(void *)((char *)b->soup + b->soup->leaf_offset + leaf_offset));
            leaf_offset += tl_leaf_size(child->count);
        } else {
            node->child[k] = next_node++;
        }
    }
    for (uint32_t k = wide->child_count; k < TL_SOUP_WIDTH; k++) {
        write_box(tl_aabb_empty(), k, node);
    }
}

static void write_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    node_range range = block_of(user, block);
    for (uint32_t i = range.first; i < range.end; i++) {
        if (range.baker->layout == TL_SOUP_COMPACT) {
            tl_compact_write_node(range.baker, i);
        } else {
            write_node(range.baker, i);
        }
    }
}

// Whether triangles differ in material; if not, `*uniform_out` is the material of all.
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

static void fill_head(const tl_soup_encoder *b, tl_soup *soup)
{
    memset(soup, 0, sizeof *soup);
    soup->has_materials = needs_material_table(b->view, &soup->uniform_material);
    soup->layout = b->layout;
    soup->leaf_bytes = b->leaf_bytes;
    soup->vertex_count = b->plan->vertex_count;
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

// The blob with its head. Nodes and leaves are uninitialized, all other bytes zero.
static tl_soup *allocate_soup(tl_soup *head, const tl_allocator *allocator)
{
    tl_soup *soup = tl_blob_allocate_part(allocator, TL_SOUP_MAGIC, TL_SOUP_VERSION, tl_soup_place_arrays(head),
                                          sizeof(tl_soup), head->leaf_offset + head->leaf_bytes);
    if (soup != NULL) {
        head->blob = soup->blob;
        *soup = *head;
    }
    return soup;
}

tl_result tl_soup_encode(const tl_soup_parts *parts, const tl_soup_def *def, tl_arena *arena, tl_soup **soup_out)
{
    const tl_mesh_view *view = parts->view;
    const tl_bvh *tree = parts->bvh;
    tl_soup_encoder b = { .view = view, .mesh = parts->mesh, .pairs = parts->pairs, .tree = tree };
    b.pair_count = parts->pair_count;
    b.layout = def->layout;
    TL_TRY(tl_bvh_plan_collapse(tree, &def->host, arena, &b.cut));
    b.wide = TL_PUSH(arena, tl_wide_node, (uint64_t)b.cut.inner_count + 1);
    if (b.wide == NULL) {
        return TL_ERR_MEMORY;
    }
    cut_tree(&b, &def->host);
    if (b.leaf_bytes / TL_SOUP_LEAF_ALIGN > TL_MAX_LEAF_UNITS) {
        return TL_ERR_LIMIT;
    }
    if (tree->ref_count != b.pair_count) {
        TL_TRY(mark_copies(&b, arena));
    }
    tl_compact_plan plan = { 0 };
    if (def->layout == TL_SOUP_COMPACT) {
        TL_TRY(tl_compact_plan_vertices(&b, arena, &plan));
    }
    b.plan = &plan;
    tl_soup head;
    fill_head(&b, &head);
    tl_soup *soup = allocate_soup(&head, def->host.allocator);
    if (soup == NULL) {
        return TL_ERR_MEMORY;
    }
    b.soup = soup;
    node_range all = { &b, 0, b.node_count };
    tl_run_tasks(&def->host, write_block, tl_block_count(b.node_count, BLOCK_NODES), &all);
    if (def->layout == TL_SOUP_COMPACT) {
        tl_compact_write_vertices(&b, &def->host);
    }
    if (soup->has_materials) {
        memcpy((char *)soup + soup->material_offset, view->materials, (size_t)view->triangle_count * sizeof(uint16_t));
    }
    *soup_out = soup;
    return TL_OK;
}
