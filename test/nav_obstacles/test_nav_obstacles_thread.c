// SPDX-License-Identifier: MIT
//
// A level that changes under readers: tiles are made while queries run, and swapped under a writer's lock. A reader
// never sees half a tile: every path that it is given is whole, and afterwards the navmesh is what a fresh one is.

#define _POSIX_C_SOURCE 200809L // read-write locks

#include "nav_level.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <talus/nav_obstacles.h>

enum { EDITS = 1000, READERS = 2, MOST_OBSTACLES = 12, MOST = 256 };

typedef struct shared_world {
    tl_navmesh *navmesh;
    pthread_rwlock_t lock;
    atomic_bool done, writer_waits; // the lock itself prefers readers, and would starve the writer
    atomic_uint paths, complete, faults;
} shared_world;

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

// What a reader is given must fit the navmesh as it is under the lock: polygons that are there, each beside the last.
static bool path_is_whole(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_tile *tile;
        uint32_t polygon, link_count = 0;
        tl_nav_link links[64];
        if (tl_navmesh_resolve(navmesh, polygons[i], &tile, &polygon) != TL_OK ||
            tl_navmesh_links(navmesh, polygons[i], links, 64, &link_count) != TL_OK) {
            return false;
        }
        bool found = i + 1 == count;
        for (uint32_t k = 0; k < link_count; k++) {
            found = found || links[k].to == polygons[i + 1];
        }
        if (!found) {
            return false;
        }
    }
    return count > 0;
}

static void *read_paths(void *user)
{
    shared_world *world = user;
    tl_nav_query *query = NULL;
    const tl_nav_query_def query_def = tl_default_nav_query_def();
    test_random random = { 77 };
    if (tl_nav_query_create(&query_def, &query) != TL_OK) {
        atomic_fetch_add(&world->faults, 1);
        return NULL;
    }
    while (!atomic_load(&world->done)) {
        tl_vec3 from = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(24, 1, 15));
        tl_vec3 to = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(24, 4, 15));
        tl_nav_ref polygons[MOST];
        tl_nav_corner corners[MOST];
        tl_nav_path_buffers buffers = { polygons, MOST, corners, MOST };
        tl_nav_route route;
        while (atomic_load(&world->writer_waits)) {
            sched_yield();
        }
        pthread_rwlock_rdlock(&world->lock);
        tl_result result = tl_nav_query_find_route(
            query, world->navmesh, &(tl_nav_route_request){ NULL, from, to, tl_vec3_make(3, 5, 3) }, &buffers, &route);
        if (result == TL_OK) {
            atomic_fetch_add(&world->paths, 1);
            atomic_fetch_add(&world->complete, route.path.status == TL_NAV_PATH_COMPLETE);
            if (!path_is_whole(world->navmesh, polygons, route.path.polygon_count)) {
                atomic_fetch_add(&world->faults, 1);
            }
        } else if (result != TL_NOT_FOUND) {
            atomic_fetch_add(&world->faults, 1);
        }
        pthread_rwlock_unlock(&world->lock);
    }
    tl_nav_query_destroy(query);
    return NULL;
}

// Tiles are made without the lock; only the swap has it.
static void settle(tl_nav_obstacles *obstacles, shared_world *world)
{
    while (tl_nav_obstacles_waiting(obstacles) > 0) {
        tl_nav_rebaked_tile remade;
        TEST_RESULT(tl_nav_obstacles_bake_next(obstacles, &remade, NULL), TL_OK);
        atomic_store(&world->writer_waits, true);
        pthread_rwlock_wrlock(&world->lock);
        atomic_store(&world->writer_waits, false);
        TEST_RESULT(tl_navmesh_replace_tiles(world->navmesh, remade.tile_x, remade.tile_z, &remade.stack), TL_OK);
        pthread_rwlock_unlock(&world->lock);
    }
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
    memset(&world, 0, sizeof world);
    TEST_CHECK(pthread_rwlock_init(&world.lock, NULL) == 0);
    TEST_RESULT(tl_navmesh_create(NULL, &world.navmesh), TL_OK);
    settle(obstacles, &world);
    pthread_t readers[READERS];
    for (int i = 0; i < READERS; i++) {
        TEST_CHECK(pthread_create(&readers[i], NULL, read_paths, &world) == 0);
    }
    tl_nav_obstacle_id ids[MOST_OBSTACLES];
    uint32_t count = 0;
    test_random random = { 5 };
    for (int edit = 0; edit < EDITS || atomic_load(&world.paths) < EDITS; edit++) {
        tl_nav_obstacle crate = random_crate(&random);
        uint32_t which = count > 0 ? test_random_below(&random, count) : 0;
        if (count < MOST_OBSTACLES && test_random_below(&random, 2) == 0) {
            TEST_RESULT(tl_nav_obstacles_add(obstacles, &crate, &ids[count++], NULL), TL_OK);
        } else if (count > 0 && test_random_below(&random, 2) == 0) {
            TEST_RESULT(tl_nav_obstacles_remove(obstacles, ids[which]), TL_OK);
            ids[which] = ids[--count];
        } else if (count > 0) {
            TEST_RESULT(tl_nav_obstacles_move(obstacles, ids[which], &crate, NULL), TL_OK);
        }
        settle(obstacles, &world);
    }
    atomic_store(&world.done, true);
    for (int i = 0; i < READERS; i++) {
        pthread_join(readers[i], NULL);
    }
    TEST_CHECK(atomic_load(&world.faults) == 0 && atomic_load(&world.complete) > EDITS / 10);
    // Without obstacles it is the first bake again.
    while (count > 0) {
        TEST_RESULT(tl_nav_obstacles_remove(obstacles, ids[--count]), TL_OK);
    }
    settle(obstacles, &world);
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
    tl_navmesh_destroy(world.navmesh);
    tl_nav_obstacles_destroy(obstacles);
    pthread_rwlock_destroy(&world.lock);
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
                                        cmocka_unit_test_setup(test_edits_under_readers, divide) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
