// SPDX-License-Identifier: MIT
//
// Placed hulls of four to eight vertices against plain products, and AVX2 against what every processor runs, bit for
// bit: random points and those of a lattice, where many are as far.

#include "talus_test.h"

#include "convex/core/placed_pair.h"

#include <string.h>

typedef struct two_rows {
    tl_vec3 points[2][8];
    uint32_t count[2];
    tl_frame b_to_a;
} two_rows;

static void make_rows(test_random *random, bool on_lattice, two_rows *r)
{
    for (int side = 0; side < 2; side++) {
        r->count[side] = 4 + test_random_below(random, 5);
        for (uint32_t i = 0; i < 8; i++) {
            r->points[side][i] = test_random_place(random, on_lattice);
        }
    }
    for (int k = 0; k < 3; k++) {
        r->b_to_a.rows[k] = tl_vec3d_from(test_random_place(random, on_lattice));
    }
    r->b_to_a.origin = tl_vec3d_from(test_random_place(random, on_lattice));
}

static tl_vec3d placed(const two_rows *r, int side, uint32_t vertex)
{
    const tl_vec3d p = tl_vec3d_from(r->points[side][vertex]);
    return side == 0 ? p : tl_frame_point(&r->b_to_a, p);
}

static uint32_t plain_farthest(const two_rows *r, int side, tl_vec3d d)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < r->count[side]; i++) {
        best = tl_vec3d_dot(d, placed(r, side, i)) > tl_vec3d_dot(d, placed(r, side, best)) ? i : best;
    }
    return best;
}

static bool same_place(const tl_placed_hull *p, const tl_placed_hull *q)
{
    return memcmp(p->x, q->x, sizeof p->x) == 0 && memcmp(p->y, q->y, sizeof p->y) == 0 &&
           memcmp(p->z, q->z, sizeof p->z) == 0 && p->spare == q->spare;
}

static void check_rows(const two_rows *r, tl_vec3d d)
{
    const tl_vertex_row a = { r->points[0], r->count[0] }, b = { r->points[1], r->count[1] };
    tl_placed_pair pair, base;
    tl_placed_pair_set(&pair, a, b, &r->b_to_a);
    tl_placed_pair_set_base(&base, a, b, &r->b_to_a);
    TEST_CHECK(same_place(&pair.a, &base.a) && same_place(&pair.b, &base.b));
    const uint32_t at = tl_placed_pair_support(&pair, d.x, d.y, d.z);
    TEST_CHECK(at == tl_placed_pair_support_base(&base, d.x, d.y, d.z));
    const uint32_t on_a = tl_placed_vertex(&pair.a, at >> 3), on_b = tl_placed_vertex(&pair.b, at & 7u);
    TEST_CHECK(on_a == plain_farthest(r, 0, d) && on_b == plain_farthest(r, 1, tl_vec3d_neg(d)));
    const tl_vec3d p = tl_placed_point(&pair.a, at >> 3), q = tl_placed_point(&pair.b, at & 7u),
                   there = placed(r, 0, on_a), there_b = placed(r, 1, on_b);
    TEST_CHECK(memcmp(&p, &there, sizeof p) == 0 && memcmp(&q, &there_b, sizeof q) == 0);
}

static void test_placed_hulls(void **state)
{
    (void)state;
    test_random random = { 8 };
    for (int i = 0; i < 100000; i++) {
        two_rows r;
        make_rows(&random, i % 2 == 0, &r);
        check_rows(&r, tl_vec3d_from(test_random_place(&random, i % 2 == 0)));
    }
}

static void test_no_direction(void **state)
{
    (void)state;
    test_random random = { 9 };
    two_rows r;
    make_rows(&random, false, &r);
    const tl_vertex_row a = { r.points[0], r.count[0] }, b = { r.points[1], r.count[1] };
    tl_placed_pair pair;
    tl_placed_pair_set(&pair, a, b, &r.b_to_a);
    TEST_CHECK(tl_placed_pair_support(&pair, (double)NAN, 0.0, 0.0) == 0);
    TEST_CHECK(tl_placed_pair_support_base(&pair, (double)NAN, 0.0, 0.0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_placed_hulls),
        cmocka_unit_test(test_no_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
