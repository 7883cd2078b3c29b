// SPDX-License-Identifier: MIT
//
// A navmesh under a read-write lock, threads that find paths over it, and a writer that swaps tiles. Define
// _POSIX_C_SOURCE before the first header.

#ifndef TALUS_TEST_NAV_READERS_H
#define TALUS_TEST_NAV_READERS_H

#include "nav_level.h"
#include "nav_path_checks.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <talus/nav_obstacles.h>

enum { TEST_READERS = 2, TEST_READER_CAPACITY = 256 };

typedef struct shared_world {
    tl_navmesh *navmesh;
    pthread_rwlock_t lock;
    pthread_t readers[TEST_READERS];
    atomic_bool done, writer_waits; // the lock itself prefers readers, and would starve the writer
    atomic_uint paths, complete, over_links, faults;
} shared_world;

/// Finds paths until the world is done. What it is given must fit the navmesh as it is under the lock.
static inline void *read_paths(void *user)
{
    shared_world *world = user;
    tl_nav_query *query = NULL;
    test_random random = { 77 };
    if (tl_nav_query_create(NULL, &query, NULL) != TL_OK) {
        atomic_fetch_add(&world->faults, 1);
        return NULL;
    }
    while (!atomic_load(&world->done)) {
        tl_vec3 from = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(24, 1, 15));
        tl_vec3 to = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(24, 4, 15));
        tl_nav_ref polygons[TEST_READER_CAPACITY];
        tl_nav_corner corners[TEST_READER_CAPACITY];
        tl_nav_path_buffers buffers = { polygons, TEST_READER_CAPACITY, corners, TEST_READER_CAPACITY };
        tl_nav_route route;
        uint32_t links = 0;
        while (atomic_load(&world->writer_waits)) {
            sched_yield();
        }
        pthread_rwlock_rdlock(&world->lock);
        tl_result result = tl_nav_query_find_route(
            query, world->navmesh, &(tl_nav_route_request){ NULL, from, to, tl_vec3_make(3, 5, 3) }, &buffers, &route);
        bool whole =
            result == TL_NOT_FOUND ||
            (result == TL_OK && test_path_is_whole(world->navmesh, polygons, route.path.polygon_count, &links));
        pthread_rwlock_unlock(&world->lock);
        atomic_fetch_add(&world->faults, !whole);
        atomic_fetch_add(&world->paths, result == TL_OK);
        atomic_fetch_add(&world->complete, result == TL_OK && route.path.status == TL_NAV_PATH_COMPLETE);
        atomic_fetch_add(&world->over_links, links > 0);
    }
    tl_nav_query_destroy(query);
    return NULL;
}

/// An empty navmesh. Zeroed elsewhere.
static inline void world_init(shared_world *world)
{
    memset(world, 0, sizeof *world);
    TEST_CHECK(pthread_rwlock_init(&world->lock, NULL) == 0);
    TEST_RESULT(tl_navmesh_create(NULL, &world->navmesh), TL_OK);
}

static inline void world_start_readers(shared_world *world)
{
    for (int i = 0; i < TEST_READERS; i++) {
        TEST_CHECK(pthread_create(&world->readers[i], NULL, read_paths, world) == 0);
    }
}

static inline void world_end_readers(shared_world *world)
{
    atomic_store(&world->done, true);
    for (int i = 0; i < TEST_READERS; i++) {
        pthread_join(world->readers[i], NULL);
    }
}

static inline void world_free(shared_world *world)
{
    tl_navmesh_destroy(world->navmesh);
    pthread_rwlock_destroy(&world->lock);
}

/// Takes the writer's lock; pthread_rwlock_unlock gives it back.
static inline void world_begin_write(shared_world *world)
{
    atomic_store(&world->writer_waits, true);
    pthread_rwlock_wrlock(&world->lock);
    atomic_store(&world->writer_waits, false);
}

/// Bakes the tiles that obstacles have changed. Tiles are made without the lock; only the swap has it.
static inline void world_settle(shared_world *world, tl_nav_obstacles *obstacles)
{
    while (tl_nav_obstacles_waiting(obstacles) > 0) {
        tl_nav_rebaked_tile rebaked;
        const tl_result result = tl_nav_obstacles_bake_next(obstacles, &rebaked, NULL);
        TEST_CHECK(result == TL_OK || result == TL_NOT_FOUND);
        if (result == TL_NOT_FOUND) {
            break; // what waited is as it was
        }
        world_begin_write(world);
        TEST_RESULT(tl_navmesh_replace_tiles(world->navmesh, rebaked.tile_x, rebaked.tile_z, &rebaked.stack), TL_OK);
        pthread_rwlock_unlock(&world->lock);
    }
}

#endif
