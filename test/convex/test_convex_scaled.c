// SPDX-License-Identifier: MIT
//
// convex_scaled.c: shapes at a scale against shapes of scaled numbers, bit by bit where they have some of their own,
// within rounding where a support function stands in; what is refused.

#include "talus_test.h"

#include "math/vec3d.h"

#include <string.h>
#include <talus/convex_scaled.h>

enum { POINTS = 40, PAIRS = 400 };

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static const tl_scaled_convex *made(const tl_convex *shape, tl_vec3 scale, tl_scaled_convex *room)
{
    TEST_RESULT(tl_scaled_convex_make(shape, scale, room, NULL), TL_OK);
    return room;
}

static void check_fields(tl_convex shape, tl_vec3 scale, tl_convex expected)
{
    tl_scaled_convex room;
    const tl_convex *found = &made(&shape, scale, &room)->shape;
    TEST_CHECK(found->kind == expected.kind && found->radius == expected.radius);
    TEST_CHECK(found->point_count == expected.point_count);
    for (int i = 0; i < 3; i++) {
        const tl_vec3 *a = &found->corners[i], *b = &expected.corners[i];
        TEST_CHECK(a->x == b->x && a->y == b->y && a->z == b->z);
    }
}

static void test_shapes_of_few_numbers(void **state)
{
    (void)state;
    const tl_vec3 a = vec(1, -2, 3), b = vec(4, 5, 6), c = vec(-7, 8, 1), zero = vec(0, 0, 0), up = vec(0, 2, 0);
    const tl_vec3 twice = vec(2, 2, 2), mirror = vec(-2, 2, 2), odd = vec(-1, 3, 0.5f);
    check_fields(tl_convex_sphere(a, 2), twice, tl_convex_sphere(vec(2, -4, 6), 4));
    check_fields(tl_convex_sphere(a, 2), mirror, tl_convex_sphere(vec(-2, -4, 6), 4));
    check_fields(tl_convex_capsule(a, b, 1), mirror, tl_convex_capsule(vec(-2, -4, 6), vec(-8, 10, 12), 2));
    check_fields(tl_convex_triangle(a, b, c, 0), odd,
                 tl_convex_triangle(vec(-1, -6, 1.5f), vec(-4, 15, 3), vec(7, 24, 0.5f), 0));
    check_fields(tl_convex_box(a, b, 0), odd, tl_convex_box(vec(-1, -6, 1.5f), vec(4, 15, 3), 0));
    check_fields(tl_convex_box(a, b, 0.5f), mirror, tl_convex_box(vec(-2, -4, 6), vec(8, 10, 12), 1));
    check_fields(tl_convex_cylinder(a, b, 1, 0), twice, tl_convex_cylinder(vec(2, -4, 6), vec(8, 10, 12), 2, 0));
    check_fields(tl_convex_cylinder(zero, up, 1, 0), vec(3, 5, -3), tl_convex_cylinder(zero, vec(0, 10, 0), 3, 0));
    check_fields(tl_convex_cone(zero, vec(2, 0, 0), 1, 0), vec(4, 3, 3), tl_convex_cone(zero, vec(8, 0, 0), 3, 0));
    check_fields(tl_convex_cone(zero, vec(0, 0, 2), 1, 0), vec(3, 3, -7), tl_convex_cone(zero, vec(0, 0, -14), 3, 0));
    check_fields(tl_convex_sphere(a, 2), zero, tl_convex_sphere(a, 2));
    check_fields(tl_convex_sphere(a, 2), vec(1, 1, 1), tl_convex_sphere(a, 2));
}

typedef struct cloud {
    tl_vec3 points[POINTS];
    tl_hull *hull;
} cloud;

static tl_vec3 farthest_point(tl_vec3 direction, void *user)
{
    const cloud *c = user;
    uint32_t best = 0;
    for (uint32_t i = 1; i < POINTS; i++) {
        best = tl_dot(direction, c->points[i]) > tl_dot(direction, c->points[best]) ? i : best;
    }
    return c->points[best];
}

static void cloud_make(cloud *c, uint64_t seed)
{
    test_random random = { seed };
    for (uint32_t i = 0; i < POINTS; i++) {
        c->points[i] = test_random_point(&random, vec(-1, -2, -1), vec(3, 1, 1));
    }
    TEST_RESULT(tl_hull_bake(c->points, POINTS, NULL, &c->hull, NULL), TL_OK);
}

// All lengths as those of the hull of scaled points.
static void check_pair(const tl_convex *scaled, const tl_convex *expected, test_random *random, float size,
                       uint32_t *apart, uint32_t *deep)
{
    tl_vec3 far = tl_scale(vec(1, 1, 1), size);
    const tl_convex box = tl_convex_box(vec(0, 0, 0), tl_scale(vec(0.3f, 0.2f, 0.1f), size), 0);
    const tl_transform pose = { { test_random_range(random, -1, 1), test_random_range(random, -1, 1),
                                  test_random_range(random, -1, 1), 1 },
                                test_random_point(random, tl_neg(far), far) };
    const tl_transform here = tl_transform_identity();
    tl_separation one, two;
    tl_convex_distance(scaled, here, &box, pose, NULL, &one);
    tl_convex_distance(expected, here, &box, pose, NULL, &two);
    const float room = 4e-6f * size;
    TEST_CHECK(fabsf(one.distance - two.distance) <= room);
    *apart += one.distance > room;
    tl_penetration in, as;
    tl_convex_penetration(scaled, here, &box, pose, NULL, &in);
    tl_convex_penetration(expected, here, &box, pose, NULL, &as);
    TEST_CHECK(fabsf(in.depth - as.depth) <= room);
    *deep += in.depth > room;
    tl_aabb bounds = tl_convex_bounds(scaled, here), right = tl_convex_bounds(expected, here);
    TEST_CHECK(tl_length(tl_sub(bounds.min, right.min)) <= room && tl_length(tl_sub(bounds.max, right.max)) <= room);
}

static void test_supports(void **state)
{
    (void)state;
    const tl_vec3 scales[6] = { { 2, 2, 2 },        { 1, 3, 0.5f },          { -1.3f, 1.3f, 1.3f },
                                { 0.1f, -7, 0.3f }, { 1e-6f, 1e-6f, 1e-6f }, { -1e6f, 1e6f, 1e6f } };
    cloud c;
    cloud_make(&c, 3);
    test_random random = { 9 };
    uint32_t apart = 0, deep = 0;
    for (uint32_t k = 0; k < 6; k++) {
        tl_vec3 points[POINTS];
        for (uint32_t i = 0; i < POINTS; i++) {
            points[i] = tl_mul(c.points[i], scales[k]);
        }
        const bool round = fabsf(scales[k].x) == fabsf(scales[k].y);
        for (uint32_t i = 0; i < PAIRS; i++) {
            const float radius = round && i % 2 ? 0.2f : 0.0f;
            const tl_convex expected = tl_convex_from_points(points, POINTS, radius * fabsf(scales[k].x));
            const tl_convex kinds[3] = { tl_convex_from_hull(c.hull, radius),
                                         tl_convex_from_points(c.points, POINTS, radius),
                                         tl_convex_custom(farthest_point, &c, radius) };
            tl_scaled_convex room;
            const tl_vec3 size = tl_abs(scales[k]);
            check_pair(&made(&kinds[i % 3], scales[k], &room)->shape, &expected, &random,
                       4 * tl_maxf(size.x, tl_maxf(size.y, size.z)), &apart, &deep);
        }
    }
    print_message("apart %u, deep %u\n", apart, deep);
    TEST_CHECK(apart > 500 && deep > 100);
    tl_blob_free(c.hull);
}

static void check_refused(tl_convex shape, tl_vec3 scale, tl_result why)
{
    tl_scaled_convex scaled;
    tl_report report;
    memset(&scaled, 0xff, sizeof scaled);
    TEST_RESULT(tl_scaled_convex_make(&shape, scale, &scaled, &report), why);
    TEST_CHECK(strcmp(report.field, "scale") == 0 && scaled.of == NULL && scaled.shape.radius == 0);
}

static void test_refused(void **state)
{
    (void)state;
    const tl_convex box = tl_convex_box(vec(0, 0, 0), vec(1, 1, 1), 0);
    check_refused(box, vec(0, 1, 1), TL_ERR_RANGE);
    check_refused(box, vec(1, -0.0f, 1), TL_ERR_RANGE);
    check_refused(box, vec(1, 1, 2e6f), TL_ERR_RANGE);
    check_refused(box, vec(1, 1, 1e-44f), TL_ERR_RANGE);
    check_refused(box, vec(1, NAN, 1), TL_ERR_NOT_FINITE);
    check_refused(box, vec(INFINITY, 1, 1), TL_ERR_NOT_FINITE);
    check_refused(tl_convex_sphere(vec(0, 0, 0), 1), vec(1, 2, 1), TL_ERR_ARGUMENT);
    check_refused(tl_convex_box(vec(0, 0, 0), vec(1, 1, 1), 0.1f), vec(1, 1, 3), TL_ERR_ARGUMENT);
    check_refused(tl_convex_cylinder(vec(0, 0, 0), vec(0, 1, 0), 1, 0), vec(1, 1, 2), TL_ERR_ARGUMENT);
    check_refused(tl_convex_cone(vec(0, 0, 0), vec(0, 1, 1), 1, 0), vec(1, 1, 2), TL_ERR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes_of_few_numbers),
        cmocka_unit_test(test_supports),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
