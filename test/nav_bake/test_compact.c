// SPDX-License-Identifier: MIT
//
// The compact heightfield against its definition: floors of walkable spans, and the lowest floor beside each that one
// can step to.

#include "nav_fields.h"

static bool naive_step(const tl_nav_compact *compact, uint32_t i, uint32_t k)
{
    int a = compact->floor[i], b = compact->floor[k];
    int a_top = a + compact->clearance[i], b_top = b + compact->clearance[k];
    int room = (a_top < b_top ? a_top : b_top) - (a > b ? a : b);
    return abs(a - b) <= (int)compact->walkable_climb && room >= (int)compact->walkable_height;
}

// Pairs floors of column c with those of column n, bottom up. Counts floors that could have stepped to another one.
static uint32_t naive_links(const tl_nav_compact *compact, uint32_t c, uint32_t n, uint32_t direction,
                            uint32_t *expected)
{
    uint32_t ambiguous = 0;
    for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
        for (uint32_t k = compact->first_span[n]; k < compact->first_span[n + 1]; k++) {
            if (!naive_step(compact, i, k)) {
                continue;
            }
            if (expected[4 * i + direction] == TL_NAV_NO_SPAN && expected[4 * k + (direction ^ 2)] == TL_NAV_NO_SPAN) {
                expected[4 * i + direction] = k;
                expected[4 * k + (direction ^ 2)] = i;
            } else {
                ambiguous++;
            }
        }
    }
    return ambiguous;
}

static void agrees_with_the_definition(void **state)
{
    (void)state;
    test_random random = { 6 };
    uint32_t linked = 0, unlinked = 0, open = 0, several = 0;
    for (uint32_t round = 0; round < 200; round++) {
        tl_nav_config config = test_nav_config(11, 70);
        config.walkable_climb = test_random_below(&random, 6);
        config.walkable_height = 1 + test_random_below(&random, 4);
        config.border_size = 2;
        tl_nav_heightfield field = test_random_heightfield(&random, &config, 4);
        tl_tasks tasks;
        test_backward_tasks(&tasks, 2);
        test_progress progress;
        test_progress_init(&progress, 0);
        tl_host host = { NULL, round % 2 ? &tasks : NULL, round % 3 ? &progress.progress : NULL };
        tl_nav_compact compact;
        tl_report report;
        TEST_RESULT(tl_nav_bake_compact(&config, &field, &host, &compact, &report), TL_OK);
        TEST_CHECK(compact.border_size == 2 && compact.distance == NULL && compact.region == NULL);
        static uint32_t expected[4 * 4000];
        memset(expected, 0xff, sizeof expected);
        uint32_t at = 0, ambiguous = 0;
        for (uint32_t c = 0; c < 770; c++) {
            ambiguous += c % 11 < 10 ? naive_links(&compact, c, c + 1, 2, expected) : 0;
            ambiguous += c / 11 < 69 ? naive_links(&compact, c, c + 11, 1, expected) : 0;
        }
        TEST_CHECK(ambiguous == 0 || 2 * config.walkable_climb > config.walkable_height);
        several += ambiguous;
        for (uint32_t c = 0; c < 770; c++) {
            TEST_CHECK(compact.first_span[c] == at);
            for (uint32_t i = field.first_span[c]; i < field.first_span[c + 1]; i++) {
                if (field.spans[i].area == 0) {
                    continue;
                }
                bool top = i + 1 == field.first_span[c + 1];
                TEST_CHECK(compact.floor[at] == field.spans[i].max && compact.area[at] == field.spans[i].area);
                TEST_CHECK(compact.clearance[at] == (top ? 0xffff : field.spans[i + 1].min - field.spans[i].max));
                for (uint32_t d = 0; d < 4; d++) {
                    TEST_CHECK(tl_nav_compact_neighbour(&compact, at, d) == expected[4 * at + d]);
                    linked += expected[4 * at + d] != TL_NAV_NO_SPAN;
                    unlinked += expected[4 * at + d] == TL_NAV_NO_SPAN;
                }
                open += top;
                at++;
            }
        }
        TEST_CHECK(at == compact.span_count && compact.first_span[770] == at);
        tl_nav_compact_free(&compact);
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(linked > 10000 && unlinked > 10000 && open > 1000 && several > 100);
}

static void failing_and_cancelling_leave_nothing(void **state)
{
    (void)state;
    test_random random = { 6 };
    tl_nav_config config = test_nav_config(30, 100);
    tl_nav_heightfield field = test_random_heightfield(&random, &config, 4);
    uint32_t failed = 0, cancelled = 0;
    for (uint32_t k = 1; k < 80; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k % 2 ? k / 2 + 1 : 0);
        test_progress progress;
        test_progress_init(&progress, k % 2 ? 0 : k / 2);
        tl_host host = { &memory.allocator, NULL, &progress.progress };
        tl_nav_compact compact;
        tl_result result = tl_nav_bake_compact(&config, &field, &host, &compact, NULL);
        failed += result == TL_ERR_MEMORY;
        cancelled += result == TL_ERR_CANCELLED;
        TEST_CHECK(result == TL_OK || (memory.live_blocks == 0 && compact.floor == NULL));
        tl_nav_compact_free(&compact);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(failed >= 10 && failed < 40 && cancelled >= 2);
    tl_nav_heightfield_free(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_the_definition),
                                        cmocka_unit_test(failing_and_cancelling_leave_nothing) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
