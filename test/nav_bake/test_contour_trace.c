// SPDX-License-Identifier: MIT
//
// Contour trace: areas, closedness, heights, flags and twins of traced outlines.

#include "nav_contour_checks.h"

#include "nav_bake/contours/contours.h"

static void example_square(void **state)
{
    (void)state;
    static const char *const rows[] = { "     ", " 013 ", " 012 ", "     " };
    tl_nav_compact compact = fixture_from_rows(rows, 4, 0);
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 100);
    tl_arena arena;
    tl_contour_work work;
    trace_contours(&compact, &config, &arena, &work);
    TEST_CHECK(work.loop_count == 1 && work.vertex_count == 10 && work.loops[0].area2 == 12);
    // Clockwise from the first floor's x- edge: up along z, right, down, left. Heights: the highest floor around.
    static const int expected[10][3] = { { 1, 0, 1 }, { 1, 0, 2 }, { 1, 0, 3 }, { 2, 1, 3 }, { 3, 2, 3 },
                                         { 4, 2, 3 }, { 4, 3, 2 }, { 4, 3, 1 }, { 3, 3, 1 }, { 2, 1, 1 } };
    for (int k = 0; k < 10; k++) {
        const tl_contour_vertex *v = &work.vertices[k];
        TEST_CHECK(v->x == expected[k][0] && v->y == expected[k][1] && v->z == expected[k][2] && v->flags == 0);
        TEST_CHECK(work.twin[k] == TL_NO_TWIN && work.across[k] == 0);
    }
    tl_arena_free(&arena);
    fixture_compact_free(&compact);
}

// A single column is an outline too.
static void example_one_column(void **state)
{
    (void)state;
    static const char *const rows[] = { "5" };
    tl_nav_compact compact = fixture_from_rows(rows, 1, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    tl_arena arena;
    tl_contour_work work;
    trace_contours(&compact, &config, &arena, &work);
    TEST_CHECK(work.loop_count == 1 && work.vertex_count == 4 && work.loops[0].area2 == 2 && work.vertices[2].y == 5);
    tl_arena_free(&arena);
    fixture_compact_free(&compact);
}

// Each twin is the same edge backwards, its twin is the edge itself, and its region is the one across.
static void twins(void **state)
{
    (void)state;
    test_random random = { 31 };
    uint32_t paired = 0, walls = 0, area_borders = 0;
    for (int round = 0; round < 60; round++) {
        tl_nav_compact compact = round % 5 == 4
                                     ? fixture_spiral(20, 2, 4)
                                     : fixture_random(&random, 40, 40, 1 + round % 3, test_random_below(&random, 15),
                                                      round % 2 == 0 ? 0 : 2);
        tl_nav_config config = region_config((tl_nav_partition)(round % 3), 10, 50);
        tl_arena arena;
        tl_contour_work work;
        trace_contours(&compact, &config, &arena, &work);
        for (uint32_t k = 0; k < work.vertex_count; k++) {
            uint32_t twin = work.twin[k], next = tl_contour_next(&work, k);
            uint32_t across = work.across[k], own = work.loops[work.loop_of[k]].region;
            TEST_CHECK(across != own && tl_contour_previous(&work, next) == k);
            bool is_area_border = (work.vertices[k].flags & TL_CONTOUR_AREA_BORDER) != 0;
            area_borders += is_area_border;
            TEST_CHECK(((work.vertices[k].flags & TL_CONTOUR_REGION_MASK) == 0) == (across == 0));
            if (across == 0 || (across & TL_NAV_BORDER_REGION) != 0) {
                TEST_CHECK(twin == TL_NO_TWIN);
                TEST_CHECK(across == 0 || (work.vertices[k].flags & 0x8000u) != 0);
                walls++;
                continue;
            }
            TEST_CHECK(twin != TL_NO_TWIN && work.twin[twin] == k && work.across[twin] == own);
            TEST_CHECK(work.loops[work.loop_of[twin]].region == across);
            TEST_CHECK(tl_contour_same_xz(&work.vertices[twin], &work.vertices[next]));
            TEST_CHECK(tl_contour_same_xz(&work.vertices[tl_contour_next(&work, twin)], &work.vertices[k]));
            TEST_CHECK((work.vertices[twin].flags & TL_CONTOUR_AREA_BORDER) ==
                       (work.vertices[k].flags & TL_CONTOUR_AREA_BORDER));
            paired++;
        }
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(paired > 2000 && walls > 2000 && area_borders > 100);
}

// A tile of one storey, cut in two regions: the outline has a border vertex where the tile's border meets both.
static void border_vertices(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(16, 16);
    for (uint32_t z = 0; z < 16; z++) {
        for (uint32_t x = 0; x < 16; x++) {
            fixture_add_floor(&map, x, z, 3, TL_NAV_WALKABLE_AREA);
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 4);
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 0);
    tl_arena arena;
    tl_contour_work work;
    trace_contours(&compact, &config, &arena, &work);
    TEST_CHECK(work.loop_count == 1 && work.vertex_count == 32 && work.loops[0].area2 == 2 * 64);
    uint32_t flagged = 0;
    for (uint32_t k = 0; k < work.vertex_count; k++) {
        const tl_contour_vertex *v = &work.vertices[k];
        TEST_CHECK(v->x >= 0 && v->x <= 8 && v->z >= 0 && v->z <= 8); // the border is cut off
        bool at_corner = (v->x == 0 || v->x == 8) && (v->z == 0 || v->z == 8);
        TEST_CHECK(((v->flags & TL_CONTOUR_BORDER_VERTEX) != 0) == !at_corner);
        flagged += !at_corner;
    }
    TEST_CHECK(flagged == 28);
    tl_arena_free(&arena);
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example_square),
        cmocka_unit_test(example_one_column),
        cmocka_unit_test(twins),
        cmocka_unit_test(border_vertices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
