// SPDX-License-Identifier: MIT
//
// Names to ids, and back.

#include "talus_test.h"

#include "io/files/growable.h"
#include "io/text/name_table.h"

#include <stdio.h>
#include <string.h>

static void test_ids(void **state)
{
    (void)state;
    tl_allocator allocator = tl_io_allocator_or_default(NULL);
    tl_name_table table = { 0 };
    enum { NAMES = 5000 };
    char name[64];
    uint32_t id;
    for (int round = 0; round < 2; round++) {
        for (uint32_t i = 0; i < NAMES; i++) {
            int size = sprintf(name, "name %u", i * 7919);
            TEST_RESULT(tl_name_table_add(&table, &allocator, name, (size_t)size, NAMES, &id), TL_OK);
            TEST_CHECK(id == i && table.count == (round == 0 ? i + 1 : NAMES));
        }
    }
    for (uint32_t i = 0; i < NAMES; i++) {
        sprintf(name, "name %u", i * 7919);
        assert_string_equal(tl_name_table_get(&table, i), name);
    }
    TEST_RESULT(tl_name_table_add(&table, &allocator, "one more", 8, NAMES, &id), TL_ERR_LIMIT);
    TEST_CHECK(table.count == NAMES);
    tl_name_table_free(&table, &allocator);
    tl_name_table_free(&table, &allocator);
}

static void test_parts_of_names(void **state)
{
    (void)state;
    tl_allocator allocator = tl_io_allocator_or_default(NULL);
    tl_name_table table = { 0 };
    static const char text[] = "abc\0def";
    uint32_t ids[5];
    TEST_RESULT(tl_name_table_add(&table, &allocator, text, 2, 10, &ids[0]), TL_OK);
    TEST_RESULT(tl_name_table_add(&table, &allocator, text, 3, 10, &ids[1]), TL_OK);
    TEST_RESULT(tl_name_table_add(&table, &allocator, text, 7, 10, &ids[2]), TL_OK); // up to the zero
    TEST_RESULT(tl_name_table_add(&table, &allocator, NULL, 0, 10, &ids[3]), TL_OK);
    TEST_RESULT(tl_name_table_add(&table, &allocator, text, 0, 10, &ids[4]), TL_OK);
    TEST_CHECK(ids[0] == 0 && ids[1] == 1 && ids[2] == 1 && ids[3] == 2 && ids[4] == 2 && table.count == 3);
    assert_string_equal(tl_name_table_get(&table, 2), "");
    tl_name_table_free(&table, &allocator);
}

// A long name that meets the slot of the last, short one must not be compared beyond the table's text.
// Found by fuzz_obj; seen under the address sanitizer.
static void test_long_name_meets_short(void **state)
{
    (void)state;
    tl_allocator allocator = tl_io_allocator_or_default(NULL);
    char name[1000];
    memset(name, 'x', sizeof name);
    for (uint32_t i = 0; i < 500; i++) {
        tl_name_table table = { 0 };
        uint32_t first;
        uint32_t second;
        name[0] = (char)('a' + i % 26);
        name[1] = (char)('a' + i / 26);
        TEST_RESULT(tl_name_table_add(&table, &allocator, name, 1, 10, &first), TL_OK);
        TEST_RESULT(tl_name_table_add(&table, &allocator, name, sizeof name, 10, &second), TL_OK);
        TEST_CHECK(first == 0 && second == 1);
        tl_name_table_free(&table, &allocator);
    }
}

static void test_every_allocation(void **state)
{
    (void)state;
    uint64_t calls = 0;
    for (uint64_t fail_at = 0; fail_at <= calls; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_name_table table = { 0 };
        tl_result result = TL_OK;
        uint32_t added = 0;
        for (uint32_t i = 0; i < 300 && result == TL_OK; i++) {
            char name[16];
            uint32_t id;
            int size = sprintf(name, "%u", i);
            result = tl_name_table_add(&table, &allocator.allocator, name, (size_t)size, UINT32_MAX, &id);
            added += result == TL_OK;
        }
        TEST_RESULT(result, fail_at == 0 ? TL_OK : TL_ERR_MEMORY);
        TEST_CHECK(table.count == added);
        calls = fail_at == 0 ? allocator.calls : calls;
        tl_name_table_free(&table, &allocator.allocator);
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
    }
    TEST_CHECK(calls > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ids),
        cmocka_unit_test(test_parts_of_names),
        cmocka_unit_test(test_long_name_meets_short),
        cmocka_unit_test(test_every_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
