// SPDX-License-Identifier: MIT
//
// tl_polygon_mesh_bake with merge_contours.

#include "polygon_shapes.h"

#include <talus/polygon.h>

enum { MAX_POINTS = 128 };

static oracle_point points[MAX_POINTS];
static uint32_t triangles[3 * MAX_POINTS];
static tl_contour_vertex vertices[3 * MAX_POINTS];
static tl_contour contours[MAX_POINTS];

static tl_contour_set as_set(uint32_t vertex_count, uint32_t contour_count)
{
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.vertex_count = vertex_count;
    set.contours = contours;
    set.contour_count = contour_count;
    set.cell_size = set.cell_height = 1.0f;
    return set;
}

static tl_polygon_report build(const tl_contour_set *set, uint32_t cap, bool merge, uint32_t *first_contour)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.merge_contours = merge;
    def.max_verts_per_poly = cap;
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, set);
    *first_contour = mesh.polygon_count > 0 ? mesh.contours[0] : 0;
    tl_polygon_mesh_free(&mesh);
    return report;
}

static void only_one_region_and_area_is_merged(void **state)
{
    (void)state;
    const tl_contour_vertex corners[8] = { { 0, 0, 0, 0 }, { 0, 0, 4, 0 }, { 4, 0, 4, 0 }, { 4, 0, 0, 0 },
                                           { 4, 0, 0, 0 }, { 4, 0, 4, 0 }, { 8, 0, 3, 0 }, { 8, 0, 1, 0 } };
    memcpy(vertices, corners, sizeof corners);
    for (uint32_t kind = 0; kind < 4; kind++) {
        const tl_contour two[2] = { { 0, 4, 1, 10 }, { 4, 4, kind & 1 ? 2 : 1, kind & 2 ? 20 : 10 } };
        memcpy(contours, two, sizeof two);
        tl_contour_set set = as_set(8, 2);
        uint32_t contour;
        tl_polygon_report report = build(&set, 6, true, &contour);
        TEST_CHECK(report.polygon_count == (kind == 0 ? 1 : 2) && report.contour_merges == (kind == 0 ? 1 : 0));
        TEST_CHECK(contour == (kind == 0 ? TL_SEVERAL_CONTOURS : 0));
        TEST_CHECK(build(&set, 6, false, &contour).polygon_count == 2);
        TEST_CHECK(build(&set, 5, true, &contour).polygon_count == 2);
    }
}

// An outline that comes as one contour a triangle is put together as if it had come whole.
static void triangles_of_an_outline_are_put_together(void **state)
{
    (void)state;
    test_random random = { 71 };
    uint32_t tested = 0, merged = 0, equal = 0;
    for (uint32_t round = 0; round < 600; round++) {
        uint32_t n = 4 + test_random_below(&random, 25);
        if (!shape_untangled(&random, points, n, 16u << test_random_below(&random, 8)) ||
            !oracle_triangulate(points, n, triangles)) {
            continue;
        }
        for (uint32_t i = 0; i < 3 * (n - 2); i++) {
            tl_contour_vertex v = { (int32_t)points[triangles[i]].x, 0, (int32_t)points[triangles[i]].z, 0 };
            vertices[i] = v;
        }
        for (uint32_t t = 0; t < n - 2; t++) {
            tl_contour contour = { 3 * t, 3, 5, 63 };
            contours[t] = contour;
        }
        tl_contour_set set = as_set(3 * (n - 2), n - 2);
        uint32_t cap = round % 3 == 0 ? 0 : 4 + round % 5, contour;
        TEST_CHECK(build(&set, cap, false, &contour).polygon_count == n - 2);
        tl_polygon_report report = build(&set, cap, true, &contour);
        TEST_CHECK(report.polygon_count + report.contour_merges == n - 2);
        oracle_polygons expected = oracle_merge(points, triangles, n - 2, cap);
        equal += report.polygon_count == expected.count;
        oracle_polygons_free(&expected, n - 2);
        merged += report.contour_merges;
        tested++;
    }
    // Equal but where edges of one length tie.
    TEST_CHECK(tested > 250 && merged > 1000 && equal + 20 > tested);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 30; i++) {
        int32_t x = 4 * (int32_t)i;
        const tl_contour_vertex corners[4] = { { x, 0, 0, 0 }, { x, 0, 4, 0 }, { x + 4, 0, 4, 0 }, { x + 4, 0, 0, 0 } };
        memcpy(vertices + 4 * (size_t)i, corners, sizeof corners);
        tl_contour contour = { 4 * i, 4, 1 + i / 10, 1 };
        contours[i] = contour;
    }
    tl_contour_set set = as_set(120, 30);
    tl_polygon_def def = tl_default_polygon_def();
    def.merge_contours = true;
    TEST_CHECK(shape_check_failing_memory(&set, def) > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_one_region_and_area_is_merged),
        cmocka_unit_test(triangles_of_an_outline_are_put_together),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
