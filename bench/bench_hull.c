// SPDX-License-Identifier: MIT
//
// Convex hulls of clouds, with Qhull as peer where it is installed: microseconds, CPU time, the best of several
// repetitions, taken by turns. Talus's figure includes the baked block with planes, mass and support tables; Qhull's is
// the bare hull. Then rays against hulls: nanoseconds a ray with each of the kernels, in a row and each waiting for the
// last.

#define _GNU_SOURCE

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "report.h"

#include "hull/ray/hull_ray.h"

#include <talus/hull.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef TALUS_BENCH_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

enum { MAX_POINTS = 140000 };

static double now(void)
{
    return 1e6 * bench_thread_seconds();
}

static uint64_t random_state = 1;

static float random_signed(void)
{
    return 2.0f * tl_random_unit_float(&random_state) - 1.0f;
}

typedef enum cloud_kind { CLOUD_SPHERE, CLOUD_CUBE, CLOUD_CUBE_FACES, CLOUD_GRID } cloud_kind;

static void make_cloud(cloud_kind kind, tl_vec3 *points, uint32_t count)
{
    uint32_t side = (uint32_t)ceilf(cbrtf((float)count));
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = tl_vec3_make(random_signed(), random_signed(), random_signed());
        if (kind == CLOUD_SPHERE) {
            p = tl_normalize(p);
        } else if (kind == CLOUD_CUBE_FACES) {
            p = i % 3 == 0   ? tl_vec3_make(p.x > 0 ? 1.0f : -1.0f, p.y, p.z)
                : i % 3 == 1 ? tl_vec3_make(p.x, p.y > 0 ? 1.0f : -1.0f, p.z)
                             : tl_vec3_make(p.x, p.y, p.z > 0 ? 1.0f : -1.0f);
        } else if (kind == CLOUD_GRID) {
            p = tl_vec3_make((float)(i % side), (float)(i / side % side), (float)(i / (side * side)));
        }
        points[i] = p;
    }
}

static double run_talus(const tl_vec3 *points, uint32_t count, uint32_t *vertices_out)
{
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    double start = now();
    if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK) {
        return 1e30;
    }
    double time = now() - start;
    *vertices_out = hull->vertex_count;
    tl_blob_free(hull);
    return time;
}

#ifdef TALUS_BENCH_QHULL
static double run_qhull(const tl_vec3 *points, uint32_t count, uint32_t *vertices_out)
{
    static coordT coordinates[3 * MAX_POINTS];
    for (uint32_t i = 0; i < count; i++) {
        coordinates[3 * i] = (double)points[i].x;
        coordinates[3 * i + 1] = (double)points[i].y;
        coordinates[3 * i + 2] = (double)points[i].z;
    }
    FILE *null = fopen("/dev/null", "w");
    char options[] = "qhull Pp";
    qhT qh;
    double start = now();
    qh_zero(&qh, NULL);
    int failed = qh_new_qhull(&qh, 3, (int)count, coordinates, False, options, NULL, null);
    double time = failed ? 1e30 : now() - start;
    *vertices_out = (uint32_t)qh.num_vertices;
    qh_freeqhull(&qh, !qh_ALL);
    int long_blocks, long_bytes;
    qh_memfreeshort(&qh, &long_blocks, &long_bytes);
    fclose(null);
    return time;
}
#endif

static void bench_builds(bench_report *report)
{
    static const struct {
        const char *name;
        cloud_kind kind;
        uint32_t count;
        int repetitions;
        double limit; // times as fast as Qhull; 0: none
    } cases[] = {
        { "sphere 32", CLOUD_SPHERE, 32, 200, 0.0 },       { "sphere 128", CLOUD_SPHERE, 128, 100, 0.0 },
        { "sphere 512", CLOUD_SPHERE, 512, 50, 2.0 },      { "sphere 2048", CLOUD_SPHERE, 2048, 20, 2.0 },
        { "sphere 8192", CLOUD_SPHERE, 8192, 9, 2.0 },     { "sphere 32768", CLOUD_SPHERE, 32768, 5, 2.0 },
        { "sphere 131072", CLOUD_SPHERE, 131072, 3, 2.0 }, { "cube 8192", CLOUD_CUBE, 8192, 20, 1.0 },
        { "cube 131072", CLOUD_CUBE, 131072, 5, 1.0 },     { "cube faces 8192", CLOUD_CUBE_FACES, 8192, 9, 1.0 },
        { "grid 132651", CLOUD_GRID, 132651, 5, 1.0 },
    };
    static tl_vec3 points[MAX_POINTS];
    printf("%-16s %10s %10s %10s %7s\n", "hull", "vertices", "talus us", "qhull us", "times");
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        make_cloud(cases[c].kind, points, cases[c].count);
        double talus = 1e30, peer = 1e30;
        uint32_t vertices = 0;
        for (int k = 0; k < cases[c].repetitions; k++) {
            talus = fmin(talus, run_talus(points, cases[c].count, &vertices));
#ifdef TALUS_BENCH_QHULL
            uint32_t peer_vertices;
            peer = fmin(peer, run_qhull(points, cases[c].count, &peer_vertices));
#endif
        }
        printf("%-16s %10u %10.1f", cases[c].name, vertices, talus);
        bench_report_value(report, "build a hull, us", "talus", cases[c].name, talus);
        if (peer < 1e30) {
            printf(" %10.1f %7.2f\n", peer, peer / talus);
            bench_report_value(report, "build a hull, us", "Qhull", cases[c].name, peer);
            if (cases[c].limit > 0.0) {
                bench_report_speed(report, cases[c].name, "Qhull", peer / talus, cases[c].limit);
            }
        } else {
            printf(" %10s %7s\n", "-", "-");
        }
    }
}

enum { RAY_COUNT = 2048, RAY_ROUNDS = 15 };

typedef struct ray {
    double origin[3], direction[3];
} ray;

// From a sphere twice as large to points around the middle: most rays hit.
static void make_rays(ray *rays)
{
    for (int i = 0; i < RAY_COUNT; i++) {
        tl_vec3 from = tl_scale(tl_normalize(tl_vec3_make(random_signed(), random_signed(), random_signed())), 2.0f);
        tl_vec3 to = tl_scale(tl_vec3_make(random_signed(), random_signed(), random_signed()), 0.4f);
        tl_vec3 along = tl_sub(to, from);
        ray r = { { (double)from.x, (double)from.y, (double)from.z },
                  { (double)along.x, (double)along.y, (double)along.z } };
        rays[i] = r;
    }
}

static double time_rays(tl_ray_planes_fn *kernel, const tl_hull *hull, const ray *rays, bool wait, uint32_t *hits_out)
{
    double best = 1e30;
    for (int round = 0; round < RAY_ROUNDS; round++) {
        double start = now(), t = 0.0;
        uint32_t hits = 0, face;
        for (int i = 0; i < RAY_COUNT; i++) {
            // When it waits, the last answer is part of the next question, too small to change it.
            double last = wait ? t * 1e-40 : 0.0;
            double origin[3] = { rays[i].origin[0] + last, rays[i].origin[1], rays[i].origin[2] };
            hits += kernel(hull, origin, rays[i].direction, 10.0, &t, &face);
        }
        best = fmin(best, 1e3 * (now() - start) / RAY_COUNT);
        *hits_out = hits;
    }
    return best;
}

static void bench_rays(bench_report *report)
{
    static const char *const names[] = { "scalar", "SSE4.2", "AVX2", "AVX-512", "chosen" };
    static const uint32_t counts[] = { 8, 32, 128, 512 };
    static ray rays[RAY_COUNT];
    make_rays(rays);
    printf("%-20s %6s", "ray on hull, ns", "faces");
    for (int level = 0; level < 5; level++) {
        printf(" %8s", names[level]);
    }
    printf(" %6s\n", "hits");
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        static tl_vec3 points[512];
        tl_hull *hull;
        make_cloud(CLOUD_SPHERE, points, counts[c]);
        if (tl_hull_bake(points, counts[c], NULL, &hull, NULL) != TL_OK) {
            continue;
        }
        for (int wait = 0; wait < 2; wait++) {
            char label[32];
            uint32_t hits = 0;
            snprintf(label, sizeof label, "sphere %u%s", counts[c], wait ? ", waiting" : "");
            printf("%-20s %6u", label, hull->face_count);
            for (int level = 0; level < 5; level++) {
                tl_ray_planes_fn *kernel = level < 4 ? tl_ray_planes_for(level) : tl_hull_clip_ray;
                if (kernel == NULL) {
                    printf(" %8s", "-");
                    continue;
                }
                double time = time_rays(kernel, hull, rays, wait != 0, &hits);
                printf(" %8.1f", time);
                bench_report_value(report, "ray on a hull, ns", names[level], label, time);
            }
            printf(" %6u\n", hits);
        }
        tl_blob_free(hull);
    }
}

int main(int argc, char **argv)
{
    const bench_option options[] = { { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("Hulls", "time", NULL);
    bench_builds(report);
    bench_rays(report);
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
