// SPDX-License-Identifier: MIT
//
// What is marked of a tile: runs against a look at each floor; and tiles that obstacles leave as they were are not
// baked again.

#include "nav_obstacles/tile_marks.h"
#include "obstacle_world.h"

#include <talus/nav_obstacles.h>

// Random areas in few values, so that runs meet, end at the array's ends and follow one another.
static void mark_at_random(test_random *random, const uint8_t *base, uint8_t *area, uint32_t count)
{
    memcpy(area, base, count);
    for (uint32_t k = test_random_below(random, 4); k > 0 && count > 0; k--) {
        const uint32_t first = test_random_below(random, count), length = test_random_below(random, 100);
        for (uint32_t i = first; i < count && i < first + length; i++) {
            area[i] = (uint8_t)test_random_below(random, 2);
        }
    }
}

static void test_runs(void **state)
{
    (void)state;
    enum { MOST = 400 };
    uint8_t base[MOST], area[MOST], again[MOST], other[MOST];
    test_random random = { 5 };
    uint32_t equal = 0, unequal = 0;
    for (int round = 0; round < 20000; round++) {
        const uint32_t count = test_random_below(&random, MOST + 1);
        for (uint32_t i = 0; i < count; i++) {
            base[i] = (uint8_t)test_random_below(&random, 2);
        }
        mark_at_random(&random, base, area, count);
        mark_at_random(&random, base, other, count);
        if (count > 0 && test_random_below(&random, 2) == 0) {
            memcpy(other, area, count);
            other[test_random_below(&random, count)] ^= (uint8_t)test_random_below(&random, 2);
        }
        tl_tile_marks marks;
        TEST_RESULT(tl_tile_marks_find(base, area, count, NULL, &marks), TL_OK);
        for (uint32_t r = 0; r < marks.run_count; r++) {
            TEST_CHECK(marks.runs[r].count > 0);
        }
        tl_tile_marks_apply(&marks, base, 0, count, again);
        TEST_CHECK(memcmp(again, area, count) == 0);
        const bool same = memcmp(area, other, count) == 0;
        TEST_CHECK(tl_tile_marks_hold(&marks, base, area, count));
        TEST_CHECK(tl_tile_marks_hold(&marks, base, other, count) == same);
        equal += same;
        unequal += !same;
        tl_tile_marks_free(&marks, NULL);
    }
    TEST_CHECK(equal > 3000 && unequal > 3000);
}

// Tiles that are handed out until none waits.
static uint32_t hand_out_all(world *w)
{
    uint32_t count = 0;
    tl_nav_rebaked_tile rebaked;
    while (tl_nav_obstacles_bake_next(w->obstacles, &rebaked, NULL) == TL_OK) {
        TEST_RESULT(tl_navmesh_replace_tiles(w->navmesh, rebaked.tile_x, rebaked.tile_z, &rebaked.stack), TL_OK);
        count++;
    }
    TEST_CHECK(tl_nav_obstacles_waiting(w->obstacles) == 0 && rebaked.stack.count == 0);
    return count;
}

static void test_tiles_as_they_were(void **state)
{
    (void)state;
    world w;
    make_world(&w, NULL);
    tl_nav_obstacle_id id, below;
    const tl_nav_obstacle crate = cylinder(0, tl_vec3_make(7.3f, 0, 8.1f), 0.8f, 1.0f);
    const tl_nav_obstacle buried = cylinder(0, tl_vec3_make(7.3f, -20, 8.1f), 0.8f, 1.0f);
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &buried, &below, NULL), TL_OK);
    TEST_CHECK(tl_nav_obstacles_waiting(w.obstacles) == 0 && hand_out_all(&w) == 0); // no floor is there
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &crate, &id, NULL), TL_OK);
    const uint32_t touched = hand_out_all(&w);
    TEST_CHECK(touched > 0);
    TEST_RESULT(tl_nav_obstacles_move(w.obstacles, id, &crate, NULL), TL_OK);
    TEST_CHECK(hand_out_all(&w) == 0); // it stays
    TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, id), TL_OK);
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &crate, &id, NULL), TL_OK);
    TEST_CHECK(hand_out_all(&w) == 0); // it goes and comes before anybody looks
    TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, id), TL_OK);
    TEST_CHECK(hand_out_all(&w) == touched);
    const tl_aabb changed = { { 6, 0, 7 }, { 8, 2, 9.5f } };
    TEST_RESULT(tl_nav_obstacles_rebake(w.obstacles, &w.input, changed, NULL), TL_OK);
    TEST_CHECK(hand_out_all(&w) >= touched); // the level may be another
    free_world(&w);
}

// A tile that a navmesh could not take comes again, though its floors are as they were when it was baked.
static void test_refused_tiles_come_again(void **state)
{
    (void)state;
    world w, twin;
    test_allocator memory;
    test_allocator_init(&memory, 0);
    make_world(&w, NULL);
    make_world(&twin, NULL);
    tl_nav_obstacle_id id;
    const tl_nav_obstacle crate = cylinder(0, tl_vec3_make(7.3f, 0, 8.1f), 0.8f, 1.0f);
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(&memory.allocator, &navmesh), TL_OK);
    TEST_RESULT(tl_nav_obstacles_add(twin.obstacles, &crate, &id, NULL), TL_OK);
    const uint32_t touched = hand_out_all(&twin);
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &crate, &id, NULL), TL_OK);
    memory.calls = 0;
    memory.fail_at = 1;
    uint32_t waiting = 0;
    TEST_RESULT(tl_nav_obstacles_update(w.obstacles, navmesh, 1, &waiting, NULL), TL_ERR_MEMORY);
    memory.fail_at = 0;
    TEST_CHECK(waiting > 0);
    TEST_RESULT(tl_nav_obstacles_update(w.obstacles, navmesh, UINT32_MAX, &waiting, NULL), TL_OK);
    TEST_CHECK(waiting == 0 && touched > 0 && tl_navmesh_tile_count(navmesh) == touched);
    tl_navmesh_destroy(navmesh);
    free_world(&w);
    free_world(&twin);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_runs), cmocka_unit_test(test_tiles_as_they_were),
                                        cmocka_unit_test(test_refused_tiles_come_again) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
