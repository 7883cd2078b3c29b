// SPDX-License-Identifier: MIT
//
// Hole merge: areas add up exactly, bridges cross nothing, each hole's vertices are all there.

#include "nav_contour_checks.h"

#include "nav_bake/contours/contours.h"

static void example_two_holes(void **state)
{
    (void)state;
    static const char *const rows[] = { "0000000000", "0000000000", "00   00  0", "00   00  0",
                                        "00   00000", "0000000000", "0000000000" };
    tl_nav_compact compact = fixture_from_rows(rows, 7, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    config.max_simplification_error = 0.5f;
    tl_nav_contours contours;
    make_contours(&compact, &config, &contours);
    TEST_CHECK(contours.set.contour_count == 1 && contours.hole_count == 2 && contours.unbridged_count == 0);
    TEST_CHECK(contours.set.vertex_count == 4 + (4 + 2) + (4 + 2));
    TEST_CHECK(contour_area2(&contours.set, 0) == 2 * (70 - 9 - 4));
    TEST_CHECK(contours.raw.contour_count == 3 && contours.raw.contours[0].vertex_count == 34);
    check_no_crossing(&contours.set, 0);
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

// The bridged contour's area is its outline's less its holes', and each hole adds its vertices and two.
static void areas_add_up(void **state)
{
    (void)state;
    test_random random = { 808 };
    uint32_t holes_seen = 0, most = 0;
    for (int round = 0; round < 80; round++) {
        tl_nav_compact compact =
            fixture_random(&random, 60, 60, 1 + round % 2, test_random_below(&random, 9), round % 4 == 3 ? 3 : 0);
        tl_nav_config config = region_config(round % 2 == 0 ? TL_NAV_LAYERS : TL_NAV_WATERSHED, 5, 400);
        config.max_simplification_error = test_random_range(&random, 0.0f, 3.0f);
        tl_arena arena;
        tl_contour_work work;
        trace_contours(&compact, &config, &arena, &work);
        TEST_RESULT(tl_contours_simplify(&work), TL_OK);
        TEST_RESULT(tl_contours_repair(&work), TL_OK);
        tl_nav_contours contours;
        TEST_RESULT(tl_nav_bake_contours(&config, &compact, NULL, &contours, NULL), TL_OK);
        TEST_CHECK(contours.unbridged_count == 0);
        int64_t *area2 = calloc(compact.region_count + 1, sizeof *area2);
        uint32_t *vertices = calloc(compact.region_count + 1, sizeof *vertices);
        uint32_t *room = malloc((work.vertex_count + 1) * sizeof *room), holes = 0;
        for (uint32_t l = 0; l < work.loop_count; l++) {
            tl_contour_path path = { room, 0 };
            tl_contours_simplified(&work, l, &path);
            if (work.loops[l].area2 == 0) {
                continue;
            }
            for (uint32_t k = 0, j = path.count - 1; k < path.count; j = k++) {
                const tl_contour_vertex *p = &work.vertices[room[k]], *q = &work.vertices[room[j]];
                area2[work.loops[l].region] += (int64_t)p->x * q->z - (int64_t)q->x * p->z;
            }
            vertices[work.loops[l].region] += path.count + (work.loops[l].area2 < 0 ? 2 : 0);
            holes += work.loops[l].area2 < 0;
        }
        for (uint32_t c = 0; c < contours.set.contour_count; c++) {
            uint32_t region = contours.set.contours[c].region;
            TEST_CHECK(contour_area2(&contours.set, c) == area2[region]);
            TEST_CHECK(contours.set.contours[c].vertex_count == vertices[region]);
        }
        holes_seen += holes;
        most = holes > most ? holes : most;
        free(area2);
        free(vertices);
        free(room);
        tl_nav_contours_free(&contours);
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(holes_seen > 500 && most > 30);
}

// Nothing sees a hole that lies outside of its outline, behind another: it is counted, and the path stays as it was.
static void unbridgeable_hole_is_named(void **state)
{
    (void)state;
    // A square outline; a hole outside of it.
    tl_contour_vertex v[8] = { { 0, 0, 0, 0 },  { 0, 0, 9, 0 },  { 9, 0, 9, 0 },  { 9, 0, 0, 0 },
                               { 20, 0, 2, 0 }, { 22, 0, 2, 0 }, { 22, 0, 4, 0 }, { 20, 0, 4, 0 } };
    uint32_t outline_room[16] = { 0, 1, 2, 3 }, hole_room[4] = { 4, 5, 6, 7 };
    tl_contour_work work;
    memset(&work, 0, sizeof work);
    work.vertices = v;
    tl_contour_path outline = { outline_room, 4 }, hole = { hole_room, 4 };
    tl_sort_item order[1], scratch[1];
    TEST_CHECK(tl_contours_bridge_holes(&work, &outline, &hole, 1, order, scratch) == 1);
    TEST_CHECK(outline.count == 4);
    // And one inside is bridged from its leftmost vertex to the nearest corner that sees it.
    for (int k = 4; k < 8; k++) {
        v[k].x -= 18;
    }
    TEST_CHECK(tl_contours_bridge_holes(&work, &outline, &hole, 1, order, scratch) == 0);
    static const uint32_t expected[10] = { 0, 4, 5, 6, 7, 4, 0, 1, 2, 3 };
    TEST_CHECK(outline.count == 10);
    assert_memory_equal(outline_room, expected, sizeof expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example_two_holes),
        cmocka_unit_test(areas_add_up),
        cmocka_unit_test(unbridgeable_hole_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
