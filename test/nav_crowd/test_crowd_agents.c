// SPDX-License-Identifier: MIT
//
// Agents one by one: they come and go, take links in turn, stand on floors above one another, keep from walls what they
// are wider, and get over edits of the mesh.

#include "crowd_world.h"

#include <talus/nav_state.h>
#include <talus/nav_wide.h>

#define DT 0.05f

static tl_nav_agent_state look(const tl_nav_crowd *crowd, tl_nav_agent agent)
{
    tl_nav_agent_state state;
    TEST_RESULT(tl_nav_crowd_agent(crowd, agent, &state), TL_OK);
    return state;
}

static void step_many(tl_nav_crowd *crowd, const tl_navmesh *navmesh, uint32_t steps)
{
    for (uint32_t i = 0; i < steps; i++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, DT, NULL), TL_OK);
    }
}

// Names of those who left are stale for ever, and places are used again.
static void test_come_and_go(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    tl_navmesh *navmesh = crowd_open_floor(15.0f, 15.0f);
    tl_nav_crowd *crowd = crowd_make(COUNT);
    tl_nav_agent agents[COUNT], gone[200];
    uint32_t gone_count = 0;
    test_random random = { 8 };
    for (uint32_t i = 0; i < COUNT; i++) {
        agents[i] = TL_NAV_NO_AGENT;
    }
    for (uint32_t round = 0; round < 400; round++) {
        uint32_t i = test_random_below(&random, COUNT);
        if (agents[i] == TL_NAV_NO_AGENT) {
            tl_nav_location goal = crowd_place(navmesh, test_random_range(&random, -13, 13), 0.0f, 9.0f);
            agents[i] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), test_random_range(&random, -13, 13),
                                   0.0f, -9.0f, &goal);
        } else if (gone_count < 200) {
            TEST_RESULT(tl_nav_crowd_remove(crowd, agents[i]), TL_OK);
            gone[gone_count++] = agents[i];
            agents[i] = TL_NAV_NO_AGENT;
        }
        step_many(crowd, navmesh, 1);
    }
    uint32_t cursor = 0, count = 0, there = 0;
    tl_nav_agent agent;
    while (tl_nav_crowd_next(crowd, &cursor, &agent)) {
        count++;
    }
    for (uint32_t i = 0; i < COUNT; i++) {
        there += agents[i] != TL_NAV_NO_AGENT;
    }
    TEST_CHECK(count == there && count == tl_nav_crowd_count(crowd) && gone_count > 100);
    for (uint32_t i = 0; i < gone_count; i++) {
        tl_nav_agent_state out;
        TEST_RESULT(tl_nav_crowd_agent(crowd, gone[i], &out), TL_ERR_STALE);
        TEST_RESULT(tl_nav_crowd_set_goal(crowd, gone[i], NULL), TL_ERR_STALE);
    }
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

static void test_names(void **state)
{
    (void)state;
    TEST_CHECK(strcmp(tl_nav_agent_status_name(TL_NAV_AGENT_IDLE), "idle") == 0);
    TEST_CHECK(strcmp(tl_nav_agent_status_name(TL_NAV_AGENT_FIXED), "fixed") == 0);
    TEST_CHECK(strcmp(tl_nav_agent_status_name((tl_nav_agent_status)77), "unknown") == 0);
}

// Two agents head-on on one line pass one another; each keeps to its right.
static void test_head_on(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(12.0f, 12.0f);
    tl_nav_crowd *crowd = crowd_make(2);
    tl_nav_location west = crowd_place(navmesh, -10, 0, 0), east = crowd_place(navmesh, 10, 0, 0);
    tl_nav_agent a = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -10, 0, 0, &east);
    tl_nav_agent b = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), 10, 0, 0, &west);
    crowd_measure m;
    uint32_t steps = crowd_run(crowd, navmesh, DT, 500, &m);
    TEST_CHECK(steps < 320 && m.overlaps == 0 && m.off_mesh == 0);
    TEST_CHECK(look(crowd, a).status == TL_NAV_AGENT_ARRIVED && look(crowd, b).status == TL_NAV_AGENT_ARRIVED);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Agents on the bridge and agents under it walk as if the others were not there.
static void test_floors(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -10, -10, 10, 10, 0.0f);
    audit_floor(&level, -10, -10, 10, 10, 3.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    uint64_t alone = 0;
    for (uint32_t run = 0; run < 2; run++) {
        tl_nav_crowd *crowd = crowd_make(40);
        tl_nav_agent last = TL_NAV_NO_AGENT;
        for (uint32_t i = 0; i < 20; i++) {
            tl_nav_location goal = crowd_place(navmesh, 9.0f, 0.0f, -9.0f + 0.9f * (float)i);
            last = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -9.0f, 0.0f, 8.1f - 0.9f * (float)i, &goal);
        }
        for (uint32_t i = 0; i < 20 && run == 1; i++) {
            tl_nav_location goal = crowd_place(navmesh, -9.0f, 3.0f, -9.0f + 0.9f * (float)i);
            TEST_CHECK(goal.point.y > 2.5f);
            crowd_send(crowd, navmesh, tl_default_nav_agent_def(), 9.0f, 3.0f, 8.1f - 0.9f * (float)i, &goal);
        }
        step_many(crowd, navmesh, 200);
        tl_nav_agent_state end = look(crowd, last);
        uint64_t hash = 0;
        memcpy(&hash, &end.position, sizeof hash);
        TEST_CHECK(run == 0 || hash == alone);
        alone = hash;
        crowd_measure m;
        TEST_CHECK(crowd_run(crowd, navmesh, DT, 1500, &m) < 1500 && m.off_mesh == 0);
        tl_nav_crowd_destroy(crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// Wide agents keep what they are wider, and go round where they do not fit through.
static void test_wide(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -12, 12, 12, 0.0f);
    audit_block(&level, -0.5f, -1, -13, 0.5f, 3, -2.0f); // a gap of 1 m at -1.5, and one of 3 m at the far end
    audit_block(&level, -0.5f, -1, -1.0f, 0.5f, 3, 9.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    tl_nav_crowd *crowd = crowd_make(30);
    tl_nav_agent_def def = tl_default_nav_agent_def();
    uint32_t through_far_gap = 0;
    tl_nav_agent wide[10];
    for (uint32_t i = 0; i < 20; i++) {
        float z = -10.4f + 1.1f * (float)i; // as near as they stand beside one another
        def.radius = i % 2 == 0 ? 0.75f : 0.3f;
        tl_nav_location goal = crowd_place(navmesh, 9.0f, 0.0f, z);
        tl_nav_agent agent = crowd_send(crowd, navmesh, def, -9.0f, 0.0f, z, &goal);
        if (i % 2 == 0) {
            wide[i / 2] = agent;
        }
    }
    crowd_measure m, sum;
    memset(&sum, 0, sizeof sum);
    float z_at_wall[10] = { 0 };
    uint32_t steps = 0;
    for (; steps < 2400; steps += 1) {
        uint32_t taken = crowd_run(crowd, navmesh, DT, 1, &m);
        TEST_CHECK(taken == 1);
        sum.off_mesh += m.off_mesh;
        sum.in_walls += m.in_walls;
        uint32_t arrived = 0;
        for (uint32_t i = 0; i < 10; i++) {
            tl_nav_agent_state now = look(crowd, wide[i]);
            z_at_wall[i] = fabsf(now.position.x) < 0.2f ? now.position.z : z_at_wall[i];
            arrived += now.status == TL_NAV_AGENT_ARRIVED;
        }
        if (arrived == 10) {
            break;
        }
    }
    for (uint32_t i = 0; i < 10; i++) {
        through_far_gap += z_at_wall[i] > 9.0f;
    }
    print_message("wide: %u steps, %u in walls\n", (unsigned)steps, (unsigned)sum.in_walls);
    TEST_CHECK(steps < 2400 && through_far_gap == 10 && sum.off_mesh == 0 && sum.in_walls == 0);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Wide agents whose goals lie nearer to walls than they can come arrive as near as that: at an edge, in a corner, and
// in a gap that is open at both ends and narrower than they are.
static void test_wide_before_walls(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -12, 12, 12, 0.0f);
    audit_block(&level, -6.0f, -1, 2.0f, 6.0f, 3, 2.5f); // 1 m apart
    audit_block(&level, -6.0f, -1, 3.5f, 6.0f, 3, 4.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.radius = 0.6f;
    static const float goals[4][2] = { { 0, -11.99f }, { 11.99f, -5 }, { 11.99f, -11.99f }, { -5.9f, 2.8f } };
    uint32_t arrived = 0;
    for (uint32_t i = 0; i < 4; i++) {
        tl_nav_crowd *crowd = crowd_make(1);
        tl_nav_location goal = crowd_place(navmesh, goals[i][0], 0.0f, goals[i][1]);
        tl_nav_agent agent = crowd_send(crowd, navmesh, def, 0.3f, 0.0f, -0.4f, &goal);
        crowd_measure m;
        const uint32_t steps = crowd_run(crowd, navmesh, DT, 1200, &m);
        tl_nav_agent_state end = look(crowd, agent);
        print_message("%u: %s after %u steps, %.3f m from the goal\n", (unsigned)i,
                      tl_nav_agent_status_name(end.status), (unsigned)steps,
                      (double)hypotf(end.position.x - goal.point.x, end.position.z - goal.point.z));
        arrived += end.status == TL_NAV_AGENT_ARRIVED;
        tl_nav_crowd_destroy(crowd);
    }
    TEST_CHECK(arrived == 4);
    tl_navmesh_destroy(navmesh);
}

// A ditch with one link over it: everyone crosses, one at a time.
static void test_links(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_ditch_world(9.0f);
    tl_nav_crowd *crowd = crowd_make(20);
    for (uint32_t i = 0; i < 12; i++) {
        float side = i % 3 == 0 ? -1.0f : 1.0f;
        tl_nav_location goal = crowd_place(navmesh, side * 6.0f, 0.0f, -5.0f + 0.9f * (float)i);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -side * 6.0f, 0.0f, -5.0f + 0.9f * (float)i, &goal);
    }
    uint32_t steps = 0, most = 0, crossed = 0;
    for (tl_nav_crowd_step_report report = { 0 }; report.arrived < 12 && steps < 3000; steps++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, DT, &report), TL_OK);
        most = report.on_link > most ? report.on_link : most;
        crossed += report.on_link;
    }
    TEST_CHECK(steps < 3000 && most == 1 && crossed > 12);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

static tl_nav_agent_status status_after(tl_nav_crowd *crowd, const tl_navmesh *navmesh, tl_nav_agent agent,
                                        uint32_t steps)
{
    step_many(crowd, navmesh, steps);
    return look(crowd, agent).status;
}

// Tiles go and come back, doors shut and open: agents wait as near as they get, and go on.
static void test_edits(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -3, 12, 3, 0.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 60); // tiles of 6 m
    tl_nav_crowd *crowd = crowd_make(4);
    tl_nav_location goal = crowd_place(navmesh, 11, 0, 0);
    tl_nav_agent agent = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -11, 0, 0, &goal);
    TEST_CHECK(status_after(crowd, navmesh, agent, 20) == TL_NAV_AGENT_WALKING);

    // The tile in the middle of the way is taken out.
    tl_nav_location middle = crowd_place(navmesh, 3, 0, 0);
    const tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_navmesh_resolve(navmesh, middle.polygon, &tile, NULL), TL_OK);
    const int32_t tile_x = tile->tile_x, tile_z = tile->tile_z;
    const uint64_t size = tile->blob.size;
    tl_nav_tile *copy = test_blob_alloc((size_t)size);
    memcpy(copy, tile, (size_t)size);
    const uint64_t edits = tl_navmesh_edit_count(navmesh);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, tile_x, tile_z), TL_OK);
    TEST_CHECK(tl_navmesh_edit_count(navmesh) > edits);
    TEST_CHECK(status_after(crowd, navmesh, agent, 400) == TL_NAV_AGENT_UNREACHABLE);
    tl_nav_agent_state now = look(crowd, agent);
    TEST_CHECK(now.position.x > -2.0f && now.position.x < 2.0f);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, copy, TL_NAV_TILE_BORROWED), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 400) == TL_NAV_AGENT_ARRIVED);

    // The tile under its feet is: it stands where it was until there is a floor again.
    TEST_RESULT(tl_nav_crowd_set_goal(crowd, agent, &middle), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 300) == TL_NAV_AGENT_ARRIVED);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, tile_x, tile_z), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 5) == TL_NAV_AGENT_OFF_MESH);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, copy, TL_NAV_TILE_BORROWED), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 50) == TL_NAV_AGENT_ARRIVED);

    // A door: flags that the filter refuses.
    goal = crowd_place(navmesh, -11, 0, 0);
    middle = crowd_place(navmesh, -3, 0, 0);
    uint64_t flags = 0;
    TEST_RESULT(tl_navmesh_polygon_flags(navmesh, middle.polygon, &flags), TL_OK);
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, middle.polygon, 2), TL_OK);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.exclude_flags = 2;
    for (int i = 0; i < 3; i++) {
        filter.slack = i == 0 ? NAN : i == 1 ? -0.5f : 1.5f;
        TEST_RESULT(tl_nav_crowd_set_filter(crowd, 0, &filter), TL_ERR_ARGUMENT);
    }
    filter.slack = 0.1f;
    TEST_RESULT(tl_nav_crowd_set_filter(crowd, 0, &filter), TL_OK);
    TEST_RESULT(tl_nav_crowd_set_goal(crowd, agent, &goal), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 400) == TL_NAV_AGENT_UNREACHABLE);
    TEST_CHECK(look(crowd, agent).position.x > -1.0f);
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, middle.polygon, flags), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 400) == TL_NAV_AGENT_ARRIVED);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
    test_blob_free(copy);
}

// The floor of a goal goes: who comes to the nearest place has arrived, and stays arrived half a metre off.
static void test_goal_gone(void **state)
{
    (void)state;
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -3, 12, 3, 0.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 60); // tiles of 6 m
    tl_nav_crowd *crowd = crowd_make(1);
    const tl_nav_location goal = crowd_place(navmesh, 0.5f, 0, 0);
    const tl_nav_agent agent = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -8, 0, 0, &goal);
    const tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_navmesh_resolve(navmesh, goal.polygon, &tile, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, tile->tile_x, tile->tile_z), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agent, 300) == TL_NAV_AGENT_ARRIVED);
    for (uint32_t step = 0; step < 50; step++) {
        TEST_CHECK(status_after(crowd, navmesh, agent, 1) == TL_NAV_AGENT_ARRIVED);
    }
    const tl_nav_agent_state now = look(crowd, agent);
    TEST_CHECK(now.position.x < 0.1f && now.position.x > -0.5f && tl_length(now.velocity) == 0.0f);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Who is shut off from its goal does not ask for a path after each edit that leaves it so, but once in a while; and at
// once when a way is there.
static void test_shut_off(void **state)
{
    (void)state;
    enum { COUNT = 12, STEPS = 256 };
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -12, -6, -1, 6, 0.0f);
    audit_floor(&level, 1, -6, 12, 6, 0.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 30); // tiles of 3 m
    tl_nav_crowd *crowd = crowd_make(COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        const float z = -5.0f + 0.9f * (float)i;
        const tl_nav_location goal = crowd_place(navmesh, 4, 0, z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -6, 0, z, &goal);
    }
    tl_nav_crowd_step_report report;
    for (uint32_t step = 0; step < 300; step++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, &report), TL_OK);
    }
    TEST_CHECK(report.unreachable == COUNT);

    // A tile in the far corner goes and comes back.
    const tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_navmesh_resolve(navmesh, crowd_place(navmesh, -11, 0, -5).polygon, &tile, NULL), TL_OK);
    const int32_t tile_x = tile->tile_x, tile_z = tile->tile_z;
    const uint64_t size = tile->blob.size;
    tl_nav_tile *copy = test_blob_alloc((size_t)size);
    memcpy(copy, tile, (size_t)size);
    uint32_t searched = 0;
    for (uint32_t step = 0; step < STEPS; step++) {
        if (step % 2 == 0) {
            TEST_RESULT(tl_navmesh_remove_tile(navmesh, tile_x, tile_z), TL_OK);
        } else {
            TEST_RESULT(tl_navmesh_add_tile(navmesh, copy, TL_NAV_TILE_BORROWED), TL_OK);
        }
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, &report), TL_OK);
        searched += report.searched;
    }
    TEST_CHECK(searched >= COUNT && searched <= COUNT * (STEPS / 64 + 1));

    tl_nav_offmesh jump = tl_default_nav_offmesh();
    tl_nav_ref link;
    jump.start = tl_vec3_make(-1.4f, 0.0f, 0.0f);
    jump.end = tl_vec3_make(1.4f, 0.0f, 0.0f);
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &jump, &link, NULL), TL_OK);
    TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, &report), TL_OK);
    TEST_CHECK(report.searched + report.waiting == COUNT);
    for (uint32_t step = 0; step < 2000 && report.arrived < COUNT; step++) {
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, 0.05f, &report), TL_OK);
    }
    TEST_CHECK(report.arrived == COUNT);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
    test_blob_free(copy);
}

// Goals so near to one another that not all can be stood on: those who come later stand beside the others, and all
// stay arrived, instead of changing places for ever.
static void test_near_goals(void **state)
{
    (void)state;
    enum { COUNT = 4 };
    tl_navmesh *navmesh = crowd_open_floor(15.0f, 15.0f);
    for (uint32_t round = 1; round < 12; round++) {
        tl_nav_crowd *crowd = crowd_make(COUNT);
        const float apart = 0.05f * (float)round;
        tl_nav_agent agents[COUNT];
        for (uint32_t i = 0; i < COUNT; i++) {
            const float away = 2.0f + 2.0f * (float)i;
            const tl_nav_location goal = crowd_place(navmesh, apart * (float)(i % 2), 0.0f, apart * (float)(i / 2));
            agents[i] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), i % 2 == 0 ? away : -away, 0.0f,
                                   i / 2 == 0 ? away : -away, &goal);
        }
        (void)status_after(crowd, navmesh, agents[0], 600);
        for (uint32_t step = 0; step < 200; step++) {
            (void)status_after(crowd, navmesh, agents[0], 1);
            for (uint32_t i = 0; i < COUNT; i++) {
                TEST_CHECK(look(crowd, agents[i]).status == TL_NAV_AGENT_ARRIVED);
            }
        }
        tl_nav_crowd_destroy(crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// One in the middle of a throng that stands is let out: those around it make way, and those around them for them.
static void test_let_out(void **state)
{
    (void)state;
    enum { COUNT = 150 };
    tl_navmesh *navmesh = crowd_open_floor(15.0f, 15.0f);
    tl_nav_crowd *crowd = crowd_make(COUNT);
    const tl_nav_location middle = crowd_place(navmesh, 0.0f, 0.0f, 0.0f),
                          out = crowd_place(navmesh, 12.0f, 0.0f, 0.0f);
    tl_nav_agent agents[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        agents[i] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -13.0f + 2.0f * (float)(i % 14), 0.0f,
                               -13.0f + 2.0f * (float)(i / 14), &middle);
    }
    (void)status_after(crowd, navmesh, agents[0], 700);
    uint32_t inmost = 0;
    float least = INFINITY;
    for (uint32_t i = 0; i < COUNT; i++) {
        const tl_nav_agent_state now = look(crowd, agents[i]);
        TEST_CHECK(now.status == TL_NAV_AGENT_ARRIVED);
        inmost = hypotf(now.position.x, now.position.z) < least ? i : inmost;
        least = fminf(least, hypotf(now.position.x, now.position.z));
    }
    TEST_RESULT(tl_nav_crowd_set_goal(crowd, agents[inmost], &out), TL_OK);
    TEST_CHECK(status_after(crowd, navmesh, agents[inmost], 1200) == TL_NAV_AGENT_ARRIVED);
    TEST_CHECK(look(crowd, agents[inmost]).position.x > 11.5f);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// A vehicle drives through a crowd that stands: everyone makes way, nobody is run over.
static void test_fixed(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(15.0f, 15.0f);
    tl_nav_crowd *crowd = crowd_make(101);
    for (uint32_t i = 0; i < 100; i++) {
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), -4.5f + (float)(i % 10), 0.0f, -4.5f + (float)(i / 10),
                   NULL);
    }
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.is_fixed = true;
    def.radius = 1.0f;
    tl_nav_agent car = crowd_send(crowd, navmesh, def, -13.0f, 0.0f, 0.2f, NULL);
    float deepest = 0.0f;
    for (uint32_t i = 0; i < 520; i++) {
        tl_vec3 at = { -13.0f + 0.05f * (float)i, 0.0f, 0.2f };
        TEST_RESULT(tl_nav_crowd_set_motion(crowd, car, at, tl_vec3_make(1.0f, 0.0f, 0.0f)), TL_OK);
        step_many(crowd, navmesh, 1);
        uint32_t cursor = 0;
        tl_nav_agent agent;
        while (tl_nav_crowd_next(crowd, &cursor, &agent)) {
            tl_nav_agent_state one = look(crowd, agent);
            float gap = hypotf(one.position.x - at.x - 0.05f, one.position.z - at.z) - one.radius - 1.0f;
            deepest = agent != car && -gap > deepest ? -gap : deepest;
        }
    }
    print_message("run over by %.3f m\n", (double)deepest);
    TEST_CHECK(deepest < 0.1f);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_come_and_go), cmocka_unit_test(test_names),
                                        cmocka_unit_test(test_head_on),     cmocka_unit_test(test_floors),
                                        cmocka_unit_test(test_wide),        cmocka_unit_test(test_wide_before_walls),
                                        cmocka_unit_test(test_links),       cmocka_unit_test(test_edits),
                                        cmocka_unit_test(test_near_goals),  cmocka_unit_test(test_let_out),
                                        cmocka_unit_test(test_shut_off),    cmocka_unit_test(test_fixed),
                                        cmocka_unit_test(test_goal_gone) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
