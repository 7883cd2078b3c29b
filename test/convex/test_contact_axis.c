// SPDX-License-Identifier: MIT
//
// The cached normal: whatever the motion, what is said to hold is as shallow as any normal but for the slack, and small
// motions hold.

#include "talus_test.h"

#include "convex_oracle.h"

#include "convex/contact/contact_axis.h"

#include <string.h>

static void test_what_holds(void **state)
{
    (void)state;
    test_random random = { 81 };
    const float motions[] = { 0.0f, 1e-6f, 1e-4f, 1e-3f, 1e-2f, 0.1f };
    uint32_t held[6] = { 0 }, tried[6] = { 0 };
    for (uint32_t i = 0; i < 4000; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_POINT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 3 % BODY_POINT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 == 0 ? GAP_SHALLOW : GAP_DEEP, &pose_a, &pose_b);
        tl_contact_cache cache = { 0 };
        tl_contact_manifold m;
        tl_contact_limits limits = { 0.01f, 0.01f, 0 };
        tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b, &limits, &cache, &m);
        for (int k = 0; k < 6 && cache.has_axis != 0; k++) {
            tl_transform moved = pose_b;
            tl_vec3 turn = tl_scale(test_random_direction(&random), 0.5f * motions[k]);
            tl_quat by = { turn.x, turn.y, turn.z, 1.0f };
            moved.rotation = tl_quat_normalize(tl_quat_mul(by, moved.rotation));
            moved.position = tl_mul_add(moved.position, test_random_direction(&random), motions[k]);
            tl_minkowski pair;
            cache.polytope.point_count = 0; // it proves more; test_polytope_keep.c
            TEST_CHECK(tl_minkowski_init(&pair, &a.shape, &pose_a, &b.shape, &moved));
            const double slack = 3e-4;
            tl_deepest found;
            tried[k]++;
            if (tl_axis_try(&pair, &cache, slack, &found) == TL_AXIS_HOLDS) {
                tl_penetration p;
                tl_convex_penetration(&a.shape, pose_a, &b.shape, moved, NULL, &p);
                TEST_CHECK(found.lower_depth <= (double)p.upper_bound + 1e-6);
                TEST_CHECK(-found.separation >= (double)p.lower_bound - 1e-6);
                TEST_CHECK(-found.separation - (double)p.upper_bound <= slack);
                held[k]++;
            }
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    for (int k = 0; k < 6; k++) {
        print_message("motion %g: %u of %u hold\n", (double)motions[k], held[k], tried[k]);
    }
    TEST_CHECK(tried[0] > 1000 && held[0] > tried[0] * 9 / 10 && held[2] > tried[2] * 3 / 4 && held[5] == 0);
}

// B comes deeper by less than the slack: bounds by the motion alone are apart by twice that, the polytope's are not.
static void test_deeper_is_kept(void **state)
{
    (void)state;
    test_random random = { 5 };
    const tl_contact_limits limits = { 0.01f, 0.01f, 0 };
    const float slack = TL_CONTACT_SLACK * limits.tolerance;
    uint32_t tried = 0, kept = 0;
    for (int i = 0; i < 1000; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_POINT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 3 % BODY_POINT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 == 0 ? GAP_SHALLOW : GAP_DEEP, &pose_a, &pose_b);
        tl_contact_cache cache = { 0 };
        tl_contact_manifold first, deeper;
        tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b, &limits, &cache, &first);
        if (cache.has_axis != 0 && cache.polytope.point_count > 0) {
            const tl_contact_cache before = cache;
            tl_penetration p;
            pose_b.position = tl_mul_add(pose_b.position, first.normal, -0.6f * slack);
            tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b, &limits, &cache, &deeper);
            tl_convex_penetration(&a.shape, pose_a, &b.shape, pose_b, NULL, &p);
            TEST_CHECK(-deeper.separation >= p.lower_bound - 1e-6f && -deeper.separation <= p.depth + slack + 1e-6f);
            tried++;
            kept += deeper.count == first.count && memcmp(before.b_to_a, cache.b_to_a, sizeof cache.b_to_a) == 0;
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("deeper: %u of %u are kept\n", kept, tried);
    TEST_CHECK(tried > 200 && kept > tried * 9 / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_holds),
        cmocka_unit_test(test_deeper_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
