// SPDX-License-Identifier: MIT

#include "polygon/merge/polygon_merge.h"

#include "polygon/triangulate/triangulate.h"
#include "polygon_shapes.h"

enum { MAX_POINTS = 512 };

static oracle_point points[MAX_POINTS];
static tl_lattice_point lattice[MAX_POINTS];
static uint32_t triangles[3 * MAX_POINTS], twins[3 * MAX_POINTS];

static tl_convex_parts triangulate_and_merge(tl_arena *arena, uint32_t n, uint32_t max_corners, uint32_t *places)
{
    const tl_triangulate_input input = { lattice, n, NULL, NULL, TL_EARS_BY_SIZE, places };
    TEST_RESULT(tl_triangulate(arena, &input, triangles, twins), TL_OK);
    const tl_merge_input merge = { lattice, triangles, twins, n - 2, max_corners, NULL, NULL, places };
    tl_convex_parts parts;
    TEST_RESULT(tl_merge_triangles(arena, &merge, &parts), TL_OK);
    return parts;
}

// Triangulates, merges, compares with the plain form place by place. Returns the number of polygons.
static uint32_t compare(uint32_t n, uint32_t max_corners)
{
    for (uint32_t i = 0; i < n; i++) {
        lattice[i].x = (int32_t)points[i].x;
        lattice[i].z = (int32_t)points[i].z;
    }
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    static uint32_t places[MAX_POINTS];
    const tl_convex_parts by_place = triangulate_and_merge(&arena, n, max_corners, places);
    const tl_convex_parts parts = triangulate_and_merge(&arena, n, max_corners, NULL);
    TEST_CHECK(by_place.count == parts.count);
    TEST_CHECK(memcmp(by_place.first, parts.first, (parts.count + 1) * sizeof *parts.first) == 0);
    TEST_CHECK(memcmp(by_place.corners, parts.corners, parts.first[parts.count] * sizeof *parts.corners) == 0);
    oracle_polygons expected = oracle_merge(points, triangles, n - 2, max_corners);
    TEST_CHECK(parts.count == expected.count);
    for (uint32_t p = 0; p < parts.count; p++) {
        uint32_t corners = parts.first[p + 1] - parts.first[p];
        TEST_CHECK(corners == expected.sizes[p]);
        TEST_CHECK(oracle_same_polygon(parts.corners + parts.first[p], expected.corners[p], corners));
    }
    uint32_t count = parts.count;
    oracle_polygons_free(&expected, n - 2);
    tl_arena_free(&arena);
    return count;
}

static void a_convex_outline_becomes_one_polygon(void **state)
{
    (void)state;
    const oracle_point hexagon[6] = { { 0, 2 }, { 2, 4 }, { 4, 4 }, { 6, 2 }, { 4, 0 }, { 2, 0 } };
    memcpy(points, hexagon, sizeof hexagon);
    TEST_CHECK(oracle_contour_area2(points, 6) > 0);
    TEST_CHECK(compare(6, 6) == 1);
    TEST_CHECK(compare(6, 5) == 2);
    TEST_CHECK(compare(6, 4) <= 3);
    TEST_CHECK(compare(6, 3) == 4);
    TEST_CHECK(compare(6, 0) == 1);
}

static void equals_the_plain_form_on_random_outlines(void **state)
{
    (void)state;
    static const uint32_t caps[8] = { 0, 3, 4, 5, 6, 8, 12, 64 };
    test_random random = { 11 };
    uint32_t compared = 0, merged = 0;
    for (uint32_t round = 0; round < 2500; round++) {
        uint32_t n = 3 + test_random_below(&random, 25);
        uint32_t side = 4u << test_random_below(&random, 8);
        if (shape_untangled(&random, points, n, side)) {
            merged += compare(n, caps[test_random_below(&random, 8)]) < n - 2;
            compared++;
        }
    }
    TEST_CHECK(compared > 1200 && merged > 800);
}

// Unit edges in two directions: nearly all lengths are equal, so the order rests on places alone.
static void equals_the_plain_form_where_lengths_tie(void **state)
{
    (void)state;
    test_random random = { 12 };
    uint32_t compared = 0;
    for (uint32_t round = 0; round < 1000; round++) {
        uint32_t n = shape_cells(&random, 12, 3 + test_random_below(&random, 70), points, 120);
        if (n >= 4 && oracle_is_simple(points, n)) {
            compare(n, test_random_below(&random, 3) == 0 ? 0 : 3 + test_random_below(&random, 5));
            compared++;
        }
    }
    TEST_CHECK(compared > 200);
    for (uint32_t n = 8; n <= 200; n += 32) {
        shape_comb(points, n, 7);
        compare(n, 6);
        compare(n, 0);
        shape_star(points, n, 5000.0, 4900.0);
        compare(n, 6);
        compare(n, 0);
        shape_spiral(points, n);
        compare(n, 6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_convex_outline_becomes_one_polygon),
        cmocka_unit_test(equals_the_plain_form_on_random_outlines),
        cmocka_unit_test(equals_the_plain_form_where_lengths_tie),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
