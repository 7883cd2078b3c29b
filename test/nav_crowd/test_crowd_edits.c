// SPDX-License-Identifier: MIT
//
// A crowd in a world that changes under it: doors shut and open, obstacles come, move and go, whole tiles disappear,
// and groups form, walk in other formations and part. Nobody leaves the mesh, is lost or stays for ever; and three
// crowds, on one, two and eight threads (pthread) and as many instruction sets as there are, stay the same to the bit.
//
//   test_crowd_edits [STEPS (1200) [AGENTS (150) [EVERY (4) [SEED (21, then 29 and 31)]]]]
//
// Seeds 29 and 31 ended once with a doorway that those who had arrived in it, or stood in their slots, never left; one
// window of 32 is compared there.
//
// In long runs the second and the third crowd take one of EVERY windows of sixteen steps alone: there they begin with
// the saved state of the first one, and end with its hash.
//
// A member of a group that wants to stand is not held up: its leader waits for others, or it for its leader. Nor is
// one whose goal is on another island, or has no floor now: it is shut off.

#include "base/cpu.h"
#include "crowd_world.h"
#include "task_threads.h"

#include <talus/nav_around.h>
#include <talus/nav_obstacles.h>

#define DT    0.05f
#define SLOW  0.3f  // metres a second: a quarter of what the slowest agents can
#define LONG  45.0f // seconds: nobody is held up for so long
#define TURN  90.0f // the same at a large crowd's end, when all set out at once: turns at a door are waited for
#define SHORT 15.0f // seconds: longer stands are counted

enum {
    CROWDS = 3,
    MAX_OBSTACLES = 24,
    DOORS = 4,
    EDIT_EVERY = 12,   // steps
    GOALS_EVERY = 20,  // steps
    GROUPS_EVERY = 36, // steps
    MAX_GROUPS = 24,
    GROUP_SIZE = 6,
    SETTLE_STEPS = 8000, // at the end, when nothing changes any more
    LARGE_CROWD = 1000,  // agents
    WINDOW = 16,         // steps
    SECOND = 20          // steps
};

static uint32_t step_count = 1200, agent_count = 150, window_every = 4;
static uint64_t seed = 21;

typedef struct edit_world {
    float half; // metres, of the square
    float door; // metres, half of a doorway: wider in a larger square, for more agents
    test_level level;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
    tl_nav_crowd *crowds[CROWDS];
    tl_nav_agent *agents[CROWDS];
    tl_nav_obstacle_id ids[MAX_OBSTACLES], doors[DOORS]; // 0: the door is open
    uint32_t obstacle_count;
    tl_nav_group groups[MAX_GROUPS]; // of fixed lists of agents; TL_NAV_NO_GROUP: they walk alone
    uint32_t group_count;
    uint32_t crowd_count; // that step now: all, or the first alone
    void *saved;
    test_random random;
    tl_vec3 *anchor;     // where each agent was when it last came forward by a metre
    uint32_t *anchor_at; // the step
    uint32_t longest;    // steps that one walked without coming forward
    uint32_t stands;     // that were longer than SHORT
    uint32_t shut_off;   // seconds that agents stood shut off, in all
    uint64_t off_mesh, lost, edits, goals, tiles_gone, formed, parted;
} edit_world;

static const uint32_t workers[CROWDS] = { 1, 2, 8 };

// Which kernels the next step may use: plain C, 128 bits, all.
static void choose_kernels(uint32_t which)
{
#if TL_CPU_LEVELS == 3
    static uint32_t found;
    found = found != 0 ? found : tl_cpu_look();
    const uint32_t kept[CROWDS] = { 0, TL_CPU_VEC128, UINT32_MAX };
    tl_cpu_found = TL_CPU_LOOKED | (found & kept[which]);
#else
    (void)which;
#endif
}

// Four rooms; a wall along each axis with a door on either side of the middle.
static void make_level(edit_world *w)
{
    const float h = w->half, q = 0.5f * h, door = w->door;
    memset(&w->level, 0, sizeof w->level);
    audit_floor(&w->level, -h, -h, h, h, 0.0f);
    const float ends[4] = { -h - 0.5f, -q - door, -q + door, q - door };
    audit_block(&w->level, -0.25f, -1.0f, ends[0], 0.25f, 3.0f, ends[1]);
    audit_block(&w->level, -0.25f, -1.0f, ends[2], 0.25f, 3.0f, ends[3]);
    audit_block(&w->level, -0.25f, -1.0f, q + door, 0.25f, 3.0f, h + 0.5f);
    audit_block(&w->level, ends[0], -1.0f, -0.25f, ends[1], 3.0f, 0.25f);
    audit_block(&w->level, ends[2], -1.0f, -0.25f, ends[3], 3.0f, 0.25f);
    audit_block(&w->level, q + door, -1.0f, -0.25f, h + 0.5f, 3.0f, 0.25f);
}

static void make_world(edit_world *w)
{
    memset(w, 0, sizeof *w);
    w->random.state = seed;
    w->half = 0.5f * sqrtf(7.0f * (float)agent_count);
    w->door = fmaxf(1.0f, w->half / 16.0f);
    make_level(w);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.15f;
    def.cell_height = 0.1f;
    def.agent_radius = CROWD_BAKE_RADIUS;
    def.agent_height = 1.8f;
    def.agent_max_climb = 0.3f;
    def.tile_size = 48;
    def.bounds.min = tl_vec3_make(-w->half - 0.5f, -1.5f, -w->half - 0.5f);
    def.bounds.max = tl_vec3_make(w->half + 0.5f, 3.5f, w->half + 0.5f);
    const tl_nav_input input = { .mesh = w->level.mesh };
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &w->obstacles, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &w->navmesh), TL_OK);
    TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, UINT32_MAX, NULL, NULL), TL_OK);
    w->anchor = calloc(agent_count, sizeof *w->anchor);
    w->anchor_at = calloc(agent_count, sizeof *w->anchor_at);
}

static tl_nav_location random_place(edit_world *w)
{
    const uint64_t numbers[2] = { test_random_u64(&w->random), test_random_u64(&w->random) };
    tl_nav_location at;
    TEST_RESULT(tl_navmesh_random_point(w->navmesh, NULL, numbers, &at), TL_OK);
    return at;
}

static void make_crowds(edit_world *w, const tl_tasks tasks[CROWDS])
{
    for (uint32_t c = 0; c < CROWDS; c++) {
        tl_nav_crowd_def def = tl_default_nav_crowd_def();
        def.max_agents = agent_count;
        def.host.tasks = &tasks[c];
        TEST_RESULT(tl_nav_crowd_create(&def, &w->crowds[c], NULL), TL_OK);
        w->agents[c] = calloc(agent_count, sizeof **w->agents);
    }
    const uint32_t rows = (uint32_t)ceilf(sqrtf((float)agent_count));
    for (uint32_t i = 0; i < agent_count; i++) {
        tl_nav_agent_def def = tl_default_nav_agent_def();
        const float cell = 2.0f * (w->half - 0.5f) / (float)rows;
        def.position.x = -w->half + 0.5f + cell * ((float)(i % rows) + 0.5f);
        def.position.z = -w->half + 0.5f + cell * ((float)(i / rows) + 0.5f);
        def.radius = i % 16 == 0 ? 0.4f : 0.3f;
        def.max_speed = test_random_range(&w->random, 1.0f, 2.0f);
        for (uint32_t c = 0; c < CROWDS; c++) {
            TEST_RESULT(tl_nav_crowd_add(w->crowds[c], w->navmesh, &def, &w->agents[c][i], NULL), TL_OK);
        }
    }
}

// The first agent of group g, which leads it: the others stand behind one another in the list.
static uint32_t first_of_group(const edit_world *w, uint32_t g)
{
    return g * (agent_count / w->group_count);
}

// Its group, or TL_NAV_NO_GROUP, and how many members stand before it in the list.
static tl_nav_group group_of(const edit_world *w, uint32_t i, uint32_t *rank_out)
{
    const uint32_t apart = w->group_count > 0 ? agent_count / w->group_count : agent_count;
    *rank_out = i % apart;
    return i / apart < w->group_count && *rank_out < GROUP_SIZE ? w->groups[i / apart] : TL_NAV_NO_GROUP;
}

static bool follows(const edit_world *w, uint32_t i)
{
    uint32_t rank = 0;
    return group_of(w, i, &rank) != TL_NAV_NO_GROUP && rank > 0;
}

static bool waits_for_group(const edit_world *w, uint32_t i, const tl_nav_agent_state *state)
{
    uint32_t rank = 0;
    return group_of(w, i, &rank) != TL_NAV_NO_GROUP && hypotf(state->wanted.x, state->wanted.z) < SLOW;
}

// Forms a group, lets it part, or changes how it walks: in all crowds that step now.
static void change_group(edit_world *w, uint32_t g)
{
    const uint32_t first = first_of_group(w, g);
    tl_nav_group_def def = tl_default_nav_group_def();
    def.formation = (tl_nav_formation)test_random_below(&w->random, TL_NAV_FORMATION_SLOTS);
    const bool forms = w->groups[g] == TL_NAV_NO_GROUP;
    const bool parts = !forms && test_random_below(&w->random, 3) == 0;
    tl_nav_group formed = w->groups[g];
    for (uint32_t c = 0; c < w->crowd_count; c++) {
        if (forms) {
            TEST_RESULT(tl_nav_crowd_add_group(w->crowds[c], &def, &w->agents[c][first], GROUP_SIZE, &formed, NULL),
                        TL_OK);
            TEST_CHECK(c == 0 || formed == w->groups[g]);
            w->groups[g] = formed;
        } else if (parts) {
            TEST_RESULT(tl_nav_crowd_remove_group(w->crowds[c], formed), TL_OK);
        } else {
            TEST_RESULT(tl_nav_crowd_set_formation(w->crowds[c], formed, &def, NULL), TL_OK);
        }
    }
    w->groups[g] = parts ? TL_NAV_NO_GROUP : w->groups[g];
    w->formed += forms;
    w->parted += parts;
}

static tl_nav_obstacle box_at(float x, float z, float half_x, float half_z)
{
    tl_nav_obstacle box;
    memset(&box, 0, sizeof box);
    box.shape = TL_NAV_OBSTACLE_BOX;
    box.base = tl_vec3_make(x, -0.5f, z);
    box.half_x = half_x;
    box.half_z = half_z;
    box.height = 3.0f;
    return box;
}

static void toggle_door(edit_world *w, uint32_t door)
{
    if (w->doors[door] != 0) {
        TEST_RESULT(tl_nav_obstacles_remove(w->obstacles, w->doors[door]), TL_OK);
        w->doors[door] = 0;
        return;
    }
    const float at = (door & 1u) != 0 ? 0.5f * w->half : -0.5f * w->half;
    const tl_nav_obstacle leaf = door < 2 ? box_at(0.0f, at, 0.1f, w->door) : box_at(at, 0.0f, w->door, 0.1f);
    TEST_RESULT(tl_nav_obstacles_add(w->obstacles, &leaf, &w->doors[door], NULL), TL_OK);
}

// One in sixteen is as large as a tile.
static tl_nav_obstacle random_obstacle(edit_world *w)
{
    const bool is_large = test_random_below(&w->random, 16) == 0;
    const float x = test_random_range(&w->random, -w->half, w->half);
    const float z = test_random_range(&w->random, -w->half, w->half);
    const float size = is_large ? 3.6f : test_random_range(&w->random, 0.2f, 1.5f);
    w->tiles_gone += is_large;
    tl_nav_obstacle box = box_at(x, z, size, is_large ? size : test_random_range(&w->random, 0.2f, 1.5f));
    if (test_random_below(&w->random, 3) == 0) {
        box.shape = TL_NAV_OBSTACLE_CYLINDER;
        box.radius = size;
    }
    return box;
}

static void edit(edit_world *w)
{
    const uint32_t kind = test_random_below(&w->random, 4);
    w->edits++;
    if (kind == 0) {
        toggle_door(w, test_random_below(&w->random, DOORS));
    } else if (kind == 1 && w->obstacle_count < MAX_OBSTACLES) {
        const tl_nav_obstacle box = random_obstacle(w);
        TEST_RESULT(tl_nav_obstacles_add(w->obstacles, &box, &w->ids[w->obstacle_count++], NULL), TL_OK);
    } else if (w->obstacle_count > 0) {
        const uint32_t which = test_random_below(&w->random, w->obstacle_count);
        if (kind == 2) {
            const tl_nav_obstacle box = random_obstacle(w);
            TEST_RESULT(tl_nav_obstacles_move(w->obstacles, w->ids[which], &box, NULL), TL_OK);
        } else {
            TEST_RESULT(tl_nav_obstacles_remove(w->obstacles, w->ids[which]), TL_OK);
            w->ids[which] = w->ids[--w->obstacle_count];
        }
    }
}

// Whoever has nowhere to go, and follows nobody, gets a new goal, the same in each crowd.
static void give_goals(edit_world *w, bool to_all)
{
    for (uint32_t i = 0; i < agent_count; i++) {
        tl_nav_agent_state state;
        TEST_RESULT(tl_nav_crowd_agent(w->crowds[0], w->agents[0][i], &state), TL_OK);
        const bool walks = state.status == TL_NAV_AGENT_WALKING || state.status == TL_NAV_AGENT_WAITING ||
                           state.status == TL_NAV_AGENT_OFF_MESH;
        if (follows(w, i) || (walks && !to_all)) {
            continue;
        }
        const tl_nav_location goal = random_place(w);
        w->goals++;
        for (uint32_t c = 0; c < w->crowd_count; c++) {
            TEST_RESULT(tl_nav_crowd_set_goal(w->crowds[c], w->agents[c][i], &goal), TL_OK);
        }
    }
}

static bool is_shut_off(const edit_world *w, const tl_nav_agent_state *state)
{
    tl_nav_location goal;
    const tl_vec3 extents = { 2.0f * state->radius, state->height, 2.0f * state->radius };
    uint32_t from = 0, to = 0;
    return tl_navmesh_find_nearest(w->navmesh, NULL, state->goal, extents, &goal) != TL_OK ||
           tl_navmesh_island(w->navmesh, state->polygon, &from) != TL_OK ||
           tl_navmesh_island(w->navmesh, goal.polygon, &to) != TL_OK || from != to;
}

// How long the agent has not come forward; whether it is shut off is looked at once a second.
static void check_progress(edit_world *w, uint32_t i, uint32_t step, const tl_nav_agent_state *state)
{
    const float dx = state->position.x - w->anchor[i].x, dz = state->position.z - w->anchor[i].z;
    const uint32_t stood = step - w->anchor_at[i];
    const bool is_forward =
        state->status != TL_NAV_AGENT_WALKING || dx * dx + dz * dz > 1.0f || waits_for_group(w, i, state);
    const bool is_off = !is_forward && stood > 0 && stood % SECOND == 0 && is_shut_off(w, state);
    if (is_forward || is_off) {
        w->anchor[i] = state->position;
        w->anchor_at[i] = step;
    }
    w->shut_off += is_off;
    w->stands += is_forward && (float)stood * DT > SHORT;
    w->longest = step - w->anchor_at[i] > w->longest ? step - w->anchor_at[i] : w->longest;
}

static void check_agent(edit_world *w, uint32_t i, uint32_t step)
{
    tl_nav_agent_state state;
    TEST_RESULT(tl_nav_crowd_agent(w->crowds[0], w->agents[0][i], &state), TL_OK);
    if (state.status == TL_NAV_AGENT_OFF_MESH) {
        tl_nav_location at; // only where there is no floor about it
        const tl_vec3 extents = { 2.0f * state.radius, state.height, 2.0f * state.radius };
        w->lost += tl_navmesh_find_nearest(w->navmesh, NULL, state.position, extents, &at) == TL_OK;
    } else {
        tl_vec3 on;
        bool inside = false;
        w->off_mesh += tl_navmesh_closest_point(w->navmesh, state.polygon, state.position, &on, &inside) != TL_OK ||
                       hypotf(on.x - state.position.x, on.z - state.position.z) > 1e-5f ||
                       fabsf(on.y - state.position.y) > 1e-3f;
    }
    check_progress(w, i, step, &state);
}

static bool is_last_of_window(uint32_t step)
{
    return step % WINDOW == WINDOW - 1;
}

// Before a window: which crowds take it. Those that missed the one before begin where the first one is.
static void begin_window(edit_world *w, uint32_t step)
{
    const uint32_t before = w->crowd_count;
    w->crowd_count = step / WINDOW % window_every == 0 ? CROWDS : 1;
    if (before == 1 && w->crowd_count > 1) {
        const size_t size = tl_nav_crowd_state_size(w->crowds[0]);
        TEST_RESULT(tl_nav_crowd_save(w->crowds[0], w->saved, size), TL_OK);
        for (uint32_t c = 1; c < CROWDS; c++) {
            TEST_RESULT(tl_nav_crowd_restore(w->crowds[c], w->saved, size, NULL), TL_OK);
        }
    }
}

// A step of each crowd; their hashes now and then.
static void step_all(edit_world *w, uint32_t step, tl_nav_crowd_step_report *report)
{
    if (step % WINDOW == 0) {
        begin_window(w, step);
    }
    for (uint32_t c = 0; c < w->crowd_count; c++) {
        choose_kernels(c);
        TEST_RESULT(tl_nav_crowd_step(w->crowds[c], w->navmesh, DT, report), TL_OK);
    }
    for (uint32_t c = 1; is_last_of_window(step) && c < w->crowd_count; c++) {
        TEST_CHECK(tl_nav_crowd_hash(w->crowds[c]) == tl_nav_crowd_hash(w->crowds[0]));
    }
    for (uint32_t i = 0; i < agent_count; i++) {
        check_agent(w, i, step);
    }
}

// All doors open and no obstacle: everybody comes to a last goal.
static uint32_t settle(edit_world *w, uint32_t step)
{
    for (uint32_t d = 0; d < DOORS; d++) {
        if (w->doors[d] != 0) {
            toggle_door(w, d);
        }
    }
    while (w->obstacle_count > 0) {
        TEST_RESULT(tl_nav_obstacles_remove(w->obstacles, w->ids[--w->obstacle_count]), TL_OK);
    }
    TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, UINT32_MAX, NULL, NULL), TL_OK);
    window_every = window_every < 8 ? 8 : window_every; // it takes thousands of steps
    begin_window(w, step);
    give_goals(w, true);
    tl_nav_crowd_step_report report = { .arrived = 0 };
    uint32_t taken = 0;
    for (; taken < SETTLE_STEPS && report.arrived < agent_count; taken++) {
        step_all(w, step + taken, &report);
    }
    for (uint32_t i = 0; i < agent_count && report.arrived < agent_count; i++) {
        tl_nav_agent_state state;
        TEST_RESULT(tl_nav_crowd_agent(w->crowds[0], w->agents[0][i], &state), TL_OK);
        if (state.status != TL_NAV_AGENT_ARRIVED) {
            print_message("agent %u at %.2f, %.2f %s, goal %.2f, %.2f, wants %.2f, %.2f\n", i, (double)state.position.x,
                          (double)state.position.z, tl_nav_agent_status_name(state.status), (double)state.goal.x,
                          (double)state.goal.z, (double)state.wanted.x, (double)state.wanted.z);
        }
    }
    TEST_CHECK(report.arrived == agent_count);
    return taken;
}

static void run_edits(uint64_t with)
{
    static edit_world w;
    seed = with;
    uint32_t counts[CROWDS];
    tl_tasks tasks[CROWDS];
    for (uint32_t c = 0; c < CROWDS; c++) {
        counts[c] = workers[c];
        const tl_tasks on = { run_on_threads, counts[c], &counts[c] };
        tasks[c] = on;
    }
    make_world(&w);
    make_crowds(&w, tasks);
    w.group_count = agent_count / 20 < MAX_GROUPS ? agent_count / 20 : MAX_GROUPS;
    w.crowd_count = CROWDS;
    w.saved = malloc(tl_nav_crowd_state_size(w.crowds[0]));
    for (uint32_t step = 0; step < step_count; step++) {
        if (step % EDIT_EVERY == 0) {
            edit(&w);
        }
        if (step % GOALS_EVERY == 0) {
            give_goals(&w, false);
        }
        if (step % GROUPS_EVERY == 0 && w.group_count > 0) {
            change_group(&w, test_random_below(&w.random, w.group_count));
        }
        choose_kernels(CROWDS - 1);
        TEST_RESULT(tl_nav_obstacles_update(w.obstacles, w.navmesh, 1, NULL, NULL), TL_OK);
        step_all(&w, step, NULL);
        if (step % 10000 == 9999) {
            print_message("%u steps, %u off the mesh, %u lost, %u stands over 15 s, the longest %.1f s, hash %016llx\n",
                          step + 1, (unsigned)w.off_mesh, (unsigned)w.lost, w.stands, (double)((float)w.longest * DT),
                          (unsigned long long)tl_nav_crowd_hash(w.crowds[0]));
            fflush(stdout);
        }
    }
    const uint32_t longest = w.longest; // while doors and obstacles came and went
    w.longest = 0;
    const uint32_t settled = settle(&w, step_count);
    print_message(
        "%u agents, %u steps, %u edits, %u goals, %u groups formed: %u off the mesh, %u lost, %u stands over "
        "15 s, the longest without a metre forward %.1f s (%u s shut off); at the end %.1f s, all arrived after "
        "%.1f s, hash %016llx\n",
        agent_count, step_count, (unsigned)w.edits, (unsigned)w.goals, (unsigned)w.formed, (unsigned)w.off_mesh,
        (unsigned)w.lost, w.stands, (double)((float)longest * DT), w.shut_off, (double)((float)w.longest * DT),
        (double)((float)settled * DT), (unsigned long long)tl_nav_crowd_hash(w.crowds[0]));
    TEST_CHECK(w.off_mesh == 0 && w.lost == 0 && w.edits * EDIT_EVERY >= step_count && w.goals > agent_count);
    TEST_CHECK((float)longest * DT < LONG && (float)w.longest * DT < (agent_count < LARGE_CROWD ? LONG : TURN));
    TEST_CHECK(w.group_count == 0 || step_count < 1200 || (w.formed > w.group_count && w.parted > 0));
    for (uint32_t c = 0; c < w.crowd_count; c++) {
        TEST_CHECK(tl_nav_crowd_count(w.crowds[c]) == agent_count);
        TEST_CHECK(tl_nav_crowd_hash(w.crowds[c]) == tl_nav_crowd_hash(w.crowds[0]));
    }
    for (uint32_t c = 0; c < CROWDS; c++) {
        tl_nav_crowd_destroy(w.crowds[c]);
        free(w.agents[c]);
    }
    choose_kernels(CROWDS - 1);
    tl_navmesh_destroy(w.navmesh);
    tl_nav_obstacles_destroy(w.obstacles);
    free(w.saved);
    free(w.anchor);
    free(w.anchor_at);
}

static void test_edits(void **state)
{
    (void)state;
    run_edits(seed);
}

static void test_blocked_doors(void **state)
{
    (void)state;
    window_every = 32;
    run_edits(29);
    run_edits(31);
}

int main(int argc, char **argv)
{
    step_count = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : step_count;
    agent_count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : agent_count;
    window_every = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : window_every;
    seed = argc > 4 ? strtoull(argv[4], NULL, 10) : seed;
    const struct CMUnitTest one[] = { cmocka_unit_test(test_edits) };
    const struct CMUnitTest all[] = { cmocka_unit_test(test_edits), cmocka_unit_test(test_blocked_doors) };
    return argc > 1 ? cmocka_run_group_tests(one, NULL, NULL) : cmocka_run_group_tests(all, NULL, NULL);
}
