// SPDX-License-Identifier: MIT
//
// Searches in slices: the same bits as in one piece for every slice size, partial paths at every moment, and tiles that
// come and go in between.

#include "nav_fixture.h"

enum { MAX_POLYGONS = 512 };

typedef struct answer {
    tl_nav_path path;
    tl_nav_ref polygons[MAX_POLYGONS];
} answer;

static answer find_at_once(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                           const tl_nav_location *start, const tl_nav_location *goal)
{
    answer a;
    memset(&a, 0, sizeof a);
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ filter, *start, *goal }, a.polygons,
                                       MAX_POLYGONS, &a.path),
                TL_OK);
    return a;
}

static bool same_answer(const answer *a, const answer *b)
{
    return a->path.status == b->path.status && a->path.polygon_count == b->path.polygon_count &&
           a->path.end.polygon == b->path.end.polygon &&
           memcmp(&a->path.end.point, &b->path.end.point, sizeof a->path.end.point) == 0 &&
           memcmp(&a->path.cost, &b->path.cost, sizeof a->path.cost) == 0 && a->path.node_count == b->path.node_count &&
           memcmp(a->polygons, b->polygons, a->path.polygon_count * sizeof(tl_nav_ref)) == 0;
}

static float distance_to_goal(const answer *a, const tl_nav_location *goal)
{
    return tl_distance(a->path.end.point, goal->point);
}

static void check_chain(const tl_navmesh *navmesh, const answer *a, const tl_nav_location *start)
{
    TEST_CHECK(a->path.polygon_count >= 1 && a->polygons[0] == start->polygon);
    TEST_CHECK(a->polygons[a->path.polygon_count - 1] == a->path.end.polygon);
    for (uint32_t i = 0; i + 1 < a->path.polygon_count; i++) {
        tl_nav_link links[64];
        uint32_t count = 0;
        bool linked = false;
        TEST_RESULT(tl_navmesh_links(navmesh, a->polygons[i], links, 64, &count), TL_OK);
        for (uint32_t k = 0; k < count; k++) {
            linked = linked || links[k].to == a->polygons[i + 1];
        }
        TEST_CHECK(linked);
    }
}

// Kinds of filters: none, areas with costs, flags that refuse (no flag matches: only the start's polygon).
static tl_nav_filter make_filter(uint32_t kind)
{
    tl_nav_filter filter = tl_default_nav_filter();
    for (int area = 0; kind == 1 && area <= TL_NAV_MAX_AREA; area++) {
        filter.area_cost[area] = 1.0f + (float)(area % 4);
    }
    filter.include_flags = kind == 2 ? 2 : UINT64_MAX;
    return filter;
}

static void test_all_slices(void **state)
{
    (void)state;
    test_random random = { 501 };
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    uint32_t pieces = 0, by_status[5] = { 0 }, partial = 0, nearer = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        level.area_count = 5;
        // Some searches run out of nodes.
        def.max_nodes = round % 3 == 2 ? 10 : 4096;
        TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 9; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
            tl_nav_filter filter = make_filter(i % 3);
            answer whole = find_at_once(query, navmesh, i % 3 == 0 ? NULL : &filter, &start, &goal);
            by_status[whole.path.status]++;
            uint32_t needed = UINT32_MAX;
            for (uint32_t slice = 1; slice <= needed; slice++) {
                tl_nav_path_progress progress;
                uint32_t steps = 0;
                float least = INFINITY;
                TEST_RESULT(tl_nav_query_begin_path(query, navmesh,
                                                    &(tl_nav_path_request){ i % 3 == 0 ? NULL : &filter, start, goal }),
                            TL_OK);
                do {
                    answer part;
                    TEST_RESULT(tl_nav_query_write_path(query, part.polygons, MAX_POLYGONS, &part.path), TL_OK);
                    if (slice == 1) {
                        check_chain(navmesh, &part, &start);
                        if (part.path.status == TL_NAV_PATH_UNFINISHED) {
                            partial++;
                            nearer += distance_to_goal(&part, &goal) < least;
                            least = distance_to_goal(&part, &goal);
                        }
                    }
                    TEST_RESULT(tl_nav_query_step_path(query, slice, &progress), TL_OK);
                    steps++;
                } while (progress.status == TL_NAV_PATH_UNFINISHED);
                answer cut;
                TEST_RESULT(tl_nav_query_write_path(query, cut.polygons, MAX_POLYGONS, &cut.path), TL_OK);
                TEST_CHECK(progress.status == cut.path.status && same_answer(&whole, &cut));
                pieces += steps;
                needed = slice == 1 ? steps : needed;
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
        tl_nav_query_destroy(query);
    }
    TEST_CHECK(pieces > 10000 && partial > 1000 && nearer > 200);
    TEST_CHECK(by_status[TL_NAV_PATH_COMPLETE] > 80 && by_status[TL_NAV_PATH_UNREACHABLE] > 40 &&
               by_status[TL_NAV_PATH_OUT_OF_NODES] > 10);
}

// Takes a tile out, or puts one in, at a random place.
static void edit(tl_navmesh *navmesh, const fixture_level *level, test_random *random, int32_t *x, int32_t *z)
{
    uint32_t tiles = fixture_tiles(level->width, level->tile_cells);
    *x = (int32_t)test_random_below(random, tiles);
    *z = (int32_t)test_random_below(random, tiles);
    if (tl_navmesh_find_tile(navmesh, *x, *z) != NULL) {
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, *x, *z), TL_OK);
        return;
    }
    tl_nav_tile *tile = fixture_build_tile(level, *x, *z, NULL);
    if (tile != NULL) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    }
}

// A search that lived through edits gives what one gives that begins after them.
static void test_edits(void **state)
{
    (void)state;
    test_random random = { 502 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL, *other = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    TEST_RESULT(tl_nav_query_create(&def, &other, NULL), TL_OK);
    uint32_t stale = 0, lived = 0, lived_through = 0, stale_near = 0;
    for (uint32_t round = 0; round < 300; round++) {
        fixture_level level = fixture_random(&random, round % 6, 16);
        level.tile_cells = 2;
        level.area_count = 5;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_location start = fixture_random_location(navmesh, &all, &random);
        tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        tl_nav_filter filter = make_filter(round % 2);
        TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }), TL_OK);
        tl_nav_path_progress progress;
        uint32_t edits = 0;
        int32_t x = 0, z = 0;
        do {
            TEST_RESULT(tl_nav_query_step_path(query, 3, &progress), TL_OK);
            if (edits < 2 && progress.status == TL_NAV_PATH_UNFINISHED && test_random_below(&random, 3) == 0) {
                edit(navmesh, &level, &random, &x, &z);
                edits++;
            }
        } while (progress.status == TL_NAV_PATH_UNFINISHED);
        answer cut;
        TEST_RESULT(tl_nav_query_write_path(query, cut.polygons, MAX_POLYGONS, &cut.path), TL_OK);
        if (progress.status == TL_NAV_PATH_STALE) {
            TEST_CHECK(edits > 0 && cut.path.status == TL_NAV_PATH_STALE && cut.path.polygon_count == 0);
            stale_near += abs(progress.tile_x - x) + abs(progress.tile_z - z) <= 1;
            stale++;
        } else if (cut.path.node_count > 0) {
            answer after = find_at_once(other, navmesh, &filter, &start, &goal);
            // A search that ends without a goal, on an island that was split off, has looked; a new one knows at once.
            bool same_end =
                after.path.node_count > 0 ? same_answer(&cut, &after) : cut.path.status == after.path.status;
            TEST_CHECK(same_end);
            lived += edits == 0;
            lived_through += edits > 0;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    tl_nav_query_destroy(other);
    TEST_CHECK(stale > 40 && stale_near > 20 && lived > 20 && lived_through > 40);
}

static void test_ended(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    level.tile_cells = 1;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = { 64, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_location start, goal, nan, stale = { 77, { 0, 0, 0 } };
    tl_vec3 extents = { 1, 1, 1 };
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 2), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10, 0, 10), extents, &goal), TL_OK);
    nan = start;
    nan.point.x = NAN;
    tl_nav_path_progress progress;
    tl_nav_path path;
    tl_nav_ref polygons[8];
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_write_path(query, polygons, 8, &path), TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, stale, goal }), TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, nan, goal }), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_ERR_STALE);

    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }), TL_OK);
    TEST_RESULT(tl_nav_query_step_path(query, 0, &progress), TL_OK);
    TEST_CHECK(progress.status == TL_NAV_PATH_UNFINISHED && progress.node_count > 0);
    TEST_RESULT(tl_nav_query_write_path(query, NULL, 0, &path), TL_INCOMPLETE);
    // Another question takes the query's nodes.
    tl_nav_wall wall;
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, start, 2.0f }, &wall), TL_OK);
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_ERR_STALE);

    // The goal's tile goes; it is named.
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 2, 2), TL_OK);
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_OK);
    TEST_CHECK(progress.status == TL_NAV_PATH_STALE && progress.tile_x == 2 && progress.tile_z == 2);
    TEST_RESULT(tl_nav_query_step_path(query, 100, &progress), TL_OK);
    TEST_CHECK(progress.status == TL_NAV_PATH_STALE && progress.tile_x == 2);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_all_slices), cmocka_unit_test(test_edits),
                                        cmocka_unit_test(test_ended) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
