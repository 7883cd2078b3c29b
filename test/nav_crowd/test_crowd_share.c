// SPDX-License-Identifier: MIT
//
// crowd_share.c: many agents to one goal take their paths from one search; so do they after an edit; and neither
// threads nor a state that is restored can be told from the bytes.

#include "crowd_world.h"
#include "task_threads.h" // pthread

#include "nav_crowd/crowd.h"

#include <talus/nav_obstacles.h>
#include <talus/nav_state.h>

static const uint32_t agent_count = 600;

typedef struct share_world {
    float half;
    test_level level;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
    tl_nav_location goal;
} share_world;

// A square with pillars in rows, seven square metres an agent.
static void begin_world(share_world *w)
{
    memset(w, 0, sizeof *w);
    w->half = 0.5f * sqrtf(7.0f * (float)agent_count);
    const float h = w->half;
    audit_floor(&w->level, -h, -h, h, h, 0.0f);
    const float apart = 2.0f * h / 4.0f;
    for (uint32_t i = 0; i < 9; i++) {
        const float x = -h + apart * (1.0f + (float)(i % 3)), z = -h + apart * (1.0f + (float)(i / 3));
        audit_block(&w->level, x - 3.0f, -1.0f, z - 1.0f, x + 3.0f, 3.0f, z + 1.0f);
    }
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.2f;
    def.cell_height = 0.1f;
    def.agent_radius = CROWD_BAKE_RADIUS;
    def.agent_height = 1.8f;
    def.agent_max_climb = 0.3f;
    def.tile_size = 48;
    def.bounds.min = tl_vec3_make(-h - 0.5f, -1.5f, -h - 0.5f);
    def.bounds.max = tl_vec3_make(h + 0.5f, 3.5f, h + 0.5f);
    const tl_nav_input input = { .mesh = w->level.mesh };
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &w->obstacles, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &w->navmesh), TL_OK);
    TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, UINT32_MAX, NULL, NULL), TL_OK);
    w->goal = crowd_place(w->navmesh, 0.7f * h, 0.0f, 0.9f * h);
}

static void end_world(share_world *w)
{
    tl_navmesh_destroy(w->navmesh);
    tl_nav_obstacles_destroy(w->obstacles);
}

static bool is_connected(const share_world *w, float x, float z)
{
    uint32_t here = 0, there = 1;
    const tl_nav_location at = crowd_place(w->navmesh, x, 0.0f, z);
    return tl_navmesh_island(w->navmesh, at.polygon, &here) == TL_OK &&
           tl_navmesh_island(w->navmesh, w->goal.polygon, &there) == TL_OK && here == there;
}

static tl_nav_crowd *make_crowd(const share_world *w, const tl_tasks *tasks, uint32_t max_shared)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = agent_count;
    def.max_shared_goals = max_shared;
    def.host.tasks = tasks;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    const uint32_t rows = (uint32_t)ceilf(sqrtf((float)agent_count));
    for (uint32_t i = 0; i < agent_count; i++) {
        const float cell = 2.0f * (w->half - 0.5f) / (float)rows;
        float x = -w->half + 0.5f + cell * ((float)(i % rows) + 0.5f);
        const float z = -w->half + 0.5f + cell * ((float)(i / rows) + 0.5f);
        while (!is_connected(w, x, z)) { // within a pillar
            x += 0.7f;
        }
        crowd_send(crowd, w->navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &w->goal);
    }
    return crowd;
}

typedef struct share_sums {
    uint32_t searched, shared, waiting;
} share_sums;

static share_sums step_crowd(tl_nav_crowd *crowd, const tl_navmesh *navmesh, uint32_t steps)
{
    share_sums sums = { 0, 0, 0 };
    for (uint32_t i = 0; i < steps; i++) {
        tl_nav_crowd_step_report report;
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, &report), TL_OK);
        sums.searched += report.searched;
        sums.shared += report.shared;
        sums.waiting = report.waiting;
    }
    return sums;
}

static void add_obstacle(share_world *w, float x, float z)
{
    tl_nav_obstacle box;
    tl_nav_obstacle_id id;
    memset(&box, 0, sizeof box);
    box.shape = TL_NAV_OBSTACLE_BOX;
    box.base = tl_vec3_make(x, -0.5f, z);
    box.half_x = 0.8f;
    box.half_z = 1.6f;
    box.height = 3.0f;
    TEST_RESULT(tl_nav_obstacles_add(w->obstacles, &box, &id, NULL), TL_OK);
    TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, UINT32_MAX, NULL, NULL), TL_OK);
}

// One search for all, where each would search its own; one again after an edit, also one under the goal.
static void test_searches(void **state)
{
    (void)state;
    share_world w;
    begin_world(&w);
    tl_nav_crowd *crowd = make_crowd(&w, NULL, 4), *alone = make_crowd(&w, NULL, 0);
    share_sums first = step_crowd(crowd, w.navmesh, 1), own = step_crowd(alone, w.navmesh, 1);
    TEST_CHECK(first.searched == 1 && first.shared == agent_count && first.waiting == 0);
    TEST_CHECK(own.searched == 64 && own.shared == 0 && own.waiting == agent_count - 64);
    share_sums more = step_crowd(crowd, w.navmesh, 400), own_more = step_crowd(alone, w.navmesh, 400);
    print_message("%u agents, 401 steps: %u searches and %u paths by them; alone %u searches\n", agent_count,
                  first.searched + more.searched, first.shared + more.shared, own.searched + own_more.searched);
    TEST_CHECK(more.searched < 20); // alone at the end
    TEST_CHECK(own_more.searched + own.searched >= agent_count);
    tl_nav_crowd_destroy(crowd);
    crowd = make_crowd(&w, NULL, 4);
    step_crowd(crowd, w.navmesh, 40);
    add_obstacle(&w, 0.0f, 0.0f);
    share_sums edited = step_crowd(crowd, w.navmesh, 3);
    TEST_CHECK(edited.searched == 1 && edited.shared > 0 && edited.waiting == 0);
    add_obstacle(&w, w.goal.point.x - 0.3f, w.goal.point.z + 2.0f); // the goal's tile has other polygons now
    TEST_RESULT(tl_navmesh_resolve(w.navmesh, w.goal.polygon, NULL, NULL), TL_ERR_STALE);
    edited = step_crowd(crowd, w.navmesh, 3);
    TEST_CHECK(edited.searched == 1 && edited.shared > agent_count / 2 && edited.waiting == 0);
    tl_nav_crowd_destroy(crowd);
    tl_nav_crowd_destroy(alone);
    end_world(&w);
}

// Metres that all have ahead of them.
static double sum_ways(const tl_nav_crowd *crowd, const tl_navmesh *navmesh)
{
    double sum = 0.0;
    uint32_t cursor = 0, count = 0;
    tl_nav_agent agent;
    while (tl_nav_crowd_next(crowd, &cursor, &agent)) {
        tl_nav_corner corners[64];
        TEST_RESULT(tl_nav_crowd_corners(crowd, navmesh, agent, corners, 64, &count), TL_OK);
        for (uint32_t i = 1; i < count; i++) {
            sum += hypot((double)corners[i].point.x - (double)corners[i - 1].point.x,
                         (double)corners[i].point.z - (double)corners[i - 1].point.z);
        }
    }
    return sum;
}

// All arrive, nobody leaves the mesh, and the ways are hardly longer than each agent's own.
static void test_arrivals(void **state)
{
    (void)state;
    share_world w;
    begin_world(&w);
    crowd_measure with, without;
    const float h = w.half;
    w.goal = crowd_place(w.navmesh, 0.25f * h, 0.0f, 0.75f * h);
    tl_nav_crowd *crowd = make_crowd(&w, NULL, 4), *alone = make_crowd(&w, NULL, 0);
    step_crowd(crowd, w.navmesh, 20);
    step_crowd(alone, w.navmesh, 20);
    const double ways = sum_ways(crowd, w.navmesh), own_ways = sum_ways(alone, w.navmesh);
    print_message("ways by the shared search: %.4f times their own\n", ways / own_ways);
    TEST_CHECK(ways < 1.02 * own_ways);
    const uint32_t steps = crowd_run(crowd, w.navmesh, 0.05f, 4000, &with);
    const uint32_t own_steps = crowd_run(alone, w.navmesh, 0.05f, 4000, &without);
    crowd_print("shared", &with, 0.05f);
    crowd_print("alone", &without, 0.05f);
    TEST_CHECK(steps < 4000 && own_steps < 4000 && with.off_mesh == 0 && with.in_walls == 0);
    TEST_CHECK(with.way < 1.1 * without.way);
    tl_nav_crowd_destroy(crowd);
    tl_nav_crowd_destroy(alone);
    end_world(&w);
}

// Trees are kept, made anew after a restore, and made by other workers: always the same bytes.
static void test_bytes(void **state)
{
    (void)state;
    share_world w;
    begin_world(&w);
    static const uint32_t workers[3] = { 1, 2, 8 };
    tl_nav_crowd *crowds[3];
    tl_tasks tasks[3];
    uint32_t counts[3];
    for (uint32_t c = 0; c < 3; c++) {
        counts[c] = workers[c];
        tasks[c] = (tl_tasks){ run_on_threads, counts[c], &counts[c] };
        crowds[c] = make_crowd(&w, &tasks[c], 4);
    }
    const size_t size = tl_nav_crowd_state_size(crowds[0]);
    void *bytes = malloc(size);
    for (uint32_t round = 0; round < 6; round++) {
        for (uint32_t c = 0; c < 3; c++) {
            step_crowd(crowds[c], w.navmesh, 13);
            TEST_CHECK(tl_nav_crowd_hash(crowds[c]) == tl_nav_crowd_hash(crowds[0]));
        }
        // Back to before, with an edit between: the third crowd has no tree, the first the right one, the second
        // others.
        TEST_RESULT(tl_nav_crowd_save(crowds[0], bytes, size), TL_OK);
        if (round % 2 == 1) {
            add_obstacle(&w, -0.5f * w.half + 3.0f * (float)round, 0.1f * w.half);
        }
        step_crowd(crowds[0], w.navmesh, 9);
        step_crowd(crowds[1], w.navmesh, 5);
        TEST_RESULT(tl_nav_crowd_restore(crowds[1], bytes, size, NULL), TL_OK);
        TEST_RESULT(tl_nav_crowd_restore(crowds[2], bytes, size, NULL), TL_OK);
        step_crowd(crowds[1], w.navmesh, 9);
        step_crowd(crowds[2], w.navmesh, 9);
        TEST_CHECK(tl_nav_crowd_hash(crowds[1]) == tl_nav_crowd_hash(crowds[0]));
        TEST_CHECK(tl_nav_crowd_hash(crowds[2]) == tl_nav_crowd_hash(crowds[0]));
    }
    // What is no goal is refused.
    uint8_t *bad = bytes;
    TEST_RESULT(tl_nav_crowd_save(crowds[0], bytes, size), TL_OK);
    memset(bad + offsetof(crowd_head, shared[0].point), 0xff, sizeof(float)); // no number
    TEST_RESULT(tl_nav_crowd_restore(crowds[1], bytes, size, NULL), TL_ERR_CORRUPT);
    free(bytes);
    for (uint32_t c = 0; c < 3; c++) {
        tl_nav_crowd_destroy(crowds[c]);
    }
    end_world(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_searches), cmocka_unit_test(test_arrivals),
                                        cmocka_unit_test(test_bytes) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
