// SPDX-License-Identifier: MIT
//
// Readers beside a writer, without a lock: two threads ask the newest version, and some versions for long, while a
// third one adds and removes obstacles, off-mesh links, flags and areas. Each answer must be that of one whole version,
// which the writer noted before it was published.
//
//   TALUS_EDIT_SECONDS=60 test_nav_versions_thread    for that long instead of 2 seconds

#define _POSIX_C_SOURCE 200809L // clock_gettime

#include "nav_answers.h"
#include "nav_level.h"

#include <pthread.h>
#include <stdatomic.h>
#include <talus/nav_obstacles.h>
#include <talus/nav_versions.h>
#include <time.h>

enum { READERS = 2, MAX_EDITS = 1 << 21, PAIR_KINDS = 4, MAX_CRATES = 10, LONG_HOLD = 64 };

typedef struct versions_world {
    tl_nav_versions *versions;
    tl_nav_obstacles *obstacles;
    uint64_t *expected; // by edit count, of one pair: PAIR_KINDS in turn
    atomic_bool done;
    atomic_uint answers, wrong, newer;
} versions_world;

static uint64_t answer_of(const tl_navmesh *navmesh, tl_nav_query *query)
{
    test_random random = { tl_navmesh_edit_count(navmesh) % PAIR_KINDS };
    const uint64_t hash = test_pair_hash(navmesh, query, &random);
    return test_mix(test_mix(hash, tl_navmesh_link_count(navmesh)), tl_navmesh_tile_count(navmesh));
}

static void *read_versions(void *user)
{
    versions_world *world = user;
    tl_nav_query *query = NULL;
    if (tl_nav_query_create(NULL, &query, NULL) != TL_OK) {
        atomic_fetch_add(&world->wrong, 1);
        return NULL;
    }
    const tl_navmesh *kept = NULL;
    uint64_t kept_answer = 0, last = 0;
    for (uint32_t round = 0; !atomic_load(&world->done); round++) {
        const tl_navmesh *navmesh = tl_nav_versions_acquire(world->versions);
        const uint64_t edit = tl_navmesh_edit_count(navmesh), answer = answer_of(navmesh, query);
        atomic_fetch_add(&world->wrong, answer != world->expected[edit] || edit < last);
        atomic_fetch_add(&world->newer, edit > last);
        atomic_fetch_add(&world->answers, 1);
        last = edit;
        if (round % LONG_HOLD == 0) {
            atomic_fetch_add(&world->wrong, kept != NULL && answer_of(kept, query) != kept_answer);
            tl_nav_versions_release(world->versions, kept);
            kept = tl_nav_versions_acquire(world->versions);
            kept_answer = answer_of(kept, query);
        }
        tl_nav_versions_release(world->versions, navmesh);
    }
    tl_nav_versions_release(world->versions, kept);
    tl_nav_query_destroy(query);
    return NULL;
}

typedef struct editor {
    tl_nav_obstacle_id crates[MAX_CRATES];
    uint32_t crate_count;
    tl_nav_ref link;
    tl_nav_query *query;
    test_random random;
} editor;

static void place_crate(versions_world *world, editor *e)
{
    if (e->crate_count == MAX_CRATES || (e->crate_count > 0 && test_random_below(&e->random, 2) == 0)) {
        tl_nav_obstacle_id *gone = &e->crates[test_random_below(&e->random, e->crate_count)];
        TEST_RESULT(tl_nav_obstacles_remove(world->obstacles, *gone), TL_OK);
        *gone = e->crates[--e->crate_count];
        return;
    }
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = TL_NAV_OBSTACLE_CYLINDER;
    crate.area = (uint8_t)(test_random_below(&e->random, 4) == 0 ? 3 : TL_NAV_NULL_AREA);
    crate.base = test_random_point(&e->random, tl_vec3_make(0, -0.1f, 0), tl_vec3_make(24, 3.5f, 16));
    crate.radius = test_random_range(&e->random, 0.2f, 1.5f);
    crate.height = 1.5f;
    TEST_RESULT(tl_nav_obstacles_add(world->obstacles, &crate, &e->crates[e->crate_count++], NULL), TL_OK);
}

static void change_link(tl_navmesh *draft, editor *e)
{
    if (e->link != TL_NAV_NO_REF) {
        TEST_RESULT(tl_navmesh_remove_offmesh(draft, e->link), TL_OK);
        e->link = TL_NAV_NO_REF;
        return;
    }
    tl_nav_offmesh jump = tl_default_nav_offmesh();
    jump.start = test_random_point(&e->random, tl_vec3_make(1, 0, 1), tl_vec3_make(24, 0, 15));
    jump.end = test_random_point(&e->random, tl_vec3_make(13, 3, 12), tl_vec3_make(19, 3, 13));
    TEST_RESULT(tl_navmesh_add_offmesh(draft, &jump, &e->link, NULL), TL_OK);
}

static void change_polygon(tl_navmesh *draft, editor *e)
{
    const uint64_t numbers[2] = { test_random_u64(&e->random), test_random_u64(&e->random) };
    tl_nav_location at;
    if (tl_navmesh_random_point(draft, NULL, numbers, &at) == TL_OK) {
        const uint8_t area = (uint8_t)(1 + test_random_below(&e->random, 4));
        TEST_RESULT(tl_navmesh_set_polygon_area(draft, at.polygon, area), TL_OK);
        TEST_RESULT(tl_navmesh_set_polygon_flags(draft, at.polygon, area < 4 ? 1 : 2), TL_OK);
    }
}

static void edit_once(versions_world *world, editor *e)
{
    tl_navmesh *draft;
    TEST_RESULT(tl_nav_versions_edit(world->versions, &draft), TL_OK);
    switch (test_random_below(&e->random, 8)) {
    case 0:
        change_link(draft, e);
        break;
    case 1:
        change_polygon(draft, e);
        break;
    case 2:
        TEST_RESULT(tl_navmesh_prepare_wide(draft, NULL, NULL), TL_OK);
        break;
    default:
        place_crate(world, e);
        break;
    }
    // Some of the tiles now, the others in later versions.
    TEST_RESULT(tl_nav_obstacles_update(world->obstacles, draft, 1 + test_random_below(&e->random, 3), NULL, NULL),
                TL_OK);
    const uint64_t edit = tl_navmesh_edit_count(draft);
    TEST_CHECK(edit < MAX_EDITS);
    const tl_navmesh *newest = tl_nav_versions_acquire(world->versions);
    const bool is_new = tl_navmesh_edit_count(newest) != edit;
    tl_nav_versions_release(world->versions, newest);
    if (is_new) {
        world->expected[edit] = answer_of(draft, e->query);
    }
    TEST_RESULT(tl_nav_versions_publish(world->versions), TL_OK);
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void make_world(versions_world *world, test_level *level)
{
    memset(world, 0, sizeof *world);
    test_level_make(level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 20;
    def.bounds.min = tl_vec3_make(-1, -3, -1);
    def.bounds.max = tl_vec3_make(26, 9, 20);
    const tl_nav_input input = { level->mesh, NULL, NULL, 0 };
    TEST_RESULT(tl_nav_obstacles_bake(&def, &input, &world->obstacles, NULL, NULL), TL_OK);
    TEST_RESULT(tl_nav_versions_create(NULL, &world->versions), TL_OK);
    world->expected = calloc(MAX_EDITS, sizeof *world->expected);
    TEST_CHECK(world->expected != NULL);
}

static void test_readers_beside_edits(void **state)
{
    (void)state;
    static test_level level;
    static versions_world world;
    make_world(&world, &level);
    editor e;
    memset(&e, 0, sizeof e);
    e.random.state = 11;
    TEST_RESULT(tl_nav_query_create(NULL, &e.query, NULL), TL_OK);
    tl_navmesh *draft;
    TEST_RESULT(tl_nav_versions_edit(world.versions, &draft), TL_OK);
    TEST_RESULT(tl_nav_obstacles_update(world.obstacles, draft, UINT32_MAX, NULL, NULL), TL_OK);
    world.expected[tl_navmesh_edit_count(draft)] = answer_of(draft, e.query);
    TEST_RESULT(tl_nav_versions_publish(world.versions), TL_OK);

    pthread_t readers[READERS];
    for (int i = 0; i < READERS; i++) {
        TEST_CHECK(pthread_create(&readers[i], NULL, read_versions, &world) == 0);
    }
    const char *asked = getenv("TALUS_EDIT_SECONDS");
    const double end = seconds_now() + (asked != NULL ? atof(asked) : 2.0);
    uint32_t edits = 0, most_versions = 0;
    // However slow the machine: until readers have seen something of it.
    while (seconds_now() < end || atomic_load(&world.newer) < 20) {
        edit_once(&world, &e);
        tl_nav_versions_state now;
        TEST_RESULT(tl_nav_versions_reclaim(world.versions, &now), TL_OK);
        most_versions = now.version_count > most_versions ? now.version_count : most_versions;
        edits++;
    }
    atomic_store(&world.done, true);
    for (int i = 0; i < READERS; i++) {
        pthread_join(readers[i], NULL);
    }
    print_message("%u versions, %u answers, %u of them on a newer version than before; %u versions at most\n", edits,
                  atomic_load(&world.answers), atomic_load(&world.newer), most_versions);
    TEST_CHECK(atomic_load(&world.wrong) == 0);
    // Each reader holds two at most; beside them there is the newest, and one that is just left.
    TEST_CHECK(most_versions <= 2 * READERS + 1);
    tl_nav_versions_state left;
    TEST_RESULT(tl_nav_versions_reclaim(world.versions, &left), TL_OK);
    TEST_CHECK(left.version_count == 1 && left.waiting_bytes == 0);
    tl_nav_query_destroy(e.query);
    tl_nav_obstacles_destroy(world.obstacles);
    tl_nav_versions_destroy(world.versions);
    free(world.expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_readers_beside_edits) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
