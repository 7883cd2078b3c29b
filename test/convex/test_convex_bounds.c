// SPDX-License-Identifier: MIT
//
// bounds.c: boxes of shapes hold every point of them, and no more than rounding beside.

#include "convex_oracle.h"
#include "talus_test.h"

#include <float.h>
#include <talus/convex.h>

static tl_vec3 egg_support(tl_vec3 direction, void *user)
{
    (void)user;
    // The farthest point of the ellipsoid with half axes 1, 2, 3.
    tl_vec3 d = tl_mul(direction, tl_vec3_make(1, 2, 3));
    return tl_mul(tl_normalize(d), tl_vec3_make(1, 2, 3));
}

static bool close_to(float value, double expected, double size)
{
    return fabs((double)value - expected) <= 4.0 * (double)FLT_EPSILON * size;
}

static void check(const tl_convex *shape, tl_transform pose, tl_vec3 min, tl_vec3 max)
{
    tl_aabb box = tl_convex_bounds(shape, pose);
    double size =
        (double)tl_length(tl_abs(pose.position)) + (double)tl_length(tl_abs(min)) + (double)tl_length(tl_abs(max));
    TEST_CHECK(close_to(box.min.x, (double)min.x, size) && close_to(box.max.x, (double)max.x, size));
    TEST_CHECK(close_to(box.min.y, (double)min.y, size) && close_to(box.max.y, (double)max.y, size));
    TEST_CHECK(close_to(box.min.z, (double)min.z, size) && close_to(box.max.z, (double)max.z, size));
    TEST_CHECK(box.min.x <= min.x && box.min.y <= min.y && box.min.z <= min.z);
    TEST_CHECK(box.max.x >= max.x && box.max.y >= max.y && box.max.z >= max.z);
}

static void test_examples(void **state)
{
    (void)state;
    tl_transform pose = tl_transform_identity();
    pose.position = tl_vec3_make(10, 20, 30);
    tl_convex sphere = tl_convex_sphere(tl_vec3_make(1, 0, 0), 2);
    check(&sphere, pose, tl_vec3_make(9, 18, 28), tl_vec3_make(13, 22, 32));
    tl_convex capsule = tl_convex_capsule(tl_vec3_make(0, -1, 0), tl_vec3_make(0, 1, 0), 0.5f);
    check(&capsule, pose, tl_vec3_make(9.5f, 18.5f, 29.5f), tl_vec3_make(10.5f, 21.5f, 30.5f));
    tl_convex egg = tl_convex_custom(egg_support, NULL, 0);
    check(&egg, pose, tl_vec3_make(9, 18, 27), tl_vec3_make(11, 22, 33));
    tl_convex cylinder = tl_convex_cylinder(tl_vec3_make(0, 0, 0), tl_vec3_make(0, 4, 0), 1, 0.25f);
    check(&cylinder, pose, tl_vec3_make(8.75f, 19.75f, 28.75f), tl_vec3_make(11.25f, 24.25f, 31.25f));
    // A quarter turn about z takes x to y.
    float s = sqrtf(0.5f);
    tl_quat turn = { 0, 0, s, s };
    pose.rotation = turn;
    tl_convex box = tl_convex_box(tl_vec3_make(1, 0, 0), tl_vec3_make(3, 2, 1), 0);
    check(&box, pose, tl_vec3_make(8, 18, 29), tl_vec3_make(12, 24, 31));
}

// Hulls of all families under random poses: the box holds every vertex, and a vertex lies at each side.
static void test_hulls(void **state)
{
    (void)state;
    test_random random = { 3 };
    for (uint32_t i = 0; i < 200; i++) {
        test_body body;
        test_body_make(&body, (body_family)(i % BODY_COUNT), i, i % 3 == 0 ? 1e-3f : 1.0f);
        tl_transform pose = tl_transform_identity();
        pose.rotation = test_random_rotation(&random);
        pose.position = test_random_point(&random, tl_vec3_make(-9, -9, -9), tl_vec3_make(9, 9, 9));
        static oracle_body oracle;
        test_body_oracle(&body, pose, &oracle);
        double radius = (double)body.shape.radius;
        tl_vec3 d[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
        tl_aabb box = tl_convex_bounds(&body.shape, pose);
        const float low[3] = { box.min.x, box.min.y, box.min.z }, high[3] = { box.max.x, box.max.y, box.max.z };
        for (int axis = 0; axis < 3; axis++) {
            double least = (double)INFINITY, most = -(double)INFINITY;
            for (uint32_t v = 0; v < oracle.vertex_count; v++) {
                double at = tl_vec3d_dot(oracle.vertices[v], tl_vec3d_from(d[axis]));
                least = at < least ? at : least;
                most = at > most ? at : most;
            }
            TEST_CHECK((double)low[axis] <= least - radius && (double)high[axis] >= most + radius);
            TEST_CHECK((double)low[axis] >= least - radius - 1e-5 && (double)high[axis] <= most + radius + 1e-5);
        }
        test_body_free(&body);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_hulls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
