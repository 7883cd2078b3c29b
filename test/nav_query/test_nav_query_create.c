// SPDX-License-Identifier: MIT
//
// The query object: what nav_query.h says of its size, measured, and its growth.

#include "nav_fixture.h"

#include <talus/nav_around.h>
#include <talus/nav_prepare.h>
#include <talus/nav_wide.h>

// What a query holds that was made for max_nodes, once it has room for `reserved`.
static uint64_t bytes_of(uint32_t max_nodes, uint32_t reserved)
{
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = max_nodes;
    def.allocator = &memory.allocator;
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    TEST_RESULT(tl_nav_query_reserve(query, reserved), TL_OK);
    TEST_RESULT(tl_nav_query_reserve(query, max_nodes + 1), TL_ERR_LIMIT);
    const uint64_t bytes = memory.live_bytes;
    tl_nav_query_destroy(query);
    TEST_CHECK(memory.live_blocks == 0);
    return bytes;
}

static void test_bytes_per_node(void **state)
{
    (void)state;
    const uint64_t small = bytes_of(2, 0);
    TEST_CHECK((bytes_of(65536, 65536) - small) / 65534 == 236);
    TEST_CHECK(bytes_of(65536, 65536) > 15000000 && bytes_of(65536, 65536) < 15600000);
    TEST_CHECK(bytes_of(65537, 65537) / 65537 <= 304 && bytes_of(65537, 65537) / 65537 > 299);
    TEST_CHECK(bytes_of(65536, 0) < 127000 && bytes_of(65536, 0) == bytes_of(512, 512));
}

// What each kind of search answers, as one number.
typedef struct search_answers {
    double shortest, path, uneven, sliced, flood, walls, random, wide;
} search_answers;

static double sliced_cost(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request)
{
    tl_nav_path_progress progress;
    tl_nav_path path;
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, request), TL_OK);
    do {
        TEST_RESULT(tl_nav_query_step_path(query, 50, &progress), TL_OK);
    } while (progress.status == TL_NAV_PATH_UNFINISHED);
    TEST_CHECK(progress.status == TL_NAV_PATH_COMPLETE);
    TEST_RESULT(tl_nav_query_write_path(query, NULL, 0, &path), TL_INCOMPLETE);
    return (double)path.cost;
}

static search_answers ask_all(tl_nav_query *query, const tl_navmesh *navmesh, tl_nav_location from, tl_nav_location to)
{
    search_answers a;
    memset(&a, 0, sizeof a);
    tl_nav_filter costs = tl_default_nav_filter();
    for (uint32_t i = 0; i < sizeof costs.area_cost / sizeof *costs.area_cost; i++) {
        costs.area_cost[i] = 1.0f + (float)(i % 3);
    }
    const tl_nav_path_request request = { NULL, from, to };
    const tl_nav_path_request uneven = { &costs, from, to };
    const tl_nav_around_request around = { NULL, from, 1000.0f };
    tl_nav_shortest_path shortest;
    tl_nav_path path;
    tl_nav_wide_path wide;
    tl_nav_location at;
    uint32_t count = 0;
    const uint64_t bits[2] = { (uint64_t)1 << 63, (uint64_t)1 << 62 };
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, NULL, &shortest), TL_OK);
    TEST_CHECK(shortest.status == TL_NAV_PATH_COMPLETE);
    a.shortest = shortest.length;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &path), TL_INCOMPLETE);
    a.path = (double)path.cost;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &uneven, NULL, 0, &path), TL_INCOMPLETE);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE);
    a.uneven = (double)path.cost;
    a.sliced = sliced_cost(query, navmesh, &uneven);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &from, NULL, NULL, 0, &count), TL_INCOMPLETE);
    a.flood = count;
    TEST_RESULT(tl_nav_query_find_walls(query, navmesh, &around, NULL, 0, &count), TL_INCOMPLETE);
    a.walls = count;
    TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &around, bits, &at), TL_OK);
    a.random = (double)at.point.x + 1e3 * (double)at.point.z;
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &request, 0.6f, NULL, 0, &wide), TL_INCOMPLETE);
    TEST_CHECK(wide.status == TL_NAV_WIDE_COMPLETE);
    a.wide = wide.length;
    return a;
}

static tl_navmesh *make_comb(tl_nav_location *from, tl_nav_location *to)
{
    test_random random = { 5 };
    fixture_level level = fixture_random(&random, 2, 60);
    level.shake = 0;
    level.area_count = 5;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    const tl_vec3 extents = { 2, 50, 2 };
    const float step = (float)FIXTURE_STEP * level.cell_size;
    const tl_vec3 low = tl_add(level.origin, tl_vec3_make(0.5f * step, 0, 59.5f * step));
    const tl_vec3 high = tl_add(level.origin, tl_vec3_make(58.5f * step, 0, 59.5f * step));
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, low, extents, from), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, high, extents, to), TL_OK);
    return navmesh;
}

// A query that grows answers as one that has all memory at once, by any way through the kinds of search.
static void test_growth(void **state)
{
    (void)state;
    tl_nav_location from, to;
    tl_navmesh *navmesh = make_comb(&from, &to);
    tl_nav_query *whole = fixture_query(65536);
    TEST_RESULT(tl_nav_query_reserve(whole, 65536), TL_OK);
    const search_answers want = ask_all(whole, navmesh, from, to);
    TEST_CHECK(want.flood > 512 && want.walls > 512);
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_nav_query_def def = tl_default_nav_query_def();
    def.allocator = &memory.allocator;
    tl_nav_query *grows = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &grows, NULL), TL_OK);
    const uint64_t first = memory.live_bytes;
    for (int round = 0; round < 2; round++) {
        const search_answers got = ask_all(grows, navmesh, from, to);
        TEST_CHECK(memcmp(&got, &want, sizeof got) == 0);
    }
    TEST_CHECK(memory.live_bytes > 2 * first && memory.live_bytes < 15000000);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
    const tl_nav_path_request request = { NULL, from, to };
    tl_nav_shortest_path path;
    tl_nav_query *fresh = fixture_query(65536);
    TEST_RESULT(tl_nav_query_find_shortest_path(fresh, navmesh, &request, NULL, &path), TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && fabs(path.length - want.shortest) < 1e-3);
    tl_nav_query_destroy(fresh);
    tl_nav_query_destroy(grows);
    TEST_CHECK(memory.live_blocks == 0);
    tl_nav_query_destroy(whole);
    tl_navmesh_destroy(navmesh);
}

// Memory that cannot be had ends a search as nodes do that are used up, and the query serves on.
static void test_growth_without_memory(void **state)
{
    (void)state;
    tl_nav_location from, to;
    tl_navmesh *navmesh = make_comb(&from, &to);
    for (uint64_t more = 1; more < 9; more++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        tl_nav_query_def def = tl_default_nav_query_def();
        def.allocator = &memory.allocator;
        tl_nav_query *query = NULL;
        TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
        const uint64_t blocks = memory.live_blocks, bytes = memory.live_bytes;
        memory.fail_at = memory.calls + more;
        uint32_t count = 0;
        const tl_result result = tl_nav_query_flood(query, navmesh, &from, NULL, NULL, 0, &count);
        TEST_RESULT(result, TL_ERR_NODES);
        TEST_CHECK(count >= 512 && memory.live_blocks == blocks);
        TEST_CHECK(more > 7 || memory.live_bytes == bytes);
        TEST_RESULT(tl_nav_query_reserve(query, 65536), TL_ERR_MEMORY);
        const tl_nav_path_request near_by = { NULL, from, from };
        tl_nav_shortest_path path;
        TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &near_by, NULL, &path), TL_OK);
        TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE);
        tl_nav_query_destroy(query);
        TEST_CHECK(memory.live_blocks == 0);
    }
    tl_navmesh_destroy(navmesh);
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
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_growth_without_memory),
        cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
