// SPDX-License-Identifier: MIT
//
// An agent walks while the world comes and goes around it, under a small budget: no frame waits for a read, and every
// answer is that of the world in memory whole, or said to be open. A read ends only when frames have passed since it
// began, so one that a frame waited for would never end.
//
//   test_world_walk [metres of each walk (400)]

#define _POSIX_C_SOURCE 200809L

#include "nav_world_file.h"
#include "world_walk.h"

#include <sched.h>
#include <stdatomic.h>
#include <time.h>

static const double HERE[3] = { 3e6, 0, -8e6 };

enum { FRAMES_A_READ = 2, PATIENCE_SECONDS = 20 };

typedef struct slow_disk {
    world_file *file;
    pthread_t frames_thread;
    atomic_uint frames, waited; // waited: reads by a frame, or for frames that never came
    atomic_bool ends;
} slow_disk;

static tl_result slow_read(uint64_t offset, void *bytes, size_t size, void *user)
{
    slow_disk *disk = user;
    const unsigned began = atomic_load(&disk->frames);
    const time_t patience = time(NULL) + PATIENCE_SECONDS;
    const bool by_a_frame = pthread_equal(pthread_self(), disk->frames_thread) != 0;
    atomic_fetch_add(&disk->waited, by_a_frame && began > 0);
    while (!by_a_frame && !atomic_load(&disk->ends) && atomic_load(&disk->frames) - began < FRAMES_A_READ) {
        sched_yield();
        if (time(NULL) > patience) {
            atomic_fetch_add(&disk->waited, 1);
            break;
        }
    }
    return world_file_read(offset, bytes, size, disk->file);
}

static double walk_metres = 400.0;

// Frames until so many metres are walked.
static void walk_frames(world_walk *walk, slow_disk *disk, walk_loader *loader)
{
    uint32_t failed = 0;
    for (uint32_t frame = 0; walk->walked < walk_metres; frame++) {
        const tl_nav_world_interest interest = { { walk->at[0], walk->at[1], walk->at[2] }, 70.0 };
        TEST_CHECK(frame < 100000 + 1000 * (uint32_t)walk_metres);
        TEST_CHECK(!tl_is_error(tl_nav_world_update(walk->part, &interest, 1, 4)));
        TEST_RESULT(walk_exchange_loads(loader, walk->part, &failed), TL_OK);
        atomic_fetch_add(&disk->frames, 1);
        const bool walks = walk_on(walk, 0.25);
        if (frame % (walks ? 48 : 16) == 0) {
            walk_choose(walk);
        }
        const struct timespec rest = { 0, 100000 };
        nanosleep(&rest, NULL);
    }
    TEST_CHECK(failed == 0 && atomic_load(&disk->waited) == 0);
}

static void test_walk(void **state)
{
    (void)state;
    test_random random = { 12 };
    uint32_t proven = 0, open = 0, unreachable = 0, frames = 0, paths = 0, jumps = 0;
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 64);
        level.tile_cells = 4;
        world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
        slow_disk disk = { &file, pthread_self(), 0, 0, false };
        world_walk walk;
        walk_loader loader;
        memset(&walk, 0, sizeof walk);
        const double edge = (double)level.width * (double)FIXTURE_STEP * (double)level.cell_size;
        const uint64_t budget = (uint64_t)768 << 10;
        walk.whole = world_open(&file, (uint64_t)256 << 20, 1e9);
        walk.part = walk_open(slow_read, &disk, budget, 64.0);
        walk.query = query;
        walk.extents = tl_vec3_make(3, 60, 3);
        walk.reach = 80.0;
        walk.random = 5 + kind;
        walk.low[0] = HERE[0] + (double)level.origin.x;
        walk.low[1] = HERE[2] + (double)level.origin.z;
        walk.high[0] = walk.low[0] + edge;
        walk.high[1] = walk.low[1] + edge;
        walk.at[0] = walk.low[0] + 0.5 * edge;
        walk.at[2] = walk.low[1] + 0.5 * edge;
        const tl_nav_world_interest all = { { walk.at[0], 0, walk.at[2] }, 10.0 * edge };
        world_settle(walk.whole, &all, 1);
        TEST_CHECK(world_state(walk.whole).loaded == world_state(walk.whole).places);
        TEST_CHECK(walk_loader_begin(&loader));
        walk_frames(&walk, &disk, &loader);
        atomic_store(&disk.ends, true);
        walk_loader_end(&loader);
        const tl_nav_world_state now = world_state(walk.part);
        TEST_CHECK(now.peak_bytes <= budget && now.loaded < now.places && now.loading == 0);
        TEST_CHECK(walk.wrong == 0);
        proven += walk.proven;
        open += walk.open;
        unreachable += walk.unreachable;
        paths += walk.paths;
        jumps += walk.jumps;
        frames += now.frames;
        tl_nav_world_destroy(walk.part);
        tl_nav_world_destroy(walk.whole);
        world_file_free(&file);
    }
    tl_nav_query_destroy(query);
    print_message("6 walks of %.0f m: %u paths, %u proven, %u unreachable, %u open, 0 wrong; %u jumps, %u frames of "
                  "reference\n",
                  walk_metres, paths, proven, unreachable, open, jumps, frames);
    TEST_CHECK(proven > 50 && open > 50 && frames > 12);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walk),
    };
    if (argc > 1) {
        walk_metres = strtod(argv[1], NULL);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
