// SPDX-License-Identifier: MIT
//
// Contours as a whole: areas, errors, crossings, bridges, shared edges.

#include "nav_contour_checks.h"

static tl_nav_compact random_level(test_random *random, int round)
{
    return round % 7 == 6 ? fixture_spiral(8 + test_random_below(random, 30), 1 + test_random_below(random, 3), 4)
                          : fixture_random(random, 10 + test_random_below(random, 50),
                                           10 + test_random_below(random, 50), 1 + round % 4,
                                           test_random_below(random, 1 + (uint32_t)round % 16), round % 3 == 2 ? 3 : 0);
}

static tl_nav_config contour_config(test_random *random, int round)
{
    tl_nav_config config =
        region_config((tl_nav_partition)(round % 3), test_random_below(random, 20), test_random_below(random, 300));
    config.max_simplification_error = round % 5 == 0 ? 0.0f : test_random_range(random, 0.5f, 4.0f);
    config.max_edge_len = test_random_below(random, 2) * test_random_below(random, 30);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(invariants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
