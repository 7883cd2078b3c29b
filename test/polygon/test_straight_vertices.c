// SPDX-License-Identifier: MIT
//
// tl_polygon_mesh_bake with drop_straight_vertices.

#include "polygon_shapes.h"

#include <talus/polygon.h>

enum { MAX_POINTS = 256 };

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

static tl_polygon_report build(const tl_contour_set *set, bool drop, uint32_t *polygons)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.drop_straight_vertices = drop;
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, set);
    *polygons = mesh.polygon_count;
    tl_polygon_mesh_free(&mesh);
    return report;
}

// Two squares side by side; the left one's outer side and their common side have a vertex in the middle.
static void only_vertices_without_a_neighbour_go(void **state)
{
    (void)state;
    const tl_contour_vertex corners[11] = { { 0, 0, 0, 0 }, { 0, 0, 2, 0 }, { 0, 0, 4, 0 }, { 4, 0, 4, 0 },
                                            { 4, 0, 2, 0 }, { 4, 0, 0, 0 }, { 4, 0, 0, 0 }, { 4, 0, 2, 0 },
                                            { 4, 0, 4, 0 }, { 8, 0, 4, 0 }, { 8, 0, 0, 0 } };
    const tl_contour contours[2] = { { 0, 6, 1, 10 }, { 6, 5, 2, 10 } };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 11;
    set.contours = contours;
    set.contour_count = 2;
    set.cell_size = set.cell_height = 1.0f;
    uint32_t polygons;
    tl_polygon_report report = build(&set, true, &polygons);
    TEST_CHECK(report.removed_straight_vertices == 1 && report.link_count == 4 && report.vertex_count == 7);
    TEST_CHECK(build(&set, false, &polygons).removed_straight_vertices == 0);
    // On a tile's border the neighbour is out of sight.
    set.border_size = 1;
    set.width = 8;
    set.height = 4;
    TEST_CHECK(build(&set, true, &polygons).removed_straight_vertices == 0);
}

// A triangle whose contour runs to (2, 0) and back, twice: no polygon has that vertex, and nothing is missing.
static void runs_there_and_back_leave_the_outline_whole(void **state)
{
    (void)state;
    const oracle_point runs[9] = { { 2, 0 }, { 0, 0 }, { 0, 2 }, { 0, 0 }, { 0, 2 },
                                   { 1, 2 }, { 2, 0 }, { 1, 2 }, { 0, 0 } };
    tl_contour contour;
    tl_contour_set set = shape_as_set(runs, 9, vertices, &contour);
    uint32_t polygons;
    build(&set, false, &polygons);
    TEST_CHECK(polygons == 1);
    build(&set, true, &polygons);
    TEST_CHECK(polygons == 1);
}

static void fewer_polygons_cover_the_same_floor(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t fewer = 0, gone = 0, kept_all = 0;
    for (uint32_t round = 0; round < 600; round++) {
        uint32_t n = round % 2 == 0 ? shape_cells(&random, 12, 3 + test_random_below(&random, 60), points, MAX_POINTS)
                                    : 3 + test_random_below(&random, 20);
        if (round % 2 != 0) {
            shape_random_points(&random, points, n, 6); // with crossings, spikes and repeated places
            shape_make_outer(points, n);
        }
        if (n < 3) {
            continue;
        }
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, n, vertices, &contour);
        uint32_t before, after;
        build(&set, false, &before);
        tl_polygon_report report = build(&set, true, &after);
        TEST_CHECK(round % 2 != 0 || report.uncovered_area2 == 0 || report.repaired_contours == 1);
        gone += report.removed_straight_vertices;
        fewer += after < before;
        kept_all += report.removed_straight_vertices == 0;
    }
    TEST_CHECK(fewer > 150 && gone > 1000 && kept_all > 50);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    test_random random = { 62 };
    uint32_t n = shape_cells(&random, 12, 60, points, MAX_POINTS);
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    def.drop_straight_vertices = true;
    TEST_CHECK(shape_check_failing_memory(&set, def) > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_vertices_without_a_neighbour_go),
        cmocka_unit_test(runs_there_and_back_leave_the_outline_whole),
        cmocka_unit_test(fewer_polygons_cover_the_same_floor),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
