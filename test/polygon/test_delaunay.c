// SPDX-License-Identifier: MIT

#include "polygon/triangulate/delaunay.h"

#include "polygon/triangulate/triangulate.h"
#include "polygon_shapes.h"

#include <stdlib.h>
#include <talus/polygon.h>

enum { MAX_POINTS = 512 };

static oracle_point points[MAX_POINTS];
static tl_lattice_point lattice[MAX_POINTS];
static uint32_t triangles[3 * MAX_POINTS], twins[3 * MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

__extension__ typedef __int128 int128;

// The sign of the 3 x 3 determinant of the lifted points, below 2^125: > 0 for d inside.
static int circle_side(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c, tl_lattice_point d)
{
    const tl_lattice_point p[3] = { a, b, c };
    int128 x[3], z[3], sum = 0;
    for (uint32_t i = 0; i < 3; i++) {
        x[i] = (int128)p[i].x - d.x;
        z[i] = (int128)p[i].z - d.z;
    }
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        sum += (x[i] * x[i] + z[i] * z[i]) * (x[j] * z[k] - x[k] * z[j]);
    }
    // Contours run clockwise in x, z.
    return (sum < 0) - (sum > 0);
}

static void in_circle_is_exact(void **state)
{
    (void)state;
    test_random random = { 51 };
    const int32_t limit = 1 << 29;
    uint32_t tested = 0, inside = 0, on = 0;
    for (uint32_t round = 0; round < 200000; round++) {
        tl_lattice_point p[4];
        uint32_t spread = round % 3 == 0 ? 6 : 3;
        for (uint32_t i = 0; i < 4; i++) {
            // Corners of the lattice's whole range and close by: circles that differ in the last digit.
            p[i].x = (int32_t)test_random_below(&random, spread);
            p[i].z = (int32_t)test_random_below(&random, spread);
            if (round % 3 != 0) {
                p[i].x += i == 0 || i == 3 ? -limit : limit - 2;
                p[i].z += i < 2 ? -limit : limit - 2;
            }
        }
        for (uint32_t flipped = 0; flipped < 2; flipped++) {
            if (tl_turn(p[0], p[1], p[2]) > 0 && tl_turn(p[0], p[2], p[3]) > 0) {
                int side = circle_side(p[0], p[1], p[2], p[3]);
                TEST_CHECK(tl_in_circle(p[0], p[1], p[2], p[3]) == (side > 0));
                tested++;
                inside += side > 0;
                on += side == 0;
            }
            tl_lattice_point t = p[1];
            p[1] = p[3];
            p[3] = t;
        }
    }
    TEST_CHECK(tested > 100000 && inside > 20000 && on > 1000);
}

static int by_corners(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(uint32_t));
}

// Triangles from their lowest corner on, in rising order.
static void sort_triangles(uint32_t *t, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *c = t + 3 * i;
        while (c[0] > c[1] || c[0] > c[2]) {
            uint32_t first = c[0];
            c[0] = c[1];
            c[1] = c[2];
            c[2] = first;
        }
    }
    qsort(t, count, 3 * sizeof *t, by_corners);
}

static uint32_t make(uint32_t n, uint32_t shift)
{
    for (uint32_t i = 0; i < n; i++) {
        lattice[i].x = (int32_t)points[(i + shift) % n].x;
        lattice[i].z = (int32_t)points[(i + shift) % n].z;
    }
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    const tl_triangulate_input input = { lattice, n, NULL, NULL, TL_EARS_BY_SIZE, NULL };
    TEST_RESULT(tl_triangulate(&arena, &input, triangles, twins), TL_OK);
    uint32_t before[3 * MAX_POINTS];
    memcpy(before, triangles, 3 * (n - 2) * sizeof *before);
    TEST_RESULT(tl_make_delaunay(&arena, lattice, triangles, twins, n - 2), TL_OK);
    tl_arena_free(&arena);
    uint32_t changed = 0;
    for (uint32_t i = 0; i < 3 * (n - 2); i++) {
        changed += before[i] != triangles[i];
    }
    return changed;
}

// Right links, positive areas that sum to the outline's, and no edge that should be flipped.
static uint32_t check(uint32_t n)
{
    int64_t area = 0;
    uint32_t open = 0, on_circles = 0;
    for (uint32_t e = 0; e < 3 * (n - 2); e++) {
        const uint32_t *c = triangles + e / 3 * 3;
        if (e % 3 == 0) {
            int64_t part = tl_turn(lattice[c[0]], lattice[c[1]], lattice[c[2]]);
            TEST_CHECK(part > 0);
            area += part;
        }
        uint32_t t = twins[e];
        if (t == TL_NO_EDGE) {
            open++;
            continue;
        }
        uint32_t next = e % 3 < 2 ? e + 1 : e - 2, twin_next = t % 3 < 2 ? t + 1 : t - 2;
        TEST_CHECK(twins[t] == e && triangles[e] == triangles[twin_next] && triangles[next] == triangles[t]);
        tl_lattice_point beyond = lattice[triangles[t % 3 > 0 ? t - 1 : t + 2]];
        int side = circle_side(lattice[c[0]], lattice[c[1]], lattice[c[2]], beyond);
        TEST_CHECK(side <= 0);
        on_circles += side == 0;
    }
    TEST_CHECK(open == n && area == oracle_contour_area2(points, n));
    return on_circles;
}

static void no_edge_is_left_to_flip(void **state)
{
    (void)state;
    test_random random = { 52 };
    static uint32_t first[3 * MAX_POINTS];
    uint32_t tested = 0, changed = 0, unique = 0;
    for (uint32_t round = 0; round < 1200; round++) {
        uint32_t n = 4 + test_random_below(&random, 30);
        if (!shape_untangled(&random, points, n, 8u << test_random_below(&random, 12))) {
            continue;
        }
        changed += make(n, 0) > 0;
        bool ties = check(n) > 0;
        tested++;
        if (!ties) {
            // No four corners on one circle: the result is the same from any other start.
            memcpy(first, triangles, sizeof first);
            uint32_t shift = 1 + test_random_below(&random, n - 1);
            make(n, shift);
            for (uint32_t i = 0; i < 3 * (n - 2); i++) {
                triangles[i] = (triangles[i] + shift) % n;
            }
            sort_triangles(first, n - 2);
            sort_triangles(triangles, n - 2);
            TEST_CHECK(memcmp(first, triangles, 3 * (n - 2) * sizeof *first) == 0);
            unique++;
        }
    }
    TEST_CHECK(tested > 600 && changed > 300 && unique > 300);
    for (uint32_t n = 8; n <= 500; n += 100) {
        shape_star(points, n, 1e8, 3e7);
        make(n, 0);
        check(n);
        shape_comb(points, n, 50);
        make(n, 0);
        check(n);
        shape_spiral(points, n);
        make(n, 0);
        check(n);
    }
}

static void meshes_of_all_kinds_are_good(void **state)
{
    (void)state;
    test_random random = { 53 };
    uint32_t good = 0;
    for (uint32_t round = 0; round < 2000; round++) {
        uint32_t n = 3 + test_random_below(&random, 20);
        shape_random_points(&random, points, n, 4u << test_random_below(&random, 8));
        shape_make_outer(points, n);
        if (round % 100 == 0) {
            n = shape_holes(points, 1 + round / 100 % 6, 1 + round / 100 % 5);
        }
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, n, vertices, &contour);
        tl_polygon_def def = tl_default_polygon_def();
        def.method = TL_PARTITION_DELAUNAY;
        def.max_verts_per_poly = round % 3 == 0 ? 0 : 6;
        tl_polygon_mesh mesh;
        tl_polygon_report report;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
        TEST_RESULT(tl_polygon_mesh_check(&mesh, &set, NULL, NULL), TL_OK);
        TEST_CHECK(report.lower_bound <= report.polygon_count);
        good += mesh.polygon_count > 0;
        tl_polygon_mesh_free(&mesh);
    }
    TEST_CHECK(good > 1000);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    uint32_t n = shape_holes(points, 8, 8);
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    def.method = TL_PARTITION_DELAUNAY;
    TEST_CHECK(shape_check_failing_memory(&set, def) > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_circle_is_exact),
        cmocka_unit_test(no_edge_is_left_to_flip),
        cmocka_unit_test(meshes_of_all_kinds_are_good),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
