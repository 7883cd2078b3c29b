// SPDX-License-Identifier: MIT
//
// Navmeshes with walls kept for wide agents beside twins without: the same bits, whatever tiles come and go, whatever
// the radius and the filter; an edit drops the tiles near it and no others; memory.

#include "nav_bake.h"
#include "nav_fixture.h"
#include "stacked_levels.h"

#include <talus/nav_wide.h>

#include <math.h>

enum { CAPACITY = 1024 };

static const float MAX_RADIUS = 1.9f;

typedef struct coverage {
    uint32_t complete, bent, unreachable, blocked, moved, beyond, filtered;
} coverage;

static tl_nav_query *make_query(void)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    def.max_nodes = 1 << 15;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    return query;
}

static bool same_location(const tl_nav_location *a, const tl_nav_location *b)
{
    return a->polygon == b->polygon && a->point.x == b->point.x && a->point.y == b->point.y && a->point.z == b->point.z;
}

static bool refuse_some(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    (void)user;
    return (tl_nav_tile_polygon_area(tile, polygon) > 9.0) == (polygon % 5 != 0);
}

static void compare_path(tl_nav_query *query, const tl_navmesh *navmeshes[2], const tl_nav_filter *filter, float radius,
                         const tl_nav_location ends[2], coverage *seen)
{
    static tl_nav_corner corners[2][CAPACITY];
    tl_nav_wide_path paths[2];
    memset(paths, 0, sizeof paths);
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_nav_query_find_wide_path(query, navmeshes[i], &(tl_nav_path_request){ filter, ends[0], ends[1] },
                                                radius, corners[i], CAPACITY, &paths[i]),
                    TL_OK);
    }
    TEST_CHECK(paths[0].status == paths[1].status && paths[0].corner_count == paths[1].corner_count);
    TEST_CHECK(paths[0].length == paths[1].length && paths[0].surface_length == paths[1].surface_length);
    TEST_CHECK(paths[0].wall_distance == paths[1].wall_distance && paths[0].node_count == paths[1].node_count);
    for (uint32_t i = 0; i < paths[0].corner_count; i++) {
        const tl_nav_location a = { corners[0][i].polygon, corners[0][i].point };
        const tl_nav_location b = { corners[1][i].polygon, corners[1][i].point };
        TEST_CHECK(same_location(&a, &b) && corners[0][i].flags == corners[1][i].flags);
    }
    TEST_CHECK(paths[0].status != TL_NAV_WIDE_OUT_OF_NODES);
    tl_nav_wide_status status = TL_NAV_WIDE_OUT_OF_NODES;
    TEST_RESULT(tl_nav_query_is_wide_reachable(query, navmeshes[0], &(tl_nav_path_request){ filter, ends[0], ends[1] },
                                               radius, &status),
                TL_OK);
    TEST_CHECK(status == paths[0].status);
    seen->complete += paths[0].status == TL_NAV_WIDE_COMPLETE;
    seen->bent += paths[0].corner_count > 2;
    seen->unreachable += paths[0].status == TL_NAV_WIDE_UNREACHABLE;
    seen->blocked += paths[0].status > TL_NAV_WIDE_OUT_OF_NODES;
    seen->beyond += radius > MAX_RADIUS;
    seen->filtered += filter != NULL;
}

// Random places and paths on two navmeshes of the same tiles.
static void compare(tl_nav_query *query, const tl_navmesh *prepared, const tl_navmesh *plain, test_random *random,
                    uint32_t count, coverage *seen)
{
    const tl_navmesh *navmeshes[2] = { prepared, plain };
    fixture_refs all = fixture_all_refs(plain);
    for (uint32_t i = 0; i < count && all.count > 0; i++) {
        float radius = test_random_range(random, 0.55f, i % 8 == 0 ? 2.6f : MAX_RADIUS);
        tl_nav_filter filter = tl_default_nav_filter();
        filter.pass = refuse_some;
        const tl_nav_filter *asked = i % 6 == 5 ? &filter : NULL;
        tl_nav_location ends[2];
        for (int e = 0; e < 2; e++) {
            tl_nav_location at = fixture_random_location(plain, &all, random), places[2];
            tl_result results[2];
            for (int n = 0; n < 2; n++) {
                results[n] = tl_nav_query_find_wide_place(
                    query, navmeshes[n], &(tl_nav_around_request){ asked, at, 3.0f }, radius, &places[n]);
            }
            TEST_CHECK(results[0] == results[1] && (results[0] == TL_OK || results[0] == TL_NOT_FOUND));
            TEST_CHECK(results[0] != TL_OK || same_location(&places[0], &places[1]));
            ends[e] = results[0] == TL_OK && i % 4 != 0 ? places[0] : at;
            seen->moved += results[0] == TL_OK && !same_location(&at, &places[0]);
        }
        compare_path(query, navmeshes, asked, radius, ends, seen);
    }
    free(all.refs);
}

static void toggle_tile(const fixture_level *level, tl_navmesh *navmeshes[2], int32_t x, int32_t z)
{
    for (int i = 0; i < 2; i++) {
        if (tl_navmesh_remove_tile(navmeshes[i], x, z) != TL_OK) {
            tl_nav_tile *tile = fixture_build_tile(level, x, z, NULL);
            if (tile != NULL) {
                TEST_RESULT(tl_navmesh_add_tile(navmeshes[i], tile, TL_NAV_TILE_OWNED), TL_OK);
            }
        }
    }
}

static void test_edits(void **state)
{
    (void)state;
    test_random random = { 41 };
    tl_nav_query *query = make_query();
    tl_nav_wide_def def = tl_default_nav_wide_def();
    coverage seen = { 0 };
    uint32_t kept = 0, made_locally = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = round % 4 == 0 ? 0 : 1 + round % 2;
        def.max_radius = round % 3 == 2 ? 1000.0f : MAX_RADIUS; // or as far as can be seen
        level.shake = round % 6 == 5 ? 0 : level.shake;
        tl_navmesh *navmeshes[2] = { fixture_build(&level, NULL), fixture_build(&level, NULL) };
        for (uint32_t edit = 0; edit < 6; edit++) {
            tl_nav_wide_report report;
            TEST_RESULT(tl_navmesh_prepare_wide(navmeshes[0], &def, &report), TL_OK);
            TEST_CHECK(report.tile_count == tl_navmesh_tile_count(navmeshes[0]));
            TEST_CHECK(report.bytes > 0 || report.tile_count == 0);
            made_locally += edit > 0 && report.made_tile_count > 0 && report.made_tile_count < report.tile_count;
            compare(query, navmeshes[0], navmeshes[1], &random, 12, &seen);
            if (level.tile_cells == 0) {
                break;
            }
            // Half of the time several tiles, and no call in between.
            for (uint32_t k = 0; k < 1 + edit % 2 * 3; k++) {
                uint32_t size = level.width / level.tile_cells;
                toggle_tile(&level, navmeshes, (int32_t)test_random_below(&random, size),
                            (int32_t)test_random_below(&random, size));
            }
            compare(query, navmeshes[0], navmeshes[1], &random, 12, &seen);
            kept++;
        }
        tl_navmesh_destroy(navmeshes[0]);
        tl_navmesh_destroy(navmeshes[1]);
    }
    print_message("complete %u (bent %u), unreachable %u, blocked %u, moved %u, wider than prepared %u, filtered %u; "
                  "%u edits, %u of them made anew in part\n",
                  seen.complete, seen.bent, seen.unreachable, seen.blocked, seen.moved, seen.beyond, seen.filtered,
                  kept, made_locally);
    TEST_CHECK(seen.complete > 400 && seen.bent > 200 && seen.unreachable > 200 && seen.blocked > 10);
    TEST_CHECK(seen.moved > 300 && seen.beyond > 40 && seen.filtered > 100 && made_locally > 20);
    tl_nav_query_destroy(query);
}

// No wall counts that is farther than one that forbids all of a polygon: so a reach beyond the level costs no more than
// one as long as its polygons are.
static void test_reach_without_end(void **state)
{
    (void)state;
    test_random random = { 43 };
    uint32_t lesser = 0;
    for (uint32_t round = 0; round < 6; round++) {
        fixture_level level = fixture_random(&random, round, 12);
        level.tile_cells = 0;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        uint64_t walls[4];
        for (int i = 0; i < 4; i++) {
            const float radii[4] = { 1.0f, 1e2f, 1e3f, 1e12f };
            tl_nav_wide_def def = tl_default_nav_wide_def();
            tl_nav_wide_report report;
            def.max_radius = radii[i];
            TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &report), TL_OK);
            walls[i] = report.wall_count;
        }
        TEST_CHECK(walls[2] >= walls[1] && walls[1] >= walls[0]);
        fixture_refs all = fixture_all_refs(navmesh);
        TEST_CHECK(walls[2] <= 32 * (uint64_t)all.count);
        TEST_CHECK(walls[3] >= walls[2] && walls[3] <= 32 * (uint64_t)all.count);
        print_message("%u polygons: %u walls in 1 m, %u in all\n", all.count, (uint32_t)walls[0], (uint32_t)walls[2]);
        free(all.refs);
        lesser += walls[0] < walls[1];
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(lesser > 3);
}

// Places that are divided into layers, which come and go one by one.
static void test_layers(void **state)
{
    (void)state;
    test_random random = { 44 };
    tl_sample_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    build_spiral(&mesh);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.agent_radius = 0.5f;
    def.tile_size = 24;
    def.tile_height = 2.9f;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = tl_sample_mesh_as_view(&mesh);
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    tl_navmesh *navmeshes[2] = { NULL, NULL };
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_navmesh_create(NULL, &navmeshes[i]), TL_OK);
        for (uint32_t k = 0; k < tiles.tile_count; k++) {
            TEST_RESULT(tl_navmesh_add_tile(navmeshes[i], tiles.tiles[k], TL_NAV_TILE_BORROWED), TL_OK);
        }
    }
    tl_nav_query *query = make_query();
    tl_nav_wide_def wide = tl_default_nav_wide_def();
    wide.max_radius = MAX_RADIUS;
    coverage seen = { 0 };
    uint32_t layers = 0;
    for (uint32_t edit = 0; edit < 40; edit++) {
        const tl_nav_tile *tile = tiles.tiles[test_random_below(&random, tiles.tile_count)];
        TEST_RESULT(tl_navmesh_prepare_wide(navmeshes[0], &wide, NULL), TL_OK);
        compare(query, navmeshes[0], navmeshes[1], &random, 6, &seen);
        for (int i = 0; i < 2; i++) {
            if (tl_navmesh_find_layer(navmeshes[i], tile->tile_x, tile->layer, tile->tile_z) != NULL) {
                TEST_RESULT(tl_navmesh_remove_layer(navmeshes[i], tile->tile_x, tile->layer, tile->tile_z), TL_OK);
            } else {
                TEST_RESULT(tl_navmesh_add_tile(navmeshes[i], tile, TL_NAV_TILE_BORROWED), TL_OK);
            }
        }
        layers += tile->layer > 0;
        compare(query, navmeshes[0], navmeshes[1], &random, 6, &seen);
    }
    print_message("%u tiles; complete %u (bent %u), unreachable %u; %u edits of upper layers\n", tiles.tile_count,
                  seen.complete, seen.bent, seen.unreachable, layers);
    TEST_CHECK(seen.complete > 50 && seen.bent > 30 && layers > 10);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmeshes[0]);
    tl_navmesh_destroy(navmeshes[1]);
    tl_nav_tiles_free(&tiles);
    tl_sample_mesh_free(&mesh);
}

static void test_arguments(void **state)
{
    (void)state;
    test_random random = { 42 };
    fixture_level level = fixture_random(&random, 4, 9);
    level.tile_cells = 3;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_wide_def def = tl_default_nav_wide_def();
    tl_nav_wide_report report, again;
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &report), TL_OK);
    TEST_CHECK(report.tile_count == 9 && report.made_tile_count == 9 && report.wall_count > 0);
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &again), TL_OK);
    TEST_CHECK(again.made_tile_count == 0 && again.bytes == report.bytes && again.wall_count == report.wall_count);
    // A wider agent asks for more, the mesh's own for nothing.
    def.max_radius *= 2.0f;
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &again), TL_OK);
    TEST_CHECK(again.made_tile_count == 9 && again.bytes > report.bytes && again.wall_count >= report.wall_count);
    def.max_radius = 0.25f;
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &again), TL_OK);
    TEST_CHECK(again.tile_count == 0 && again.bytes == 0);
    def.max_radius = INFINITY;
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &again), TL_ERR_NOT_FINITE);
    def.max_radius = -1.0f;
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, NULL), TL_ERR_ARGUMENT);
    tl_navmesh_destroy(navmesh);
    // Nothing to prepare.
    def = tl_default_nav_wide_def();
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &report), TL_OK);
    TEST_CHECK(report.tile_count == 0 && report.bytes == 0);
    tl_navmesh_destroy(navmesh);
}

static void test_memory(void **state)
{
    (void)state;
    test_random random = { 43 };
    fixture_level level = fixture_random(&random, 1, 6);
    level.tile_cells = 2;
    test_allocator failing;
    test_allocator_init(&failing, 0);
    tl_navmesh *navmesh = fixture_build(&level, &failing.allocator), *plain = fixture_build(&level, NULL);
    tl_nav_query *query = make_query();
    tl_nav_wide_def def = tl_default_nav_wide_def();
    tl_nav_wide_report report;
    coverage seen = { 0 };
    uint64_t before = failing.live_blocks, failures = 0;
    tl_result result = TL_ERR_MEMORY;
    for (uint64_t k = 1; result != TL_OK; k++) {
        // Each time from the beginning: what was made before a failure stays.
        def.max_radius = 0.0f;
        failing.fail_at = 0;
        TEST_RESULT(tl_navmesh_prepare_wide(navmesh, &def, &report), TL_OK);
        TEST_CHECK(failing.live_blocks == before && report.bytes == 0);
        def.max_radius = MAX_RADIUS;
        failing.calls = 0;
        failing.fail_at = k;
        result = tl_navmesh_prepare_wide(navmesh, &def, &report);
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        TEST_CHECK(failing.live_blocks == before + report.tile_count);
        if (k % 8 == 0) {
            compare(query, navmesh, plain, &random, 4, &seen);
        }
        failures += result != TL_OK;
    }
    TEST_CHECK(failures > 20);
    failing.fail_at = 0;
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(plain);
    tl_navmesh_destroy(navmesh);
    TEST_CHECK(failing.live_blocks == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits),  cmocka_unit_test(test_reach_without_end),
        cmocka_unit_test(test_layers), cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
