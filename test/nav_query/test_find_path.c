// SPDX-License-Identifier: MIT
//
// A* against a plain twin without heap and hash table, its paths against nearly exact shortest ones, reachability
// against connected components.

#include "nav_fixture.h"
#include "nav_path_checks.h"

#include <float.h>
#include <math.h>
#include <talus/nav_state.h>

// The search graph, written out: node 0 is the start, then one node a link.
typedef struct way_graph {
    fixture_refs all;
    uint32_t *first_way; // [all.count + 1]
    tl_nav_link *ways;
    uint32_t *way_to; // index of the polygon that a way enters
    uint32_t *component;
    uint32_t way_count;
} way_graph;

static bool passes(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    return tl_nav_filter_passes(filter, tile, polygon);
}

static way_graph make_graph(const tl_navmesh *navmesh, const tl_nav_filter *filter)
{
    way_graph g;
    memset(&g, 0, sizeof g);
    g.all = fixture_all_refs(navmesh);
    g.first_way = calloc(g.all.count + 1u, sizeof *g.first_way);
    g.ways = calloc((size_t)tl_navmesh_link_count(navmesh) + 1, sizeof *g.ways);
    g.way_to = calloc((size_t)tl_navmesh_link_count(navmesh) + 1, sizeof *g.way_to);
    g.component = calloc(g.all.count + 1u, sizeof *g.component);
    for (uint32_t i = 0; i < g.all.count; i++) {
        uint32_t count = 0;
        TEST_RESULT(tl_navmesh_links(navmesh, g.all.refs[i], g.ways + g.way_count, 64, &count), TL_OK);
        g.way_count += count;
        g.first_way[i + 1] = g.way_count;
        g.component[i] = i;
    }
    for (uint32_t k = 0; k < g.way_count; k++) {
        g.way_to[k] = fixture_index_of(&g.all, g.ways[k].to);
    }
    for (bool changed = true; changed;) { // labels sink until neighbours agree
        changed = false;
        for (uint32_t i = 0; i < g.all.count; i++) {
            for (uint32_t k = g.first_way[i]; k < g.first_way[i + 1]; k++) {
                uint32_t j = g.way_to[k];
                bool both = passes(navmesh, filter, g.all.refs[i]) && passes(navmesh, filter, g.all.refs[j]);
                if (both && g.component[j] > g.component[i]) {
                    g.component[j] = g.component[i];
                    changed = true;
                }
            }
        }
    }
    return g;
}

static void free_graph(way_graph *g)
{
    free(g->all.refs);
    free(g->first_way);
    free(g->ways);
    free(g->way_to);
    free(g->component);
}

static float area_cost(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    return filter->area_cost[tl_nav_tile_area(tile, polygon)];
}

// Where a portal is entered: with the operations of the search itself, for equal bits.
static tl_vec3 entry_of(tl_vec3 from, tl_vec3 goal, const tl_nav_link *way)
{
    double ux = (double)way->left.x - (double)way->right.x, uz = (double)way->left.z - (double)way->right.z;
    double fx = (double)from.x - (double)way->right.x, fz = (double)from.z - (double)way->right.z;
    double gx = (double)goal.x - (double)way->right.x, gz = (double)goal.z - (double)way->right.z;
    double from_along = fx * ux + fz * uz, goal_along = gx * ux + gz * uz;
    double from_off = fabs(fx * uz - fz * ux), off = from_off + fabs(gx * uz - gz * ux);
    double along = off > 0.0 ? from_along * off + (goal_along - from_along) * from_off : goal_along;
    double whole = (off > 0.0 ? off : 1.0) * (ux * ux + uz * uz);
    return !(along > 0.0)   ? way->right
           : along >= whole ? way->left
                            : tl_lerp(way->right, way->left, (float)(along / whole));
}

typedef struct twin_node {
    tl_vec3 point;
    float cost, total;
    uint32_t order; // of discovery: breaks ties
    bool open, closed;
} twin_node;

// The search by scanning all nodes for the best each time. The cost, or INFINITY when there is no way.
static float twin_search(const tl_navmesh *navmesh, const way_graph *g, const tl_nav_filter *filter,
                         const tl_nav_location *start, const tl_nav_location *goal)
{
    uint32_t start_node = g->way_count, goal_node = g->way_count + 1, count = g->way_count + 2;
    uint32_t start_index = fixture_index_of(&g->all, start->polygon);
    uint32_t goal_index = fixture_index_of(&g->all, goal->polygon);
    uint32_t *parent_polygon = malloc(count * sizeof *parent_polygon);
    twin_node *nodes = calloc(count, sizeof *nodes);
    float least = filter->area_cost[0];
    for (int area = 1; area <= TL_NAV_MAX_AREA; area++) {
        least = fminf(least, filter->area_cost[area]);
    }
    uint32_t found = 0;
    nodes[start_node].open = true;
    nodes[start_node].point = start->point;
    nodes[start_node].order = found++;
    parent_polygon[start_node] = UINT32_MAX;
    float result = INFINITY;
    for (;;) {
        uint32_t at = UINT32_MAX;
        for (uint32_t i = 0; i < count; i++) {
            bool better = at == UINT32_MAX || nodes[i].total < nodes[at].total ||
                          (nodes[i].total == nodes[at].total && nodes[i].order < nodes[at].order);
            at = nodes[i].open && !nodes[i].closed && better ? i : at;
        }
        if (at == UINT32_MAX || at == goal_node) {
            result = at == goal_node ? nodes[at].cost : INFINITY;
            break;
        }
        nodes[at].closed = true;
        uint32_t polygon = at == start_node ? start_index : g->way_to[at];
        float metre = area_cost(navmesh, filter, g->all.refs[polygon]);
        // The goal, then all ways out.
        for (uint32_t n = 0; n <= g->first_way[polygon + 1] - g->first_way[polygon]; n++) {
            uint32_t to = n == 0 ? goal_node : g->first_way[polygon] + n - 1;
            if (n == 0 ? polygon != goal_index
                       : g->way_to[to] == parent_polygon[at] || !passes(navmesh, filter, g->ways[to].to)) {
                continue;
            }
            tl_vec3 point = n == 0 ? goal->point : entry_of(nodes[at].point, goal->point, &g->ways[to]);
            float cost = nodes[at].cost + metre * tl_distance(nodes[at].point, point);
            if (nodes[to].closed || (nodes[to].open && cost >= nodes[to].cost)) {
                continue;
            }
            nodes[to].order = nodes[to].open ? nodes[to].order : found++;
            nodes[to].open = true;
            nodes[to].point = point;
            nodes[to].cost = cost;
            nodes[to].total = cost + least * tl_distance(point, goal->point);
            parent_polygon[to] = polygon;
        }
    }
    free(nodes);
    free(parent_polygon);
    return result;
}

// Path polygons are neighbours in order, and pass the filter.
static void check_chain(const tl_navmesh *navmesh, const tl_nav_filter *filter, const tl_nav_ref *polygons,
                        uint32_t count)
{
    for (uint32_t i = 0; i + 1 < count; i++) {
        TEST_CHECK(test_are_linked(navmesh, polygons[i], polygons[i + 1]) && passes(navmesh, filter, polygons[i + 1]));
    }
}

static void randomize_flags(tl_navmesh *navmesh, test_random *random)
{
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        const uint32_t polygon_count = tile != NULL ? tile->polygon_count : 0;
        for (uint32_t p = 0; p < polygon_count; p++) {
            const uint64_t flags = test_random_below(random, 12) == 0 ? 2 : 1;
            TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, tl_navmesh_polygon_ref(navmesh, slot, p), flags), TL_OK);
        }
    }
}

static void test_against_twin(void **state)
{
    (void)state;
    test_random random = { 41 };
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t complete = 0, unreachable = 0, alone = 0, longest = 0;
    for (uint32_t round = 0; round < 30; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = round % 2 == 0 ? 0 : 4;
        level.area_count = 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        randomize_flags(navmesh, &random);
        tl_nav_filter filter = tl_default_nav_filter();
        filter.exclude_flags = round % 3 == 0 ? 2 : 0;
        filter.area_cost[0] = 7.0f; // of no polygon, but costs are not all the same: A* it is
        for (uint32_t area = 1; area <= 3 && round % 4 != 0; area++) {
            filter.area_cost[area] = test_random_range(&random, 0.5f, 6.0f);
        }
        way_graph g = make_graph(navmesh, &filter);
        for (uint32_t i = 0; i < 20; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &g.all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &g.all, &random);
            if (!passes(navmesh, &filter, start.polygon) || !passes(navmesh, &filter, goal.polygon)) {
                continue;
            }
            tl_nav_ref polygons[512];
            tl_nav_path path;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }, polygons,
                                               512, &path),
                        TL_OK);
            check_chain(navmesh, &filter, polygons, path.polygon_count);
            TEST_CHECK(polygons[0] == start.polygon && polygons[path.polygon_count - 1] == path.end.polygon);
            bool reachable = g.component[fixture_index_of(&g.all, start.polygon)] ==
                             g.component[fixture_index_of(&g.all, goal.polygon)];
            TEST_CHECK(path.status == (reachable ? TL_NAV_PATH_COMPLETE : TL_NAV_PATH_UNREACHABLE));
            TEST_CHECK(path.node_count <= tl_navmesh_link_count(navmesh) + 2);
            float expected = twin_search(navmesh, &g, &filter, &start, &goal);
            TEST_CHECK(reachable == (isfinite(expected) != 0));
            if (reachable) {
                TEST_CHECK(path.cost == expected);
                TEST_CHECK(path.end.polygon == goal.polygon && path.end.point.x == goal.point.x);
                complete++;
                alone += path.polygon_count == 1;
                longest = path.polygon_count > longest ? path.polygon_count : longest;
            } else {
                unreachable++;
            }
        }
        free_graph(&g);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(complete > 200 && unreachable > 60 && alone >= 3 && longest > 30);
}

enum { SAMPLES = 17 };

// Nearly the shortest length in the plane, from above: Dijkstra over many points of each portal. O(n^2).
static double sampled_shortest(const way_graph *g, const tl_nav_location *start, const tl_nav_location *goal)
{
    uint32_t count = g->way_count * SAMPLES + 1;
    double *length = malloc(count * sizeof *length);
    bool *done = calloc(count, sizeof *done);
    tl_vec3 *points = malloc(count * sizeof *points);
    for (uint32_t i = 0; i < count; i++) {
        length[i] = (double)INFINITY;
        const tl_nav_link *way = &g->ways[i / SAMPLES];
        points[i] =
            i + 1 == count ? start->point : tl_lerp(way->right, way->left, (float)(i % SAMPLES) / (SAMPLES - 1));
    }
    length[count - 1] = 0.0;
    double best = (double)INFINITY;
    for (;;) {
        uint32_t at = UINT32_MAX;
        for (uint32_t i = 0; i < count; i++) {
            at = !done[i] && isfinite(length[i]) && (at == UINT32_MAX || length[i] < length[at]) ? i : at;
        }
        if (at == UINT32_MAX || length[at] >= best) {
            break;
        }
        done[at] = true;
        uint32_t polygon = at + 1 == count ? fixture_index_of(&g->all, start->polygon) : g->way_to[at / SAMPLES];
        if (g->all.refs[polygon] == goal->polygon) {
            best = fmin(best, length[at] + (double)tl_distance(points[at], goal->point));
        }
        for (uint32_t to = g->first_way[polygon] * SAMPLES; to < g->first_way[polygon + 1] * SAMPLES; to++) {
            length[to] = fmin(length[to], length[at] + (double)tl_distance(points[at], points[to]));
        }
    }
    free(length);
    free(done);
    free(points);
    return best;
}

// Straight paths on flat levels are never longer than the search's own line, and near the shortest.
static void test_length(void **state)
{
    (void)state;
    test_random random = { 45 };
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t paths = 0, exact = 0;
    double sum = 0.0, worst = 0.0;
    for (uint32_t round = 0; round < 15; round++) {
        fixture_level level = fixture_random(&random, round % 5, 7);
        level.tile_cells = round % 2 == 0 ? 0 : 4;
        level.slope = 0;
        level.detail = false;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        tl_nav_filter filter = tl_default_nav_filter();
        way_graph g = make_graph(navmesh, &filter);
        for (uint32_t i = 0; i < 12; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &g.all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &g.all, &random);
            tl_nav_ref polygons[256];
            tl_nav_corner corners[256];
            tl_nav_path path;
            uint32_t count = 0;
            float length = 0.0f;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons,
                                               256, &path),
                        TL_OK);
            if (path.status != TL_NAV_PATH_COMPLETE) {
                continue;
            }
            TEST_RESULT(tl_navmesh_straight_path(
                            navmesh, &(tl_nav_polygon_path){ polygons, path.polygon_count, start.point, goal.point },
                            corners, 256, &count, &length),
                        TL_OK);
            TEST_CHECK(length <= path.cost * 1.00001f);
            double ratio = (double)length / sampled_shortest(&g, &start, &goal);
            TEST_CHECK(ratio > 0.97); // the samples' own error
            sum += ratio;
            worst = fmax(worst, ratio);
            exact += ratio < 1.0001;
            paths++;
        }
        free_graph(&g);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(paths > 80 && exact == paths);
    TEST_CHECK(sum / paths < 1.00001 && worst < 1.0001);
}

// A partial path ends in the reachable polygon whose closest point is nearest to the goal.
static void test_partial(void **state)
{
    (void)state;
    test_random random = { 42 };
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t partial = 0, routes = 0;
    for (uint32_t round = 0; round < 20; round++) {
        fixture_level level = fixture_random(&random, round % 2 == 0 ? 1 : 5, 9);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        tl_nav_filter filter = tl_default_nav_filter();
        way_graph g = make_graph(navmesh, &filter);
        for (uint32_t i = 0; i < 20; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &g.all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &g.all, &random);
            uint32_t from = fixture_index_of(&g.all, start.polygon);
            if (g.component[from] == g.component[fixture_index_of(&g.all, goal.polygon)]) {
                continue;
            }
            float best = INFINITY;
            for (uint32_t k = 0; k < g.all.count; k++) {
                tl_vec3 closest;
                TEST_RESULT(tl_navmesh_closest_point(navmesh, g.all.refs[k], goal.point, &closest, NULL), TL_OK);
                float d = tl_distance_sq(closest, goal.point);
                best = g.component[k] == g.component[from] && d < best ? d : best;
            }
            tl_nav_ref polygons[512];
            tl_nav_corner corners[512];
            tl_nav_path path;
            TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons,
                                               512, &path),
                        TL_OK);
            TEST_CHECK(path.status == TL_NAV_PATH_UNREACHABLE && path.node_count == 0 && path.polygon_count == 1);
            tl_nav_location near_goal;
            TEST_RESULT(tl_navmesh_find_nearest_reachable(navmesh, NULL, start.polygon, goal.point, &near_goal), TL_OK);
            TEST_CHECK(tl_distance_sq(near_goal.point, goal.point) == best);
            tl_nav_path_buffers buffers = { polygons, 512, corners, 512 };
            tl_nav_route route;
            TEST_RESULT(tl_nav_query_find_route(
                            query, navmesh,
                            &(tl_nav_route_request){ NULL, start.point, goal.point, tl_vec3_make(0.5f, 0.5f, 0.5f) },
                            &buffers, &route),
                        TL_OK);
            // Where a point lies on a border, the route may begin or end on the other side of it.
            if (route.start.polygon == start.polygon && route.goal.polygon == goal.polygon) {
                TEST_CHECK(route.path.status == TL_NAV_PATH_UNREACHABLE);
                TEST_CHECK(tl_distance_sq(route.path.end.point, goal.point) == best);
                routes++;
            }
            partial++;
        }
        free_graph(&g);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(partial > 60 && routes > 50);
}

// Every pool size: the answer is either the whole one, or says that it gave up.
static void test_out_of_nodes(void **state)
{
    (void)state;
    test_random random = { 43 };
    fixture_level level = fixture_random(&random, 2, 12);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_location start = { all.refs[0], { 0, 0, 0 } }, goal = { all.refs[all.count - 1], { 0, 0, 0 } };
    TEST_RESULT(tl_navmesh_closest_point(navmesh, start.polygon, level.origin, &start.point, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_closest_point(navmesh, goal.polygon, tl_vec3_make(99, 0, 99), &goal.point, NULL), TL_OK);
    uint32_t gave_up = 0, complete = 0;
    tl_nav_filter filter = tl_default_nav_filter();
    for (uint32_t max_nodes = 2; max_nodes <= tl_navmesh_link_count(navmesh) + 2; max_nodes++) {
        tl_nav_query_def def = tl_default_nav_query_def();
        def.max_nodes = max_nodes;
        tl_nav_query *query = NULL;
        TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
        tl_nav_ref polygons[512];
        tl_nav_path path;
        TEST_RESULT(
            tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons, 512, &path),
            TL_OK);
        check_chain(navmesh, &filter, polygons, path.polygon_count);
        TEST_CHECK(path.status != TL_NAV_PATH_UNREACHABLE && path.node_count <= max_nodes);
        TEST_CHECK(complete == 0 || path.status == TL_NAV_PATH_COMPLETE);
        gave_up += path.status == TL_NAV_PATH_OUT_OF_NODES;
        complete += path.status == TL_NAV_PATH_COMPLETE;
        tl_nav_query_destroy(query);
    }
    TEST_CHECK(gave_up > 20 && complete > 0);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

// A query is as good after a thousand searches as before, and does not depend on them.
static void test_query_is_reusable(void **state)
{
    (void)state;
    test_random random = { 44 };
    fixture_level level = fixture_random(&random, 4, 16);
    level.tile_cells = 5;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_query *used = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &used, NULL), TL_OK);
    for (uint32_t i = 0; i < 300; i++) {
        tl_nav_location start = fixture_random_location(navmesh, &all, &random);
        tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        tl_nav_query *fresh = NULL;
        TEST_RESULT(tl_nav_query_create(&def, &fresh, NULL), TL_OK);
        tl_nav_ref a[256], b[256];
        tl_nav_path path_a, path_b;
        TEST_RESULT(tl_nav_query_find_path(used, navmesh, &(tl_nav_path_request){ NULL, start, goal }, a, 256, &path_a),
                    TL_OK);
        TEST_RESULT(
            tl_nav_query_find_path(fresh, navmesh, &(tl_nav_path_request){ NULL, start, goal }, b, 256, &path_b),
            TL_OK);
        TEST_CHECK(path_a.polygon_count == path_b.polygon_count && path_a.cost == path_b.cost);
        TEST_CHECK(memcmp(a, b, path_a.polygon_count * sizeof *a) == 0);
        tl_nav_query_destroy(fresh);
    }
    tl_nav_query_destroy(used);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = 1;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_ERR_ARGUMENT);
    def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_location start = { tl_navmesh_polygon_ref(navmesh, 0, 0), { 1, 0, 1 } };
    tl_nav_location goal = { tl_navmesh_polygon_ref(navmesh, 0, 7), { 11, 0, 11 } };
    tl_nav_location stale = { 77, { 0, 0, 0 } }, nan = { start.polygon, { NAN, 0, 0 } };
    tl_nav_ref polygons[8] = { 0 };
    tl_nav_path path;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, stale, goal }, polygons, 8, &path),
                TL_ERR_STALE);
    TEST_RESULT(
        tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, stale }, polygons, 8, &path),
        TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, nan, goal }, polygons, 8, &path),
                TL_ERR_NOT_FINITE);
    const float bad[8] = { 0.0f, -0.0f, -1.0f, -FLT_MIN, NAN, -NAN, INFINITY, -INFINITY };
    for (int i = 0; i < 16; i++) {
        tl_nav_filter filter = tl_default_nav_filter();
        filter.area_cost[i < 8 ? 5 : TL_NAV_MAX_AREA] = bad[i % 8];
        TEST_RESULT(
            tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal }, polygons, 8, &path),
            TL_ERR_ARGUMENT);
    }
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons, 3, &path),
                TL_INCOMPLETE);
    TEST_CHECK(path.polygon_count == 5 && path.status == TL_NAV_PATH_COMPLETE);
    TEST_CHECK(polygons[0] == start.polygon && polygons[3] == 0);
    TEST_CHECK(strcmp(tl_nav_path_status_name(TL_NAV_PATH_OUT_OF_NODES), "out of nodes") == 0);
    TEST_CHECK(strcmp(tl_nav_path_status_name((tl_nav_path_status)9), "unknown") == 0);

    // All in one.
    tl_nav_corner corners[8];
    tl_nav_path_buffers buffers = { polygons, 8, corners, 8 };
    tl_nav_route route;
    tl_vec3 extents = { 1, 2, 1 };
    TEST_RESULT(tl_nav_query_find_route(
                    query, navmesh,
                    &(tl_nav_route_request){ NULL, tl_vec3_make(2, 0.5f, 2), tl_vec3_make(10, 0, 10), extents },
                    &buffers, &route),
                TL_OK);
    TEST_CHECK(route.corner_count == 3 && fabsf(route.length - 2.0f * sqrtf(4.0f + 36.0f)) < 1e-5f);
    TEST_RESULT(tl_nav_query_find_route(
                    query, navmesh,
                    &(tl_nav_route_request){ NULL, tl_vec3_make(2, 0, 2), tl_vec3_make(40, 0, 10), extents }, &buffers,
                    &route),
                TL_NOT_FOUND);
    TEST_CHECK(route.start.polygon != TL_NAV_NO_REF && route.goal.polygon == TL_NAV_NO_REF);
    buffers.corner_capacity = 2;
    TEST_RESULT(tl_nav_query_find_route(
                    query, navmesh,
                    &(tl_nav_route_request){ NULL, tl_vec3_make(2, 0, 2), tl_vec3_make(10, 0, 10), extents }, &buffers,
                    &route),
                TL_INCOMPLETE);
    TEST_CHECK(route.corner_count == 3);
    tl_nav_query_destroy(query);
    tl_nav_query_destroy(NULL);
    tl_navmesh_destroy(navmesh);
}

static void test_memory(void **state)
{
    (void)state;
    uint32_t failures = 0;
    for (uint64_t k = 1;; k++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        tl_nav_query_def def = { 1000, &failing.allocator, TL_DEF_COOKIE };
        tl_nav_query *query = NULL;
        tl_result result = tl_nav_query_create(&def, &query, NULL);
        if (result == TL_OK) {
            tl_nav_query_destroy(query);
            TEST_CHECK(failing.live_blocks == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(query == NULL && failing.live_blocks == 0);
        failures++;
    }
    TEST_CHECK(failures == 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_twin),
        cmocka_unit_test(test_length),
        cmocka_unit_test(test_partial),
        cmocka_unit_test(test_out_of_nodes),
        cmocka_unit_test(test_query_is_reusable),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
