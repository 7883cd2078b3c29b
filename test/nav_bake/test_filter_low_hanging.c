// SPDX-License-Identifier: MIT
//
// Low-hanging obstacles: examples, and a twin that reads the rule literally.

#include "nav_fields.h"

static void expect(const tl_nav_span *spans, uint32_t count, uint32_t climb, const uint16_t *areas)
{
    tl_nav_config config = test_nav_config(1, 1);
    config.walkable_climb = climb;
    tl_nav_span copy[8];
    memcpy(copy, spans, count * sizeof *spans);
    uint32_t first[2] = { 0, count };
    tl_nav_heightfield field;
    memset(&field, 0, sizeof field);
    field.width = field.height = 1;
    field.first_span = first;
    field.spans = copy;
    field.span_count = count;
    tl_nav_filter_low_hanging_obstacles(&config, &field);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(copy[i].area == areas[i]);
    }
}

static void kerbs_are_stepped_on(void **state)
{
    (void)state;
    const tl_nav_span kerb[] = { { 0, 2, 9, 0 }, { 3, 4, 0, 0 } };
    expect(kerb, 2, 2, (const uint16_t[]){ 9, 9 });
    expect(kerb, 2, 1, (const uint16_t[]){ 9, 0 });
    // A pile of obstacles is not climbed through its first.
    const tl_nav_span pile[] = { { 0, 2, 9, 0 }, { 3, 4, 0, 0 }, { 5, 6, 0, 0 } };
    expect(pile, 3, 2, (const uint16_t[]){ 9, 9, 0 });
    // What lies on nothing walkable stays.
    const tl_nav_span bare[] = { { 0, 2, 0, 0 }, { 3, 4, 0, 0 }, { 5, 6, 4, 0 }, { 7, 8, 0, 0 } };
    expect(bare, 4, 2, (const uint16_t[]){ 0, 0, 4, 4 });
}

static void agrees_with_the_rule(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t raised = 0, kept = 0;
    for (uint32_t round = 0; round < 100; round++) {
        tl_nav_config config = test_nav_config(20, 20);
        config.walkable_climb = test_random_below(&random, 5);
        tl_nav_heightfield field = test_random_heightfield(&random, &config, 5);
        uint32_t bytes = field.span_count * (uint32_t)sizeof(tl_nav_span);
        tl_nav_span *before = malloc(bytes + 1);
        memcpy(before, field.spans, bytes);
        tl_nav_filter_low_hanging_obstacles(&config, &field);
        for (uint32_t c = 0; c < 400; c++) {
            for (uint32_t i = field.first_span[c]; i < field.first_span[c + 1]; i++) {
                uint16_t area = before[i].area;
                bool over_walkable = i > field.first_span[c] && before[i - 1].area != 0;
                if (area == 0 && over_walkable && before[i].max - before[i - 1].max <= (int)config.walkable_climb) {
                    area = before[i - 1].area;
                    raised++;
                }
                kept += over_walkable && area == 0;
                TEST_CHECK(field.spans[i].area == area);
            }
        }
        free(before);
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(raised > 500 && kept > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(kerbs_are_stepped_on),
                                        cmocka_unit_test(agrees_with_the_rule) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
