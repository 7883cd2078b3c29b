// SPDX-License-Identifier: MIT
//
// A level that changes under readers: tiles are made while queries run, and swapped under a writer's lock. A reader
// never sees half a tile: every path that it is given is whole, and afterwards the navmesh is what a fresh one is. And
// tiles that threads make side by side are those that one makes.

#define _POSIX_C_SOURCE 200809L // read-write locks

#include "nav_readers.h"
#include "task_threads.h"

enum { EDITS = 1000, MAX_OBSTACLES = 12 };

static float tile_height; // 0 at first

static tl_nav_def make_def(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 20;
    def.tile_height = tile_height;
    def.bounds.min = tl_vec3_make(-1, -3, -1);
    def.bounds.max = tl_vec3_make(26, 9, 20);
    return def;
}

static tl_nav_obstacle random_crate(test_random *random)
{
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = test_random_below(random, 2) == 0 ? TL_NAV_OBSTACLE_BOX : TL_NAV_OBSTACLE_CYLINDER;
    crate.area = (uint8_t)(test_random_below(random, 4) == 0 ? 7 : TL_NAV_NULL_AREA);
    crate.base = test_random_point(random, tl_vec3_make(0, -0.1f, 0), tl_vec3_make(24, 3.5f, 16));
    crate.radius = crate.half_x = test_random_range(random, 0.2f, 2.0f);
    crate.half_z = test_random_range(random, 0.2f, 2.0f);
    crate.height = 1.5f;
    return crate;
}

static void test_edits_under_readers(void **state)
{
    (void)state;
    static test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def();
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_obstacles *obstacles;
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &obstacles, NULL, NULL), TL_OK);
    shared_world world;
    world_init(&world);
    world_settle(&world, obstacles);
    world_start_readers(&world);
    tl_nav_obstacle_id ids[MAX_OBSTACLES];
    uint32_t count = 0;
    test_random random = { 5 };
    for (int edit = 0; edit < EDITS || atomic_load(&world.paths) < EDITS; edit++) {
        tl_nav_obstacle crate = random_crate(&random);
        uint32_t which = count > 0 ? test_random_below(&random, count) : 0;
        if (count < MAX_OBSTACLES && test_random_below(&random, 2) == 0) {
            TEST_RESULT(tl_nav_obstacles_add(obstacles, &crate, &ids[count++], NULL), TL_OK);
        } else if (count > 0 && test_random_below(&random, 2) == 0) {
            TEST_RESULT(tl_nav_obstacles_remove(obstacles, ids[which]), TL_OK);
            ids[which] = ids[--count];
        } else if (count > 0) {
            TEST_RESULT(tl_nav_obstacles_move(obstacles, ids[which], &crate, NULL), TL_OK);
        }
        world_settle(&world, obstacles);
    }
    world_end_readers(&world);
    TEST_CHECK(atomic_load(&world.faults) == 0 && atomic_load(&world.complete) > EDITS / 10);
    // Without obstacles it is the first bake again.
    while (count > 0) {
        TEST_RESULT(tl_nav_obstacles_remove(obstacles, ids[--count]), TL_OK);
    }
    world_settle(&world, obstacles);
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    TEST_CHECK(tiles.tile_count == tl_navmesh_tile_count(world.navmesh));
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        const tl_nav_tile *expected = tiles.tiles[i];
        const tl_nav_tile *tile =
            tl_navmesh_find_layer(world.navmesh, expected->tile_x, expected->layer, expected->tile_z);
        TEST_CHECK(tile != NULL && memcmp(tile, expected, tile->blob.size) == 0);
    }
    tl_nav_tiles_free(&tiles);
    tl_nav_obstacles_destroy(obstacles);
    world_free(&world);
}

static void check_same_tiles(const tl_navmesh *a, const tl_navmesh *b)
{
    TEST_CHECK(tl_navmesh_tile_count(a) == tl_navmesh_tile_count(b));
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(a); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(a, slot);
        if (tile != NULL) {
            const tl_nav_tile *other = tl_navmesh_find_layer(b, tile->tile_x, tile->layer, tile->tile_z);
            TEST_CHECK(other != NULL && memcmp(tile, other, tile->blob.size) == 0);
        }
    }
}

static void test_updates_by_threads(void **state)
{
    (void)state;
    static test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    const tl_nav_def def = make_def();
    const tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_obstacles *obstacles[2];
    tl_navmesh *navmeshes[2];
    uint32_t workers = 3;
    const tl_tasks tasks = { run_on_threads, workers, &workers };
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &obstacles[i], NULL, NULL), TL_OK);
        TEST_RESULT(tl_nav_obstacles_set_tasks(obstacles[i], i == 0 ? NULL : &tasks), TL_OK);
        TEST_RESULT(tl_navmesh_create(NULL, &navmeshes[i]), TL_OK);
    }
    test_random random = { 6 };
    tl_nav_obstacle_id ids[2][MAX_OBSTACLES];
    for (int frame = 0; frame < 40; frame++) {
        for (uint32_t k = 0; k < MAX_OBSTACLES; k++) {
            const tl_nav_obstacle crate = random_crate(&random);
            for (int i = 0; i < 2; i++) {
                TEST_RESULT(frame == 0 ? tl_nav_obstacles_add(obstacles[i], &crate, &ids[i][k], NULL)
                                       : tl_nav_obstacles_move(obstacles[i], ids[i][k], &crate, NULL),
                            TL_OK);
            }
        }
        const tl_aabb changed = { tl_vec3_make(3, -3, 3), tl_vec3_make(9, 9, 9) };
        for (int i = 0; i < 2; i++) {
            if (frame % 10 == 9) {
                TEST_RESULT(tl_nav_obstacles_rebake(obstacles[i], &input, changed, NULL), TL_OK);
            }
            TEST_RESULT(tl_nav_obstacles_update(obstacles[i], navmeshes[i], UINT32_MAX, NULL, NULL), TL_OK);
        }
        check_same_tiles(navmeshes[0], navmeshes[1]);
    }
    for (int i = 0; i < 2; i++) {
        tl_navmesh_destroy(navmeshes[i]);
        tl_nav_obstacles_destroy(obstacles[i]);
    }
}

// The same with floors in layers of two metres.
static int divide(void **state)
{
    (void)state;
    tile_height = 2.0f;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edits_under_readers),
                                        cmocka_unit_test(test_updates_by_threads),
                                        cmocka_unit_test_setup(test_edits_under_readers, divide) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
