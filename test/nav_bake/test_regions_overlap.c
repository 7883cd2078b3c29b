// SPDX-License-Identifier: MIT
//
// Regions that lie over themselves are cut apart; others stay as they are.

#include "nav_region_checks.h"

#include "nav_bake/regions/regions.h"

static void run(const tl_nav_compact *compact, uint32_t *region, uint32_t region_count, tl_region_work *work_out)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_region_work work = { .compact = compact, .arena = &arena, .region = region, .region_count = region_count };
    TEST_RESULT(tl_regions_split_overlaps(&work), TL_OK);
    tl_arena_free(&arena);
    *work_out = work;
}

// A whole spiral as one region: the worst that a watershed could make.
static void whole_spiral(void **state)
{
    (void)state;
    for (int turns = 1; turns < 6; turns++) {
        tl_nav_compact compact = fixture_spiral(16, 3, turns);
        uint32_t *region = calloc(compact.span_count + 1, sizeof *region);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            region[i] = 1;
        }
        tl_region_work work;
        run(&compact, region, 2, &work);
        uint32_t deepest = 0;
        for (uint32_t c = 0; c < 256; c++) {
            uint32_t floors = compact.first_span[c + 1] - compact.first_span[c];
            deepest = floors > deepest ? floors : deepest;
        }
        TEST_CHECK(work.stats.split == (deepest > 1 ? 1u : 0u));
        TEST_CHECK(deepest == 1 || work.region_count >= 2 + deepest);
        check_regions(&compact, region, work.region_count);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            TEST_CHECK(region[i] != 0);
        }
        free(region);
        fixture_compact_free(&compact);
    }
}

static void sound_regions_are_untouched(void **state)
{
    (void)state;
    test_random random = { 17 };
    tl_nav_compact compact = fixture_random(&random, 40, 40, 3, 5, 2);
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 50);
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    uint32_t *region = calloc(compact.span_count + 1, sizeof *region);
    memcpy(region, compact.region, compact.span_count * sizeof *region);
    tl_region_work work;
    run(&compact, region, compact.region_count, &work);
    TEST_CHECK(work.stats.split == 0 && work.region_count == compact.region_count);
    assert_memory_equal(region, compact.region, compact.span_count * sizeof *region);
    free(region);
    fixture_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_spiral),
        cmocka_unit_test(sound_regions_are_untouched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
