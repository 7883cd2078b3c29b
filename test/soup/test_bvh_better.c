// SPDX-License-Identifier: MIT
//
// The better of two trees: with spatial splits where they pay, else without, and never the worse one.

#include "base/assert.h"
#include "soup/bake/bvh_split.h"
#include "soup_models.h"

static double cost_of(const tl_bvh *tree)
{
    return (double)TL_BVH_TRAVERSAL_COST * tree->inner_surface + tree->leaf_surface;
}

typedef enum choice { NOTHING_SPLIT, SPLITS_KEPT, SPLITS_DROPPED } choice;

static tl_arena arenas[2];

// The sums of surfaces that are compared, from the tree itself.
static void check_sums(const tl_bvh *tree)
{
    double inner = 0.0, leaves = 0.0;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        double surface = (double)tl_aabb_half_area(tree->nodes[i].box);
        *(tl_bvh_leaf_count(&tree->nodes[i]) > 0 ? &leaves : &inner) += surface;
    }
    TEST_CHECK(fabs(tree->inner_surface - inner) <= 1e-9 * inner && fabs(tree->leaf_surface - leaves) <= 1e-9 * leaves);
}

static choice choose(const model *m)
{
    tl_mesh_view view = model_view(m);
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(&view, NULL, &mesh, NULL), TL_OK);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_triangle_pair *pairs = NULL;
    uint32_t count;
    TEST_RESULT(tl_pair_triangles(&mesh, true, NULL, &arena, &pairs, &count), TL_OK);
    tl_bvh_input input = { &mesh, pairs, count, 0.2f };
    tl_bvh better, split, whole;
    tl_arena_init(&arenas[0], NULL);
    tl_arena_init(&arenas[1], NULL);
    TEST_RESULT(tl_bvh_build_better(&input, NULL, arenas, &better), TL_OK);
    // Only the tree that is kept takes memory.
    TEST_CHECK((arenas[0].live_bytes == 0) != (arenas[1].live_bytes == 0));
    TEST_RESULT(tl_bvh_build(&input, NULL, &arena, &split), TL_OK);
    input.split_budget = 0.0f;
    TEST_RESULT(tl_bvh_build(&input, NULL, &arena, &whole), TL_OK);
    check_sums(&better);
    check_sums(&split);
    check_sums(&whole);
    TEST_CHECK(whole.ref_count == count && split.ref_count >= count && split.ref_count <= count + count / 5);
    TEST_CHECK(cost_of(&better) <= cost_of(&whole));
    choice chosen = split.ref_count == count ? NOTHING_SPLIT : better.ref_count > count ? SPLITS_KEPT : SPLITS_DROPPED;
    const tl_bvh *expected = chosen == SPLITS_DROPPED ? &whole : &split;
    TEST_CHECK(better.node_count == expected->node_count);
    TEST_CHECK(memcmp(better.nodes, expected->nodes, better.node_count * sizeof *better.nodes) == 0);
    TEST_CHECK(chosen != SPLITS_KEPT || cost_of(&split) <= 0.97 * cost_of(&whole));
    TEST_CHECK(chosen != SPLITS_DROPPED || cost_of(&split) > 0.97 * cost_of(&whole));
    tl_arena_free(&arenas[0]);
    tl_arena_free(&arenas[1]);
    tl_arena_free(&arena);
    tl_mesh_free(&mesh);
    return chosen;
}

// Long thin beams in all directions among small triangles.
static model beams(uint32_t beam_count, uint32_t small_count, float length)
{
    test_random random = { 5 };
    model m = model_random(small_count, 20, 0.5f, 3);
    for (uint32_t i = 0; i < beam_count; i++) {
        tl_vec3 low = { -20, -20, -20 }, high = { 20, 20, 20 };
        tl_vec3 at = test_random_point(&random, low, high), along = test_random_direction(&random);
        tl_vec3 end = tl_mul_add(at, along, length);
        uint32_t a = model_vertex(&m, at.x, at.y, at.z);
        model_vertex(&m, end.x, end.y, end.z);
        model_vertex(&m, at.x, at.y + 0.1f, at.z);
        model_triangle(&m, a, a + 1, a + 2);
    }
    return m;
}

static void test_what_is_kept(void **state)
{
    (void)state;
    model terrain = model_terrain(40, 2, tl_vec3_make(0, 0, 0), 1);
    TEST_CHECK(choose(&terrain) == NOTHING_SPLIT);
    model_free(&terrain);
    model crossing = beams(500, 3000, 20);
    TEST_CHECK(choose(&crossing) == SPLITS_KEPT);
    model_free(&crossing);
    uint32_t dropped = 0;
    for (uint32_t i = 0; i < 12; i++) {
        model few = beams(4 + 4 * i, 3000, 4.0f);
        dropped += choose(&few) == SPLITS_DROPPED;
        model_free(&few);
    }
    TEST_CHECK(dropped > 0);
    for (uint32_t count = 1; count < 40; count++) {
        model small = model_random(count, 5, 4, count);
        (void)choose(&small);
        model_free(&small);
    }
}

// A bake does what its quality says.
static void test_quality(void **state)
{
    (void)state;
    model m = beams(500, 3000, 20);
    static const tl_soup_quality qualities[3] = { TL_SOUP_QUALITY_FAST, TL_SOUP_QUALITY_DEFAULT, TL_SOUP_QUALITY_HIGH };
    uint32_t references[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_soup_def def = tl_default_soup_def();
        def.quality = qualities[i];
        tl_soup *soup = model_soup(&m, &def);
        TEST_RESULT(tl_soup_check(soup, tl_soup_size(soup), NULL), TL_OK);
        references[i] = tl_soup_get_stats(soup).reference_count;
        tl_blob_free(soup);
    }
    TEST_CHECK(references[0] < references[1] && references[1] < references[2]);
    TEST_CHECK(references[1] <= references[0] + references[0] / 5);
    TEST_CHECK(references[2] <= references[0] + references[0] / 2);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_kept),
        cmocka_unit_test(test_quality),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
