// SPDX-License-Identifier: MIT

#include "polygon/outline/key_table.h"

#include "talus_test.h"

static void keeps_one_value_a_key(void **state)
{
    (void)state;
    enum { KEYS = 5000 };
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_key_table table;
    TEST_CHECK(tl_key_table_init(&table, &arena, KEYS));
    // Keys that differ in high or in low bits only, zero and all ones among them.
    for (int round = 0; round < 2; round++) {
        for (uint32_t i = 0; i < KEYS; i++) {
            uint64_t key = i % 2 == 0 ? (uint64_t)i << 32 : UINT64_MAX - i;
            uint32_t *value = tl_key_table_at(&table, key);
            TEST_CHECK(*value == (round == 0 ? TL_NO_VALUE : i));
            *value = i;
        }
    }
    // Looking up a key that is not there leaves the table as it was.
    for (uint32_t i = 0; i < 20000; i++) {
        TEST_CHECK(*tl_key_table_at(&table, tl_pair_key(7, 1000000 + i)) == TL_NO_VALUE);
    }
    TEST_CHECK(*tl_key_table_at(&table, 0) == 0);
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(keeps_one_value_a_key) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
