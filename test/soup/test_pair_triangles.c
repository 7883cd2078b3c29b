// SPDX-License-Identifier: MIT
//
// pair_triangles.c: a valid matching on any input, and nearly everything paired on manifold ones.

#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"
#include "soup_models.h"

typedef struct paired {
    uint32_t triangles, in_pairs;
} paired;

static void check_corners(const tl_mesh *mesh, const tl_triangle_pair *pair, uint32_t side, uint32_t triangle)
{
    uint32_t slot[3] = { pair->corner[0], pair->corner[side == 0 ? 1 : 3], pair->corner[2] };
    const uint32_t *indices = mesh->indices + 3 * (size_t)triangle;
    for (uint32_t k = 0; k < 3; k++) {
        TEST_CHECK(slot[tl_soup_corner_slots[tl_id_order(pair->id[side])][k]] == indices[k]);
    }
}

static paired check_pairing(const model *m, bool allow_pairs)
{
    tl_mesh_view view = model_view(m);
    tl_mesh_def def = tl_default_mesh_def();
    def.keep_duplicates = true;
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, NULL), TL_OK);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_triangle_pair *pairs = NULL;
    uint8_t *seen = calloc(mesh.triangle_count, 1);
    uint32_t *triangle_of = malloc((m->triangle_count + 1) * sizeof *triangle_of);
    TEST_CHECK(seen != NULL && triangle_of != NULL);
    memset(triangle_of, 0xff, (m->triangle_count + 1) * sizeof *triangle_of);
    for (uint32_t i = 0; i < mesh.triangle_count; i++) {
        triangle_of[mesh.source_triangles[i]] = i;
    }
    uint32_t count = 0;
    TEST_RESULT(tl_pair_triangles(&mesh, allow_pairs, NULL, &arena, &pairs, &count), TL_OK);
    paired result = { mesh.triangle_count, 0 };
    for (uint32_t i = 0; i < count; i++) {
        bool single = pairs[i].id[1] == TL_ID_NONE;
        for (uint32_t side = 0; side < (single ? 1u : 2u); side++) {
            const uint32_t source = pairs[i].id[side] & TL_ID_INDEX;
            TEST_CHECK(source < m->triangle_count && triangle_of[source] < mesh.triangle_count);
            TEST_CHECK(!seen[triangle_of[source]]);
            seen[triangle_of[source]] = 1;
            check_corners(&mesh, &pairs[i], side, triangle_of[source]);
        }
        TEST_CHECK(!single || pairs[i].corner[3] == pairs[i].corner[0]);
        result.in_pairs += single ? 0 : 2;
    }
    for (uint32_t i = 0; i < mesh.triangle_count; i++) {
        TEST_CHECK(seen[i]);
    }
    free(seen);
    free(triangle_of);
    tl_arena_free(&arena);
    tl_mesh_free(&mesh);
    return result;
}

static double share(paired p)
{
    return (double)p.in_pairs / (double)p.triangles;
}

static void test_quad_is_one_pair(void **state)
{
    (void)state;
    // Every rotation of both triangles, with either winding of the second.
    for (uint32_t first = 0; first < 3; first++) {
        for (uint32_t second = 0; second < 6; second++) {
            model m = { 0 };
            for (uint32_t k = 0; k < 4; k++) {
                model_vertex(&m, k == 1 || k == 2, k >= 2, 0);
            }
            uint32_t a[3] = { 0, 1, 2 };
            uint32_t b[3] = { 0, second < 3 ? 2u : 3u, second < 3 ? 3u : 2u };
            model_triangle(&m, a[first], a[(first + 1) % 3], a[(first + 2) % 3]);
            model_triangle(&m, b[second % 3], b[(second + 1) % 3], b[(second + 2) % 3]);
            TEST_CHECK(check_pairing(&m, true).in_pairs == 2);
            TEST_CHECK(check_pairing(&m, false).in_pairs == 0);
            model_free(&m);
        }
    }
}

// Twenty triangles around one edge, and a triangle given eight times: all find a partner.
static void test_non_manifold_and_duplicates(void **state)
{
    (void)state;
    model m = { 0 };
    model_vertex(&m, 0, 0, 0);
    model_vertex(&m, 0, 1, 0);
    for (uint32_t i = 0; i < 20; i++) {
        uint32_t tip = model_vertex(&m, cosf((float)i), 0.5f, sinf((float)i));
        model_triangle(&m, i % 2, 1 - i % 2, tip);
    }
    TEST_CHECK(check_pairing(&m, true).in_pairs == 20);
    for (uint32_t i = 0; i < 8; i++) {
        model_triangle(&m, 5, 6, 7);
    }
    TEST_CHECK(check_pairing(&m, true).in_pairs == 28);
    model_free(&m);
}

static void test_strip_and_loose(void **state)
{
    (void)state;
    model strip = { 0 };
    for (uint32_t i = 0; i < 402; i++) {
        model_vertex(&strip, (float)(i / 2), (float)(i % 2), 0);
    }
    for (uint32_t i = 0; i < 400; i++) {
        model_triangle(&strip, i + i % 2, i + 1 - i % 2, i + 2);
    }
    TEST_CHECK(check_pairing(&strip, true).in_pairs == 400); // a path has one perfect matching
    model_free(&strip);
    model loose = model_random(500, 5, 1, 3);
    TEST_CHECK(check_pairing(&loose, true).in_pairs == 0);
    model_free(&loose);
    // Unindexed quads: shared corners are equal positions, not equal indices.
    model split = { 0 };
    for (uint32_t i = 0; i < 10; i++) {
        float x = (float)i * 3;
        static const float at[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
        for (uint32_t k = 0; k < 6; k++) {
            model_vertex(&split, x + at[k][0], at[k][1], 0);
        }
        model_triangle(&split, 6 * i, 6 * i + 1, 6 * i + 2);
        model_triangle(&split, 6 * i + 3, 6 * i + 4, 6 * i + 5);
    }
    TEST_CHECK(check_pairing(&split, true).in_pairs == 20);
    model_free(&split);
}

static void test_manifold_share(void **state)
{
    (void)state;
    model m = model_ball(5, 1, 0.1f, tl_vec3_make(0, 0, 0), 1);
    paired p = check_pairing(&m, true);
    print_message("ball: %.2f%% of %u triangles paired\n", 100 * share(p), p.triangles);
    TEST_CHECK(share(p) >= 0.98);
    model_free(&m);
    m = model_terrain(150, 3, tl_vec3_make(0, 0, 0), 1); // some 45,000 triangles: several chunks
    p = check_pairing(&m, true);
    print_message("terrain: %.2f%% of %u triangles paired\n", 100 * share(p), p.triangles);
    TEST_CHECK(share(p) >= 0.98);
    model_free(&m);
    for (uint32_t i = 0; i < sizeof model_levels / sizeof model_levels[0]; i++) {
        m = model_load(model_levels[i]);
        if (m.triangle_count > 0) {
            p = check_pairing(&m, true);
            print_message("%s: %.2f%% of %u triangles paired\n", model_levels[i], 100 * share(p), p.triangles);
            TEST_CHECK(share(p) >= 0.8); // they are not all manifold: loose triangles stay single
        }
        model_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quad_is_one_pair),
        cmocka_unit_test(test_non_manifold_and_duplicates),
        cmocka_unit_test(test_strip_and_loose),
        cmocka_unit_test(test_manifold_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
