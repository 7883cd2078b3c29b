// SPDX-License-Identifier: MIT
//
// crowd_groups.c, crowd_lead.c and crowd_follow.c: formations hold in the open, become a column in a door and come
// apart behind it; leaders wait, are followed over links, are players, and are succeeded; threads and states that are
// restored give the same bytes.

#include "crowd_world.h"
#include "task_threads.h" // pthread

#include "nav_crowd/crowd.h"

#define DT 0.05f

enum { MOST = 300 };

typedef struct group_run {
    tl_nav_crowd *crowd;
    const tl_navmesh *navmesh;
    tl_nav_agent agents[MOST];
    tl_nav_group group;
    uint32_t count;
} group_run;

static tl_nav_crowd *make_crowd(const tl_tasks *tasks)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = def.max_members = MOST;
    def.max_groups = 4;
    def.host.tasks = tasks;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    return crowd;
}

// Agents in rows of six around a place; the first is the leader.
static group_run begin_run(const tl_navmesh *navmesh, const tl_nav_group_def *def, uint32_t count, float x, float z)
{
    group_run run;
    memset(&run, 0, sizeof run);
    run.crowd = make_crowd(NULL);
    run.navmesh = navmesh;
    run.count = count;
    for (uint32_t i = 0; i < count; i++) {
        run.agents[i] = crowd_send(run.crowd, navmesh, tl_default_nav_agent_def(), x - 0.8f * (float)(i / 6), 0.0f,
                                   z + 0.8f * ((float)(i % 6) - 2.5f), NULL);
    }
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, def, run.agents, count, &run.group, NULL), TL_OK);
    return run;
}

static void send_group(const group_run *run, float x, float z)
{
    const tl_nav_location goal = crowd_place(run->navmesh, x, 0.0f, z);
    TEST_RESULT(tl_nav_crowd_set_goal(run->crowd, run->agents[0], &goal), TL_OK);
}

static tl_nav_crowd_step_report step_once(const group_run *run)
{
    tl_nav_crowd_step_report report;
    TEST_RESULT(tl_nav_crowd_step(run->crowd, run->navmesh, DT, &report), TL_OK);
    return report;
}

static void step_many(const group_run *run, uint32_t steps)
{
    for (uint32_t i = 0; i < steps; i++) {
        step_once(run);
    }
}

static tl_nav_agent_state look(const group_run *run, uint32_t who)
{
    tl_nav_agent_state state;
    TEST_RESULT(tl_nav_crowd_agent(run->crowd, run->agents[who], &state), TL_OK);
    return state;
}

static tl_nav_group_state look_at_group(const group_run *run)
{
    tl_nav_group_state state;
    TEST_RESULT(tl_nav_crowd_group(run->crowd, run->group, &state), TL_OK);
    return state;
}

static tl_nav_group_def formed(tl_nav_formation formation)
{
    tl_nav_group_def def = tl_default_nav_group_def();
    def.formation = formation;
    return def;
}

// The mean distance of all from their slots while they walk from 6 m on, and nobody far off.
static void test_open(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(30.0f, 20.0f);
    static const tl_nav_formation_slot own[8] = { { 1, 1 },  { 1, -1 },  { -1, 1 }, { -1, -1 },
                                                  { -3, 1 }, { -3, -1 }, { -5, 0 }, { 3, 0 } };
    for (uint32_t k = TL_NAV_FORMATION_LOOSE; k <= TL_NAV_FORMATION_SLOTS; k++) {
        tl_nav_group_def def = formed((tl_nav_formation)k);
        def.slots = own;
        group_run run = begin_run(navmesh, &def, 9, -22.0f, -6.0f);
        send_group(&run, 20.0f, 8.0f);
        crowd_measure m;
        double sum = 0.0, most = 0.0;
        uint32_t seen = 0, searched = 0, steps = 0, arrived = 0;
        for (; steps < 1500 && arrived < 9; steps++) {
            const tl_nav_crowd_step_report report = step_once(&run);
            const tl_nav_group_state group = look_at_group(&run);
            searched += report.searched;
            arrived = report.arrived;
            if (fabsf(look(&run, 0).position.x) < 14.0f) {
                sum += (double)group.lag;
                most = fmax(most, (double)group.lag);
                seen++;
                TEST_CHECK(group.count == 9 && group.formation == def.formation && group.leader == run.agents[0]);
                TEST_CHECK(fabsf(tl_length(group.heading) - 1.0f) < 1e-5f);
            }
        }
        print_message("%-6s arrived after %.1f s, lag %.2f m, at most %.2f, %u searches\n",
                      tl_nav_formation_name(def.formation), (double)((float)steps * DT), sum / seen, most, searched);
        TEST_CHECK(arrived == 9 && seen > 200 && sum / seen < 0.35 && searched <= 4);
        TEST_CHECK(look_at_group(&run).in_place == 9);
        // They stand still now, nobody over another.
        TEST_CHECK(crowd_run(run.crowd, navmesh, DT, 1, &m) == 1 && m.overlaps == 0 && m.off_mesh == 0);
        tl_nav_crowd_destroy(run.crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// Where slots are, of a leader that stands and looks along x.
static void test_slots(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(20.0f, 20.0f);
    for (uint32_t k = TL_NAV_FORMATION_LINE; k <= TL_NAV_FORMATION_RING; k++) {
        tl_nav_group_def def = formed((tl_nav_formation)k);
        group_run run;
        memset(&run, 0, sizeof run);
        run.crowd = make_crowd(NULL);
        run.navmesh = navmesh;
        run.count = 7;
        for (uint32_t i = 0; i < 7; i++) { // the others right behind: their middle lies behind the leader
            run.agents[i] = crowd_send(run.crowd, navmesh, tl_default_nav_agent_def(), i == 0 ? 0.0f : -4.0f, 0.0f,
                                       i == 0 ? 0.0f : (float)i - 3.5f, NULL);
        }
        TEST_RESULT(tl_nav_crowd_add_group(run.crowd, &def, run.agents, 7, &run.group, NULL), TL_OK);
        step_many(&run, 400);
        TEST_CHECK(look_at_group(&run).in_place == 7 && look_at_group(&run).heading.x > 0.99f);
        tl_nav_agent order[7];
        uint32_t count = 0;
        TEST_RESULT(tl_nav_crowd_members(run.crowd, run.group, order, 7, &count), TL_OK);
        TEST_CHECK(count == 7 && order[0] == run.agents[0]);
        for (uint32_t rank = 1; rank < 7; rank++) {
            tl_nav_agent_state at;
            TEST_RESULT(tl_nav_crowd_agent(run.crowd, order[rank], &at), TL_OK);
            const float side = rank % 2 == 1 ? -1.0f : 1.0f, row = (float)((rank + 1) / 2);
            const float away = hypotf(at.position.x, at.position.z);
            TEST_CHECK(at.status == TL_NAV_AGENT_ARRIVED);
            if (def.formation == TL_NAV_FORMATION_LINE) { // left of +x is -z
                TEST_CHECK(fabsf(at.position.x) < 0.15f && fabsf(at.position.z - 1.2f * side * row) < 0.15f);
            } else if (def.formation == TL_NAV_FORMATION_COLUMN) {
                TEST_CHECK(fabsf(at.position.x + 1.2f * (float)rank) < 0.15f && fabsf(at.position.z) < 0.15f);
            } else if (def.formation == TL_NAV_FORMATION_WEDGE) {
                TEST_CHECK(fabsf(at.position.x + 0.8485f * row) < 0.15f &&
                           fabsf(at.position.z - 0.8485f * side * row) < 0.15f);
            } else {
                TEST_CHECK(fabsf(away - 1.2f) < 0.15f);
            }
        }
        tl_nav_crowd_destroy(run.crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// Through a door that one fits through, and back: a column there, the formation behind it, and no path but the leader's
// is searched, or hardly one.
static void test_door(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(1.5f);
    for (uint32_t k = TL_NAV_FORMATION_LOOSE; k <= TL_NAV_FORMATION_RING; k++) {
        const tl_nav_group_def def = formed((tl_nav_formation)k);
        group_run run = begin_run(navmesh, &def, 9, -12.0f, -5.0f);
        uint32_t searched = 0, on_trail = 0, taken[2];
        for (uint32_t leg = 0; leg < 2; leg++) {
            send_group(&run, leg == 0 ? 13.0f : -13.0f, leg == 0 ? 5.0f : -3.0f);
            uint32_t steps = 0;
            for (uint32_t arrived = 0; steps < 3000 && arrived < 9; steps++) {
                const tl_nav_crowd_step_report report = step_once(&run);
                const tl_nav_group_state group = look_at_group(&run);
                on_trail = group.on_trail > on_trail ? group.on_trail : on_trail;
                searched += report.searched;
                arrived = report.arrived;
                TEST_CHECK(report.off_mesh == 0 && report.unreachable == 0);
            }
            TEST_CHECK(steps < 3000 && look_at_group(&run).in_place == 9);
            taken[leg] = steps;
        }
        print_message("%-6s through the door and back: %.1f s, %.1f s; %u on the trail, %u searches\n",
                      tl_nav_formation_name(def.formation), (double)((float)taken[0] * DT),
                      (double)((float)taken[1] * DT), on_trail, searched);
        TEST_CHECK(on_trail >= 3 && searched <= 2 + 4);
        tl_nav_crowd_destroy(run.crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// The leader walks as the slowest can, stands while one is far behind, and does not wait for who is lost.
static void test_waiting(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(40.0f, 10.0f);
    tl_nav_group_def def = formed(TL_NAV_FORMATION_LINE);
    def.lost_distance = 12.0f;
    for (uint32_t far = 0; far < 2; far++) {
        group_run run;
        memset(&run, 0, sizeof run);
        run.crowd = make_crowd(NULL);
        run.navmesh = navmesh;
        for (uint32_t i = 0; i < 4; i++) {
            tl_nav_agent_def agent = tl_default_nav_agent_def();
            agent.max_speed = i == 2 ? 0.8f : 1.6f;
            const float x = i < 3 ? -15.0f : far == 0 ? -24.0f : -38.0f;
            run.agents[i] = crowd_send(run.crowd, navmesh, agent, x, 0.0f, 2.0f * (float)i, NULL);
        }
        TEST_RESULT(tl_nav_crowd_add_group(run.crowd, &def, run.agents, 4, &run.group, NULL), TL_OK);
        send_group(&run, 35.0f, 0.0f);
        float fastest = 0.0f;
        uint32_t stood = 0;
        for (uint32_t step = 0; step < (far == 0 ? 500 : 200); step++) { // then it is within reach again
            step_once(&run);
            const tl_nav_agent_state leader = look(&run, 0);
            const tl_nav_group_state group = look_at_group(&run);
            fastest = fmaxf(fastest, tl_length(leader.velocity));
            stood += group.speed == 0.0f;
            if (step > 10) {
                TEST_CHECK(group.speed <= 0.8f * 0.9f + 1e-6f);
            }
        }
        print_message("one %s: the leader stands %u steps, walks %.2f m/s\n", far == 0 ? "9 m behind" : "lost", stood,
                      (double)fastest);
        TEST_CHECK(far == 0 ? stood > 50 : stood <= 1);
        TEST_CHECK(fastest < 0.9f && fastest > 0.6f && look(&run, 0).position.x > -10.0f);
        tl_nav_crowd_destroy(run.crowd);
    }
    tl_navmesh_destroy(navmesh);
}

// A player, who jumps back and forth; the others follow it, and never get onto each other's places.
static void test_player(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(2.0f);
    const tl_nav_group_def def = formed(TL_NAV_FORMATION_WEDGE);
    group_run run;
    memset(&run, 0, sizeof run);
    run.crowd = make_crowd(NULL);
    run.navmesh = navmesh;
    for (uint32_t i = 0; i < 6; i++) {
        tl_nav_agent_def agent = tl_default_nav_agent_def();
        agent.is_fixed = i == 0;
        run.agents[i] = crowd_send(run.crowd, navmesh, agent, -10.0f, 0.0f, 1.5f * (float)i - 4.0f, NULL);
    }
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, &def, run.agents, 6, &run.group, NULL), TL_OK);
    // Along the hall, through the door, to the other corner; then back at once; and a jump into the air.
    static const float ways[][2] = { { -10, 0 }, { 10, 0 }, { 14, 9 }, { 14, -9 } };
    tl_vec3 at = { -10.0f, 0.2f, -4.0f };
    for (uint32_t w = 0; w < 4; w++) {
        float x = ways[w][0] - at.x, z = ways[w][1] - at.z;
        const float length = hypotf(x, z);
        for (float gone = 0.0f; gone < length; gone += 1.2f * DT) {
            const tl_vec3 velocity = { 1.2f * x / length, 0.0f, 1.2f * z / length };
            at = tl_mul_add(at, velocity, DT);
            TEST_RESULT(tl_nav_crowd_set_motion(run.crowd, run.agents[0], at, velocity), TL_OK);
            TEST_CHECK(step_once(&run).off_mesh == 0);
        }
    }
    TEST_RESULT(tl_nav_crowd_set_motion(run.crowd, run.agents[0], at, tl_vec3_make(0, 0, 0)), TL_OK);
    step_many(&run, 400);
    TEST_CHECK(look_at_group(&run).in_place == 6);
    TEST_CHECK(look(&run, 3).position.x > 8.0f);
    at.y = 50.0f;
    TEST_RESULT(tl_nav_crowd_set_motion(run.crowd, run.agents[0], at, tl_vec3_make(0, 0, 0)), TL_OK);
    const tl_vec3 before = look(&run, 3).position;
    step_many(&run, 40);
    TEST_CHECK(tl_distance(before, look(&run, 3).position) < 0.1f);
    const tl_nav_location goal = crowd_place(navmesh, 0, 0, 0);
    TEST_RESULT(tl_nav_crowd_set_goal(run.crowd, run.agents[0], &goal), TL_ERR_ARGUMENT);
    tl_nav_crowd_destroy(run.crowd);
    tl_navmesh_destroy(navmesh);
}

// Over a link, one after the other.
static void test_link(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_ditch_world(13.0f);
    const tl_nav_group_def def = formed(TL_NAV_FORMATION_WEDGE);
    group_run run = begin_run(navmesh, &def, 7, -9.0f, 0.0f);
    send_group(&run, 9.0f, 1.0f);
    uint32_t steps = 0, most = 0;
    for (tl_nav_crowd_step_report report = { 0 }; report.arrived < 7 && steps < 4000; steps++) {
        report = step_once(&run);
        most = report.on_link > most ? report.on_link : most;
    }
    print_message("7 over a link: %.1f s\n", (double)((float)steps * DT));
    TEST_CHECK(steps < 4000 && most == 1 && look_at_group(&run).in_place == 7);
    tl_nav_crowd_destroy(run.crowd);
    tl_navmesh_destroy(navmesh);
}

// Members leave, leaders are succeeded, groups end; names go stale, tables close up.
static void test_coming_and_going(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(20.0f, 20.0f);
    const tl_nav_group_def def = formed(TL_NAV_FORMATION_LINE);
    group_run run = begin_run(navmesh, &def, 5, 0.0f, 0.0f);
    tl_nav_agent more[4], order[5];
    tl_nav_group second, third;
    uint32_t count = 0;
    for (uint32_t i = 0; i < 4; i++) {
        more[i] = crowd_send(run.crowd, navmesh, tl_default_nav_agent_def(), 10.0f, 0.0f, (float)i, NULL);
    }
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, NULL, more, 4, &second, NULL), TL_OK);
    TEST_CHECK(tl_nav_crowd_group_of(run.crowd, more[3]) == second && second != run.group && second != 0);
    const tl_nav_location goal = crowd_place(navmesh, -15, 0, 0);
    TEST_RESULT(tl_nav_crowd_set_goal(run.crowd, more[1], &goal), TL_ERR_ARGUMENT);
    // Twice in a group, or in two.
    tl_report report;
    const tl_nav_agent alone = crowd_send(run.crowd, navmesh, tl_default_nav_agent_def(), 5.0f, 0.0f, 5.0f, NULL);
    const tl_nav_agent twice[2] = { alone, alone }, both[2] = { alone, more[0] }, none[2] = { alone, alone + 77 };
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, NULL, twice, 2, &third, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.field, "agents") == 0 && third == TL_NAV_NO_GROUP);
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, NULL, both, 2, &third, &report), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, NULL, none, 2, &third, &report), TL_ERR_STALE);
    TEST_CHECK(tl_nav_crowd_group_of(run.crowd, alone) == TL_NAV_NO_GROUP);
    step_many(&run, 100);
    // A follower goes: those behind it move up.
    send_group(&run, 10.0f, 15.0f);
    TEST_RESULT(tl_nav_crowd_members(run.crowd, run.group, order, 2, &count), TL_INCOMPLETE);
    TEST_RESULT(tl_nav_crowd_members(run.crowd, run.group, order, 5, &count), TL_OK);
    const tl_nav_agent_state leader = look(&run, 0);
    TEST_RESULT(tl_nav_crowd_remove(run.crowd, order[2]), TL_OK);
    TEST_CHECK(look_at_group(&run).count == 4);
    TEST_RESULT(tl_nav_crowd_members(run.crowd, second, more, 4, &count), TL_OK);
    TEST_CHECK(count == 4);
    step_many(&run, 40);
    // The leader goes: the next one takes over its goal, and all arrive.
    TEST_RESULT(tl_nav_crowd_remove(run.crowd, order[0]), TL_OK);
    TEST_CHECK(look_at_group(&run).leader == order[1] && look_at_group(&run).count == 3);
    step_many(&run, 600);
    tl_nav_agent_state next;
    TEST_RESULT(tl_nav_crowd_agent(run.crowd, order[1], &next), TL_OK);
    TEST_CHECK(next.status == TL_NAV_AGENT_ARRIVED && tl_distance(next.position, leader.goal) < 0.2f);
    TEST_CHECK(look_at_group(&run).in_place == 3);
    // Another formation, with slots for three.
    tl_nav_group_def own = formed(TL_NAV_FORMATION_SLOTS);
    const tl_nav_formation_slot slots[2] = { { 2, 2 }, { 2, -2 } };
    own.slots = slots;
    own.keep_order = true;
    TEST_RESULT(tl_nav_crowd_set_formation(run.crowd, run.group, &own, NULL), TL_OK);
    step_many(&run, 200);
    TEST_CHECK(look_at_group(&run).in_place == 3 && look_at_group(&run).formation == TL_NAV_FORMATION_SLOTS);
    // The first group ends; the second one is where it was, and its place is used again.
    const tl_nav_group old = run.group;
    TEST_RESULT(tl_nav_crowd_remove_group(run.crowd, old), TL_OK);
    TEST_RESULT(tl_nav_crowd_remove_group(run.crowd, old), TL_ERR_STALE);
    TEST_CHECK(tl_nav_crowd_group_of(run.crowd, order[1]) == TL_NAV_NO_GROUP);
    TEST_RESULT(tl_nav_crowd_set_goal(run.crowd, order[3], &goal), TL_OK);
    TEST_RESULT(tl_nav_crowd_members(run.crowd, second, more, 4, &count), TL_OK);
    TEST_RESULT(tl_nav_crowd_add_group(run.crowd, &def, &order[1], 1, &third, NULL), TL_OK);
    TEST_CHECK(third != old && (uint32_t)third == (uint32_t)old);
    for (uint32_t i = 0; i < 4; i++) { // the last one takes the group with it
        TEST_RESULT(tl_nav_crowd_remove(run.crowd, more[i]), TL_OK);
    }
    tl_nav_group_state gone;
    TEST_RESULT(tl_nav_crowd_group(run.crowd, second, &gone), TL_ERR_STALE);
    TEST_CHECK(strcmp(tl_nav_formation_name(TL_NAV_FORMATION_RING), "ring") == 0);
    TEST_CHECK(strcmp(tl_nav_formation_name((tl_nav_formation)6), "unknown") == 0);
    tl_nav_crowd_destroy(run.crowd);
    tl_navmesh_destroy(navmesh);
}

static void test_limits(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_open_floor(10.0f, 10.0f);
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    tl_nav_agent agents[4];
    tl_nav_group group;
    def.max_groups = 2;
    def.max_members = 3;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    for (uint32_t i = 0; i < 4; i++) {
        agents[i] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), 0.0f, 0.0f, (float)i, NULL);
    }
    tl_report report;
    TEST_RESULT(tl_nav_crowd_add_group(crowd, NULL, agents, 4, &group, &report), TL_ERR_LIMIT);
    TEST_CHECK(strcmp(report.field, "max_members") == 0);
    TEST_RESULT(tl_nav_crowd_add_group(crowd, NULL, agents, 1, &group, NULL), TL_OK);
    TEST_RESULT(tl_nav_crowd_add_group(crowd, NULL, agents + 1, 1, &group, NULL), TL_OK);
    TEST_RESULT(tl_nav_crowd_add_group(crowd, NULL, agents + 2, 1, &group, &report), TL_ERR_LIMIT);
    TEST_CHECK(strcmp(report.field, "max_groups") == 0);
    tl_nav_crowd_destroy(crowd);
    // A crowd without groups is as good as any.
    def.max_groups = def.max_members = 0;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    agents[0] = crowd_send(crowd, navmesh, tl_default_nav_agent_def(), 0.0f, 0.0f, 0.0f, NULL);
    TEST_RESULT(tl_nav_crowd_add_group(crowd, NULL, agents, 1, &group, NULL), TL_ERR_LIMIT);
    TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, DT, NULL), TL_OK);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

// Three groups through a door from both sides, one of them more than 64; one, two and eight threads, and states that
// are restored.
static void test_bytes(void **state)
{
    (void)state;
    tl_navmesh *navmesh = crowd_door_world(3.0f);
    static const uint32_t workers[3] = { 1, 2, 8 };
    uint32_t counts[3];
    tl_tasks tasks[3];
    tl_nav_crowd *crowds[3];
    for (uint32_t c = 0; c < 3; c++) {
        counts[c] = workers[c];
        tasks[c] = (tl_tasks){ run_on_threads, counts[c], &counts[c] };
        crowds[c] = make_crowd(c == 0 ? NULL : &tasks[c]);
        for (uint32_t g = 0; g < 3; g++) {
            const uint32_t size = g == 0 ? 80 : 20;
            tl_nav_agent agents[80];
            for (uint32_t i = 0; i < size; i++) {
                const float x = g == 0 ? -15.0f + (float)(i % 10) : g == 1 ? 10.0f : 14.0f;
                agents[i] = crowd_send(crowds[c], navmesh, tl_default_nav_agent_def(), x, 0.0f,
                                       g == 0 ? (float)(i / 10) - 4.0f : 0.9f * (float)i - 9.0f, NULL);
            }
            const tl_nav_group_def def = formed(g == 0   ? TL_NAV_FORMATION_RING
                                                : g == 1 ? TL_NAV_FORMATION_WEDGE
                                                         : TL_NAV_FORMATION_LOOSE);
            tl_nav_group group;
            TEST_RESULT(tl_nav_crowd_add_group(crowds[c], &def, agents, size, &group, NULL), TL_OK);
            const tl_nav_location goal = crowd_place(navmesh, g == 0 ? 12.0f : -12.0f, 0.0f, 3.0f);
            TEST_RESULT(tl_nav_crowd_set_goal(crowds[c], agents[0], &goal), TL_OK);
        }
    }
    const size_t size = tl_nav_crowd_state_size(crowds[0]);
    void *bytes = malloc(size);
    for (uint32_t round = 0; round < 8; round++) {
        TEST_RESULT(tl_nav_crowd_save(crowds[0], bytes, size), TL_OK);
        for (uint32_t c = 0; c < 3; c++) {
            for (uint32_t k = 0; k < 25; k++) {
                TEST_RESULT(tl_nav_crowd_step(crowds[c], navmesh, DT, NULL), TL_OK);
            }
            TEST_CHECK(tl_nav_crowd_hash(crowds[c]) == tl_nav_crowd_hash(crowds[0]));
        }
        TEST_RESULT(tl_nav_crowd_restore(crowds[1], bytes, size, NULL), TL_OK);
        TEST_CHECK(tl_nav_crowd_hash(crowds[1]) != tl_nav_crowd_hash(crowds[0]));
        for (uint32_t k = 0; k < 25; k++) {
            TEST_RESULT(tl_nav_crowd_step(crowds[1], navmesh, DT, NULL), TL_OK);
        }
        TEST_CHECK(tl_nav_crowd_hash(crowds[1]) == tl_nav_crowd_hash(crowds[0]));
    }
    free(bytes);
    for (uint32_t c = 0; c < 3; c++) {
        tl_nav_crowd_destroy(crowds[c]);
    }
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_open),
                                        cmocka_unit_test(test_slots),
                                        cmocka_unit_test(test_door),
                                        cmocka_unit_test(test_waiting),
                                        cmocka_unit_test(test_player),
                                        cmocka_unit_test(test_link),
                                        cmocka_unit_test(test_coming_and_going),
                                        cmocka_unit_test(test_limits),
                                        cmocka_unit_test(test_bytes) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
