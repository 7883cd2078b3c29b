// SPDX-License-Identifier: MIT
//
// From the binary BVH to the blob: wide nodes are collapsed from it (bvh_collapse.c) level by level, which gives every
// node and leaf its place; then the host's tasks write them, in any order. The blob is not zeroed first: a task writes
// all bytes of its own nodes and leaves, and so touches their pages first.

#include "soup/bake/soup_encode.h"

#include "base/assert.h"
#include "base/min_max.h"

#include <float.h>
#include <string.h>

// Wide nodes a task; so many tasks are run for each worker between two progress calls, some 10 ms.
enum { BLOCK_NODES = 64, NODE_BATCH = 32 };

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
        uint32_t pairs = tl_bvh_leaf_count(&b->tree->nodes[wide->child[k]]);
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

// Room for the wide nodes of the next level.
static tl_result make_level_room(tl_soup_encoder *b, const node_range *level, const tl_allocator *allocator)
{
    uint64_t needed = b->node_count;
    for (uint32_t i = level->first; i < level->end; i++) {
        needed += b->wide[i].inner_count;
    }
    if (needed <= b->wide_capacity) {
        return TL_OK;
    }
    const uint64_t capacity = tl_max_u64(needed, 2 * b->wide_capacity);
    tl_wide_node *grown = tl_allocate_array(allocator, capacity, sizeof *grown);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = tl_stage_copy(b->stage, grown, b->wide, b->node_count * sizeof *grown);
    tl_release_array(allocator, b->wide, b->wide_capacity, sizeof *b->wide);
    b->wide = grown;
    b->wide_capacity = capacity;
    return result;
}

// Finds the wide nodes breadth first, and with them all sizes.
static tl_result cut_tree(tl_soup_encoder *b, const tl_allocator *allocator)
{
    b->wide = tl_grow_array(allocator, NULL, &b->wide_capacity, sizeof *b->wide);
    if (b->wide == NULL) {
        return TL_ERR_MEMORY;
    }
    b->wide[0].root = 0;
    b->node_count = 1;
    for (node_range level = { b, 0, 1 }; level.first < level.end; level.first = level.end, level.end = b->node_count) {
        b->depth++;
        TL_TRY(tl_stage_run(b->stage, find_children_of_block, tl_block_count(level.end - level.first, BLOCK_NODES),
                            &level, NODE_BATCH, 0));
        TL_TRY(make_level_room(b, &level, allocator));
        for (uint32_t i = level.first; i < level.end; i++) {
            place_children(b, &b->wide[i]);
            TL_TRY(tl_stage_tick(b->stage, i));
        }
    }
    return TL_OK;
}

// Plans and chances are freed before the blob takes its memory.
static tl_result collapse_tree(tl_soup_encoder *b, tl_bvh *tree, const tl_allocator *allocator)
{
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_result result = tl_bvh_plan_collapse(tree, b->stage, &arena, &b->cut);
    if (result == TL_OK) {
        result = cut_tree(b, allocator);
    }
    tl_arena_free(&arena);
    return result;
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
        TL_TRY(tl_stage_tick(b->stage, 8 * (uint64_t)i + 7));
        for (uint32_t k = 0; k < wide->child_count; k++) {
            const tl_bvh_node *leaf = &b->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF];
            for (uint32_t r = 0; r < tl_bvh_leaf_count(leaf); r++) {
                tl_bvh_ref *ref = &b->tree->refs[leaf->link + r];
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
    const uint32_t id = b->pairs[ref->pair].id[k];
    return id != TL_ID_NONE && ref->is_copy ? id | TL_ID_COPY : id;
}

static void write_leaf(const tl_soup_encoder *b, const tl_bvh_node *node, tl_soup_leaf *leaf)
{
    uint32_t n = tl_bvh_leaf_count(node);
    memset(leaf, 0, (size_t)tl_leaf_size(n));
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
        const tl_bvh_ref *ref = &b->tree->refs[node->link + i];
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
            node->child[k] = tl_child_of_leaf(leaf_offset, tl_bvh_leaf_count(child));
            write_leaf(b, child, (tl_soup_leaf *)(void *)((char *)b->soup + b->soup->leaf_offset + leaf_offset));
            leaf_offset += tl_leaf_size(tl_bvh_leaf_count(child));
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
    const uint16_t *materials = view->materials;
    *uniform_out = materials != NULL ? materials[0] : 0;
    // All are equal where each equals the next one.
    if (materials != NULL &&
        memcmp(materials, materials + 1, ((size_t)view->triangle_count - 1) * sizeof *materials) != 0) {
        *uniform_out = 0;
        return true;
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
    soup->triangle_count = b->mesh->triangle_count + b->coincident.word_count - b->coincident.lane_count;
    soup->coincident_words = b->coincident.word_count;
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
    const uint32_t version = head->coincident_words > 0 ? TL_SOUP_VERSION : TL_SOUP_VERSION_ALONE;
    tl_soup *soup = tl_blob_allocate_part(allocator, TL_SOUP_MAGIC, version, tl_soup_place_arrays(head),
                                          sizeof(tl_soup), head->leaf_offset + head->leaf_bytes);
    if (soup != NULL) {
        head->blob = soup->blob;
        *soup = *head;
    }
    return soup;
}

static tl_result write_soup(tl_soup_encoder *b, tl_arena *arena, tl_soup **soup_out)
{
    if (b->leaf_bytes / TL_SOUP_LEAF_ALIGN > TL_MAX_LEAF_UNITS) {
        return TL_ERR_LIMIT;
    }
    if (b->tree->ref_count != b->pair_count) {
        TL_TRY(mark_copies(b, arena));
    }
    tl_compact_plan plan = { 0 };
    if (b->layout == TL_SOUP_COMPACT) {
        TL_TRY(tl_compact_plan_vertices(b, arena, &plan));
    }
    b->plan = &plan;
    tl_soup head;
    fill_head(b, &head);
    tl_soup *soup = allocate_soup(&head, &arena->allocator);
    if (soup == NULL) {
        return TL_ERR_MEMORY;
    }
    *soup_out = soup;
    b->soup = soup;
    node_range all = { b, 0, b->node_count };
    TL_TRY(tl_stage_run(b->stage, write_block, tl_block_count(b->node_count, BLOCK_NODES), &all, NODE_BATCH,
                        b->view->triangle_count));
    if (b->layout == TL_SOUP_COMPACT) {
        TL_TRY(tl_compact_write_vertices(b));
    }
    TL_TRY(tl_stage_copy(b->stage, (char *)soup + soup->coincident_offset, b->coincident.words,
                         soup->coincident_words * sizeof(uint32_t)));
    return soup->has_materials ? tl_stage_copy(b->stage, (char *)soup + soup->material_offset, b->view->materials,
                                               (uint64_t)b->view->triangle_count * sizeof(uint16_t))
                               : TL_OK;
}

tl_result tl_soup_encode(const tl_soup_parts *parts, tl_soup_layout layout, tl_stage *stage, tl_arena *arena,
                         tl_soup **soup_out)
{
    tl_soup_encoder b = { .view = parts->view, .mesh = parts->mesh, .pairs = parts->pairs, .tree = parts->bvh };
    b.pair_count = parts->pair_count;
    b.coincident = parts->coincident;
    b.stage = stage;
    b.layout = layout;
    tl_soup *soup = NULL;
    tl_result result = collapse_tree(&b, parts->bvh, &arena->allocator);
    if (result == TL_OK) {
        result = write_soup(&b, arena, &soup);
    }
    tl_release_array(&arena->allocator, b.wide, b.wide_capacity, sizeof *b.wide);
    if (result != TL_OK) {
        tl_blob_free(soup);
        soup = NULL;
    }
    *soup_out = soup;
    return result;
}
