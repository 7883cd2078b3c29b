// SPDX-License-Identifier: MIT
//
// The soup's queries beside rays: batches against single calls, sweeps, overlaps, nearest points, all hits, inside, on
// generated levels. One thread; each repetition runs all queries in turn, the best repetition counts. Times are those
// of this thread alone, so that a busy machine disturbs them less.
//
//   bench_soup_queries [--repetitions N (5)] [--queries N (10000)] [--json FILE]

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/soup.h>

enum { MAX_TRIANGLES = 256, BATCH_SHARE = 20 };

typedef enum kind {
    SINGLE,
    BATCH,
    NEAREST,
    SPHERE_OVERLAP,
    CAPSULE_OVERLAP,
    BOX_OVERLAP,
    SWEEP_SPHERE,
    SWEEP_CAPSULE,
    SWEEP_BOX,
    ALL_HITS,
    LOCATE,
    KINDS
} kind;

static const char *const names[KINDS] = { "ray, single call", "ray, batch",  "nearest point",     "sphere overlap",
                                          "capsule overlap",  "box overlap", "sphere sweep, 4 m", "capsule sweep, 4 m",
                                          "rotated box, 4 m", "all hits",    "inside or outside" };

// Places where a character may be: at most some metres above a triangle. And where it goes.
typedef struct workload {
    const tl_soup *soup;
    uint32_t ray_count, count;
    tl_ray *rays;
    tl_ray_hit *hits, *batch_hits;
    tl_vec3 *places, *motions;
    uint64_t found[KINDS];
} workload;

static void make_workload(workload *w, const tl_soup *soup, uint32_t count)
{
    memset(w, 0, sizeof *w);
    w->soup = soup;
    w->count = count;
    w->ray_count = BATCH_SHARE * count;
    w->rays = malloc(w->ray_count * sizeof *w->rays);
    w->hits = calloc(w->ray_count, sizeof *w->hits);
    w->batch_hits = calloc(w->ray_count, sizeof *w->batch_hits);
    w->places = malloc(count * sizeof *w->places);
    w->motions = malloc(count * sizeof *w->motions);
    tl_aabb bounds = tl_soup_bounds(soup);
    uint64_t random = 1;
    for (uint32_t i = 0; i < w->ray_count; i++) {
        tl_ray ray = { bench_point_in(&random, bounds), bench_direction(&random), INFINITY };
        w->rays[i] = ray;
    }
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 above = bench_point_in(&random, bounds);
        above.y = bounds.max.y + 1;
        tl_ray down = { above, { 0, -1, 0 }, INFINITY };
        tl_ray_hit hit;
        float y = tl_soup_cast_ray(soup, &down, NULL, &hit) ? above.y - hit.t : bounds.min.y;
        w->places[i] = tl_vec3_make(above.x, y + 0.3f + 2 * tl_random_unit_float(&random), above.z);
        w->motions[i] = tl_scale(bench_direction(&random), 4);
    }
}

static void free_workload(workload *w)
{
    free(w->rays);
    free(w->hits);
    free(w->batch_hits);
    free(w->places);
    free(w->motions);
}

static uint64_t cast_single(workload *w)
{
    uint64_t found = 0;
    for (uint32_t i = 0; i < w->ray_count; i++) {
        found += tl_soup_cast_ray(w->soup, &w->rays[i], NULL, &w->hits[i]);
    }
    return found;
}

static uint64_t cast_batch(workload *w)
{
    tl_soup_cast_rays(w->soup, w->rays, w->ray_count, NULL, NULL, w->batch_hits);
    return w->ray_count;
}

static uint64_t overlap(workload *w, tl_convex shape)
{
    uint64_t found = 0;
    uint32_t triangles[MAX_TRIANGLES], count;
    for (uint32_t i = 0; i < w->count; i++) {
        tl_transform pose = { { 0, 0.38268343f, 0, 0.92387953f }, w->places[i] };
        (void)tl_soup_find_overlaps(w->soup, &shape, pose, NULL, triangles, MAX_TRIANGLES, &count);
        found += count > 0;
    }
    return found;
}

static uint64_t sweep(workload *w, tl_convex shape)
{
    uint64_t found = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        tl_transform pose = { { 0, 0.38268343f, 0, 0.92387953f }, w->places[i] };
        tl_shape_hit hit;
        found += tl_soup_cast_shape(w->soup, &shape, pose, w->motions[i], NULL, &hit) == TL_OK;
    }
    return found;
}

static uint64_t ask_points(workload *w, kind k)
{
    uint64_t found = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        if (k == NEAREST) {
            tl_soup_point nearest;
            found += tl_soup_nearest(w->soup, w->places[i], INFINITY, NULL, &nearest) == TL_OK;
        } else if (k == LOCATE) {
            tl_soup_location place;
            found += tl_soup_locate(w->soup, w->places[i], &place) == TL_OK && place.side == TL_SOUP_INSIDE;
        } else {
            tl_ray_hit hits[MAX_TRIANGLES];
            uint32_t count;
            (void)tl_soup_cast_ray_all(w->soup, &w->rays[i], TL_HITS_TOUCHED, NULL, hits, MAX_TRIANGLES, &count);
            found += count;
        }
    }
    return found;
}

static uint64_t run(workload *w, kind k)
{
    tl_vec3 zero = tl_vec3_make(0, 0, 0);
    tl_convex sphere = tl_convex_sphere(zero, 0.4f), box = tl_convex_box(zero, tl_vec3_make(0.4f, 0.9f, 0.4f), 0);
    tl_convex capsule = tl_convex_capsule(zero, tl_vec3_make(0, 1, 0), 0.4f);
    switch (k) {
    case SINGLE:
        return cast_single(w);
    case BATCH:
        return cast_batch(w);
    case SPHERE_OVERLAP:
        return overlap(w, sphere);
    case CAPSULE_OVERLAP:
        return overlap(w, capsule);
    case BOX_OVERLAP:
        return overlap(w, box);
    case SWEEP_SPHERE:
        return sweep(w, sphere);
    case SWEEP_CAPSULE:
        return sweep(w, capsule);
    case SWEEP_BOX:
        return sweep(w, box);
    default:
        return ask_points(w, k);
    }
}

static bool same_hits(const workload *w)
{
    for (uint32_t i = 0; i < w->ray_count; i++) {
        const tl_ray_hit *a = &w->hits[i], *b = &w->batch_hits[i];
        if (b->triangle == TL_NO_TRIANGLE ? a->t != 0 : a->triangle != b->triangle || a->t != b->t || a->u != b->u) {
            return false;
        }
    }
    return true;
}

static void print_level(bench_report *report, const char *name, uint32_t triangles, const workload *w,
                        const double *best)
{
    char label[64], claim[128];
    snprintf(label, sizeof label, "%s %uk", name, (triangles + 500) / 1000);
    printf("\n%s, %u triangles, %.1f MB\n", name, triangles, (double)tl_soup_size(w->soup) / 1e6);
    for (uint32_t k = 0; k < KINDS; k++) {
        uint32_t count = k <= BATCH ? w->ray_count : w->count;
        double seconds = best[k] / count;
        printf("  %-20s %9.0f ns  %9.0f a second", names[k], 1e9 * seconds, 1.0 / seconds);
        if (k == BATCH) {
            printf("  %.2f x single calls%s\n", best[SINGLE] / best[BATCH],
                   same_hits(w) ? ", same bits" : " DIFFERENT");
        } else {
            printf("  %.2f found a query\n", (double)w->found[k] / count);
        }
        bench_report_value(report, "a query, ns", names[k], label, 1e9 * seconds);
    }
    snprintf(claim, sizeof claim, "%s: batch of incoherent rays", label);
    bench_report_speed(report, claim, "single calls", best[SINGLE] / best[BATCH], 1.3);
}

static void run_level(bench_report *report, const char *name, uint32_t triangles, uint32_t repetitions,
                      uint32_t queries)
{
    bench_level level;
    if (!bench_make_sample(name, triangles, &level)) {
        return;
    }
    tl_soup *soup;
    if (tl_soup_bake(&level.view, NULL, &soup, NULL) == TL_OK) {
        workload w;
        make_workload(&w, soup, queries);
        double best[KINDS];
        for (uint32_t r = 0; r < repetitions; r++) {
            for (uint32_t k = 0; k < KINDS; k++) {
                double start = bench_thread_seconds();
                w.found[k] = run(&w, (kind)k);
                double time = bench_thread_seconds() - start;
                best[k] = r == 0 || time < best[k] ? time : best[k];
            }
        }
        print_level(report, name, level.view.triangle_count, &w, best);
        free_workload(&w);
        tl_blob_free(soup);
    }
    bench_free_levels(&level, 1);
}

int main(int argc, char **argv)
{
    uint32_t repetitions = 5, queries = 10000;
    const bench_option options[] = { { "repetitions", BENCH_COUNT, &repetitions, "of which the best counts" },
                                     { "queries", BENCH_COUNT, &queries, "of each kind" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("Soup queries", "ns", NULL);
    run_level(report, "dungeon", 8000, repetitions, queries);
    run_level(report, "dungeon", 50000, repetitions, queries);
    run_level(report, "terrain", 100000, repetitions, queries);
    run_level(report, "city", 100000, repetitions, queries);
    run_level(report, "city", 1000000, repetitions, queries);
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
