// SPDX-License-Identifier: MIT
//
// Who goes first, who goes back and who makes way: the ways of small crowds where that matters, as hashes. Other tests
// bound how long such scenes may take; these change with the first step that any rule decides otherwise, on any number
// of threads (pthread) and with any instruction set. Where a rule is meant to change, the new numbers are what the test
// prints; look then at test_crowd_step, test_crowd_groups, test_crowd_edits and `make bench-crowd` too.

#include "base/cpu.h"
#include "base/hash.h"
#include "crowd_world.h"
#include "task_threads.h"

#define DT 0.05f

enum { RUNS = 3, MAX_STEPS = 6000, MAX_AGENTS = 200 };

static const uint32_t workers[RUNS] = { 1, 8, 2 };

// Which kernels the next steps may use: plain C, 128 bits, all.
static void choose_kernels(uint32_t which)
{
#if TL_CPU_LEVELS == 3
    static uint32_t found;
    found = found != 0 ? found : tl_cpu_look();
    const uint32_t kept[RUNS] = { 0, TL_CPU_VEC128, UINT32_MAX };
    tl_cpu_found = TL_CPU_LOOKED | (found & kept[which]);
#else
    (void)which;
#endif
}

typedef struct golden_scene {
    const char *name;
    tl_navmesh *(*make_world)(void);
    void (*fill)(tl_nav_crowd *crowd, const tl_navmesh *navmesh);
    uint32_t steps; // until all have arrived
    uint64_t hash;  // of everybody's place and status after each of them
} golden_scene;

// ---------------------------------------------------------------------------------------------------------
// Worlds.

static tl_navmesh *make_door(void)
{
    return crowd_door_world(1.5f);
}

static tl_navmesh *make_narrow_door(void)
{
    return crowd_door_world(0.9f);
}

static tl_navmesh *make_square(void)
{
    return crowd_open_floor(15.0f, 15.0f);
}

static tl_navmesh *make_pillar(void)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -12, 12, 12, 0.0f);
    audit_block(&level, -1.5f, -1, -1.5f, 1.5f, 3, 1.5f);
    return crowd_bake(&level, 60);
}

// A bay with one mouth, hardly large enough for all who want to stand in it.
static tl_navmesh *make_bay(void)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -6, 6, 6, 0.0f);
    audit_block(&level, 0, -1, -6.5f, 6.5f, 3, -1.2f);
    audit_block(&level, 0, -1, 1.2f, 6.5f, 3, 6.5f);
    audit_block(&level, 3, -1, -1.5f, 6.5f, 3, 1.5f);
    return crowd_bake(&level, 0);
}

static tl_navmesh *make_ditch(void)
{
    return crowd_ditch_world(9.0f);
}

// ---------------------------------------------------------------------------------------------------------
// Those who walk in them.

static tl_nav_agent send_across(tl_nav_crowd *crowd, const tl_navmesh *navmesh, float x, float z)
{
    const tl_nav_location goal = crowd_place(navmesh, -x, 0.0f, z);
    return crowd_send(crowd, navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &goal);
}

static void fill_flows(tl_nav_crowd *crowd, const tl_navmesh *navmesh, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const float x = 4.0f + 1.2f * (float)(i / 2 / 10), z = -9.0f + 2.0f * (float)(i / 2 % 10);
        send_across(crowd, navmesh, i % 2 == 0 ? x : -x, z);
    }
}

static void fill_hundreds(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    fill_flows(crowd, navmesh, 200);
}

static void fill_two_flows(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    fill_flows(crowd, navmesh, 40);
}

static void fill_many(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    fill_flows(crowd, navmesh, 30);
}

// Each second one has priority, and one in eight is in a hurry.
static void fill_throng(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    const tl_nav_location goal = crowd_place(navmesh, 3.5f, 0.0f, 0.0f);
    for (uint32_t i = 0; i < 60; i++) {
        tl_nav_agent_def def = tl_default_nav_agent_def();
        def.priority = i % 2 == 0 ? 0.5f : 0.8f;
        def.max_speed = i % 8 == 0 ? 2.2f : 1.4f;
        crowd_send(crowd, navmesh, def, -11.0f + 0.9f * (float)(i % 10), 0.0f, -3.0f + 1.1f * (float)(i / 10), &goal);
    }
}

static void fill_crossing(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    for (uint32_t i = 0; i < 48; i++) {
        const float away = 8.0f + 1.1f * (float)(i / 4 / 4), beside = -1.8f + 1.2f * (float)(i / 4 % 4);
        const float side = i % 2 == 0 ? 1.0f : -1.0f;
        const float x = i % 4 < 2 ? side * away : beside, z = i % 4 < 2 ? beside : side * away;
        const tl_nav_location goal = crowd_place(navmesh, i % 4 < 2 ? -x : x, 0.0f, i % 4 < 2 ? z : -z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &goal);
    }
}

// A wedge and a column meet in the door, and ten who belong to nobody.
static void fill_groups(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    for (uint32_t g = 0; g < 2; g++) {
        const float side = g == 0 ? 1.0f : -1.0f;
        tl_nav_agent agents[7];
        for (uint32_t i = 0; i < 7; i++) {
            agents[i] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), side * (5.0f + (float)(i / 3)), 0.0f,
                                   -1.0f + (float)(i % 3), NULL);
        }
        tl_nav_group_def def = tl_default_nav_group_def();
        def.formation = g == 0 ? TL_NAV_FORMATION_WEDGE : TL_NAV_FORMATION_COLUMN;
        tl_nav_group group;
        const tl_nav_location goal = crowd_place(navmesh, -8.0f * side, 0.0f, 3.0f * side);
        TEST_RESULT(tl_nav_crowd_add_group(crowd, &def, agents, 7, &group, NULL), TL_OK);
        TEST_RESULT(tl_nav_crowd_set_goal(crowd, agents[0], &goal), TL_OK);
    }
    for (uint32_t i = 0; i < 10; i++) {
        send_across(crowd, navmesh, i % 2 == 0 ? 11.0f : -11.0f, -4.0f + (float)i);
    }
}

// Each has a place of its own, half a diameter from the next one's; and two want to get out.
static void fill_bay(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    for (uint32_t i = 0; i < 14; i++) {
        const float x = 2.6f - 0.2f * (float)(i % 6), z = -0.1f + 0.2f * (float)(i / 6);
        const bool leaves = i >= 12;
        const tl_nav_location goal = crowd_place(navmesh, leaves ? -9.0f : x, 0.0f, z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), leaves ? 2.5f : -3.0f - 0.8f * (float)(i % 6), 0.0f,
                   leaves ? 0.8f * (float)i - 10.0f : 2.0f * z, &goal);
    }
}

static void fill_ditch(tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    for (uint32_t i = 0; i < 12; i++) {
        send_across(crowd, navmesh, i % 3 == 0 ? 6.0f : -6.0f, -5.0f + 0.9f * (float)i);
    }
}

// ---------------------------------------------------------------------------------------------------------

static uint64_t hash_step(const tl_nav_crowd *crowd, uint64_t hash)
{
    uint32_t cursor = 0;
    tl_nav_agent agent;
    while (tl_nav_crowd_next(crowd, &cursor, &agent)) {
        tl_nav_agent_state state;
        TEST_RESULT(tl_nav_crowd_agent(crowd, agent, &state), TL_OK);
        const float place[3] = { state.position.x, state.position.y, state.position.z };
        uint32_t words[4];
        memcpy(words, place, sizeof place);
        words[3] = (uint32_t)state.status;
        for (uint32_t k = 0; k < 4; k++) {
            hash = tl_hash_mix(hash ^ words[k]);
        }
    }
    return hash;
}

static void run_scene(const golden_scene *scene, const tl_navmesh *navmesh, uint32_t run)
{
    uint32_t threads = workers[run];
    const tl_tasks tasks = { run_on_threads, threads, &threads };
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = MAX_AGENTS;
    def.host.tasks = &tasks;
    tl_nav_crowd *crowd = NULL;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    scene->fill(crowd, navmesh);
    choose_kernels(run);
    uint64_t hash = 0;
    uint32_t steps = 0;
    tl_nav_crowd_step_report report = { .arrived = 0 };
    for (; steps < MAX_STEPS && report.arrived < tl_nav_crowd_count(crowd); steps++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, DT, &report), TL_OK);
        hash = hash_step(crowd, hash);
    }
    choose_kernels(RUNS - 1);
    if (steps != scene->steps || hash != scene->hash) {
        print_message("%s, %u threads: %u steps, 0x%016llx\n", scene->name, threads, steps, (unsigned long long)hash);
    }
    TEST_CHECK(steps == scene->steps && hash == scene->hash);
    tl_nav_crowd_destroy(crowd);
}

static void test_ways(void **state)
{
    (void)state;
    static const golden_scene scenes[] = {
        { "two flows, a door of 1.5 m", make_door, fill_two_flows, 857, 0xb6e0a2fe3fefa0b2 },
        { "two flows of 100, a door of 1.5 m", make_door, fill_hundreds, 4008, 0xe9380a64d75d4ae4 },
        { "two flows, a door of 0.9 m", make_narrow_door, fill_many, 1067, 0x725cf60deb89230e },
        { "a throng behind a pillar", make_pillar, fill_throng, 345, 0xe5dcc3d23f1cc7c2 },
        { "four flows cross", make_square, fill_crossing, 486, 0x7c9ebea5eea0f7a8 },
        { "groups in a door", make_door, fill_groups, 1154, 0xa9efe4095ac96ca1 },
        { "a bay that fills up", make_bay, fill_bay, 883, 0x3be174b724a3c3e3 },
        { "one link for both sides", make_ditch, fill_ditch, 750, 0x32eb51ee050c6bb0 },
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        tl_navmesh *navmesh = scenes[i].make_world();
        // The long one, which alone has stands of half a minute, once.
        for (uint32_t run = scenes[i].fill == fill_hundreds ? RUNS - 1 : 0; run < RUNS; run++) {
            run_scene(&scenes[i], navmesh, run);
        }
        tl_navmesh_destroy(navmesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_ways) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
