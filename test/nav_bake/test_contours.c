// SPDX-License-Identifier: MIT
//
// Contours as a whole: areas, errors, crossings, bridges, shared edges.

#include "nav_contour_checks.h"

static tl_nav_compact random_level(test_random *random, int round)
{
    uint32_t width = test_random_below(random, 50), height = test_random_below(random, 50);
    if (round % 7 == 6) {
        return fixture_spiral(8 + width / 2, 1 + height % 3, 4);
    }
    uint32_t holes = test_random_below(random, 1 + (uint32_t)round % 16), border = round % 3 == 2 ? 3 : 0;
    return fixture_random(random, 10 + width, 10 + height, 1 + round % 4, holes, border);
}

static tl_nav_config contour_config(test_random *random, int round)
{
    uint32_t min_area = test_random_below(random, 20);
    tl_nav_config config = region_config((tl_nav_partition)(round % 3), min_area, test_random_below(random, 300));
    config.max_simplification_error = round % 5 == 0 ? 0.0f : test_random_range(random, 0.5f, 4.0f);
    config.max_edge_len = round % 2 == 0 ? 0 : test_random_below(random, 30);
    return config;
}

static void invariants(void **state)
{
    (void)state;
    test_random random = { 1234 };
    uint32_t holes = 0, repaired = 0, contours_seen = 0, unbridged = 0;
    for (int round = 0; round < 240; round++) {
        tl_nav_compact compact = random_level(&random, round);
        tl_nav_config config = contour_config(&random, round);
        tl_nav_contours contours;
        make_contours(&compact, &config, &contours);
        check_raw_areas(&compact, &contours);
        TEST_CHECK(contours.set.width == (int32_t)compact.width - 2 * (int32_t)compact.border_size);
        for (uint32_t c = 0; c < contours.set.contour_count; c++) {
            const tl_contour *contour = &contours.set.contours[c];
            TEST_CHECK(contour->vertex_count >= 3);
            TEST_CHECK(contour_area2(&contours.set, c) > 0);
            check_no_crossing(&contours.set, c);
            for (uint32_t k = 0; k < contour->vertex_count; k++) {
                const tl_contour_vertex *v = &contours.set.vertices[contour->first_vertex + k];
                const tl_contour_vertex *next =
                    &contours.set.vertices[contour->first_vertex + (k + 1) % contour->vertex_count];
                TEST_CHECK(v->x != next->x || v->z != next->z);
            }
        }
        // Polygons are made of them as they are: nothing to repair.
        tl_polygon_def def = tl_default_polygon_def();
        tl_polygon_mesh polygons;
        TEST_RESULT(tl_polygon_mesh_bake(&contours.set, &def, &polygons, NULL), TL_OK);
        TEST_CHECK(polygons.note_count == 0);
        tl_polygon_mesh_free(&polygons);
        contours_seen += contours.set.contour_count;
        holes += contours.hole_count;
        repaired += contours.repaired_count;
        unbridged += contours.unbridged_count;
        tl_nav_contours_free(&contours);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(contours_seen > 2000 && holes > 300 && repaired > 100);
    TEST_CHECK(unbridged == 0);
}

static void lattice_of_a_tile(void **state)
{
    (void)state;
    test_random random = { 3 };
    tl_nav_compact compact = fixture_random(&random, 30, 26, 1, 0, 3);
    compact.lattice.first_x = 61;
    compact.lattice.first_z = -3;
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    tl_nav_contours contours;
    make_contours(&compact, &config, &contours);
    TEST_CHECK(contours.set.width == 24 && contours.set.height == 20 && contours.set.border_size == 3);
    TEST_CHECK(contours.set.bounds.min.x == -3.0f + 64 * 0.5f && contours.set.bounds.min.z == 7.0f);
    TEST_CHECK(contours.set.bounds.max.x == -3.0f + 88 * 0.5f && contours.set.bounds.max.z == 7.0f + 20 * 0.5f);
    for (uint32_t k = 0; k < contours.set.vertex_count; k++) {
        const tl_contour_vertex *v = &contours.set.vertices[k];
        TEST_CHECK(v->x >= 0 && v->x <= 24 && v->z >= 0 && v->z <= 20);
    }
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

static void nothing_walkable(void **state)
{
    (void)state;
    static const char *const rows[] = { "###", "   " };
    tl_nav_compact compact = fixture_from_rows(rows, 2, 0);
    tl_nav_config config = region_config(TL_NAV_WATERSHED, 0, 0);
    tl_nav_contours contours;
    tl_report report;
    TEST_RESULT(tl_nav_bake_contours(&config, &compact, NULL, &contours, &report), TL_ERR_ARGUMENT); // no regions yet
    TEST_CHECK(report.advice != NULL && contours.block == NULL);
    make_contours(&compact, &config, &contours);
    TEST_CHECK(contours.set.contour_count == 0 && contours.raw.contour_count == 0);
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

static void fails_at_each_allocation(void **state)
{
    (void)state;
    test_random random = { 12 };
    tl_nav_compact compact = fixture_random(&random, 50, 50, 2, 6, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 5, 0);
    config.max_simplification_error = 2.0f;
    tl_nav_contours whole;
    make_contours(&compact, &config, &whole);
    test_allocator test;
    uint64_t k = 1;
    for (;; k++) {
        test_allocator_init(&test, k);
        tl_host host = { &test.allocator, NULL, NULL };
        tl_nav_contours contours;
        tl_result result = tl_nav_bake_contours(&config, &compact, &host, &contours, NULL);
        if (result == TL_OK) {
            TEST_CHECK(contours.set.vertex_count == whole.set.vertex_count);
            assert_memory_equal(contours.set.vertices, whole.set.vertices,
                                whole.set.vertex_count * sizeof *whole.set.vertices);
            tl_nav_contours_free(&contours);
            TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(test.live_blocks == 0 && contours.block == NULL && contours.set.contours == NULL);
    }
    TEST_CHECK(k > 3);
    tl_nav_contours_free(&whole);
    fixture_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(invariants),
        cmocka_unit_test(lattice_of_a_tile),
        cmocka_unit_test(nothing_walkable),
        cmocka_unit_test(fails_at_each_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
