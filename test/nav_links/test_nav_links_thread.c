// SPDX-License-Identifier: MIT
//
// A level that changes under readers: 1,000 random edits of obstacles, tiles and off-mesh links, each under a writer's
// lock. After each the islands and anchors are those of a navmesh that was built afresh from the tiles and links that
// are there; and every path that a reader is given, over links too, is whole.

#define _POSIX_C_SOURCE 200809L // read-write locks

#include "nav_readers.h"

enum { EDITS = 1000, MAX_OBSTACLES = 10, MAX_LINKS = 20, MAX_POLYGONS = 4096 };

// What only the writer knows.
typedef struct editor {
    shared_world *world;
    tl_nav_obstacles *obstacles;
    tl_nav_obstacle_id crates[MAX_OBSTACLES];
    tl_nav_offmesh offmesh[MAX_LINKS];
    tl_nav_ref links[MAX_LINKS];
    uint32_t crate_count, link_count;
    test_random random;
    uint64_t anchored, waiting, islands;
} editor;

static tl_nav_def make_def(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 20;
    def.bounds.min = tl_vec3_make(-1, -3, -1);
    def.bounds.max = tl_vec3_make(26, 9, 20);
    return def;
}

// ---------------------------------------------------------------------------------------------------------
// Edits.

static void edit_crates(editor *e)
{
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = TL_NAV_OBSTACLE_BOX;
    crate.area = TL_NAV_NULL_AREA;
    crate.base = test_random_point(&e->random, tl_vec3_make(0, -0.1f, 0), tl_vec3_make(24, 3.5f, 16));
    crate.half_x = test_random_range(&e->random, 0.2f, 2.5f);
    crate.half_z = test_random_range(&e->random, 0.2f, 2.5f);
    crate.height = 1.5f;
    uint32_t which = e->crate_count > 0 ? test_random_below(&e->random, e->crate_count) : 0;
    if (e->crate_count < MAX_OBSTACLES && test_random_below(&e->random, 2) == 0) {
        TEST_RESULT(tl_nav_obstacles_add(e->obstacles, &crate, &e->crates[e->crate_count++], NULL), TL_OK);
    } else if (e->crate_count > 0) {
        TEST_RESULT(tl_nav_obstacles_remove(e->obstacles, e->crates[which]), TL_OK);
        e->crates[which] = e->crates[--e->crate_count];
    }
    world_settle(e->world, e->obstacles);
}

// A tile is taken out; the next change of an obstacle on it, or the end, brings it back.
static void drop_tile(editor *e)
{
    world_begin_write(e->world);
    (void)tl_navmesh_remove_tile(e->world->navmesh, (int32_t)test_random_below(&e->random, 5),
                                 (int32_t)test_random_below(&e->random, 4));
    pthread_rwlock_unlock(&e->world->lock);
}

static void edit_links(editor *e)
{
    world_begin_write(e->world);
    if (e->link_count < MAX_LINKS && (e->link_count < 8 || test_random_below(&e->random, 2) == 0)) {
        tl_nav_offmesh *link = &e->offmesh[e->link_count];
        *link = tl_default_nav_offmesh();
        link->start = test_random_point(&e->random, tl_vec3_make(0, -0.1f, 0), tl_vec3_make(25, 4, 16));
        link->end = test_random_point(&e->random, tl_vec3_make(0, -0.1f, 0), tl_vec3_make(25, 4, 16));
        link->radius = 2.0f;
        link->both_ways = test_random_below(&e->random, 2) == 0;
        link->cost_factor = test_random_below(&e->random, 4) == 0 ? 0.25f : 1.0f;
        TEST_RESULT(tl_navmesh_add_offmesh(e->world->navmesh, link, &e->links[e->link_count++], NULL), TL_OK);
    } else {
        uint32_t which = test_random_below(&e->random, e->link_count);
        TEST_RESULT(tl_navmesh_remove_offmesh(e->world->navmesh, e->links[which]), TL_OK);
        e->links[which] = e->links[--e->link_count];
        e->offmesh[which] = e->offmesh[e->link_count];
    }
    pthread_rwlock_unlock(&e->world->lock);
}

// ---------------------------------------------------------------------------------------------------------
// After each edit: the same as afresh. Only the writer changes anything, so it looks without the lock.

static tl_navmesh *build_afresh(const editor *e, tl_nav_ref links_out[MAX_LINKS])
{
    const tl_navmesh *navmesh = e->world->navmesh;
    tl_navmesh *fresh;
    TEST_RESULT(tl_navmesh_create(NULL, &fresh), TL_OK);
    for (int32_t z = 0; z < 8; z++) {
        for (int32_t x = 0; x < 8; x++) {
            const tl_nav_tile *tile = tl_navmesh_find_tile(navmesh, x, z);
            if (tile != NULL) {
                TEST_RESULT(tl_navmesh_add_tile(fresh, tile, TL_NAV_TILE_BORROWED), TL_OK);
            }
        }
    }
    TEST_CHECK(tl_navmesh_tile_count(fresh) == tl_navmesh_tile_count(navmesh));
    for (uint32_t i = 0; i < e->link_count; i++) {
        TEST_RESULT(tl_navmesh_add_offmesh(fresh, &e->offmesh[i], &links_out[i], NULL), TL_OK);
    }
    return fresh;
}

// Islands by tile place and polygon.
static uint32_t list_islands(const tl_navmesh *navmesh, uint32_t islands[MAX_POLYGONS])
{
    uint32_t count = 0;
    for (int32_t z = 0; z < 8; z++) {
        for (int32_t x = 0; x < 8; x++) {
            const tl_nav_tile *tile = tl_navmesh_find_tile(navmesh, x, z);
            uint32_t slot = 0;
            while (tile != NULL && tl_navmesh_slot_tile(navmesh, slot) != tile) {
                slot++;
            }
            for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
                TEST_CHECK(count < MAX_POLYGONS);
                TEST_RESULT(tl_navmesh_island(navmesh, tl_navmesh_polygon_ref(navmesh, slot, p), &islands[count++]),
                            TL_OK);
            }
        }
    }
    return count;
}

static void check_afresh(editor *e)
{
    static uint32_t own[MAX_POLYGONS], expected[MAX_POLYGONS];
    tl_nav_ref links[MAX_LINKS];
    tl_navmesh *fresh = build_afresh(e, links);
    uint32_t count = list_islands(e->world->navmesh, own);
    TEST_CHECK(list_islands(fresh, expected) == count);
    // Numbers differ, what hangs together does not: each names the first polygon of its island.
    for (uint32_t i = 0; i < count; i++) {
        uint32_t first = 0, first_expected = 0;
        while (own[first] != own[i]) {
            first++;
        }
        while (expected[first_expected] != expected[i]) {
            first_expected++;
        }
        TEST_CHECK(first == first_expected);
        e->islands += first == i;
    }
    for (uint32_t i = 0; i < e->link_count; i++) {
        tl_nav_offmesh_state state, state_expected;
        TEST_RESULT(tl_navmesh_offmesh_state(e->world->navmesh, e->links[i], &state), TL_OK);
        TEST_RESULT(tl_navmesh_offmesh_state(fresh, links[i], &state_expected), TL_OK);
        TEST_CHECK(state.anchored == state_expected.anchored && state.cost == state_expected.cost);
        for (int end = 0; end < 2; end++) {
            TEST_CHECK(tl_distance(state.ends[end].point, state_expected.ends[end].point) == 0.0f);
        }
        e->anchored += state.anchored;
        e->waiting += !state.anchored;
    }
    tl_navmesh_destroy(fresh);
}

static void test_edits_under_readers(void **state)
{
    (void)state;
    static test_level level;
    static editor e;
    static shared_world world;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def();
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    memset(&e, 0, sizeof e);
    memset(&world, 0, sizeof world);
    e.world = &world;
    e.random.state = 5;
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &e.obstacles, NULL, NULL), TL_OK);
    world_init(&world);
    world_settle(&world, e.obstacles);
    world_start_readers(&world);
    uint64_t kinds[3] = { 0, 0, 0 };
    for (int edit = 0; edit < EDITS || atomic_load(&world.paths) < EDITS; edit++) {
        uint32_t roll = test_random_below(&e.random, 10);
        uint32_t kind = roll < 4 ? 0 : roll < 5 ? 1 : 2;
        (kind == 0 ? edit_crates : kind == 1 ? drop_tile : edit_links)(&e);
        kinds[kind]++;
        if (edit < EDITS) {
            check_afresh(&e);
        }
    }
    world_end_readers(&world);
    print_message("%llu edits of obstacles, %llu of tiles, %llu of links; %llu links anchored, %llu waiting; "
                  "%u paths, %u over links\n",
                  (unsigned long long)kinds[0], (unsigned long long)kinds[1], (unsigned long long)kinds[2],
                  (unsigned long long)e.anchored, (unsigned long long)e.waiting, atomic_load(&world.paths),
                  atomic_load(&world.over_links));
    TEST_CHECK(atomic_load(&world.faults) == 0 && atomic_load(&world.complete) > EDITS / 10);
    TEST_CHECK(kinds[0] > 100 && kinds[1] > 50 && kinds[2] > 100 && e.anchored > EDITS && e.waiting > EDITS);
    TEST_CHECK(e.islands > EDITS && atomic_load(&world.over_links) > 0);
    tl_nav_obstacles_destroy(e.obstacles);
    world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edits_under_readers) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
