// SPDX-License-Identifier: MIT
//
// Paths of a baked navmesh, walked physically on generated levels: all arrive, none falls, no step is deeper than 1 mm.

#include "character_world.h"
#include "cli/sample/sample_level.h"
#include "path_walker.h"

#include <talus/nav_around.h>
#include <talus/nav_bake.h>

enum { PATHS = 20, MOST_TICKS = 60 * 200 };

static path_walker walker;

static void walk_paths(const tl_soup *soup, tl_navmesh *navmesh, uint64_t seed)
{
    test_random random = { seed };
    tl_character_def def = tl_default_character_def();
    tl_convex thin = tl_convex_capsule(tl_vec3_make(0, def.radius, 0), tl_vec3_make(0, def.height - def.radius, 0),
                                       def.radius - 0.001f);
    uint32_t walked = 0;
    walker.navmesh = navmesh;
    walker.level.soup = soup;
    walker.speed = 4;
    walker.floor = tl_soup_bounds(soup).min.y - 2;
    for (uint32_t tries = 0; tries < 50 * PATHS && walked < PATHS; tries++) {
        const uint64_t numbers[4] = { test_random_u64(&random), test_random_u64(&random), test_random_u64(&random),
                                      test_random_u64(&random) };
        tl_nav_location start, goal;
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, numbers, &start), TL_OK);
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, numbers + 2, &goal), TL_OK);
        memset(&walker.character, 0, sizeof walker.character);
        walker.character.position = start.point;
        walker.character.position.y += 0.05f;
        walker.goal = goal.point;
        walker.routes = 0;
        if (!walker_ask(&walker)) {
            continue;
        }
        walked++;
        walker_state state = WALKER_WALKS;
        for (uint32_t k = 0; k < MOST_TICKS && state == WALKER_WALKS; k++) {
            state = walker_tick(&walker);
            tl_transform pose = { { 0, 0, 0, 1 }, walker.character.position };
            bool overlaps;
            TEST_RESULT(tl_soup_overlaps(soup, &thin, pose, NULL, &overlaps), TL_OK);
            TEST_CHECK(!overlaps);
        }
        TEST_CHECK(state == WALKER_ARRIVED);
        TEST_CHECK(walker_flat_distance(walker.character.position, goal.point) < 0.2f);
    }
    TEST_CHECK(walked == PATHS);
}

static void test_samples(void **state)
{
    (void)state;
    static const char *const names[] = { "courtyard", "dungeon", "terrain", "city" };
    TEST_RESULT(tl_character_mover_create(NULL, &walker.mover, NULL), TL_OK);
    TEST_RESULT(tl_nav_query_create(NULL, &walker.query, NULL), TL_OK);
    for (uint32_t i = 0; i < sizeof names / sizeof *names; i++) {
        tl_sample_mesh mesh;
        TEST_RESULT(tl_sample_build_level(tl_sample_find_level(names[i]), 6000, 3, &mesh), TL_OK);
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
        tl_nav_input input = { view, NULL, NULL, 0 };
        tl_nav_def def = tl_default_nav_def();
        tl_nav_tiles tiles = { 0 };
        tl_navmesh *navmesh;
        def.cell_size = 0.15f;
        def.cell_height = 0.1f;
        def.agent_max_climb = 0.4f;
        TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
        TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
        TEST_RESULT(tl_navmesh_add_tiles(navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_BORROWED, NULL), TL_OK);
        walk_paths(soup, navmesh, 7 + i);
        tl_navmesh_destroy(navmesh);
        tl_nav_tiles_free(&tiles);
        tl_blob_free(soup);
        tl_sample_mesh_free(&mesh);
    }
    tl_character_mover_destroy(walker.mover);
    tl_nav_query_destroy(walker.query);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
