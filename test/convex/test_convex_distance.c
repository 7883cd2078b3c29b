// SPDX-License-Identifier: MIT
//
// GJK against brute force: 14 families of bodies in all pairs, 9 classes of gap, four scales; radii, caches, far
// places, custom shapes, nonsense in the cache.

#include "talus_test.h"

#include "convex_oracle.h"

#include <string.h>

static oracle_body oracle_a, oracle_b;

static void test_distance_matches_brute_force(void **state)
{
    (void)state;
    static const float scales[] = { 1.0f, 1e-6f, 1e5f, 0.02f };
    test_random random = { 1 };
    uint32_t seen[GAP_COUNT] = { 0 }, overlaps[GAP_COUNT] = { 0 }, degenerate = 0, cases = 0, most = 0;
    double worst = 0.0, worst_lower = 0.0;
    for (int round = 0; round < 4; round++) {
        for (int pair = 0; pair < BODY_COUNT * BODY_COUNT; pair++) {
            int fa = pair % BODY_COUNT, fb = pair / BODY_COUNT;
            test_body a, b;
            float scale = scales[(fa + fb + round) % 4];
            test_body_make(&a, (body_family)fa, (uint64_t)(fa * 100 + fb + 10000 * round), scale);
            test_body_make(&b, (body_family)fb, (uint64_t)(fb * 100 + fa + 7 + 10000 * round), scale);
            for (int gap = 0; gap < GAP_COUNT; gap++) {
                tl_transform pose_a, pose_b;
                test_place(&random, &a, &b, (gap_class)gap, &pose_a, &pose_b);
                test_body_oracle(&a, pose_a, &oracle_a);
                test_body_oracle(&b, pose_b, &oracle_b);
                double expected = oracle_distance(&oracle_a, &oracle_b);
                double size = (double)tl_maxf(a.size, b.size);
                tl_separation s;
                tl_convex_distance(&a.shape, pose_a, &b.shape, pose_b, NULL, &s);
                // Nothing is wrong by more than a millionth of the size; what is measured is far less.
                TEST_CHECK(s.overlap ? expected <= 1e-6 * size : expected > 0.0 || (double)s.distance <= 1e-6 * size);
                TEST_CHECK(s.status != TL_CONVEX_ITERATIONS);
                TEST_CHECK((double)s.lower_bound <= expected + 1e-12 * size && s.lower_bound <= s.distance);
                double error = fabs((double)s.distance - expected) - 1e-7 * expected;
                worst = fmax(worst, error / size);
                worst_lower = fmax(worst_lower, ((double)s.distance - (double)s.lower_bound - 1e-6 * expected) / size);
                degenerate += s.status == TL_CONVEX_DEGENERATE;
                overlaps[gap] += s.overlap;
                seen[gap]++;
                most = s.iterations > most ? s.iterations : most;
                cases++;
                if (!s.overlap) {
                    // The witness points are apart by the distance, along the normal.
                    double apart = tl_vec3d_length(tl_vec3d_sub(tl_vec3d_from(s.point_a), tl_vec3d_from(s.point_b)));
                    double place = (double)tl_length(pose_b.position) + size;
                    TEST_CHECK(fabs(apart - (double)s.distance) <= 4e-7 * place);
                    TEST_CHECK(fabsf(tl_length(s.normal) - 1.0f) < 1e-6f);
                }
                bool touching = tl_convex_overlap(&a.shape, pose_a, &b.shape, pose_b, NULL);
                TEST_CHECK(touching ? expected <= 1e-6 * size : !s.overlap || expected <= 1e-6 * size);
                // The other way round.
                tl_separation t;
                tl_convex_distance(&b.shape, pose_b, &a.shape, pose_a, NULL, &t);
                TEST_CHECK(fabs((double)s.distance - (double)t.distance) <= 1e-6 * size + 1e-6 * expected);
            }
            test_body_free(&a);
            test_body_free(&b);
        }
    }
    print_message("%u pairs: worst error %.2g, widest bounds %.2g of the size, %u degenerate, at most %u iterations\n",
                  cases, worst, worst_lower, degenerate, most);
    TEST_CHECK(worst <= 1e-6 && worst_lower <= 1e-5);
    TEST_CHECK(overlaps[GAP_CONCENTRIC] > 400 && overlaps[GAP_DEEP] > 200 && overlaps[GAP_1E_2] == 0 &&
               overlaps[GAP_ONE] == 0);
    for (int gap = 0; gap < GAP_COUNT; gap++) {
        TEST_CHECK(seen[gap] == 4 * BODY_COUNT * BODY_COUNT);
    }
}

static void compare_far(const test_body *a, const test_body *b, const tl_transform near[2], const tl_transform far[2],
                        void *user)
{
    tl_separation at_origin, away;
    tl_convex_distance(&a->shape, near[0], &b->shape, near[1], NULL, &at_origin);
    tl_convex_distance(&a->shape, far[0], &b->shape, far[1], NULL, &away);
    TEST_CHECK(memcmp(&at_origin.distance, &away.distance, sizeof(float)) == 0 && at_origin.overlap == away.overlap);
    TEST_CHECK(memcmp(&at_origin.normal, &away.normal, sizeof away.normal) == 0);
    *(uint32_t *)user += !away.overlap;
}

static void test_place_in_the_world_does_not_matter(void **state)
{
    (void)state;
    uint32_t apart = 0;
    test_each_far_pair(2, 2.0f, compare_far, &apart);
    TEST_CHECK(apart > 100);
}

static void test_radii(void **state)
{
    (void)state;
    tl_transform identity = tl_transform_identity(), moved = identity;
    moved.position = tl_vec3_make(0, 3, 4);
    tl_convex sphere = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1.0f),
              other = tl_convex_sphere(tl_vec3_make(0, 0, 0), 2.0f);
    tl_separation s;
    tl_convex_distance(&sphere, identity, &other, moved, NULL, &s);
    TEST_CHECK(s.distance == 2.0f && !s.overlap && s.lower_bound <= 2.0f && s.lower_bound > 1.9999f);
    TEST_CHECK(tl_distance(s.point_a, tl_vec3_make(0, 0.6f, 0.8f)) < 1e-6f);
    TEST_CHECK(tl_distance(s.point_b, tl_vec3_make(0, 1.8f, 2.4f)) < 1e-6f);
    // Spheres that overlap although their centres do not.
    other.radius = 4.5f;
    tl_convex_distance(&sphere, identity, &other, moved, NULL, &s);
    TEST_CHECK(s.overlap && s.distance == 0.0f && s.lower_bound == 0.0f);
    TEST_CHECK(tl_convex_overlap(&sphere, identity, &other, moved, NULL));
    other.radius = 3.999f;
    TEST_CHECK(!tl_convex_overlap(&sphere, identity, &other, moved, NULL));
    // A capsule above a box.
    tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(2, 1, 2), 0.0f);
    tl_convex capsule = tl_convex_capsule(tl_vec3_make(-1, 0, 0), tl_vec3_make(1, 0, 0), 0.5f);
    moved.position = tl_vec3_make(0.25f, 3, 0.25f);
    tl_convex_distance(&box, identity, &capsule, moved, NULL, &s);
    TEST_CHECK(fabsf(s.distance - 1.5f) < 1e-6f && fabsf(s.normal.y - 1.0f) < 1e-6f);
    TEST_CHECK(fabsf(s.point_a.y - 1.0f) < 1e-6f && fabsf(s.point_b.y - 2.5f) < 1e-6f);
    // Coincident centres.
    tl_convex_distance(&sphere, identity, &sphere, identity, NULL, &s);
    TEST_CHECK(s.overlap && s.distance == 0.0f);
}

static tl_vec3 ellipsoid(tl_vec3 direction, void *user)
{
    const tl_vec3 *radii = (const tl_vec3 *)user;
    tl_vec3 scaled = tl_mul(direction, *radii);
    return tl_mul(tl_normalize(scaled), *radii);
}

static void test_custom_shapes(void **state)
{
    (void)state;
    tl_vec3 radii = tl_vec3_make(1, 2, 3);
    tl_convex shape = tl_convex_custom(ellipsoid, &radii, 0.0f);
    tl_convex point = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
    tl_transform identity = tl_transform_identity(), moved = identity;
    tl_simplex_cache cache;
    memset(&cache, 0, sizeof cache);
    for (int axis = 0; axis < 3; axis++) {
        moved.position = tl_vec3_make(axis == 0 ? 5.0f : 0, axis == 1 ? 5.0f : 0, axis == 2 ? 5.0f : 0);
        tl_separation s;
        tl_convex_distance(&shape, identity, &point, moved, &cache, &s);
        TEST_CHECK(fabsf(s.distance - (4.0f - (float)axis)) < 1e-5f && s.status == TL_CONVEX_CONVERGED);
    }
    test_random random = { 3 };
    uint32_t inside = 0;
    for (int i = 0; i < 2000; i++) {
        tl_vec3 p = tl_scale(test_random_direction(&random), test_random_range(&random, 0, 4));
        moved.position = p;
        float level = p.x * p.x + p.y * p.y / 4 + p.z * p.z / 9;
        if (fabsf(level - 1.0f) > 1e-4f) {
            TEST_CHECK(tl_convex_overlap(&shape, identity, &point, moved, NULL) == (level < 1.0f));
            inside += level < 1.0f;
        }
    }
    TEST_CHECK(inside > 300 && inside < 1700);
}

static void test_cache_changes_only_the_time(void **state)
{
    (void)state;
    test_random random = { 4 };
    uint32_t cold_iterations = 0, warm_iterations = 0;
    for (int i = 0; i < 300; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 5 % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_simplex_cache cache;
        memset(&cache, 0, sizeof cache);
        if (i % 10 == 9) {
            cache.count = 7;
            for (int k = 0; k < 4; k++) {
                cache.vertex_a[k] = (uint32_t)test_random_u64(&random);
                cache.vertex_b[k] = test_random_below(&random, 6);
            }
        }
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 ? GAP_1E_2 : GAP_ONE, &pose_a, &pose_b);
        for (int step = 0; step < 10; step++) {
            tl_separation cold, warm;
            tl_convex_distance(&a.shape, pose_a, &b.shape, pose_b, NULL, &cold);
            tl_convex_distance(&a.shape, pose_a, &b.shape, pose_b, &cache, &warm);
            TEST_CHECK(cold.overlap == warm.overlap &&
                       fabsf(cold.distance - warm.distance) <= 1e-6f * (1.0f + cold.distance));
            cold_iterations += cold.iterations;
            warm_iterations += warm.iterations;
            pose_b.position = tl_add(pose_b.position, tl_scale(test_random_direction(&random), 0.002f));
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    TEST_CHECK(warm_iterations < cold_iterations / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distance_matches_brute_force),
        cmocka_unit_test(test_place_in_the_world_does_not_matter),
        cmocka_unit_test(test_radii),
        cmocka_unit_test(test_custom_shapes),
        cmocka_unit_test(test_cache_changes_only_the_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
