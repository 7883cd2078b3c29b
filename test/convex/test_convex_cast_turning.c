// SPDX-License-Identifier: MIT
//
// Casts with rotation: fine steps find nothing before the time reported, and the shapes are as near as the gap then; a
// bar that is turned by a right angle meets a ball where the arc does; motion without rotation as in the linear cast.

#include "talus_test.h"

#include "convex_oracle.h"

static tl_transform pose_between(tl_transform from, tl_transform to, float t)
{
    tl_quat p = from.rotation, q = to.rotation;
    float sign = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0.0f ? -t : t, u = 1.0f - t;
    tl_quat r = { u * p.x + sign * q.x, u * p.y + sign * q.y, u * p.z + sign * q.z, u * p.w + sign * q.w };
    tl_transform pose = { tl_quat_normalize(r), tl_add(tl_scale(from.position, u), tl_scale(to.position, t)) };
    return pose;
}

static void test_against_fine_steps(void **state)
{
    (void)state;
    test_random random = { 31 };
    uint32_t hits = 0, misses = 0, steps = 0, stopped = 0;
    for (uint32_t i = 0; i < 1500; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 3 % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a = { test_random_rotation(&random), { 0, 0, 0 } },
                     from = { test_random_rotation(&random), tl_scale(test_random_direction(&random), 3.0f) },
                     to = { test_random_rotation(&random), tl_scale(test_random_direction(&random), 3.0f) };
        float gap = 0.01f * tl_maxf(a.size, b.size);
        tl_convex_hit hit;
        tl_convex_cast_turning(&a.shape, pose_a, &b.shape, from, to, gap, &hit);
        float end = hit.hit ? hit.t : 1.0f;
        steps += hit.iterations;
        stopped += hit.status == TL_CONVEX_ITERATIONS;
        tl_separation s;
        for (int k = 0; k < 200; k++) {
            tl_convex_distance(&a.shape, pose_a, &b.shape, pose_between(from, to, end * (float)k / 200.0f), NULL, &s);
            TEST_CHECK(!s.overlap || (hit.initial_overlap && end == 0.0f));
        }
        if (hit.hit && hit.status == TL_CONVEX_CONVERGED) {
            tl_convex_distance(&a.shape, pose_a, &b.shape, pose_between(from, to, end), NULL, &s);
            TEST_CHECK(s.overlap || s.distance <= gap + 1e-5f);
            TEST_CHECK(hit.initial_overlap || fabsf(s.distance - hit.gap) < 1e-5f);
        }
        hits += hit.hit;
        misses += !hit.hit;
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("%u hits, %u misses, %.1f steps, %u at the limit\n", hits, misses, (double)steps / 1500.0, stopped);
    TEST_CHECK(hits > 150 && misses > 150 && stopped == 0);
}

// A bar along x turns to z about the origin; a ball stands at 45 degrees.
static void test_a_turning_bar(void **state)
{
    (void)state;
    tl_convex bar = tl_convex_capsule(tl_vec3_make(0, 0, 0), tl_vec3_make(2, 0, 0), 0.1f),
              ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.2f);
    tl_transform at = tl_transform_identity(), from = at, to = at;
    at.position = tl_vec3_make(1.0f, 0, -1.0f);
    to.rotation = (tl_quat){ 0, 0.70710678f, 0, 0.70710678f }; // x goes to -z
    tl_convex_hit hit;
    TEST_CHECK(tl_convex_cast_turning(&ball, at, &bar, from, to, 1e-3f, &hit) && hit.status == TL_CONVEX_CONVERGED);
    // The bar's axis is then 0.3 from the ball's middle: asin(0.3 / sqrt 2) before 45 degrees.
    double angle = 0.78539816 - asin(0.3 / sqrt(2.0)), half = 0.5 * angle, whole = 0.78539816;
    double t = sin(half) / (sin(half) + sin(whole - half)); // of the quaternions' mean
    TEST_CHECK((double)hit.t <= t + 1e-6 && (double)hit.t > t - 2e-3);
    // The other way round there is nothing.
    to.rotation.y = -to.rotation.y;
    TEST_CHECK(!tl_convex_cast_turning(&ball, at, &bar, from, to, 1e-3f, &hit) && hit.t == 0.0f);
    // By the longer way of the same rotation: the shorter one is taken.
    to.rotation = (tl_quat){ 0, -0.70710678f, 0, -0.70710678f };
    TEST_CHECK(tl_convex_cast_turning(&ball, at, &bar, from, to, 1e-3f, &hit));
}

static void test_without_rotation(void **state)
{
    (void)state;
    test_random random = { 32 };
    uint32_t hits = 0;
    for (uint32_t i = 0; i < 500; i++) {
        tl_convex a = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.7f, 0.3f), 0.0f);
        tl_transform pose_a = { test_random_rotation(&random), { 0, 0, 0 } },
                     from = { test_random_rotation(&random), tl_scale(test_random_direction(&random), 3.0f) },
                     to = from;
        to.position = tl_scale(test_random_direction(&random), 2.0f);
        tl_convex_hit hit, linear;
        tl_convex_cast(&a, pose_a, &a, from, tl_sub(to.position, from.position), &linear);
        tl_convex_cast_turning(&a, pose_a, &a, from, to, 1e-3f, &hit);
        TEST_CHECK(!linear.hit || (hit.hit && hit.t <= linear.t + 1e-5f));
        hits += linear.hit;
    }
    TEST_CHECK(hits > 100);
}

static void test_refusals(void **state)
{
    (void)state;
    tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1.0f);
    tl_transform here = tl_transform_identity(), there = here, odd = here;
    there.position.x = 5.0f;
    odd.rotation.y = NAN;
    tl_convex_hit hit;
    TEST_CHECK(!tl_convex_cast_turning(&ball, here, &ball, there, odd, 0.01f, &hit) &&
               hit.status == TL_CONVEX_NOT_FINITE);
    TEST_CHECK(!tl_convex_cast_turning(&ball, here, &ball, there, here, 0.0f, &hit) &&
               hit.status == TL_CONVEX_NOT_FINITE);
    TEST_CHECK(!tl_convex_cast_turning(&ball, here, &ball, there, here, NAN, &hit) &&
               hit.status == TL_CONVEX_NOT_FINITE);
    TEST_CHECK(tl_convex_cast_turning(&ball, here, &ball, here, there, 0.01f, &hit) && hit.initial_overlap &&
               hit.t == 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_fine_steps),
        cmocka_unit_test(test_a_turning_bar),
        cmocka_unit_test(test_without_rotation),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
