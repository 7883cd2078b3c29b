// SPDX-License-Identifier: MIT
//
// Shortest paths over off-mesh links, against an oracle: exact paths between all ends of links on the same navmesh
// without links, and the shortest way through that small graph. Links of any direction, length and cost; short cuts and
// teleporters among them. A* on the same pairs: paths that are whole, never shorter, and found whenever there is one.

#include "nav_fixture.h"

#include <math.h>

enum { MAX_LINKS = 7, MAX_NODES = 2 + 2 * MAX_LINKS, MAX_POLYGONS = 1024, MAX_CORNERS = 512 };

typedef struct linked_pair {
    tl_navmesh *plain, *linked;
    tl_nav_offmesh_state links[MAX_LINKS];
    uint32_t link_count;
    fixture_refs all;
    tl_nav_query *query;
} linked_pair;

typedef struct coverage {
    uint64_t complete, cut_off, over_one, over_more, over_short, backward, one_way_stuck, within_polygon;
} coverage;

static tl_nav_offmesh random_link(test_random *random, const tl_nav_location *ends)
{
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = ends[0].point;
    link.end = ends[1].point;
    link.both_ways = test_random_below(random, 2) == 0;
    uint32_t kind = test_random_below(random, 4);
    link.cost_factor = kind == 0 ? 0.0f : kind == 1 ? test_random_range(random, 0.2f, 1.0f) : 1.0f;
    link.fixed_cost = test_random_below(random, 2) == 0 ? 0.0f : test_random_range(random, 0.0f, 4.0f);
    return link;
}

// Levels without short cuts too: they take another way through the search.
static void make_pair(linked_pair *p, const fixture_level *level, test_random *random, bool short_cuts)
{
    p->plain = fixture_build(level, NULL);
    p->linked = fixture_build(level, NULL);
    p->all = fixture_all_refs(p->plain);
    p->link_count = 0;
    uint32_t wanted = test_random_below(random, MAX_LINKS + 1);
    for (uint32_t i = 0; i < wanted && p->all.count > 0; i++) {
        tl_nav_location ends[2];
        ends[0] = fixture_random_location(p->plain, &p->all, random);
        ends[1] = fixture_random_location(p->plain, &p->all, random);
        if (test_random_below(random, 6) == 0) {
            ends[1].polygon = ends[0].polygon;
            ends[1].point.x = ends[0].point.x + test_random_range(random, -1.0f, 1.0f);
            ends[1].point.z = ends[0].point.z + test_random_range(random, -1.0f, 1.0f);
        }
        tl_nav_offmesh link = random_link(random, ends);
        if (!short_cuts) {
            link.cost_factor = 1.0f;
        }
        tl_nav_ref ref;
        TEST_RESULT(tl_navmesh_add_offmesh(p->linked, &link, &ref, NULL), TL_OK);
        TEST_CHECK(tl_nav_is_offmesh(ref));
        tl_nav_offmesh_state *state = &p->links[p->link_count];
        TEST_RESULT(tl_navmesh_offmesh_state(p->linked, ref, state), TL_OK);
        if (state->anchored) {
            p->link_count++;
        }
    }
}

static void free_pair(linked_pair *p)
{
    tl_navmesh_destroy(p->plain);
    tl_navmesh_destroy(p->linked);
    free(p->all.refs);
}

static double plain_length(linked_pair *p, const tl_nav_location *a, const tl_nav_location *b)
{
    tl_nav_shortest_path path;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(p->query, p->plain, &(tl_nav_path_request){ NULL, *a, *b }, NULL, &path),
        TL_OK);
    return path.status == TL_NAV_PATH_COMPLETE ? path.length : (double)INFINITY;
}

// Floyd and Warshall over start, goal and all ends.
static double oracle(linked_pair *p, const tl_nav_location *start, const tl_nav_location *goal)
{
    tl_nav_location nodes[MAX_NODES] = { *start, *goal };
    uint32_t count = 2;
    for (uint32_t i = 0; i < p->link_count; i++) {
        nodes[count++] = p->links[i].ends[0];
        nodes[count++] = p->links[i].ends[1];
    }
    double d[MAX_NODES][MAX_NODES];
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = 0; j < count; j++) {
            d[i][j] = i == j ? 0.0 : plain_length(p, &nodes[i], &nodes[j]);
        }
    }
    for (uint32_t i = 0; i < p->link_count; i++) {
        uint32_t a = 2 + 2 * i, b = 3 + 2 * i;
        double cost = (double)p->links[i].cost;
        d[a][b] = fmin(d[a][b], cost);
        d[b][a] = p->links[i].offmesh.both_ways ? fmin(d[b][a], cost) : d[b][a];
    }
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t j = 0; j < count; j++) {
                d[i][j] = fmin(d[i][j], d[i][k] + d[k][j]);
            }
        }
    }
    return d[0][1];
}

static bool are_neighbours(const tl_navmesh *navmesh, tl_nav_ref a, tl_nav_ref b)
{
    tl_nav_link links[64];
    uint32_t count = 0;
    TEST_RESULT(tl_navmesh_links(navmesh, a, links, 64, &count), TL_OK);
    bool found = false;
    for (uint32_t i = 0; i < count; i++) {
        found = found || links[i].to == b;
    }
    return found;
}

// Each polygon beside the last, or a link that may be taken so between the two. Returns the number of links.
static uint32_t check_polygons(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t count,
                               const tl_nav_location *start, tl_nav_ref last)
{
    uint32_t links = 0;
    TEST_CHECK(count > 0 && count <= MAX_POLYGONS);
    TEST_CHECK(polygons[0] == start->polygon && polygons[count - 1] == last);
    for (uint32_t i = 0; i + 1 < count; i++) {
        if (!tl_nav_is_offmesh(polygons[i + 1])) {
            TEST_CHECK(are_neighbours(navmesh, polygons[i], polygons[i + 1]));
            continue;
        }
        tl_nav_offmesh_state state;
        TEST_RESULT(tl_navmesh_offmesh_state(navmesh, polygons[i + 1], &state), TL_OK);
        uint32_t from = (polygons[i + 1] & TL_NAV_OFFMESH_BACKWARD) != 0 ? 1 : 0;
        TEST_CHECK(from == 0 || state.offmesh.both_ways);
        TEST_CHECK(i + 2 < count && state.ends[from].polygon == polygons[i] &&
                   state.ends[1 - from].polygon == polygons[i + 2]);
        tl_nav_ref listed[2 * MAX_LINKS];
        uint32_t listed_count = 0;
        bool found = false;
        TEST_RESULT(tl_navmesh_offmesh_from(navmesh, polygons[i], listed, 2 * MAX_LINKS, &listed_count), TL_OK);
        for (uint32_t k = 0; k < listed_count; k++) {
            found = found || listed[k] == polygons[i + 1];
        }
        TEST_CHECK(found);
        links++;
        i++;
    }
    return links;
}

static double in_plane(tl_vec3 a, tl_vec3 b)
{
    double x = (double)a.x - (double)b.x, z = (double)a.z - (double)b.z;
    return sqrt(x * x + z * z);
}

// The corners add up to the length, and name the same links as the polygons do.
static void check_corners(const tl_navmesh *navmesh, const tl_nav_corner *corners, uint32_t count,
                          const tl_nav_ref *polygons, uint32_t polygon_count, double length, coverage *seen)
{
    double sum = 0.0;
    uint32_t at = 0;
    TEST_CHECK(count >= 2 && count <= MAX_CORNERS && corners[0].flags == TL_NAV_CORNER_START);
    TEST_CHECK((corners[count - 1].flags & TL_NAV_CORNER_END) != 0);
    for (uint32_t i = 0; i + 1 < count; i++) {
        bool is_link = (corners[i].flags & TL_NAV_CORNER_LINK) != 0;
        TEST_CHECK(is_link == (corners[i].link != TL_NAV_NO_REF));
        if (!is_link) {
            sum += in_plane(corners[i].point, corners[i + 1].point);
            continue;
        }
        tl_nav_offmesh_state state;
        TEST_RESULT(tl_navmesh_offmesh_state(navmesh, corners[i].link, &state), TL_OK);
        uint32_t from = (corners[i].link & TL_NAV_OFFMESH_BACKWARD) != 0 ? 1 : 0;
        TEST_CHECK(tl_distance(corners[i].point, state.ends[from].point) == 0.0f);
        TEST_CHECK(tl_distance(corners[i + 1].point, state.ends[1 - from].point) == 0.0f);
        sum += (double)state.cost;
        seen->backward += from;
        seen->over_short += state.cost < 0.999f * state.length;
        while (at < polygon_count && polygons[at] != corners[i].link) {
            at++;
        }
        TEST_CHECK(at++ < polygon_count);
    }
    TEST_CHECK(length < 0.0 || fabs(sum - length) <= 1e-6 * (1.0 + length));
}

// By A*: one area, which no polygon has, costs more.
static void check_ways(linked_pair *p, const tl_nav_location *start, const tl_nav_location *goal, double shortest,
                       coverage *seen)
{
    static tl_nav_ref polygons[MAX_POLYGONS];
    static tl_nav_corner corners[MAX_CORNERS];
    tl_nav_filter filter = tl_default_nav_filter();
    filter.area_cost[1] = 2.0f;
    tl_nav_path path;
    TEST_RESULT(tl_nav_query_find_path(p->query, p->linked, &(tl_nav_path_request){ &filter, *start, *goal }, polygons,
                                       MAX_POLYGONS, &path),
                TL_OK);
    TEST_CHECK((path.status == TL_NAV_PATH_COMPLETE) == isfinite(shortest));
    check_polygons(p->linked, polygons, path.polygon_count, start, path.end.polygon);
    if (path.status == TL_NAV_PATH_COMPLETE) {
        TEST_CHECK((double)path.cost >= shortest - 1e-4 * (1.0 + shortest));
        uint32_t count = 0;
        float length = 0.0f;
        TEST_RESULT(tl_navmesh_straight_path(
                        p->linked, &(tl_nav_polygon_path){ polygons, path.polygon_count, start->point, goal->point },
                        corners, MAX_CORNERS, &count, &length),
                    TL_OK);
        coverage unused;
        memset(&unused, 0, sizeof unused);
        check_corners(p->linked, corners, count, polygons, path.polygon_count, -1.0, &unused);
        seen->within_polygon += path.polygon_count >= 3 && polygons[0] == polygons[2];
    }
}

static void check_pair(linked_pair *p, test_random *random, coverage *seen)
{
    static tl_nav_ref polygons[MAX_POLYGONS];
    static tl_nav_corner corners[MAX_CORNERS];
    tl_nav_location start = fixture_random_location(p->linked, &p->all, random);
    tl_nav_location goal = fixture_random_location(p->linked, &p->all, random);
    if (p->link_count > 0 && test_random_below(random, 8) == 0) {
        start = p->links[0].ends[test_random_below(random, 2)];
    }
    double expected = oracle(p, &start, &goal);
    tl_nav_shortest_path path;
    TEST_RESULT(tl_nav_query_find_shortest_path(p->query, p->linked, &(tl_nav_path_request){ NULL, start, goal },
                                                &(tl_nav_path_buffers){ polygons, MAX_POLYGONS, corners, MAX_CORNERS },
                                                &path),
                TL_OK);
    TEST_CHECK((path.status == TL_NAV_PATH_COMPLETE) == isfinite(expected));
    check_ways(p, &start, &goal, expected, seen);
    uint32_t islands[2];
    TEST_RESULT(tl_navmesh_island(p->linked, start.polygon, &islands[0]), TL_OK);
    TEST_RESULT(tl_navmesh_island(p->linked, goal.polygon, &islands[1]), TL_OK);
    if (path.status != TL_NAV_PATH_COMPLETE) {
        seen->cut_off += islands[0] != islands[1];
        seen->one_way_stuck += islands[0] == islands[1];
        return;
    }
    seen->complete++;
    TEST_CHECK(islands[0] == islands[1]);
    if (fabs(path.length - expected) > 2e-6 * (1.0 + expected)) {
        fail_msg("length %.9g, expected %.9g", path.length, expected);
    }
    TEST_CHECK(path.lower_bound <= path.length && path.lower_bound >= path.length * (1.0 - 1e-6));
    uint32_t links = check_polygons(p->linked, polygons, path.polygon_count, &start, goal.polygon);
    check_corners(p->linked, corners, path.corner_count, polygons, path.polygon_count, path.length, seen);
    seen->over_one += links == 1;
    seen->over_more += links > 1;
}

static void test_oracle(void **state)
{
    (void)state;
    test_random random = { 2024 };
    tl_nav_query_def def = tl_default_nav_query_def();
    linked_pair p;
    memset(&p, 0, sizeof p);
    TEST_RESULT(tl_nav_query_create(&def, &p.query, NULL), TL_OK);
    coverage seen;
    memset(&seen, 0, sizeof seen);
    for (uint32_t round = 0; round < 400; round++) {
        fixture_level level = fixture_random(&random, round % 6, 4 + test_random_below(&random, 9));
        // Two floors that fork at a seam can be changed anywhere along it (docs/notes/paths.md): those stand in one
        // tile.
        level.tile_cells = round % 6 == 5 || test_random_below(&random, 3) == 0 ? 0 : 3;
        make_pair(&p, &level, &random, round % 2 == 0);
        for (uint32_t i = 0; i < 12 && p.all.count > 0; i++) {
            check_pair(&p, &random, &seen);
        }
        free_pair(&p);
    }
    tl_nav_query_destroy(p.query);
    print_message(
        "%llu complete, %llu over one link, %llu over more, %llu over short cuts, %llu backward, %llu cut off, "
        "%llu stuck behind one way, %llu from a polygon to itself\n",
        (unsigned long long)seen.complete, (unsigned long long)seen.over_one, (unsigned long long)seen.over_more,
        (unsigned long long)seen.over_short, (unsigned long long)seen.backward, (unsigned long long)seen.cut_off,
        (unsigned long long)seen.one_way_stuck, (unsigned long long)seen.within_polygon);
    TEST_CHECK(seen.complete > 1000 && seen.over_one > 200 && seen.over_more > 50 && seen.over_short > 50);
    TEST_CHECK(seen.backward > 50 && seen.cut_off > 50 && seen.one_way_stuck > 10 && seen.within_polygon > 0);
}

// A filter that refuses a link's flags walks around; an area's cost makes a link dearer.
static void test_filter(void **state)
{
    (void)state;
    const char *const rows[] = { "00000", "0###0", "0###0", "00000" };
    fixture_level level = fixture_make(rows, 4);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = tl_vec3_make(10, 0, 3.5f);
    link.end = tl_vec3_make(10, 0, 12.5f);
    link.flags = 4;
    link.area = 9;
    tl_nav_ref ref;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &link, &ref, NULL), TL_OK);
    tl_nav_location start, goal;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10, 0, 2), tl_vec3_make(1, 1, 1), &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10, 0, 14), tl_vec3_make(1, 1, 1), &goal), TL_OK);
    tl_nav_shortest_path path;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &path),
        TL_OK);
    TEST_CHECK(fabs(path.length - 12.0) < 1e-5);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.exclude_flags = 4;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }, NULL, &path),
        TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && path.length > 20.0);
    // By A*: at ten times its length the link loses.
    filter.exclude_flags = 0;
    filter.area_cost[9] = 10.0f;
    tl_nav_ref polygons[64];
    tl_nav_path by_ways;
    TEST_RESULT(
        tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }, polygons, 64, &by_ways),
        TL_OK);
    for (uint32_t i = 0; i < by_ways.polygon_count; i++) {
        TEST_CHECK(!tl_nav_is_offmesh(polygons[i]));
    }
    filter.area_cost[9] = 1.5f;
    TEST_RESULT(
        tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }, polygons, 64, &by_ways),
        TL_OK);
    TEST_CHECK(by_ways.polygon_count == 3 && polygons[1] == ref && fabsf(by_ways.cost - 16.5f) < 1e-3f);
    // From the far side it leads nowhere.
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, goal, start }, NULL, &path),
        TL_OK);
    TEST_CHECK(path.length > 20.0);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_oracle), cmocka_unit_test(test_filter) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
