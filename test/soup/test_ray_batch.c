// SPDX-License-Identifier: MIT
//
// ray_batch.c: a batch gives the bits of single calls, in any order, on any number of threads.

#include "soup/ray/ray_job.h"
#include "soup_models.h"

// A walk of many rays whose stacks overflow all the time.
#define TL_LANE_STACK_SIZE 24
#define TL_RAY_WALK        test_walk
#define TL_RAY_WALK_MANY   test_walk_many
static tl_ray_walk_fn test_walk, test_walk_alone;
static tl_ray_walk_many_fn test_walk_many;
#include "soup/ray/ray_walk.inl"
#undef TL_RAY_WALK
#define TL_RAY_WALK test_walk_alone
#include "soup/ray/ray_walk_interleaved.inl"

#include <pthread.h>

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

typedef struct loop {
    tl_task_fn *task;
    void *task_user;
    uint32_t count, worker;
} loop;

// Every third item: three threads.
static void *run_third(void *user)
{
    loop *l = user;
    for (uint32_t i = l->worker; i < l->count; i += 3) {
        l->task(i, l->worker, l->task_user);
    }
    return NULL;
}

static void run_on_threads(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    pthread_t threads[3];
    loop loops[3];
    for (uint32_t i = 0; i < 3; i++) {
        loops[i] = (loop){ task, task_user, count, i };
        TEST_CHECK(pthread_create(&threads[i], NULL, run_third, &loops[i]) == 0);
    }
    for (uint32_t i = 0; i < 3; i++) {
        pthread_join(threads[i], NULL);
    }
    *(uint32_t *)user += count;
}

static bool even(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    (void)user;
    return triangle % 2 == 0;
}

static bool same_hit(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return memcmp(&a->t, &b->t, sizeof a->t) == 0 && a->triangle == b->triangle &&
           memcmp(&a->u, &b->u, sizeof a->u) == 0 && memcmp(&a->v, &b->v, sizeof a->v) == 0 &&
           memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 && a->material == b->material && a->back == b->back;
}

static void check_batch(const tl_soup *soup, uint32_t count, const tl_ray_filter *filter, uint64_t seed)
{
    test_random random = { seed };
    tl_aabb bounds = tl_soup_bounds(soup);
    tl_ray *rays = malloc(count * sizeof *rays + 1);
    tl_ray_hit *single = malloc(count * sizeof *single + 1), *batch = malloc(count * sizeof *batch + 1);
    TEST_CHECK(rays != NULL && single != NULL && batch != NULL);
    uint32_t hits = 0;
    for (uint32_t i = 0; i < count; i++) {
        rays[i].origin = test_random_point(&random, bounds.min, bounds.max);
        rays[i].direction = test_random_direction(&random);
        rays[i].tmax = i % 5 == 0 ? 2.0f : INFINITY;
        if (i % 1000 == 7) { // what hits nothing
            rays[i].origin.y = i % 3 == 0 ? NAN : i % 3 == 1 ? INFINITY : -3e38f;
        }
        memset(&single[i], 0, sizeof single[i]);
        if (!tl_soup_cast_ray(soup, &rays[i], filter, &single[i])) {
            single[i].t = INFINITY;
            single[i].triangle = TL_NO_TRIANGLE;
        }
        hits += single[i].triangle != TL_NO_TRIANGLE;
    }
    uint32_t tasks = 0;
    tl_tasks threads = { run_on_threads, 3, &tasks };
    tl_host host = { NULL, &threads, NULL };
    for (uint32_t way = 0; way < 2; way++) {
        memset(batch, 0xff, count * sizeof *batch);
        tl_soup_cast_rays(soup, rays, count, filter, way == 1 ? &host : NULL, batch);
        for (uint32_t i = 0; i < count; i++) {
            TEST_CHECK(same_hit(&batch[i], &single[i]));
        }
    }
    TEST_CHECK(count == 0 || (hits > count / 50 && hits < count));
    TEST_CHECK(count <= 16384 || tasks > 0); // a loop of one item needs no host
    free(rays);
    free(single);
    free(batch);
}

static void test_same_bits(void **state)
{
    (void)state;
    // Larger than what has many rays under way, and smaller.
    model large = model_terrain(360, 4, vec(0, 0, 0), 1), small = model_terrain(20, 4, vec(900, 0, 0), 2);
    tl_soup_def compact = tl_default_soup_def();
    compact.layout = TL_SOUP_COMPACT;
    tl_soup *soups[3] = { model_soup(&large, NULL), model_soup(&small, NULL), model_soup(&small, &compact) };
    tl_ray_filter filter = { 0 };
    filter.accept = even;
    for (uint32_t i = 0; i < 3; i++) {
        check_batch(soups[i], 70000, NULL, 1);
        check_batch(soups[i], 5000, &filter, 2);
        check_batch(soups[i], 0, NULL, 3);
        tl_blob_free(soups[i]);
    }
    model_free(&large);
    model_free(&small);
}

static uint32_t alone;

static bool test_walk_alone(const tl_soup *soup, const tl_vec3 *origin, const tl_vec3 *target, float tmax,
                            bool is_segment, const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    alone++;
    return test_walk(soup, origin, target, tmax, is_segment, filter, hit_out);
}

// Every instruction set's walk of many rays, and that with short stacks, against the plain walk of one.
static void check_walks(const model *m, uint32_t count, uint64_t seed)
{
    test_random random = { seed };
    tl_soup *soup = model_soup(m, NULL);
    tl_aabb bounds = tl_soup_bounds(soup);
    tl_ray *rays = malloc(count * sizeof *rays);
    tl_ray_hit *single = malloc(count * sizeof *single), *hits = malloc(count * sizeof *hits);
    TEST_CHECK(rays != NULL && single != NULL && hits != NULL);
    for (uint32_t i = 0; i < count; i++) {
        rays[i].origin = test_random_point(&random, bounds.min, bounds.max);
        rays[i].direction = i % 7 == 0 ? vec(0, -1, 0) : test_random_direction(&random);
        rays[i].tmax = i % 5 == 0 ? 2.0f : INFINITY;
        if (!tl_soup_cast_ray_with(tl_ray_walk_scalar, soup, &rays[i], NULL, &single[i])) {
            tl_ray_miss(&single[i]);
        }
    }
    tl_ray_walk_many_fn *walks[TL_RAY_ISA_COUNT + 1] = { [TL_RAY_ISA_COUNT] = test_walk_many };
    for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
        walks[isa] = tl_ray_walk_many_for(isa);
    }
    for (uint32_t i = 0; i < sizeof walks / sizeof walks[0]; i++) {
        if (walks[i] == NULL) {
            continue;
        }
        memset(hits, 0xff, count * sizeof *hits);
        tl_ray_batch batch = { soup, rays, NULL, count, NULL, hits, NULL, true };
        walks[i](&batch);
        for (uint32_t k = 0; k < count; k++) {
            TEST_CHECK(same_hit(&single[k], &hits[k]));
        }
    }
    free(rays);
    free(single);
    free(hits);
    tl_blob_free(soup);
}

static void test_walks(void **state)
{
    (void)state;
    model terrain = model_terrain(60, 4, vec(0, 0, 0), 1);
    for (uint32_t count = 1; count < 40; count++) {
        check_walks(&terrain, count, count); // fewer rays than lanes, and a few more
    }
    check_walks(&terrain, 20000, 1);
    model_free(&terrain);
    // Triangles as large as the whole: rays enter all boxes.
    model heap = model_random(3000, 1, 40, 2);
    check_walks(&heap, 300, 2);
    model_free(&heap);
    TEST_CHECK(alone > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_walks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
