// SPDX-License-Identifier: MIT

#include "talus_test.h"

static tl_quat random_rotation(test_random *random)
{
    tl_vec3 axis = test_random_direction(random);
    tl_quat q = { axis.x, axis.y, axis.z, test_random_range(random, -2.0f, 2.0f) };
    return tl_quat_normalize(q);
}

static void boxes(void **state)
{
    (void)state;
    tl_aabb box = tl_aabb_empty();
    TEST_CHECK(tl_aabb_is_empty(box));
    box = tl_aabb_add_point(box, tl_vec3_make(1, 2, 3));
    TEST_CHECK(!tl_aabb_is_empty(box) && tl_aabb_contains(box, tl_vec3_make(1, 2, 3)));
    box = tl_aabb_add_point(box, tl_vec3_make(-1, 5, 0));
    TEST_CHECK(tl_aabb_half_area(box) == 2 * 3 + 3 * 3 + 3 * 2);
    tl_aabb beside = { { 1, 2, 3 }, { 4, 4, 4 } };
    TEST_CHECK(tl_aabb_overlaps(box, beside) && !tl_aabb_is_empty(tl_aabb_intersection(box, beside)));
    beside.min.x = 1.5f;
    TEST_CHECK(!tl_aabb_overlaps(box, beside) && tl_aabb_is_empty(tl_aabb_intersection(box, beside)));
    tl_aabb both = tl_aabb_union(box, beside);
    TEST_CHECK(both.min.x == -1 && both.max.x == 4 && tl_aabb_union(tl_aabb_empty(), box).max.y == 5);
    tl_aabb nan_box = { { NAN, 0, 0 }, { 1, 1, 1 } };
    TEST_CHECK(tl_aabb_is_empty(nan_box));
}

static void rotations_keep_lengths_and_invert(void **state)
{
    (void)state;
    test_random random = { 9 };
    for (int i = 0; i < 1000; i++) {
        tl_transform a = { random_rotation(&random), test_random_direction(&random) };
        tl_transform b = { random_rotation(&random), test_random_direction(&random) };
        tl_vec3 p = test_random_point(&random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
        // Each of the five operations errs by a few ulps of numbers below 4.
        const float bound = 4e-6f;
        TEST_CHECK(fabsf(tl_length(tl_rotate(a.rotation, p)) - tl_length(p)) < bound);
        TEST_CHECK(tl_distance(tl_inverse_transform_point(a, tl_transform_point(a, p)), p) < bound);
        tl_vec3 in_steps = tl_transform_point(a, tl_transform_point(b, p));
        TEST_CHECK(tl_distance(in_steps, tl_transform_point(tl_transform_mul(a, b), p)) < bound);
        tl_transform relative = tl_transform_relative(a, b);
        tl_vec3 seen = tl_inverse_transform_point(a, tl_transform_point(b, p));
        TEST_CHECK(tl_distance(seen, tl_transform_point(relative, p)) < bound);
    }
    tl_quat zero = { 0, 0, 0, 0 };
    TEST_CHECK(tl_quat_normalize(zero).w == 1.0f);
}

static void vectors(void **state)
{
    (void)state;
    tl_vec3 x = tl_vec3_make(1, 0, 0);
    tl_vec3 y = tl_vec3_make(0, 1, 0);
    TEST_CHECK(tl_cross(x, y).z == 1.0f && tl_dot(x, y) == 0.0f);
    TEST_CHECK(tl_length(tl_normalize(tl_vec3_make(3, 4, 12))) > 0.999999f);
    TEST_CHECK(tl_length(tl_normalize(tl_vec3_make(0, 0, 0))) == 0.0f);
    tl_vec3 a = tl_vec3_make(0.1f, 1e30f, -7.3f);
    tl_vec3 b = tl_vec3_make(0.7f, -3.0f, 1e-20f);
    tl_vec3 at_end = tl_lerp(a, b, 1.0f);
    TEST_CHECK(at_end.x == b.x && at_end.y == b.y && at_end.z == b.z);
    TEST_CHECK(tl_lerp(a, b, 0.0f).y == a.y);
    TEST_CHECK(!tl_is_finite(tl_vec3_make(0, NAN, 0)) && !tl_is_finite(tl_vec3_make(0, 0, INFINITY)));
    TEST_CHECK(tl_is_finite(a) && tl_clampf(5, 0, 1) == 1 && tl_clampf(-5, 0, 1) == 0);
}

static bool same_quat(tl_quat a, tl_quat b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

static bool same_point(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void zero_quaternions_are_the_identity(void **state)
{
    (void)state;
    const tl_quat zero = { 0.0f, 0.0f, 0.0f, 0.0f };
    const tl_transform still = { zero, { 0.0f, 0.0f, 0.0f } };
    test_random random = { 77 };
    for (int i = 0; i < 100; i++) {
        tl_vec3 axis = test_random_direction(&random), p = test_random_direction(&random);
        tl_quat q = { axis.x * 0.6f, axis.y * 0.6f, axis.z * 0.6f, 0.8f };
        tl_transform pose = { q, test_random_direction(&random) };
        TEST_CHECK(same_point(tl_rotate(zero, p), p) && same_point(tl_inverse_rotate(zero, p), p));
        TEST_CHECK(same_quat(tl_quat_mul(zero, q), q) && same_quat(tl_quat_mul(q, zero), q));
        TEST_CHECK(same_quat(tl_quat_mul(zero, zero), tl_quat_identity()));
        TEST_CHECK(same_quat(tl_quat_mul(tl_quat_conjugate(zero), q), q));
        TEST_CHECK(same_point(tl_transform_point(still, p), p) && same_point(tl_inverse_transform_point(still, p), p));
        tl_transform after = tl_transform_mul(still, pose), before = tl_transform_mul(pose, still);
        tl_transform seen = tl_transform_relative(still, pose);
        TEST_CHECK(same_quat(after.rotation, q) && same_point(after.position, pose.position));
        TEST_CHECK(same_quat(before.rotation, q) && same_point(before.position, pose.position));
        TEST_CHECK(same_quat(seen.rotation, q) && same_point(seen.position, pose.position));
        TEST_CHECK(same_quat(tl_quat_normalize(zero), tl_quat_identity()));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes),
        cmocka_unit_test(rotations_keep_lengths_and_invert),
        cmocka_unit_test(vectors),
        cmocka_unit_test(zero_quaternions_are_the_identity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
