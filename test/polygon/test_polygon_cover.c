// SPDX-License-Identifier: MIT
//
// The validator's second half on meshes that no build made: random triangles anywhere, against trying every pair.

#include "polygon/check/polygon_check.h"
#include "polygon_proof.h"
#include "polygon_shapes.h"

enum { MAX_POLYGONS = 24 };

typedef struct fixture {
    tl_polygon_mesh mesh;
    int32_t vertices[3 * 3 * MAX_POLYGONS];
    uint32_t first[MAX_POLYGONS + 1], indices[3 * MAX_POLYGONS], neighbours[3 * MAX_POLYGONS];
    uint32_t regions[MAX_POLYGONS], areas[MAX_POLYGONS], contours[MAX_POLYGONS];
} fixture;

static void begin(fixture *f)
{
    memset(f, 0, sizeof *f);
    memset(f->neighbours, 0xff, sizeof f->neighbours);
    f->mesh.vertices = f->vertices;
    f->mesh.first = f->first;
    f->mesh.indices = f->indices;
    f->mesh.neighbours = f->neighbours;
    f->mesh.regions = f->regions;
    f->mesh.areas = f->areas;
    f->mesh.contours = f->contours;
}

// A triangle with vertices of its own.
static void add_triangle(fixture *f, const oracle_point corners[3], uint32_t contour)
{
    tl_polygon_mesh *m = &f->mesh;
    for (uint32_t k = 0; k < 3; k++) {
        m->vertices[3 * m->vertex_count] = (int32_t)corners[k].x;
        m->vertices[3 * m->vertex_count + 2] = (int32_t)corners[k].z;
        m->indices[m->index_count++] = m->vertex_count++;
    }
    m->contours[m->polygon_count++] = contour;
    m->first[m->polygon_count] = m->index_count;
}

static tl_polygon_check_report check(const fixture *f, const tl_contour_set *set)
{
    tl_polygon_checker checker;
    memset(&checker, 0, sizeof checker);
    checker.mesh = &f->mesh;
    checker.contours = set;
    tl_arena_init(&checker.arena, NULL);
    TEST_RESULT(tl_polygon_check_cover(&checker), TL_OK);
    tl_arena_free(&checker.arena);
    return checker.report;
}

// Counts of pairs that overlap and of vertices inside edges, one for each polygon and place.
static void overlaps_and_t_junctions_as_all_pairs_say(void **state)
{
    (void)state;
    test_random random = { 91 };
    uint64_t overlaps = 0, junctions = 0, clean = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        fixture f;
        begin(&f);
        uint32_t wanted = 2 + test_random_below(&random, MAX_POLYGONS - 2);
        uint32_t side = 6u << test_random_below(&random, 6), reach = 2 + test_random_below(&random, side);
        while (f.mesh.polygon_count < wanted) {
            oracle_point corners[3];
            shape_random_points(&random, corners, 3, reach);
            shape_make_outer(corners, 3);
            if (oracle_contour_area2(corners, 3) <= 0) {
                continue;
            }
            int64_t x = test_random_below(&random, side), z = test_random_below(&random, side);
            for (uint32_t k = 0; k < 3; k++) {
                corners[k].x += x - side / 2;
                corners[k].z += z - side / 2;
            }
            add_triangle(&f, corners, test_random_below(&random, 3));
        }
        uint64_t expected_overlaps = 0, expected_junctions = 0;
        const tl_polygon_mesh *m = &f.mesh;
        for (uint32_t p = 0; p < m->polygon_count; p++) {
            for (uint32_t q = 0; q < p; q++) {
                expected_overlaps +=
                    m->contours[p] == m->contours[q] && !proof_is_parted(m, p, q) && !proof_is_parted(m, q, p);
            }
            // A place counts once for a polygon, however many vertices are there.
            for (uint32_t v = 0; v < m->vertex_count; v++) {
                oracle_point at = proof_corner(m, v);
                bool is_first = m->contours[v / 3] == m->contours[p];
                for (uint32_t w = 0; w < v; w++) {
                    is_first =
                        is_first && (m->contours[w / 3] != m->contours[p] || !oracle_same(at, proof_corner(m, w)));
                }
                for (uint32_t k = m->first[p]; k < m->first[p + 1] && is_first; k++) {
                    oracle_point a = proof_corner(m, k), b = proof_corner(m, proof_next(m, p, k));
                    expected_junctions += !oracle_same(a, at) && !oracle_same(b, at) && oracle_between(a, b, at);
                }
            }
        }
        tl_polygon_check_report report = check(&f, NULL);
        TEST_CHECK(report.counts[TL_POLYGON_FAULT_OVERLAP] == expected_overlaps);
        TEST_CHECK(report.counts[TL_POLYGON_FAULT_T_JUNCTION] == expected_junctions);
        overlaps += expected_overlaps;
        junctions += expected_junctions;
        clean += expected_overlaps == 0 && expected_junctions == 0;
    }
    TEST_CHECK(overlaps > 5000 && junctions > 1000 && clean > 100);
}

static const oracle_point lower[3] = { { 0, 0 }, { 0, 4 }, { 4, 0 } }, upper[3] = { { 0, 4 }, { 4, 4 }, { 4, 0 } };

static void covering_is_the_contour_no_more_and_no_less(void **state)
{
    (void)state;
    const oracle_point square[4] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    const oracle_point beside[3] = { { 4, 4 }, { 8, 4 }, { 4, 0 } };
    tl_contour_vertex vertices[4];
    tl_contour contour;
    tl_contour_set set = shape_as_set(square, 4, vertices, &contour);
    fixture f;
    begin(&f);
    add_triangle(&f, lower, 0);
    add_triangle(&f, upper, 0);
    tl_polygon_check_report report = check(&f, &set);
    for (uint32_t fault = 0; fault < TL_POLYGON_FAULT_COUNT; fault++) {
        TEST_CHECK(report.counts[fault] == 0);
    }
    // One half is missing.
    begin(&f);
    add_triangle(&f, lower, 0);
    report = check(&f, &set);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_AREA] == 1 && report.counts[TL_POLYGON_FAULT_OUTLINE] <= 1);
    // The right area in the wrong place.
    begin(&f);
    add_triangle(&f, lower, 0);
    add_triangle(&f, beside, 0);
    report = check(&f, &set);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_AREA] == 0 && report.counts[TL_POLYGON_FAULT_OUTLINE] == 1);
    // A note says that only half could be covered; then that is right, and the whole is not.
    tl_contour_note note;
    memset(&note, 0, sizeof note);
    note.covered_area2 = 16;
    begin(&f);
    f.mesh.notes = &note;
    f.mesh.note_count = 1;
    add_triangle(&f, lower, 0);
    report = check(&f, &set);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_AREA] == 0);
    add_triangle(&f, upper, 0);
    report = check(&f, &set);
    TEST_CHECK(report.counts[TL_POLYGON_FAULT_AREA] == 1);
}

// Polygons of several contours share floor only within a piece that hangs together.
static void floors_of_several_contours_may_lie_over_each_other(void **state)
{
    (void)state;
    fixture f;
    begin(&f);
    add_triangle(&f, lower, TL_SEVERAL_CONTOURS);
    add_triangle(&f, lower, TL_SEVERAL_CONTOURS);
    TEST_CHECK(check(&f, NULL).counts[TL_POLYGON_FAULT_OVERLAP] == 0);
    f.neighbours[0] = 1;
    f.neighbours[3] = 0;
    TEST_CHECK(check(&f, NULL).counts[TL_POLYGON_FAULT_OVERLAP] == 1);
}

static void memory_may_run_out(void **state)
{
    (void)state;
    const oracle_point square[4] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    tl_contour_vertex vertices[4];
    tl_contour contour;
    tl_contour_set set = shape_as_set(square, 4, vertices, &contour);
    fixture f;
    begin(&f);
    add_triangle(&f, lower, 0);
    add_triangle(&f, upper, 0);
    uint64_t fail_at = 1;
    for (tl_result result = TL_ERR_MEMORY; result == TL_ERR_MEMORY; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_polygon_checker checker;
        memset(&checker, 0, sizeof checker);
        checker.mesh = &f.mesh;
        checker.contours = &set;
        tl_arena_init(&checker.arena, &allocator.allocator);
        result = tl_polygon_check_cover(&checker);
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        tl_arena_free(&checker.arena);
        TEST_CHECK(allocator.live_blocks == 0);
    }
    TEST_CHECK(fail_at > 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overlaps_and_t_junctions_as_all_pairs_say),
        cmocka_unit_test(covering_is_the_contour_no_more_and_no_less),
        cmocka_unit_test(floors_of_several_contours_may_lie_over_each_other),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
