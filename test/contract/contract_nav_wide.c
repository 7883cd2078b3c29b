// SPDX-License-Identifier: MIT
//
// nav_wide.h.

#include "contract_nav.h"

static const float RADIUS = 1.0f;

static tl_result wide_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_path_request request = { contract_nav_filter(run, &nav), nav.here, nav.there };
    tl_nav_corner corners[CONTRACT_CAPACITY];
    tl_nav_wide_path path;
    memset(&path, 0, sizeof path);
    tl_result result = TL_OK;
    do {
        result = tl_nav_query_find_wide_path(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request), RADIUS,
                                             nav.capacity > 0 ? corners : NULL, nav.capacity,
                                             CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.corner_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = (uint64_t)(path.length * 1e9);
    return result;
}

static tl_result is_wide_reachable(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_path_request request = { contract_nav_filter(run, &nav), nav.here, nav.there };
    tl_nav_wide_status status = TL_NAV_WIDE_NONE;
    const tl_result result = tl_nav_query_is_wide_reachable(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                                            RADIUS, CONTRACT_OUTPUT(run, 0, &status));
    run->is_clear = status == TL_NAV_WIDE_NONE;
    run->answer = (uint64_t)status;
    return result;
}

static tl_result default_wide_def(contract_run *run)
{
    const tl_nav_wide_def def = tl_default_nav_wide_def();
    TEST_CHECK(def.cookie == TL_DEF_COOKIE && def.max_radius == 1.5f);
    run->is_clear = true;
    return TL_OK;
}

// On a navmesh of its own: it changes.
static tl_result prepare_wide(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_navmesh *navmesh = NULL;
    tl_result result = tl_navmesh_create(run->host->allocator, &navmesh);
    for (uint32_t i = 0; i < level->tiles.tile_count && result == TL_OK; i++) {
        result = tl_navmesh_add_tile(navmesh, level->tiles.tiles[i], TL_NAV_TILE_BORROWED);
    }
    tl_nav_wide_def def = tl_default_nav_wide_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.max_radius = -1.0f;
    }
    tl_nav_wide_report report;
    memset(&report, 0, sizeof report);
    if (result == TL_OK) {
        result = tl_navmesh_prepare_wide(CONTRACT_INPUT(run, 0, navmesh), run->what == CONTRACT_NULL_DEF ? NULL : &def,
                                         run->wants_report ? &report : NULL);
    }
    run->own_report = report.base;
    run->is_clear = result == TL_ERR_MEMORY || report.wall_count == 0;
    // What is kept shows in what another preparation has to make.
    tl_nav_wide_report again;
    if (result == TL_OK && run->what != CONTRACT_NO_MEMORY) {
        TEST_RESULT(tl_navmesh_prepare_wide(navmesh, NULL, &again), TL_OK);
        run->answer = again.wall_count * 1000 + again.made_tile_count;
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result wide_place(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_around_request request = { contract_nav_filter(run, &nav), nav.here, 2.0f };
    tl_nav_location place;
    memset(&place, 0, sizeof place);
    const tl_result result = tl_nav_query_find_wide_place(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                                          run->what == CONTRACT_NOT_FOUND ? 100.0f : RADIUS,
                                                          CONTRACT_OUTPUT(run, 0, &place));
    run->is_clear = contract_nav_is_clear(run, result, &place, sizeof place);
    run->answer = place.polygon;
    return result;
}

static tl_result path_clearance(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_corner corners[1] = { { nav.here.point, nav.here.polygon, 0, TL_NAV_NO_REF } };
    float clearance = 0.0f;
    const tl_result result =
        tl_nav_query_path_clearance(nav.query, nav.navmesh, contract_nav_filter(run, &nav),
                                    CONTRACT_INPUT(run, 2, corners), 1, 20.0f, CONTRACT_OUTPUT(run, 0, &clearance));
    run->is_clear = clearance == 0.0f;
    run->answer = (uint64_t)(clearance * 1e6f);
    return result;
}

#define FILTERED                                                                                                       \
    (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT) |               \
     CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE))
#define BUFFERED (CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER))

static const char *const WIDE_FIELDS[] = { "max_radius", NULL };

const contract_entry CONTRACT_TABLE_nav_wide[] = {
    { "tl_nav_wide_status_name", 0, 0, 0, NULL, NULL, "a constant text for every number: test_wide_path.c" },
    { "tl_nav_query_find_wide_path", FILTERED | BUFFERED, 3, 1, NULL, wide_path, NULL },
    { "tl_nav_query_is_wide_reachable", FILTERED, 3, 1, NULL, is_wide_reachable, NULL },
    { "tl_default_nav_wide_def", CONTRACT_BIT(GOOD), 0, 0, NULL, default_wide_def, NULL },
    { "tl_navmesh_prepare_wide",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY),
      1, 0, WIDE_FIELDS, prepare_wide, NULL },
    { "tl_nav_query_find_wide_place", FILTERED | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NO_NODES), 3, 1, NULL,
      wide_place, NULL },
    { "tl_nav_query_path_clearance", FILTERED | CONTRACT_BIT(NO_NODES), 3, 1, NULL, path_clearance, NULL },
    { 0 },
};
