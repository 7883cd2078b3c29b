// SPDX-License-Identifier: MIT
//
// nav_corridor.h.

#include "contract_nav.h"

static const tl_vec3 NEAR = { 4.5f, 0.0f, 10.0f };

// A corridor from here to there.
typedef struct corridor_call {
    contract_nav nav;
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_corridor corridor;
} corridor_call;

static void begin_corridor(const contract_run *run, corridor_call *call)
{
    const contract_level *level = contract_level_get();
    call->nav = contract_nav_begin(run);
    call->corridor = tl_nav_corridor_init(call->polygons, CONTRACT_CAPACITY);
    const tl_nav_location here = contract_nav_location(level->here);
    tl_nav_path path;
    tl_nav_corridor_reset(&call->corridor, &here);
    TEST_RESULT(tl_nav_corridor_find(&call->corridor, level->query, level->navmesh, NULL, &call->nav.there, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && call->corridor.reaches);
    if (run->what == CONTRACT_STALE) {
        call->polygons[0] = level->stale;
        call->polygons[call->corridor.count - 1] = level->stale;
    }
}

static tl_result init(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    run->is_clear = true;
    return TL_OK;
}

static tl_result find(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    tl_nav_path path;
    memset(&path, 0, sizeof path);
    const tl_result result = tl_nav_corridor_find(
        CONTRACT_INPUT(run, 2, &call.corridor), call.nav.query, call.nav.navmesh, contract_nav_filter(run, &call.nav),
        CONTRACT_INPUT(run, 3, &call.nav.there), CONTRACT_OUTPUT(run, 0, &path));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = path.polygon_count;
    return result;
}

static tl_result set_path(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    memcpy(polygons, call.polygons, sizeof polygons);
    run->is_clear = true;
    return tl_nav_corridor_set_path(CONTRACT_INPUT(run, 1, &call.corridor), call.nav.navmesh,
                                    CONTRACT_INPUT(run, 2, polygons), call.corridor.count, call.nav.there.point);
}

// The count of corners that were not looked at is not known, so a short buffer has its own capacity as count.
static tl_result corners(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    tl_nav_corner out[CONTRACT_CAPACITY];
    uint32_t count = 0;
    const tl_result result = tl_nav_corridor_corners(CONTRACT_INPUT(run, 1, &call.corridor), call.nav.navmesh, out,
                                                     CONTRACT_CAPACITY, CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0;
    uint32_t few = 0;
    if (run->what == CONTRACT_GOOD) {
        TEST_RESULT(tl_nav_corridor_corners(&call.corridor, call.nav.navmesh, out, 2, &few), TL_INCOMPLETE);
        TEST_CHECK(few == 2);
        TEST_RESULT(tl_nav_corridor_corners(&call.corridor, call.nav.navmesh, NULL, 0, &few), TL_INCOMPLETE);
    }
    return result;
}

static tl_result move(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    const tl_result result = tl_nav_corridor_move(CONTRACT_INPUT(run, 2, &call.corridor), call.nav.query,
                                                  call.nav.navmesh, contract_nav_filter(run, &call.nav),
                                                  run->what == CONTRACT_NO_NODES ? call.nav.there.point : NEAR);
    run->is_clear = true;
    run->answer = call.polygons[0];
    return result;
}

static tl_result move_target(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    const tl_vec3 to = run->what == CONTRACT_NO_NODES ? contract_level_get()->here : tl_vec3_make(15.5f, 0.0f, 10.0f);
    const tl_result result = tl_nav_corridor_move_target(CONTRACT_INPUT(run, 2, &call.corridor), call.nav.query,
                                                         call.nav.navmesh, contract_nav_filter(run, &call.nav), to);
    run->is_clear = true;
    run->answer = call.corridor.count;
    return result;
}

static tl_result pass_link(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    run->is_clear = true;
    return tl_nav_corridor_pass_link(CONTRACT_INPUT(run, 1, &call.corridor), call.nav.navmesh, NULL, NULL);
}

static tl_result shorten(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    bool changed = false;
    const tl_result result = tl_nav_corridor_shorten(CONTRACT_INPUT(run, 1, &call.corridor), call.nav.navmesh,
                                                     contract_nav_filter(run, &call.nav), 20.0f, &changed);
    run->is_clear = !changed;
    return result;
}

static tl_result improve(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    bool changed = false;
    const tl_result result =
        tl_nav_corridor_improve(CONTRACT_INPUT(run, 2, &call.corridor), call.nav.query, call.nav.navmesh,
                                contract_nav_filter(run, &call.nav), 8, 64, &changed);
    run->is_clear = !changed;
    return result;
}

static tl_result check(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    const uint32_t whole = tl_nav_corridor_check(&call.corridor, call.nav.navmesh, NULL, UINT32_MAX);
    TEST_CHECK(whole == call.corridor.count && tl_nav_corridor_check(&call.corridor, call.nav.navmesh, NULL, 1) == 1);
    run->is_clear = true;
    return TL_OK;
}

static tl_result repair(contract_run *run)
{
    corridor_call call;
    begin_corridor(run, &call);
    if (run->what == CONTRACT_NOT_FOUND) {
        call.polygons[0] = contract_level_get()->stale;
        call.corridor.position = contract_level_get()->nowhere;
    }
    tl_nav_path path;
    memset(&path, 0, sizeof path);
    const tl_result result = tl_nav_corridor_repair(CONTRACT_INPUT(run, 2, &call.corridor), call.nav.query,
                                                    call.nav.navmesh, contract_nav_filter(run, &call.nav),
                                                    tl_vec3_make(1, 1, 1), CONTRACT_OUTPUT(run, 0, &path));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = path.polygon_count;
    return result;
}

#define FILTERED (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT))

const contract_entry CONTRACT_TABLE_nav_corridor[] = {
    { "tl_nav_corridor_init", CONTRACT_BIT(GOOD), 0, 0, NULL, init, NULL },
    { "tl_nav_corridor_reset", CONTRACT_BIT(GOOD), 0, 0, NULL, init, NULL },
    { "tl_nav_corridor_find", FILTERED | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 4, 1, NULL, find, NULL },
    { "tl_nav_corridor_set_path", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT), 3, 0, NULL, set_path, NULL },
    { "tl_nav_corridor_corners",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 2, 1, NULL,
      corners, NULL },
    { "tl_nav_corridor_move", FILTERED | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_NODES), 3, 0, NULL, move, NULL },
    { "tl_nav_corridor_move_target", FILTERED | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_NODES), 3, 0, NULL, move_target,
      NULL },
    { "tl_nav_corridor_pass_link", CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NULL_INPUT), 2, 0, NULL, pass_link, NULL },
    { "tl_nav_corridor_shorten", FILTERED | CONTRACT_BIT(STALE), 2, 0, NULL, shorten, NULL },
    { "tl_nav_corridor_improve", FILTERED | CONTRACT_BIT(STALE), 3, 0, NULL, improve, NULL },
    { "tl_nav_corridor_check", CONTRACT_BIT(GOOD), 0, 0, NULL, check, NULL },
    { "tl_nav_corridor_repair", FILTERED | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND), 3, 1, NULL, repair,
      NULL },
    { 0 },
};
