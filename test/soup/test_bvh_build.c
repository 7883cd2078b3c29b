// SPDX-License-Identifier: MIT
//
// bvh_build.c with bvh_split.c, and kd_build.c: every pair is in a leaf, every box holds what is below it, and the
// tree pays.

#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"
#include "soup_models.h"

typedef struct walk {
    const tl_mesh *mesh;
    const tl_triangle_pair *pairs;
    const tl_bvh *tree;
    uint32_t *seen; // references to each pair
    uint32_t references, leaves, depth;
    uint32_t nodes;              // met so far, in preorder
    uint32_t inner, overlapping; // nodes, and those whose children share more than a plane
    double cost;                 // surface of all nodes' boxes over the root's, leaves only
} walk;

static bool holds(tl_aabb outer, tl_aabb inner)
{
    return tl_aabb_contains(outer, inner.min) && tl_aabb_contains(outer, inner.max);
}

// Cuts are rounded outward, so even boxes that a plane parts share a sliver.
static bool share_space(tl_aabb a, tl_aabb b)
{
    tl_aabb both = tl_aabb_intersection(a, b);
    if (tl_aabb_is_empty(both)) {
        return false;
    }
    tl_vec3 size = tl_aabb_size(both), whole = tl_aabb_size(tl_aabb_union(a, b));
    return size.x > 1e-5f * whole.x && size.y > 1e-5f * whole.y && size.z > 1e-5f * whole.z;
}

static void check_node(walk *w, uint32_t index, uint32_t depth)
{
    const tl_bvh_node *node = &w->tree->nodes[index];
    w->depth = depth > w->depth ? depth : w->depth;
    const uint32_t count = tl_bvh_leaf_count(node);
    TEST_CHECK(index == w->nodes++);
    if (count == 0) {
        const tl_bvh_node *left = &w->tree->nodes[index + 1], *right = &w->tree->nodes[node->link];
        TEST_CHECK(node->link > index + 1 && node->link < w->tree->node_count);
        TEST_CHECK(holds(node->box, left->box));
        TEST_CHECK(holds(node->box, right->box));
        w->inner++;
        w->overlapping += share_space(left->box, right->box);
        check_node(w, index + 1, depth + 1);
        check_node(w, node->link, depth + 1);
        return;
    }
    TEST_CHECK(count <= TL_SOUP_LEAF_PAIRS);
    for (uint32_t i = 0; i < count; i++) {
        const tl_bvh_ref *ref = &w->tree->refs[node->link + i];
        tl_aabb box = { ref->min, ref->max };
        TEST_CHECK(holds(node->box, box));
        w->seen[ref->pair]++;
    }
    w->references += count;
    w->leaves++;
    w->cost += (double)tl_aabb_half_area(node->box);
}

static walk check_tree(const model *m, tl_soup_partition partition, float split_budget)
{
    tl_mesh_view view = model_view(m);
    tl_mesh_def mesh_def = tl_default_mesh_def();
    mesh_def.keep_duplicates = true;
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(&view, &mesh_def, &mesh, NULL), TL_OK);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_triangle_pair *pairs = NULL;
    uint32_t count;
    TEST_RESULT(tl_pair_triangles(&mesh, true, NULL, &arena, &pairs, &count), TL_OK);
    const tl_bvh_input input = { &mesh, pairs, count, split_budget };
    bool kd = partition == TL_SOUP_KD_TREE;
    tl_bvh tree;
    TEST_RESULT((kd ? tl_kd_build : tl_bvh_build)(&input, NULL, &arena, &tree), TL_OK);
    walk w = { &mesh, pairs, &tree, TL_PUSH_ZERO(&arena, uint32_t, count), 0, 0, 0, 0, 0, 0, 0 };
    check_node(&w, 0, 1);
    TEST_CHECK(w.nodes == tree.node_count && w.leaves == tree.node_count / 2 + 1);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(w.seen[i] >= 1 && (kd || split_budget > 0 || w.seen[i] == 1));
    }
    // Only the nodes between parts are in none.
    uint32_t in_parts = 0;
    for (uint32_t i = 0; i < tree.part_count; i++) {
        TEST_CHECK(i == 0 || tree.parts[i].first >= tree.parts[i - 1].first + tree.parts[i - 1].count);
        in_parts += tree.parts[i].count;
    }
    TEST_CHECK(kd ? tree.part_count == 0 : in_parts + tree.part_count - 1 == tree.node_count);
    TEST_CHECK(fabs(tree.leaf_surface - w.cost) <= 1e-9 * w.cost);
    TEST_CHECK(w.references == tree.ref_count && w.depth <= TL_SOUP_MAX_DEPTH);
    TEST_CHECK(kd || w.references <= (uint32_t)((float)count * (1 + split_budget)) + 1);
    w.cost /= (double)tl_aabb_half_area(tree.nodes[0].box);
    tl_arena_free(&arena);
    tl_mesh_free(&mesh);
    return w;
}

static void test_shapes(void **state)
{
    (void)state;
    for (uint32_t count = 1; count < 60; count++) {
        model m = model_random(count, 5, 1, count);
        check_tree(&m, TL_SOUP_BVH, 0);
        check_tree(&m, TL_SOUP_BVH, 0.5f);
        check_tree(&m, TL_SOUP_KD_TREE, 0);
        model_free(&m);
    }
    model m = model_random(3000, 10, 3, 1);
    walk plain = check_tree(&m, TL_SOUP_BVH, 0);
    TEST_CHECK(plain.leaves > 3000 / 4 && plain.depth < 40);
    check_tree(&m, TL_SOUP_BVH, 0.3f);
    model_free(&m);
}

// Nothing tells these apart: the tree is balanced by count, not a chain.
static void test_coinciding_triangles(void **state)
{
    (void)state;
    model m = { 0 };
    for (uint32_t i = 0; i < 5000; i++) {
        uint32_t a = model_vertex(&m, 0, 0, (float)(i % 2));
        model_vertex(&m, 1, 0, 0);
        model_vertex(&m, 0, 1, 0);
        model_triangle(&m, a, a + 1, a + 2);
    }
    TEST_CHECK(check_tree(&m, TL_SOUP_BVH, 0.2f).depth < 20);
    TEST_CHECK(check_tree(&m, TL_SOUP_KD_TREE, 0).depth < 20);
    model_free(&m);
}

// Sizes that halve toward a corner make a chain of the heuristic; the depth stays bounded.
static void test_depth_is_bounded(void **state)
{
    (void)state;
    model m = { 0 };
    for (uint32_t i = 0; i < 4000; i++) {
        float size = ldexpf(1.0f + (float)(i / 200) * 0.01f, 30 - (int)(i % 150));
        uint32_t a = model_vertex(&m, size, 0, 0);
        model_vertex(&m, size * 1.5f, 0, 0);
        model_vertex(&m, size, size, size * 0.5f);
        model_triangle(&m, a, a + 1, a + 2);
    }
    walk w = check_tree(&m, TL_SOUP_BVH, 0.2f);
    TEST_CHECK(w.depth > 30);
    w = check_tree(&m, TL_SOUP_KD_TREE, 0);
    TEST_CHECK(w.depth < 40);
    model_free(&m);
}

static void test_tree_pays(void **state)
{
    (void)state;
    model m = model_terrain(60, 3, tl_vec3_make(0, 0, 0), 1);
    walk w = check_tree(&m, TL_SOUP_BVH, 0);
    print_message("terrain: %u leaves, depth %u, leaf surface %.2f of the root's\n", w.leaves, w.depth, w.cost);
    // One leaf of all pairs would cost 1 a block: over a thousand blocks.
    TEST_CHECK(w.cost < 40);
    model_free(&m);
}

// Large triangles, all across each other: boxes overlap, cells do not.
static void test_cells_part_space(void **state)
{
    (void)state;
    model m = model_random(3000, 10, 3, 1);
    walk boxes = check_tree(&m, TL_SOUP_BVH, 0), cells = check_tree(&m, TL_SOUP_KD_TREE, 0);
    print_message("children share space in %u of %u nodes, in cells in %u of %u; %u and %u references\n",
                  boxes.overlapping, boxes.inner, cells.overlapping, cells.inner, boxes.references, cells.references);
    TEST_CHECK(boxes.overlapping > boxes.inner / 2 && cells.references > boxes.references);
    // Only where more pairs meet than a leaf holds are they shared out by count.
    TEST_CHECK(cells.overlapping < cells.inner / 2);
    model_free(&m);
}

// Pairs around one corner, which no plane separates: twice as many take twice the memory, not four times.
static void test_fans_grow_linearly(void **state)
{
    (void)state;
    uint64_t before = 0;
    for (uint32_t count = 1000; count <= 16000; count *= 2) {
        model m = { 0 };
        const uint32_t hub = model_vertex(&m, 0, 0, 0);
        for (uint32_t i = 0; i <= count; i++) {
            const float turn = 6.2831853f * (float)i / (float)count;
            model_vertex(&m, 10 * cosf(turn), 0.3f * (float)(i % 7), 10 * sinf(turn));
        }
        for (uint32_t i = 1; i <= count; i++) {
            model_triangle(&m, hub, i, i + 1);
        }
        const walk cells = check_tree(&m, TL_SOUP_KD_TREE, 0);
        test_allocator memory;
        test_allocator_init(&memory, 0);
        tl_soup_def def = model_soup_def(MODEL_KD);
        def.host.allocator = &memory.allocator;
        tl_soup *soup = model_soup(&m, &def);
        TEST_CHECK(cells.references <= 16 * tl_soup_get_stats(soup).pair_count);
        TEST_CHECK(before == 0 || memory.peak_bytes < before * 5 / 2);
        before = memory.peak_bytes;
        tl_blob_free(soup);
        model_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),           cmocka_unit_test(test_coinciding_triangles),
        cmocka_unit_test(test_depth_is_bounded), cmocka_unit_test(test_tree_pays),
        cmocka_unit_test(test_cells_part_space), cmocka_unit_test(test_fans_grow_linearly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
