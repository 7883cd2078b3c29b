// SPDX-License-Identifier: MIT

#include "polygon_shapes.h"

#include <talus/polygon.h>

enum { MAX_POINTS = 4096 };

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

static void two_contours_meet_in_links(void **state)
{
    (void)state;
    const tl_contour_vertex corners[8] = { { 0, 0, 0, 0 }, { 0, 0, 4, 0 }, { 4, 1, 4, 2 }, { 4, 1, 0, 0 },
                                           { 4, 3, 0, 0 }, { 4, 2, 4, 1 }, { 8, 0, 4, 0 }, { 8, 0, 0, 0 } };
    const tl_contour contours[2] = { { 0, 4, 1, 10 }, { 4, 4, 2, 20 } };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 8;
    set.contours = contours;
    set.contour_count = 2;
    set.bounds.min = tl_vec3_make(10.0f, 20.0f, 30.0f);
    set.cell_size = 0.5f;
    set.cell_height = 0.25f;
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, &set);
    TEST_CHECK(mesh.polygon_count == 2 && mesh.vertex_count == 6 && mesh.index_count == 8);
    TEST_CHECK(mesh.regions[0] == 1 && mesh.regions[1] == 2 && mesh.areas[0] == 10 && mesh.areas[1] == 20);
    TEST_CHECK(report.link_count == 1 && report.portal_count == 0 && report.triangle_count == 4);
    tl_vec3 v = tl_polygon_mesh_vertex(&mesh, 2);
    TEST_CHECK(v.x == 12.0f && v.y == 20.25f && v.z == 32.0f);
    tl_polygon_mesh_free(&mesh);
    // Heights 1 and 3, 1 and 2 at the shared corners: an exact merge leaves both pairs apart, one unit one of them.
    static const uint32_t heights[3] = { 0, 1, 2 }, expected_vertices[3] = { 8, 7, 6 }, expected_links[3] = { 0, 0, 1 };
    for (uint32_t i = 0; i < 3; i++) {
        def.merge_height = heights[i];
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
        shape_check_mesh(&mesh, &set);
        TEST_CHECK(mesh.vertex_count == expected_vertices[i] && report.link_count == expected_links[i]);
        tl_polygon_mesh_free(&mesh);
    }
}

// Scribbles of all kinds: whatever is built passes the validator, and whatever is not as it came has a note.
static void scribbles_give_good_meshes(void **state)
{
    (void)state;
    test_random random = { 31 };
    uint32_t plain = 0, touched = 0, repaired = 0, empty = 0;
    for (uint32_t round = 0; round < 6000; round++) {
        uint32_t n = 3 + test_random_below(&random, round % 16 == 0 ? 40 : 9);
        shape_random_points(&random, points, n, 3u << test_random_below(&random, 10));
        if (round % 3 == 0) {
            shape_make_outer(points, n);
        }
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, n, vertices, &contour);
        tl_polygon_def def = tl_default_polygon_def();
        def.max_verts_per_poly = 3 + test_random_below(&random, 6);
        tl_polygon_mesh mesh;
        tl_polygon_report report;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
        shape_check_mesh(&mesh, &set);
        TEST_CHECK(report.refused_contours == 0);
        bool simple = oracle_is_simple(points, n) && oracle_contour_area2(points, n) > 0;
        // A hole that touches the outline in a vertex is no fault either.
        TEST_CHECK(mesh.note_count == 0 || !simple);
        touched += mesh.note_count == 0 && !simple;
        plain += simple;
        repaired += report.repaired_contours;
        empty += report.empty_contours;
        tl_polygon_mesh_free(&mesh);
    }
    TEST_CHECK(plain > 300 && touched > 0 && repaired > 2000 && empty > 20);
}

static void hard_families_pass_the_validator(void **state)
{
    (void)state;
    static const uint32_t caps[4] = { 0, 3, 6, 64 };
    for (uint32_t i = 0; i < 4; i++) {
        for (uint32_t kind = 0; kind < 4; kind++) {
            uint32_t n = 2000;
            if (kind == 0) {
                shape_star(points, n, 1e8, 3e7);
            } else if (kind == 1) {
                shape_comb(points, n, 1000);
            } else if (kind == 2) {
                shape_spiral(points, n);
            } else {
                n = shape_holes(points, 25, 25);
            }
            tl_contour contour;
            tl_contour_set set = shape_as_set(points, n, vertices, &contour);
            tl_polygon_def def = tl_default_polygon_def();
            def.max_verts_per_poly = caps[i];
            tl_polygon_mesh mesh;
            tl_polygon_report report;
            TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
            TEST_CHECK(mesh.note_count == 0 && report.triangle_count == n - 2);
            shape_check_mesh(&mesh, &set);
            tl_polygon_mesh_free(&mesh);
        }
    }
}

static void floors_upon_each_other_are_counted(void **state)
{
    (void)state;
    const tl_contour_vertex corners[4] = { { 0, 0, 0, 0 }, { 0, 0, 4, 0 }, { 4, 0, 4, 0 }, { 4, 0, 0, 0 } };
    const tl_contour contours[2] = { { 0, 4, 1, 63 }, { 0, 4, 2, 63 } };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 4;
    set.contours = contours;
    set.contour_count = 2;
    set.cell_size = set.cell_height = 1.0f;
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    TEST_CHECK(mesh.polygon_count == 2 && report.link_count == 0 && report.non_manifold_edges > 0);
    shape_check_mesh(&mesh, &set);
    tl_polygon_mesh_free(&mesh);
}

static void bad_arguments_are_named(void **state)
{
    (void)state;
    const oracle_point square[4] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    tl_contour contour;
    tl_contour_set set = shape_as_set(square, 4, vertices, &contour);
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = 2;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_ERR_ARGUMENT);
    def.max_verts_per_poly = 65;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.base.field, "max_verts_per_poly") == 0 && report.base.advice != NULL);
    def = tl_default_polygon_def();
    contour.vertex_count = 5;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_ERR_INDEX);
    contour.vertex_count = 4;
    contour.first_vertex = UINT32_MAX;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_ERR_INDEX);
    contour.first_vertex = 0;
    vertices[2].y = TL_MAX_CONTOUR_COORDINATE + 1;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_ERR_RANGE);
    TEST_CHECK(strcmp(report.base.element, "contour") == 0 && report.base.element_index == 0);
    set.contour_count = 0;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    TEST_CHECK(mesh.polygon_count == 0 && mesh.first[0] == 0);
    shape_check_mesh(&mesh, &set);
    tl_polygon_mesh_free(&mesh);
    tl_polygon_mesh_free(&mesh);
}

static bool stop_at_once(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)done;
    (void)total;
    (void)user;
    return false;
}

static void a_build_can_be_cancelled(void **state)
{
    (void)state;
    const oracle_point square[4] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    tl_contour contour;
    tl_contour_set set = shape_as_set(square, 4, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    tl_progress progress = { stop_at_once, NULL };
    test_allocator allocator;
    test_allocator_init(&allocator, 0);
    def.host.progress = &progress;
    def.host.allocator = &allocator.allocator;
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_ERR_CANCELLED);
    TEST_CHECK(allocator.live_blocks == 0);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    // Bridges, a crossing and border vertices, large enough that each path allocates.
    uint32_t n = shape_holes(points, 20, 20);
    points[1].x += 5;
    points[1].z = points[2].z + 7;
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    vertices[20].flags = TL_CONTOUR_BORDER_VERTEX;
    TEST_CHECK(shape_check_failing_memory(&set, tl_default_polygon_def()) > 6);
}

// A stair that comes up beside its own landing: the outline runs from (0, 1) to (2, 1) on the lower floor and back on
// the upper one, 3 m higher. In the plane that is a bridge; it is a wall.
static void a_run_back_on_another_floor_is_a_wall(void **state)
{
    (void)state;
    const tl_contour_vertex stair[] = {
        { 0, 21, 0, 0x8001 },   { 0, 21, 1, 0x20000 }, { 2, 21, 1, 0x20000 },  { 11, 21, 1, 0x20000 },
        { 12, 23, 5, 0x20000 }, { 2, 35, 6, 0x20000 }, { 1, 37, 2, 0x20000 },  { 2, 37, 1, 5 },
        { 0, 37, 1, 0x18001 },  { 0, 37, 9, 0x20000 }, { 15, 21, 9, 0x20000 }, { 15, 21, 0, 0x8003 },
    };
    const tl_contour whole = { 0, 12, 1, 63 };
    tl_contour_set set = { stair, 12, &whole, 1, { { 0, 0, 0 }, { 64, 10, 64 } }, 0.3f, 0.2f, 64, 64, 5, 1.3f };
    for (int method = TL_PARTITION_CLASSIC; method <= TL_PARTITION_DELAUNAY; method++) {
        tl_polygon_def def = tl_default_polygon_def();
        def.method = (tl_partition_method)method;
        tl_polygon_mesh mesh;
        tl_polygon_check_report check;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
        TEST_RESULT(tl_polygon_mesh_check(&mesh, &set, NULL, &check), TL_OK);
        uint32_t walls = 0;
        for (uint32_t p = 0; p < mesh.polygon_count; p++) {
            for (uint32_t k = mesh.first[p]; k < mesh.first[p + 1]; k++) {
                const int32_t *a = mesh.vertices + 3 * mesh.indices[k];
                const int32_t *b = mesh.vertices + 3 * mesh.indices[k + 1 < mesh.first[p + 1] ? k + 1 : mesh.first[p]];
                if (a[2] == 1 && b[2] == 1 && a[0] + b[0] == 2) {
                    TEST_CHECK(a[1] == b[1] && mesh.neighbours[k] == TL_NO_POLYGON);
                    walls++;
                }
            }
        }
        assert_int_equal(walls, 2);
        tl_polygon_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_back_on_another_floor_is_a_wall),
        cmocka_unit_test(two_contours_meet_in_links),
        cmocka_unit_test(scribbles_give_good_meshes),
        cmocka_unit_test(hard_families_pass_the_validator),
        cmocka_unit_test(floors_upon_each_other_are_counted),
        cmocka_unit_test(bad_arguments_are_named),
        cmocka_unit_test(a_build_can_be_cancelled),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
