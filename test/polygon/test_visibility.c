// SPDX-License-Identifier: MIT

#include "polygon/optimal/visibility.h"

#include "polygon/triangulate/triangulate.h"
#include "polygon_shapes.h"

enum { MAX_POINTS = 256 };

static oracle_point points[MAX_POINTS];
static tl_lattice_point lattice[MAX_POINTS];
static uint32_t triangles[3 * MAX_POINTS], twins[3 * MAX_POINTS], identity[MAX_POINTS];

static tl_visibility look(tl_arena *arena, uint32_t n, uint64_t max_chords, bool *found)
{
    for (uint32_t i = 0; i < n; i++) {
        lattice[i].x = (int32_t)points[i].x;
        lattice[i].z = (int32_t)points[i].z;
    }
    tl_visibility visibility;
    const tl_triangulate_input input = { lattice, n, NULL, NULL, TL_EARS_BY_SIZE, NULL };
    TEST_RESULT(tl_triangulate(arena, &input, triangles, twins), TL_OK);
    const tl_triangulated_outline outline = { lattice, n, triangles, twins };
    TEST_RESULT(tl_find_visibility(arena, &outline, max_chords, &visibility, found), TL_OK);
    return visibility;
}

// Each pair of corners against each edge. Returns the chords that are not edges.
static uint32_t compare(uint32_t n)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    bool found;
    tl_visibility seen = look(&arena, n, UINT32_MAX, &found);
    TEST_CHECK(found);
    uint32_t chords = 0;
    for (uint32_t i = 0; i < n; i++) {
        identity[i] = i;
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t at = seen.first[i];
        for (uint32_t j = i + 1; j < n; j++) {
            bool is_edge = j == i + 1 || (i == 0 && j == n - 1);
            bool is_listed = at < seen.first[i + 1] && seen.to[at] == j;
            TEST_CHECK(is_listed == (is_edge || oracle_sees(points, identity, n, i, j)));
            at += is_listed;
            chords += is_listed && !is_edge;
        }
        TEST_CHECK(at == seen.first[i + 1]);
    }
    tl_arena_free(&arena);
    return chords;
}

static void equals_the_plain_form(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t compared = 0, straight = 0, chords = 0;
    for (uint32_t round = 0; round < 1500; round++) {
        uint32_t n = 3 + test_random_below(&random, round % 50 == 0 ? 60 : 20);
        if (shape_untangled(&random, points, n, 4u << test_random_below(&random, 12))) {
            chords += compare(n);
            compared++;
        }
        n = shape_cells(&random, 12, 3 + test_random_below(&random, 60), points, 120);
        if (n >= 4 && oracle_is_simple(points, n)) {
            chords += compare(n);
            straight++;
        }
    }
    TEST_CHECK(compared > 700 && straight > 300 && chords > 10000);
    for (uint32_t n = 8; n <= 120; n += 28) {
        shape_star(points, n, 5000.0, 1000.0);
        compare(n);
        shape_comb(points, n, 7);
        compare(n);
        shape_spiral(points, n);
        compare(n);
    }
}

static void all_corners_of_a_convex_outline_see_each_other(void **state)
{
    (void)state;
    shape_star(points, 100, 1e8, 1e8);
    TEST_CHECK(compare(100) == 100 * 97 / 2);
}

// At a bridge two corners lie at one place; each sees its own side only.
static void sides_of_a_bridge_are_told_apart(void **state)
{
    (void)state;
    uint32_t n = shape_holes(points, 1, 1);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    bool found;
    tl_visibility seen = look(&arena, n, UINT32_MAX, &found);
    TEST_CHECK(found);
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t k = seen.first[i]; k < seen.first[i + 1]; k++) {
            TEST_CHECK(!oracle_same(points[i], points[seen.to[k]]));
            for (uint32_t e = 0; e < n; e++) {
                // No chord crosses an edge from side to side.
                oracle_point a = points[i], b = points[seen.to[k]], c = points[e], d = points[(e + 1) % n];
                int sides = oracle_sign(oracle_area2(a, b, c)) * oracle_sign(oracle_area2(a, b, d));
                TEST_CHECK(sides >= 0 || oracle_sign(oracle_area2(c, d, a)) * oracle_sign(oracle_area2(c, d, b)) >= 0);
            }
        }
    }
    tl_arena_free(&arena);
}

static void gives_up_above_the_limit(void **state)
{
    (void)state;
    shape_star(points, 50, 1e6, 1e6);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    bool found;
    look(&arena, 50, 50 * 49 / 2, &found);
    TEST_CHECK(found);
    look(&arena, 50, 50 * 49 / 2 - 1, &found);
    TEST_CHECK(!found);
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_the_plain_form),
        cmocka_unit_test(all_corners_of_a_convex_outline_see_each_other),
        cmocka_unit_test(sides_of_a_bridge_are_told_apart),
        cmocka_unit_test(gives_up_above_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
