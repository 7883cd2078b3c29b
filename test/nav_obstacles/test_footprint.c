// SPDX-License-Identifier: MIT
//
// Which outlines an obstacle may have.

#include "nav_obstacles/footprint.h"
#include "talus_test.h"

#include <math.h>

// Corners in the middle of a rectangle's sides, wherever it is turned and however large: floats put them a little
// beyond the sides, and they are no dents. Those that are moved inwards by a thousandth are.
static void test_corners_on_sides(void **state)
{
    (void)state;
    test_random random = { 77 };
    uint32_t beyond = 0;
    for (uint32_t round = 0; round < 2000; round++) {
        const double size = ldexp(1.0, (int)test_random_below(&random, 24) - 12);
        const double angle = (double)test_random_below(&random, 6283) * 1e-3;
        const double corner[8][2] = { { -2, -1 }, { 0, -1 }, { 2, -1 }, { 2, 0 },
                                      { 2, 1 },   { 0, 1 },  { -2, 1 }, { -2, 0 } };
        const double dent = round % 2 == 0 ? 1.0 : 0.999;
        tl_nav_obstacle prism = { .shape = TL_NAV_OBSTACLE_PRISM, .height = 1, .point_count = 8 };
        for (int i = 0; i < 8; i++) {
            const double share = i % 2 == 1 ? dent : 1.0;
            const double x = corner[i][0] * share * size, z = corner[i][1] * share * size;
            prism.points[i].x = (float)(x * cos(angle) - z * sin(angle));
            prism.points[i].z = (float)(x * sin(angle) + z * cos(angle));
        }
        TEST_RESULT(tl_obstacle_check(&prism, NULL), dent == 1.0 ? TL_OK : TL_ERR_ARGUMENT);
        const tl_vec3 *p = prism.points;
        beyond += dent == 1.0 && ((double)p[2].x - (double)p[0].x) * ((double)p[1].z - (double)p[0].z) >
                                     ((double)p[2].z - (double)p[0].z) * ((double)p[1].x - (double)p[0].x);
    }
    TEST_CHECK(beyond > 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_corners_on_sides) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
