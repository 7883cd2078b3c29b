// SPDX-License-Identifier: MIT
//
// GJK and the Minkowski difference it walks on: supports against all pairs of vertices; distances by what they prove
// of themselves: the normal keeps all vertices apart by the lower bound, the simplex reaches the upper one.

#include "talus_test.h"

#include "convex_oracle.h"

#include "convex/core/gjk.h"

#include <float.h>
#include <string.h>

enum { MAX_POINTS = 24 };

// Two clouds of points; B's pose is random, A's frame is the world's.
typedef struct cloud_pair {
    tl_vec3 points[2][MAX_POINTS];
    tl_vec3d world[2][MAX_POINTS];
    uint32_t count[2];
    double size;
    tl_convex shape[2];
    tl_minkowski minkowski;
} cloud_pair;

static void make_pair(test_random *random, cloud_pair *p)
{
    static const float scales[4] = { 1.0f, 1e-4f, 300.0f, 1e5f };
    const float scale = scales[test_random_below(random, 4)], far = test_random_range(random, 0.0f, 4.0f);
    const tl_vec3 low = tl_vec3_make(-1, -1, -1), high = tl_vec3_make(1, 1, 1);
    tl_transform poses[2] = { tl_transform_identity(), tl_transform_identity() };
    poses[1].position = tl_scale(test_random_point(random, low, high), far * scale);
    const float angle = test_random_range(random, -3.0f, 3.0f);
    poses[1].rotation.y = sinf(0.5f * angle);
    poses[1].rotation.w = cosf(0.5f * angle);
    for (int k = 0; k < 2; k++) {
        // Flat, straight and single ones too.
        const uint32_t axes = test_random_below(random, 8);
        p->count[k] = 1 + test_random_below(random, MAX_POINTS);
        for (uint32_t i = 0; i < p->count[k]; i++) {
            tl_vec3 q = tl_scale(test_random_point(random, low, high), scale);
            q.y = axes == 0 ? 0.0f : q.y;
            q.z = axes == 0 || axes == 1 ? 0.0f : q.z;
            p->points[k][i] = q;
            p->world[k][i] = oracle_transform(poses[k], q);
        }
        p->shape[k] = tl_convex_from_points(p->points[k], p->count[k], 0.0f);
    }
    p->size = (double)scale * 4.0;
    TEST_CHECK(tl_minkowski_init(&p->minkowski, &p->shape[0], &poses[0], &p->shape[1], &poses[1]));
}

// How far the points of shape k reach along a direction.
static double reach(const cloud_pair *p, int k, tl_vec3d d)
{
    double most = -DBL_MAX;
    for (uint32_t i = 0; i < p->count[k]; i++) {
        most = fmax(most, tl_vec3d_dot(p->world[k][i], d));
    }
    return most;
}

static void supports_are_the_farthest_differences(void **state)
{
    (void)state;
    test_random random = { 21 };
    static cloud_pair p;
    for (int round = 0; round < 3000; round++) {
        make_pair(&random, &p);
        const tl_vec3d d = tl_vec3d_from(test_random_point(&random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1)));
        const double length = tl_vec3d_length(d);
        const double expected = reach(&p, 0, d) + reach(&p, 1, tl_vec3d_neg(d));
        tl_minkowski_point first, again, same;
        tl_minkowski_support(&p.minkowski, d, &first);
        TEST_CHECK(fabs(tl_vec3d_dot(first.w, d) - expected) <= 1e-6 * p.size * length);
        // Any vertex as a hint leads to a point as far.
        tl_minkowski_set_hints(&p.minkowski, test_random_below(&random, p.count[0]),
                               test_random_below(&random, p.count[1]));
        tl_minkowski_support(&p.minkowski, d, &again);
        TEST_CHECK(fabs(tl_vec3d_dot(again.w, d) - expected) <= 1e-6 * p.size * length);
        TEST_CHECK(tl_minkowski_vertex(&p.minkowski, first.vertex_a, first.vertex_b, &same));
        TEST_CHECK(tl_vec3d_length(tl_vec3d_sub(same.w, first.w)) <= 1e-12 * p.size);
        TEST_CHECK(!tl_minkowski_vertex(&p.minkowski, p.count[0], 0, &same));
    }
    tl_transform at_origin = tl_transform_identity(), bad = at_origin;
    bad.position.y = NAN;
    TEST_CHECK(!tl_minkowski_init(&p.minkowski, &p.shape[0], &at_origin, &p.shape[1], &bad));
}

static void bounds_prove_themselves(void **state)
{
    (void)state;
    test_random random = { 22 };
    static cloud_pair p;
    uint32_t apart = 0, overlapping = 0;
    for (int round = 0; round < 20000; round++) {
        make_pair(&random, &p);
        tl_gjk gjk;
        tl_gjk_run(&p.minkowski, NULL, -1.0, &gjk);
        tl_vec3d on_a, on_b;
        tl_simplex_witness(&gjk.simplex, &on_a, &on_b);
        const double gap = tl_vec3d_length(tl_vec3d_sub(on_b, on_a));
        if (gjk.overlap) {
            TEST_CHECK(gap <= 1e-6 * p.size); // one point of both
            overlapping++;
            continue;
        }
        apart++;
        TEST_CHECK(gjk.lower <= gjk.upper && gjk.upper - gjk.lower <= 1e-5 * p.size);
        TEST_CHECK(fabs(gap - gjk.upper) <= 1e-6 * p.size);
        TEST_CHECK(fabs(tl_vec3d_length(gjk.normal) - 1.0) < 1e-9);
        const double between = -reach(&p, 1, tl_vec3d_neg(gjk.normal)) - reach(&p, 0, gjk.normal);
        TEST_CHECK(between >= gjk.lower - 1e-9 * p.size);
    }
    TEST_CHECK(apart > 5000 && overlapping > 2000);
}

static void a_decision_ends_early(void **state)
{
    (void)state;
    test_random random = { 23 };
    static cloud_pair p;
    uint32_t below = 0, above = 0, steps = 0, all_steps = 0;
    for (int round = 0; round < 5000; round++) {
        make_pair(&random, &p);
        const tl_minkowski fresh = p.minkowski;
        tl_gjk whole, decided;
        tl_gjk_run(&p.minkowski, NULL, -1.0, &whole);
        const double at = (double)test_random_range(&random, 0.0f, 1.0f) * p.size;
        if (fabs(at - whole.upper) < 1e-4 * p.size) {
            continue;
        }
        p.minkowski = fresh;
        tl_gjk_run(&p.minkowski, NULL, at, &decided);
        const bool is_nearer = whole.overlap || whole.upper < at;
        TEST_CHECK(is_nearer ? decided.overlap || decided.upper <= at : decided.lower >= at);
        (*(is_nearer ? &below : &above))++;
        steps += decided.iterations;
        all_steps += whole.iterations;
    }
    TEST_CHECK(below > 500 && above > 500 && steps < all_steps);
}

static tl_transform random_pose(test_random *random)
{
    const tl_vec3 low = tl_vec3_make(-9, -9, -9), high = tl_vec3_make(9, 9, 9),
                  axis = test_random_point(random, low, high);
    tl_transform pose = { { axis.x, axis.y, axis.z, test_random_range(random, -9.0f, 9.0f) },
                          test_random_point(random, low, high) };
    if (test_random_below(random, 8) == 0) {
        pose.rotation = (tl_quat){ 0, 0, 0, 0 };
    }
    return pose;
}

static void frames_are_those_of_one_pose_at_a_time(void **state)
{
    (void)state;
    test_random random = { 29 };
    const tl_convex point = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
    for (int round = 0; round < 20000; round++) {
        const tl_transform pose_a = random_pose(&random), pose_b = random_pose(&random);
        const tl_quatd a = tl_quatd_from(pose_a.rotation), b = tl_quatd_from(pose_b.rotation);
        tl_minkowski pair;
        TEST_CHECK(tl_minkowski_init(&pair, &point, &pose_a, &point, &pose_b));
        tl_frame to_world, b_to_a;
        tl_frame_set(&to_world, a, tl_vec3d_from(pose_a.position));
        tl_frame_set(&b_to_a, tl_quatd_between(a, b),
                     tl_frame_rotate_back(&to_world, tl_vec3d_sub(tl_vec3d_from(pose_b.position), to_world.origin)));
        TEST_CHECK(memcmp(&pair.a_to_world, &to_world, sizeof to_world) == 0);
        TEST_CHECK(memcmp(&pair.b_to_a, &b_to_a, sizeof b_to_a) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(supports_are_the_farthest_differences),
                                        cmocka_unit_test(bounds_prove_themselves),
                                        cmocka_unit_test(a_decision_ends_early),
                                        cmocka_unit_test(frames_are_those_of_one_pose_at_a_time) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
