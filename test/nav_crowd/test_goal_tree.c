// SPDX-License-Identifier: MIT
//
// Goal trees (nav_around.h), by which the agents of a crowd share a search: their paths against the shortest ones,
// links in their direction, areas, edits and short memory.

#include "nav_fixture.h"
#include "nav_path_checks.h"

#include <math.h>
#include <talus/nav_around.h>

enum { CAPACITY = 2048 };

typedef struct goal_sums {
    uint32_t paths, same, differ;
    double ratios, worst;
} goal_sums;

// A path by the tree: whole, without a polygon twice, and hardly longer than the shortest one.
static void check_goal_path(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_goal_tree *tree,
                            const tl_nav_location *start, goal_sums *sums)
{
    tl_nav_ref polygons[CAPACITY], few[8];
    tl_nav_corner corners[CAPACITY];
    uint32_t corner_count = 0, links = 0;
    float metres = 0.0f;
    tl_nav_path path, cut;
    tl_nav_goal_path_request request = { NULL, *start, 0 };
    TEST_RESULT(tl_nav_goal_tree_path(tree, navmesh, &request, polygons, CAPACITY, &path), TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && path.end.polygon == tree->goal.polygon);
    TEST_CHECK(polygons[0] == start->polygon && polygons[path.polygon_count - 1] == tree->goal.polygon);
    TEST_CHECK(test_path_is_whole(navmesh, polygons, path.polygon_count, &links));
    for (uint32_t i = 0; i < path.polygon_count; i++) {
        for (uint32_t k = 0; k < i; k++) {
            TEST_CHECK(polygons[i] != polygons[k]);
        }
    }
    request.max_polygons = 5;
    TEST_RESULT(tl_nav_goal_tree_path(tree, navmesh, &request, few, 8, &cut), TL_OK);
    TEST_CHECK(cut.polygon_count <= 5 && test_path_is_whole(navmesh, few, cut.polygon_count, &links));
    TEST_CHECK(cut.status ==
               (few[cut.polygon_count - 1] == tree->goal.polygon ? TL_NAV_PATH_COMPLETE : TL_NAV_PATH_UNFINISHED));
    sums->differ += memcmp(few, polygons, cut.polygon_count * sizeof *few) != 0;
    TEST_CHECK(cut.end.polygon == few[cut.polygon_count - 1]);
    TEST_RESULT(tl_navmesh_straight_path(
                    navmesh, &(tl_nav_polygon_path){ polygons, path.polygon_count, start->point, tree->goal.point },
                    corners, CAPACITY, &corner_count, &metres),
                TL_OK);
    tl_nav_shortest_path shortest;
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, *start, tree->goal },
                                                NULL, &shortest),
                TL_OK);
    const double ratio = shortest.surface_length > 0.5 ? (double)metres / shortest.surface_length : 1.0;
    sums->paths++;
    sums->same += ratio < 1.0001;
    sums->ratios += ratio;
    sums->worst = ratio > sums->worst ? ratio : sums->worst;
}

static void test_goal_trees(void **state)
{
    (void)state;
    test_random random = { 211 };
    tl_nav_query *query = fixture_query(4096);
    static tl_nav_goal_entry entries[CAPACITY];
    goal_sums sums = { 0, 0, 0, 0.0, 0.0 };
    uint32_t apart = 0;
    for (uint32_t round = 0; round < 60; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 4; i++) {
            tl_nav_goal_tree tree = { entries, CAPACITY, 0, fixture_random_location(navmesh, &all, &random) };
            TEST_RESULT(tl_nav_query_find_goal_tree(query, navmesh, NULL, &tree), TL_OK);
            uint32_t goals = 0;
            for (uint32_t k = 0; k < tree.count; k++) {
                TEST_CHECK(k == 0 || entries[k - 1].polygon < entries[k].polygon);
                goals += entries[k].parent == UINT32_MAX;
                TEST_CHECK(entries[k].parent == UINT32_MAX
                               ? entries[k].polygon == tree.goal.polygon
                               : entries[entries[k].parent].min_cost <= entries[k].min_cost);
            }
            TEST_CHECK(goals == 1);
            for (uint32_t k = 0; k < 40; k++) {
                const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
                uint32_t here = 0, there = 0;
                TEST_RESULT(tl_navmesh_island(navmesh, start.polygon, &here), TL_OK);
                TEST_RESULT(tl_navmesh_island(navmesh, tree.goal.polygon, &there), TL_OK);
                if (here == there) {
                    check_goal_path(query, navmesh, &tree, &start, &sums);
                } else {
                    const tl_nav_goal_path_request request = { NULL, start, 0 };
                    tl_nav_path path;
                    TEST_RESULT(tl_nav_goal_tree_path(&tree, navmesh, &request, NULL, 0, &path), TL_NOT_FOUND);
                    apart++;
                }
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    print_message(
        "%u paths by goal trees: %.4f times the shortest, %.3f at worst, %u as short, %u otherwise when cut off\n",
        sums.paths, sums.ratios / sums.paths, sums.worst, sums.same, sums.differ);
    TEST_CHECK(sums.paths > 3000 && apart > 100);
    TEST_CHECK(sums.ratios / sums.paths >= 0.9999 && sums.ratios / sums.paths < 1.006 && sums.worst < 1.8);
    TEST_CHECK(sums.same * 10 > sums.paths * 7);
    tl_nav_query_destroy(query);
}

// A link one way: paths to its landing take it, and none leads back.
static void test_links(void **state)
{
    (void)state;
    tl_nav_ref link = TL_NAV_NO_REF, polygons[8], expected[8];
    tl_navmesh *navmesh = fixture_gap(&link);
    tl_nav_query *query = fixture_query(64);
    tl_nav_goal_entry entries[8];
    const tl_vec3 extents = { 1, 1, 1 };
    tl_nav_location ends[2];
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 2), extents, &ends[0]), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(22, 0, 2), extents, &ends[1]), TL_OK);
    for (uint32_t back = 0; back < 2; back++) {
        tl_nav_goal_tree tree = { entries, 8, 0, ends[1 - back] };
        const tl_nav_goal_path_request request = { NULL, ends[back], 0 };
        tl_nav_path path, own;
        TEST_RESULT(tl_nav_query_find_goal_tree(query, navmesh, NULL, &tree), TL_OK);
        TEST_RESULT(tl_nav_goal_tree_path(&tree, navmesh, &request, polygons, 8, &path),
                    back != 0 ? TL_NOT_FOUND : TL_OK);
        if (back == 0) {
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, ends[0], ends[1] },
                                               expected, 8, &own),
                        TL_OK);
            TEST_CHECK(path.polygon_count == own.polygon_count && fabsf(path.cost - own.cost) < 1e-4f);
            TEST_CHECK(memcmp(polygons, expected, own.polygon_count * sizeof *polygons) == 0);
        }
        TEST_CHECK((tree.count == 4) == (back == 0));
    }
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// What the straight path through polygons costs where areas do.
static double cost_of_path(const tl_navmesh *navmesh, const tl_nav_filter *filter, const tl_nav_location *start,
                           const tl_nav_goal_tree *tree, uint32_t *count_out)
{
    static tl_nav_ref polygons[CAPACITY];
    const tl_nav_goal_path_request request = { filter, *start, 0 };
    tl_nav_path path;
    uint32_t links = 0;
    *count_out = 0;
    if (tl_nav_goal_tree_path(tree, navmesh, &request, polygons, CAPACITY, &path) != TL_OK) {
        return -1.0;
    }
    TEST_CHECK(test_path_is_whole(navmesh, polygons, path.polygon_count, &links));
    *count_out = path.polygon_count;
    return (double)path.cost;
}

// Where areas cost more, and some are refused: never through these, and about as cheap as A* finds.
static void test_areas(void **state)
{
    (void)state;
    test_random random = { 212 };
    tl_nav_query *query = fixture_query(4096);
    static tl_nav_goal_entry entries[CAPACITY];
    double ratios = 0.0;
    uint32_t paths = 0, none = 0;
    for (uint32_t round = 0; round < 40; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.area_count = 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_filter filter = tl_default_nav_filter();
        for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
            filter.area_cost[area] = 1.0f + (float)(area % 4);
        }
        tl_nav_goal_tree tree = { entries, CAPACITY, 0, fixture_random_location(navmesh, &all, &random) };
        TEST_RESULT(tl_nav_query_find_goal_tree(query, navmesh, &filter, &tree), TL_OK);
        for (uint32_t k = 0; k < 40; k++) {
            const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_path own;
            uint32_t count = 0;
            const double cost = cost_of_path(navmesh, &filter, &start, &tree, &count);
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, tree.goal },
                                               NULL, 0, &own),
                        TL_INCOMPLETE);
            TEST_CHECK((own.status == TL_NAV_PATH_COMPLETE) == (count > 0));
            none += count == 0;
            if (count > 0 && own.cost > 1.0f) {
                ratios += cost / (double)own.cost;
                paths++;
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    print_message("%u paths over areas: %.3f times what A* finds; %u without\n", paths, ratios / paths, none);
    TEST_CHECK(paths > 1000 && none > 10 && ratios / paths < 1.1);
    tl_nav_query_destroy(query);
}

// Too few nodes: the nearest ones are there, and their paths.
static void test_few_nodes(void **state)
{
    (void)state;
    test_random random = { 213 };
    fixture_level level = fixture_random(&random, 0, 8);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_query *query = fixture_query(4096), *small = fixture_query(16);
    static tl_nav_goal_entry entries[CAPACITY], few[CAPACITY];
    const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
    tl_nav_goal_tree tree = { entries, CAPACITY, 0, goal }, part = { few, CAPACITY, 0, goal };
    TEST_RESULT(tl_nav_query_find_goal_tree(query, navmesh, NULL, &tree), TL_OK);
    TEST_CHECK(tree.count > 20);
    TEST_RESULT(tl_nav_query_find_goal_tree(small, navmesh, NULL, &part), TL_ERR_NODES);
    TEST_CHECK(part.count == 16);
    part.capacity = 10;
    TEST_RESULT(tl_nav_query_find_goal_tree(query, navmesh, NULL, &part), TL_INCOMPLETE);
    TEST_CHECK(part.count == 10);
    for (uint32_t i = 0; i < part.count; i++) {
        tl_nav_location start = { few[i].polygon, few[i].corner };
        TEST_RESULT(tl_navmesh_closest_point(navmesh, start.polygon, start.point, &start.point, NULL), TL_OK);
        tl_nav_path path;
        tl_nav_ref polygons[CAPACITY];
        uint32_t links = 0;
        TEST_RESULT(tl_nav_goal_tree_path(&part, navmesh, &(tl_nav_goal_path_request){ NULL, start, 0 }, polygons,
                                          CAPACITY, &path),
                    TL_OK);
        TEST_CHECK(test_path_is_whole(navmesh, polygons, path.polygon_count, &links));
    }
    free(all.refs);
    tl_nav_query_destroy(query);
    tl_nav_query_destroy(small);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_goal_trees), cmocka_unit_test(test_links),
                                        cmocka_unit_test(test_areas), cmocka_unit_test(test_few_nodes) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
