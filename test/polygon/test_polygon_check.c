// SPDX-License-Identifier: MIT
//
// The validator must name each kind of broken mesh. A good mesh is spoilt in one way at a time.

#include "polygon_shapes.h"

#include <talus/polygon.h>

enum { MAX_VERTICES = 64 };

typedef struct fixture {
    oracle_point points[MAX_VERTICES];
    tl_contour_vertex vertices[MAX_VERTICES];
    tl_contour contour;
    tl_contour_set set;
    tl_polygon_mesh mesh;
} fixture;

static void build(fixture *f, const oracle_point *points, uint32_t n, uint32_t max_verts)
{
    memcpy(f->points, points, n * sizeof *points);
    f->set = shape_as_set(f->points, n, f->vertices, &f->contour);
    f->set.width = 8;
    f->set.height = 4;
    f->set.border_size = 1;
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = max_verts;
    TEST_RESULT(tl_polygon_mesh_bake(&f->set, &def, &f->mesh, NULL), TL_OK);
    TEST_RESULT(tl_polygon_mesh_check(&f->mesh, &f->set, NULL, NULL), TL_OK);
}

// Two squares side by side, with a straight corner where they meet, in triangles.
static void build_bar(fixture *f)
{
    const oracle_point bar[6] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 8, 4 }, { 8, 0 }, { 4, 0 } };
    build(f, bar, 6, 3);
    TEST_CHECK(f->mesh.polygon_count == 4);
}

static tl_polygon_check_report expect(fixture *f, tl_polygon_fault fault, bool with_contours)
{
    tl_polygon_check_report report;
    TEST_RESULT(tl_polygon_mesh_check(&f->mesh, with_contours ? &f->set : NULL, NULL, &report), TL_ERR_CORRUPT);
    if (report.counts[fault] == 0) {
        fail_msg("expected '%s', got '%s'", tl_polygon_fault_text(fault), tl_polygon_fault_text(report.first_fault));
    }
    TEST_CHECK(report.base.element != NULL && report.base.advice != NULL);
    tl_polygon_mesh_free(&f->mesh);
    return report;
}

static uint32_t linked_edge(const tl_polygon_mesh *mesh)
{
    uint32_t k = 0;
    while (mesh->neighbours[k] >= mesh->polygon_count) {
        k++;
    }
    return k;
}

static uint32_t portal_edge(const tl_polygon_mesh *mesh)
{
    uint32_t k = 0;
    while (mesh->neighbours[k] < TL_PORTAL || mesh->neighbours[k] == TL_NO_POLYGON) {
        k++;
    }
    return k;
}

static void names_indices_out_of_range(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    f.mesh.indices[4] = f.mesh.vertex_count;
    expect(&f, TL_POLYGON_FAULT_RANGE, true);
    build_bar(&f);
    f.mesh.neighbours[4] = f.mesh.polygon_count;
    expect(&f, TL_POLYGON_FAULT_RANGE, false);
    build_bar(&f);
    f.mesh.neighbours[4] = TL_PORTAL | 4u;
    expect(&f, TL_POLYGON_FAULT_RANGE, false);
    build_bar(&f);
    f.mesh.first[1] = UINT32_MAX;
    expect(&f, TL_POLYGON_FAULT_RANGE, false);
    build_bar(&f);
    f.mesh.first[f.mesh.polygon_count]--;
    expect(&f, TL_POLYGON_FAULT_RANGE, false);
    build_bar(&f);
    f.mesh.contours[0] = 1;
    expect(&f, TL_POLYGON_FAULT_RANGE, true);
    build_bar(&f);
    f.mesh.vertices[0] = INT32_MIN;
    expect(&f, TL_POLYGON_FAULT_RANGE, false);
    build_bar(&f);
    f.contour.vertex_count = 7;
    expect(&f, TL_POLYGON_FAULT_RANGE, true);
    build_bar(&f);
    f.vertices[0].x = INT32_MAX;
    expect(&f, TL_POLYGON_FAULT_RANGE, true);
}

static void names_wrong_corner_counts(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    f.mesh.first[1]--;
    expect(&f, TL_POLYGON_FAULT_CORNERS, false);
    const oracle_point square[4] = { { 0, 0 }, { 0, 4 }, { 8, 4 }, { 8, 0 } };
    build(&f, square, 4, 4);
    f.mesh.max_verts_per_poly = 3;
    expect(&f, TL_POLYGON_FAULT_CORNERS, false);
}

static void names_bad_shapes(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    f.mesh.indices[1] = f.mesh.indices[0];
    expect(&f, TL_POLYGON_FAULT_REPEATED, false);
    build_bar(&f);
    uint32_t t = f.mesh.indices[1];
    f.mesh.indices[1] = f.mesh.indices[2];
    f.mesh.indices[2] = t;
    expect(&f, TL_POLYGON_FAULT_INVERTED, false);
    // A dent, a straight corner, and a star that turns left everywhere but goes around twice.
    const oracle_point pentagon[5] = { { 0, 2 }, { 4, 8 }, { 8, 2 }, { 6, -4 }, { 2, -4 } };
    build(&f, pentagon, 5, 6);
    TEST_CHECK(f.mesh.polygon_count == 1);
    for (uint32_t v = 0; v < 5; v++) {
        if (f.mesh.vertices[3 * v + 2] == 8) {
            f.mesh.vertices[3 * v + 2] = 1;
        }
    }
    expect(&f, TL_POLYGON_FAULT_NOT_CONVEX, false);
    build(&f, pentagon, 5, 6);
    for (uint32_t v = 0; v < 5; v++) {
        if (f.mesh.vertices[3 * v + 2] == 8) {
            f.mesh.vertices[3 * v + 2] = 2;
        }
    }
    expect(&f, TL_POLYGON_FAULT_NOT_CONVEX, false);
    build(&f, pentagon, 5, 6);
    uint32_t star[5];
    for (uint32_t k = 0; k < 5; k++) {
        star[k] = f.mesh.indices[2 * k % 5];
    }
    memcpy(f.mesh.indices, star, sizeof star);
    expect(&f, TL_POLYGON_FAULT_NOT_CONVEX, false);
}

static void names_overlaps_and_t_junctions(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    // One triangle on top of another.
    memcpy(f.mesh.indices, f.mesh.indices + 3, 3 * sizeof *f.mesh.indices);
    tl_polygon_check_report report = expect(&f, TL_POLYGON_FAULT_OVERLAP, true);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_OUTLINE] == 1);
    // Another contour's floor may lie over this one's.
    build_bar(&f);
    memcpy(f.mesh.indices, f.mesh.indices + 3, 3 * sizeof *f.mesh.indices);
    f.mesh.contours[0] = 5;
    tl_polygon_mesh_check(&f.mesh, NULL, NULL, &report);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_OVERLAP] == 0);
    tl_polygon_mesh_free(&f.mesh);
    // In a kite the upper triangle is put over the lower one, whose own corner then lies inside the upper one's edge.
    const oracle_point kite[4] = { { 0, 0 }, { 4, 4 }, { 8, 0 }, { 4, -4 } };
    build(&f, kite, 4, 3);
    TEST_CHECK(f.mesh.polygon_count == 2);
    int32_t *vertices = f.mesh.vertices;
    uint32_t corner[4] = { 0, 0, 0, 0 };
    for (uint32_t v = 0; v < 4; v++) {
        for (uint32_t k = 0; k < 4; k++) {
            corner[k] = vertices[3 * v] == kite[k].x && vertices[3 * v + 2] == kite[k].z ? v : corner[k];
        }
    }
    vertices[3 * corner[1] + 2] = 0;
    const uint32_t big[3] = { corner[0], corner[2], corner[3] }, small[3] = { corner[0], corner[1], corner[3] };
    memcpy(f.mesh.indices, big, sizeof big);
    memcpy(f.mesh.indices + 3, small, sizeof small);
    report = expect(&f, TL_POLYGON_FAULT_T_JUNCTION, false);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_OVERLAP] == 1);
}

static void names_broken_links(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    f.mesh.neighbours[linked_edge(&f.mesh)] = TL_NO_POLYGON;
    expect(&f, TL_POLYGON_FAULT_LINK, false);
    build_bar(&f);
    uint32_t k = linked_edge(&f.mesh);
    f.mesh.neighbours[k] = (f.mesh.neighbours[k] + 1) % f.mesh.polygon_count;
    expect(&f, TL_POLYGON_FAULT_LINK, false);
    // Both sides left out.
    build_bar(&f);
    k = linked_edge(&f.mesh);
    for (uint32_t other = 0; other < f.mesh.index_count; other++) {
        if (other / 3 == f.mesh.neighbours[k] && f.mesh.neighbours[other] == k / 3) {
            f.mesh.neighbours[other] = TL_NO_POLYGON;
        }
    }
    f.mesh.neighbours[k] = TL_NO_POLYGON;
    expect(&f, TL_POLYGON_FAULT_LINK, false);
    build_bar(&f);
    k = portal_edge(&f.mesh);
    f.mesh.neighbours[k] = TL_PORTAL | ((f.mesh.neighbours[k] + 1) & 3u);
    expect(&f, TL_POLYGON_FAULT_PORTAL, true);
    build_bar(&f);
    f.set.border_size = 0;
    expect(&f, TL_POLYGON_FAULT_PORTAL, true);
}

// Triangles of the same few vertices, linked at random: counts as all edges looked through say.
static void counts_broken_links_as_all_edges_say(void **state)
{
    (void)state;
    enum { TRIANGLES = 12, VERTICES = 5, CORNERS = 3 * TRIANGLES };
    test_random random = { 17 };
    uint64_t broken = 0, whole = 0;
    for (uint32_t round = 0; round < 3000; round++) {
        int32_t vertices[3 * VERTICES] = { 0, 0, 0, 4, 0, 0, 8, 0, 2, 2, 0, 7, 5, 0, 9 };
        uint32_t first[TRIANGLES + 1], indices[CORNERS], neighbours[CORNERS], contours[TRIANGLES] = { 0 };
        tl_polygon_mesh mesh;
        memset(&mesh, 0, sizeof mesh);
        mesh.vertices = vertices;
        mesh.vertex_count = VERTICES;
        mesh.polygon_count = 2 + test_random_below(&random, TRIANGLES - 1);
        mesh.index_count = 3 * mesh.polygon_count;
        mesh.first = first;
        mesh.indices = indices;
        mesh.neighbours = neighbours;
        mesh.contours = contours;
        for (uint32_t p = 0; p <= mesh.polygon_count; p++) {
            first[p] = 3 * p;
        }
        const uint32_t few = 2 + test_random_below(&random, VERTICES - 1), near = 1 + test_random_below(&random, 4);
        for (uint32_t k = 0; k < mesh.index_count; k++) {
            const uint32_t across = test_random_below(&random, near);
            indices[k] = test_random_below(&random, few);
            neighbours[k] = test_random_below(&random, 4) == 0 ? TL_NO_POLYGON : across % mesh.polygon_count;
        }
        uint64_t expected = 0;
        bool is_open[VERTICES][VERTICES] = { { false } };
        for (uint32_t k = 0; k < mesh.index_count; k++) {
            const uint32_t from = indices[k], to = indices[k % 3 < 2 ? k + 1 : k - 2], across = neighbours[k];
            bool is_returned = false;
            for (uint32_t j = 0; j < mesh.index_count && across != k / 3; j++) {
                is_returned = is_returned || (j / 3 == across && neighbours[j] == k / 3 && indices[j] == to &&
                                              indices[j % 3 < 2 ? j + 1 : j - 2] == from);
            }
            expected += across != TL_NO_POLYGON && !is_returned;
            whole += is_returned;
            is_open[from][to] = is_open[from][to] || across == TL_NO_POLYGON;
        }
        for (uint32_t from = 0; from < VERTICES; from++) {
            for (uint32_t to = from + 1; to < VERTICES; to++) {
                expected += is_open[from][to] && is_open[to][from];
            }
        }
        tl_polygon_check_report report;
        (void)tl_polygon_mesh_check(&mesh, NULL, NULL, &report);
        TEST_CHECK(report.counts[TL_POLYGON_FAULT_LINK] == expected);
        broken += expected;
    }
    print_message("%u links broken, %u returned\n", (unsigned)broken, (unsigned)whole);
    TEST_CHECK(broken > 10000 && whole > 500);
}

static void names_uncovered_floor(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    // The last polygon is left out, and who linked to it does so no more.
    uint32_t last = --f.mesh.polygon_count;
    f.mesh.index_count = f.mesh.first[last];
    for (uint32_t k = 0; k < f.mesh.index_count; k++) {
        f.mesh.neighbours[k] = f.mesh.neighbours[k] == last ? TL_NO_POLYGON : f.mesh.neighbours[k];
    }
    TEST_RESULT(tl_polygon_mesh_check(&f.mesh, NULL, NULL, NULL), TL_OK);
    expect(&f, TL_POLYGON_FAULT_AREA, true);
    // Same area, another place.
    build_bar(&f);
    for (uint32_t v = 0; v < f.mesh.vertex_count; v++) {
        f.mesh.vertices[3 * v] += 1;
    }
    f.set.border_size = 1;
    for (uint32_t k = 0; k < f.mesh.index_count; k++) {
        f.mesh.neighbours[k] = f.mesh.neighbours[k] >= TL_PORTAL ? TL_NO_POLYGON : f.mesh.neighbours[k];
    }
    expect(&f, TL_POLYGON_FAULT_OUTLINE, true);
}

// Border vertices that are gone or stay, wherever the contour begins: none of it is a fault of the outline.
static void passes_over_border_vertices(void **state)
{
    (void)state;
    enum { N = 5 };
    // The third and the fourth vertex lie on the straight run from the second to the first.
    static const int32_t corners[N][2] = { { 255, 255 }, { 16, 0 }, { 0, 0 }, { 32, 32 }, { 64, 64 } };
    uint32_t gone = 0, kept = 0;
    for (uint32_t flags = 0; flags < 1u << N; flags++) {
        for (uint32_t start = 0; start < N; start++) {
            tl_contour_vertex vertices[N];
            for (uint32_t k = 0; k < N; k++) {
                uint32_t from = (start + k) % N;
                tl_contour_vertex v = { corners[from][0], 0, corners[from][1],
                                        (flags >> from & 1u) != 0 ? TL_CONTOUR_BORDER_VERTEX : 0 };
                vertices[k] = v;
            }
            tl_contour contour = { 0, N, 1, 1 };
            tl_contour_set set;
            memset(&set, 0, sizeof set);
            set.vertices = vertices;
            set.vertex_count = N;
            set.contours = &contour;
            set.contour_count = 1;
            set.cell_size = set.cell_height = 1.0f;
            tl_polygon_mesh mesh;
            tl_polygon_report report;
            TEST_RESULT(tl_polygon_mesh_bake(&set, NULL, &mesh, &report), TL_OK);
            TEST_RESULT(tl_polygon_mesh_check(&mesh, &set, NULL, NULL), TL_OK);
            gone += report.removed_border_vertices;
            kept += report.kept_border_vertices;
            tl_polygon_mesh_free(&mesh);
        }
    }
    TEST_CHECK(gone > 50 && kept > 50);
}

// A slope that winds up over itself: a border vertex goes, polygons of four contours hang together, and some lie over
// others. Floors whose heights do not meet are no overlap.
static void floors_that_hang_together_may_lie_over_each_other(void **state)
{
    (void)state;
    enum { B = TL_CONTOUR_BORDER_VERTEX, A = TL_CONTOUR_AREA_BORDER };
    static const tl_contour_vertex vertices[] = {
        { 0, 91, 0, 0 },    { 0, 61, 35, B },   { 60, 109, 35, A }, { 65, 119, 32, A }, { 81, 142, 33, 0 },
        { 81, 99, 0, 0 },   { 0, 61, 35, B },   { 0, 60, 81, 0 },   { 62, 158, 81, B }, { 62, 126, 64, A },
        { 60, 113, 62, A }, { 63, 110, 59, A }, { 81, 101, 57, 0 }, { 81, 113, 44, A }, { 65, 108, 43, A },
        { 60, 109, 35, 0 }, { 64, 116, 36, A }, { 65, 120, 42, A }, { 81, 122, 43, 0 }, { 81, 142, 36, A },
        { 64, 129, 36, A }, { 64, 136, 51, A }, { 62, 126, 64, 0 }, { 62, 158, 81, B }, { 81, 189, 81, 0 },
        { 81, 165, 36, A },
    };
    static const tl_contour contours[] = { { 0, 6, 2, 63 }, { 6, 10, 1, 63 }, { 16, 4, 4, 63 }, { 20, 6, 3, 63 } };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.vertex_count = sizeof vertices / sizeof vertices[0];
    set.contours = contours;
    set.contour_count = 4;
    set.cell_size = set.cell_height = 1.0f;
    set.width = set.height = 81;
    set.border_size = 4;
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, NULL, &mesh, NULL), TL_OK);
    TEST_RESULT(tl_polygon_mesh_check(&mesh, &set, NULL, NULL), TL_OK);
    uint32_t several = 0;
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        several += mesh.contours[p] == TL_SEVERAL_CONTOURS;
    }
    TEST_CHECK(several > 1);
    // On one height they do overlap.
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        mesh.vertices[3 * i + 1] = 0;
    }
    tl_polygon_check_report report;
    TEST_RESULT(tl_polygon_mesh_check(&mesh, NULL, NULL, &report), TL_ERR_CORRUPT);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_OVERLAP] > 0);
    tl_polygon_mesh_free(&mesh);
}

static void runs_out_of_memory_cleanly(void **state)
{
    (void)state;
    fixture f;
    build_bar(&f);
    tl_result result = TL_ERR_MEMORY;
    uint64_t fail_at = 1;
    for (; result == TL_ERR_MEMORY; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        result = tl_polygon_mesh_check(&f.mesh, &f.set, &allocator.allocator, NULL);
        TEST_CHECK(allocator.live_blocks == 0);
    }
    TEST_RESULT(result, TL_OK);
    TEST_CHECK(fail_at > 2);
    tl_polygon_mesh_free(&f.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_indices_out_of_range),
        cmocka_unit_test(names_wrong_corner_counts),
        cmocka_unit_test(names_bad_shapes),
        cmocka_unit_test(names_overlaps_and_t_junctions),
        cmocka_unit_test(names_broken_links),
        cmocka_unit_test(counts_broken_links_as_all_edges_say),
        cmocka_unit_test(names_uncovered_floor),
        cmocka_unit_test(passes_over_border_vertices),
        cmocka_unit_test(floors_that_hang_together_may_lie_over_each_other),
        cmocka_unit_test(runs_out_of_memory_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
