// SPDX-License-Identifier: MIT
//
// Paths that may be longer than the shortest by a share: on every level, with walls by flags, links and short cuts,
// they are no longer than that, their lower bound holds, and there is one exactly when there is a shortest one.

#include "nav_fixture.h"

#include <talus/nav_corridor.h>

enum { MAX_POLYGONS = 1024, MAX_CORNERS = 512, SLACKS = 5 };

static const float g_slacks[SLACKS] = { 0.0f, 0.02f, 0.1f, 0.4f, 1.0f };

typedef struct tally {
    uint64_t pairs, complete, unreachable, longer[SLACKS], nodes[SLACKS];
} tally;

static double plan_length(const tl_nav_corner *corners, uint32_t count)
{
    double length = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        const double x = (double)corners[i].point.x - (double)corners[i - 1].point.x;
        const double z = (double)corners[i].point.z - (double)corners[i - 1].point.z;
        length += sqrt(x * x + z * z);
    }
    return length;
}

static bool takes_link(const tl_nav_corner *corners, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if ((corners[i].flags & TL_NAV_CORNER_LINK) != 0) {
            return true;
        }
    }
    return false;
}

static tl_nav_shortest_path find(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                                 tl_nav_corner *corners, tl_nav_ref *polygons)
{
    tl_nav_shortest_path path;
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, request,
                                                &(tl_nav_path_buffers){ polygons, MAX_POLYGONS, corners, MAX_CORNERS },
                                                &path),
                TL_OK);
    return path;
}

// The other searches with the same filter find the same: find_path in one piece and in slices.
static void check_two_calls(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                            const tl_nav_shortest_path *path, const tl_nav_ref *polygons)
{
    static tl_nav_ref found[MAX_POLYGONS];
    tl_nav_path at_once, cut;
    tl_nav_path_progress progress;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, request, found, MAX_POLYGONS, &at_once), TL_OK);
    TEST_CHECK(at_once.status == path->status && at_once.polygon_count == path->polygon_count);
    TEST_CHECK(memcmp(found, polygons, at_once.polygon_count * sizeof *found) == 0);
    TEST_CHECK(at_once.cost == (float)path->length);
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, request), TL_OK);
    do {
        TEST_RESULT(tl_nav_query_step_path(query, 3, &progress), TL_OK);
    } while (progress.status == TL_NAV_PATH_UNFINISHED);
    TEST_RESULT(tl_nav_query_write_path(query, found, MAX_POLYGONS, &cut), TL_OK);
    TEST_CHECK(cut.status == at_once.status && cut.polygon_count == at_once.polygon_count && cut.cost == at_once.cost);
    TEST_CHECK(memcmp(found, polygons, cut.polygon_count * sizeof *found) == 0);
}

static void check_pair(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *exact,
                       const tl_nav_location *start, const tl_nav_location *goal, tally *t)
{
    static tl_nav_corner corners[MAX_CORNERS];
    static tl_nav_ref polygons[MAX_POLYGONS];
    tl_nav_filter filter = *exact;
    const tl_nav_path_request request = { &filter, *start, *goal };
    const tl_nav_shortest_path shortest = find(query, navmesh, &request, corners, polygons);
    TEST_CHECK(shortest.status != TL_NAV_PATH_OUT_OF_NODES);
    t->pairs++;
    t->complete += shortest.status == TL_NAV_PATH_COMPLETE;
    t->unreachable += shortest.status == TL_NAV_PATH_UNREACHABLE;
    for (uint32_t i = 0; i < SLACKS; i++) {
        filter.slack = g_slacks[i];
        const tl_nav_shortest_path path = find(query, navmesh, &request, corners, polygons);
        TEST_CHECK(path.status == shortest.status);
        t->nodes[i] += path.node_count;
        if (path.status != TL_NAV_PATH_COMPLETE) {
            continue;
        }
        const double most = 1.0 + (double)filter.slack, rounding = 1e-6;
        TEST_CHECK(path.length >= shortest.length * (1.0 - rounding) - 1e-5);
        TEST_CHECK(path.length <= shortest.length * (most + rounding) + 1e-5);
        TEST_CHECK(path.lower_bound <= shortest.length * (1.0 + rounding) + 1e-5 && path.lower_bound <= path.length);
        TEST_CHECK(path.length <= path.lower_bound * (most + rounding) + 1e-5);
        TEST_CHECK(corners[0].polygon == start->polygon && polygons[path.polygon_count - 1] == goal->polygon);
        TEST_CHECK(takes_link(corners, path.corner_count) ||
                   fabs(plan_length(corners, path.corner_count) - path.length) <= 1e-9 * path.length);
        t->longer[i] += path.length > shortest.length * (1.0 + 1e-4);
        check_two_calls(query, navmesh, &request, &path, polygons);
    }
}

// Flags of polygons, of which a filter refuses one.
static void deal_flags(tl_navmesh *navmesh, test_random *random)
{
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            tl_nav_tile_set_flags((tl_nav_tile *)(uintptr_t)tile, p, test_random_below(random, 8) == 0 ? 2 : 1);
        }
    }
}

static void add_links(tl_navmesh *navmesh, const fixture_refs *all, bool are_short_cuts, test_random *random)
{
    for (uint32_t i = 0; i < 4; i++) {
        tl_nav_offmesh link = tl_default_nav_offmesh();
        tl_nav_ref ref;
        link.start = fixture_random_location(navmesh, all, random).point;
        link.end = fixture_random_location(navmesh, all, random).point;
        link.both_ways = i % 2 == 0;
        link.cost_factor = are_short_cuts ? 0.25f * (float)i : 1.0f;
        TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &link, &ref, NULL), TL_OK);
    }
}

static void test_bound(void **state)
{
    (void)state;
    test_random random = { 93 };
    tally t;
    memset(&t, 0, sizeof t);
    tl_nav_query *query = fixture_query(1 << 16);
    for (uint32_t round = 0; round < 200; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9 + round % 5);
        level.tile_cells = round % 3 == 0 ? 0 : 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_filter filter = tl_default_nav_filter();
        if (round / 6 % 4 == 1) {
            deal_flags(navmesh, &random);
            filter.exclude_flags = 2;
        } else if (round / 6 % 4 >= 2) {
            add_links(navmesh, &all, round / 6 % 4 == 3, &random);
        }
        for (uint32_t i = 0; i < 30; i++) {
            const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
            check_pair(query, navmesh, &filter, &start, &goal, &t);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(t.complete > 1500 && t.unreachable > 100);
    TEST_CHECK(t.longer[0] == 0 && t.longer[SLACKS - 1] > 50);
}

// Blocks of streets: the search looks at fewer places the more slack it has.
static void test_fewer_nodes(void **state)
{
    (void)state;
    test_random random = { 812 };
    fixture_level level;
    memset(&level, 0, sizeof level);
    level.width = level.height = 48;
    level.cell_size = 0.25f;
    level.cell_height = 0.125f;
    level.shake = 4;
    level.tile_cells = 16;
    for (uint32_t z = 0; z < level.height; z++) {
        for (uint32_t x = 0; x < level.width; x++) {
            const bool is_street = x % 4 == 0 || z % 4 == 0;
            level.cells[z][x] = is_street && test_random_below(&random, 12) != 0 ? '0' : '#';
        }
    }
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_query *query = fixture_query(1 << 18);
    const tl_nav_filter filter = tl_default_nav_filter();
    tally t;
    memset(&t, 0, sizeof t);
    for (uint32_t i = 0; i < 100; i++) {
        const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
        const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        check_pair(query, navmesh, &filter, &start, &goal, &t);
    }
    for (uint32_t i = 1; i < SLACKS; i++) {
        TEST_CHECK(t.nodes[i] < t.nodes[i - 1]);
    }
    TEST_CHECK(t.complete > 60 && 4 * t.nodes[3] < 3 * t.nodes[0]);
    tl_nav_query_destroy(query);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

// Where areas cost differently there is a path exactly when there is one without slack, and slices change nothing.
static void test_areas(void **state)
{
    (void)state;
    test_random random = { 813 };
    tl_nav_query *query = fixture_query(1 << 16);
    uint32_t complete = 0;
    double sums[2] = { 0.0, 0.0 };
    for (uint32_t round = 0; round < 36; round++) {
        fixture_level level = fixture_random(&random, round % 6, 12);
        level.tile_cells = round % 2 == 0 ? 0 : 5;
        level.area_count = 5;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 20; i++) {
            static tl_nav_ref polygons[MAX_POLYGONS];
            tl_nav_filter filter = tl_default_nav_filter();
            for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
                filter.area_cost[area] = 1.0f + (float)(area % 4);
            }
            tl_nav_path_request request = { &filter, fixture_random_location(navmesh, &all, &random),
                                            fixture_random_location(navmesh, &all, &random) };
            tl_nav_path cheap, loose, cut;
            tl_nav_path_progress progress;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, polygons, MAX_POLYGONS, &cheap), TL_OK);
            filter.slack = 0.2f;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, polygons, MAX_POLYGONS, &loose), TL_OK);
            TEST_CHECK(cheap.status == loose.status);
            TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &request), TL_OK);
            do {
                TEST_RESULT(tl_nav_query_step_path(query, 5, &progress), TL_OK);
            } while (progress.status == TL_NAV_PATH_UNFINISHED);
            TEST_RESULT(tl_nav_query_write_path(query, polygons, MAX_POLYGONS, &cut), TL_OK);
            TEST_CHECK(cut.cost == loose.cost && cut.polygon_count == loose.polygon_count);
            complete += cheap.status == TL_NAV_PATH_COMPLETE;
            sums[0] += (double)cheap.cost;
            sums[1] += (double)loose.cost;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(complete > 300 && sums[1] <= 1.2 * sums[0]);
}

static void test_refused(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    test_random random = { 814 };
    tl_nav_query *query = fixture_query(4096);
    const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
    const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
    const float bad[] = { NAN, -1e-30f, -1.0f, 1.0000001f, INFINITY, -INFINITY };
    const float good[] = { -0.0f, 1e-40f, TL_NAV_MAX_SLACK };
    for (uint32_t i = 0; i < 9; i++) {
        tl_nav_filter filter = tl_default_nav_filter();
        filter.slack = i < 6 ? bad[i] : good[i - 6];
        const tl_result expected = i < 6 ? TL_ERR_ARGUMENT : TL_OK;
        const tl_nav_path_request request = { &filter, start, goal };
        const tl_nav_route_request between = { &filter, start.point, goal.point, { 1.0f, 4.0f, 1.0f } };
        tl_nav_shortest_path shortest;
        tl_nav_path path;
        tl_nav_route route;
        tl_nav_ref room[64];
        tl_nav_corridor corridor = tl_nav_corridor_init(room, 64);
        tl_nav_corridor_reset(&corridor, &start);
        TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, NULL, &shortest), expected);
        TEST_CHECK((shortest.status == TL_NAV_PATH_NONE) == (expected != TL_OK));
        TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &request), expected);
        tl_nav_ref polygons[64];
        tl_nav_corner corners[64];
        TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, polygons, 64, &path), expected);
        TEST_RESULT(tl_nav_query_find_route(query, navmesh, &between,
                                            &(tl_nav_path_buffers){ polygons, 64, corners, 64 }, &route),
                    expected);
        TEST_RESULT(tl_nav_corridor_find(&corridor, query, navmesh, &filter, &goal, &path), expected);
        TEST_CHECK(corridor.count == (expected == TL_OK ? path.polygon_count : 1));
    }
    tl_nav_query_destroy(query);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bound),
        cmocka_unit_test(test_fewer_nodes),
        cmocka_unit_test(test_areas),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
