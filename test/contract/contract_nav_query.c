// SPDX-License-Identifier: MIT
//
// nav_query.h: the table of tiles, off-mesh links, filters, nearest polygons, the query object. Paths, rays and moves
// stand in contract_nav_paths.c.

#include "contract_nav.h"

// ---------------------------------------------------------------------------------------------------------
// The table of tiles.

static const tl_vec3 EXTENTS = { 1, 1, 1 };

// A navmesh of the level's tiles, from the call's allocator.
static tl_result make_navmesh(const contract_run *run, tl_navmesh **navmesh_out)
{
    const contract_level *level = contract_level_get();
    tl_result result = tl_navmesh_create(run->host->allocator, navmesh_out);
    if (result == TL_OK) {
        result =
            tl_navmesh_add_tiles(*navmesh_out, level->tiles.tiles, level->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
    }
    if (result != TL_OK) {
        tl_navmesh_destroy(*navmesh_out);
        *navmesh_out = NULL;
    }
    return result;
}

static tl_result create(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    const tl_result result = tl_navmesh_create(run->what == CONTRACT_NULL_DEF ? NULL : run->host->allocator,
                                               CONTRACT_OUTPUT(run, 0, &navmesh));
    run->is_clear = navmesh == NULL;
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result destroy(contract_run *run)
{
    run->is_clear = true;
    tl_navmesh_destroy(NULL);
    return TL_OK;
}

static tl_result reserve_tiles(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_result result = make_navmesh(run, &navmesh);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_reserve_tiles(CONTRACT_INPUT(run, 0, navmesh), 100);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result add_tile(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_navmesh *navmesh = NULL;
    tl_result result = tl_navmesh_create(run->host->allocator, &navmesh);
    if (result == TL_OK) {
        result = tl_navmesh_add_tile(CONTRACT_INPUT(run, 0, navmesh), CONTRACT_INPUT(run, 1, level->tiles.tiles[0]),
                                     TL_NAV_TILE_BORROWED);
        run->is_clear = tl_navmesh_tile_count(navmesh) == 0;
        run->answer = tl_navmesh_tile_count(navmesh);
    } else {
        run->is_clear = true;
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result add_tiles(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_navmesh *navmesh = NULL;
    tl_result result = tl_navmesh_create(run->host->allocator, &navmesh);
    run->is_clear = true;
    if (result == TL_OK) {
        tl_nav_tile *tiles[3] = { level->tiles.tiles[0], level->tiles.tiles[1], level->tiles.tiles[0] };
        result = tl_navmesh_add_tiles(CONTRACT_INPUT(run, 0, navmesh), CONTRACT_INPUT(run, 1, tiles),
                                      run->what == CONTRACT_BAD_BYTES ? 3 : 2, TL_NAV_TILE_BORROWED, run->report);
        run->is_clear = tl_navmesh_tile_count(navmesh) == 0 && tl_navmesh_link_count(navmesh) == 0;
        run->answer = tl_navmesh_link_count(navmesh);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

// Takes a tile out, all its layers or one.
static tl_result remove_part(contract_run *run, bool only_layer)
{
    const contract_level *level = contract_level_get();
    const tl_nav_tile *tile = level->tiles.tiles[0];
    tl_navmesh *navmesh = NULL;
    tl_result result = make_navmesh(run, &navmesh);
    run->is_clear = true;
    if (result == TL_OK) {
        const int32_t x = run->what == CONTRACT_NOT_FOUND && !only_layer ? 1000 : tile->tile_x;
        const uint32_t layer = run->what == CONTRACT_NOT_FOUND ? 1000 : tile->layer;
        tl_navmesh *given = CONTRACT_INPUT(run, 0, navmesh);
        result = only_layer ? tl_navmesh_remove_layer(given, x, layer, tile->tile_z)
                            : tl_navmesh_remove_tile(given, x, tile->tile_z);
        run->answer = tl_navmesh_tile_count(navmesh);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result remove_tile(contract_run *run)
{
    return remove_part(run, false);
}

static tl_result remove_layer(contract_run *run)
{
    return remove_part(run, true);
}

static tl_result replace_tiles(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_tile *tile = level->tiles.tiles[0];
    tl_navmesh *navmesh = NULL;
    tl_nav_tile_stack stack;
    memset(&stack, 0, sizeof stack);
    tl_result result = make_navmesh(run, &navmesh);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_replace_tiles(CONTRACT_INPUT(run, 0, navmesh), tile->tile_x, tile->tile_z,
                                          CONTRACT_INPUT(run, 1, &stack));
        run->answer = tl_navmesh_tile_count(navmesh);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result resolve(contract_run *run)
{
    const contract_nav nav = contract_nav_begin(run);
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    const tl_result result = tl_navmesh_resolve(nav.navmesh, nav.here.polygon, CONTRACT_OUTPUT(run, 0, &tile),
                                                CONTRACT_OUTPUT(run, 1, &polygon));
    run->is_clear = tile == NULL && polygon == 0;
    run->answer = polygon;
    return result;
}

static tl_result links(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    tl_nav_link found[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result;
    do {
        result = tl_navmesh_links(nav.navmesh, nav.here.polygon, nav.capacity > 0 ? found : NULL, nav.capacity,
                                  CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &count, sizeof count);
    run->answer = count;
    return result;
}

static tl_result island(contract_run *run)
{
    const contract_nav nav = contract_nav_begin(run);
    uint32_t number = 0;
    const tl_result result = tl_navmesh_island(nav.navmesh, nav.here.polygon, CONTRACT_OUTPUT(run, 0, &number));
    run->is_clear = contract_nav_is_clear(run, result, &number, sizeof number);
    run->answer = number;
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Off-mesh links.

static tl_nav_offmesh offmesh_of_level(void)
{
    const contract_level *level = contract_level_get();
    tl_nav_offmesh offmesh = tl_default_nav_offmesh();
    offmesh.start = level->here;
    offmesh.end = level->there;
    return offmesh;
}

static tl_result default_offmesh(contract_run *run)
{
    run->is_clear = true;
    return tl_default_nav_offmesh().cookie == TL_DEF_COOKIE ? TL_OK : TL_ERR_ARGUMENT;
}

static tl_result add_offmesh(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_nav_ref link = TL_NAV_NO_REF;
    tl_nav_offmesh offmesh = offmesh_of_level();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&offmesh, 0, sizeof offmesh);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        float *const fields[5] = { &offmesh.start.y, &offmesh.end.z, &offmesh.radius, &offmesh.cost_factor,
                                   &offmesh.fixed_cost };
        if (run->variant < 5) {
            *fields[run->variant] = run->variant < 3 ? NAN : -1.0f;
        } else {
            offmesh.flags = 0;
        }
    }
    tl_result result = make_navmesh(run, &navmesh);
    if (result == TL_OK) {
        result = tl_navmesh_add_offmesh(CONTRACT_INPUT(run, 0, navmesh), CONTRACT_INPUT(run, 1, &offmesh),
                                        CONTRACT_OUTPUT(run, 0, &link), run->report);
    }
    run->is_clear = link == TL_NAV_NO_REF;
    run->answer = link;
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result reserve_offmesh(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_result result = make_navmesh(run, &navmesh);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_reserve_offmesh(CONTRACT_INPUT(run, 0, navmesh), 100);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

// A navmesh with one link.
static tl_result make_linked(const contract_run *run, tl_navmesh **navmesh_out, tl_nav_ref *link_out)
{
    const tl_nav_offmesh offmesh = offmesh_of_level();
    tl_result result = make_navmesh(run, navmesh_out);
    if (result == TL_OK) {
        result = tl_navmesh_add_offmesh(*navmesh_out, &offmesh, link_out, NULL);
    }
    if (run->what == CONTRACT_STALE) {
        *link_out = 77;
    }
    return result;
}

static tl_result remove_offmesh(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_nav_ref link = TL_NAV_NO_REF;
    tl_result result = make_linked(run, &navmesh, &link);
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_navmesh_remove_offmesh(CONTRACT_INPUT(run, 0, navmesh), link);
        run->answer = tl_navmesh_offmesh_count(navmesh);
    }
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result offmesh_state(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_nav_ref link = TL_NAV_NO_REF;
    tl_nav_offmesh_state state;
    memset(&state, 0, sizeof state);
    tl_result result = make_linked(run, &navmesh, &link);
    if (result == TL_OK) {
        result = tl_navmesh_offmesh_state(CONTRACT_INPUT(run, 0, navmesh), link, CONTRACT_OUTPUT(run, 0, &state));
    }
    run->is_clear = contract_nav_is_clear(run, result, &state, sizeof state);
    run->answer = state.anchored;
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result offmesh_from(contract_run *run)
{
    tl_navmesh *navmesh = NULL;
    tl_nav_ref link = TL_NAV_NO_REF, found[CONTRACT_CAPACITY];
    contract_nav nav = contract_nav_begin(run);
    uint32_t count = 0;
    tl_result result = make_linked(run, &navmesh, &link);
    if (result == TL_OK) {
        do {
            result =
                tl_navmesh_offmesh_from(CONTRACT_INPUT(run, 0, navmesh), nav.here.polygon,
                                        nav.capacity > 0 ? found : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
        } while (contract_nav_shorten(run, count, &nav));
    }
    run->is_clear = contract_nav_is_clear(run, result, &count, sizeof count);
    run->answer = count;
    tl_navmesh_destroy(navmesh);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Filters, points and polygons.

static tl_result default_filter(contract_run *run)
{
    run->is_clear = true;
    return tl_default_nav_filter().cookie == TL_DEF_COOKIE ? TL_OK : TL_ERR_ARGUMENT;
}

static tl_result filter_passes(contract_run *run)
{
    const contract_nav nav = contract_nav_begin(run);
    const contract_level *level = contract_level_get();
    run->is_clear = true;
    run->answer = tl_nav_filter_passes(contract_nav_filter(run, &nav), level->tiles.tiles[0], 0);
    return TL_OK;
}

static tl_result find_nearest(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const contract_nav nav = contract_nav_begin(run);
    tl_nav_location found;
    memset(&found, 0, sizeof found);
    const tl_result result = tl_navmesh_find_nearest(nav.navmesh, contract_nav_filter(run, &nav),
                                                     run->what == CONTRACT_NOT_FOUND ? level->nowhere : level->here,
                                                     EXTENTS, CONTRACT_OUTPUT(run, 0, &found));
    run->is_clear = contract_nav_is_clear(run, result, &found, sizeof found);
    run->answer = found.polygon;
    return result;
}

static tl_result find_nearest_reachable(contract_run *run)
{
    const contract_level *level = contract_level_get();
    contract_nav nav = contract_nav_begin(run);
    if (run->what == CONTRACT_NOT_FOUND) {
        nav.own_filter.include_flags = 0;
    }
    tl_nav_location found;
    memset(&found, 0, sizeof found);
    const tl_result result = tl_navmesh_find_nearest_reachable(
        nav.navmesh, contract_nav_filter(run, &nav), nav.here.polygon, level->nowhere, CONTRACT_OUTPUT(run, 0, &found));
    run->is_clear = contract_nav_is_clear(run, result, &found, sizeof found);
    run->answer = found.polygon;
    return result;
}

static tl_result closest_point(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const contract_nav nav = contract_nav_begin(run);
    tl_vec3 point = { 0, 0, 0 };
    const tl_result result =
        tl_navmesh_closest_point(nav.navmesh, nav.here.polygon, level->there, CONTRACT_OUTPUT(run, 0, &point), NULL);
    run->is_clear = contract_nav_is_clear(run, result, &point, sizeof point);
    run->answer = contract_hash(&point, sizeof point, 0);
    return result;
}

static tl_result height(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const contract_nav nav = contract_nav_begin(run);
    float y = 0.0f;
    const tl_result result =
        tl_navmesh_height(nav.navmesh, nav.here.polygon, level->there.x, level->there.z, CONTRACT_OUTPUT(run, 0, &y));
    run->is_clear = contract_nav_is_clear(run, result, &y, sizeof y);
    run->answer = contract_hash(&y, sizeof y, 0);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// The query object.

static tl_result default_query_def(contract_run *run)
{
    run->is_clear = true;
    return tl_default_nav_query_def().cookie == TL_DEF_COOKIE ? TL_OK : TL_ERR_ARGUMENT;
}

static tl_result query_create(contract_run *run)
{
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    def.allocator = run->host->allocator;
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.max_nodes = 1;
    }
    const tl_result result =
        tl_nav_query_create(run->what == CONTRACT_NULL_DEF ? NULL : &def, CONTRACT_OUTPUT(run, 0, &query), run->report);
    run->is_clear = query == NULL;
    tl_nav_query_destroy(query);
    return result;
}

static tl_result query_destroy(contract_run *run)
{
    run->is_clear = true;
    tl_nav_query_destroy(NULL);
    return TL_OK;
}

static tl_result query_reserve(contract_run *run)
{
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    def.allocator = run->host->allocator;
    tl_result result = tl_nav_query_create(&def, &query, NULL);
    if (result == TL_OK) {
        result = tl_nav_query_reserve(run->what == CONTRACT_NULL_INPUT ? NULL : query, 2048);
    }
    run->is_clear = true;
    tl_nav_query_destroy(query);
    return result;
}

#define GOOD      CONTRACT_BIT(GOOD)
#define INPUT     CONTRACT_BIT(NULL_INPUT)
#define OUTPUT    CONTRACT_BIT(NULL_OUTPUT)
#define NO_MEMORY CONTRACT_BIT(NO_MEMORY)
#define STALE     CONTRACT_BIT(STALE)
#define NOT_FOUND CONTRACT_BIT(NOT_FOUND)
#define DEF       (CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF))
#define BUFFERED  (CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER))
#define RETURNS   "returns a value of a navmesh that must be given"

static const char *const OFFMESH_FIELDS[] = { "start", "end", "radius", "cost_factor", "fixed_cost", "flags", NULL };
static const char *const QUERY_FIELDS[] = { "max_nodes", NULL };

const contract_entry CONTRACT_TABLE_nav_query[] = {
    { "tl_navmesh_create", GOOD | CONTRACT_BIT(NULL_DEF) | OUTPUT | NO_MEMORY, 0, 1, NULL, create, NULL },
    { "tl_navmesh_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, destroy, NULL },
    { "tl_navmesh_reserve_tiles", GOOD | INPUT | NO_MEMORY, 1, 0, NULL, reserve_tiles, NULL },
    { "tl_navmesh_add_tile", GOOD | INPUT | NO_MEMORY, 2, 0, NULL, add_tile, NULL },
    { "tl_navmesh_add_tiles", GOOD | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(BAD_BYTES) | INPUT | NO_MEMORY, 2, 0,
      NULL, add_tiles, NULL },
    { "tl_navmesh_remove_tile", GOOD | NOT_FOUND | INPUT, 1, 0, NULL, remove_tile, NULL },
    { "tl_navmesh_remove_layer", GOOD | NOT_FOUND | INPUT, 1, 0, NULL, remove_layer, NULL },
    { "tl_navmesh_replace_tiles", GOOD | INPUT, 2, 0, NULL, replace_tiles, NULL },
    { "tl_navmesh_find_tile", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_find_layer", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_tile_count", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_slot_count", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_slot_tile", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_edit_count", 0, 0, 0, NULL, NULL, RETURNS ": test_crowd_agents.c" },
    { "tl_navmesh_link_count", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_polygon_ref", 0, 0, 0, NULL, NULL, RETURNS ": test_tile_table.c" },
    { "tl_navmesh_resolve", GOOD | INPUT | STALE, 1, 0, NULL, resolve, NULL },
    { "tl_navmesh_links", GOOD | INPUT | OUTPUT | STALE | BUFFERED, 1, 1, NULL, links, NULL },
    { "tl_navmesh_island", GOOD | INPUT | OUTPUT | STALE, 1, 1, NULL, island, NULL },
    { "tl_default_nav_offmesh", GOOD, 0, 0, NULL, default_offmesh, NULL },
    { "tl_navmesh_add_offmesh",
      GOOD | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) | INPUT | OUTPUT |
          NO_MEMORY,
      2, 1, OFFMESH_FIELDS, add_offmesh, NULL },
    { "tl_navmesh_reserve_offmesh", GOOD | INPUT | NO_MEMORY, 1, 0, NULL, reserve_offmesh, NULL },
    { "tl_navmesh_remove_offmesh", GOOD | INPUT | STALE, 1, 0, NULL, remove_offmesh, NULL },
    { "tl_navmesh_offmesh_state", GOOD | INPUT | OUTPUT | STALE, 1, 1, NULL, offmesh_state, NULL },
    { "tl_navmesh_offmesh_count", 0, 0, 0, NULL, NULL, RETURNS ": test_offmesh_table.c" },
    { "tl_navmesh_next_offmesh", 0, 0, 0, NULL, NULL, RETURNS ": test_offmesh_table.c" },
    { "tl_navmesh_offmesh_from", GOOD | INPUT | OUTPUT | STALE | BUFFERED, 1, 1, NULL, offmesh_from, NULL },
    { "tl_default_nav_filter", GOOD, 0, 0, NULL, default_filter, NULL },
    { "tl_nav_filter_passes", GOOD | CONTRACT_BIT(NULL_DEF), 0, 0, NULL, filter_passes, NULL },
    { "tl_navmesh_find_nearest", GOOD | DEF | NOT_FOUND | INPUT | OUTPUT, 1, 1, NULL, find_nearest, NULL },
    { "tl_navmesh_find_nearest_reachable", GOOD | DEF | NOT_FOUND | STALE | INPUT | OUTPUT, 1, 1, NULL,
      find_nearest_reachable, NULL },
    { "tl_navmesh_closest_point", GOOD | STALE | INPUT | OUTPUT, 1, 1, NULL, closest_point, NULL },
    { "tl_navmesh_height", GOOD | STALE | INPUT | OUTPUT, 1, 1, NULL, height, NULL },
    { "tl_default_nav_query_def", GOOD, 0, 0, NULL, default_query_def, NULL },
    { "tl_nav_query_create", GOOD | CONTRACT_BIT(NULL_REPORT) | DEF | CONTRACT_BIT(BAD_FIELD) | OUTPUT | NO_MEMORY, 0,
      1, QUERY_FIELDS, query_create, NULL },
    { "tl_nav_query_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, query_destroy, NULL },
    { "tl_nav_query_reserve", GOOD | INPUT | NO_MEMORY, 1, 0, NULL, query_reserve, NULL },
    { 0 },
};
