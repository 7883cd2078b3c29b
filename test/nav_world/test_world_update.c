// SPDX-License-Identifier: MIT
//
// Tiles in and out: the budget is kept at every moment, the nearest are there, references of before are stale, a place
// that could not be read is tried again, and loads may be handed back in any order, or not run.

#include "nav_world_file.h"

#include <pthread.h>

static const double HERE[3] = { 5e6, 0, 5e6 };

static fixture_level wide_level(void)
{
    test_random random = { 31 };
    fixture_level level = fixture_random(&random, 1, 64);
    level.tile_cells = 4;
    return level;
}

static double edge_of(const fixture_level *level)
{
    return (double)level->width * (double)FIXTURE_STEP * (double)level->cell_size;
}

static void test_budget_is_kept(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    const double edge = edge_of(&level);
    uint32_t most = 0, frames = 0;
    for (uint64_t budget = 128 << 10; budget <= 4 << 20; budget *= 2) {
        tl_nav_world *world = world_open(&file, budget, 40.0);
        uint32_t covered = 0;
        for (uint32_t step = 0; step <= 40; step++) {
            const double at = edge * (double)step / 40.0;
            const tl_nav_world_interest interest = world_interest(HERE, at, at, 0.5 * edge);
            world_settle(world, &interest, 1);
            const tl_nav_world_state now = world_state(world);
            TEST_CHECK(now.bytes <= budget && now.peak_bytes <= budget && now.loading == 0 && now.ready == 0);
            TEST_CHECK(now.loaded > 0 && now.failed == 0);
            TEST_CHECK(tl_navmesh_tile_count(tl_nav_world_navmesh(world)) >= now.loaded);
            covered += tl_nav_world_covers(world, interest.point, 1.0) == TL_OK;
            frames = now.frames;
            most = now.loaded > most ? now.loaded : most;
        }
        TEST_CHECK(covered == 41); // what is nearest is there whatever the budget
        TEST_CHECK(frames >= 8);
        tl_nav_world_destroy(world);
    }
    TEST_CHECK(most > 60);
    world_file_free(&file);
}

static void test_references_go_stale(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 50.0);
    tl_nav_world_interest interest = world_interest(HERE, 10, 10, 60);
    world_settle(world, &interest, 1);
    fixture_refs before = fixture_all_refs(tl_nav_world_navmesh(world));
    TEST_CHECK(before.count > 20 && world_state(world).frames == 1);
    interest = world_interest(HERE, 90, 90, 60);
    TEST_RESULT(tl_nav_world_update(world, &interest, 1, 0), TL_OK); // the frame alone
    TEST_CHECK(world_state(world).frames == 2 && world_state(world).loaded > 0);
    for (uint32_t i = 0; i < before.count; i++) {
        TEST_RESULT(tl_navmesh_resolve(tl_nav_world_navmesh(world), before.refs[i], NULL, NULL), TL_ERR_STALE);
    }
    TEST_RESULT(tl_nav_world_update(world, &interest, 1, 0), TL_NOT_FOUND);
    free(before.refs);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

static void test_failed_reads_are_tried_again(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    const double edge = edge_of(&level);
    tl_nav_world_interest all = world_interest(HERE, 0.5 * edge, 0.5 * edge, edge);
    file.fail_from = file.in.size / 2;
    world_settle(world, &all, 1);
    const tl_nav_world_state broken = world_state(world);
    TEST_CHECK(broken.failed > 20 && broken.loaded > 20 && broken.failed + broken.loaded == broken.places);
    tl_nav_location location;
    double at[3] = { HERE[0] + 0.5 * edge, HERE[1], HERE[2] + edge - 2.0 };
    const tl_result near = tl_nav_world_find_nearest(world, NULL, at, tl_vec3_make(4, 60, 4), &location);
    TEST_RESULT(near, TL_NOT_LOADED); // not "nothing there"
    file.fail_from = 0;
    all.point[0] += 20.0;
    world_settle(world, &all, 1);
    TEST_CHECK(world_state(world).failed == 0 && world_state(world).loaded == broken.places);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

static void test_loads_in_any_order(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    const double edge = edge_of(&level);
    const tl_nav_world_interest all = world_interest(HERE, 0.5 * edge, 0.5 * edge, edge);
    tl_nav_world_load loads[8];
    TEST_RESULT(tl_nav_world_update(world, &all, 1, 4), TL_OK);
    for (int i = 0; i < 8; i++) {
        TEST_RESULT(tl_nav_world_begin_load(world, &loads[i]), TL_OK);
        for (int k = 0; k < i; k++) {
            TEST_CHECK(loads[k].tile_x != loads[i].tile_x || loads[k].tile_z != loads[i].tile_z);
        }
    }
    TEST_CHECK(world_state(world).loading == 8);
    for (int i = 7; i >= 0; i--) {
        if (i != 3) {
            TEST_RESULT(tl_nav_world_run_load(&loads[i]), TL_OK);
        }
        TEST_RESULT(tl_nav_world_end_load(&loads[i]), TL_OK);
        TEST_RESULT(tl_nav_world_end_load(&loads[i]), TL_ERR_ARGUMENT); // handed back already
    }
    TEST_CHECK(world_state(world).loading == 0 && world_state(world).ready == 7 && world_state(world).failed == 0);
    TEST_RESULT(tl_nav_world_update(world, &all, 1, 3), TL_OK);
    TEST_CHECK(world_state(world).loaded == 3 && world_state(world).ready == 4);
    // Interests elsewhere: what was read comes in all the same, and is there when they come back.
    TEST_RESULT(tl_nav_world_update(world, NULL, 0, 100), TL_OK);
    TEST_CHECK(world_state(world).loaded == 7 && world_state(world).ready == 0 && world_state(world).missing == 0);
    world_settle(world, &all, 1);
    TEST_CHECK(world_state(world).loaded == world_state(world).places);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

// A thread that runs loads while this one asks and updates.
typedef struct loader {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    tl_nav_world_load load;
    int stage; // 0: nothing to do, 1: run it, 2: done, 3: end
} loader;

static tl_result locked_read(uint64_t offset, void *bytes, size_t size, void *user)
{
    const world_file *file = user;
    TEST_CHECK(offset + size <= file->in.size);
    memcpy(bytes, file->in.bytes + offset, size);
    return TL_OK;
}

static void *run_loads(void *user)
{
    loader *self = user;
    pthread_mutex_lock(&self->mutex);
    while (self->stage != 3) {
        if (self->stage == 1) {
            pthread_mutex_unlock(&self->mutex);
            (void)tl_nav_world_run_load(&self->load);
            pthread_mutex_lock(&self->mutex);
            self->stage = 2;
            pthread_cond_broadcast(&self->changed);
        } else {
            pthread_cond_wait(&self->changed, &self->mutex);
        }
    }
    pthread_mutex_unlock(&self->mutex);
    return NULL;
}

static void test_loads_on_a_thread(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    def.read = locked_read;
    def.user = &file;
    def.frame_reach = 30.0;
    TEST_RESULT(tl_nav_world_create(&def, &world, NULL), TL_OK);
    loader work;
    memset(&work, 0, sizeof work);
    pthread_mutex_init(&work.mutex, NULL);
    pthread_cond_init(&work.changed, NULL);
    pthread_t thread;
    TEST_CHECK(pthread_create(&thread, NULL, run_loads, &work) == 0);
    const double edge = edge_of(&level);
    for (uint32_t frame = 0; frame < 1000; frame++) {
        const double at = edge * (double)frame / 1000.0;
        const tl_nav_world_interest interest = world_interest(HERE, at, at, 0.4 * edge);
        const tl_result result = tl_nav_world_update(world, &interest, 1, 1);
        TEST_CHECK(result == TL_OK || result == TL_NOT_FOUND);
        pthread_mutex_lock(&work.mutex);
        while (work.stage == 1 && frame % 4 == 0) {
            pthread_cond_wait(&work.changed, &work.mutex); // so that each load takes four frames at most
        }
        if (work.stage == 2) {
            TEST_RESULT(tl_nav_world_end_load(&work.load), TL_OK);
            work.stage = 0;
        }
        if (work.stage == 0 && tl_nav_world_begin_load(world, &work.load) == TL_OK) {
            work.stage = 1;
            pthread_cond_broadcast(&work.changed);
        }
        pthread_mutex_unlock(&work.mutex);
        tl_nav_location location;
        TEST_CHECK(
            !tl_is_error(tl_nav_world_find_nearest(world, NULL, interest.point, tl_vec3_make(2, 60, 2), &location)));
    }
    pthread_mutex_lock(&work.mutex);
    while (work.stage == 1) {
        pthread_cond_wait(&work.changed, &work.mutex);
    }
    work.stage = 3;
    pthread_cond_broadcast(&work.changed);
    pthread_mutex_unlock(&work.mutex);
    pthread_join(thread, NULL);
    TEST_CHECK(world_state(world).loaded > 20);
    pthread_cond_destroy(&work.changed);
    pthread_mutex_destroy(&work.mutex);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

static void test_bad_interests(void **state)
{
    (void)state;
    const fixture_level level = wide_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    tl_nav_world_interest bad = world_interest(HERE, 0, 0, -1.0);
    TEST_RESULT(tl_nav_world_update(world, &bad, 1, 1), TL_ERR_ARGUMENT);
    bad.radius = (double)INFINITY;
    TEST_RESULT(tl_nav_world_update(world, &bad, 1, 1), TL_ERR_NOT_FINITE);
    bad = world_interest(HERE, (double)NAN, 0, 1.0);
    TEST_RESULT(tl_nav_world_update(world, &bad, 1, 1), TL_ERR_NOT_FINITE);
    TEST_CHECK(world_state(world).frames == 0);
    // Interests at the ends of what a double can say: nothing is near, nothing breaks.
    bad = world_interest(HERE, 1e300, -1e300, 1e300);
    TEST_CHECK(!tl_is_error(tl_nav_world_update(world, &bad, 1, 1)));
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_budget_is_kept),
        cmocka_unit_test(test_references_go_stale),
        cmocka_unit_test(test_failed_reads_are_tried_again),
        cmocka_unit_test(test_loads_in_any_order),
        cmocka_unit_test(test_loads_on_a_thread),
        cmocka_unit_test(test_bad_interests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
