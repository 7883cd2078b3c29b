// SPDX-License-Identifier: MIT
//
// The scans of a few points against plain C, bit for bit: with two points in a register and with four, random points
// and those of a lattice, where many are as far.

#include "talus_test.h"

#include "convex/core/farthest.h"

#include <string.h>

enum { MAX_POINTS = 70 };

typedef struct cloud {
    tl_vec3 points[MAX_POINTS];
    uint32_t count;
    tl_vec3d directions[2];
    tl_frame map;
} cloud;

static tl_vec3 random_place(test_random *random, bool on_lattice)
{
    tl_vec3 p = test_random_point(random, tl_vec3_make(-3, -3, -3), tl_vec3_make(3, 3, 3));
    return on_lattice ? tl_vec3_make(truncf(p.x), truncf(p.y), truncf(p.z)) : p;
}

static void make_cloud(test_random *random, cloud *c)
{
    const bool on_lattice = test_random_below(random, 2) == 0;
    c->count = 1 + test_random_below(random, MAX_POINTS);
    for (uint32_t i = 0; i < c->count; i++) {
        c->points[i] = random_place(random, on_lattice);
    }
    for (int k = 0; k < 2; k++) {
        c->directions[k] = tl_vec3d_from(random_place(random, on_lattice));
    }
    for (int k = 0; k < 3; k++) {
        c->map.rows[k] = tl_vec3d_from(random_place(random, on_lattice));
    }
    c->map.origin = tl_vec3d_from(random_place(random, on_lattice));
}

static double plain_reach(const cloud *c, tl_vec3d direction)
{
    const uint32_t vertex = tl_farthest_plain(c->points, c->count, &direction);
    return tl_vec3d_dot(direction, tl_vec3d_from(c->points[vertex])) + 0.0;
}

static double plain_image_sq(const cloud *c)
{
    double most = 0.0;
    for (uint32_t i = 0; i < c->count; i++) {
        const tl_vec3d image = tl_frame_point(&c->map, tl_vec3d_from(c->points[i]));
        const double length_sq = tl_vec3d_dot(image, image);
        most = length_sq > most ? length_sq : most;
    }
    return most;
}

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void check_scans(const cloud *c)
{
    const uint32_t vertex = tl_farthest_plain(c->points, c->count, &c->directions[0]);
    TEST_CHECK(tl_farthest(c->points, c->count, &c->directions[0]) == vertex);
    TEST_CHECK(tl_farthest_base(c->points, c->count, &c->directions[0]) == vertex);
    if (c->count < 4) {
        return;
    }
    for (int directions = 1; directions <= 2; directions++) {
        double reach[2] = { 0.0, 0.0 }, base[2] = { 0.0, 0.0 };
        tl_reach_along(c->points, c->count, c->directions, directions, reach);
        tl_reach_along_base(c->points, c->count, c->directions, directions, base);
        for (int k = 0; k < directions; k++) {
            const double plain = plain_reach(c, c->directions[k]);
            TEST_CHECK(same_bits(reach[k], plain) && same_bits(base[k], plain));
        }
    }
    const double image_sq = plain_image_sq(c);
    TEST_CHECK(same_bits(tl_farthest_image_sq(c->points, c->count, &c->map), image_sq));
    TEST_CHECK(same_bits(tl_farthest_image_sq_base(c->points, c->count, &c->map), image_sq));
}

static void test_scans(void **state)
{
    (void)state;
    test_random random = { 71 };
    for (int i = 0; i < 20000; i++) {
        cloud c;
        make_cloud(&random, &c);
        check_scans(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_scans) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
