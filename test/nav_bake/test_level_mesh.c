// SPDX-License-Identifier: MIT
//
// Checks of the caller's triangles, and which slopes are walkable.

#include "nav_bake/input/level_mesh.h"

#include "math/cos_degrees.h"
#include "talus_test.h"

#include <math.h>

static void bad_meshes_are_named(void **state)
{
    (void)state;
    tl_vec3 vertices[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 2, 1 }, { NAN, NAN, NAN } };
    uint32_t indices[6] = { 0, 1, 2, 2, 1, 0 };
    tl_mesh_view mesh = { vertices, 4, indices, 2, NULL };
    tl_report report = { 0 };
    tl_aabb bounds;
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, &bounds, &report), TL_OK); // vertex 3 is not used
    TEST_CHECK(bounds.max.x == 1 && bounds.max.y == 2 && bounds.max.z == 1 && bounds.min.x == 0);
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, NULL, &report), TL_OK);
    indices[4] = 3;
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, &bounds, &report), TL_ERR_NOT_FINITE);
    TEST_CHECK(report.element_index == 3);
    assert_string_equal(report.element, "vertex");
    vertices[3] = tl_vec3_make(0, 0, 2e12f);
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, &bounds, &report), TL_ERR_RANGE);
    indices[4] = 4;
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, &bounds, &report), TL_ERR_INDEX);
    TEST_CHECK(report.element_index == 1);
    vertices[3] = vertices[2]; // all are sound now, but not the index
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, NULL, &report), TL_ERR_INDEX);
    TEST_CHECK(report.element_index == 1);
    mesh.triangle_count = 0;
    TEST_RESULT(tl_level_mesh_check(&mesh, NULL, NULL, NULL), TL_ERR_EMPTY);
}

// A triangle that rises by `rise` over a run of `run`, turned about y by some angle and moved.
static bool ramp_is_walkable(double rise, double run, double turn, float limit_degrees, tl_vec3 offset)
{
    double c = cos(turn), s = sin(turn);
    tl_vec3 a = offset;
    tl_vec3 b = tl_add(offset, tl_vec3_make((float)(-s * 3), 0, (float)(c * 3)));
    tl_vec3 top = tl_add(offset, tl_vec3_make((float)(c * run), (float)rise, (float)(s * run)));
    return tl_triangle_is_walkable(a, b, top, tl_cos_degrees(limit_degrees));
}

static void slopes_below_the_limit_are_walkable(void **state)
{
    (void)state;
    test_random random = { 4 };
    const double radians = 0.017453292519943295;
    for (uint32_t i = 0; i < 20000; i++) {
        float limit = test_random_range(&random, 1.0f, 89.0f);
        double turn = (double)test_random_range(&random, 0, 6.28f), run = (double)test_random_range(&random, 0.1f, 50);
        tl_vec3 offset = { 0, 0, 0 };
        TEST_CHECK(ramp_is_walkable(run * tan(((double)limit - 0.01) * radians), run, turn, limit, offset));
        TEST_CHECK(!ramp_is_walkable(run * tan(((double)limit + 0.01) * radians), run, turn, limit, offset));
    }
    // Flat ground is walkable at any limit, but not from below, and not what has no area.
    TEST_CHECK(ramp_is_walkable(0, 1, 1, 0, tl_vec3_make(5, 5, 5)));
    const float flat = tl_cos_degrees(0), loose = tl_cos_degrees(89);
    tl_vec3 a = { 0, 0, 0 }, b = { 1, 0, 0 }, c = { 0, 0, 1 };
    TEST_CHECK(tl_triangle_is_walkable(a, c, b, flat) && !tl_triangle_is_walkable(a, b, c, flat));
    TEST_CHECK(!tl_triangle_is_walkable(a, b, c, loose) && !tl_triangle_is_walkable(a, b, b, loose));
    TEST_CHECK(!tl_triangle_is_walkable(a, a, a, loose));
    // Sizes from 1e-6 to 1e9 metres.
    for (float size = 1e-6f; size < 1e10f; size *= 10) {
        TEST_CHECK(tl_triangle_is_walkable(tl_scale(a, size), tl_scale(c, size), tl_scale(b, size), flat));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(bad_meshes_are_named),
                                        cmocka_unit_test(slopes_below_the_limit_are_walkable) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
