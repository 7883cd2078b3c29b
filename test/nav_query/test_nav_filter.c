// SPDX-License-Identifier: MIT
//
// Filters with functions: they answer as flags and area costs do where those can say the same.

#include "nav_fixture.h"

#include "nav_query/filter/nav_filter.h"

enum { MAX_POLYGONS = 512 };

// Refuses polygons by their number, as flags cannot; counts its calls.
typedef struct rule {
    uint32_t calls;
} rule;

static bool pass_max(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    ((rule *)user)->calls++;
    return fixture_hash((uint64_t)(uint32_t)(tile->tile_x * 64 + tile->tile_z), polygon) % 5 != 0;
}

static float cost_of_area(uint32_t area)
{
    return 1.0f + (float)(area % 3);
}

// What a filter's area costs would say.
static float cost_by_area(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 from, tl_vec3 to, float cost, void *user)
{
    TEST_CHECK(cost == tl_distance(from, to));
    ((rule *)user)->calls++;
    return cost_of_area(tl_nav_tile_area(tile, polygon)) * tl_distance(from, to);
}

static float cost_or_refuse(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 from, tl_vec3 to, float cost, void *user)
{
    static const float no[] = { -1.0f, INFINITY, NAN };
    (void)from;
    (void)to;
    return pass_max(tile, polygon, user) ? cost : no[polygon % 3];
}

// What hangs together over links, through polygons that pass_max lets through.
static bool is_reachable(const tl_navmesh *navmesh, const fixture_refs *all, uint32_t from, uint32_t to, rule *r)
{
    bool *reached = calloc(all->count, sizeof *reached);
    uint32_t *queue = calloc(all->count, sizeof *queue), count = 1;
    queue[0] = from;
    reached[from] = true;
    for (uint32_t at = 0; at < count; at++) {
        tl_nav_link links[64];
        uint32_t n = 0;
        TEST_RESULT(tl_navmesh_links(navmesh, all->refs[queue[at]], links, 64, &n), TL_OK);
        for (uint32_t k = 0; k < n; k++) {
            const tl_nav_tile *tile = NULL;
            uint32_t polygon = 0, index = fixture_index_of(all, links[k].to);
            TEST_RESULT(tl_navmesh_resolve(navmesh, links[k].to, &tile, &polygon), TL_OK);
            if (!reached[index] && pass_max(tile, polygon, r)) {
                reached[index] = true;
                queue[count++] = index;
            }
        }
    }
    bool answer = reached[to];
    free(reached);
    free(queue);
    return answer;
}

static void test_functions(void **state)
{
    (void)state;
    test_random random = { 611 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t complete = 0, refused = 0, twins = 0;
    for (uint32_t round = 0; round < 18; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.area_count = 6;
        level.tile_cells = round % 3 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 10; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
            tl_nav_ref polygons[2][MAX_POLYGONS];
            tl_nav_path path, twin;
            rule r = { 0 };
            tl_nav_filter filter = tl_default_nav_filter();
            filter.user = &r;
            // A function that refuses: over the flags' head, exact and by A*.
            bool reachable = is_reachable(navmesh, &all, fixture_index_of(&all, start.polygon),
                                          fixture_index_of(&all, goal.polygon), &r);
            filter.pass = pass_max;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal },
                                               polygons[0], MAX_POLYGONS, &path),
                        TL_OK);
            TEST_CHECK((path.status == TL_NAV_PATH_COMPLETE) == reachable);
            for (uint32_t k = 1; k < path.polygon_count; k++) {
                const tl_nav_tile *tile = NULL;
                uint32_t polygon = 0;
                TEST_RESULT(tl_navmesh_resolve(navmesh, polygons[0][k], &tile, &polygon), TL_OK);
                TEST_CHECK(pass_max(tile, polygon, &r));
            }
            complete += reachable;
            refused += !reachable;

            // A function that knows the costs of areas, and a filter that does: the same bits.
            filter.pass = NULL;
            filter.cost = cost_by_area;
            r.calls = 0;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal },
                                               polygons[0], MAX_POLYGONS, &path),
                        TL_OK);
            TEST_CHECK(r.calls > 0 || path.node_count == 0);
            filter.cost = NULL;
            for (uint32_t area = 0; area <= TL_NAV_MAX_AREA; area++) {
                filter.area_cost[area] = cost_of_area(area);
            }
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal },
                                               polygons[1], MAX_POLYGONS, &twin),
                        TL_OK);
            TEST_CHECK(path.status == twin.status && path.cost == twin.cost && path.node_count == twin.node_count);
            TEST_CHECK(path.polygon_count == twin.polygon_count &&
                       memcmp(polygons[0], polygons[1], path.polygon_count * sizeof polygons[0][0]) == 0);
            twins += path.status == TL_NAV_PATH_COMPLETE;

            // What a function calls impossible is not gone.
            filter.cost = cost_or_refuse;
            bool start_passes = true;
            const tl_nav_tile *tile = NULL;
            uint32_t polygon = 0;
            TEST_RESULT(tl_navmesh_resolve(navmesh, start.polygon, &tile, &polygon), TL_OK);
            start_passes = pass_max(tile, polygon, &r);
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal },
                                               polygons[1], MAX_POLYGONS, &twin),
                        TL_OK);
            TEST_CHECK((twin.status == TL_NAV_PATH_COMPLETE) == (reachable && start_passes));
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(complete > 40 && refused > 40 && twins > 60);
}

static void test_plain(void **state)
{
    (void)state;
    tl_nav_filter filter = tl_default_nav_filter();
    float least = 0.0f;
    bool is_uniform = false;
    TEST_CHECK(filter.pass == NULL && filter.cost == NULL);
    TEST_CHECK(tl_nav_filter_costs(&filter, &least, &is_uniform) && is_uniform && least == 1.0f);
    filter.cost = cost_by_area;
    TEST_CHECK(tl_nav_filter_costs(&filter, &least, &is_uniform) && !is_uniform);
    filter.area_cost[3] = 0.0f;
    TEST_CHECK(!tl_nav_filter_costs(&filter, &least, &is_uniform));
}

// What is known of costs holds for the same costs alone, whichever filter has them.
static void test_known_costs(void **state)
{
    (void)state;
    tl_nav_filter filter = tl_default_nav_filter();
    tl_nav_known_costs known = { 0 };
    float least = 0.0f;
    bool is_uniform = false;
    TEST_CHECK(tl_nav_filter_costs_again(&known, &filter, &least, &is_uniform) && is_uniform && least == 1.0f);
    filter.area_cost[TL_NAV_MAX_AREA] = 0.5f;
    for (int again = 0; again < 2; again++) {
        TEST_CHECK(tl_nav_filter_costs_again(&known, &filter, &least, &is_uniform) && !is_uniform && least == 0.5f);
    }
    filter.area_cost[3] = NAN;
    for (int again = 0; again < 2; again++) {
        TEST_CHECK(!tl_nav_filter_costs_again(&known, &filter, &least, &is_uniform));
    }
    filter = tl_default_nav_filter();
    filter.cost = cost_by_area;
    TEST_CHECK(tl_nav_filter_costs_again(&known, &filter, &least, &is_uniform) && !is_uniform && least == 1.0f);
}

// Impassable in the middle, from x = 24 metres to 28.
static float cost_around_the_middle(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 from, tl_vec3 to, float cost,
                                    void *user)
{
    (void)tile;
    (void)polygon;
    (void)user;
    return from.x < 24.5f && to.x > 24.5f ? INFINITY : cost;
}

// A street two polygons wide, with dead ends on one side: paths along it leave them out, those into them do not, and
// where the street is closed the end of a dead end may be the place nearest to the goal.
static void test_dead_ends(void **state)
{
    (void)state;
    const char *const rows[2][6] = {
        { "0000000000000", "0000000000000", "#0#0#0#0#0#0#", "#0#0#0#0#0#0#", "#0#0#0#0#0#0#", "#0#0#0#0#0#0#" },
        { "0000000000000", "0000000000000", "#############", "#############", "#############", "#############" }
    };
    tl_nav_query *query = fixture_query(1024);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.area_cost[1] = 0.01f; // of no polygon: A* with an estimate that tells little, so it looks everywhere
    tl_nav_path path[2];
    for (int k = 0; k < 2; k++) {
        const fixture_level level = fixture_make(rows[k], 6);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        const tl_vec3 half = { 1, 1, 1 }, left = { 2, 0, 2 }, right = { 50, 0, 2 }, end = { 30, 0, 22 };
        tl_nav_path_request request = { &filter, { 0 }, { 0 } };
        TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, left, half, &request.start), TL_OK);
        TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, right, half, &request.goal), TL_OK);
        TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &path[k]), TL_INCOMPLETE);
        TEST_CHECK(path[k].status == TL_NAV_PATH_COMPLETE);
        if (k == 0) {
            tl_nav_path into;
            TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, end, half, &request.goal), TL_OK);
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &into), TL_INCOMPLETE);
            TEST_CHECK(into.status == TL_NAV_PATH_COMPLETE && into.cost > 40.0f);
            filter.cost = cost_around_the_middle;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &into), TL_INCOMPLETE);
            TEST_CHECK(into.status == TL_NAV_PATH_UNREACHABLE);
            TEST_CHECK(into.end.point.x == 24.0f && into.end.point.z == 22.0f);
            filter.cost = NULL;
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(path[0].cost == path[1].cost && path[0].node_count == path[1].node_count);
    tl_nav_query_destroy(query);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_functions), cmocka_unit_test(test_plain),
                                        cmocka_unit_test(test_known_costs), cmocka_unit_test(test_dead_ends) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
