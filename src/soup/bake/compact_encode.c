// SPDX-License-Identifier: MIT
//
// Writes the compact layout (compact_layout.h).

#include "soup/bake/soup_encode.h"

#include "base/assert.h"

#include <float.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// Vertices.

typedef struct numbering {
    tl_compact_plan *plan;
    uint32_t *latest; // the latest number of a mesh vertex, UINT32_MAX: none
    uint32_t pair_count;
} numbering;

// A group counts from so far back that its own new vertices are within reach too.
static void begin_group(numbering *n)
{
    uint32_t reach = TL_COMPACT_WINDOW - 4 * TL_COMPACT_GROUP, count = n->plan->vertex_count;
    n->plan->groups[n->pair_count / TL_COMPACT_GROUP] = count > reach ? count - reach : 0;
}

static void number_pair(numbering *n, const tl_triangle_pair *pair)
{
    static const uint8_t order[4] = { 0, 2, 1, 3 }; // a, c, b, d
    tl_compact_plan *plan = n->plan;
    if (n->pair_count % TL_COMPACT_GROUP == 0) {
        begin_group(n);
    }
    uint32_t base = plan->groups[n->pair_count / TL_COMPACT_GROUP];
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t vertex = pair->corner[order[k]];
        if (n->latest[vertex] == UINT32_MAX || n->latest[vertex] < base) {
            n->latest[vertex] = plan->vertex_count;
            plan->vertices[plan->vertex_count++] = vertex;
        }
        plan->corners[n->pair_count][k] = (uint16_t)(n->latest[vertex] - base);
    }
    n->pair_count++;
}

tl_result tl_compact_plan_vertices(const tl_soup_encoder *baker, tl_arena *arena, tl_compact_plan *plan)
{
    uint32_t pairs = baker->tree->ref_count;
    memset(plan, 0, sizeof *plan);
    // Each pair names at most four new vertices.
    if (pairs > UINT32_MAX / 4) {
        return TL_ERR_LIMIT;
    }
    numbering n = { plan, TL_PUSH(arena, uint32_t, baker->mesh->vertex_count), 0 };
    plan->corners = tl_arena_push(arena, pairs, sizeof *plan->corners);
    plan->groups = TL_PUSH(arena, uint32_t, tl_compact_group_count(pairs));
    plan->vertices = TL_PUSH(arena, uint32_t, 4 * (uint64_t)pairs);
    if (n.latest == NULL || plan->corners == NULL || plan->groups == NULL || plan->vertices == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(n.latest, 0xff, baker->mesh->vertex_count * sizeof *n.latest);
    for (uint32_t i = 0; i < baker->node_count; i++) {
        const tl_wide_node *wide = &baker->wide[i];
        for (uint32_t k = 0; k < wide->child_count; k++) {
            const tl_bvh_node *child = &baker->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF];
            for (uint32_t r = 0; r < tl_bvh_leaf_count(child); r++) {
                number_pair(&n, &baker->pairs[baker->tree->refs[child->link + r].pair]);
                TL_TRY(tl_stage_tick(baker->stage, n.pair_count));
            }
        }
    }
    TL_ASSERT(n.pair_count == pairs);
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Nodes.

static tl_aabb box_of_child(const tl_soup_encoder *b, const tl_wide_node *wide, uint32_t k)
{
    return b->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF].box;
}

// The smallest power of two whose steps, as they round, reach from `low` to `high`.
static float choose_scale(float low, float high)
{
    float scale = FLT_MIN;
    while (low + (float)TL_COMPACT_STEPS * scale < high) {
        scale *= 2.0f;
    }
    return scale;
}

// The largest step whose plane is at most `at`, or the smallest whose plane is at least that.
static uint8_t step_below(const tl_compact_node *node, uint32_t axis, float at)
{
    float guess = (at - node->origin[axis]) / node->scale[axis];
    uint32_t step = guess < (float)TL_COMPACT_STEPS ? (uint32_t)guess : TL_COMPACT_STEPS;
    while (step > 0 && tl_compact_plane(node, axis, (uint8_t)step) > at) {
        step--;
    }
    return (uint8_t)step;
}

static uint8_t step_above(const tl_compact_node *node, uint32_t axis, float at)
{
    uint32_t step = step_below(node, axis, at);
    while (step < TL_COMPACT_STEPS && tl_compact_plane(node, axis, (uint8_t)step) < at) {
        step++;
    }
    return (uint8_t)step;
}

static void write_boxes(const tl_soup_encoder *b, const tl_wide_node *wide, tl_compact_node *node)
{
    tl_aabb all = tl_aabb_empty();
    for (uint32_t k = 0; k < wide->child_count; k++) {
        all = tl_aabb_union(all, box_of_child(b, wide, k));
    }
    const float low[3] = { all.min.x, all.min.y, all.min.z }, high[3] = { all.max.x, all.max.y, all.max.z };
    for (uint32_t axis = 0; axis < 3; axis++) {
        node->origin[axis] = low[axis];
        node->scale[axis] = choose_scale(low[axis], high[axis]);
    }
    for (uint32_t k = 0; k < wide->child_count; k++) {
        tl_aabb box = box_of_child(b, wide, k);
        const float min[3] = { box.min.x, box.min.y, box.min.z }, max[3] = { box.max.x, box.max.y, box.max.z };
        for (uint32_t axis = 0; axis < 3; axis++) {
            node->plane[2 * axis][k] = step_below(node, axis, min[axis]);
            node->plane[2 * axis + 1][k] = step_above(node, axis, max[axis]);
            TL_ASSERT(tl_compact_plane(node, axis, node->plane[2 * axis][k]) <= min[axis] &&
                      tl_compact_plane(node, axis, node->plane[2 * axis + 1][k]) >= max[axis]);
        }
    }
    node->mask = (1u << wide->child_count) - 1u;
}

static void write_compact_pairs(const tl_soup_encoder *b, const tl_bvh_node *leaf, uint32_t first, tl_compact_pair *out)
{
    for (uint32_t i = 0; i < tl_bvh_leaf_count(leaf); i++) {
        for (uint32_t k = 0; k < 2; k++) {
            out[first + i].ids[k] = tl_encode_id(b, &b->tree->refs[leaf->link + i], k);
        }
        memcpy(out[first + i].corner, b->plan->corners[first + i], sizeof out->corner);
    }
}

void tl_compact_write_node(const tl_soup_encoder *b, uint32_t index)
{
    const tl_wide_node *wide = &b->wide[index];
    tl_compact_node *node = (tl_compact_node *)(void *)((char *)b->soup + b->soup->node_offset) + index;
    tl_compact_pair *pairs = (tl_compact_pair *)(void *)((char *)b->soup + b->soup->leaf_offset);
    uint32_t next_node = wide->first_inner, next_pair = (uint32_t)(wide->leaf_offset / sizeof *pairs);
    memset(node, 0, sizeof *node);
    write_boxes(b, wide, node);
    for (uint32_t k = 0; k < wide->child_count; k++) {
        if ((wide->child[k] & TL_WIDE_LEAF) != 0) {
            const tl_bvh_node *leaf = &b->tree->nodes[wide->child[k] & ~TL_WIDE_LEAF];
            node->child[k] = tl_child_of_leaf(next_pair * sizeof *pairs, tl_bvh_leaf_count(leaf));
            write_compact_pairs(b, leaf, next_pair, pairs);
            next_pair += tl_bvh_leaf_count(leaf);
        } else {
            node->child[k] = next_node++;
        }
    }
}

enum { COMPACT_BLOCK_VERTICES = 1 << 14 };

static void write_block_of_vertices(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const tl_soup_encoder *b = user;
    tl_vec3 *vertices = (tl_vec3 *)(void *)((char *)b->soup + b->soup->vertex_offset);
    uint32_t end = tl_block_end(block, COMPACT_BLOCK_VERTICES, b->plan->vertex_count);
    for (uint32_t i = block * COMPACT_BLOCK_VERTICES; i < end; i++) {
        vertices[i] = b->mesh->vertices[b->plan->vertices[i]];
    }
}

tl_result tl_compact_write_vertices(const tl_soup_encoder *b)
{
    uint32_t groups = tl_compact_group_count(b->tree->ref_count);
    memcpy((char *)b->soup + b->soup->group_offset, b->plan->groups, groups * sizeof(uint32_t));
    return tl_stage_run(b->stage, write_block_of_vertices,
                        tl_block_count(b->plan->vertex_count, COMPACT_BLOCK_VERTICES), (void *)(uintptr_t)b, 64, 0);
}
