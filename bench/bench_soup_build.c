// SPDX-License-Identifier: MIT
//
// Builds of the soup: against Embree 3 on one thread and on two (FAST against quality MEDIUM, DEFAULT and HIGH against
// HIGH), and two threads against one. Every round runs all of them in turn and the best round counts: CPU time against
// Embree, wall time for threads. Two threads need two processors with nothing else to do. Memory is the most that a
// build holds at once, its result included and the caller's mesh not: what Embree's device reports but for its copies
// of vertices and indices.
//
//   bench_soup_build [--rounds N (5)] [--only NAME] [--sample NAME --triangles N] [--json FILE]

#define _POSIX_C_SOURCE 200809L

#include "bench_options.h"
#include "cli/shared/thread_pool.h"
#include "embree_scene.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/soup.h>

enum { MAX_STAGES = 8, THREADED_TRIANGLES = 50000 - 100 };

// Small levels get more rounds.
enum { MORE_ROUNDS = 5, FEW_TRIANGLES = 100000 };

typedef enum system { PLAIN, CHOSEN, SPLIT, MEDIUM, HIGH, ONE_THREAD, TWO_THREADS, MEDIUM_TWO, SYSTEMS } system_kind;

static const char *const system_names[SYSTEMS] = {
    "talus fast",  "talus default", "talus high",  "Embree medium",
    "Embree high", "one thread",    "two threads", "Embree two threads"
};

typedef struct stage {
    const char *name;
    double began, best; // seconds
} stage;

typedef struct level_result {
    double best[SYSTEMS]; // seconds
    stage stages[MAX_STAGES];
    uint32_t stage_count;
    double peak_bytes, bytes, embree_peak;
} level_result;

// What the device holds, and the most that it held.
static double embree_bytes, embree_peak;

static bool count_memory(void *user, ssize_t bytes, bool post)
{
    (void)user;
    (void)post;
    embree_bytes += (double)bytes;
    embree_peak = embree_bytes > embree_peak ? embree_bytes : embree_peak;
    return true;
}

static bool time_stage(const char *name, uint64_t done, uint64_t total, void *user)
{
    level_result *r = user;
    uint32_t i = 0;
    while (i < r->stage_count && strcmp(r->stages[i].name, name) != 0) {
        i++;
    }
    if (i == r->stage_count && i < MAX_STAGES) {
        r->stages[r->stage_count++] = (stage){ name, 0, 1e30 };
    }
    if (i < MAX_STAGES && done == 0) {
        r->stages[i].began = bench_process_seconds();
    }
    if (i < MAX_STAGES && done == total) {
        double seconds = bench_process_seconds() - r->stages[i].began;
        r->stages[i].best = seconds < r->stages[i].best ? seconds : r->stages[i].best;
    }
    return true;
}

static void build_soup(const tl_mesh_view *view, tl_soup_quality quality, const tl_tasks *tasks, level_result *staged,
                       level_result *r)
{
    tl_progress progress = { time_stage, staged };
    tl_soup_def def = tl_default_soup_def();
    def.quality = quality;
    def.host.tasks = tasks;
    def.host.progress = staged != NULL ? &progress : NULL;
    tl_soup *soup = NULL;
    tl_soup_report report;
    tl_result code = tl_soup_bake(view, &def, &soup, &report);
    if (code != TL_OK) {
        fprintf(stderr, "%s\n", tl_result_text(code));
        exit(1);
    }
    r->peak_bytes = (double)report.base.peak_bytes;
    r->bytes = (double)tl_soup_size(soup);
    tl_blob_free(soup);
}

// What builds run on.
typedef struct build_host {
    RTCDevice one_thread, two_threads; // Embree's
    const tl_tasks *tasks;             // of two threads
} build_host;

static void run_system(system_kind system, const tl_mesh_view *view, const build_host *host, level_result *r)
{
    switch (system) {
    case CHOSEN:
        build_soup(view, TL_SOUP_QUALITY_DEFAULT, NULL, NULL, r);
        return;
    case SPLIT:
        build_soup(view, TL_SOUP_QUALITY_HIGH, NULL, NULL, r);
        return;
    case MEDIUM:
        embree_bytes = embree_peak = 0;
        rtcReleaseScene(bench_embree_triangles(host->one_thread, view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM));
        r->embree_peak = embree_peak - 12.0 * ((double)view->vertex_count + (double)view->triangle_count);
        return;
    case MEDIUM_TWO:
        rtcReleaseScene(bench_embree_triangles(host->two_threads, view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM));
        return;
    case HIGH:
        rtcReleaseScene(bench_embree_triangles(host->one_thread, view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH));
        return;
    default:
        build_soup(view, TL_SOUP_QUALITY_FAST, system == TWO_THREADS ? host->tasks : NULL, system == PLAIN ? r : NULL,
                   r);
        return;
    }
}

static void run_level(const bench_level *l, uint32_t rounds, const build_host *host, bench_report *report,
                      level_result *r)
{
    uint32_t triangles = l->view.triangle_count;
    memset(r, 0, sizeof *r);
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        r->best[system] = 1e30;
    }
    uint32_t more = triangles < FEW_TRIANGLES ? MORE_ROUNDS : 1;
    for (uint32_t round = 0; round < rounds * more; round++) {
        for (uint32_t system = 0; system < SYSTEMS; system++) {
            double start = system < ONE_THREAD ? bench_process_seconds() : bench_wall_seconds();
            run_system((system_kind)system, &l->view, host, r);
            double seconds = (system < ONE_THREAD ? bench_process_seconds() : bench_wall_seconds()) - start;
            r->best[system] = seconds < r->best[system] ? seconds : r->best[system];
        }
    }
    double ns = 1e9 / triangles;
    printf("%-20s %8u triangles, ns each:", l->name, triangles);
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        printf("  %s %.0f", system_names[system], ns * r->best[system]);
        bench_report_value(report, "build, ns a triangle", system_names[system], l->name, ns * r->best[system]);
    }
    printf("\n    stages:");
    for (uint32_t i = 0; i < r->stage_count; i++) {
        printf("  %s %.0f", r->stages[i].name, ns * r->stages[i].best);
    }
    printf("; %.1f bytes a triangle, at most %.0f held (Embree %.0f); two threads %.2f\n", r->bytes / triangles,
           r->peak_bytes / triangles, r->embree_peak / triangles, r->best[ONE_THREAD] / r->best[TWO_THREADS]);
    fflush(stdout);
}

// The geometric mean of one system's time to another's, over levels of so many triangles or more.
static double mean_ratio(const level_result *results, const bench_level *levels, uint32_t count, system_kind a,
                         system_kind b, uint32_t min_triangles)
{
    double sum = 0;
    uint32_t taken = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (levels[i].view.triangle_count >= min_triangles) {
            sum += log(results[i].best[a] / results[i].best[b]);
            taken++;
        }
    }
    return taken > 0 ? exp(sum / taken) : 0;
}

static void claim(bench_report *report, const level_result *results, const bench_level *levels, uint32_t count)
{
    bench_report_speed(report, "bake", "Embree at MEDIUM", mean_ratio(results, levels, count, MEDIUM, PLAIN, 0), 1.11);
    bench_report_speed(report, "bake on two threads", "Embree at MEDIUM on two",
                       mean_ratio(results, levels, count, MEDIUM_TWO, TWO_THREADS, 0), 1.11);
    bench_report_speed(report, "bake at high quality", "Embree at HIGH",
                       mean_ratio(results, levels, count, HIGH, SPLIT, 0), 1.67);
    bench_report_speed(report, "two threads, 50k triangles and more", "one",
                       mean_ratio(results, levels, count, ONE_THREAD, TWO_THREADS, THREADED_TRIANGLES), 1.7);
    double worst = 0;
    for (uint32_t i = 0; i < count; i++) {
        worst = fmax(worst, results[i].peak_bytes / results[i].embree_peak);
    }
    bench_report_at_most(report, "memory held at the peak, as a share of Embree's at MEDIUM, worst level", worst, 1.1);
}

int main(int argc, char **argv)
{
    uint32_t rounds = 5, triangles = 0;
    const char *only = NULL, *sample = NULL;
    const bench_option options[] = { { "rounds", BENCH_COUNT, &rounds, "of which the best counts" },
                                     { "only", BENCH_TEXT, &only, "levels whose name holds this" },
                                     { "sample", BENCH_TEXT, &sample, "a built-in level instead" },
                                     { "triangles", BENCH_COUNT, &triangles, "of the built-in level" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("Soup builds", "ns", NULL);
    tl_thread_pool *pool = tl_thread_pool_create(2);
    const build_host host = { rtcNewDevice("threads=1"), rtcNewDevice("threads=2"), tl_thread_pool_tasks(pool) };
    rtcSetDeviceMemoryMonitorFunction(host.one_thread, count_memory, NULL);
    static bench_level levels[BENCH_MAX_LEVELS];
    static level_result results[BENCH_MAX_LEVELS];
    uint32_t count =
        sample != NULL ? bench_make_sample(sample, triangles, &levels[0]) : bench_load_levels(levels, only);
    for (uint32_t i = 0; i < count; i++) {
        run_level(&levels[i], rounds, &host, report, &results[i]);
    }
    if (count > 0) {
        claim(report, results, levels, count);
    }
    bench_report_print_claims(report);
    bench_free_levels(levels, count);
    tl_thread_pool_free(pool);
    rtcReleaseDevice(host.one_thread);
    rtcReleaseDevice(host.two_threads);
    return bench_report_close(report, json);
}
