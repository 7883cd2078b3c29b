// SPDX-License-Identifier: MIT

#include "polygon/triangulate/ear_mesh.h"

#include "polygon_random_shapes.h"

enum { MAX_POINTS = 400 };

typedef struct fixture {
    oracle_point points[MAX_POINTS];
    tl_lattice_point lattice[MAX_POINTS];
    uint32_t left[MAX_POINTS]; // what is left of the outline
    tl_ear_vertex vertices[MAX_POINTS];
    uint32_t free_ears, blocked_ears;
} fixture;

static fixture f;

static void start(uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        f.lattice[i].x = (int32_t)f.points[i].x;
        f.lattice[i].z = (int32_t)f.points[i].z;
        f.left[i] = i;
        f.vertices[i].position = f.lattice[i];
    }
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    TEST_RESULT(tl_ear_mesh_init(f.vertices, n, &arena, f.lattice, NULL), TL_OK);
    tl_arena_free(&arena);
}

static uint32_t origin_of(uint32_t edge)
{
    return tl_ear_edge_origin(f.vertices, edge);
}

static uint32_t find_triangle(uint32_t edge)
{
    return edge / 4;
}

// Walks over all triangles from the outline's first edge on: each has a positive area, twins are each other's, the
// outline's edges are there, and all have the outline's area.
static void check_mesh(uint32_t n, uint32_t total)
{
    static uint8_t is_seen[MAX_POINTS];
    static uint32_t stack[3 * MAX_POINTS];
    memset(is_seen, 0, sizeof is_seen);
    oracle_point outline[MAX_POINTS];
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t edge = f.vertices[f.left[i]].outer;
        TEST_CHECK(tl_ear_edge_twin(f.vertices, edge) == TL_NO_EAR_EDGE && origin_of(edge) == f.left[i]);
        TEST_CHECK(origin_of(tl_ear_edge_next(edge)) == f.left[(i + 1) % n]);
        outline[i] = f.points[f.left[i]];
    }
    uint32_t depth = 0, triangles = 0;
    int64_t area = 0;
    stack[depth++] = f.vertices[f.left[0]].outer;
    is_seen[find_triangle(stack[0])] = 1;
    while (depth > 0) {
        uint32_t edge = stack[--depth];
        oracle_point corners[3];
        TEST_CHECK(find_triangle(edge) > 0 && find_triangle(edge) < total - 1);
        for (uint32_t k = 0; k < 3; k++, edge = tl_ear_edge_next(edge)) {
            const uint32_t twin = tl_ear_edge_twin(f.vertices, edge);
            TEST_CHECK(tl_ear_edge_previous(tl_ear_edge_next(edge)) == edge);
            corners[k] = f.points[origin_of(edge)];
            if (twin == TL_NO_EAR_EDGE) {
                TEST_CHECK(f.vertices[origin_of(edge)].outer == edge);
                continue;
            }
            TEST_CHECK(tl_ear_edge_twin(f.vertices, twin) == edge);
            TEST_CHECK(origin_of(tl_ear_edge_next(twin)) == origin_of(edge));
            if (!is_seen[find_triangle(twin)]) {
                is_seen[find_triangle(twin)] = 1;
                stack[depth++] = twin;
            }
        }
        TEST_CHECK(oracle_area2(corners[0], corners[1], corners[2]) < 0);
        area -= oracle_area2(corners[0], corners[1], corners[2]);
        triangles++;
    }
    TEST_CHECK(triangles == n - 2 && area == oracle_contour_area2(outline, n));
}

// Cuts ears off in random order; each answer is the plain form's.
static void cut_at_random(test_random *random, uint32_t n)
{
    start(n);
    check_mesh(n, n);
    for (uint32_t left = n; left > 3;) {
        const uint32_t i = test_random_below(random, left);
        const uint32_t a = f.left[i], b = f.left[(i + 1) % left], c = f.left[(i + 2) % left];
        if (tl_turn(f.lattice[a], f.lattice[b], f.lattice[c]) <= 0) {
            continue;
        }
        const bool is_free = tl_ear_mesh_is_free(f.vertices, a, b, f.lattice[a], f.lattice[c]);
        TEST_CHECK(is_free == oracle_is_valid_cut(f.points, f.left, left, i));
        f.free_ears += is_free;
        f.blocked_ears += !is_free;
        if (is_free) {
            tl_ear_mesh_cut(f.vertices, a, b);
            const uint32_t gone = (i + 1) % left--;
            memmove(f.left + gone, f.left + gone + 1, (left - gone) * sizeof *f.left);
            if (left % 8 == 0) {
                check_mesh(left, n);
            }
        }
    }
    check_mesh(3, n);
}

static void ears_are_free_as_the_plain_form_says(void **state)
{
    (void)state;
    test_random random = { 8 };
    for (uint32_t round = 0; round < 1200; round++) {
        uint32_t n = 4 + test_random_below(&random, 30);
        const uint32_t side = 4u << test_random_below(&random, 12);
        bool is_good = shape_untangled(&random, f.points, n, side);
        if (round % 4 == 0) {
            n = shape_cells(&random, 12, 3 + test_random_below(&random, 60), f.points, 120);
            is_good = n >= 4 && oracle_is_simple(f.points, n);
        }
        if (is_good) {
            cut_at_random(&random, n);
        }
    }
    TEST_CHECK(f.free_ears > 8000 && f.blocked_ears > 4000);
}

static void large_ears_are_cut_right_too(void **state)
{
    (void)state;
    test_random random = { 9 };
    for (uint32_t round = 0; round < 12; round++) {
        const uint32_t n = 64 + 2 * test_random_below(&random, 160);
        shape_random_star(&random, f.points, n, 5e8, 0.1);
        cut_at_random(&random, n);
        shape_random_comb(&random, f.points, n, 1000);
        cut_at_random(&random, n);
        shape_random_spiral(&random, f.points, n, 1e6);
        cut_at_random(&random, n);
        cut_at_random(&random, shape_random_holes(&random, f.points, 1 + round % 6, 1 + round % 5));
        cut_at_random(&random, shape_holes(f.points, 1 + round % 6, 1 + round % 5));
    }
}

// One corner sees all others: its edges move on when it goes.
static void a_fan_is_cut_at_its_hub(void **state)
{
    (void)state;
    enum { ARC = 200 };
    for (uint32_t i = 0; i < ARC; i++) {
        // A parabola, seen from a hub far off: convex.
        f.points[i].x = i;
        f.points[i].z = (int64_t)i * (ARC - 1 - i);
    }
    const oracle_point hub = { ARC / 2, -100000 };
    f.points[ARC] = hub;
    shape_make_outer(f.points, ARC + 1);
    test_random random = { 10 };
    cut_at_random(&random, ARC + 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ears_are_free_as_the_plain_form_says),
        cmocka_unit_test(large_ears_are_cut_right_too),
        cmocka_unit_test(a_fan_is_cut_at_its_hub),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
