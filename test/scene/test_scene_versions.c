// SPDX-License-Identifier: MIT
//
// Versions of a scene: each answers as a scene baked of its instances alone, also while it is held and others come;
// what readers leave is used again; and two threads cast rays without a lock while a third one moves instances, takes
// and adds some, and exchanges a soup for another one that it frees when no version has it any more.
//
//   TALUS_EDIT_SECONDS=60 test_scene_versions    for that long instead of 2 seconds

#define _POSIX_C_SOURCE 200809L // clock_gettime

#include "scene_models.h"

#include <pthread.h>
#include <stdatomic.h>
#include <talus/scene_versions.h>
#include <time.h>

enum { MAX_INSTANCES = 40, RAYS = 12, MAX_HELD = 6, ROUNDS = 400, READERS = 2, MAX_VERSIONS = 1 << 22, LONG_HOLD = 50 };

static uint64_t mix(uint64_t hash, uint64_t value)
{
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

// The same rays for all.
static uint64_t answers(const tl_scene *scene, const tl_scene_instance *instances)
{
    test_random random = { 3 };
    uint64_t hash = 1;
    for (uint32_t i = 0; i < RAYS; i++) {
        const tl_ray ray = { test_random_point(&random, tl_vec3_make(-9, -9, -9), tl_vec3_make(9, 9, 9)),
                             test_random_direction(&random), INFINITY };
        tl_scene_hit hit;
        memset(&hit, 0, sizeof hit);
        if (tl_scene_cast_ray(scene, instances, &ray, NULL, &hit)) {
            uint32_t t;
            memcpy(&t, &hit.hit.t, sizeof t);
            hash = mix(mix(mix(hash, t), hit.instance), hit.hit.triangle);
        }
    }
    return hash;
}

static uint64_t answers_alone(const tl_scene_instance *instances, uint32_t count)
{
    tl_scene *alone = scene_build(instances, count);
    const uint64_t hash = answers(alone, instances);
    tl_blob_free(alone);
    return hash;
}

// Moves some instances, and now and then changes what they are, or how many there are.
static void change(const scene_parts *parts, test_random *random, tl_scene_instance *instances, uint32_t *count)
{
    const tl_vec3 center = tl_vec3_make(0, 0, 0);
    for (uint32_t k = test_random_below(random, 4) * test_random_below(random, 4); k > 0 && *count > 0; k--) {
        const uint32_t i = test_random_below(random, *count);
        if (test_random_below(random, 4) == 0) {
            instances[i] = scene_instance(parts, random, center, 8.0f);
        } else {
            instances[i].pose.position = test_random_point(random, tl_vec3_make(-8, -8, -8), tl_vec3_make(8, 8, 8));
        }
    }
    if (test_random_below(random, 6) == 0) {
        const uint32_t now = test_random_below(random, MAX_INSTANCES + 1);
        if (now > *count) {
            scene_fill(parts, random, center, 8.0f, instances + *count, now - *count);
        }
        *count = now;
    }
}

typedef struct held_version {
    const tl_scene_version *version;
    uint64_t hash;
} held_version;

static void test_versions_stay(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1.0f);
    test_random random = { 1 };
    test_allocator counted;
    test_allocator_init(&counted, 0);
    tl_scene_instance instances[MAX_INSTANCES];
    uint32_t count = 20, held_count = 0;
    scene_fill(&parts, &random, tl_vec3_make(0, 0, 0), 8.0f, instances, count);
    tl_scene_versions *versions;
    TEST_RESULT(tl_scene_versions_create(instances, count, &counted.allocator, &versions, NULL), TL_OK);
    held_version held[MAX_HELD];
    for (uint32_t round = 0; round < ROUNDS; round++) {
        const tl_scene_version *newest = tl_scene_versions_acquire(versions);
        TEST_CHECK(newest->number == round + 1 && newest->count == count);
        TEST_CHECK(answers(newest->scene, newest->instances) == answers_alone(instances, count));
        if (held_count == MAX_HELD || (held_count > 0 && test_random_below(&random, 2) == 0)) {
            const uint32_t i = test_random_below(&random, held_count);
            TEST_CHECK(answers(held[i].version->scene, held[i].version->instances) == held[i].hash);
            tl_scene_versions_release(versions, held[i].version);
            held[i] = held[--held_count];
        }
        const held_version next = { newest, answers_alone(instances, count) };
        if (held_count < MAX_HELD && test_random_below(&random, 2) == 0) {
            held[held_count++] = next;
        } else {
            tl_scene_versions_release(versions, newest);
        }
        change(&parts, &random, instances, &count);
        TEST_RESULT(tl_scene_versions_publish(versions, instances, count, NULL), TL_OK);
        tl_scene_versions_state now;
        TEST_RESULT(tl_scene_versions_reclaim(versions, &now), TL_OK);
        TEST_CHECK(now.newest == round + 2 && now.version_count <= held_count + 1);
        for (uint32_t i = 0; i < held_count; i++) {
            TEST_CHECK(held[i].version->number >= now.oldest);
        }
    }
    while (held_count > 0) {
        tl_scene_versions_release(versions, held[--held_count].version);
    }
    tl_scene_versions_state last;
    TEST_RESULT(tl_scene_versions_reclaim(versions, &last), TL_OK);
    TEST_CHECK(last.version_count == 1 && last.oldest == last.newest);
    tl_scene_versions_destroy(versions);
    TEST_CHECK(counted.live_blocks == 0);
    scene_parts_free(&parts);
}

// What is refused leaves the newest version as it is.
static void test_refused(void **state)
{
    (void)state;
    tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1);
    tl_scene_instance instance = { .shape = &ball, .pose = tl_transform_identity(), .mask = 1 };
    tl_scene_versions *versions;
    TEST_RESULT(tl_scene_versions_create(&instance, 1, NULL, &versions, NULL), TL_OK);
    tl_scene_instance bad = instance;
    bad.pose.position.x = NAN;
    tl_report report;
    TEST_RESULT(tl_scene_versions_publish(versions, &bad, 1, &report), TL_ERR_NOT_FINITE);
    TEST_CHECK(strcmp(report.element, "instance") == 0 && report.element_index == 0);
    const tl_scene_version *held[TL_MAX_SCENE_VERSIONS];
    for (uint32_t i = 0; i < TL_MAX_SCENE_VERSIONS; i++) {
        held[i] = tl_scene_versions_acquire(versions);
        TEST_CHECK(held[i]->number == i + 1);
        const tl_result wanted = i + 1 < TL_MAX_SCENE_VERSIONS ? TL_OK : TL_ERR_LIMIT;
        TEST_RESULT(tl_scene_versions_publish(versions, &instance, 1, NULL), wanted);
    }
    tl_scene_versions_release(versions, held[7]);
    TEST_RESULT(tl_scene_versions_publish(versions, &instance, 1, NULL), TL_OK);
    for (uint32_t i = 0; i < TL_MAX_SCENE_VERSIONS; i++) {
        tl_scene_versions_release(versions, i != 7 ? held[i] : NULL);
    }
    tl_scene_versions_destroy(versions);
}

typedef struct shared_scene {
    tl_scene_versions *versions;
    uint64_t *expected; // by number
    atomic_bool done;
    atomic_uint answered, wrong, newer;
} shared_scene;

static void *cast_rays(void *user)
{
    shared_scene *shared = user;
    const tl_scene_version *kept = NULL;
    uint64_t kept_answer = 0, last = 0;
    for (uint32_t round = 0; !atomic_load(&shared->done); round++) {
        const tl_scene_version *version = tl_scene_versions_acquire(shared->versions);
        const uint64_t answer = answers(version->scene, version->instances);
        atomic_fetch_add(&shared->wrong, answer != shared->expected[version->number] || version->number < last);
        atomic_fetch_add(&shared->newer, version->number > last);
        atomic_fetch_add(&shared->answered, 1);
        last = version->number;
        if (round % LONG_HOLD == 0) {
            atomic_fetch_add(&shared->wrong, kept != NULL && answers(kept->scene, kept->instances) != kept_answer);
            tl_scene_versions_release(shared->versions, kept);
            kept = tl_scene_versions_acquire(shared->versions);
            kept_answer = answers(kept->scene, kept->instances);
        }
        tl_scene_versions_release(shared->versions, version);
    }
    tl_scene_versions_release(shared->versions, kept);
    return NULL;
}

// A soup that is exchanged, and freed when no version has it any more.
typedef struct changing_soup {
    tl_soup *now, *before;
    uint64_t last; // version that has `before`
    uint64_t exchanges;
} changing_soup;

static void exchange_soup(changing_soup *soup, const tl_scene_versions_state *state, uint64_t seed)
{
    if (soup->before != NULL && state->oldest > soup->last) {
        tl_blob_free(soup->before);
        soup->before = NULL;
    }
    if (soup->before == NULL) {
        model ball = model_ball(2, 1.0f, 0.3f, tl_vec3_make(0, 0, 0), seed);
        const tl_soup_def def = model_soup_def(MODEL_BOXES);
        soup->before = soup->now;
        soup->last = state->newest;
        soup->now = model_soup(&ball, &def);
        soup->exchanges++;
        model_free(&ball);
    }
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void test_readers_beside_a_writer(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1.0f);
    static shared_scene shared;
    memset(&shared, 0, sizeof shared);
    shared.expected = calloc(MAX_VERSIONS, sizeof *shared.expected);
    TEST_CHECK(shared.expected != NULL);
    test_random random = { 2 };
    tl_scene_instance instances[MAX_INSTANCES + 1];
    uint32_t count = 20;
    changing_soup soup = { NULL, NULL, 0, 0 };
    const tl_scene_versions_state none = { 0, 0, 0 };
    exchange_soup(&soup, &none, 1);
    memset(&instances[0], 0, sizeof instances[0]);
    instances[0].soup = soup.now;
    instances[0].pose = tl_transform_identity();
    instances[0].mask = 1;
    scene_fill(&parts, &random, tl_vec3_make(0, 0, 0), 8.0f, instances + 1, count);
    shared.expected[1] = answers_alone(instances, count + 1);
    TEST_RESULT(tl_scene_versions_create(instances, count + 1, NULL, &shared.versions, NULL), TL_OK);
    pthread_t readers[READERS];
    for (int i = 0; i < READERS; i++) {
        TEST_CHECK(pthread_create(&readers[i], NULL, cast_rays, &shared) == 0);
    }
    const char *asked = getenv("TALUS_EDIT_SECONDS");
    const double end = seconds_now() + (asked != NULL ? atof(asked) : 2.0);
    uint32_t most = 0;
    tl_scene_versions_state now = none;
    // However slow the machine: until readers have seen something of it.
    while ((seconds_now() < end || atomic_load(&shared.newer) < 20) && now.newest + 2 < MAX_VERSIONS) {
        TEST_RESULT(tl_scene_versions_reclaim(shared.versions, &now), TL_OK);
        most = now.version_count > most ? now.version_count : most;
        change(&parts, &random, instances + 1, &count);
        exchange_soup(&soup, &now, now.newest);
        instances[0].soup = soup.now;
        shared.expected[now.newest + 1] = answers_alone(instances, count + 1);
        TEST_RESULT(tl_scene_versions_publish(shared.versions, instances, count + 1, NULL), TL_OK);
    }
    atomic_store(&shared.done, true);
    for (int i = 0; i < READERS; i++) {
        pthread_join(readers[i], NULL);
    }
    print_message("%u versions, %u soups, %u answers, %u of them of a newer version than before; %u versions at most\n",
                  (unsigned)now.newest, (unsigned)soup.exchanges, atomic_load(&shared.answered),
                  atomic_load(&shared.newer), most);
    TEST_CHECK(atomic_load(&shared.wrong) == 0 && soup.exchanges > 3);
    TEST_CHECK(most <= 2 * READERS + 1);
    tl_scene_versions_destroy(shared.versions);
    tl_blob_free(soup.now);
    tl_blob_free(soup.before);
    free(shared.expected);
    scene_parts_free(&parts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_versions_stay),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_readers_beside_a_writer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
