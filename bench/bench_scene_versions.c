// SPDX-License-Identifier: MIT
//
// A scene that changes while rays are cast: what publishing costs beside a refit in place, and how many rays a reader
// casts in a second of its time that acquires a version for each of them or for sixteen, alone and beside a writer that
// moves a tenth of the instances some 240 times a second.
//
//   bench_scene_versions [--instances N (1000)] [--json FILE]

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "measure.h"
#include "report.h"

#include <talus/scene_versions.h>

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RAYS = 4096, SLICES = 15, REPEATS = 40, PUBLISHES = 400, MOVED = 10 };

// How a reader comes to its scene.
enum { DIRECT, EACH_RAY, EACH_SIXTEEN, EACH_RAY_BESIDE, READERS };

static uint64_t random_state = 1; // of the writer, while there is one

typedef struct moving_scene {
    uint32_t count;
    tl_soup *soup;
    tl_scene_instance *instances;
    tl_scene *alone;
    tl_scene_versions *versions;
    tl_ray rays[RAYS];
    atomic_bool writes;
    uint32_t published;
} moving_scene;

static void must(tl_result result, const char *what)
{
    if (result != TL_OK) {
        fprintf(stderr, "%s: %s\n", what, tl_result_text(result));
        exit(1);
    }
}

static tl_vec3 random_place(float half)
{
    const float x = half * (2.0f * tl_random_unit_float(&random_state) - 1.0f);
    const float y = half * (2.0f * tl_random_unit_float(&random_state) - 1.0f);
    return tl_vec3_make(x, y, half * (2.0f * tl_random_unit_float(&random_state) - 1.0f));
}

static void make_moving_scene(moving_scene *s, uint32_t count)
{
    tl_sample_mesh mesh;
    must(tl_sample_build_level(tl_sample_find_level("courtyard"), 2000, 1, &mesh), "courtyard");
    const tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
    must(tl_soup_bake(&view, NULL, &s->soup, NULL), "soup");
    s->count = count;
    s->instances = calloc(count, sizeof *s->instances);
    const float half = 25.0f * cbrtf((float)count);
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 turn = random_place(1.0f);
        s->instances[i].soup = s->soup;
        s->instances[i].pose.rotation = (tl_quat){ turn.x, turn.y, turn.z, 1.0f };
        s->instances[i].pose.position = random_place(half);
        s->instances[i].mask = 1;
    }
    for (uint32_t i = 0; i < RAYS; i++) {
        const tl_ray ray = { random_place(half), random_place(1.0f), INFINITY };
        s->rays[i] = ray;
    }
    must(tl_scene_bake(s->instances, count, NULL, &s->alone, NULL), "scene");
    must(tl_scene_versions_create(s->instances, count, NULL, &s->versions, NULL), "versions");
    tl_sample_mesh_free(&mesh);
}

static void move_some(moving_scene *s)
{
    for (uint32_t i = 0; i < s->count; i += MOVED) {
        tl_vec3 *at = &s->instances[i].pose.position;
        *at = tl_add(*at, random_place(0.1f));
    }
}

static void measure_publishing(moving_scene *s, bench_report *report)
{
    double times[2][PUBLISHES];
    for (uint32_t k = 0; k < PUBLISHES; k++) {
        move_some(s);
        double began = bench_thread_seconds();
        must(tl_scene_refit(s->alone, s->instances, s->count, NULL, NULL), "refit");
        times[0][k] = 1e6 * (bench_thread_seconds() - began);
        began = bench_thread_seconds();
        must(tl_scene_versions_publish(s->versions, s->instances, s->count, NULL), "publish");
        times[1][k] = 1e6 * (bench_thread_seconds() - began);
    }
    const double refit = bench_quantile(times[0], PUBLISHES, 0.5), publish = bench_quantile(times[1], PUBLISHES, 0.5);
    printf("%u instances, a tenth moved: refitted %.1f us, published %.1f us\n", s->count, refit, publish);
    bench_report_value(report, "writer", "publishing", "to a refit in place", publish / refit);
}

static double rays_per_second(moving_scene *s, uint32_t reader)
{
    const uint32_t batch = reader == DIRECT ? RAYS : reader == EACH_SIXTEEN ? 16 : 1;
    tl_scene_hit hit;
    const double began = bench_thread_seconds();
    for (uint32_t repeat = 0; repeat < REPEATS; repeat++) {
        for (uint32_t i = 0; i < RAYS; i += batch) {
            const tl_scene_version *version = reader != DIRECT ? tl_scene_versions_acquire(s->versions) : NULL;
            const tl_scene *scene = version != NULL ? version->scene : s->alone;
            const tl_scene_instance *instances = version != NULL ? version->instances : s->instances;
            for (uint32_t k = i; k < i + batch; k++) {
                (void)tl_scene_cast_ray(scene, instances, &s->rays[k], NULL, &hit);
            }
            tl_scene_versions_release(s->versions, version);
        }
    }
    return (double)RAYS * REPEATS / (bench_thread_seconds() - began);
}

static void *write_versions(void *user)
{
    moving_scene *s = user;
    while (atomic_load(&s->writes)) {
        move_some(s);
        must(tl_scene_versions_publish(s->versions, s->instances, s->count, NULL), "publish");
        s->published++;
        const struct timespec pause = { 0, 4000000 };
        nanosleep(&pause, NULL);
    }
    return NULL;
}

static double rays_beside_writer(moving_scene *s)
{
    pthread_t thread;
    atomic_store(&s->writes, true);
    if (pthread_create(&thread, NULL, write_versions, s) != 0) {
        must(TL_ERR_MEMORY, "thread");
    }
    const double rate = rays_per_second(s, EACH_RAY_BESIDE);
    atomic_store(&s->writes, false);
    pthread_join(thread, NULL);
    return rate;
}

static void measure_scene_readers(moving_scene *s, bench_report *report)
{
    double rates[READERS][SLICES], ratios[READERS][SLICES];
    for (int i = -1; i < SLICES; i++) {
        double now[READERS];
        for (uint32_t k = 0; k < READERS; k++) {
            now[k] = k == EACH_RAY_BESIDE ? rays_beside_writer(s) : rays_per_second(s, k);
        }
        for (uint32_t k = 0; k < READERS && i >= 0; k++) { // the first ones warm up
            rates[k][i] = now[k];
            ratios[k][i] = now[k] / now[k == EACH_RAY_BESIDE ? EACH_RAY : DIRECT];
        }
    }
    printf("million rays a second of a reader's time: without versions %.3f, a version for each ray %.3f, for sixteen "
           "%.3f, for each ray beside %u versions published %.3f\n",
           1e-6 * bench_quantile(rates[DIRECT], SLICES, 0.5), 1e-6 * bench_quantile(rates[EACH_RAY], SLICES, 0.5),
           1e-6 * bench_quantile(rates[EACH_SIXTEEN], SLICES, 0.5), s->published,
           1e-6 * bench_quantile(rates[EACH_RAY_BESIDE], SLICES, 0.5));
    bench_report_at_least(report, "rays, a version for each, to those without",
                          bench_quantile(ratios[EACH_RAY], SLICES, 0.5), 0.97);
    bench_report_at_least(report, "rays, a version for sixteen, to those without",
                          bench_quantile(ratios[EACH_SIXTEEN], SLICES, 0.5), 0.97);
    bench_report_at_least(report, "rays beside a writer to those without one",
                          bench_quantile(ratios[EACH_RAY_BESIDE], SLICES, 0.5), 0.97);
}

int main(int argc, char **argv)
{
    uint32_t count = 1000;
    const bench_option options[] = { { "instances", BENCH_COUNT, &count, "of the scene" }, { NULL, 0, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    static moving_scene s;
    make_moving_scene(&s, count);
    bench_report *report = bench_report_new("scene_versions", "us", NULL);
    measure_publishing(&s, report);
    // Both stand the same when rays are compared.
    must(tl_scene_refit(s.alone, s.instances, s.count, NULL, NULL), "refit");
    measure_scene_readers(&s, report);
    bench_report_print_claims(report);
    tl_scene_versions_destroy(s.versions);
    tl_blob_free(s.alone);
    tl_blob_free(s.soup);
    free(s.instances);
    return bench_report_close(report, json);
}
