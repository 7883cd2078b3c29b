// SPDX-License-Identifier: MIT

#include "polygon_shapes.h"

#include <talus/polygon.h>

// A tile's border runs along x == 0; regions 1 and 2 meet it in the border vertex (0, 4).
static void border_vertices_go_where_the_border_is_straight(void **state)
{
    (void)state;
    tl_contour_vertex corners[8] = {
        { 0, 0, 0, 0 },
        { 0, 0, 4, TL_CONTOUR_BORDER_VERTEX },
        { 6, 0, 4, 0 },
        { 6, 0, 0, 0 },
        { 0, 0, 4, TL_CONTOUR_BORDER_VERTEX },
        { 0, 0, 8, 0 },
        { 6, 0, 8, 0 },
        { 6, 0, 4, 0 },
    };
    tl_contour contours[2] = { { 0, 4, 1, 63 }, { 4, 4, 2, 63 } };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 8;
    set.contours = contours;
    set.contour_count = 2;
    set.cell_size = set.cell_height = 1.0f;
    set.width = 20;
    set.height = 8;
    set.border_size = 3;
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, &set);
    TEST_CHECK(report.removed_border_vertices == 1 && report.kept_border_vertices == 0 && mesh.vertex_count == 5);
    TEST_CHECK(report.portal_count == 3); // x == 0 is one edge now, z == 0 and z == 8
    uint32_t sides[4] = { 0, 0, 0, 0 };
    for (uint32_t k = 0; k < mesh.index_count; k++) {
        if (mesh.neighbours[k] != TL_NO_POLYGON && mesh.neighbours[k] >= TL_PORTAL) {
            sides[mesh.neighbours[k] & 3u]++;
        }
    }
    TEST_CHECK(sides[0] == 1 && sides[1] == 1 && sides[2] == 0 && sides[3] == 1);
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        TEST_CHECK(mesh.areas[p] == 63 && mesh.regions[p] == TL_SEVERAL_REGIONS &&
                   mesh.contours[p] == TL_SEVERAL_CONTOURS);
    }
    tl_polygon_mesh_free(&mesh);
    def.keep_border_vertices = true;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, &set);
    TEST_CHECK(mesh.vertex_count == 6 && mesh.polygon_count == 2 && report.kept_border_vertices == 0);
    tl_polygon_mesh_free(&mesh);
    def.keep_border_vertices = false;
    // A border that bends there keeps its vertex, and so do regions of different areas.
    contours[1].area = 1;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    TEST_CHECK(report.removed_border_vertices == 0 && report.kept_border_vertices == 1);
    tl_polygon_mesh_free(&mesh);
    contours[1].area = 63;
    corners[1].x = corners[4].x = 1;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    shape_check_mesh(&mesh, &set);
    TEST_CHECK(report.removed_border_vertices == 0 && report.kept_border_vertices == 1);
    tl_polygon_mesh_free(&mesh);
}

// Many border vertices in a row, around which polygons are replaced again and again.
static void border_vertices_go_one_after_another(void **state)
{
    (void)state;
    enum { STRIPS = 12 };
    tl_contour_vertex corners[4 * STRIPS];
    tl_contour contours[STRIPS];
    for (int32_t s = 0; s < STRIPS; s++) {
        tl_contour_vertex strip[4] = {
            { 0, 0, 4 * s, 0 }, { 0, 0, 4 * s + 4, 0 }, { 9, 0, 4 * s + 4, 0 }, { 9, 0, 4 * s, 0 }
        };
        strip[0].flags = s > 0 ? TL_CONTOUR_BORDER_VERTEX : 0;
        strip[1].flags = s + 1 < STRIPS ? TL_CONTOUR_BORDER_VERTEX : 0;
        memcpy(corners + 4 * s, strip, sizeof strip);
        tl_contour contour = { 4 * (uint32_t)s, 4, (uint32_t)s + 1, 63 };
        contours[s] = contour;
    }
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 4 * STRIPS;
    set.contours = contours;
    set.contour_count = STRIPS;
    set.cell_size = set.cell_height = 1.0f;
    set.width = 20;
    set.height = 4 * STRIPS;
    set.border_size = 3;
    for (uint32_t cap = 3; cap <= 8; cap++) {
        tl_polygon_def def = tl_default_polygon_def();
        def.max_verts_per_poly = cap;
        tl_polygon_mesh mesh;
        tl_polygon_report report;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
        shape_check_mesh(&mesh, &set);
        TEST_CHECK(report.removed_border_vertices == STRIPS - 1 && report.portal_count == 3);
        tl_polygon_mesh_free(&mesh);
    }
}

// Random tiles: a grid of cells cut into vertical strips, every grid vertex on the border flagged.
static void random_tiles_keep_their_floor(void **state)
{
    (void)state;
    enum { ROWS = 9 };
    test_random random = { 51 };
    uint32_t gone = 0, kept = 0, mixed = 0;
    for (uint32_t round = 0; round < 500; round++) {
        tl_contour_vertex corners[4 * 2 * ROWS];
        tl_contour contours[2 * ROWS];
        uint32_t count = 0;
        int32_t cuts[ROWS + 1];
        for (int32_t r = 0; r <= ROWS; r++) {
            cuts[r] = 5 * r + (int32_t)test_random_below(&random, 4);
        }
        int32_t middle = 5 + (int32_t)test_random_below(&random, 20);
        for (int32_t r = 0; r < ROWS; r++) {
            for (int32_t side = 0; side < 2; side++) {
                if (test_random_below(&random, 6) == 0) {
                    continue; // a hole in the floor
                }
                int32_t left = side == 0 ? 0 : middle, right = side == 0 ? middle : 30;
                uint32_t flag = TL_CONTOUR_BORDER_VERTEX;
                tl_contour_vertex cell[4] = { { left, 0, cuts[r], side == 0 && r > 0 ? flag : 0 },
                                              { left, 0, cuts[r + 1], side == 0 && r + 1 < ROWS ? flag : 0 },
                                              { right, 0, cuts[r + 1], side == 1 && r + 1 < ROWS ? flag : 0 },
                                              { right, 0, cuts[r], side == 1 && r > 0 ? flag : 0 } };
                memcpy(corners + 4 * count, cell, sizeof cell);
                tl_contour contour = { 4 * count, 4, count + 1, 60 + test_random_below(&random, 2) };
                contours[count++] = contour;
            }
        }
        tl_contour_set set;
        memset(&set, 0, sizeof set);
        set.vertices = corners;
        set.vertex_count = 4 * count;
        set.contours = contours;
        set.contour_count = count;
        set.cell_size = set.cell_height = 1.0f;
        set.width = 30;
        set.height = 60;
        set.border_size = 2;
        tl_polygon_def def = tl_default_polygon_def();
        def.max_verts_per_poly = 3 + test_random_below(&random, 5);
        tl_polygon_mesh mesh;
        tl_polygon_report report;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
        shape_check_mesh(&mesh, &set);
        gone += report.removed_border_vertices;
        kept += report.kept_border_vertices;
        for (uint32_t p = 0; p < mesh.polygon_count; p++) {
            mixed += mesh.regions[p] == TL_SEVERAL_REGIONS;
        }
        tl_polygon_mesh_free(&mesh);
    }
    TEST_CHECK(gone > 1000 && kept > 1000 && mixed > 1000);
}

static void bake_and_check(tl_contour_vertex *vertices, tl_contour *contours, uint32_t count, uint32_t merge_height,
                           tl_polygon_report *report)
{
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.vertex_count = contours[count - 1].first_vertex + contours[count - 1].vertex_count;
    set.contours = contours;
    set.contour_count = count;
    set.cell_size = set.cell_height = 1.0f;
    set.width = set.height = 256;
    tl_polygon_def def = tl_default_polygon_def();
    def.merge_height = merge_height;
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, report), TL_OK);
    tl_polygon_check_report check;
    const tl_result result = tl_polygon_mesh_check(&mesh, &set, NULL, &check);
    // Contours that lie upon each other may claim an edge more than twice; one of the claims stays without a link.
    const bool is_claimed_twice = report->non_manifold_edges > 0;
    for (uint32_t fault = 0; fault < TL_POLYGON_FAULT_COUNT && result != TL_OK; fault++) {
        TEST_CHECK(check.counts[fault] == 0 || (fault == TL_POLYGON_FAULT_LINK && is_claimed_twice));
    }
    tl_polygon_mesh_free(&mesh);
}

#define BORDER TL_CONTOUR_BORDER_VERTEX

// One contour passes (221, 221) on two floors. The border vertex of the upper floor stands in a straight run, but
// without it an edge would have the lower floor's vertex inside it.
static void a_border_vertex_stays_at_a_place_of_two_floors(void **state)
{
    (void)state;
    tl_contour_vertex vertices[] = {
        { 252, 4, 252, BORDER }, { 252, 0, 6, 0 },      { 47, 0, 2, 0 },        { 0, 4, 0, BORDER },
        { 221, 5, 221, BORDER }, { 221, 0, 160, 0 },    { 0, 5, 0, BORDER },    { 221, 0, 221, 0 },
        { 0, 0, 0, 0 },          { 0, 4, 215, BORDER }, { 66, 5, 221, BORDER }, { 221, 5, 221, BORDER },
    };
    tl_contour contour = { 0, sizeof vertices / sizeof vertices[0], 1, 63 };
    tl_polygon_report report;
    bake_and_check(vertices, &contour, 1, 4, &report);
    TEST_CHECK(report.kept_border_vertices > 0);
}

// The border vertex at the end of the run there and back is at the place of a vertex that the floor keeps.
static void a_bridge_may_end_in_a_border_vertex(void **state)
{
    (void)state;
    tl_contour_vertex vertices[] = {
        { 255, 7, 255, BORDER }, { 255, 0, 0, 0 },   { 0, 0, 16, 0 },
        { 16, 0, 16, 0 },        { 255, 0, 255, 0 }, { 0, 0, 16, 0 },
    };
    tl_contour contour = { 0, 6, 1, 63 };
    tl_polygon_report report;
    bake_and_check(vertices, &contour, 1, 0, &report);
}

// Contours of a few vertices on a small lattice: most touch or cross themselves and others, on any floor.
static void border_flags_anywhere_leave_a_whole_mesh(void **state)
{
    (void)state;
    enum { CONTOURS = 3, VERTICES = 9 };
    test_random random = { 52 };
    uint32_t gone = 0, kept = 0;
    for (uint32_t round = 0; round < 40000; round++) {
        tl_contour_vertex vertices[CONTOURS * VERTICES];
        tl_contour contours[CONTOURS];
        const uint32_t contour_count = 1 + test_random_below(&random, CONTOURS);
        const uint32_t side = 2 + test_random_below(&random, 6);
        uint32_t count = 0;
        for (uint32_t c = 0; c < contour_count; c++) {
            contours[c].first_vertex = count;
            contours[c].vertex_count = 3 + test_random_below(&random, VERTICES - 2);
            contours[c].region = c + 1;
            contours[c].area = 63;
            for (uint32_t k = 0; k < contours[c].vertex_count; k++, count++) {
                vertices[count].x = (int32_t)test_random_below(&random, side);
                vertices[count].y = (int32_t)test_random_below(&random, 8);
                vertices[count].z = (int32_t)test_random_below(&random, side);
                vertices[count].flags = test_random_below(&random, 2) == 0 ? BORDER : 0;
            }
        }
        tl_polygon_report report;
        bake_and_check(vertices, contours, contour_count, test_random_below(&random, 8), &report);
        gone += report.removed_border_vertices;
        kept += report.kept_border_vertices;
    }
    TEST_CHECK(gone > 1000 && kept > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(border_vertices_go_where_the_border_is_straight),
        cmocka_unit_test(border_vertices_go_one_after_another),
        cmocka_unit_test(random_tiles_keep_their_floor),
        cmocka_unit_test(a_border_vertex_stays_at_a_place_of_two_floors),
        cmocka_unit_test(a_bridge_may_end_in_a_border_vertex),
        cmocka_unit_test(border_flags_anywhere_leave_a_whole_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
