// SPDX-License-Identifier: MIT
//
// The query object: what nav_query.h says of its size, measured.

#include "talus_test.h"

#include <string.h>
#include <talus/nav_query.h>

static uint64_t bytes_of(uint32_t max_nodes)
{
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = max_nodes;
    def.allocator = &memory.allocator;
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    const uint64_t bytes = memory.live_bytes;
    tl_nav_query_destroy(query);
    TEST_CHECK(memory.live_blocks == 0);
    return bytes;
}

static void test_bytes_per_node(void **state)
{
    (void)state;
    const uint64_t small = bytes_of(2);
    TEST_CHECK((bytes_of(65536) - small) / 65534 == 232);
    TEST_CHECK(bytes_of(65536) > 15000000 && bytes_of(65536) < 15400000);
    TEST_CHECK(bytes_of(65537) / 65537 <= 300 && bytes_of(65537) / 65537 > 295);
}

static void test_limits(void **state)
{
    (void)state;
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = 1;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_ERR_ARGUMENT);
    def.max_nodes = (1u << 30) + 1;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_ERR_ARGUMENT);
    TEST_CHECK(query == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes_per_node),
        cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
