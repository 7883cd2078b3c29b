// SPDX-License-Identifier: MIT
//
// Rays against Embree 3, in one process, one ray a call, on one thread: the levels of TALUS_DATA_DIR and generated
// ones. Each repetition runs every system on the same rays in turn, twice, and the best second runs count: the best of
// each slice of rays, so that a slice during which the machine did something else is made up for by another repetition.
// Each repetition begins with the next system, and every other one goes through them backwards, so that none always has
// the same place or the same neighbour. Embree asks the system to back its data with huge pages, so a large soup is
// put into such pages too, as a host may do; they are asked for, not promised. Every ray is written float by float just
// before its call, as callers do: a library that then loads it by wider pieces waits for the stores. Segments and sight
// are repeated on the level in centimetres, against the same in metres: a unit must not matter.
// Rows are million rays a second; claims are times as fast, as geometric means over levels, as Embree robust and as
// "Embree fast", the better of its fast triangles and quads, all built at quality HIGH.
//
//   bench_rays [--repetitions N (5)] [--rays N (20000)] [--only NAME] [--json FILE]
//
// Pin it to a core (taskset -c 1) and keep the machine quiet.

#define _DEFAULT_SOURCE // madvise

#include "base/random.h"
#include "bench_options.h"
#include "embree_scene.h"
#include "measure.h"
#include "report.h"
#include "soup/ray/ray_job.h"
#include "soup_levels.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { KINDS = 5, SLICE_RAYS = 500, MAX_SLICES = 4096 };
enum { TALUS, TALUS_AVX2, TALUS_AVX512, COMPACT, FAST, QUADS, ROBUST, SYSTEMS };

static const char *const kind_names[KINDS] = { "camera", "incoherent", "sight", "segment", "down" };
static const char *const system_names[SYSTEMS] = { "talus",       "talus avx2",   "talus avx512", "talus compact",
                                                   "Embree fast", "Embree quads", "Embree robust" };

typedef struct query {
    tl_vec3 origin, target; // target: direction, or end for sight and segment
    float tmax;
} query;

static uint64_t random_state = 1;

// ---------------------------------------------------------------------------------------------------- queries

// Four cameras at random places look at random places, scanline by scanline.
static void make_camera(query *queries, uint32_t count, tl_aabb inner)
{
    uint32_t per_camera = count / 4, width = 1;
    while ((width + 1) * (width + 1) <= per_camera) {
        width++;
    }
    for (uint32_t i = 0, camera = 0; i < count; camera++) {
        tl_vec3 eye = bench_point_in(&random_state, inner);
        tl_vec3 forward = tl_normalize(tl_sub(bench_point_in(&random_state, inner), eye));
        tl_vec3 side = tl_normalize(tl_cross(forward, tl_vec3_make(0.01f, 1, 0.02f)));
        tl_vec3 up = tl_cross(side, forward);
        for (uint32_t p = 0; p < width * width && i < count; p++, i++) {
            float x = 2 * ((float)(p % width) + 0.5f) / (float)width - 1;
            float y = 2 * ((float)(p / width) + 0.5f) / (float)width - 1;
            tl_vec3 d = tl_mul_add(tl_mul_add(forward, side, 0.7f * x), up, 0.7f * y);
            query q = { eye, tl_normalize(d), INFINITY };
            queries[i] = q;
        }
    }
}

static void make_queries(query *queries, uint32_t count, uint32_t kind, tl_aabb bounds)
{
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.05f);
    tl_aabb inner = { tl_add(bounds.min, margin), tl_sub(bounds.max, margin) };
    float diagonal = tl_length(tl_aabb_size(bounds));
    random_state = kind + 1;
    if (kind == 0) {
        make_camera(queries, count, inner);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        query q = { bench_point_in(&random_state, inner), bench_direction(&random_state), INFINITY };
        if (kind == 2) {
            q.target = bench_point_in(&random_state, inner);
        } else if (kind == 3) {
            q.target = tl_mul_add(q.origin, q.target, diagonal * (0.02f + 0.1f * tl_random_unit_float(&random_state)));
        } else if (kind == 4) {
            q.target = tl_vec3_make(0, -1, 0);
        }
        queries[i] = q;
    }
}

// ---------------------------------------------------------------------------------------------------- systems

typedef struct answer {
    uint32_t hits;
    double t_sum;
} answer;

// `volatile`, or the compiler writes two or three floats at once.
static void write_ray(volatile tl_ray *ray, const query *q)
{
    ray->origin.x = q->origin.x;
    ray->origin.y = q->origin.y;
    ray->origin.z = q->origin.z;
    ray->direction.x = q->target.x;
    ray->direction.y = q->target.y;
    ray->direction.z = q->target.z;
    ray->tmax = q->tmax;
}

static void write_embree_ray(volatile struct RTCRay *ray, tl_vec3 origin, tl_vec3 direction, float tmax)
{
    ray->org_x = origin.x;
    ray->org_y = origin.y;
    ray->org_z = origin.z;
    ray->dir_x = direction.x;
    ray->dir_y = direction.y;
    ray->dir_z = direction.z;
    ray->tnear = 0;
    ray->tfar = tmax;
    ray->time = 0;
    ray->mask = UINT32_MAX;
    ray->id = 0;
    ray->flags = 0;
}

static answer run_talus(tl_ray_walk_fn *walk, const tl_soup *soup, const query *queries, uint32_t count, uint32_t kind)
{
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        const query *q = &queries[i];
        tl_ray_hit hit;
        bool found;
        if (kind == 2) {
            found = walk != NULL ? !tl_soup_line_of_sight_with(walk, soup, q->origin, q->target, NULL)
                                 : !tl_soup_line_of_sight(soup, q->origin, q->target, NULL);
            hit.t = 0;
        } else if (kind == 3) {
            found = walk != NULL ? tl_soup_cast_segment_with(walk, soup, q->origin, q->target, NULL, &hit)
                                 : tl_soup_cast_segment(soup, q->origin, q->target, NULL, &hit);
        } else {
            tl_ray ray;
            write_ray(&ray, q);
            found = walk != NULL ? tl_soup_cast_ray_with(walk, soup, &ray, NULL, &hit)
                                 : tl_soup_cast_ray(soup, &ray, NULL, &hit);
        }
        if (found) {
            a.hits++;
            a.t_sum += (double)hit.t;
        }
    }
    return a;
}

static answer run_embree(RTCScene scene, const query *queries, uint32_t count, uint32_t kind)
{
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        const query *q = &queries[i];
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        bool segment = kind == 2 || kind == 3;
        tl_vec3 d = segment ? tl_sub(q->target, q->origin) : q->target;
        struct RTCRayHit ray;
        write_embree_ray(&ray.ray, q->origin, d, segment ? 1 : q->tmax);
        if (kind == 2) {
            rtcOccluded1(scene, &context, &ray.ray);
            a.hits += ray.ray.tfar < 0;
        } else {
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &ray);
            if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
                a.hits++;
                a.t_sum += (double)ray.ray.tfar;
            }
        }
    }
    return a;
}

static double embree_bytes;

static bool count_memory(void *user, ssize_t bytes, bool post)
{
    (void)user;
    (void)post;
    embree_bytes += (double)bytes;
    return true;
}

// Two triangles that share the edge c-a as one quad a, b, c, d; a lone triangle as a quad with d == c.
static RTCScene make_quads(RTCDevice device, const tl_soup *soup)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    tl_soup_stats stats = tl_soup_get_stats(soup);
    uint32_t count = stats.pair_count + stats.single_count;
    float *v = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4 * (size_t)count);
    uint32_t *f = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, count);
    uint64_t cursor = 0;
    tl_soup_pair pair;
    for (uint32_t i = 0; tl_soup_next_pair(soup, &cursor, &pair); i++) {
        // Embree splits a quad along its second and fourth corner.
        static const uint32_t order[4] = { 1, 2, 3, 0 };
        bool single = pair.triangles[1] == TL_NO_TRIANGLE;
        for (uint32_t k = 0; k < 4; k++) {
            memcpy(v + 12 * (size_t)i + 3 * k, &pair.corners[single && k == 3 ? 2 : single ? k : order[k]], 12);
            f[4 * (size_t)i + k] = 4 * i + k;
        }
    }
    return bench_embree_scene(device, geometry, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
}

// ------------------------------------------------------------------------------------------------------- runs

// What a level gave.
typedef struct result {
    double rate[KINDS][SYSTEMS]; // rays a second
    double miss_ns[SYSTEMS];     // a call whose ray misses the root
    double bytes, compact_bytes; // a triangle
    double to_metres;            // speed of segments and sight in centimetres
} result;

typedef struct scenes {
    tl_soup *soup, *compact;
    RTCScene embree[SYSTEMS];
} scenes;

static answer run_system(const scenes *s, uint32_t system, const query *queries, uint32_t count, uint32_t kind)
{
    switch (system) {
    case TALUS:
        return run_talus(NULL, s->soup, queries, count, kind);
    case TALUS_AVX2:
        return run_talus(tl_ray_walk_for(TL_RAY_AVX2), s->soup, queries, count, kind);
    case TALUS_AVX512:
        return run_talus(tl_ray_walk_for(TL_RAY_AVX512), s->soup, queries, count, kind);
    case COMPACT:
        return run_talus(NULL, s->compact, queries, count, kind);
    default:
        return run_embree(s->embree[system], queries, count, kind);
    }
}

// One run over all queries; the seconds of each slice that were less than ever go to `best`.
static answer run_slices(const scenes *s, uint32_t system, const query *queries, uint32_t count, uint32_t kind,
                         double *best)
{
    answer sum = { 0, 0 };
    for (uint32_t first = 0, slice = 0; first < count; first += SLICE_RAYS, slice++) {
        uint32_t rest = count - first < SLICE_RAYS ? count - first : SLICE_RAYS;
        double start = bench_wall_seconds();
        answer a = run_system(s, system, queries + first, rest, kind);
        double t = bench_wall_seconds() - start;
        best[slice] = t < best[slice] ? t : best[slice];
        sum.hits += a.hits;
        sum.t_sum += a.t_sum;
    }
    return sum;
}

// Best seconds of each system for all queries.
static void time_systems(const scenes *s, const query *queries, uint32_t count, uint32_t kind, uint32_t repetitions,
                         double best[SYSTEMS], answer answers[SYSTEMS])
{
    static double slices[SYSTEMS][MAX_SLICES], warm[MAX_SLICES];
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        for (uint32_t i = 0; i < MAX_SLICES; i++) {
            slices[system][i] = 1e30;
        }
    }
    for (uint32_t repetition = 0; repetition < repetitions; repetition++) {
        for (uint32_t place = 0; place < SYSTEMS; place++) {
            uint32_t turn = repetition % 2 == 0 ? place : SYSTEMS - 1 - place, system = (turn + repetition) % SYSTEMS;
            // Once to have its own data in the caches, not its neighbour's.
            (void)run_slices(s, system, queries, count, kind, warm);
            answers[system] = run_slices(s, system, queries, count, kind, slices[system]);
        }
    }
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        best[system] = 0;
        for (uint32_t i = 0; i * SLICE_RAYS < count; i++) {
            best[system] += slices[system][i];
        }
    }
}

static tl_soup *build_soup(const tl_mesh_view *view, tl_soup_layout layout, float split_budget)
{
    tl_soup_def def = tl_default_soup_def();
    def.layout = layout;
    def.split_budget = split_budget;
    tl_soup *soup = NULL;
    tl_result code = tl_soup_bake(view, &def, &soup, NULL);
    if (code != TL_OK) {
        fprintf(stderr, "%s\n", tl_result_text(code));
        exit(1);
    }
    return soup;
}

// A copy in memory of malloc's, which free takes back; large ones in huge pages, where the system has them to give.
static tl_soup *lay_out(tl_soup *soup)
{
    enum { HUGE_PAGE = 2 << 20 };
    size_t size = (size_t)tl_soup_size(soup), unit = size < HUGE_PAGE ? TL_BLOB_ALIGNMENT : HUGE_PAGE;
    size_t room = (size + unit - 1) / unit * unit;
    tl_soup *copy = aligned_alloc(unit, room);
    if (copy == NULL) {
        fprintf(stderr, "%s\n", tl_result_text(TL_ERR_MEMORY));
        exit(1);
    }
    (void)madvise(copy, room, MADV_HUGEPAGE);
    memcpy(copy, soup, size);
    tl_blob_free(soup);
    return copy;
}

static void build_level(RTCDevice device, const bench_level *l, scenes *s, result *r)
{
    s->soup = lay_out(build_soup(&l->view, TL_SOUP_FAST, 0.0f));
    s->compact = lay_out(build_soup(&l->view, TL_SOUP_COMPACT, 0.0f));
    tl_soup *split = build_soup(&l->view, TL_SOUP_FAST, 0.1f);
    embree_bytes = 0;
    s->embree[FAST] = bench_embree_triangles(device, &l->view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
    double high_bytes = embree_bytes;
    s->embree[QUADS] = make_quads(device, s->soup);
    s->embree[ROBUST] = bench_embree_triangles(device, &l->view, RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH);
    tl_soup_stats stats = tl_soup_get_stats(s->soup);
    double n = (double)stats.triangle_count;
    r->bytes = (double)stats.size / n;
    r->compact_bytes = (double)tl_soup_size(s->compact) / n;
    printf(
        "%-20s %7u triangles, %.1f%% paired, leaf fill %.2f, node fill %.1f, %.1f bytes a triangle (with splits %.1f, "
        "Embree %.1f)\n",
        l->name, stats.triangle_count, 200.0 * (double)stats.pair_count / n,
        (double)stats.reference_count / (double)stats.leaf_count,
        (double)(stats.node_count + stats.leaf_count - 1) / (double)stats.node_count, r->bytes,
        (double)tl_soup_size(split) / n, high_bytes / n);
    tl_blob_free(split);
}

// Speed in centimetres as a share of that in metres.
static double time_centimetres(const bench_level *l, const scenes *metres, query *queries, uint32_t count,
                               uint32_t kind, uint32_t repetitions)
{
    static double slices[2][MAX_SLICES];
    tl_mesh_view view = l->view;
    tl_vec3 *scaled = malloc(view.vertex_count * sizeof *scaled);
    query *long_queries = malloc(count * sizeof *long_queries);
    for (uint32_t i = 0; i < view.vertex_count; i++) {
        scaled[i] = tl_scale(view.vertices[i], 100);
    }
    view.vertices = scaled;
    scenes centimetres = { .soup = lay_out(build_soup(&view, TL_SOUP_FAST, 0.0f)) };
    make_queries(queries, count, kind, tl_soup_bounds(metres->soup));
    for (uint32_t i = 0; i < count; i++) {
        query q = { tl_scale(queries[i].origin, 100), tl_scale(queries[i].target, 100), queries[i].tmax };
        long_queries[i] = q;
    }
    for (uint32_t i = 0; i < MAX_SLICES; i++) {
        slices[0][i] = slices[1][i] = 1e30;
    }
    for (uint32_t i = 0; i < 4 * repetitions; i++) { // each twice in turn: once to fill the caches
        bool second = i / 2 % 2 != 0;
        (void)run_slices(second ? &centimetres : metres, TALUS, second ? long_queries : queries, count, kind,
                         slices[second]);
    }
    double seconds[2] = { 0, 0 };
    for (uint32_t i = 0; i * SLICE_RAYS < count; i++) {
        seconds[0] += slices[0][i];
        seconds[1] += slices[1][i];
    }
    free(centimetres.soup);
    free(scaled);
    free(long_queries);
    return seconds[0] / seconds[1];
}

static void run_level(RTCDevice device, const bench_level *l, uint32_t repetitions, uint32_t ray_count,
                      bench_report *report, result *r)
{
    scenes s;
    build_level(device, l, &s, r);
    query *queries = malloc(ray_count * sizeof *queries);
    double best[SYSTEMS];
    answer a[SYSTEMS];
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        make_queries(queries, ray_count, kind, tl_soup_bounds(s.soup));
        time_systems(&s, queries, ray_count, kind, repetitions, best, a);
        char chart[64];
        snprintf(chart, sizeof chart, "%s, Mray/s", kind_names[kind]);
        printf("  %-10s", kind_names[kind]);
        for (uint32_t system = 0; system < SYSTEMS; system++) {
            r->rate[kind][system] = (double)ray_count / best[system];
            printf("  %s %6.2f", system_names[system], r->rate[kind][system] * 1e-6);
            bench_report_value(report, chart, system_names[system], l->name, r->rate[kind][system] * 1e-6);
        }
        printf("   hits %.1f%%, fast %+d, robust %+d\n", 100.0 * a[TALUS].hits / ray_count,
               (int)(a[FAST].hits - a[TALUS].hits), (int)(a[ROBUST].hits - a[TALUS].hits));
    }
    // Straight up, from above the level.
    tl_aabb bounds = tl_soup_bounds(s.soup);
    for (uint32_t i = 0; i < ray_count; i++) {
        query q = { bench_point_in(&random_state, bounds),
                    tl_vec3_make(0.1f * tl_random_unit_float(&random_state), 1,
                                 0.1f * tl_random_unit_float(&random_state)),
                    INFINITY };
        q.origin.y = bounds.max.y + 1;
        queries[i] = q;
    }
    time_systems(&s, queries, ray_count, 1, repetitions, best, a);
    printf("  %-10s", "miss, ns");
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        r->miss_ns[system] = 1e9 * best[system] / ray_count;
        printf("  %s %6.1f", system_names[system], r->miss_ns[system]);
    }
    double sight = time_centimetres(l, &s, queries, ray_count, 2, repetitions);
    double segment = time_centimetres(l, &s, queries, ray_count, 3, repetitions);
    printf("\n  in centimetres: sight %.2f, segment %.2f times as fast as in metres\n", sight, segment);
    r->to_metres = sqrt(sight * segment);
    fflush(stdout);
    free(queries);
    rtcReleaseScene(s.embree[FAST]);
    rtcReleaseScene(s.embree[QUADS]);
    rtcReleaseScene(s.embree[ROBUST]);
    free(s.soup);
    free(s.compact);
}

// ----------------------------------------------------------------------------------------------------- claims

static double fast_rate(const result *r, uint32_t kind)
{
    double fast = r->rate[kind][FAST], quads = r->rate[kind][QUADS];
    return fast > quads ? fast : quads;
}

static double mean_to_fast(const result *results, uint32_t count, uint32_t kind, uint32_t system)
{
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum += log(results[i].rate[kind][system] / fast_rate(&results[i], kind));
    }
    return exp(sum / count);
}

static void claim_rates(bench_report *report, const result *results, uint32_t count)
{
    static const double to_robust[KINDS] = { 1.5, 1.35, 1.35, 1.25, 1.5 };
    static const double to_fast[KINDS] = { 1.2, 1.05, 1.1, 1.0, 1.15 };
    static const double avx2_to_fast[KINDS] = { 1.0, 0.95, 1.0, 0.95, 0.95 };
    char text[96];
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        double robust = 0;
        for (uint32_t i = 0; i < count; i++) {
            robust += log(results[i].rate[kind][TALUS] / results[i].rate[kind][ROBUST]);
        }
        bench_report_speed(report, kind_names[kind], "Embree robust", exp(robust / count), to_robust[kind]);
    }
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        bench_report_speed(report, kind_names[kind], "Embree fast", mean_to_fast(results, count, kind, TALUS),
                           to_fast[kind]);
    }
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        snprintf(text, sizeof text, "%s with AVX2", kind_names[kind]);
        bench_report_speed(report, text, "Embree fast", mean_to_fast(results, count, kind, TALUS_AVX2),
                           avx2_to_fast[kind]);
    }
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        snprintf(text, sizeof text, "%s, compact", kind_names[kind]);
        bench_report_speed(report, text, "Embree fast", mean_to_fast(results, count, kind, COMPACT), 0.7);
    }
}

static void claim_others(bench_report *report, const result *results, uint32_t count)
{
    double worst = 1e30, miss = 0, bytes = 0, compact = 0, to_metres = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t kind = 0; kind < KINDS; kind++) {
            double ratio = results[i].rate[kind][TALUS] / fast_rate(&results[i], kind);
            worst = ratio < worst ? ratio : worst;
        }
        miss += log(results[i].miss_ns[TALUS]);
        to_metres += log(results[i].to_metres);
        bytes = results[i].bytes > bytes ? results[i].bytes : bytes;
        compact = results[i].compact_bytes > compact ? results[i].compact_bytes : compact;
    }
    bench_report_speed(report, "worst level and kind", "Embree fast", worst, 0.95);
    bench_report_speed(report, "segment and sight in centimetres", "in metres", exp(to_metres / count), 0.97);
    bench_report_at_most(report, "a call that misses the root, ns", exp(miss / count), 14);
    bench_report_at_most(report, "max bytes a triangle", bytes, 40);
    bench_report_at_most(report, "max bytes a triangle, compact", compact, 20);
}

int main(int argc, char **argv)
{
    uint32_t repetitions = 5, ray_count = 20000;
    const char *only = NULL;
    const bench_option options[] = { { "repetitions", BENCH_COUNT, &repetitions, "of which the best counts" },
                                     { "rays", BENCH_COUNT, &ray_count, "rays of each kind" },
                                     { "only", BENCH_TEXT, &only, "levels whose name holds this" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    ray_count = ray_count < SLICE_RAYS * MAX_SLICES ? ray_count : SLICE_RAYS * MAX_SLICES;
    bench_report *report = bench_report_new("rays", "Mray/s", NULL);
    RTCDevice device = rtcNewDevice("threads=1");
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, NULL);
    static bench_level levels[BENCH_MAX_LEVELS];
    static result results[BENCH_MAX_LEVELS];
    uint32_t count = bench_load_levels(levels, only);
    for (uint32_t i = 0; i < count; i++) {
        run_level(device, &levels[i], repetitions, ray_count, report, &results[i]);
    }
    bench_free_levels(levels, count);
    if (count > 0) {
        claim_rates(report, results, count);
        claim_others(report, results, count);
    }
    bench_report_print_claims(report);
    rtcReleaseDevice(device);
    return bench_report_close(report, json);
}
