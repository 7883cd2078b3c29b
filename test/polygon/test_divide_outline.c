// SPDX-License-Identifier: MIT

#include "polygon/optimal/divide_outline.h"

#include "polygon/triangulate/triangulate.h"
#include "polygon_shapes.h"

enum { MAX_POINTS = 512 };

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

static tl_division divide(tl_arena *arena, uint32_t n, tl_partition_method method, uint32_t cap)
{
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_outline outline;
    tl_division division;
    TEST_RESULT(tl_outline_prepare(arena, set.vertices, n, 2, &outline), TL_OK);
    TEST_CHECK(outline.walk_count > 0);
    TEST_RESULT(tl_divide_outline(arena, &outline, method, cap, NULL, &division), TL_OK);
    return division;
}

static uint32_t bound(uint32_t n, uint32_t cap)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    uint32_t result = divide(&arena, n, TL_PARTITION_CLASSIC, cap).lower_bound;
    tl_arena_free(&arena);
    return result;
}

static void bounds_of_known_shapes(void **state)
{
    (void)state;
    shape_star(points, 12, 1e6, 1e6);
    TEST_CHECK(bound(12, 0) == 1 && bound(12, 12) == 1 && bound(12, 11) == 2 && bound(12, 6) == 3 &&
               bound(12, 3) == 10);
    // Two notches between neighbouring teeth, each in need of a chord's end.
    shape_comb(points, 40, 7);
    TEST_CHECK(bound(40, 0) == 10 && bound(40, 3) == 38);
    // Four corners of a hole need two chords at least, and two chords cut a ring in two. The bridge ends in one of
    // them.
    uint32_t n = shape_holes(points, 1, 1);
    TEST_CHECK(bound(n, 0) >= 1 && bound(n, 0) <= 2);
}

static void no_method_goes_below_the_bound(void **state)
{
    (void)state;
    static const uint32_t caps[4] = { 0, 3, 5, 6 };
    test_random random = { 81 };
    uint32_t tested = 0, above = 0;
    for (uint32_t round = 0; round < 800; round++) {
        uint32_t n = 4 + test_random_below(&random, 30);
        bool is_good = shape_untangled(&random, points, n, 8u << test_random_below(&random, 10));
        if (round % 10 == 0) {
            n = shape_holes(points, 1 + test_random_below(&random, 4), 1 + test_random_below(&random, 4));
            is_good = true;
        }
        if (!is_good) {
            continue;
        }
        uint32_t cap = caps[round % 4];
        uint32_t least = bound(n, cap);
        for (uint32_t m = 0; m < 3; m++) {
            tl_arena arena;
            tl_arena_init(&arena, NULL);
            tl_division division = divide(&arena, n, (tl_partition_method)m, cap);
            TEST_CHECK(division.parts.count >= least && division.parts.count >= division.lower_bound);
            TEST_CHECK(division.triangle_count == n - 2);
            above += division.parts.count > least;
            tl_arena_free(&arena);
        }
        tested++;
    }
    TEST_CHECK(tested > 400 && above > 400);
}

static void edges_are_paired_once(void **state)
{
    (void)state;
    // Two triangles on the edge 1 - 2; the first lies open elsewhere.
    const uint32_t corners[6] = { 0, 1, 2, 2, 1, 3 };
    uint32_t twins[6], pairs = 0;
    memset(twins, 0xff, sizeof twins);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    TEST_RESULT(tl_pair_edges(&arena, corners, twins, 6, &pairs), TL_OK);
    TEST_CHECK(pairs == 1 && twins[1] == 3 && twins[3] == 1 && twins[0] == TL_NO_EDGE && twins[5] == TL_NO_EDGE);
    TEST_RESULT(tl_pair_edges(&arena, corners, twins, 6, &pairs), TL_OK);
    TEST_CHECK(pairs == 1);
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_of_known_shapes),
        cmocka_unit_test(no_method_goes_below_the_bound),
        cmocka_unit_test(edges_are_paired_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
