// SPDX-License-Identifier: MIT
//
// Floors without headroom, against the drawing of a column voxel by voxel.

#include "nav_fields.h"

static void agrees_with_voxels(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t removed = 0, exact = 0, kept = 0;
    for (uint32_t round = 0; round < 100; round++) {
        tl_nav_config config = test_nav_config(20, 20);
        config.walkable_height = 1 + test_random_below(&random, 6);
        tl_nav_heightfield field = test_random_heightfield(&random, &config, 5);
        tl_nav_span before[2000];
        memcpy(before, field.spans, field.span_count * sizeof *before);
        tl_nav_filter_walkable_low_height_spans(&config, &field);
        for (uint32_t c = 0; c < 400; c++) {
            bool solid[128] = { false };
            for (uint32_t i = field.first_span[c]; i < field.first_span[c + 1]; i++) {
                memset(solid + before[i].min, true, (size_t)before[i].max - before[i].min);
            }
            for (uint32_t i = field.first_span[c]; i < field.first_span[c + 1]; i++) {
                bool room = true;
                for (uint32_t y = before[i].max; y < before[i].max + config.walkable_height; y++) {
                    room = room && !solid[y];
                }
                TEST_CHECK(field.spans[i].area == (room ? before[i].area : 0));
                removed += !room && before[i].area != 0;
                kept += room;
                exact += room && solid[before[i].max + config.walkable_height];
            }
        }
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(removed > 1000 && kept > 1000 && exact > 300);
}

static void the_sky_is_high_enough_for_anyone(void **state)
{
    (void)state;
    tl_nav_config config = test_nav_config(1, 1);
    config.walkable_height = TL_NAV_MAX_VOXELS;
    tl_nav_span span = { 0, 0xffff, 7, 0 };
    uint32_t first[2] = { 0, 1 };
    tl_nav_heightfield field;
    memset(&field, 0, sizeof field);
    field.width = field.height = 1;
    field.first_span = first;
    field.spans = &span;
    field.span_count = 1;
    tl_nav_filter_walkable_low_height_spans(&config, &field);
    TEST_CHECK(span.area == 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_voxels),
                                        cmocka_unit_test(the_sky_is_high_enough_for_anyone) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
