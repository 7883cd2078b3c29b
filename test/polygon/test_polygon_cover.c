// SPDX-License-Identifier: MIT
//
// The validator's second half on meshes that no build made: random convex polygons anywhere, against trying every pair.

#include "polygon/check/polygon_check.h"
#include "polygon_proof.h"
#include "polygon_shapes.h"

enum { MAX_POLYGONS = 24, MAX_CORNERS = 12 };

typedef struct fixture {
    tl_polygon_mesh mesh;
    int32_t vertices[3 * MAX_CORNERS * MAX_POLYGONS];
    uint32_t first[MAX_POLYGONS + 1], indices[MAX_CORNERS * MAX_POLYGONS], neighbours[MAX_CORNERS * MAX_POLYGONS];
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

// A polygon with vertices of its own.
static void add_polygon(fixture *f, const oracle_point *corners, uint32_t count, uint32_t contour)
{
    tl_polygon_mesh *m = &f->mesh;
    for (uint32_t k = 0; k < count; k++) {
        m->vertices[3 * m->vertex_count] = (int32_t)corners[k].x;
        m->vertices[3 * m->vertex_count + 2] = (int32_t)corners[k].z;
        m->indices[m->index_count++] = m->vertex_count++;
    }
    m->contours[m->polygon_count++] = contour;
    m->first[m->polygon_count] = m->index_count;
}

static void add_triangle(fixture *f, const oracle_point corners[3], uint32_t contour)
{
    add_polygon(f, corners, 3, contour);
}

// The strictly convex hull of random points, in the polygons' winding. Returns its corners, fewer than 3 on a line.
static uint32_t random_convex(test_random *random, uint32_t reach, oracle_point corners[MAX_CORNERS])
{
    oracle_point points[MAX_CORNERS];
    const uint32_t count = 3 + (test_random_below(random, 2) != 0 ? test_random_below(random, MAX_CORNERS - 2) : 0);
    shape_random_points(random, points, count, reach);
    uint32_t at = 0, made = 0;
    for (uint32_t i = 1; i < count; i++) {
        at = points[i].x < points[at].x || (points[i].x == points[at].x && points[i].z < points[at].z) ? i : at;
    }
    const uint32_t lowest = at;
    do { // wraps the points; of those in line the farthest counts
        corners[made++] = points[at];
        uint32_t next = at;
        for (uint32_t i = 0; i < count; i++) {
            const int64_t side = oracle_area2(points[at], points[next], points[i]);
            const bool is_farther = side == 0 && oracle_between(points[at], points[i], points[next]);
            if (oracle_same(points[next], points[at]) ||
                (!oracle_same(points[i], points[at]) && (side > 0 || is_farther))) {
                next = i;
            }
        }
        at = next;
    } while (!oracle_same(points[at], points[lowest]) && made < MAX_CORNERS);
    shape_make_outer(corners, made);
    return made;
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
        uint32_t contour_of[MAX_CORNERS * MAX_POLYGONS]; // each vertex
        uint32_t wanted = 2 + test_random_below(&random, MAX_POLYGONS - 2);
        uint32_t side = 6u << test_random_below(&random, 6), reach = 2 + test_random_below(&random, side);
        while (f.mesh.polygon_count < wanted) {
            oracle_point corners[MAX_CORNERS];
            const uint32_t count = random_convex(&random, reach, corners);
            if (count < 3) {
                continue;
            }
            int64_t x = test_random_below(&random, side), z = test_random_below(&random, side);
            for (uint32_t k = 0; k < count; k++) {
                corners[k].x += x - side / 2;
                corners[k].z += z - side / 2;
            }
            const uint32_t contour = test_random_below(&random, 3);
            for (uint32_t k = 0; k < count; k++) {
                contour_of[f.mesh.vertex_count + k] = contour;
            }
            add_polygon(&f, corners, count, contour);
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
                bool is_first = contour_of[v] == m->contours[p];
                for (uint32_t w = 0; w < v; w++) {
                    is_first = is_first && (contour_of[w] != m->contours[p] || !oracle_same(at, proof_corner(m, w)));
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
