// SPDX-License-Identifier: MIT
//
// The two claims of Christer Ericson's article "Chunky triangle soup" (2009): that pairs of triangles take less memory
// than single ones, and that a ray tests two for little more than one. Four rows a level: a BVH and a k-d tree, with
// pairs and without, over the same leaf code; a fifth is the compact BVH. No peer: the rows are compared with one
// another. Each repetition casts the same rays at all in turn, the best counts, and answers are compared bit by bit.
//
//   bench_soup_trees [--repetitions N (5)] [--rays N (40000)] [--only NAME] [--json FILE]

#include "bench_options.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/soup.h>

enum { ROWS = 5 };

static const char *const row_names[ROWS] = { "BVH, pairs", "BVH, singles", "k-d, pairs", "k-d, singles",
                                             "compact, pairs" };

typedef struct row {
    tl_soup *soup;
    double build;  // seconds
    double camera; // seconds, all rays
    double incoherent;
} row;

typedef struct sums { // of logarithms, over levels
    double bytes[ROWS], camera[ROWS], incoherent[ROWS], paired;
    uint32_t levels;
} sums;

static bool build_rows(const bench_level *level, row rows[ROWS])
{
    bool built = true;
    for (uint32_t k = 0; k < ROWS; k++) {
        tl_soup_def def = tl_default_soup_def();
        def.pair_triangles = k % 2 == 0;
        def.partition = k / 2 == 1 ? TL_SOUP_KD_TREE : TL_SOUP_BVH;
        def.layout = k == 4 ? TL_SOUP_COMPACT : TL_SOUP_FAST;
        double start = bench_thread_seconds();
        built = tl_soup_bake(&level->view, &def, &rows[k].soup, NULL) == TL_OK && built;
        rows[k].build = bench_thread_seconds() - start;
    }
    return built;
}

static void make_rays(tl_ray *camera, tl_ray *incoherent, uint32_t count, tl_aabb bounds)
{
    uint64_t random = 1;
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.05f);
    tl_aabb inner = { tl_add(bounds.min, margin), tl_sub(bounds.max, margin) };
    uint32_t width = (uint32_t)sqrtf((float)count / 4.0f);
    tl_vec3 eye = { 0, 0, 0 }, forward = eye, side = eye, up = eye;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t p = i % (width * width);
        if (p == 0) {
            eye = bench_point_in(&random, inner);
            forward = tl_normalize(tl_sub(bench_point_in(&random, inner), eye));
            side = tl_normalize(tl_cross(forward, tl_vec3_make(0.01f, 1, 0.02f)));
            up = tl_cross(side, forward);
        }
        float x = 2 * ((float)(p % width) + 0.5f) / (float)width - 1;
        float y = 2 * ((float)(p / width) + 0.5f) / (float)width - 1;
        tl_vec3 d = tl_normalize(tl_mul_add(tl_mul_add(forward, side, 0.7f * x), up, 0.7f * y));
        tl_ray seen = { eye, d, INFINITY };
        camera[i] = seen;
        tl_ray ray = { bench_point_in(&random, inner), bench_direction(&random), INFINITY };
        incoherent[i] = ray;
    }
}

static double cast(const tl_soup *soup, const tl_ray *rays, uint32_t count, tl_ray_hit *hits)
{
    double start = bench_thread_seconds();
    for (uint32_t i = 0; i < count; i++) {
        if (!tl_soup_cast_ray(soup, &rays[i], NULL, &hits[i])) {
            memset(&hits[i], 0, sizeof hits[i]);
        }
    }
    return bench_thread_seconds() - start;
}

static bool run(row rows[ROWS], const tl_ray *camera, const tl_ray *incoherent, uint32_t count, uint32_t repetitions)
{
    size_t size = count * sizeof(tl_ray_hit);
    tl_ray_hit *expected = malloc(size), *hits = malloc(size);
    bool same = expected != NULL && hits != NULL;
    for (uint32_t r = 0; same && r < repetitions; r++) {
        for (uint32_t k = 0; k < ROWS; k++) {
            double time = cast(rows[k].soup, camera, count, hits);
            rows[k].camera = r == 0 || time < rows[k].camera ? time : rows[k].camera;
            time = cast(rows[k].soup, incoherent, count, k == 0 ? expected : hits);
            rows[k].incoherent = r == 0 || time < rows[k].incoherent ? time : rows[k].incoherent;
            same = same && (k == 0 || memcmp(expected, hits, size) == 0);
        }
    }
    free(expected);
    free(hits);
    return same;
}

static void print_level(bench_report *report, const bench_level *level, const row rows[ROWS], uint32_t count, bool same,
                        sums *all)
{
    tl_soup_stats pairs = tl_soup_get_stats(rows[0].soup);
    double paired = 200.0 * pairs.pair_count / pairs.triangle_count;
    printf("\n%s: %u triangles, %.1f%% of them in pairs%s\n", level->name, level->view.triangle_count, paired,
           same ? "" : ", ANSWERS DIFFER");
    printf("  %-16s%10s%12s%12s%14s%10s\n", "", "bytes/tri", "references", "ns, camera", "ns, incoherent", "build ms");
    for (uint32_t k = 0; k < ROWS; k++) {
        tl_soup_stats stats = tl_soup_get_stats(rows[k].soup);
        double bytes = (double)stats.size / stats.triangle_count;
        double camera = 1e9 * rows[k].camera / count, incoherent = 1e9 * rows[k].incoherent / count;
        printf("  %-16s%10.1f%11.2fx%12.0f%14.0f%10.1f\n", row_names[k], bytes,
               (double)stats.reference_count / (stats.pair_count + stats.single_count), camera, incoherent,
               1e3 * rows[k].build);
        bench_report_value(report, "bytes a triangle", row_names[k], level->name, bytes);
        bench_report_value(report, "incoherent ray, ns", row_names[k], level->name, incoherent);
        all->bytes[k] += log(bytes);
        all->camera[k] += log(camera);
        all->incoherent[k] += log(incoherent);
    }
    all->paired += paired;
    all->levels++;
}

static void print_means(const sums *all)
{
    printf("\nGeometric means of %u levels, %.1f%% in pairs\n", all->levels, all->paired / all->levels);
    for (uint32_t k = 0; k < ROWS; k++) {
        printf("  %-16s%10.1f bytes/tri%8.0f ns camera%8.0f ns incoherent\n", row_names[k],
               exp(all->bytes[k] / all->levels), exp(all->camera[k] / all->levels),
               exp(all->incoherent[k] / all->levels));
    }
}

int main(int argc, char **argv)
{
    uint32_t repetitions = 5, count = 40000;
    const char *only = NULL;
    const bench_option options[] = { { "repetitions", BENCH_COUNT, &repetitions, "of which the best counts" },
                                     { "rays", BENCH_COUNT, &count, "of each kind" },
                                     { "only", BENCH_TEXT, &only, "levels whose name holds this" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("Soup trees", "bytes or ns", NULL);
    bench_level levels[BENCH_MAX_LEVELS];
    uint32_t level_count = bench_load_levels(levels, only);
    tl_ray *camera = malloc(count * sizeof *camera), *incoherent = malloc(count * sizeof *incoherent);
    sums all = { 0 };
    bool sound = level_count > 0 && camera != NULL && incoherent != NULL;
    for (uint32_t i = 0; sound && i < level_count; i++) {
        row rows[ROWS] = { 0 };
        sound = build_rows(&levels[i], rows);
        if (sound) {
            make_rays(camera, incoherent, count, tl_soup_bounds(rows[0].soup));
            bool same = run(rows, camera, incoherent, count, repetitions);
            print_level(report, &levels[i], rows, count, same, &all);
            sound = same;
        }
        for (uint32_t k = 0; k < ROWS; k++) {
            tl_blob_free(rows[k].soup);
        }
    }
    if (all.levels > 0) {
        print_means(&all);
        bench_report_at_least(report, "triangles in pairs, %", all.paired / all.levels, 95.0);
        bench_report_at_most(report, "BVH: memory of pairs over singles",
                             exp((all.bytes[0] - all.bytes[1]) / all.levels), 1.0);
        bench_report_at_most(report, "BVH: incoherent ray, pairs over singles",
                             exp((all.incoherent[0] - all.incoherent[1]) / all.levels), 1.0);
        bench_report_at_most(report, "k-d: memory of pairs over singles",
                             exp((all.bytes[2] - all.bytes[3]) / all.levels), 1.0);
        bench_report_at_most(report, "k-d: incoherent ray, pairs over singles",
                             exp((all.incoherent[2] - all.incoherent[3]) / all.levels), 1.0);
        bench_report_at_most(report, "compact: bytes a triangle", exp(all.bytes[4] / all.levels), 20.0);
        bench_report_print_claims(report);
    }
    free(camera);
    free(incoherent);
    bench_free_levels(levels, level_count);
    int code = bench_report_close(report, json);
    return sound ? code : 1;
}
