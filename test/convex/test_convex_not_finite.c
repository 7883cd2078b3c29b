// SPDX-License-Identifier: MIT
//
// Poses, shapes and motions that are NaN or infinite in one number: every query names it, and answers nothing else.

#include "talus_test.h"

#include <talus/convex.h>

#include <string.h>

// One number of a call is replaced: those of both poses, the motion, the shapes' corners and radii, t_max and limits.
enum { POSE_NUMBERS = 7, SHAPE_NUMBERS = 10 };

typedef struct query_input {
    tl_convex a, b;
    tl_transform pose_a, pose_b;
    tl_vec3 motion;
} query_input;

static bool all_zero(const void *bytes, size_t size)
{
    const uint8_t *b = bytes;
    for (size_t i = 0; i < size; i++) {
        if (b[i] != 0) {
            return false;
        }
    }
    return true;
}

static void check_pair(const query_input *in)
{
    tl_separation s;
    memset(&s, 0xff, sizeof s);
    tl_convex_distance(&in->a, in->pose_a, &in->b, in->pose_b, NULL, &s);
    TEST_CHECK(s.status == TL_CONVEX_NOT_FINITE);
    s.status = TL_CONVEX_CONVERGED;
    TEST_CHECK(all_zero(&s, sizeof s));
    tl_penetration p;
    memset(&p, 0xff, sizeof p);
    TEST_CHECK(!tl_convex_penetration(&in->a, in->pose_a, &in->b, in->pose_b, NULL, &p));
    TEST_CHECK(p.status == TL_CONVEX_NOT_FINITE);
    p.status = TL_CONVEX_CONVERGED;
    TEST_CHECK(all_zero(&p, sizeof p));
    tl_contact_manifold m;
    memset(&m, 0xff, sizeof m);
    tl_contact_limits limits = { 1.0f, 1.0f, 0 };
    TEST_CHECK(tl_convex_contacts(&in->a, in->pose_a, &in->b, in->pose_b, &limits, NULL, &m) == 0);
    TEST_CHECK(m.status == TL_CONVEX_NOT_FINITE);
    m.status = TL_CONVEX_CONVERGED;
    TEST_CHECK(all_zero(&m, sizeof m));
    TEST_CHECK(!tl_convex_overlap(&in->a, in->pose_a, &in->b, in->pose_b, NULL));
}

static void check_cast(const query_input *in)
{
    tl_convex_hit hit;
    memset(&hit, 0xff, sizeof hit);
    TEST_CHECK(!tl_convex_cast(&in->a, in->pose_a, &in->b, in->pose_b, in->motion, &hit));
    TEST_CHECK(hit.status == TL_CONVEX_NOT_FINITE);
    hit.status = TL_CONVEX_CONVERGED;
    TEST_CHECK(all_zero(&hit, sizeof hit));
}

static void check_ray(const query_input *in, tl_vec3 origin, tl_vec3 direction, float t_max)
{
    tl_convex_hit hit;
    memset(&hit, 0xff, sizeof hit);
    TEST_CHECK(!tl_convex_cast_ray(&in->a, in->pose_a, origin, direction, t_max, &hit));
    TEST_CHECK(hit.status == TL_CONVEX_NOT_FINITE);
    hit.status = TL_CONVEX_CONVERGED;
    TEST_CHECK(all_zero(&hit, sizeof hit));
}

static float *pose_number(tl_transform *pose, int i)
{
    float *numbers[POSE_NUMBERS] = { &pose->position.x, &pose->position.y, &pose->position.z, &pose->rotation.x,
                                     &pose->rotation.y, &pose->rotation.z, &pose->rotation.w };
    return numbers[i];
}

static float *shape_number(tl_convex *shape, int i)
{
    return i == SHAPE_NUMBERS - 1 ? &shape->radius
           : i % 3 == 0           ? &shape->corners[i / 3].x
           : i % 3 == 1           ? &shape->corners[i / 3].y
                                  : &shape->corners[i / 3].z;
}

static void check_all(const query_input *right, float bad)
{
    for (int i = 0; i < POSE_NUMBERS; i++) {
        query_input in = *right;
        *pose_number(&in.pose_a, i) = bad;
        check_pair(&in);
        check_cast(&in);
        check_ray(&in, in.motion, in.motion, 1.0f);
        tl_aabb box = tl_convex_bounds(&in.a, in.pose_a);
        TEST_CHECK(box.min.x > box.max.x && box.min.y > box.max.y && box.min.z > box.max.z);
        in = *right;
        *pose_number(&in.pose_b, i) = bad;
        check_pair(&in);
        check_cast(&in);
    }
    for (int i = 0; i < SHAPE_NUMBERS; i++) {
        query_input in = *right;
        *shape_number(&in.b, i) = bad;
        check_pair(&in);
        check_cast(&in);
    }
    tl_vec3 wrong[3] = { { bad, 1, 1 }, { 1, bad, 1 }, { 1, 1, bad } };
    for (int i = 0; i < 3; i++) {
        query_input in = *right;
        in.motion = wrong[i];
        check_cast(&in);
        check_ray(right, right->motion, wrong[i], 1.0f);
        check_ray(right, wrong[i], right->motion, 1.0f);
    }
}

static void test_not_finite_has_a_name(void **state)
{
    (void)state;
    tl_vec3 points[30];
    test_random random = { 3 };
    for (int i = 0; i < 30; i++) {
        points[i] = test_random_direction(&random);
    }
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, 30, NULL, &hull, NULL), TL_OK);
    const tl_vec3 zero = { 0, 0, 0 }, up = { 0, 1, 0 }, side = { 1, 0, 0 };
    const tl_convex shapes[] = { tl_convex_from_hull(hull, 0.0f),    tl_convex_from_points(points, 30, 0.0f),
                                 tl_convex_box(zero, up, 0.5f),      tl_convex_sphere(zero, 1.0f),
                                 tl_convex_capsule(zero, up, 0.5f),  tl_convex_triangle(zero, up, side, 0.0f),
                                 tl_convex_cylinder(zero, up, 1, 0), tl_convex_cone(zero, up, 1, 0) };
    const float bad[] = { NAN, INFINITY, -INFINITY };
    for (int i = 0; i < 64; i++) {
        query_input in = {
            shapes[i / 8], shapes[i % 8], tl_transform_identity(), tl_transform_identity(), { 1, 2, 3 }
        };
        for (int k = 0; k < 3; k++) {
            check_all(&in, bad[k]);
        }
        check_ray(&in, in.motion, in.motion, NAN);
        tl_contact_manifold m;
        tl_contact_limits limits[2] = { { NAN, 1.0f, 0 }, { 1.0f, NAN, 0 } };
        for (int k = 0; k < 2; k++) {
            TEST_CHECK(tl_convex_contacts(&in.a, in.pose_a, &in.b, in.pose_b, &limits[k], NULL, &m) == 0);
            TEST_CHECK(m.status == TL_CONVEX_NOT_FINITE);
        }
    }
    tl_blob_free(hull);
}

// Points in the caller's memory are not looked through. Whatever they are, none but these is read.
static void test_points_stay_in_range(void **state)
{
    (void)state;
    static const float odd[] = { NAN, INFINITY, -INFINITY, 0.0f, 1.0f, -1.0f, 3e38f, -3e38f };
    test_random random = { 11 };
    for (int i = 0; i < 200000; i++) {
        tl_vec3 points[2][40];
        uint32_t counts[2];
        for (int k = 0; k < 2; k++) {
            counts[k] = 1 + test_random_below(&random, i % 8 == 0 ? 40 : 12);
            for (uint32_t p = 0; p < counts[k]; p++) {
                points[k][p] = tl_vec3_make(odd[test_random_below(&random, 8)], odd[test_random_below(&random, 8)],
                                            odd[test_random_below(&random, 8)]);
            }
        }
        tl_convex a = tl_convex_from_points(points[0], counts[0], 0.0f),
                  b = tl_convex_from_points(points[1], counts[1], 0.0f);
        tl_simplex_cache cache = { 0 };
        tl_separation s;
        tl_convex_distance(&a, tl_transform_identity(), &b, tl_transform_identity(), &cache, &s);
        for (uint32_t k = 0; k < cache.count; k++) {
            TEST_CHECK(cache.vertex_a[k] < counts[0] && cache.vertex_b[k] < counts[1]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_not_finite_has_a_name),
        cmocka_unit_test(test_points_stay_in_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
