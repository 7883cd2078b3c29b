// SPDX-License-Identifier: MIT
//
// The search over directions alone, where EPA would not ask for it: it starts from nothing but "not infinitely deep"
// and must come to the same depth as all face normals and edge pairs tried.

#include "talus_test.h"

#include "convex_oracle.h"

#include "convex/depth/direction_search.h"

#include <string.h>

static void test_matches_brute_force(void **state)
{
    (void)state;
    static oracle_body oracle_a, oracle_b;
    test_random random = { 61 };
    uint32_t cases = 0, converged = 0, most = 0;
    double worst = 0.0;
    for (int i = 0; i < BODY_COUNT * BODY_COUNT; i++) {
        test_body a, b;
        float scale = i % 3 == 0 ? 1.0f : i % 3 == 1 ? 1e-5f : 1e4f;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, scale);
        test_body_make(&b, (body_family)(i / BODY_COUNT), (uint64_t)i + 500, scale);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 ? GAP_DEEP : GAP_CONCENTRIC, &pose_a, &pose_b);
        test_body_oracle(&a, pose_a, &oracle_a);
        test_body_oracle(&b, pose_b, &oracle_b);
        double size = (double)tl_maxf(a.size, b.size);
        double expected = oracle_distance(&oracle_a, &oracle_b) > 0.0 ? 0.0 : oracle_depth(&oracle_a, &oracle_b);
        if (expected > 1e-3 * size && expected < (double)INFINITY) {
            tl_minkowski pair;
            tl_core_depth depth;
            tl_minkowski_init(&pair, &a.shape, &pose_a, &b.shape, &pose_b);
            memset(&depth, 0, sizeof depth);
            depth.upper = 4.0 * size;
            tl_direction_search(&pair, &depth);
            worst = fmax(worst, fabs(depth.upper - expected) / size);
            TEST_CHECK(depth.lower <= expected + 1e-9 * size && depth.upper >= expected - 1e-6 * size);
            TEST_CHECK(fabs(tl_vec3d_length(depth.normal) - 1.0) < 1e-12);
            tl_vec3d apart = tl_vec3d_sub(depth.on_a, depth.on_b);
            TEST_CHECK(tl_vec3d_length(tl_vec3d_mul_add(apart, depth.normal, -depth.upper)) < 1e-5 * size);
            most = depth.iterations > most ? depth.iterations : most;
            converged += depth.status == TL_CONVEX_CONVERGED;
            cases++;
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("%u cases, %u converged, worst error %g of the size, at most %u steps\n", cases, converged, worst,
                  most);
    TEST_CHECK(cases > 80 && converged == cases && worst < 2e-6);
}

// The witnesses are those of a moved pair; what a query has placed before does not move along.
static void test_placed_hulls_move(void **state)
{
    (void)state;
    test_random random = { 62 };
    for (int i = 0; i < 200; i++) {
        tl_vec3 points[2][8];
        tl_hull *hulls[2];
        for (int side = 0; side < 2; side++) {
            for (int k = 0; k < 8; k++) {
                points[side][k] = test_random_direction(&random);
            }
            TEST_CHECK(tl_hull_bake(points[side], 8, NULL, &hulls[side], NULL) == TL_OK);
        }
        const tl_convex a = tl_convex_from_hull(hulls[0], 0.0f), b = tl_convex_from_hull(hulls[1], 0.0f);
        const tl_transform pose = tl_transform_identity();
        tl_minkowski pair;
        tl_core_depth depth;
        TEST_CHECK(tl_minkowski_init(&pair, &a, &pose, &b, &pose));
        tl_minkowski_place_hulls(&pair);
        TEST_CHECK(pair.is_placed);
        memset(&depth, 0, sizeof depth);
        depth.upper = 4.0;
        tl_direction_search(&pair, &depth);
        const tl_vec3d apart = tl_vec3d_sub(depth.on_a, depth.on_b);
        TEST_CHECK(tl_vec3d_length(tl_vec3d_mul_add(apart, depth.normal, -depth.upper)) < 1e-5);
        tl_blob_free(hulls[0]);
        tl_blob_free(hulls[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_matches_brute_force),
                                        cmocka_unit_test(test_placed_hulls_move) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
