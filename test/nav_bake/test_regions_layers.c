// SPDX-License-Identifier: MIT
//
// Layers: sheets that never lie over themselves, and are as large as that allows.

#include "nav_region_checks.h"

static void invariants(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t several = 0, bordered = 0;
    for (int round = 0; round < 80; round++) {
        uint32_t border = round % 5 == 1 ? 3 : 0;
        uint32_t width = 10 + test_random_below(&random, 50);
        tl_nav_compact compact =
            fixture_random(&random, width, 40, 1 + round % 5, test_random_below(&random, 20), border);
        tl_nav_config config = region_config(TL_NAV_LAYERS, 20, 60);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        check_regions(&compact, compact.region, compact.region_count);
        TEST_CHECK(check_islands(&compact, 20) == compact.region_stats.filtered_spans);
        several += compact.region_count > 3;
        bordered += border > 0 && compact.region_count > 1;
        fixture_compact_free(&compact);
    }
    TEST_CHECK(several > 40 && bordered > 5);
}

// One storey of one area, in one piece: one layer, holes and all.
static void one_storey_is_one_layer(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "0000000000", "0  00   00", "0  00   00", "0000000000", "00 0000 00", "0000000000",
    };
    tl_nav_compact compact = fixture_from_rows(rows, 6, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 1, 0);
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    TEST_CHECK(compact.region_count == 2);
    fixture_compact_free(&compact);
}

static void areas_stay_apart(void **state)
{
    (void)state;
    static const char *const rows[] = { "aaabbbaaa", "aaabbbaaa", "aaabbbaaa", "aaaaaaaaa" };
    tl_nav_compact compact = fixture_from_rows(rows, 4, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 1, 0);
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    TEST_CHECK(compact.region_count == 3); // a and b
    TEST_CHECK(compact.region[0] == compact.region[8] && compact.region[0] != compact.region[4]);
    fixture_compact_free(&compact);
}

static void spirals(void **state)
{
    (void)state;
    for (uint32_t size = 10; size < 30; size += 4) {
        tl_nav_compact compact = fixture_spiral(size, 2, 4);
        tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        check_regions(&compact, compact.region, compact.region_count);
        TEST_CHECK(check_islands(&compact, 0) == 0);
        TEST_CHECK(compact.region_count >= 5); // four storeys need four layers at least
        fixture_compact_free(&compact);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(invariants),
        cmocka_unit_test(one_storey_is_one_layer),
        cmocka_unit_test(areas_stay_apart),
        cmocka_unit_test(spirals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
