// SPDX-License-Identifier: MIT

#include "polygon/triangulate/triangulate.h"

#include "polygon_random_shapes.h"

enum { MAX_POINTS = 512 };

typedef struct fixture {
    oracle_point points[MAX_POINTS];
    tl_lattice_point lattice[MAX_POINTS];
    uint32_t triangles[3 * MAX_POINTS], twins[3 * MAX_POINTS], expected[3 * MAX_POINTS];
} fixture;

static fixture f;

static tl_result run(uint32_t n, tl_ear_test ear_test)
{
    for (uint32_t i = 0; i < n; i++) {
        f.lattice[i].x = (int32_t)f.points[i].x;
        f.lattice[i].z = (int32_t)f.points[i].z;
    }
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    const tl_triangulate_input input = { f.lattice, n, NULL, NULL, ear_test, NULL };
    tl_result result = tl_triangulate(&arena, &input, f.triangles, f.twins);
    tl_arena_free(&arena);
    return result;
}

static void check_twins(uint32_t n)
{
    uint32_t open = 0;
    for (uint32_t e = 0; e < 3 * (n - 2); e++) {
        if (f.twins[e] == TL_NO_EDGE) {
            open++;
            continue;
        }
        uint32_t t = f.twins[e];
        TEST_CHECK(t < 3 * (n - 2) && f.twins[t] == e && t / 3 != e / 3);
        uint32_t next = e % 3 < 2 ? e + 1 : e - 2, twin_next = t % 3 < 2 ? t + 1 : t - 2;
        TEST_CHECK(f.triangles[e] == f.triangles[twin_next] && f.triangles[next] == f.triangles[t]);
    }
    TEST_CHECK(open == n);
}

// The fast forms against the plain one, triangle by triangle, in order.
static void compare(uint32_t n)
{
    TEST_CHECK(oracle_triangulate(f.points, n, f.expected));
    TEST_RESULT(run(n, TL_EARS_BY_MESH), TL_OK);
    TEST_CHECK(memcmp(f.triangles, f.expected, 3 * (n - 2) * sizeof(uint32_t)) == 0);
    TEST_RESULT(run(n, TL_EARS_BY_LIST), TL_OK);
    TEST_CHECK(memcmp(f.triangles, f.expected, 3 * (n - 2) * sizeof(uint32_t)) == 0);
    check_twins(n);
    int64_t area = 0;
    for (uint32_t t = 0; t < n - 2; t++) {
        const uint32_t *c = f.triangles + 3 * t;
        int64_t part = -oracle_area2(f.points[c[0]], f.points[c[1]], f.points[c[2]]);
        TEST_CHECK(part > 0);
        area += part;
    }
    TEST_CHECK(area == oracle_contour_area2(f.points, n));
}

static void cuts_the_shortest_partition_first(void **state)
{
    (void)state;
    // An L: the corner next to the notch has the shortest new edge.
    const oracle_point points[6] = { { 0, 0 }, { 0, 4 }, { 2, 4 }, { 2, 2 }, { 6, 2 }, { 6, 0 } };
    memcpy(f.points, points, sizeof points);
    TEST_CHECK(oracle_contour_area2(f.points, 6) > 0);
    compare(6);
    // From (0, 4) to (2, 2), cutting off (2, 4), has length 8; all others have 8 or more, and none at a lower vertex.
    TEST_CHECK(f.triangles[0] == 1 && f.triangles[1] == 2 && f.triangles[2] == 3);
}

static void one_triangle_stays_as_it_is(void **state)
{
    (void)state;
    const oracle_point points[3] = { { 0, 0 }, { 0, 5 }, { 5, 0 } };
    memcpy(f.points, points, sizeof points);
    compare(3);
    TEST_CHECK(f.triangles[0] == 0 && f.triangles[1] == 1 && f.triangles[2] == 2);
}

static void equals_the_plain_form_on_random_outlines(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t simple = 0, large = 0;
    for (uint32_t round = 0; round < 3000; round++) {
        uint32_t n = 3 + test_random_below(&random, round % 50 == 0 ? 70 : 20);
        // A small lattice makes ties, straight runs and near misses.
        uint32_t side = 4u << test_random_below(&random, 12);
        if (shape_untangled(&random, f.points, n, side)) {
            compare(n);
            simple++;
            large += n > 40;
        }
    }
    TEST_CHECK(simple > 1500 && large > 10);
}

static void equals_the_plain_form_on_straight_runs(void **state)
{
    (void)state;
    test_random random = { 2 };
    uint32_t compared = 0;
    for (uint32_t round = 0; round < 1500; round++) {
        uint32_t cells = 3 + test_random_below(&random, 60);
        uint32_t n = shape_cells(&random, 12, cells, f.points, 120);
        if (n >= 4 && oracle_is_simple(f.points, n)) {
            compare(n);
            compared++;
        }
    }
    TEST_CHECK(compared > 300);
}

static void equals_the_plain_form_on_bridged_holes(void **state)
{
    (void)state;
    for (uint32_t columns = 1; columns <= 4; columns++) {
        for (uint32_t rows = 1; rows <= 4; rows++) {
            compare(shape_holes(f.points, columns, rows));
        }
    }
}

static void equals_the_plain_form_on_hard_families(void **state)
{
    (void)state;
    for (uint32_t n = 8; n <= 120; n += 16) {
        shape_star(f.points, n, 1000.0, 300.0);
        compare(n);
        shape_comb(f.points, n, 50);
        compare(n);
        shape_spiral(f.points, n);
        TEST_CHECK(oracle_is_simple(f.points, n));
        compare(n);
    }
}

static void computes_exactly_at_the_limits(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t compared = 0;
    const int64_t limit = TL_MAX_CONTOUR_COORDINATE;
    for (uint32_t round = 0; round < 400; round++) {
        uint32_t n = 4 + test_random_below(&random, 16);
        if (!shape_untangled(&random, f.points, n, 20)) {
            continue;
        }
        // Stretched to the whole range, then shaken by a unit: the oracle's sums stay below 2^62.
        for (uint32_t i = 0; i < n; i++) {
            f.points[i].x = f.points[i].x * (2 * limit / 20) - limit + test_random_below(&random, 2);
            f.points[i].z = f.points[i].z * (2 * limit / 20) - limit + test_random_below(&random, 2);
        }
        if (oracle_is_simple(f.points, n) && oracle_contour_area2(f.points, n) > 0) {
            compare(n);
            compared++;
        }
    }
    TEST_CHECK(compared > 100);
}

static void refuses_what_is_no_outline(void **state)
{
    (void)state;
    const oracle_point inverted[4] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } };
    memcpy(f.points, inverted, sizeof inverted);
    TEST_RESULT(run(4, TL_EARS_BY_LIST), TL_ERR_SELF_INTERSECTION);
    TEST_RESULT(run(4, TL_EARS_BY_MESH), TL_ERR_SELF_INTERSECTION);
    const oracle_point flat[3] = { { 0, 0 }, { 4, 0 }, { 8, 0 } };
    memcpy(f.points, flat, sizeof flat);
    TEST_RESULT(run(3, TL_EARS_BY_LIST), TL_ERR_SELF_INTERSECTION);
    TEST_RESULT(run(3, TL_EARS_BY_MESH), TL_ERR_SELF_INTERSECTION);
    // Scribbles end in some result, with triangles of positive area when it is TL_OK.
    test_random random = { 4 };
    for (uint32_t round = 0; round < 2000; round++) {
        uint32_t n = 3 + test_random_below(&random, 12);
        shape_random_points(&random, f.points, n, 6);
        if (run(n, round % 2 == 0 ? TL_EARS_BY_LIST : TL_EARS_BY_MESH) == TL_OK) {
            for (uint32_t t = 0; t < n - 2; t++) {
                const uint32_t *c = f.triangles + 3 * t;
                TEST_CHECK(oracle_area2(f.points[c[0]], f.points[c[1]], f.points[c[2]]) < 0);
            }
        }
    }
}

// Hangs a triangular hole on some of the outline's convex corners, which it passes twice then. Edges are along the axes
// and longer than 8. Returns the number of points.
static uint32_t hang_holes(test_random *random, oracle_point *p, uint32_t n)
{
    static oracle_point plain[MAX_POINTS];
    memcpy(plain, p, n * sizeof *p);
    uint32_t made = 0;
    for (uint32_t i = 0; i < n; i++) {
        const oracle_point a = plain[(i + n - 1) % n], b = plain[i], c = plain[(i + 1) % n];
        p[made++] = b;
        if (oracle_area2(a, b, c) >= 0 || test_random_below(random, 3) != 0) {
            continue;
        }
        const int64_t back_x = oracle_sign(a.x - b.x), back_z = oracle_sign(a.z - b.z);
        const int64_t on_x = oracle_sign(c.x - b.x), on_z = oracle_sign(c.z - b.z);
        const oracle_point hole[2] = { { b.x + 4 * back_x + 2 * on_x, b.z + 4 * back_z + 2 * on_z },
                                       { b.x + 2 * back_x + 4 * on_x, b.z + 2 * back_z + 4 * on_z } };
        p[made++] = hole[0];
        p[made++] = hole[1];
        p[made++] = b;
    }
    return made;
}

static void equals_the_plain_form_where_outlines_touch_themselves(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t compared = 0;
    for (uint32_t round = 0; round < 1500; round++) {
        const uint32_t n = shape_cells(&random, 12, 3 + test_random_below(&random, 60), f.points, 120);
        if (n < 4 || !oracle_is_simple(f.points, n)) {
            continue;
        }
        for (uint32_t i = 0; i < n; i++) {
            f.points[i].x *= 16;
            f.points[i].z *= 16;
        }
        const uint32_t with_holes = hang_holes(&random, f.points, n);
        compare(with_holes);
        compared += with_holes > n + 6;
    }
    TEST_CHECK(compared > 200);
}

// By place the same triangles stand at other numbers, each beside its outline's corner.
static void check_by_place(const tl_lattice_point *lattice, uint32_t n, tl_ear_test ear_test, const uint32_t *triangles,
                           const uint32_t *twins)
{
    uint32_t *corners = malloc(3 * (size_t)n * sizeof *corners), *across = malloc(3 * (size_t)n * sizeof *across);
    uint32_t *places = malloc(n * sizeof *places);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    const tl_triangulate_input input = { lattice, n, NULL, NULL, ear_test, places };
    TEST_RESULT(tl_triangulate(&arena, &input, corners, across), TL_OK);
    tl_arena_free(&arena);
    for (uint32_t t = 0; t < n - 2; t++) {
        TEST_CHECK(places[t] < n - 2 && memcmp(&corners[3 * t], &triangles[3 * places[t]], 3 * sizeof *corners) == 0);
        TEST_CHECK(t == 0 || corners[3 * t + 1] > corners[3 * t - 2]);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t twin = across[3 * t + k];
            const uint32_t expected = twin != TL_NO_EDGE ? 3 * places[twin / 3] + twin % 3 : TL_NO_EDGE;
            TEST_CHECK(twins[3 * places[t] + k] == expected);
        }
    }
    free(corners);
    free(across);
    free(places);
}

// Too large for the plain form: the list, which is proven by it, against the mesh.
static void compare_large(const oracle_point *points, uint32_t n)
{
    tl_lattice_point *lattice = malloc(n * sizeof *lattice);
    uint32_t *out[4];
    for (uint32_t k = 0; k < 4; k++) {
        out[k] = malloc(3 * (size_t)n * sizeof *out[k]);
    }
    for (uint32_t i = 0; i < n; i++) {
        lattice[i].x = (int32_t)points[i].x;
        lattice[i].z = (int32_t)points[i].z;
    }
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    for (uint32_t k = 0; k < 2; k++) {
        const tl_triangulate_input input = { lattice, n, NULL, NULL, k == 0 ? TL_EARS_BY_LIST : TL_EARS_BY_MESH, NULL };
        TEST_RESULT(tl_triangulate(&arena, &input, out[2 * k], out[2 * k + 1]), TL_OK);
    }
    tl_arena_free(&arena);
    TEST_CHECK(memcmp(out[0], out[2], 3 * ((size_t)n - 2) * sizeof(uint32_t)) == 0);
    TEST_CHECK(memcmp(out[1], out[3], 3 * ((size_t)n - 2) * sizeof(uint32_t)) == 0);
    check_by_place(lattice, n, TL_EARS_BY_LIST, out[0], out[1]);
    check_by_place(lattice, n, TL_EARS_BY_MESH, out[0], out[1]);
    for (uint32_t k = 0; k < 4; k++) {
        free(out[k]);
    }
    free(lattice);
}

static void list_and_mesh_agree_on_large_random_outlines(void **state)
{
    (void)state;
    enum { LARGEST = 3000 };
    oracle_point *points = malloc(2 * LARGEST * sizeof *points);
    test_random random = { 6 };
    for (uint32_t round = 0; round < 20; round++) {
        const uint32_t n = 64 + 2 * test_random_below(&random, (LARGEST - 64) / 2);
        // From lattices on which many lengths are equal to the whole range.
        const double radius = 1000.0 * n * (1u << test_random_below(&random, 6));
        shape_random_star(&random, points, n, radius, round % 8 / 10.0 + 0.1);
        compare_large(points, n);
        shape_random_comb(&random, points, n, 2u << test_random_below(&random, 24));
        compare_large(points, n);
        shape_random_spiral(&random, points, n, radius);
        compare_large(points, n);
        const uint32_t side = 1 + test_random_below(&random, 30);
        compare_large(points, shape_random_holes(&random, points, side, 1 + test_random_below(&random, 30)));
    }
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_the_shortest_partition_first),
        cmocka_unit_test(one_triangle_stays_as_it_is),
        cmocka_unit_test(equals_the_plain_form_on_random_outlines),
        cmocka_unit_test(equals_the_plain_form_on_straight_runs),
        cmocka_unit_test(equals_the_plain_form_on_bridged_holes),
        cmocka_unit_test(equals_the_plain_form_on_hard_families),
        cmocka_unit_test(computes_exactly_at_the_limits),
        cmocka_unit_test(refuses_what_is_no_outline),
        cmocka_unit_test(equals_the_plain_form_where_outlines_touch_themselves),
        cmocka_unit_test(list_and_mesh_agree_on_large_random_outlines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
