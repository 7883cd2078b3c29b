// SPDX-License-Identifier: MIT
//
// nav_around.h.

#include "contract_nav.h"

static const uint64_t RANDOM[4] = { 0x0123456789abcdefu, 0xfedcba9876543210u, 0x5555555555555555u,
                                    0x3333333333333333u };

static tl_result zone_circle(contract_run *run)
{
    const tl_nav_zone zone = tl_nav_zone_circle(tl_vec3_make(1, 2, 3), 4.0f);
    TEST_CHECK(zone.center.x == 1.0f && zone.radius == 4.0f && zone.points == NULL);
    run->is_clear = true;
    return TL_OK;
}

static tl_result zone_polygon(contract_run *run)
{
    const tl_vec3 points[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
    const tl_nav_zone zone = tl_nav_zone_polygon(points, 3);
    TEST_CHECK(zone.points == points && zone.point_count == 3);
    run->is_clear = true;
    return TL_OK;
}

static tl_result find_polygons(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_zone zone = tl_nav_zone_circle(nav.here.point, 6.0f);
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result = TL_OK;
    do {
        result =
            tl_navmesh_find_polygons(nav.navmesh, contract_nav_filter(run, &nav), CONTRACT_INPUT(run, 1, &zone), NULL,
                                     nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0;
    run->answer = contract_hash(polygons, result == TL_OK ? count * sizeof *polygons : 0, 0);
    return result;
}

static tl_result default_field_def(contract_run *run)
{
    const tl_nav_field_def def = tl_default_nav_field_def();
    TEST_CHECK(def.cookie == TL_DEF_COOKIE && isinf(def.max_cost));
    run->is_clear = true;
    return TL_OK;
}

static tl_result flood(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    tl_nav_field_def def = tl_default_nav_field_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    static tl_nav_field_entry entries[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result = TL_OK;
    do {
        result = tl_nav_query_flood(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &nav.here),
                                    run->what == CONTRACT_NULL_DEF ? NULL : &def, nav.capacity > 0 ? entries : NULL,
                                    nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0 || result == TL_ERR_NODES;
    run->answer = count;
    return result;
}

// A field by reference; returns the number of its entries.
static uint32_t make_field(tl_nav_field_entry entries[CONTRACT_CAPACITY])
{
    const contract_level *level = contract_level_get();
    const tl_nav_location start = contract_nav_location(level->here);
    tl_nav_field_def def = tl_default_nav_field_def();
    def.by_reference = true;
    uint32_t count = 0;
    TEST_RESULT(tl_nav_query_flood(level->query, level->navmesh, &start, &def, entries, CONTRACT_CAPACITY, &count),
                TL_OK);
    return count;
}

static tl_result field_find(contract_run *run)
{
    tl_nav_field_entry entries[CONTRACT_CAPACITY];
    const uint32_t count = make_field(entries);
    TEST_CHECK(tl_nav_field_find(entries, count, entries[count / 2].polygon) == count / 2);
    TEST_CHECK(tl_nav_field_find(NULL, 0, 1) == UINT32_MAX);
    run->is_clear = true;
    return TL_OK;
}

static tl_result field_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    tl_nav_field_entry entries[CONTRACT_CAPACITY];
    const uint32_t entry_count = make_field(entries);
    const uint32_t goal =
        run->what == CONTRACT_NOT_FOUND ? UINT32_MAX : tl_nav_field_find(entries, entry_count, nav.there.polygon);
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result = TL_OK;
    do {
        result = tl_nav_field_path(CONTRACT_INPUT(run, 0, entries), entry_count, goal,
                                   nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0;
    return result;
}

static tl_result find_goal_tree(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    static tl_nav_goal_entry entries[CONTRACT_CAPACITY];
    tl_nav_goal_tree tree = { nav.capacity > 0 ? entries : NULL, nav.capacity, 0, nav.here };
    const tl_result result = tl_nav_query_find_goal_tree(nav.query, nav.navmesh, contract_nav_filter(run, &nav),
                                                         CONTRACT_INPUT(run, 2, &tree));
    run->is_clear = tree.count == 0 || result == TL_ERR_NODES;
    run->answer = tree.count;
    if (run->what == CONTRACT_GOOD) {
        tree.capacity = 1;
        TEST_RESULT(tl_nav_query_find_goal_tree(nav.query, nav.navmesh, NULL, &tree), TL_INCOMPLETE);
        TEST_CHECK(tree.count == 1 && entries[0].polygon == nav.here.polygon);
        tree.goal.point.x = NAN;
        TEST_RESULT(tl_nav_query_find_goal_tree(nav.query, nav.navmesh, NULL, &tree), TL_ERR_NOT_FINITE);
    }
    return result;
}

static tl_result goal_tree_path(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const contract_level *level = contract_level_get();
    static tl_nav_goal_entry entries[CONTRACT_CAPACITY];
    tl_nav_goal_tree tree = { entries, CONTRACT_CAPACITY, 0, nav.there };
    TEST_RESULT(tl_nav_query_find_goal_tree(level->query, level->navmesh, NULL, &tree), TL_OK);
    tree.count = run->what == CONTRACT_NOT_FOUND ? 0 : tree.count;
    const tl_nav_goal_path_request request = { contract_nav_filter(run, &nav), nav.here, 0 };
    tl_nav_ref polygons[CONTRACT_CAPACITY];
    tl_nav_path path;
    memset(&path, 0, sizeof path);
    tl_result result = TL_OK;
    do {
        result =
            tl_nav_goal_tree_path(CONTRACT_INPUT(run, 1, &tree), nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                  nav.capacity > 0 ? polygons : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.polygon_count, &nav));
    run->is_clear = contract_is_zero(&path, sizeof path);
    run->answer = contract_hash(polygons, result == TL_OK ? path.polygon_count * sizeof *polygons : 0, 0);
    return result;
}

// A polygon that has a wall.
static tl_nav_ref walled_polygon(void)
{
    const contract_level *level = contract_level_get();
    const tl_nav_around_request request = { NULL, contract_nav_location(level->here), 20.0f };
    tl_nav_wall wall;
    TEST_RESULT(tl_nav_query_find_wall(level->query, level->navmesh, &request, &wall), TL_OK);
    TEST_CHECK(wall.hit);
    return wall.polygon;
}

static tl_result polygon_walls(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_ref polygon = run->what == CONTRACT_STALE ? nav.here.polygon : walled_polygon();
    tl_nav_wall_segment segments[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result = TL_OK;
    do {
        result =
            tl_navmesh_polygon_walls(nav.navmesh, contract_nav_filter(run, &nav), polygon,
                                     nav.capacity > 0 ? segments : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0;
    run->answer = count;
    return result;
}

static tl_result find_walls(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_around_request request = { contract_nav_filter(run, &nav), nav.here, 20.0f };
    tl_nav_wall_segment segments[CONTRACT_CAPACITY];
    uint32_t count = 0;
    tl_result result = TL_OK;
    do {
        result =
            tl_nav_query_find_walls(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                    nav.capacity > 0 ? segments : NULL, nav.capacity, CONTRACT_OUTPUT(run, 0, &count));
    } while (contract_nav_shorten(run, count, &nav));
    run->is_clear = count == 0 || result == TL_ERR_NODES;
    run->answer = count;
    return result;
}

static tl_result random_point(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    if (run->what == CONTRACT_NOT_FOUND) {
        nav.own_filter.include_flags = 0;
    }
    tl_nav_location location;
    memset(&location, 0, sizeof location);
    const tl_result result =
        tl_navmesh_random_point(nav.navmesh, contract_nav_filter(run, &nav), CONTRACT_INPUT(run, 1, RANDOM),
                                CONTRACT_OUTPUT(run, 0, &location));
    run->is_clear = contract_nav_is_clear(run, result, &location, sizeof location);
    run->answer = location.polygon;
    return result;
}

static tl_result random_reachable(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_around_request request = { contract_nav_filter(run, &nav), nav.here, 8.0f };
    tl_nav_location location;
    memset(&location, 0, sizeof location);
    const tl_result result =
        tl_nav_query_random_reachable(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                      CONTRACT_INPUT(run, 3, RANDOM), CONTRACT_OUTPUT(run, 0, &location));
    run->is_clear = contract_nav_is_clear(run, result, &location, sizeof location);
    run->answer = location.polygon;
    return result;
}

static tl_result random_reachable_points(contract_run *run)
{
    contract_nav nav = contract_nav_begin(run);
    const tl_nav_around_request request = { contract_nav_filter(run, &nav), nav.here, 8.0f };
    tl_nav_location locations[2];
    memset(locations, 0, sizeof locations);
    const tl_result result =
        tl_nav_query_random_reachable_points(nav.query, nav.navmesh, CONTRACT_INPUT(run, 2, &request),
                                             CONTRACT_INPUT(run, 3, RANDOM), 2, CONTRACT_OUTPUT(run, 0, locations));
    run->is_clear = contract_nav_is_clear(run, result, locations, sizeof locations);
    run->answer = locations[0].polygon * 3 + locations[1].polygon;
    return result;
}

#define FILTERED                                                                                                       \
    (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT) |               \
     CONTRACT_BIT(NULL_OUTPUT))
#define AROUND   (FILTERED | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_NODES))
#define BUFFERED (CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER))

const contract_entry CONTRACT_TABLE_nav_around[] = {
    { "tl_nav_zone_circle", CONTRACT_BIT(GOOD), 0, 0, NULL, zone_circle, NULL },
    { "tl_nav_zone_polygon", CONTRACT_BIT(GOOD), 0, 0, NULL, zone_polygon, NULL },
    { "tl_navmesh_find_polygons", FILTERED | BUFFERED, 2, 1, NULL, find_polygons, NULL },
    { "tl_default_nav_field_def", CONTRACT_BIT(GOOD), 0, 0, NULL, default_field_def, NULL },
    { "tl_nav_query_flood", AROUND | BUFFERED, 3, 1, NULL, flood, NULL },
    { "tl_nav_field_find", CONTRACT_BIT(GOOD), 0, 0, NULL, field_find, NULL },
    { "tl_nav_field_path",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND) | BUFFERED, 1,
      1, NULL, field_path, NULL },
    { "tl_nav_query_find_goal_tree",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_NODES),
      3, 0, NULL, find_goal_tree, NULL },
    { "tl_nav_goal_tree_path", FILTERED | CONTRACT_BIT(STALE) | CONTRACT_BIT(NOT_FOUND) | BUFFERED, 3, 1, NULL,
      goal_tree_path, NULL },
    { "tl_navmesh_polygon_walls", FILTERED | CONTRACT_BIT(STALE) | BUFFERED, 1, 1, NULL, polygon_walls, NULL },
    { "tl_nav_query_find_walls", AROUND | BUFFERED, 3, 1, NULL, find_walls, NULL },
    { "tl_navmesh_random_point", FILTERED | CONTRACT_BIT(NOT_FOUND), 2, 1, NULL, random_point, NULL },
    { "tl_nav_query_random_reachable", AROUND, 4, 1, NULL, random_reachable, NULL },
    { "tl_nav_query_random_reachable_points", AROUND, 4, 1, NULL, random_reachable_points, NULL },
    { 0 },
};
