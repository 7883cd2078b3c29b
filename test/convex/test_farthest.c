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

static void make_cloud(test_random *random, cloud *c)
{
    const bool on_lattice = test_random_below(random, 2) == 0;
    c->count = 1 + test_random_below(random, MAX_POINTS);
    for (uint32_t i = 0; i < c->count; i++) {
        c->points[i] = test_random_place(random, on_lattice);
    }
    for (int k = 0; k < 2; k++) {
        c->directions[k] = tl_vec3d_from(test_random_place(random, on_lattice));
    }
    for (int k = 0; k < 3; k++) {
        c->map.rows[k] = tl_vec3d_from(test_random_place(random, on_lattice));
    }
    c->map.origin = tl_vec3d_from(test_random_place(random, on_lattice));
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

#if TL_CPU_LEVELS >= 2

enum { MOST_FACES = 44 };

// Differences of random pairs of vertices, and the faces between them: what tl_scan_place_avx2 and tl_scan_nearest_avx2
// find, one by one.
static void check_polytope(test_random *random, const cloud *c)
{
    uint16_t vertices[TL_KEPT_POINTS][2];
    uint8_t corners[MOST_FACES][3];
    const uint32_t count = 4 + test_random_below(random, TL_KEPT_POINTS - 3),
                   faces = 4 + test_random_below(random, MOST_FACES - 3);
    tl_placed_points points;
    for (uint32_t i = 0; i < count; i++) {
        vertices[i][0] = (uint16_t)test_random_below(random, c->count);
        vertices[i][1] = (uint16_t)test_random_below(random, c->count);
    }
    const tl_vertex_row row = { c->points, c->count };
    TEST_CHECK(tl_scan_place_avx2(&c->map, row, row, (const uint16_t(*)[2])vertices, count, &points));
    const uint32_t wrong = test_random_below(random, count), side = test_random_below(random, 2);
    const uint16_t right = vertices[wrong][side];
    vertices[wrong][side] = (uint16_t)c->count;
    TEST_CHECK(!tl_scan_place_avx2(&c->map, row, row, (const uint16_t(*)[2])vertices, count, &points));
    vertices[wrong][side] = right;
    TEST_CHECK(tl_scan_place_avx2(&c->map, row, row, (const uint16_t(*)[2])vertices, count, &points));
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3d w = tl_vec3d_sub(tl_vec3d_from(c->points[vertices[i][0]]),
                                        tl_frame_point(&c->map, tl_vec3d_from(c->points[vertices[i][1]])));
        TEST_CHECK(same_bits(points.x[i], w.x) && same_bits(points.y[i], w.y) && same_bits(points.z[i], w.z));
    }
    double nearness[MOST_FACES], least = (double)INFINITY;
    uint32_t nearest = faces;
    for (uint32_t f = 0; f < faces; f++) {
        for (uint32_t i = 0; i < 3; i++) {
            corners[f][i] = (uint8_t)((test_random_below(random, count - 2) + i) % count);
        }
    }
    const uint32_t found =
        tl_scan_nearest_avx2(&points, (const uint8_t(*)[3])corners, faces, -1.0 - c->map.origin.x, nearness);
    for (uint32_t f = 0; f < faces; f++) {
        tl_vec3d w[3];
        for (uint32_t i = 0; i < 3; i++) {
            w[i] = tl_vec3d_make(points.x[corners[f][i]], points.y[corners[f][i]], points.z[corners[f][i]]);
        }
        const tl_vec3d normal = tl_vec3d_cross(tl_vec3d_sub(w[0], w[2]), tl_vec3d_sub(w[1], w[2]));
        const double offset = tl_vec3d_dot(normal, w[2]) - (-1.0 - c->map.origin.x),
                     plain = offset * fabs(offset) / tl_vec3d_dot(normal, normal);
        TEST_CHECK(same_bits(nearness[f], plain) || (isnan(nearness[f]) && isnan(plain)));
        least = plain < least ? plain : least;
    }
    for (uint32_t f = faces; f-- > 0;) {
        nearest = nearness[f] == least ? f : nearest;
    }
    TEST_CHECK(found == (least > 0.0 ? nearest : faces));
}

static void test_polytopes(void **state)
{
    (void)state;
    test_random random = { 73 };
    for (int i = 0; i < 20000 && tl_cpu_has_avx2(); i++) {
        cloud c;
        make_cloud(&random, &c);
        check_polytope(&random, &c);
    }
}

// Blocks of eight planes, of a few planes 4 or 6, of which some have the same normal.
static void test_planes(void **state)
{
    (void)state;
    test_random random = { 74 };
    for (int i = 0; i < 20000 && tl_cpu_has_avx2(); i++) {
        double blocks[4 * TL_SCAN_PLANES + 8] = { 0.0 };
        const uint32_t count = 4 + test_random_below(&random, TL_SCAN_PLANES - 3),
                       lanes = count > 6 ? 8 : (count + 1) / 2 * 2;
        const tl_vec3d d = tl_vec3d_from(test_random_place(&random, true));
        uint32_t best = 0;
        double most = -2.0;
        for (uint32_t k = 0; k < count; k++) {
            tl_vec3d n = tl_vec3d_from(test_random_place(&random, true));
            n = tl_vec3d_scale(n, k == count / 2 && tl_vec3d_dot(n, d) < 0.0 ? -1.0 : 1.0);
            double *at = blocks + 32 * (size_t)(k / 8) + k % 8;
            at[0] = n.x;
            at[lanes] = n.y;
            at[2 * (size_t)lanes] = n.z;
            best = tl_vec3d_dot(n, d) > most ? k : best;
            most = tl_vec3d_dot(n, d) > most ? tl_vec3d_dot(n, d) : most;
        }
        // As in a hull, some normal looks along the direction: lanes without a plane are zero.
        TEST_CHECK(most <= 0.0 || tl_scan_planes_avx2(blocks, count, lanes, &d) == best);
    }
}

#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scans),
#if TL_CPU_LEVELS >= 2
        cmocka_unit_test(test_polytopes),
        cmocka_unit_test(test_planes),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
