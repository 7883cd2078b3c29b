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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes),
        cmocka_unit_test(rotations_keep_lengths_and_invert),
        cmocka_unit_test(vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
