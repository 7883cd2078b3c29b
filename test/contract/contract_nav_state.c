// SPDX-License-Identifier: MIT
//
// nav_state.h.

#include "contract_nav.h"

// A navmesh of the call's own, since the calls change it.
typedef struct state_case {
    tl_navmesh *navmesh;
    tl_nav_ref polygon;
    const tl_nav_tile *tile;
    int32_t tile_x;
} state_case;

static tl_result begin_state(const contract_run *run, state_case *s)
{
    const contract_level *level = contract_level_get();
    memset(s, 0, sizeof *s);
    s->tile = level->tiles.tiles[0];
    s->tile_x = run->what == CONTRACT_NOT_FOUND ? 1000 : s->tile->tile_x;
    tl_result result = tl_navmesh_create(run->host->allocator, &s->navmesh);
    if (result == TL_OK) {
        result =
            tl_navmesh_add_tiles(s->navmesh, level->tiles.tiles, level->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
    }
    s->polygon = result == TL_OK ? tl_navmesh_polygon_ref(s->navmesh, 0, 0) : TL_NAV_NO_REF;
    s->polygon = run->what == CONTRACT_STALE ? level->stale : s->polygon;
    return result;
}

static tl_result get_flags(contract_run *run)
{
    const contract_nav nav = contract_nav_begin(run);
    uint64_t flags = 1;
    const tl_result result = tl_navmesh_polygon_flags(nav.navmesh, nav.here.polygon, CONTRACT_OUTPUT(run, 0, &flags));
    run->is_clear = flags == 0 || run->what == CONTRACT_NULL_OUTPUT;
    run->answer = flags;
    return result;
}

static tl_result get_area(contract_run *run)
{
    const contract_nav nav = contract_nav_begin(run);
    uint8_t area = 1;
    const tl_result result = tl_navmesh_polygon_area(nav.navmesh, nav.here.polygon, CONTRACT_OUTPUT(run, 0, &area));
    run->is_clear = area == 0 || run->what == CONTRACT_NULL_OUTPUT;
    run->answer = area;
    return result;
}

static tl_result set_flags(contract_run *run)
{
    state_case s;
    tl_result result = begin_state(run, &s);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_set_polygon_flags(CONTRACT_INPUT(run, 0, s.navmesh), s.polygon, 6);
        run->answer = tl_navmesh_is_state_changed(s.navmesh, s.tile->tile_x, s.tile->layer, s.tile->tile_z);
    }
    tl_navmesh_destroy(s.navmesh);
    return result;
}

static tl_result set_area(contract_run *run)
{
    state_case s;
    tl_result result = begin_state(run, &s);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_set_polygon_area(CONTRACT_INPUT(run, 0, s.navmesh), s.polygon, 6);
        run->answer = tl_navmesh_is_state_changed(s.navmesh, s.tile->tile_x, s.tile->layer, s.tile->tile_z);
    }
    tl_navmesh_destroy(s.navmesh);
    return result;
}

static tl_result store(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_tile *tile = level->tiles.tiles[0];
    contract_nav nav = contract_nav_begin(run);
    tl_nav_polygon_state *states = calloc(tile->polygon_count, sizeof *states);
    const uint32_t wanted = run->what == CONTRACT_NO_BUFFER      ? 0
                            : run->what == CONTRACT_SHORT_BUFFER ? tile->polygon_count - 1
                                                                 : tile->polygon_count;
    uint32_t count = 1;
    const tl_result result = tl_navmesh_store_state(
        nav.navmesh, run->what == CONTRACT_NOT_FOUND ? 1000 : tile->tile_x, tile->layer, tile->tile_z,
        run->what == CONTRACT_NO_BUFFER ? NULL : states, wanted, CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || run->what == CONTRACT_NULL_OUTPUT;
    run->count = count;
    run->answer = contract_hash(states, tile->polygon_count * sizeof *states, 0);
    free(states);
    return result;
}

static tl_result restore(contract_run *run)
{
    state_case s;
    tl_result result = begin_state(run, &s);
    tl_nav_polygon_state *states = calloc(s.tile->polygon_count, sizeof *states);
    for (uint32_t p = 0; p < s.tile->polygon_count; p++) {
        states[p].flags = p;
        states[p].area = 5;
    }
    run->is_clear = true;
    if (result == TL_OK) {
        const uint32_t count = s.tile->polygon_count + (run->what == CONTRACT_STALE ? 1 : 0);
        result = tl_navmesh_restore_state(CONTRACT_INPUT(run, 0, s.navmesh), s.tile_x, s.tile->layer, s.tile->tile_z,
                                          CONTRACT_INPUT(run, 1, states), count, run->report);
        run->answer = tl_navmesh_is_state_changed(s.navmesh, s.tile->tile_x, s.tile->layer, s.tile->tile_z);
    }
    free(states);
    tl_navmesh_destroy(s.navmesh);
    return result;
}

static tl_result reset(contract_run *run)
{
    state_case s;
    tl_result result = begin_state(run, &s);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_set_polygon_flags(s.navmesh, s.polygon, 6);
    }
    if (result == TL_OK) {
        result = tl_navmesh_reset_state(CONTRACT_INPUT(run, 0, s.navmesh), s.tile_x, s.tile->layer, s.tile->tile_z);
        run->answer = tl_navmesh_is_state_changed(s.navmesh, s.tile->tile_x, s.tile->layer, s.tile->tile_z);
    }
    tl_navmesh_destroy(s.navmesh);
    return result;
}

const contract_entry CONTRACT_TABLE_nav_state[] = {
    { "tl_navmesh_polygon_flags",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 1, 1, NULL,
      get_flags, NULL },
    { "tl_navmesh_polygon_area",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 1, 1, NULL,
      get_area, NULL },
    { "tl_navmesh_set_polygon_flags",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_MEMORY), 1, 0, NULL,
      set_flags, NULL },
    { "tl_navmesh_set_polygon_area",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_MEMORY), 1, 0, NULL,
      set_area, NULL },
    { "tl_navmesh_store_state",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_BUFFER) |
          CONTRACT_BIT(SHORT_BUFFER) | CONTRACT_BIT(NOT_FOUND),
      1, 1, NULL, store, NULL },
    { "tl_navmesh_restore_state",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) |
          CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NO_MEMORY),
      2, 0, NULL, restore, NULL },
    { "tl_navmesh_reset_state", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NOT_FOUND), 1, 0, NULL,
      reset, NULL },
    { "tl_navmesh_is_state_changed", 0, 0, 0, NULL, NULL, "returns a value; asked in the calls that change it" },
    { 0 },
};
