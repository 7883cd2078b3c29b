// SPDX-License-Identifier: MIT
//
// bvh_order.c: probabilities by hand and their bounds in random trees, and the order that they give.

#include "soup/bake/bvh_order.h"

#include "soup_models.h"

static tl_aabb box_of(float x, float y, float z, float size_x, float size_y, float size_z)
{
    tl_aabb box = { tl_vec3_make(x, y, z), tl_vec3_make(x + size_x, y + size_y, z + size_z) };
    return box;
}

static tl_bvh_node leaf_of(tl_aabb box, uint32_t first, uint32_t count)
{
    tl_bvh_node node = { box, first, TL_BVH_LEAF + count };
    return node;
}

// A wall that fills its box, and a small square in a large box.
static void test_chances_by_hand(void **state)
{
    (void)state;
    const tl_aabb wall = box_of(0, 0, 0, 4, 2, 0), room = box_of(0, 0, 0, 4, 4, 4), square = box_of(1, 1, 1, 2, 2, 0);
    tl_bvh_ref refs[2] = { { wall.min, 0, wall.max, 0 }, { square.min, 1, square.max, 0 } };
    tl_bvh_node nodes[3] = { { .box = room, .link = 2 }, leaf_of(wall, 0, 1), leaf_of(room, 1, 1) };
    tl_bvh tree = { .refs = refs, .nodes = nodes, .node_count = 3, .ref_count = 2 };
    float chance[3];
    for (uint32_t i = 3; i-- > 0;) {
        tl_bvh_order_node(&tree, i, chance);
    }
    // Half areas: wall 8, room 48, square 4.
    TEST_CHECK(chance[1] == 1.0f);
    TEST_CHECK(fabs((double)chance[2] - 4.0 / 48.0) < 1e-6);
    TEST_CHECK(fabs((double)chance[0] - (1.0 - (1.0 - 8.0 / 48.0) * (1.0 - 4.0 / 48.0))) < 1e-6);
}

// A node stops no fewer rays than either of its halves does.
static uint32_t check_node(const tl_bvh *tree, float *chance, uint32_t index)
{
    const tl_bvh_node *node = &tree->nodes[index];
    if (tl_bvh_leaf_count(node) > 0) {
        tl_bvh_order_node(tree, index, chance);
        TEST_CHECK(chance[index] >= 0.0f && chance[index] <= 1.0f);
        return 1;
    }
    const uint32_t halves[2] = { index + 1, node->link };
    uint32_t checked = 1 + check_node(tree, chance, halves[0]) + check_node(tree, chance, halves[1]);
    tl_bvh_order_node(tree, index, chance);
    TEST_CHECK(chance[index] >= 0.0f && chance[index] <= 1.0f);
    for (uint32_t k = 0; k < 2; k++) {
        float share = tl_aabb_half_area(tree->nodes[halves[k]].box) / tl_aabb_half_area(node->box);
        TEST_CHECK(chance[index] >= share * chance[halves[k]] - 1e-5f);
    }
    return checked;
}

static void test_random_trees(void **state)
{
    (void)state;
    uint32_t checked = 0;
    for (uint32_t seed = 1; seed < 20; seed++) {
        model m = model_random(50 * seed, 10, 2, seed);
        tl_mesh_view view = model_view(&m);
        tl_mesh mesh;
        TEST_RESULT(tl_mesh_bake(&view, NULL, &mesh, NULL), TL_OK);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_triangle_pair *pairs = NULL;
        uint32_t count;
        TEST_RESULT(tl_pair_triangles(&mesh, true, NULL, &arena, &pairs, &count), TL_OK);
        const tl_bvh_input input = { &mesh, pairs, count, 0.0f };
        tl_bvh tree;
        TEST_RESULT(tl_bvh_build(&input, NULL, &arena, &tree), TL_OK);
        float *chance = TL_PUSH(&arena, float, tree.node_count);
        TEST_CHECK(chance != NULL);
        checked += check_node(&tree, chance, 0);
        tl_arena_free(&arena);
        tl_mesh_free(&mesh);
        model_free(&m);
    }
    TEST_CHECK(checked > 3000);
}

static void test_order(void **state)
{
    (void)state;
    const float chance[6] = { 0.5f, 0.25f, 1.0f, 0.5f, 0.0f, 0.5f };
    uint32_t children[6] = { 5, 4, 3, 2, 1, 0 };
    const uint32_t expected[6] = { 2, 5, 3, 0, 1, 4 };
    tl_bvh_order_children(chance, children, 6);
    for (uint32_t i = 0; i < 6; i++) {
        TEST_CHECK(children[i] == expected[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chances_by_hand),
        cmocka_unit_test(test_random_trees),
        cmocka_unit_test(test_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
