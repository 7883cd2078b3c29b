// SPDX-License-Identifier: MIT
//
// nav_query.h, its second half: paths, rays, moves, routes. contract_nav_query.c has the first.

#include "contract_nav.h"

// Over a border of tiles from the level's `here`.
static const tl_vec3 BESIDE = { 4, 0, 2 };

static tl_result find_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_path_request request = { contract_nav_filter(run, &nav), nav.here, nav.there };
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_path path;
    memset(&path, 0, sizeof path);
    tl_result result = TL_OK;
    do {
        result =
            tl_nav_query_find_path(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                   nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.polygon_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = contract_hash(polygons, result == TL_OK ? path.polygon_count * sizeof *polygons : 0, 0);
    return result;
}

static tl_result begin_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_path_request request = { contract_nav_filter(run, &nav), nav.here, nav.there };
    const tl_result result = tl_nav_query_begin_path(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request));
    run->is_clear = true;
    tl_nav_path_progress progress = { TL_NAV_PATH_NONE, 0, 0, 0 };
    if (result == TL_OK) {
        TEST_RESULT(tl_nav_query_step_path(nav.query, UINT32_MAX, &progress), TL_OK);
    }
    run->answer = progress.node_count;
    return result;
}

// A search under way; none in CONTRACT_STALE.
static void begin_or_end(const contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_path_request request = { NULL, contract_nav_location(level->here),
                                          contract_nav_location(level->there) };
    tl_nav_path path;
    if (run->what == CONTRACT_STALE) {
        TEST_RESULT(tl_nav_query_find_path(level->query, level->navmesh, &request, NULL, 0, &path), TL_INCOMPLETE);
    } else {
        TEST_RESULT(tl_nav_query_begin_path(level->query, level->navmesh, &request), TL_OK);
    }
}

static tl_result step_path(contract_run *run)
{
    begin_or_end(run);
    tl_nav_path_progress progress;
    memset(&progress, 0, sizeof progress);
    const tl_result result = tl_nav_query_step_path(CONTRACT_INPUT(run, 0, contract_level_get()->query), UINT32_MAX,
                                                    CONTRACT_OUTPUT(run, 0, &progress));
    run->is_clear = contract_nav_is_clear(run, result, &progress, sizeof progress);
    return result;
}

static tl_result write_path(contract_run *run)
{
    begin_or_end(run);
    contract_nav nav = contract_nav_begin(run);
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_path path;
    memset(&path, 0, sizeof path);
    tl_nav_path_progress progress;
    const tl_result stepped = tl_nav_query_step_path(contract_level_get()->query, UINT32_MAX, &progress);
    TEST_CHECK(stepped == (run->what == CONTRACT_STALE ? TL_ERR_STALE : TL_OK));
    tl_result result = TL_OK;
    do {
        result =
            tl_nav_query_write_path(CONTRACT_INPUT(run, 0, contract_level_get()->query),
                                    nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.polygon_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    return result;
}

static tl_result shortest_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_path_request request = { contract_nav_filter(run, &nav), nav.here, nav.there };
    tl_nav_corner corners[CONTRACT_CAPACITY];
    tl_nav_shortest_path path;
    memset(&path, 0, sizeof path);
    tl_result result = TL_OK;
    do {
        const tl_nav_path_buffers buffers = { NULL, 0, corners, nav.capacity };
        result = tl_nav_query_find_shortest_path(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request), &buffers,
                                                 CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.corner_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = (uint64_t)(path.length * 1e9);
    return result;
}

// The polygons and corners of a path from here to there.
typedef struct known_path {
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_corner corners[CONTRACT_CAPACITY];
    tl_nav_shortest_path path;
} known_path;

static void make_path(const contract_run *run, known_path *known)
{
    const contract_level *level = contract_level_get();
    const tl_nav_path_request request = { NULL, contract_nav_location(level->here),
                                          contract_nav_location(level->there) };
    const tl_nav_path_buffers buffers = { known->polygons, CONTRACT_CAPACITY, known->corners, CONTRACT_CAPACITY };
    TEST_RESULT(tl_nav_query_find_shortest_path(level->query, level->navmesh, &request, &buffers, &known->path), TL_OK);
    TEST_CHECK(known->path.status == TL_NAV_PATH_COMPLETE && known->path.polygon_count > 1);
    if (run->what == CONTRACT_STALE) {
        known->polygons[0] = level->stale;
    }
}

static tl_result straight_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    known_path known;
    make_path(run, &known);
    const tl_nav_polygon_path path = { CONTRACT_INPUT(run, 2, known.polygons), known.path.polygon_count, nav.here.point,
                                       nav.there.point };
    tl_nav_corner corners[CONTRACT_CAPACITY];
    uint32_t count = 0;
    float length = 0.0f;
    tl_result result = TL_OK;
    do {
        result = tl_navmesh_straight_path(nav.navmesh, CONTRACT_INPUT(run, 1, &path), nav.capacity > 0 ? corners : NULL,
                                          nav.capacity, CONTRACT_OUTPUT(run, 0, &count), &length);
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0 && length == 0.0f;
    return result;
}

static tl_result trace_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    known_path known;
    make_path(run, &known);
    const tl_nav_trace_request request = { contract_nav_filter(run, &nav), CONTRACT_INPUT(run, 2, known.polygons),
                                           known.path.polygon_count,       CONTRACT_INPUT(run, 3, known.corners),
                                           known.path.corner_count,        TL_NAV_CORNER_CROSSING };
    tl_nav_trace_point points[CONTRACT_CAPACITY];
    uint32_t count = 0;
    float cost = 0.0f;
    tl_result result = TL_OK;
    do {
        result = tl_navmesh_trace_path(nav.navmesh, CONTRACT_INPUT(run, 1, &request), nav.capacity > 0 ? points : NULL,
                                       nav.capacity, CONTRACT_OUTPUT(run, 0, &count), &cost);
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0 && cost == 0.0f;
    run->answer = count;
    return result;
}

static tl_result cast_ray(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_ray_hit hit;
    memset(&hit, 0, sizeof hit);
    tl_result result = TL_OK;
    do {
        result =
            tl_navmesh_cast_ray(nav.navmesh, contract_nav_filter(run, &nav), CONTRACT_INPUT(run, 1, &nav.here), BESIDE,
                                nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &hit));
    } while (contract_nav_shorten(run, hit.polygon_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &hit, sizeof hit);
    run->answer = (uint64_t)(hit.t * 1e6f);
    return result;
}

static tl_result move_along_surface(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_move_request request = { contract_nav_filter(run, &nav), nav.here, BESIDE };
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_move move;
    memset(&move, 0, sizeof move);
    tl_result result = TL_OK;
    do {
        result = tl_nav_query_move_along_surface(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                                 nav.capacity > 0 ? polygons : NULL, nav.capacity,
                                                 CONTRACT_OUTPUT(run, 0, &move));
    } while (contract_nav_shorten(run, move.polygon_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &move, sizeof move);
    run->answer = move.end.polygon;
    return result;
}

static tl_result find_wall(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_around_request request = { contract_nav_filter(run, &nav), nav.here, 20.0f };
    tl_nav_wall wall;
    memset(&wall, 0, sizeof wall);
    const tl_result result = tl_nav_query_find_wall(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                                    CONTRACT_OUTPUT(run, 0, &wall));
    run->is_clear = contract_nav_is_clear(run, result, &wall, sizeof wall);
    run->answer = (uint64_t)(wall.distance * 1e6f);
    return result;
}

static tl_result find_route(contract_run *run)
{
    const contract_level *level = contract_level_get();
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_route_request request = { contract_nav_filter(run, &nav), level->here,
                                           run->what == CONTRACT_NOT_FOUND ? level->nowhere : level->there,
                                           tl_vec3_make(1, 1, 1) };
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_corner corners[CONTRACT_CAPACITY];
    tl_nav_route route;
    memset(&route, 0, sizeof route);
    tl_result result = TL_OK;
    do {
        const tl_nav_path_buffers buffers = { polygons, CONTRACT_CAPACITY, corners, nav.capacity };
        result =
            tl_nav_query_find_route(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                    run->what == CONTRACT_NO_BUFFER ? NULL : &buffers, CONTRACT_OUTPUT(run, 0, &route));
    } while (contract_nav_shorten(run, route.corner_count, &nav));
    run->is_clear = contract_nav_is_clear(run, result, &route, sizeof route);
    run->answer = (uint64_t)(route.length * 1e6f);
    return result;
}

#define FILTERED                                                                                                       \
    (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT) |               \
     CONTRACT_BIT(STALE))
#define BUFFERED (CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER))
#define OUTPUT   CONTRACT_BIT(NULL_OUTPUT)

const contract_entry CONTRACT_TABLE_nav_paths[] = {
    { "tl_nav_path_status_name", 0, 0, 0, NULL, NULL, "a constant text for every number: test_find_path.c" },
    { "tl_nav_query_find_path", FILTERED | BUFFERED | OUTPUT, 3, 1, NULL, find_path, NULL },
    { "tl_nav_query_begin_path", FILTERED, 3, 0, NULL, begin_path, NULL },
    { "tl_nav_query_step_path", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | OUTPUT, 1, 1,
      NULL, step_path, NULL },
    { "tl_nav_query_write_path",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | BUFFERED | OUTPUT, 1, 1, NULL, write_path,
      NULL },
    { "tl_navmesh_straight_path",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE) | BUFFERED | OUTPUT, 3, 1, NULL,
      straight_path, NULL },
    { "tl_navmesh_trace_path", FILTERED | BUFFERED | OUTPUT, 4, 1, NULL, trace_path, NULL },
    { "tl_nav_query_find_shortest_path", FILTERED | CONTRACT_BIT(SHORT_BUFFER) | OUTPUT, 3, 1, NULL, shortest_path,
      NULL },
    { "tl_navmesh_cast_ray", FILTERED | CONTRACT_BIT(SHORT_BUFFER) | OUTPUT, 2, 1, NULL, cast_ray, NULL },
    { "tl_nav_query_move_along_surface", FILTERED | CONTRACT_BIT(SHORT_BUFFER) | CONTRACT_BIT(NO_NODES) | OUTPUT, 3, 1,
      NULL, move_along_surface, NULL },
    { "tl_nav_query_find_wall", FILTERED | CONTRACT_BIT(NO_NODES) | OUTPUT, 3, 1, NULL, find_wall, NULL },
    { "tl_nav_query_find_route",
      (FILTERED & ~CONTRACT_BIT(STALE)) | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(SHORT_BUFFER) | OUTPUT, 3, 1, NULL,
      find_route, NULL },
    { 0 },
};
