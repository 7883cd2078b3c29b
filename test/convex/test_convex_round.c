// SPDX-License-Identifier: MIT
//
// Cylinders and cones against closed forms: distance and depth of points inside and outside, at three scales, in any
// pose; pairs of them against fine polyhedra.

#include "talus_test.h"

#include "hull_shapes.h"

#include "math/vec3d.h"

#include <talus/convex.h>

#include <string.h>

static double distance_2d(double x, double y)
{
    return sqrt(x * x + y * y);
}

// Signed distance of a point at (r, z) from a cylinder of radius R, z in [-h, h]; negative inside.
static double cylinder_distance(double r, double z, double radius, double h)
{
    double out_r = r - radius, out_z = fabs(z) - h;
    if (out_r <= 0.0 && out_z <= 0.0) {
        return fmax(out_r, out_z);
    }
    return distance_2d(fmax(out_r, 0.0), fmax(out_z, 0.0));
}

// Of a cone with base radius R at z = 0 and its apex at z = h.
static double cone_distance(double r, double z, double radius, double h)
{
    double side = distance_2d(radius, h);
    double over = (h * r + radius * z - h * radius) / side; // above the slanted line
    if (over <= 0.0 && z >= 0.0) {
        return fmax(over, -z);
    }
    double base = distance_2d(fmax(r - radius, 0.0), z);
    double t = fmin(fmax((radius * (radius - r) + h * z) / (side * side), 0.0), 1.0);
    return fmin(base, distance_2d(r - radius * (1.0 - t), z - h * t));
}

static void test_points(void **state)
{
    (void)state;
    static const float scales[] = { 1.0f, 1e-6f, 1e6f };
    test_random random = { 31 };
    uint32_t inside = 0, outside = 0, unconverged = 0;
    double worst_distance = 0.0, worst_depth = 0.0;
    for (int i = 0; i < 6000; i++) {
        float scale = scales[i % 3], radius = test_random_range(&random, 0.05f, 2),
              h = test_random_range(&random, 0.05f, 2);
        bool cone = i / 3 % 2 == 1;
        float low = cone ? 0.0f : -h;
        tl_convex shape =
            cone ? tl_convex_cone(tl_vec3_make(0, 0, 0), tl_vec3_make(0, 0, h * scale), radius * scale, 0.0f)
                 : tl_convex_cylinder(tl_vec3_make(0, 0, low * scale), tl_vec3_make(0, 0, h * scale), radius * scale,
                                      0.0f);
        tl_convex point = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
        tl_transform identity = tl_transform_identity(), there = identity;
        there.position = tl_vec3_make(scale * test_random_range(&random, -1.8f, 1.8f),
                                      scale * test_random_range(&random, -1.8f, 1.8f),
                                      scale * test_random_range(&random, -1.8f, 1.8f));
        double r = distance_2d((double)there.position.x, (double)there.position.y), z = (double)there.position.z;
        double expected =
            (cone ? cone_distance : cylinder_distance)(r, z, (double)(radius * scale), (double)(h * scale));
        tl_separation s;
        tl_penetration p;
        tl_convex_distance(&shape, identity, &point, there, NULL, &s);
        tl_convex_penetration(&shape, identity, &point, there, NULL, &p);
        TEST_CHECK(s.overlap == p.overlap);
        double size = 2.0 * (double)scale;
        if (fabs(expected) > 1e-7 * size) {
            TEST_CHECK(s.overlap == (expected < 0.0));
        }
        unconverged += s.status != TL_CONVEX_CONVERGED;
        if (expected > 0.0) {
            worst_distance = fmax(worst_distance, fabs((double)s.distance - expected) / size);
            TEST_CHECK((double)s.lower_bound <= expected * (1.0 + 1e-6));
            outside++;
        } else {
            worst_depth = fmax(worst_depth, fabs((double)p.depth + expected) / size);
            TEST_CHECK((double)p.lower_bound <= -expected + 1e-6 * size);
            inside++;
        }
    }
    print_message("worst distance error %g, worst depth error %g of the size; %u of %u not converged\n", worst_distance,
                  worst_depth, unconverged, inside + outside);
    TEST_CHECK(inside > 300 && outside > 2000 && worst_distance < 1e-6 && worst_depth < 1e-5);
    TEST_CHECK(unconverged * 100 <= inside + outside);
}

// A hull of 512 points on the rims and the apex is inside of the shape, by R (1 - cos(pi / 256)) at most.
static tl_hull *make_polyhedron(bool cone, float radius, float h)
{
    static tl_vec3 points[513];
    uint32_t count = 0;
    for (int k = 0; k < 256; k++) {
        float angle = 6.2831853f * (float)k / 256;
        points[count++] = tl_vec3_make(radius * cosf(angle), radius * sinf(angle), cone ? 0.0f : -h);
        if (!cone) {
            points[count++] = tl_vec3_make(radius * cosf(angle), radius * sinf(angle), h);
        }
    }
    if (cone) {
        points[count++] = tl_vec3_make(0, 0, h);
    }
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    return hull;
}

static tl_quat random_rotation(test_random *random)
{
    tl_vec3 a = test_random_direction(random);
    tl_quat q = { a.x, a.y, a.z, test_random_range(random, -1, 1) };
    return tl_quat_normalize(q);
}

static void test_pairs_against_polyhedra(void **state)
{
    (void)state;
    test_random random = { 32 };
    uint32_t overlaps = 0, apart = 0;
    for (int i = 0; i < 60; i++) {
        tl_convex shapes[2], hulls[2];
        tl_hull *owned[2];
        tl_transform poses[2];
        double short_by = 0.0;
        for (int k = 0; k < 2; k++) {
            float radius = test_random_range(&random, 0.2f, 2), h = test_random_range(&random, 0.2f, 2);
            bool cone = (i >> k & 1) != 0;
            owned[k] = make_polyhedron(cone, radius, h);
            hulls[k] = tl_convex_from_hull(owned[k], 0.0f);
            shapes[k] = cone ? tl_convex_cone(tl_vec3_make(0, 0, 0), tl_vec3_make(0, 0, h), radius, 0.0f)
                             : tl_convex_cylinder(tl_vec3_make(0, 0, -h), tl_vec3_make(0, 0, h), radius, 0.0f);
            short_by += (double)radius * 7.6e-5;
        }
        for (int j = 0; j < 20; j++) {
            poses[0].rotation = random_rotation(&random);
            poses[1].rotation = random_rotation(&random);
            poses[0].position = tl_vec3_make(0, 0, 0);
            poses[1].position = tl_scale(test_random_direction(&random), test_random_range(&random, 0, 5));
            tl_separation s, polyhedral;
            tl_penetration p, polyhedral_depth;
            tl_convex_distance(&shapes[0], poses[0], &shapes[1], poses[1], NULL, &s);
            tl_convex_distance(&hulls[0], poses[0], &hulls[1], poses[1], NULL, &polyhedral);
            tl_convex_penetration(&shapes[0], poses[0], &shapes[1], poses[1], NULL, &p);
            tl_convex_penetration(&hulls[0], poses[0], &hulls[1], poses[1], NULL, &polyhedral_depth);
            TEST_CHECK((double)s.distance <= (double)polyhedral.distance + 1e-5 &&
                       (double)s.distance >= (double)polyhedral.distance - short_by - 1e-5);
            TEST_CHECK((double)polyhedral_depth.lower_bound <= (double)p.upper_bound + 1e-5 &&
                       (double)p.lower_bound <= (double)polyhedral_depth.upper_bound + short_by + 1e-5);
            TEST_CHECK(!p.overlap || fabsf(tl_distance(p.point_a, p.point_b) - p.depth) < 1e-5f ||
                       p.status != TL_CONVEX_CONVERGED);
            overlaps += p.overlap;
            apart += !p.overlap;
        }
        tl_blob_free(owned[0]);
        tl_blob_free(owned[1]);
    }
    TEST_CHECK(overlaps > 200 && apart > 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_points), cmocka_unit_test(test_pairs_against_polyhedra) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
