// SPDX-License-Identifier: MIT
//
// Points on a coarse lattice: which clouds are, and that there the sign of a height in double is the exact one.

#include "talus_test.h"

#include "hull/bake/quickhull.h"

#include <math.h>

enum { FULL = (1 << 15) - 1 }; // units that the farthest coordinate may have

static tl_vec3 lattice_point(test_random *random, int32_t units)
{
    uint32_t range = 2 * (uint32_t)units + 1;
    return tl_vec3_make((float)((int32_t)test_random_below(random, range) - units),
                        (float)((int32_t)test_random_below(random, range) - units),
                        (float)((int32_t)test_random_below(random, range) - units));
}

static tl_vec3 scaled_by_power(tl_vec3 p, int exponent)
{
    return tl_vec3_make(ldexpf(p.x, exponent), ldexpf(p.y, exponent), ldexpf(p.z, exponent));
}

static bool is_on_lattice(const tl_vec3 *points, uint32_t count)
{
    tl_quickhull_point local[4];
    tl_vec3 reach = { 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        local[i].position = points[i];
        local[i].next = TL_NONE;
        reach = tl_max(reach, tl_abs(points[i]));
    }
    return tl_quickhull_on_lattice(local, count, reach);
}

static void test_clouds_on_a_lattice_are_told(void **state)
{
    (void)state;
    static const int exponents[] = { -149, -126, -20, 0, 60, 84 };
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; e++) {
        tl_vec3 points[2] = { { FULL, 0, -7 }, { -3, 1, FULL } };
        tl_vec3 scaled[2] = { scaled_by_power(points[0], exponents[e]), scaled_by_power(points[1], exponents[e]) };
        TEST_CHECK(is_on_lattice(scaled, 2));
        // Two farther is an odd number that takes a bit more than there are.
        scaled[0].x = ldexpf(FULL + 2, exponents[e]);
        TEST_CHECK(!is_on_lattice(scaled, 2));
    }
    tl_vec3 thirds[2] = { { 1.0f, 0.0f, 0.0f }, { 0.0f, 1.0f / 3.0f, 0.0f } };
    TEST_CHECK(!is_on_lattice(thirds, 2));
}

// The fourth point in the plane of the others, off it by one step, or anywhere.
static tl_vec3 fourth_point(test_random *random, const tl_vec3 p[3], uint32_t kind)
{
    tl_vec3 d = kind < 2 ? tl_add(p[0], tl_sub(p[1], p[2])) : lattice_point(random, FULL);
    if (kind == 1) {
        d.z += 1.0f;
    }
    tl_vec3 size = tl_abs(d);
    return size.x <= FULL && size.y <= FULL && size.z <= FULL ? d : lattice_point(random, FULL);
}

static void test_heights_on_a_lattice_are_exact(void **state)
{
    (void)state;
    test_random random = { 18 };
    const double exact[3] = { 0.0, 0.0, 0.0 };
    uint32_t in_plane = 0, off = 0;
    for (uint32_t i = 0; i < 200000; i++) {
        int32_t units = i % 3 == 0 ? FULL : i % 3 == 1 ? FULL / 3 : 5;
        tl_vec3 p[4] = {
            lattice_point(&random, units), lattice_point(&random, units), lattice_point(&random, units), { 0, 0, 0 }
        };
        p[3] = fourth_point(&random, p, i / 3 % 3);
        int exponent = (int)test_random_below(&random, 180) - 120;
        for (int k = 0; k < 4; k++) {
            p[k] = scaled_by_power(p[k], exponent);
        }
        tl_side_plane plane = tl_side_plane_make(p[0], p[1], p[2], exact);
        int sign = tl_side_plane_sign(&plane, tl_side_plane_height(&plane, p[3]));
        TEST_CHECK(plane.error == 0.0 && sign == tl_orient3d(p[0], p[1], p[2], p[3]));
        in_plane += sign == 0;
        off += sign != 0;
    }
    TEST_CHECK(in_plane > 20000 && off > 100000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_clouds_on_a_lattice_are_told),
        cmocka_unit_test(test_heights_on_a_lattice_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
