// SPDX-License-Identifier: MIT
//
// Agents whose goals cannot be reached are told so: wide ones before gaps that are narrower than they are, until an
// edit opens them; and those who must walk farther than a corridor holds to come as near as a path leads.

#include "crowd_world.h"

#include <talus/nav_obstacles.h>

#define DT 0.05f

static tl_nav_agent_state look(const tl_nav_crowd *crowd, tl_nav_agent agent)
{
    tl_nav_agent_state state;
    TEST_RESULT(tl_nav_crowd_agent(crowd, agent, &state), TL_OK);
    return state;
}

static tl_nav_agent_state look_after(tl_nav_crowd *crowd, const tl_navmesh *navmesh, tl_nav_agent agent, uint32_t steps)
{
    crowd_measure m;
    const uint32_t taken = crowd_run(crowd, navmesh, DT, steps, &m);
    TEST_CHECK(m.off_mesh == 0);
    const tl_nav_agent_state state = look(crowd, agent);
    print_message("%s at %.2f %.2f, %.1f s\n", tl_nav_agent_status_name(state.status), (double)state.position.x,
                  (double)state.position.z, (double)((float)taken * DT));
    return state;
}

static tl_nav_agent_def wide_def(void)
{
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.radius = 0.6f;
    return def;
}

// In a gap of 12 m by 1 m, open at both ends, an agent of 0.6 m: it stands before the end that is nearer to its goal,
// wherever it comes from.
static void test_goals_in_a_gap(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -12, 12, 12, 0.0f);
    audit_block(&level, -6.0f, -1, 2.0f, 6.0f, 3, 2.5f);
    audit_block(&level, -6.0f, -1, 3.5f, 6.0f, 3, 4.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    static const float ways[4][3] = { { 0.3f, -0.4f, -2.0f }, { 0.3f, -0.4f, 1.5f }, { -11, 9, 2.5f }, { 11, -9, -3 } };
    for (uint32_t i = 0; i < 4; i++) {
        tl_nav_crowd *crowd = crowd_make(1);
        const float goal_x = ways[i][2];
        const tl_nav_location goal = crowd_place(navmesh, goal_x, 0.0f, 3.0f);
        const tl_nav_agent agent = crowd_send(crowd, navmesh, wide_def(), ways[i][0], 0.0f, ways[i][1], &goal);
        const tl_nav_agent_state end = look_after(crowd, navmesh, agent, 1000);
        TEST_CHECK(end.status == TL_NAV_AGENT_UNREACHABLE && tl_length(end.velocity) == 0.0f);
        TEST_CHECK(fabsf(end.position.z - 3.0f) < 0.3f && fabsf(end.position.x - (goal_x < 0 ? -6 : 6)) < 0.7f);
        tl_nav_crowd_destroy(crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// The goal is beside a wall of a room with two doors, and the short way leads through the one that is too narrow: the
// agent takes the other one, and has arrived as near as that wall lets it come.
static void test_goal_by_a_wall(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -12, 12, 12, 0.0f);
    audit_block(&level, -0.25f, -1, -12.5f, 0.25f, 3, -10.0f); // doors of 2 m at -9, and of 1 m at 0.5
    audit_block(&level, -0.25f, -1, -8.0f, 0.25f, 3, 0.0f);
    audit_block(&level, -0.25f, -1, 1.0f, 0.25f, 3, 12.5f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    tl_nav_crowd *crowd = crowd_make(1);
    const tl_nav_location goal = crowd_place(navmesh, 0.6f, 0.0f, 6.0f);
    const tl_nav_agent agent = crowd_send(crowd, navmesh, wide_def(), -3, 0, 2, &goal);
    const tl_nav_agent_state end = look_after(crowd, navmesh, agent, 1000);
    TEST_CHECK(end.status == TL_NAV_AGENT_ARRIVED);
    TEST_CHECK(hypotf(end.position.x - goal.point.x, end.position.z - goal.point.z) < 0.4f);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

typedef struct door_world {
    tl_nav_obstacles *tiles;
    tl_navmesh *navmesh;
    tl_nav_obstacle_id crate;
} door_world;

// Two halls with a door of 2 m, of which a crate leaves 1 m.
static door_world make_door_world(void)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -10.0f, -6.0f, 10.0f, 6.0f, 0.0f);
    audit_block(&level, -0.25f, -1.0f, -6.5f, 0.25f, 3.0f, -1.0f);
    audit_block(&level, -0.25f, -1.0f, 1.0f, 0.25f, 3.0f, 6.5f);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.1f;
    def.cell_height = 0.1f;
    def.agent_radius = CROWD_BAKE_RADIUS;
    def.agent_max_climb = 0.3f;
    def.tile_size = 50;
    def.bounds = (tl_aabb){ { -10.5f, -2.0f, -6.5f }, { 10.5f, 3.5f, 6.5f } };
    const tl_nav_input input = { .mesh = level.mesh };
    door_world world = { NULL, NULL, 0 };
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &world.tiles, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &world.navmesh), TL_OK);
    TEST_RESULT(tl_nav_obstacles_update(world.tiles, world.navmesh, UINT32_MAX, NULL, NULL), TL_OK);
    return world;
}

static void set_crate(door_world *world, bool is_there)
{
    if (is_there) {
        tl_nav_obstacle crate;
        memset(&crate, 0, sizeof crate);
        crate.shape = TL_NAV_OBSTACLE_BOX;
        crate.area = TL_NAV_NULL_AREA;
        crate.base = tl_vec3_make(0.0f, 0.0f, -0.5f);
        crate.height = 2.0f;
        crate.half_x = 0.25f;
        crate.half_z = 0.5f;
        crate.cosine = 1.0f;
        TEST_RESULT(tl_nav_obstacles_add(world->tiles, &crate, &world->crate, NULL), TL_OK);
    } else {
        TEST_RESULT(tl_nav_obstacles_remove(world->tiles, world->crate), TL_OK);
    }
    TEST_RESULT(tl_nav_obstacles_update(world->tiles, world->navmesh, UINT32_MAX, NULL, NULL), TL_OK);
}

static void free_door_world(door_world *world)
{
    tl_navmesh_destroy(world->navmesh);
    tl_nav_obstacles_destroy(world->tiles);
}

// A crate in the door comes and goes: the agent waits before it, told so, and walks on when there is room.
static void test_gap_opens_and_closes(void **state)
{
    (void)state;
    door_world world = make_door_world();
    tl_nav_crowd *crowd = crowd_make(1);
    const tl_nav_location there = crowd_place(world.navmesh, 8, 0, 0), here = crowd_place(world.navmesh, -8, 0, 0);
    set_crate(&world, true);
    const tl_nav_agent agent = crowd_send(crowd, world.navmesh, wide_def(), -8, 0, 0, &there);
    tl_nav_agent_state now = look_after(crowd, world.navmesh, agent, 400);
    TEST_CHECK(now.status == TL_NAV_AGENT_UNREACHABLE && now.position.x > -1.2f && now.position.x < 0.0f);
    // An edit elsewhere: it asks again when its turn comes, and stands as before.
    set_crate(&world, false);
    set_crate(&world, true);
    now = look_after(crowd, world.navmesh, agent, 200);
    TEST_CHECK(now.status == TL_NAV_AGENT_UNREACHABLE && now.position.x > -1.2f && now.position.x < 0.0f);
    set_crate(&world, false);
    now = look_after(crowd, world.navmesh, agent, 400);
    TEST_CHECK(now.status == TL_NAV_AGENT_ARRIVED);
    // The way back is shut while it walks it, and opens once more.
    TEST_RESULT(tl_nav_crowd_set_goal(crowd, agent, &here), TL_OK);
    now = look_after(crowd, world.navmesh, agent, 40);
    TEST_CHECK(now.status == TL_NAV_AGENT_WALKING);
    set_crate(&world, true);
    now = look_after(crowd, world.navmesh, agent, 400);
    TEST_CHECK(now.status == TL_NAV_AGENT_UNREACHABLE && now.position.x > 0.0f && now.position.x < 1.2f);
    set_crate(&world, false);
    now = look_after(crowd, world.navmesh, agent, 400);
    TEST_CHECK(now.status == TL_NAV_AGENT_ARRIVED);
    tl_nav_crowd_destroy(crowd);
    free_door_world(&world);
}

// The crate comes while the agent stands in the door, which is too narrow for it then: whether it gets out or not, it
// does not walk for ever.
static void test_gap_closes_around(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 5; i++) {
        door_world world = make_door_world();
        tl_nav_crowd *crowd = crowd_make(1);
        const tl_nav_location goal = crowd_place(world.navmesh, 8, 0, 0);
        const tl_nav_agent agent =
            crowd_send(crowd, world.navmesh, wide_def(), -0.4f + 0.2f * (float)i, 0, 0.25f, NULL);
        look_after(crowd, world.navmesh, agent, 5);
        set_crate(&world, true);
        TEST_RESULT(tl_nav_crowd_set_goal(crowd, agent, &goal), TL_OK);
        const tl_nav_agent_state now = look_after(crowd, world.navmesh, agent, 600);
        TEST_CHECK(now.status == TL_NAV_AGENT_ARRIVED || now.status == TL_NAV_AGENT_UNREACHABLE);
        set_crate(&world, false);
        TEST_CHECK(look_after(crowd, world.navmesh, agent, 600).status == TL_NAV_AGENT_ARRIVED);
        tl_nav_crowd_destroy(crowd);
        free_door_world(&world);
    }
}

// A goal beyond a ditch, and corridors of four polygons: the agent comes to the ditch all the same.
static void test_far_and_unreachable(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -20, -2, 20, 2, 0.0f);
    audit_floor(&level, 22, -2, 30, 2, 0.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 30); // tiles of 3 m
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = 1;
    def.max_path = 4;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    const tl_nav_location goal = crowd_place(navmesh, 25, 0, 0);
    const tl_nav_agent agent = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -19, 0, 0, &goal);
    const tl_nav_agent_state end = look_after(crowd, navmesh, agent, 1200);
    TEST_CHECK(end.status == TL_NAV_AGENT_UNREACHABLE && end.position.x > 19.0f);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_goals_in_a_gap),       cmocka_unit_test(test_goal_by_a_wall),
        cmocka_unit_test(test_gap_opens_and_closes), cmocka_unit_test(test_gap_closes_around),
        cmocka_unit_test(test_far_and_unreachable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
