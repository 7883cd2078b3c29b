// SPDX-License-Identifier: MIT
//
// Outlines of every size and kind through tl_polygon_mesh_bake with TL_PARTITION_OPTIMAL.

#include "polygon_shapes.h"

#include <talus/polygon.h>

enum { MAX_POINTS = 8192 };

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

typedef struct outcome {
    tl_polygon_report report;
    uint32_t classic; // polygons of the classic method
} outcome;

static outcome build(uint32_t n, uint32_t cap)
{
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = cap;
    tl_polygon_mesh mesh;
    outcome o;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &o.report), TL_OK);
    o.classic = o.report.polygon_count;
    TEST_CHECK(o.report.lower_bound <= o.classic);
    tl_polygon_mesh_free(&mesh);
    def.method = TL_PARTITION_OPTIMAL;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &o.report), TL_OK);
    shape_check_mesh(&mesh, &set);
    TEST_CHECK(o.report.lower_bound <= o.report.polygon_count && o.report.polygon_count <= o.classic);
    TEST_CHECK(o.report.lower_bound >= 1 || o.report.polygon_count == 0);
    tl_polygon_mesh_free(&mesh);
    return o;
}

static void small_outlines_are_exact(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t exact = 0;
    for (uint32_t round = 0; round < 300; round++) {
        uint32_t n = 3 + test_random_below(&random, 40);
        if (shape_untangled(&random, points, n, 8u << test_random_below(&random, 10))) {
            outcome o = build(n, 6);
            TEST_CHECK(o.report.lower_bound == o.report.polygon_count);
            exact++;
        }
    }
    TEST_CHECK(exact > 150);
    // A convex outline of the promised size takes the most chords and steps.
    shape_star(points, 128, 1e8, 1e8);
    outcome o = build(128, 6);
    TEST_CHECK(o.report.lower_bound == 32 && o.report.polygon_count == 32);
}

static void outlines_with_holes_are_divided(void **state)
{
    (void)state;
    for (uint32_t columns = 1; columns <= 5; columns++) {
        for (uint32_t rows = 1; rows <= 5; rows++) {
            outcome o = build(shape_holes(points, columns, rows), columns % 2 == 0 ? 6 : 0);
            // Each hole's four corners need a chord each, and a chord has two ends.
            TEST_CHECK(o.report.polygon_count >= columns * rows + 1);
        }
    }
    build(shape_holes(points, 20, 20), 6);
}

static void large_outlines_are_divided_in_pieces(void **state)
{
    (void)state;
    uint32_t better = 0;
    for (uint32_t n = 1000; n <= MAX_POINTS; n *= 2) {
        shape_star(points, n, 1e8, 3e7);
        better += build(n, 6).report.polygon_count < build(n, 6).classic;
        shape_star(points, n, 1e8, 1e8);
        build(n, 6);
        shape_comb(points, n, 1000);
        build(n, 0);
        shape_spiral(points, n);
        build(n, 5);
    }
    TEST_CHECK(better > 0);
}

static void scribbles_are_divided(void **state)
{
    (void)state;
    test_random random = { 42 };
    uint32_t divided = 0, repaired = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        uint32_t n = 3 + test_random_below(&random, 20);
        shape_random_points(&random, points, n, 4u << test_random_below(&random, 8));
        shape_make_outer(points, n);
        outcome o = build(n, round % 3 == 0 ? 0 : 3 + round % 7);
        divided += o.report.polygon_count > 0;
        repaired += o.report.repaired_contours;
    }
    TEST_CHECK(divided > 2000 && repaired > 1500);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    // Bridges take the general way; the second outline is too large for one solution.
    for (uint32_t kind = 0; kind < 2; kind++) {
        uint32_t n = kind == 0 ? shape_holes(points, 12, 12) : 6000;
        if (kind == 1) {
            shape_star(points, n, 1e8, 1e8);
        }
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, n, vertices, &contour);
        tl_polygon_def def = tl_default_polygon_def();
        def.method = TL_PARTITION_OPTIMAL;
        TEST_CHECK(shape_check_failing_memory(&set, def) > 6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_outlines_are_exact),
        cmocka_unit_test(outlines_with_holes_are_divided),
        cmocka_unit_test(large_outlines_are_divided_in_pieces),
        cmocka_unit_test(scribbles_are_divided),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
