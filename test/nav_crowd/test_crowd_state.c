// SPDX-License-Identifier: MIT
//
// crowd_state.c, and that steps are a function of the state: the same bytes for any number of threads, from a saved
// state again, and after hostile bytes were refused.

#include "crowd_world.h"
#include "task_threads.h" // pthread

#include "nav_crowd/crowd.h"

#include <talus/nav_state.h>

enum { COUNT = 240 };

static tl_nav_crowd *make_flows(const tl_navmesh *navmesh, const tl_tasks *tasks)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = COUNT + 10;
    def.paths_per_step = 7;
    def.host.tasks = tasks;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    test_random random = { 3 };
    for (uint32_t i = 0; i < COUNT; i++) {
        float side = i % 2 == 0 ? 1.0f : -1.0f;
        tl_nav_agent_def agent = tl_default_nav_agent_def();
        agent.radius = i % 5 == 0 ? 0.45f : 0.3f;
        agent.max_speed = test_random_range(&random, 0.8f, 2.0f);
        agent.is_fixed = i % 40 == 39;
        float x = side * (3.0f + 1.2f * (float)(i / 2 % 12)), z = -9.0f + 1.5f * (float)(i / 24);
        tl_nav_location goal = crowd_place(navmesh, -x, 0.0f, z);
        crowd_send(crowd, navmesh, agent, x, 0.0f, z, agent.is_fixed ? NULL : &goal);
    }
    // Two groups, one behind a fixed agent.
    tl_nav_agent group[6];
    for (uint32_t g = 0; g < 2; g++) {
        uint32_t cursor = g == 0 ? 39 : 100;
        for (uint32_t k = 0; k < 6; k++) {
            tl_nav_crowd_next(crowd, &cursor, &group[k]);
        }
        tl_nav_group_def group_def = tl_default_nav_group_def();
        group_def.formation = g == 0 ? TL_NAV_FORMATION_WEDGE : TL_NAV_FORMATION_COLUMN;
        tl_nav_group name;
        TEST_RESULT(tl_nav_crowd_add_group(crowd, &group_def, group, 6, &name, NULL), TL_OK);
    }
    return crowd;
}

static void step_many(tl_nav_crowd *crowd, const tl_navmesh *navmesh, uint32_t steps)
{
    for (uint32_t i = 0; i < steps; i++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, NULL), TL_OK);
    }
}

static void test_threads(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(2.0f);
    uint64_t hashes[3];
    static const uint32_t workers[3] = { 1, 2, 8 };
    for (uint32_t run = 0; run < 3; run++) {
        uint32_t count = workers[run];
        const tl_tasks tasks = { run_on_threads, count, &count };
        tl_nav_crowd *crowd = make_flows(navmesh, run == 0 ? NULL : &tasks);
        step_many(crowd, navmesh, 160);
        hashes[run] = tl_nav_crowd_hash(crowd);
        tl_nav_crowd_destroy(crowd);
    }
    TEST_CHECK(hashes[0] == hashes[1] && hashes[0] == hashes[2]);
    tl_navmesh_destroy(navmesh);
}

// A saved state gives the same bytes again: in the same crowd, in another one, and after a step was taken in between.
static void test_rollback(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(2.0f);
    tl_nav_crowd *crowd = make_flows(navmesh, NULL);
    tl_nav_crowd *other = make_flows(navmesh, NULL);
    const size_t size = tl_nav_crowd_state_size(crowd);
    void *bytes = malloc(size), *again = malloc(size);
    for (uint32_t round = 0; round < 5; round++) {
        step_many(crowd, navmesh, 31);
        TEST_RESULT(tl_nav_crowd_save(crowd, bytes, size), TL_OK);
        step_many(crowd, navmesh, 20);
        const uint64_t hash = tl_nav_crowd_hash(crowd);
        TEST_RESULT(tl_nav_crowd_restore(other, bytes, size, NULL), TL_OK);
        TEST_RESULT(tl_nav_crowd_save(other, again, size), TL_OK);
        TEST_CHECK(memcmp(bytes, again, size) == 0);
        step_many(other, navmesh, 20);
        TEST_CHECK(tl_nav_crowd_hash(other) == hash);
        TEST_RESULT(tl_nav_crowd_restore(crowd, bytes, size, NULL), TL_OK);
        TEST_CHECK(tl_nav_crowd_hash(crowd) != hash);
        step_many(crowd, navmesh, 20);
        TEST_CHECK(tl_nav_crowd_hash(crowd) == hash);
    }
    free(bytes);
    free(again);
    tl_nav_crowd_destroy(other);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Words turned round twice are as they were: what machines of the other byte order do.
static void test_byte_order(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(15.0f, 15.0f);
    tl_nav_crowd *crowd = make_flows(navmesh, NULL);
    const size_t size = tl_nav_crowd_state_size(crowd);
    uint8_t *bytes = malloc(size), *turned = malloc(size);
    TEST_RESULT(tl_nav_crowd_save(crowd, bytes, size), TL_OK);
    memcpy(turned, bytes, size);
    tl_crowd_swap_words(turned, size, &crowd->def);
    TEST_CHECK(turned[0] == bytes[3] && memcmp(bytes, turned, size) != 0);
    tl_crowd_swap_words(turned, size, &crowd->def);
    TEST_CHECK(memcmp(bytes, turned, size) == 0);
    free(bytes);
    free(turned);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Bytes that were changed anywhere are refused by name, or give a state that steps are safe in.
static void test_hostile(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(2.0f);
    tl_nav_crowd *crowd = make_flows(navmesh, NULL);
    step_many(crowd, navmesh, 5);
    const size_t size = tl_nav_crowd_state_size(crowd);
    const size_t groups_size = size - (size_t)((uint8_t *)crowd->a.trail_polygon - (uint8_t *)crowd->head);
    uint8_t *bytes = malloc(size), *bad = malloc(size);
    TEST_RESULT(tl_nav_crowd_save(crowd, bytes, size), TL_OK);
    const uint64_t hash = tl_nav_crowd_hash(crowd);
    test_random random = { 12 };
    uint32_t refused = 0, taken = 0;
    for (uint32_t round = 0; round < 1200; round++) {
        memcpy(bad, bytes, size);
        // The head and the first arrays as often as all the rest, and so the groups at the end.
        uint32_t reach = round % 3 == 0 ? 128 : (uint32_t)size;
        for (uint32_t k = 0; k < 1 + round % 4; k++) {
            size_t at = test_random_below(&random, reach / 4) * 4;
            at = round % 5 == 1 ? size - 4 - at * (groups_size - 4) / size / 4 * 4 : at;
            uint32_t word =
                round % 2 == 0 ? UINT32_MAX >> test_random_below(&random, 32) : (uint32_t)test_random_u64(&random);
            memcpy(bad + at, &word, 4);
        }
        tl_report report;
        tl_result result = tl_nav_crowd_restore(crowd, bad, size, &report);
        if (result != TL_OK) {
            refused++;
            TEST_CHECK(tl_nav_crowd_hash(crowd) == hash);
            TEST_CHECK(result == TL_ERR_MAGIC || result == TL_ERR_VERSION || result == TL_ERR_ARGUMENT ||
                       result == TL_ERR_CORRUPT || result == TL_ERR_NOT_FINITE);
        } else {
            taken++;
            step_many(crowd, navmesh, 3);
            TEST_RESULT(tl_nav_crowd_restore(crowd, bytes, size, NULL), TL_OK);
            TEST_CHECK(tl_nav_crowd_hash(crowd) == hash);
        }
    }
    TEST_CHECK(refused > 300 && taken > 300);
    for (size_t length = 0; length < size; length += length < 256 ? 1 : 4096) {
        TEST_RESULT(tl_nav_crowd_restore(crowd, bytes, length, NULL), TL_ERR_TRUNCATED);
    }
    TEST_RESULT(tl_nav_crowd_restore(crowd, bytes + 4, size - 4, NULL), TL_ERR_ARGUMENT);
    free(bytes);
    free(bad);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// At most 512 bytes an agent, all scratch counted, for a large crowd; and a step allocates nothing.
static void test_memory(void **state)
{
    (void)state;
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = 10000;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    // The scratch: twelve words of the snapshot, one for the cell, and the grid's cells. The tables of groups are there
    // too, but what deals slots is not counted.
    const uint64_t bytes =
        crowd->state_bytes + 4u * (uint64_t)crowd->grid.cell_count + (uint64_t)def.max_agents * (12 + 1) * 4;
    print_message("%u bytes an agent, %u of them saved\n", (unsigned)(bytes / def.max_agents),
                  (unsigned)(crowd->state_bytes / def.max_agents));
    TEST_CHECK(bytes <= 512 * (uint64_t)def.max_agents);
    tl_nav_crowd_destroy(crowd);

    tl_navmesh *navmesh = crowd_door_world(2.0f);
    test_allocator counted;
    test_allocator_init(&counted, 0);
    tl_nav_crowd_def small = tl_default_nav_crowd_def();
    small.host.allocator = &counted.allocator;
    small.max_agents = 50;
    TEST_RESULT(tl_nav_crowd_create(&small, &crowd, NULL), TL_OK);
    for (uint32_t i = 0; i < 50; i++) {
        float z = -8.0f + 0.3f * (float)i;
        tl_nav_location goal = crowd_place(navmesh, -10.0f, 0.0f, z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), 10.0f, 0.0f, z, &goal);
    }
    const uint64_t before = counted.calls;
    step_many(crowd, navmesh, 200);
    TEST_CHECK(counted.calls == before && before > 0);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_threads), cmocka_unit_test(test_rollback),
                                        cmocka_unit_test(test_byte_order), cmocka_unit_test(test_hostile),
                                        cmocka_unit_test(test_memory) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
