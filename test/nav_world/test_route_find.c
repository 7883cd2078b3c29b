// SPDX-License-Identifier: MIT
//
// Routes against the shortest paths over the same world in memory whole: they bound it from both sides, and say the
// same of what cannot be reached, however few tiles are in memory.
//
//   test_route_find [routes that are refined while tiles come in (150)]

#include "nav_route_file.h"

static const double HERE[3] = { 0, 0, 0 };
static const tl_vec3 EXTENTS = { 3, 60, 3 };

enum { MAX_POINTS = 4096 };

typedef struct route_counts {
    uint32_t reached, unreachable, gates, within_place, folded;
    double stretch, tightness, worst; // sums over those that were reached, and go over gates
} route_counts;

static double edge_of(const fixture_level *level)
{
    return (double)level->width * (double)FIXTURE_STEP * (double)level->cell_size;
}

static bool find_random(test_random *random, const fixture_level *level, const tl_nav_world *world, double at[3],
                        tl_nav_location *out)
{
    const double edge = edge_of(level);
    at[0] = (double)level->origin.x + (double)test_random_unit(random) * edge;
    at[1] = (double)test_random_range(random, -1.0f, 4.0f);
    at[2] = (double)level->origin.z + (double)test_random_unit(random) * edge;
    return tl_nav_world_find_nearest(world, NULL, at, EXTENTS, out) == TL_OK;
}

// Points follow one another no farther than their lengths say, from end to end.
static void check_points(const tl_nav_world *world, const tl_nav_world_route_request *request,
                         const tl_nav_world_route_point *points, const tl_nav_world_route *route)
{
    double start[3], goal[3];
    TEST_CHECK(route->point_count >= 2 && route->point_count <= MAX_POINTS);
    TEST_CHECK(points[0].length == 0.0 && points[route->point_count - 1].length == route->length);
    for (uint32_t i = 1; i < route->point_count; i++) {
        const double dx = points[i].point[0] - points[i - 1].point[0], dz = points[i].point[2] - points[i - 1].point[2];
        const double step = points[i].length - points[i - 1].length;
        TEST_CHECK(sqrt(dx * dx + dz * dz) <= step * (1.0 + 1e-6) + 1e-4);
    }
    tl_nav_world_place_out(world, request->start.point, start);
    tl_nav_world_place_out(world, request->goal.point, goal);
    for (int i = 0; i < 3; i++) {
        TEST_CHECK(fabs(start[i] - points[0].point[i]) <= 1e-4);
        TEST_CHECK(fabs(goal[i] - points[route->point_count - 1].point[i]) <= 1e-4);
    }
}

static void compare_route(const tl_nav_world *world, tl_nav_router *router, tl_nav_query *query,
                          const tl_nav_world_route_request *request, bool is_ramps, route_counts *n)
{
    static tl_nav_world_route_point points[MAX_POINTS];
    tl_nav_world_route route;
    tl_nav_shortest_path truth;
    const tl_nav_path_request path = { NULL, request->start, request->goal };
    TEST_RESULT(tl_nav_world_find_route(world, router, request, points, MAX_POINTS, &route), TL_OK);
    TEST_RESULT(tl_nav_world_find_path(world, query, &path, NULL, &truth), TL_OK);
    // An exact search does not cross an edge and come straight back over it to another floor, where routes do: over the
    // side of a ramp that both floors meet.
    if (is_ramps && route.status == TL_NAV_PATH_COMPLETE && truth.status != TL_NAV_PATH_COMPLETE) {
        n->folded++;
        return;
    }
    TEST_CHECK(route.status == truth.status);
    if (truth.status != TL_NAV_PATH_COMPLETE) {
        TEST_CHECK(route.status == TL_NAV_PATH_UNREACHABLE && route.point_count == 0 &&
                   route.lower_bound == (double)INFINITY && route.length == 0.0);
        n->unreachable++;
        return;
    }
    n->reached++;
    TEST_CHECK(route.lower_bound <= truth.length * (1.0 + 1e-6) + 1e-5);
    const bool is_longer = truth.lower_bound <= route.length * (1.0 + 1e-6) + 1e-5;
    TEST_CHECK(is_longer || is_ramps);
    n->folded += !is_longer;
    check_points(world, request, points, &route);
    if (route.point_count == 2) {
        n->within_place++;
    } else if (truth.length > 1.0) {
        n->gates++;
        n->stretch += route.length / truth.length;
        n->tightness += route.lower_bound / truth.length;
        n->worst = route.length / truth.length > n->worst ? route.length / truth.length : n->worst;
    }
}

static void test_bounds(void **state)
{
    (void)state;
    static const uint32_t TILE[4] = { 2, 3, 5, 8 }, BLOCK[5] = { 1, 2, 4, 8, 16 };
    test_random random = { 31 };
    tl_nav_query *query = NULL;
    route_counts all = { 0 };
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t round = 0; round < 60; round++) {
        route_counts n = { 0 };
        fixture_level level = fixture_random(&random, round % 6, 8 + test_random_below(&random, 40));
        level.tile_cells = TILE[round / 6 % 4];
        world_file file = route_file_make(&level, HERE, BLOCK[round % 5]);
        tl_nav_world *world = world_open(&file, (uint64_t)256 << 20, 4096.0);
        tl_nav_router *router = NULL;
        TEST_RESULT(tl_nav_router_create(world, NULL, &router, NULL), TL_OK);
        const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 10.0 * edge_of(&level));
        world_settle(world, &everywhere, 1);
        const tl_navmesh *navmesh = tl_nav_world_navmesh(world);
        fixture_refs refs = fixture_all_refs(navmesh);
        for (uint32_t pair = 0; pair < 170; pair++) {
            tl_nav_world_route_request request = { fixture_random_location(navmesh, &refs, &random),
                                                   fixture_random_location(navmesh, &refs, &random) };
            // Half of the ends are nearest points, many of them on walls; not where ways fork, as above.
            double at[3];
            if (round % 6 != 5 && pair % 2 == 0 &&
                (!find_random(&random, &level, world, at, &request.start) ||
                 !find_random(&random, &level, world, at, &request.goal))) {
                continue;
            }
            compare_route(world, router, query, &request, round % 6 == 5, &n);
        }
        free(refs.refs);
        tl_nav_router_destroy(router);
        tl_nav_world_destroy(world);
        world_file_free(&file);
        all.reached += n.reached;
        all.unreachable += n.unreachable;
        all.gates += n.gates;
        all.within_place += n.within_place;
        all.folded += n.folded;
        all.stretch += n.stretch;
        all.tightness += n.tightness;
        all.worst = n.worst > all.worst ? n.worst : all.worst;
    }
    tl_nav_query_destroy(query);
    print_message(
        "%u routes, %u unreachable, %u within a place, %u folded; length %.4f of the path (worst %.3f), bound %.4f\n",
        all.reached, all.unreachable, all.within_place, all.folded, all.stretch / (double)all.gates, all.worst,
        all.tightness / (double)all.gates);
    TEST_CHECK(all.folded < 100);
    TEST_CHECK(all.reached > 6000 && all.unreachable > 700 && all.within_place > 50 && all.gates > 5000);
}

// With the tiles of both ends alone in memory the answer is the same, up to the rounding of what a frame holds.
static void test_few_tiles(void **state)
{
    (void)state;
    test_random random = { 7 };
    uint32_t asked = 0, open = 0;
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 48);
        level.tile_cells = 4;
        world_file file = route_file_make(&level, HERE, 4);
        tl_nav_world *whole = world_open(&file, (uint64_t)256 << 20, 4096.0);
        tl_nav_router *router = NULL, *few_router = NULL;
        TEST_RESULT(tl_nav_router_create(whole, NULL, &router, NULL), TL_OK);
        const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 10.0 * edge_of(&level));
        world_settle(whole, &everywhere, 1);
        for (uint32_t pair = 0; pair < 30; pair++) {
            double from[3], to[3];
            tl_nav_world_route_request request, in_few;
            if (!find_random(&random, &level, whole, from, &request.start) ||
                !find_random(&random, &level, whole, to, &request.goal)) {
                continue;
            }
            tl_nav_world *few = world_open(&file, (uint64_t)256 << 20, 8.0);
            TEST_RESULT(tl_nav_router_create(few, NULL, &few_router, NULL), TL_OK);
            const tl_nav_world_interest ends[2] = { world_interest(HERE, from[0], from[2], 4.5),
                                                    world_interest(HERE, to[0], to[2], 4.5) };
            world_settle(few, ends, 2);
            open += world_state(few).loaded < world_state(few).places / 2;
            tl_nav_world_route a, b;
            if (tl_nav_world_find_nearest(few, NULL, from, EXTENTS, &in_few.start) == TL_OK &&
                tl_nav_world_find_nearest(few, NULL, to, EXTENTS, &in_few.goal) == TL_OK) {
                TEST_RESULT(tl_nav_world_find_route(whole, router, &request, NULL, 0, &a), TL_OK);
                TEST_RESULT(tl_nav_world_find_route(few, few_router, &in_few, NULL, 0, &b), TL_OK);
                TEST_CHECK(a.status == b.status && a.point_count == b.point_count);
                // Ends are rounded in each frame, and both bounds leave room for that.
                const double rounding = 1e-4 + 1e-6 * (a.status == TL_NAV_PATH_COMPLETE ? a.length : 0.0);
                TEST_CHECK(fabs(a.length - b.length) <= rounding);
                TEST_CHECK(a.lower_bound == b.lower_bound || fabs(a.lower_bound - b.lower_bound) <= rounding);
                asked++;
            }
            tl_nav_router_destroy(few_router);
            tl_nav_world_destroy(few);
        }
        tl_nav_router_destroy(router);
        tl_nav_world_destroy(whole);
        world_file_free(&file);
    }
    print_message("%u routes with few tiles in memory\n", asked);
    TEST_CHECK(asked > 80 && open > 80);
}

// A world of which the tiles at both ends of a route are in memory, in the frame of the world that is there whole.
typedef struct route_part {
    tl_nav_world *world;
    tl_nav_router *router;
    double ends[2][3];
    tl_nav_location at[2];
} route_part;

static void load_part(route_part *part, const tl_nav_world_interest *interests, uint32_t count)
{
    const tl_vec3 extents = { 0.1f, 0.5f, 0.1f };
    world_settle(part->world, interests, count);
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_nav_world_find_nearest(part->world, NULL, part->ends[i], extents, &part->at[i]), TL_OK);
    }
}

static tl_nav_world_interest interest_at(const double point[3], double radius)
{
    const tl_nav_world_interest interest = { { point[0], point[1], point[2] }, radius };
    return interest;
}

typedef struct refine_counts {
    uint32_t refined, in_part, open, early; // open: stages without a proof; early: proofs before all tiles were there
} refine_counts;

// What a part of the tiles says: the path of the whole world, or that it may not be, with a bound that holds.
static bool is_proven_path(const route_part *part, tl_nav_query *query, const tl_nav_shortest_path *truth)
{
    const tl_nav_path_request request = { NULL, part->at[0], part->at[1] };
    tl_nav_shortest_path path;
    const tl_result result = tl_nav_world_find_path(part->world, query, &request, NULL, &path);
    TEST_CHECK(result == TL_OK || result == TL_NOT_LOADED);
    if (result == TL_NOT_LOADED) {
        TEST_CHECK(path.lower_bound <= truth->length + 1e-4);
        TEST_CHECK(path.status != TL_NAV_PATH_COMPLETE || path.length >= truth->length - 1e-4);
        return false;
    }
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && fabs(path.length - truth->length) <= 1e-4);
    return true;
}

// From the route to the path, while tiles come in: with all that the circle around both ends touches whose diameter is
// the route's length, the path is proven, and is that of the whole world. No path as short as the route leaves it.
static void refine_route(route_part *part, tl_nav_query *query, const tl_nav_shortest_path *truth, refine_counts *n)
{
    enum { STAGES = 4 };
    tl_nav_world_route route;
    const tl_nav_world_interest few[3] = { interest_at(HERE, 0.0), interest_at(part->ends[0], 2.0),
                                           interest_at(part->ends[1], 2.0) };
    load_part(part, few, 3);
    const tl_nav_world_route_request request = { part->at[0], part->at[1] };
    TEST_RESULT(tl_nav_world_find_route(part->world, part->router, &request, NULL, 0, &route), TL_OK);
    TEST_CHECK(route.status == truth->status);
    if (route.status != TL_NAV_PATH_COMPLETE) {
        return;
    }
    TEST_CHECK(truth->lower_bound <= route.length + 1e-4 && route.lower_bound <= truth->length + 1e-4);
    const double middle[3] = { 0.5 * (part->ends[0][0] + part->ends[1][0]), 0.0,
                               0.5 * (part->ends[0][2] + part->ends[1][2]) };
    bool is_proven = is_proven_path(part, query, truth);
    for (int stage = 1; stage <= STAGES; stage++) {
        const double radius = (0.5 * route.length + 1.0) * (double)stage / (double)STAGES;
        const tl_nav_world_interest all[4] = { few[0], few[1], few[2], interest_at(middle, radius) };
        n->open += !is_proven;
        n->early += is_proven;
        load_part(part, all, 4);
        // A circle that touches a tile by less than its rounding is not said to be covered.
        TEST_RESULT(tl_nav_world_covers(part->world, middle, 0.9 * radius), TL_OK);
        is_proven = is_proven_path(part, query, truth);
    }
    TEST_CHECK(is_proven);
    n->refined++;
    n->in_part += world_state(part->world).loaded < world_state(part->world).places;
}

static uint32_t refined_pairs = 150;

static void test_refined(void **state)
{
    (void)state;
    test_random random = { 19 };
    refine_counts n = { 0, 0, 0, 0 };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t kind = 0; kind < 5; kind++) {
        fixture_level level = fixture_random(&random, kind, 48);
        level.tile_cells = 4;
        world_file file = route_file_make(&level, HERE, 4);
        tl_nav_world *whole = world_open(&file, (uint64_t)256 << 20, 4096.0);
        const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 10.0 * edge_of(&level));
        world_settle(whole, &everywhere, 1);
        fixture_refs refs = fixture_all_refs(tl_nav_world_navmesh(whole));
        for (uint32_t pair = 0; pair < refined_pairs / 5; pair++) {
            route_part part;
            tl_nav_path_request request = { NULL, { 0 }, { 0 } };
            tl_nav_shortest_path truth;
            memset(&part, 0, sizeof part);
            request.start = fixture_random_location(tl_nav_world_navmesh(whole), &refs, &random);
            request.goal = fixture_random_location(tl_nav_world_navmesh(whole), &refs, &random);
            tl_nav_world_place_out(whole, request.start.point, part.ends[0]);
            tl_nav_world_place_out(whole, request.goal.point, part.ends[1]);
            TEST_RESULT(tl_nav_world_find_path(whole, query, &request, NULL, &truth), TL_OK);
            part.world = world_open(&file, (uint64_t)256 << 20, 4096.0);
            TEST_RESULT(tl_nav_router_create(part.world, NULL, &part.router, NULL), TL_OK);
            refine_route(&part, query, &truth, &n);
            tl_nav_router_destroy(part.router);
            tl_nav_world_destroy(part.world);
        }
        free(refs.refs);
        tl_nav_world_destroy(whole);
        world_file_free(&file);
    }
    tl_nav_query_destroy(query);
    print_message(
        "%u routes refined, %u of them with a part of the tiles; proven before the last tiles %u times of %u\n",
        n.refined, n.in_part, n.early, n.early + n.open);
    TEST_CHECK(n.refined > refined_pairs / 2 && n.in_part > refined_pairs / 5 && n.open > refined_pairs / 2);
}

static void test_short_buffers(void **state)
{
    (void)state;
    test_random random = { 3 };
    fixture_level level = fixture_random(&random, 0, 32);
    level.tile_cells = 2;
    world_file file = route_file_make(&level, HERE, 2);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    tl_nav_router *router = NULL;
    TEST_RESULT(tl_nav_router_create(world, NULL, &router, NULL), TL_OK);
    const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 1000.0);
    world_settle(world, &everywhere, 1);
    const double x = (double)level.origin.x, z = (double)level.origin.z, edge = edge_of(&level);
    const double from[3] = { x + 1.0, 0, z + 1.0 }, to[3] = { x + edge - 3.0, 0, z + edge - 20.0 };
    tl_nav_world_route_request request;
    tl_nav_world_route_point points[64], part[64];
    tl_nav_world_route route, again;
    TEST_RESULT(tl_nav_world_find_nearest(world, NULL, from, EXTENTS, &request.start), TL_OK);
    TEST_RESULT(tl_nav_world_find_nearest(world, NULL, to, EXTENTS, &request.goal), TL_OK);
    TEST_RESULT(tl_nav_world_find_route(world, router, &request, points, 64, &route), TL_OK);
    TEST_CHECK(route.point_count > 5 && route.point_count <= 64);
    for (uint32_t capacity = 1; capacity <= route.point_count; capacity++) {
        const tl_result result = tl_nav_world_find_route(world, router, &request, part, capacity, &again);
        TEST_RESULT(result, capacity < route.point_count ? TL_INCOMPLETE : TL_OK);
        TEST_CHECK(memcmp(&route, &again, sizeof route) == 0 && memcmp(points, part, capacity * sizeof *part) == 0);
    }
    tl_nav_router_destroy(router);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_few_tiles),
        cmocka_unit_test(test_refined),
        cmocka_unit_test(test_short_buffers),
    };
    if (argc > 1) {
        refined_pairs = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
