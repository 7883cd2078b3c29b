// SPDX-License-Identifier: MIT
//
// Every query ends, however few nodes it has: all of them with pools of 2 to 64 nodes, on hubs (polygons with many
// neighbours), on levels, and on prepared navmeshes. One that says TL_OK says what a large pool says.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_around.h>
#include <talus/nav_corridor.h>
#include <talus/nav_prepare.h>
#include <talus/nav_wide.h>

enum { BUFFER = 1024, LARGE_POOL = 1 << 14 };

// What a query said. `exact`: bytes that any pool must say, if its result is TL_OK and `is_whole`.
typedef struct pool_answer {
    tl_result result;
    bool is_whole;
    uint64_t exact;
} pool_answer;

typedef struct pool_case {
    const tl_navmesh *navmesh;
    tl_nav_query *query;
    tl_nav_location from, to;
    float radius;
} pool_case;

static tl_nav_ref g_polygons[BUFFER];
static tl_nav_corner g_corners[BUFFER];
static tl_nav_wall_segment g_walls[BUFFER];
static tl_nav_field_entry g_entries[BUFFER];

static uint64_t hash_bytes(const void *bytes, size_t size)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 0x100000001b3u;
    }
    return hash;
}

static uint64_t hash_location(const tl_nav_location *location)
{
    return hash_bytes(&location->polygon, sizeof location->polygon) * 31 +
           hash_bytes(&location->point, sizeof location->point);
}

static bool is_polygon(const pool_case *c, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    return tl_navmesh_resolve(c->navmesh, ref, &tile, NULL) == TL_OK;
}

static pool_answer ask_find_path(const pool_case *c)
{
    const tl_nav_path_request request = { NULL, c->from, c->to };
    tl_nav_path path;
    tl_result result = tl_nav_query_find_path(c->query, c->navmesh, &request, g_polygons, BUFFER, &path);
    TEST_CHECK(path.polygon_count > 0 && g_polygons[0] == c->from.polygon);
    return (pool_answer){ result, false, 0 };
}

static pool_answer ask_sliced_path(const pool_case *c)
{
    const tl_nav_path_request request = { NULL, c->from, c->to };
    tl_nav_path_progress progress = { TL_NAV_PATH_UNFINISHED, 0, 0, 0 };
    tl_nav_path path;
    tl_result result = tl_nav_query_begin_path(c->query, c->navmesh, &request);
    for (int i = 0; result == TL_OK && progress.status == TL_NAV_PATH_UNFINISHED; i++) {
        TEST_CHECK(i < 100000);
        result = tl_nav_query_step_path(c->query, 7, &progress);
    }
    TEST_RESULT(tl_nav_query_write_path(c->query, g_polygons, BUFFER, &path), TL_OK);
    return (pool_answer){ result, false, 0 };
}

static pool_answer ask_shortest_path(const pool_case *c)
{
    const tl_nav_path_request request = { NULL, c->from, c->to };
    const tl_nav_path_buffers buffers = { g_polygons, BUFFER, g_corners, BUFFER };
    tl_nav_shortest_path path;
    tl_result result = tl_nav_query_find_shortest_path(c->query, c->navmesh, &request, &buffers, &path);
    // Of two paths as long as one another either may be found.
    const float length = (float)path.length;
    return (pool_answer){ result, path.status == TL_NAV_PATH_COMPLETE, (uint64_t)roundf(length * 256.0f) };
}

static pool_answer ask_route(const pool_case *c)
{
    const tl_nav_route_request request = { NULL, c->from.point, c->to.point, { 1.0f, 4.0f, 1.0f } };
    const tl_nav_path_buffers buffers = { g_polygons, BUFFER, g_corners, BUFFER };
    tl_nav_route route;
    return (pool_answer){ tl_nav_query_find_route(c->query, c->navmesh, &request, &buffers, &route), false, 0 };
}

static pool_answer ask_move(const pool_case *c)
{
    const tl_nav_move_request request = { NULL, c->from, c->to.point };
    tl_nav_move move;
    tl_result result = tl_nav_query_move_along_surface(c->query, c->navmesh, &request, g_polygons, BUFFER, &move);
    TEST_CHECK(is_polygon(c, move.end.polygon) && move.polygon_count > 0 && g_polygons[0] == c->from.polygon);
    TEST_CHECK(g_polygons[move.polygon_count - 1] == move.end.polygon);
    return (pool_answer){ result, true, hash_location(&move.end) };
}

static pool_answer ask_find_wall(const pool_case *c)
{
    const tl_nav_around_request request = { NULL, c->from, c->radius };
    tl_nav_wall wall;
    tl_result result = tl_nav_query_find_wall(c->query, c->navmesh, &request, &wall);
    TEST_CHECK(is_polygon(c, wall.polygon) && wall.distance <= c->radius);
    return (pool_answer){ result, true, hash_bytes(&wall.distance, sizeof wall.distance) };
}

static pool_answer ask_find_walls(const pool_case *c)
{
    const tl_nav_around_request request = { NULL, c->from, c->radius };
    uint32_t count = 0;
    uint64_t hash = 0;
    tl_result result = tl_nav_query_find_walls(c->query, c->navmesh, &request, g_walls, BUFFER, &count);
    TEST_CHECK(count <= BUFFER);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(is_polygon(c, g_walls[i].polygon));
        hash = hash * 31 + hash_bytes(&g_walls[i].start, sizeof g_walls[i].start);
    }
    return (pool_answer){ result, true, hash };
}

static pool_answer ask_flood(const pool_case *c)
{
    uint32_t count = 0;
    tl_result result = tl_nav_query_flood(c->query, c->navmesh, &c->from, NULL, g_entries, BUFFER, &count);
    return (pool_answer){ result, true, count };
}

static pool_answer ask_random_reachable(const pool_case *c)
{
    static const uint64_t RANDOM[2] = { 0x0123456789abcdefu, 0xfedcba9876543210u };
    const tl_nav_around_request request = { NULL, c->from, c->radius };
    tl_nav_location location;
    tl_result result = tl_nav_query_random_reachable(c->query, c->navmesh, &request, RANDOM, &location);
    return (pool_answer){ result, true, hash_location(&location) };
}

static pool_answer ask_random_points(const pool_case *c)
{
    static const uint64_t RANDOM[6] = { 1, UINT64_MAX, 0x0123456789abcdefu, 3, 0xfedcba9876543210u, 5 };
    const tl_nav_around_request request = { NULL, c->from, c->radius };
    tl_nav_location locations[3];
    tl_result result = tl_nav_query_random_reachable_points(c->query, c->navmesh, &request, RANDOM, 3, locations);
    return (pool_answer){ result, true, hash_location(&locations[0]) + hash_location(&locations[2]) };
}

static pool_answer ask_wide_path(const pool_case *c)
{
    const tl_nav_path_request request = { NULL, c->from, c->to };
    tl_nav_wide_path path;
    tl_result result = tl_nav_query_find_wide_path(c->query, c->navmesh, &request, 0.8f, g_corners, BUFFER, &path);
    return (pool_answer){ result, false, 0 };
}

static pool_answer ask_wide_reachable(const pool_case *c)
{
    const tl_nav_path_request request = { NULL, c->from, c->to };
    tl_nav_wide_status status = TL_NAV_WIDE_NONE;
    tl_result result = tl_nav_query_is_wide_reachable(c->query, c->navmesh, &request, 0.8f, &status);
    return (pool_answer){ result, status != TL_NAV_WIDE_OUT_OF_NODES, status };
}

static pool_answer ask_wide_place(const pool_case *c)
{
    const tl_nav_around_request request = { NULL, c->from, c->radius };
    tl_nav_location place;
    tl_result result = tl_nav_query_find_wide_place(c->query, c->navmesh, &request, 0.8f, &place);
    return (pool_answer){ result, true, hash_location(&place) };
}

static pool_answer ask_clearance(const pool_case *c)
{
    const tl_nav_corner corners[2] = { { c->from.point, c->from.polygon, TL_NAV_CORNER_START, TL_NAV_NO_REF },
                                       { c->from.point, c->from.polygon, TL_NAV_CORNER_END, TL_NAV_NO_REF } };
    float clearance = 0.0f;
    tl_result result = tl_nav_query_path_clearance(c->query, c->navmesh, NULL, corners, 2, c->radius, &clearance);
    return (pool_answer){ result, true, hash_bytes(&clearance, sizeof clearance) };
}

static pool_answer ask_corridor(const pool_case *c)
{
    tl_nav_corridor corridor = tl_nav_corridor_init(g_polygons, BUFFER);
    tl_nav_path path;
    tl_nav_corridor_reset(&corridor, &c->from);
    tl_result result = tl_nav_corridor_find(&corridor, c->query, c->navmesh, NULL, &c->to, &path);
    const tl_vec3 half = { 1.0f, 4.0f, 1.0f };
    tl_nav_corridor_improve(&corridor, c->query, c->navmesh, NULL, 8, 100, NULL);
    tl_nav_corridor_move(&corridor, c->query, c->navmesh, NULL, c->to.point);
    tl_nav_corridor_move_target(&corridor, c->query, c->navmesh, NULL, c->from.point);
    tl_nav_corridor_repair(&corridor, c->query, c->navmesh, NULL, half, &path);
    TEST_CHECK(corridor.count > 0 && is_polygon(c, corridor.path[0]));
    return (pool_answer){ result, false, 0 };
}

typedef struct pool_query {
    const char *name;
    pool_answer (*ask)(const pool_case *c);
} pool_query;

static const pool_query QUERIES[] = {
    { "find_path", ask_find_path },
    { "begin_path", ask_sliced_path },
    { "find_shortest_path", ask_shortest_path },
    { "find_route", ask_route },
    { "move_along_surface", ask_move },
    { "find_wall", ask_find_wall },
    { "find_walls", ask_find_walls },
    { "flood", ask_flood },
    { "random_reachable", ask_random_reachable },
    { "random_reachable_points", ask_random_points },
    { "find_wide_path", ask_wide_path },
    { "is_wide_reachable", ask_wide_reachable },
    { "find_wide_place", ask_wide_place },
    { "path_clearance", ask_clearance },
    { "corridor", ask_corridor },
};
enum { QUERY_COUNT = sizeof QUERIES / sizeof *QUERIES };

typedef struct pool_tally {
    uint32_t ok, no_nodes, other;
} pool_tally;

static pool_tally g_tallies[QUERY_COUNT];

// All queries from one place to another, with every pool.
static void ask_all(pool_case *c)
{
    static const uint32_t POOLS[] = { 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64 };
    for (int i = 0; i < QUERY_COUNT; i++) {
        c->query = fixture_query(LARGE_POOL);
        const pool_answer expected = QUERIES[i].ask(c);
        tl_nav_query_destroy(c->query);
        for (size_t k = 0; k < sizeof POOLS / sizeof *POOLS; k++) {
            c->query = fixture_query(POOLS[k]);
            for (int again = 0; again < 2; again++) { // what the first left behind must not matter
                const pool_answer answer = QUERIES[i].ask(c);
                pool_tally *tally = &g_tallies[i];
                *(answer.result == TL_OK          ? &tally->ok
                  : answer.result == TL_ERR_NODES ? &tally->no_nodes
                                                  : &tally->other) += 1;
                if (answer.result != TL_ERR_NODES && answer.is_whole &&
                    (answer.result != expected.result || answer.exact != expected.exact)) {
                    fail_msg("%s with %u nodes: %s, not %s", QUERIES[i].name, POOLS[k], tl_result_name(answer.result),
                             tl_result_name(expected.result));
                }
            }
            tl_nav_query_destroy(c->query);
        }
    }
}

static void ask_everywhere(const tl_navmesh *navmesh, test_random *random, int places)
{
    for (int i = 0; i < places; i++) {
        pool_case c = { navmesh, NULL, { 0, { 0, 0, 0 } }, { 0, { 0, 0, 0 } }, i % 2 == 0 ? 1000.0f : 5.0f };
        const uint64_t from[2] = { test_random_u64(random), test_random_u64(random) };
        const uint64_t to[2] = { test_random_u64(random), test_random_u64(random) };
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, from, &c.from), TL_OK);
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, to, &c.to), TL_OK);
        if (i == 0) { // from the first polygon, which is the hub
            c.from.polygon = tl_navmesh_polygon_ref(navmesh, 0, 0);
            TEST_RESULT(tl_navmesh_closest_point(navmesh, c.from.polygon, c.from.point, &c.from.point, NULL), TL_OK);
        }
        ask_all(&c);
    }
}

// A polygon of many corners with a triangle on each edge.
static tl_navmesh *make_hub(uint32_t corners)
{
    uint32_t index_count = 4 * corners;
    int32_t *vertices = calloc(6 * (size_t)corners, sizeof *vertices);
    uint32_t *numbers = calloc(2 * (size_t)index_count + 4 * ((size_t)corners + 2), sizeof *numbers);
    uint32_t *indices = numbers, *neighbours = numbers + index_count, *first = numbers + 2 * index_count;
    uint32_t *areas = first + corners + 2, *regions = areas + corners + 1;
    for (uint32_t i = 0; i < corners; i++) {
        const double turn = -6.283185307179586 / (double)corners;
        const double at[2] = { turn * (double)i, turn * ((double)i + 0.5) };
        for (int k = 0; k < 2; k++) {
            const double reach = k == 0 ? 10000.0 : 12000.0;
            vertices[3 * (k * (int)corners + (int)i)] = (int32_t)(20000.0 + reach * cos(at[k]));
            vertices[3 * (k * (int)corners + (int)i) + 2] = (int32_t)(20000.0 + reach * sin(at[k]));
        }
        const uint32_t triangle = corners + 3 * i;
        indices[i] = i;
        neighbours[i] = i + 1;
        indices[triangle] = (i + 1) % corners;
        indices[triangle + 1] = i;
        indices[triangle + 2] = corners + i;
        neighbours[triangle + 1] = TL_NO_POLYGON;
        neighbours[triangle + 2] = TL_NO_POLYGON;
        first[i + 1] = triangle;
        areas[i] = TL_NAV_MAX_AREA;
    }
    first[corners + 1] = index_count;
    areas[corners] = TL_NAV_MAX_AREA;
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = 2 * corners;
    mesh.polygon_count = corners + 1;
    mesh.index_count = index_count;
    mesh.vertices = vertices;
    mesh.first = first;
    mesh.indices = indices;
    mesh.neighbours = neighbours;
    mesh.areas = areas;
    mesh.regions = regions;
    mesh.contours = regions;
    mesh.cell_size = 0.01f;
    mesh.cell_height = 0.01f;
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.agent_height = 2.0f;
    source.agent_max_climb = 1.0f;
    tl_nav_tile *tile = NULL;
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    free(vertices);
    free(numbers);
    return navmesh;
}

static void queries_end_on_hubs(void **state)
{
    (void)state;
    test_random random = { 1 };
    for (uint32_t corners = 8; corners <= 64; corners *= 2) {
        tl_navmesh *navmesh = make_hub(corners);
        ask_everywhere(navmesh, &random, 4);
        TEST_RESULT(tl_navmesh_prepare_wide(navmesh, NULL, NULL), TL_OK);
        ask_everywhere(navmesh, &random, 2);
        tl_navmesh_destroy(navmesh);
    }
}

static void queries_end_on_levels(void **state)
{
    (void)state;
    test_random random = { 2 };
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 12);
        level.tile_cells = kind % 2 == 0 ? 4 : 0;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        ask_everywhere(navmesh, &random, 6);
        tl_navmesh_destroy(navmesh);
    }
}

static void queries_end_on_prepared_navmeshes(void **state)
{
    (void)state;
    static const tl_nav_prepared_kind KINDS[] = { TL_NAV_PREPARED_GRAPH, TL_NAV_PREPARED_TABLE };
    test_random random = { 3 };
    uint32_t by_graph = 0;
    for (uint32_t i = 0; i < 12; i++) {
        fixture_level level = fixture_random(&random, 1 + i % 4, 14);
        level.tile_cells = i / 2 % 2 == 0 ? 0 : 5;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        tl_nav_prepare_def def = tl_default_nav_prepare_def();
        tl_nav_prepared prepared;
        const tl_nav_prepared_kind kind = KINDS[i % 2];
        def.table_bytes = kind == TL_NAV_PREPARED_TABLE ? 1u << 28 : 0;
        TEST_RESULT(tl_navmesh_prepare(navmesh, &def, &prepared), TL_OK);
        by_graph += prepared.kind == kind && prepared.corner_vertex_count > 8;
        ask_everywhere(navmesh, &random, 4);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(by_graph >= 9);
}

// The searches that have no other way to say it ran out somewhere, and answered elsewhere.
static void pools_were_too_small_and_large_enough(void **state)
{
    (void)state;
    for (int i = 0; i < QUERY_COUNT; i++) {
        TEST_CHECK(g_tallies[i].ok > 0 && g_tallies[i].other <= g_tallies[i].ok + g_tallies[i].no_nodes);
        const bool has_status = g_tallies[i].no_nodes == 0;
        TEST_CHECK(!has_status || strstr(QUERIES[i].name, "path") != NULL || strstr(QUERIES[i].name, "route") != NULL ||
                   strstr(QUERIES[i].name, "reachable") != NULL || strstr(QUERIES[i].name, "corridor") != NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(queries_end_on_hubs),
        cmocka_unit_test(queries_end_on_levels),
        cmocka_unit_test(queries_end_on_prepared_navmeshes),
        cmocka_unit_test(pools_were_too_small_and_large_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
