// SPDX-License-Identifier: MIT
//
// What the pipeline refuses before any work, by name.

#include "nav_bake/input/input_check.h"

#include "nav_level.h"

#include <math.h>

static test_level LEVEL;

static void expect(const tl_nav_input *input, tl_result expected, const char *element, uint64_t index)
{
    tl_report report;
    TEST_RESULT(tl_nav_input_check(input, NULL, NULL, &report), expected);
    if (expected != TL_OK) {
        assert_string_equal(report.element, element);
        TEST_CHECK(report.element_index == index && report.advice != NULL);
    }
}

static void volumes_are_checked(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_vec3 points[3] = { { 0, 0, 0 }, { 0, 0, 5 }, { 5, 0, 0 } };
    tl_nav_volume volumes[3];
    memset(volumes, 0, sizeof volumes);
    volumes[0].kind = TL_NAV_VOLUME_BOX;
    volumes[1].kind = TL_NAV_VOLUME_POLYGON;
    volumes[1].points = points;
    volumes[1].point_count = 3;
    volumes[2].kind = TL_NAV_VOLUME_CYLINDER;
    volumes[2].radius = volumes[2].height = 1;
    tl_nav_input input = { LEVEL.mesh, NULL, volumes, 3 };
    expect(&input, TL_OK, NULL, 0);
    volumes[1].area = TL_NAV_MAX_AREA;
    expect(&input, TL_OK, NULL, 0);
    volumes[1].point_count = 2;
    expect(&input, TL_ERR_ARGUMENT, "volume", 1);
    volumes[1].point_count = 3;
    points[2].y = NAN;
    expect(&input, TL_ERR_NOT_FINITE, "volume", 1);
    points[2].y = 0;
    volumes[0].box.max.z = INFINITY;
    expect(&input, TL_ERR_NOT_FINITE, "volume", 0);
    volumes[0].box.max.z = 0;
    volumes[2].radius = NAN;
    expect(&input, TL_ERR_NOT_FINITE, "volume", 2);
    volumes[2].radius = 1;
    int kind = 9;
    memcpy(&volumes[2].kind, &kind, sizeof volumes[2].kind);
    expect(&input, TL_ERR_ARGUMENT, "volume", 2);
}

static void meshes_and_areas_are_checked(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    uint8_t areas[TEST_LEVEL_MAX_TRIANGLES] = { 0 };
    tl_nav_input input = { LEVEL.mesh, areas, NULL, 0 };
    tl_aabb bounds, expected = test_level_bounds(&LEVEL);
    TEST_RESULT(tl_nav_input_check(&input, NULL, &bounds, NULL), TL_OK);
    TEST_CHECK(memcmp(&bounds, &expected, sizeof bounds) == 0);
    areas[7] = TL_NAV_MAX_AREA;
    expect(&input, TL_OK, NULL, 0);
    LEVEL.indices[3 * 5] = 1000;
    expect(&input, TL_ERR_INDEX, "triangle", 5);
    input.mesh.triangle_count = 0;
    expect(&input, TL_ERR_EMPTY, "triangle", TL_NO_ELEMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(volumes_are_checked),
                                        cmocka_unit_test(meshes_and_areas_are_checked) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
