// SPDX-License-Identifier: MIT
//
// nav_crowd.h.

#include "contract_nav.h"

// A crowd of two: one walks, one is fixed.
typedef struct crowd_call {
    tl_nav_crowd *crowd;
    const tl_navmesh *navmesh;
    tl_nav_agent walker, fixed;
} crowd_call;

static crowd_call begin_crowd(const contract_run *run)
{
    const contract_level *level = contract_level_get();
    crowd_call call;
    memset(&call, 0, sizeof call);
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = 3;
    TEST_RESULT(tl_nav_crowd_create(&def, &call.crowd, NULL), TL_OK);
    tl_nav_agent_def agent = tl_default_nav_agent_def();
    agent.position = level->here;
    TEST_RESULT(tl_nav_crowd_add(call.crowd, level->navmesh, &agent, &call.walker, NULL), TL_OK);
    agent.is_fixed = true;
    agent.position = level->there;
    TEST_RESULT(tl_nav_crowd_add(call.crowd, level->navmesh, &agent, &call.fixed, NULL), TL_OK);
    const tl_nav_location goal = contract_nav_location(level->there);
    TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.walker, &goal), TL_OK);
    TEST_RESULT(tl_nav_crowd_step(call.crowd, level->navmesh, 0.1f, NULL), TL_OK);
    call.navmesh = level->navmesh;
    if (run->what == CONTRACT_STALE) {
        call.walker += 1 + ((uint64_t)7 << 32);
        call.fixed = call.walker;
    }
    return call;
}

static tl_result create(contract_run *run)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        switch (run->variant) {
        case 0:
            def.max_agents = 0;
            break;
        case 1:
            def.max_path = 3;
            break;
        case 2:
            def.max_neighbors = 33;
            break;
        case 3:
            def.paths_per_step = 0;
            break;
        case 4:
            def.max_nodes = 1;
            break;
        case 5:
            def.neighbor_distance = 0.0f;
            break;
        case 6:
            def.agent_horizon = NAN;
            break;
        case 7:
            def.wall_horizon = -1.0f;
            break;
        case 8:
            def.max_shared_goals = 9;
            break;
        case 9:
            def.max_groups = TL_NAV_CROWD_MAX_AGENTS + 1;
            break;
        default:
            def.max_members = TL_NAV_CROWD_MAX_AGENTS + 1;
            break;
        }
    }
    def.host = *run->host;
    tl_nav_crowd *crowd = NULL;
    const tl_result result =
        tl_nav_crowd_create(run->what == CONTRACT_NULL_DEF ? NULL : &def, CONTRACT_OUTPUT(run, 0, &crowd), run->report);
    run->is_clear = crowd == NULL;
    run->answer = crowd != NULL ? tl_nav_crowd_hash(crowd) : 0;
    tl_nav_crowd_destroy(crowd);
    return result;
}

static tl_result destroy(contract_run *run)
{
    (void)run;
    tl_nav_crowd_destroy(NULL);
    return TL_OK;
}

static tl_result set_filter(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_filter filter = tl_default_nav_filter();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&filter, 0, sizeof filter);
    }
    const tl_result result =
        tl_nav_crowd_set_filter(CONTRACT_INPUT(run, 0, call.crowd), 1, run->what == CONTRACT_NULL_DEF ? NULL : &filter);
    TEST_RESULT(tl_nav_crowd_set_filter(call.crowd, TL_NAV_CROWD_FILTER_COUNT, &filter), TL_ERR_ARGUMENT);
    run->is_clear = true;
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static void spoil_agent(tl_nav_agent_def *def, uint32_t variant)
{
    switch (variant) {
    case 0:
        def->position.x = INFINITY;
        break;
    case 1:
        def->reach = -1.0f;
        break;
    case 2:
        def->radius = 0.0f;
        break;
    case 3:
        def->height = NAN;
        break;
    case 4:
        def->max_speed = 1001.0f;
        break;
    case 5:
        def->max_acceleration = 0.0f;
        break;
    case 6:
        def->arrive_distance = -0.1f;
        break;
    case 7:
        def->priority = 1.5f;
        break;
    default:
        def->filter = TL_NAV_CROWD_FILTER_COUNT;
        break;
    }
}

static tl_result add(contract_run *run)
{
    const contract_level *level = contract_level_get();
    crowd_call call = begin_crowd(run);
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.position = level->here;
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        spoil_agent(&def, run->variant);
    } else if (run->what == CONTRACT_NOT_FOUND) {
        def.position = level->nowhere;
    }
    tl_nav_agent agent = TL_NAV_NO_AGENT;
    const tl_result result = tl_nav_crowd_add(CONTRACT_INPUT(run, 0, call.crowd), CONTRACT_INPUT(run, 1, call.navmesh),
                                              &def, CONTRACT_OUTPUT(run, 0, &agent), run->report);
    run->is_clear = agent == TL_NAV_NO_AGENT;
    run->answer = agent;
    if (result == TL_OK) {
        TEST_RESULT(tl_nav_crowd_add(call.crowd, call.navmesh, &def, &agent, NULL), TL_ERR_LIMIT);
    }
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result remove_agent(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const tl_result result = tl_nav_crowd_remove(CONTRACT_INPUT(run, 0, call.crowd), call.walker);
    run->is_clear = true;
    run->answer = tl_nav_crowd_count(call.crowd);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result set_goal(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_location goal = contract_nav_location(contract_level_get()->here);
    const tl_result result = tl_nav_crowd_set_goal(CONTRACT_INPUT(run, 0, call.crowd), call.walker, &goal);
    run->is_clear = true;
    if (run->what == CONTRACT_GOOD) {
        TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.fixed, &goal), TL_ERR_ARGUMENT);
        goal.point.x = NAN;
        TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.walker, &goal), TL_ERR_NOT_FINITE);
        goal.point.x = 2e9f;
        TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.walker, &goal), TL_ERR_RANGE);
        TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.walker, NULL), TL_OK);
    }
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result set_motion(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_vec3 zero = { 0.0f, 0.0f, 0.0f };
    const tl_result result = tl_nav_crowd_set_motion(CONTRACT_INPUT(run, 0, call.crowd), call.fixed, zero, zero);
    run->is_clear = true;
    if (run->what == CONTRACT_GOOD) {
        TEST_RESULT(tl_nav_crowd_set_motion(call.crowd, call.walker, zero, zero), TL_ERR_ARGUMENT);
        TEST_RESULT(tl_nav_crowd_set_motion(call.crowd, call.fixed, tl_vec3_make(NAN, 0, 0), zero), TL_ERR_NOT_FINITE);
        TEST_RESULT(tl_nav_crowd_set_motion(call.crowd, call.fixed, tl_vec3_make(2e9f, 0, 0), zero), TL_ERR_RANGE);
    }
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result agent_state(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_agent_state state;
    memset(&state, 0, sizeof state);
    const tl_result result =
        tl_nav_crowd_agent(CONTRACT_INPUT(run, 0, call.crowd), call.walker, CONTRACT_OUTPUT(run, 0, &state));
    run->is_clear = contract_is_zero(&state, sizeof state);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result corners(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_corner out[CONTRACT_CAPACITY];
    uint32_t count = 0;
    const tl_result result =
        tl_nav_crowd_corners(CONTRACT_INPUT(run, 0, call.crowd), CONTRACT_INPUT(run, 1, call.navmesh),
                             run->what == CONTRACT_NOT_FOUND ? call.fixed : call.walker, CONTRACT_INPUT(run, 2, out),
                             CONTRACT_CAPACITY, CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0;
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result step(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const uint64_t before = tl_nav_crowd_hash(call.crowd);
    tl_nav_crowd_step_report report;
    memset(&report, 0, sizeof report);
    const tl_result result =
        tl_nav_crowd_step(CONTRACT_INPUT(run, 0, call.crowd), CONTRACT_INPUT(run, 1, call.navmesh), 0.1f, &report);
    run->is_clear = contract_is_zero(&report, sizeof report);
    run->answer = tl_nav_crowd_hash(call.crowd);
    TEST_CHECK((run->answer == before) == (result != TL_OK));
    TEST_RESULT(tl_nav_crowd_step(call.crowd, call.navmesh, NAN, NULL), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_crowd_step(call.crowd, call.navmesh, 0.0f, NULL), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_crowd_step(call.crowd, call.navmesh, 1.01f, NULL), TL_ERR_ARGUMENT);
    TEST_CHECK(tl_nav_crowd_hash(call.crowd) == run->answer);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result save(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const size_t size = tl_nav_crowd_state_size(call.crowd);
    void *bytes = calloc(1, size);
    const tl_result result =
        tl_nav_crowd_save(CONTRACT_INPUT(run, 0, call.crowd), CONTRACT_OUTPUT(run, 0, bytes), size);
    TEST_RESULT(tl_nav_crowd_save(call.crowd, bytes, size - 1), TL_ERR_LIMIT);
    run->is_clear = result == TL_OK || contract_is_zero(bytes, size);
    run->answer = contract_hash(bytes, size, 0);
    free(bytes);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result restore(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const size_t size = tl_nav_crowd_state_size(call.crowd);
    uint8_t *bytes = malloc(size);
    TEST_RESULT(tl_nav_crowd_save(call.crowd, bytes, size), TL_OK);
    if (run->what == CONTRACT_BAD_BYTES) {
        memset(bytes + size / 2, 0xff, size / 2);
    }
    const tl_result result =
        tl_nav_crowd_restore(CONTRACT_INPUT(run, 0, call.crowd), CONTRACT_INPUT(run, 1, bytes), size, run->report);
    run->is_clear = true;
    run->answer = tl_nav_crowd_hash(call.crowd);
    free(bytes);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Groups.

// A group of the walker alone.
static tl_nav_group begin_group(const contract_run *run, const crowd_call *call)
{
    tl_nav_group group = TL_NAV_NO_GROUP;
    if (run->what == CONTRACT_STALE) {
        return (uint64_t)9 << 32;
    }
    TEST_RESULT(tl_nav_crowd_add_group(call->crowd, NULL, &call->walker, 1, &group, NULL), TL_OK);
    return group;
}

static void spoil_group(const contract_run *run, tl_nav_group_def *def)
{
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(def, 0, sizeof *def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        switch (run->variant) {
        case 0:
            def->formation = (tl_nav_formation)6;
            break;
        case 1:
            def->spacing = 0.0f;
            break;
        case 2:
            def->wait_distance = INFINITY;
            break;
        case 3:
            def->lost_distance = 1001.0f;
            break;
        default:
            def->formation = TL_NAV_FORMATION_SLOTS;
            break;
        }
    }
}

static tl_result add_group(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_group_def def = tl_default_nav_group_def();
    tl_nav_agent agents[2] = { call.fixed, call.walker }; // a fixed one leads
    tl_nav_group group = TL_NAV_NO_GROUP;
    spoil_group(run, &def);
    const tl_result result =
        tl_nav_crowd_add_group(CONTRACT_INPUT(run, 0, call.crowd), run->what == CONTRACT_NULL_DEF ? NULL : &def,
                               CONTRACT_INPUT(run, 1, agents), 2, CONTRACT_OUTPUT(run, 0, &group), run->report);
    run->is_clear = group == TL_NAV_NO_GROUP;
    run->answer = group;
    if (result == TL_OK) {
        TEST_RESULT(tl_nav_crowd_set_goal(call.crowd, call.walker, NULL), TL_ERR_ARGUMENT); // it follows
        TEST_RESULT(tl_nav_crowd_remove_group(call.crowd, group), TL_OK);
        agents[0] = call.walker;
        agents[1] = call.fixed;
        TEST_RESULT(tl_nav_crowd_add_group(call.crowd, &def, agents, 2, &group, NULL), TL_ERR_ARGUMENT);
        TEST_RESULT(tl_nav_crowd_add_group(call.crowd, &def, agents, 0, &group, NULL), TL_ERR_ARGUMENT);
    }
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result remove_group(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const tl_nav_group group = begin_group(run, &call);
    const tl_result result = tl_nav_crowd_remove_group(CONTRACT_INPUT(run, 0, call.crowd), group);
    run->is_clear = true;
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result set_formation(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    tl_nav_group_def def = tl_default_nav_group_def();
    tl_nav_agent agents[2] = { call.fixed, call.walker };
    tl_nav_group group = (uint64_t)9 << 32;
    if (run->what != CONTRACT_STALE) {
        def.formation = TL_NAV_FORMATION_WEDGE;
        TEST_RESULT(tl_nav_crowd_add_group(call.crowd, &def, agents, 2, &group, NULL), TL_OK);
        def.formation = TL_NAV_FORMATION_LOOSE;
    }
    const uint64_t before = tl_nav_crowd_hash(call.crowd);
    spoil_group(run, &def);
    const tl_result result = tl_nav_crowd_set_formation(CONTRACT_INPUT(run, 0, call.crowd), group,
                                                        run->what == CONTRACT_NULL_DEF ? NULL : &def, run->report);
    run->is_clear = true;
    run->answer = tl_nav_crowd_hash(call.crowd);
    TEST_CHECK(result == TL_OK || run->answer == before);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result group_state(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const tl_nav_group group = begin_group(run, &call);
    tl_nav_group_state state;
    memset(&state, 0, sizeof state);
    const tl_result result =
        tl_nav_crowd_group(CONTRACT_INPUT(run, 0, call.crowd), group, CONTRACT_OUTPUT(run, 0, &state));
    run->is_clear = contract_is_zero(&state, sizeof state);
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static tl_result members(contract_run *run)
{
    crowd_call call = begin_crowd(run);
    const tl_nav_group group = begin_group(run, &call);
    tl_nav_agent agents[CONTRACT_CAPACITY];
    uint32_t count = 0;
    const tl_result result =
        tl_nav_crowd_members(CONTRACT_INPUT(run, 0, call.crowd), group, CONTRACT_INPUT(run, 1, agents),
                             CONTRACT_CAPACITY, CONTRACT_OUTPUT(run, 0, &count));
    if (result == TL_OK) {
        TEST_RESULT(tl_nav_crowd_members(call.crowd, group, NULL, 0, &count), TL_INCOMPLETE);
        TEST_CHECK(count == 1 && agents[0] == call.walker);
    }
    run->is_clear = count == 0;
    tl_nav_crowd_destroy(call.crowd);
    return result;
}

static const char *const GROUP_FIELDS[] = { "formation", "spacing", "wait_distance", "lost_distance", "slots", NULL };
static const char *const CROWD_FIELDS[] = { "max_agents",       "max_path",          "max_neighbors", "paths_per_step",
                                            "max_nodes",        "neighbor_distance", "agent_horizon", "wall_horizon",
                                            "max_shared_goals", "max_groups",        "max_members",   NULL };
static const char *const AGENT_FIELDS[] = { "position",         "reach",           "radius",   "height", "max_speed",
                                            "max_acceleration", "arrive_distance", "priority", "filter", NULL };

const contract_entry CONTRACT_TABLE_nav_crowd[] = {
    { "tl_default_nav_crowd_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_crowd_create",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY),
      0, 1, CROWD_FIELDS, create, NULL },
    { "tl_nav_crowd_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, destroy, NULL },
    { "tl_nav_crowd_set_filter",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT), 1, 0, NULL,
      set_filter, NULL },
    { "tl_default_nav_agent_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_agent_status_name", 0, 0, 0, NULL, NULL, "a constant text: test_crowd_agents.c" },
    { "tl_nav_crowd_add",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) |
          CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND),
      2, 1, AGENT_FIELDS, add, NULL },
    { "tl_nav_crowd_remove", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE), 1, 0, NULL,
      remove_agent, NULL },
    { "tl_nav_crowd_set_goal", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE), 1, 0, NULL,
      set_goal, NULL },
    { "tl_nav_crowd_set_motion", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE), 1, 0, NULL,
      set_motion, NULL },
    { "tl_nav_crowd_agent",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 1, 1, NULL,
      agent_state, NULL },
    { "tl_nav_crowd_corners",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE) |
          CONTRACT_BIT(NOT_FOUND),
      3, 1, NULL, corners, NULL },
    { "tl_nav_crowd_count", 0, 0, 0, NULL, NULL, "a number; the caller's crowd: test_crowd_agents.c" },
    { "tl_nav_crowd_next", 0, 0, 0, NULL, NULL, "iterates; the caller's crowd: test_crowd_agents.c" },
    { "tl_nav_formation_name", 0, 0, 0, NULL, NULL, "a constant text: test_crowd_groups.c" },
    { "tl_default_nav_group_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_crowd_add_group",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT),
      2, 1, GROUP_FIELDS, add_group, NULL },
    { "tl_nav_crowd_remove_group", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE), 1, 0, NULL,
      remove_group, NULL },
    { "tl_nav_crowd_set_formation",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE),
      1, 0, GROUP_FIELDS, set_formation, NULL },
    { "tl_nav_crowd_group",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 1, 1, NULL,
      group_state, NULL },
    { "tl_nav_crowd_members",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 2, 1, NULL,
      members, NULL },
    { "tl_nav_crowd_group_of", 0, 0, 0, NULL, NULL, "a name; the caller's crowd: test_crowd_groups.c" },
    { "tl_nav_crowd_step", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT), 2, 0, NULL, step, NULL },
    { "tl_nav_crowd_state_size", 0, 0, 0, NULL, NULL, "a number; the caller's crowd: test_crowd_state.c" },
    { "tl_nav_crowd_save", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL, save,
      NULL },
    { "tl_nav_crowd_restore",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES), 2, 0, NULL,
      restore, NULL },
    { "tl_nav_crowd_hash", 0, 0, 0, NULL, NULL, "a number; the caller's crowd: test_crowd_state.c" },
    { 0 },
};
