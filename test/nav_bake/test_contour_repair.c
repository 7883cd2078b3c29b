// SPDX-License-Identifier: MIT
//
// Contour repair: what aggressive simplification breaks is mended, and no more is added than that needs.

#include "nav_contour_checks.h"

#include "nav_bake/contours/contours.h"

// A thin wall, one column wide: simplified on its own it collapses to a line, and the wall would be gone.
static void thin_wall_stays(void **state)
{
    (void)state;
    static const char *const rows[] = { "00000000000", "00000000000", "00       00", "00000000000", "00000000000" };
    tl_nav_compact compact = fixture_from_rows(rows, 5, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    config.max_simplification_error = 1.3f;
    tl_nav_contours contours;
    make_contours(&compact, &config, &contours);
    TEST_CHECK(contours.set.contour_count == 1 && contours.hole_count == 1 && contours.repaired_count == 1);
    TEST_CHECK(contour_area2(&contours.set, 0) == 2 * (55 - 7));
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

// A thin floor too.
static void thin_floor_stays(void **state)
{
    (void)state;
    static const char *const rows[] = { "000000000000" };
    tl_nav_compact compact = fixture_from_rows(rows, 1, 0);
    tl_nav_config config = region_config(TL_NAV_WATERSHED, 0, 0);
    config.max_simplification_error = 1.3f;
    tl_nav_contours contours;
    make_contours(&compact, &config, &contours);
    TEST_CHECK(contours.set.contour_count == 1 && contours.repaired_count == 1);
    TEST_CHECK(contour_area2(&contours.set, 0) == 24);
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

// A pillar on the border between two regions: each on its own may make its half of the outline straight, and both are
// then the same edge, there and back, with nothing between.
static void pillar_between_regions_stays(void **state)
{
    (void)state;
    static const char *const rows[] = { "000000000000", "000000000000", "000000000000", "00000   0000", "00000   0000",
                                        "00000   0000", "000000000000", "000000000000", "000000000000" };
    enum { WIDTH = 12, HEIGHT = 9, BORDER_X = 6 };
    tl_nav_compact compact = fixture_from_rows(rows, HEIGHT, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    config.max_simplification_error = 4.0f;
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    for (uint32_t column = 0; column < WIDTH * HEIGHT; column++) {
        for (uint32_t i = compact.first_span[column]; i < compact.first_span[column + 1]; i++) {
            compact.region[i] = column % WIDTH < BORDER_X ? 1 : 2;
        }
    }
    compact.region_count = 3;
    tl_nav_contours contours;
    TEST_RESULT(tl_nav_bake_contours(&config, &compact, NULL, &contours, NULL), TL_OK);
    TEST_CHECK(contours.set.contour_count == 2 && contours.repaired_count > 0);
    const int64_t area2 = contour_area2(&contours.set, 0) + contour_area2(&contours.set, 1);
    TEST_CHECK(area2 < 2 * WIDTH * HEIGHT && area2 >= 2 * (WIDTH * HEIGHT - 9));
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
}

static uint64_t count_conflicts(const tl_contour_work *work)
{
    uint64_t conflicts = 0;
    uint32_t *room = malloc(work->vertex_count * sizeof *room + 1);
    uint32_t *owner = malloc(work->vertex_count * sizeof *owner + 1);
    for (uint32_t region = 1; region < work->compact->region_count; region++) {
        uint32_t count = 0;
        uint32_t(*edges)[2] = malloc((work->vertex_count + 1) * sizeof *edges);
        for (uint32_t l = 0; l < work->loop_count; l++) {
            if (work->loops[l].region != region || work->loops[l].area2 == 0) {
                continue;
            }
            tl_contour_path path = { room, 0 };
            tl_contours_simplified(work, l, &path);
            conflicts += path.count < 3;
            for (uint32_t k = 0; k < path.count; k++, count++) {
                edges[count][0] = room[k];
                edges[count][1] = room[(k + 1) % path.count];
            }
        }
        for (uint32_t k = 0; k < count; k++) {
            for (uint32_t j = 0; j < k; j++) {
                const tl_contour_vertex *v = work->vertices;
                conflicts += contour_edges_conflict(&v[edges[k][0]], &v[edges[k][1]], &v[edges[j][0]], &v[edges[j][1]]);
            }
        }
        free(edges);
    }
    free(room);
    free(owner);
    return conflicts;
}

static void no_conflict_is_left(void **state)
{
    (void)state;
    test_random random = { 515 };
    uint32_t broken = 0, sound = 0, untouched = 0;
    for (int round = 0; round < 120; round++) {
        tl_nav_compact compact =
            round % 6 == 5 ? fixture_spiral(12 + test_random_below(&random, 20), 2, 3)
                           : fixture_random(&random, 40, 40, 1 + round % 2, test_random_below(&random, 14), 0);
        tl_nav_config config = region_config((tl_nav_partition)(round % 3), 5, test_random_below(&random, 400));
        config.max_simplification_error = test_random_range(&random, 0.5f, 8.0f);
        tl_arena arena;
        tl_contour_work work;
        trace_contours(&compact, &config, &arena, &work);
        TEST_RESULT(tl_contours_simplify(&work), TL_OK);
        uint64_t before = count_conflicts(&work);
        uint8_t *kept = malloc(work.vertex_count + 1u);
        memcpy(kept, work.keep, work.vertex_count);
        TEST_RESULT(tl_contours_repair(&work), TL_OK);
        TEST_CHECK(count_conflicts(&work) == 0);
        TEST_CHECK(before == 0 || work.repaired_count > 0);
        uint32_t changed = 0;
        for (uint32_t k = 0; k < work.vertex_count; k++) {
            TEST_CHECK(work.keep[k] >= kept[k]); // only ever added to
            changed += work.keep[k] != kept[k];
        }
        TEST_CHECK((changed > 0) == (work.repaired_count > 0));
        broken += before > 0;
        sound += before == 0;
        untouched += changed == 0;
        free(kept);
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(broken > 40 && sound > 10 && untouched > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thin_wall_stays),
        cmocka_unit_test(thin_floor_stays),
        cmocka_unit_test(pillar_between_regions_stays),
        cmocka_unit_test(no_conflict_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
