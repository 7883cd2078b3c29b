// SPDX-License-Identifier: MIT

#include "polygon/triangulate/reflex_tree.h"

#include "talus_test.h"

enum { POINTS = 700, QUERIES = 4000 };

static bool brute(const tl_lattice_point *p, const uint8_t *alive, tl_lattice_point a, tl_lattice_point b,
                  tl_lattice_point c)
{
    for (uint32_t i = 0; i < POINTS; i++) {
        if (alive[i] && tl_turn(a, b, p[i]) >= 0 && tl_turn(b, c, p[i]) >= 0 && tl_turn(c, a, p[i]) >= 0 &&
            !tl_same_point(p[i], a) && !tl_same_point(p[i], b) && !tl_same_point(p[i], c)) {
            return true;
        }
    }
    return false;
}

static tl_lattice_point random_point(test_random *random, uint32_t side)
{
    tl_lattice_point p = { (int32_t)test_random_below(random, side), (int32_t)test_random_below(random, side) };
    return p;
}

static void answers_as_the_plain_loop_while_points_go(void **state)
{
    (void)state;
    static const uint32_t sides[3] = { 12, 300, 1u << 29 };
    test_random random = { 5 };
    for (uint32_t s = 0; s < 3; s++) {
        tl_lattice_point points[POINTS];
        uint8_t alive[POINTS];
        for (uint32_t i = 0; i < POINTS; i++) {
            points[i] = random_point(&random, sides[s]);
            alive[i] = test_random_below(&random, 3) != 0;
        }
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_reflex_tree tree;
        TEST_CHECK(tl_reflex_tree_init(&tree, &arena, points, alive, POINTS));
        uint32_t hits = 0, misses = 0, left = 0;
        for (uint32_t q = 0; q < QUERIES; q++) {
            tl_lattice_point a = random_point(&random, sides[s]);
            tl_lattice_point b = points[test_random_below(&random, POINTS)];
            tl_lattice_point c = random_point(&random, sides[s]);
            // Half of them small, so that some are empty.
            if (q % 2 == 0) {
                int32_t reach = (int32_t)(sides[s] / 12);
                a.x = b.x + a.x % (reach + 1);
                c.z = b.z + c.z % (reach + 1);
                a.z = b.z, c.x = b.x;
            }
            if (tl_turn(a, b, c) <= 0) {
                tl_lattice_point t = a;
                a = c;
                c = t;
            }
            if (tl_turn(a, b, c) > 0) {
                bool expected = brute(points, alive, a, b, c);
                TEST_CHECK(tl_reflex_tree_any_in_triangle(&tree, a, b, c) == expected);
                hits += expected;
                misses += !expected;
            }
            uint32_t gone = test_random_below(&random, POINTS);
            if (q % 4 == 3 && alive[gone]) {
                alive[gone] = 0;
                tl_reflex_tree_remove(&tree, gone);
            }
        }
        for (uint32_t i = 0; i < POINTS; i++) {
            left += alive[i];
        }
        TEST_CHECK(hits > 300 && misses > 300 && left > 0 && left < 300);
        tl_arena_free(&arena);
    }
}

static void an_empty_tree_has_no_points(void **state)
{
    (void)state;
    const tl_lattice_point points[3] = { { 0, 0 }, { 1, 1 }, { 2, 0 } };
    const uint8_t none[3] = { 0, 0, 0 };
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_reflex_tree tree;
    TEST_CHECK(tl_reflex_tree_init(&tree, &arena, points, none, 3));
    tl_lattice_point a = { -9, -9 }, b = { -9, 90 }, c = { 90, -9 };
    TEST_CHECK(tl_turn(a, b, c) > 0);
    TEST_CHECK(!tl_reflex_tree_any_in_triangle(&tree, a, b, c));
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_as_the_plain_loop_while_points_go),
        cmocka_unit_test(an_empty_tree_has_no_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
