// SPDX-License-Identifier: MIT
//
// Batches of rays against Embree 3's packets of sixteen, in one process, on one thread: a camera's rays in tiles of
// four by four, lines from what it sees to one light, rays in no order, and lines of sight in no order. Both are given
// the same rays in the same order, write them in their own form as a part of the measured time (talus an array, Embree
// sixteen at a time), and read all answers. Camera and light are told to Embree as coherent; talus is told nothing.
// Systems take turns; of each slice of rays the best run counts. Claims are times as fast as Embree, geometric means
// over levels.
//
//   bench_batches [--repetitions N (5)] [--rays N (16384)] [--only NAME] [--json FILE] [FILE ...]
//
// Files are levels to measure instead of those of TALUS_DATA_DIR. Pin it to a core (taskset -c 1) and keep the machine
// quiet.

#include "base/random.h"
#include "bench_options.h"
#include "embree_scene.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/soup.h>

enum { CAMERA, LIGHT, INCOHERENT, SIGHT, KINDS };
enum { TALUS, ROBUST, FAST, SYSTEMS };
enum { PACKET = 16, TILE = 4, CAMERAS = 4, SLICE = 2048, MAX_SLICES = 4096, MAX_FILES = 64 };

static const char *const kind_names[KINDS] = { "camera", "light", "incoherent", "sight" };
static const char *const system_names[SYSTEMS] = { "talus", "Embree robust", "Embree fast" };

static uint64_t random_state = 1;

// A ray, or of light and sight a segment.
typedef struct query {
    tl_vec3 origin, target; // direction, or end
} query;

static bool is_closest(uint32_t kind)
{
    return kind == CAMERA || kind == INCOHERENT;
}

// ---------------------------------------------------------------------------------------------------- queries

// Cameras at random places look at random places, tile by tile.
static void make_camera(query *queries, uint32_t count, tl_aabb inner)
{
    uint32_t side = (uint32_t)sqrt((double)count / CAMERAS) / TILE * TILE;
    side = side < TILE ? TILE : side;
    tl_vec3 eye = inner.min, forward = eye, right = eye, up = eye;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t pixel = i % (side * side), tile = pixel / (TILE * TILE), within = pixel % (TILE * TILE);
        if (pixel == 0) {
            eye = bench_point_in(&random_state, inner);
            forward = tl_normalize(tl_sub(bench_point_in(&random_state, inner), eye));
            right = tl_normalize(tl_cross(forward, tl_vec3_make(0.01f, 1, 0.02f)));
            up = tl_cross(right, forward);
        }
        uint32_t column = tile % (side / TILE) * TILE + within % TILE,
                 row = tile / (side / TILE) * TILE + within / TILE;
        float x = 2 * ((float)column + 0.5f) / (float)side - 1, y = 2 * ((float)row + 0.5f) / (float)side - 1;
        queries[i].origin = eye;
        queries[i].target = tl_normalize(tl_mul_add(tl_mul_add(forward, right, 0.7f * x), up, 0.7f * y));
    }
}

// From where a camera's rays end, a little in front of the surface, to one light.
static void light_up(const tl_soup *soup, query *queries, uint32_t count, tl_aabb inner)
{
    tl_vec3 light = bench_point_in(&random_state, inner);
    for (uint32_t i = 0; i < count; i++) {
        tl_ray ray = { queries[i].origin, queries[i].target, INFINITY };
        tl_ray_hit hit;
        float t = tl_soup_cast_ray(soup, &ray, NULL, &hit) ? 0.999f * hit.t : 1.0f;
        queries[i].origin = tl_mul_add(ray.origin, ray.direction, t);
        queries[i].target = light;
    }
}

static void make_queries(const tl_soup *soup, query *queries, uint32_t count, uint32_t kind)
{
    tl_aabb bounds = tl_soup_bounds(soup);
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.05f);
    tl_aabb inner = { tl_add(bounds.min, margin), tl_sub(bounds.max, margin) };
    random_state = kind == LIGHT ? CAMERA + 1 : kind + 1;
    if (kind == CAMERA || kind == LIGHT) {
        make_camera(queries, count, inner);
    }
    if (kind == LIGHT) {
        light_up(soup, queries, count, inner);
    }
    for (uint32_t i = 0; i < count && (kind == INCOHERENT || kind == SIGHT); i++) {
        queries[i].origin = bench_point_in(&random_state, inner);
        queries[i].target = kind == SIGHT ? bench_point_in(&random_state, inner) : bench_direction(&random_state);
    }
}

// ---------------------------------------------------------------------------------------------------- systems

typedef struct answer {
    uint32_t hits;
    double t_sum;
} answer;

static answer run_closest(const tl_soup *soup, const query *queries, uint32_t count)
{
    static tl_ray rays[SLICE];
    static tl_ray_hit hits[SLICE];
    for (uint32_t i = 0; i < count; i++) {
        tl_ray ray = { queries[i].origin, queries[i].target, INFINITY };
        rays[i] = ray;
    }
    tl_soup_cast_rays(soup, rays, count, NULL, NULL, hits);
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        bool hit = hits[i].triangle != TL_NO_TRIANGLE;
        a.hits += hit;
        a.t_sum += hit ? (double)hits[i].t : 0;
    }
    return a;
}

static answer run_sight(const tl_soup *soup, const query *queries, uint32_t count)
{
    static tl_segment segments[SLICE];
    static bool clear[SLICE];
    for (uint32_t i = 0; i < count; i++) {
        tl_segment segment = { queries[i].origin, queries[i].target };
        segments[i] = segment;
    }
    tl_soup_lines_of_sight(soup, segments, count, NULL, NULL, clear);
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        a.hits += !clear[i];
    }
    return a;
}

static void write_packet(struct RTCRayHit16 *packet, const query *queries, bool closest)
{
    for (uint32_t i = 0; i < PACKET; i++) {
        tl_vec3 o = queries[i].origin, d = closest ? queries[i].target : tl_sub(queries[i].target, o);
        packet->ray.org_x[i] = o.x;
        packet->ray.org_y[i] = o.y;
        packet->ray.org_z[i] = o.z;
        packet->ray.dir_x[i] = d.x;
        packet->ray.dir_y[i] = d.y;
        packet->ray.dir_z[i] = d.z;
        packet->ray.tnear[i] = 0;
        packet->ray.tfar[i] = closest ? INFINITY : 1;
        packet->ray.time[i] = 0;
        packet->ray.mask[i] = UINT32_MAX;
        packet->ray.id[i] = 0;
        packet->ray.flags[i] = 0;
        packet->hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
}

static answer run_embree(RTCScene scene, const query *queries, uint32_t count, uint32_t kind)
{
    answer a = { 0, 0 };
    bool closest = is_closest(kind);
    static const int valid[PACKET] = { -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1 };
    for (uint32_t first = 0; first + PACKET <= count; first += PACKET) {
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags =
            kind == CAMERA || kind == LIGHT ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_NONE;
        _Alignas(64) struct RTCRayHit16 packet;
        write_packet(&packet, queries + first, closest);
        if (closest) {
            rtcIntersect16(valid, scene, &context, &packet);
        } else {
            rtcOccluded16(valid, scene, &context, &packet.ray);
        }
        for (uint32_t i = 0; i < PACKET; i++) {
            bool hit = closest ? packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID : packet.ray.tfar[i] < 0;
            a.hits += hit;
            a.t_sum += hit && closest ? (double)packet.ray.tfar[i] : 0;
        }
    }
    return a;
}

// ------------------------------------------------------------------------------------------------------- runs

typedef struct systems {
    tl_soup *soup;
    RTCScene embree[SYSTEMS];
} systems;

// One run over all queries; the seconds of each slice that were less than ever go to `best`.
static answer run_slices(const systems *s, uint32_t system, const query *queries, uint32_t count, uint32_t kind,
                         double *best)
{
    answer sum = { 0, 0 };
    for (uint32_t first = 0, slice = 0; first < count; first += SLICE, slice++) {
        uint32_t rest = count - first < SLICE ? count - first : SLICE;
        double start = bench_wall_seconds();
        answer a = system != TALUS    ? run_embree(s->embree[system], queries + first, rest, kind)
                   : is_closest(kind) ? run_closest(s->soup, queries + first, rest)
                                      : run_sight(s->soup, queries + first, rest);
        double t = bench_wall_seconds() - start;
        best[slice] = t < best[slice] ? t : best[slice];
        sum.hits += a.hits;
        sum.t_sum += a.t_sum;
    }
    return sum;
}

static void time_systems(const systems *s, const query *queries, uint32_t count, uint32_t kind, uint32_t repetitions,
                         double rates[SYSTEMS], answer answers[SYSTEMS])
{
    static double best[SYSTEMS][MAX_SLICES];
    for (uint32_t i = 0; i < SYSTEMS * MAX_SLICES; i++) {
        best[i / MAX_SLICES][i % MAX_SLICES] = 1e30;
    }
    for (uint32_t repetition = 0; repetition < 2 * repetitions;
         repetition++) { // each twice in turn, to fill the caches
        for (uint32_t place = 0; place < SYSTEMS; place++) {
            uint32_t system = (repetition / 2 + place) % SYSTEMS;
            (void)run_slices(s, system, queries, count, kind, best[system]);
            answers[system] = run_slices(s, system, queries, count, kind, best[system]);
        }
    }
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        double seconds = 0;
        for (uint32_t i = 0; i * SLICE < count; i++) {
            seconds += best[system][i];
        }
        rates[system] = 1e-6 * count / seconds;
    }
}

typedef struct result {
    double rates[KINDS][SYSTEMS]; // million rays a second
} result;

static void run_level(RTCDevice device, const bench_level *level, uint32_t repetitions, uint32_t count,
                      bench_report *report, result *r)
{
    systems s;
    if (tl_soup_bake(&level->view, NULL, &s.soup, NULL) != TL_OK) {
        fprintf(stderr, "%s: not baked\n", level->name);
        exit(1);
    }
    s.embree[ROBUST] = bench_embree_triangles(device, &level->view, RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH);
    s.embree[FAST] = bench_embree_triangles(device, &level->view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
    printf("%s: %u triangles\n", level->name, level->view.triangle_count);
    query *queries = malloc(count * sizeof *queries);
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        answer answers[SYSTEMS];
        make_queries(s.soup, queries, count, kind);
        time_systems(&s, queries, count, kind, repetitions, r->rates[kind], answers);
        printf("  %-10s", kind_names[kind]);
        for (uint32_t system = 0; system < SYSTEMS; system++) {
            printf("  %s %6.2f", system_names[system], r->rates[kind][system]);
            bench_report_value(report, kind_names[kind], system_names[system], level->name, r->rates[kind][system]);
        }
        printf("   to robust %.2f, fast %.2f; hits %.1f%%, robust %+d, fast %+d\n",
               r->rates[kind][TALUS] / r->rates[kind][ROBUST], r->rates[kind][TALUS] / r->rates[kind][FAST],
               100.0 * answers[TALUS].hits / count, (int)(answers[ROBUST].hits - answers[TALUS].hits),
               (int)(answers[FAST].hits - answers[TALUS].hits));
    }
    fflush(stdout);
    free(queries);
    rtcReleaseScene(s.embree[ROBUST]);
    rtcReleaseScene(s.embree[FAST]);
    tl_blob_free(s.soup);
}

static void claim(bench_report *report, const result *results, uint32_t count)
{
    static const double bars[SYSTEMS][KINDS] = { [ROBUST] = { 1.2, 1.2, 1.2, 1.2 }, [FAST] = { 1.0, 1.0, 1.2, 1.2 } };
    for (uint32_t peer = ROBUST; peer < SYSTEMS; peer++) {
        for (uint32_t kind = 0; kind < KINDS; kind++) {
            double sum = 0, worst = 1e30;
            for (uint32_t i = 0; i < count; i++) {
                double ratio = results[i].rates[kind][TALUS] / results[i].rates[kind][peer];
                sum += log(ratio);
                worst = ratio < worst ? ratio : worst;
            }
            char text[96];
            snprintf(text, sizeof text, "%s (worst level %.2f)", kind_names[kind], worst);
            bench_report_speed(report, text, system_names[peer], exp(sum / count), bars[peer][kind]);
        }
    }
}

int main(int argc, char **argv)
{
    uint32_t repetitions = 5, ray_count = 16384;
    const char *only = NULL, *json = NULL;
    const bench_option options[] = { { "repetitions", BENCH_COUNT, &repetitions, "of which the best counts" },
                                     { "rays", BENCH_COUNT, &ray_count, "rays of each kind" },
                                     { "only", BENCH_TEXT, &only, "levels whose name holds this" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char **files = malloc((size_t)argc * sizeof *files);
    uint32_t file_count = (uint32_t)bench_parse(argc, argv, options, files, &json);
    ray_count = ray_count / PACKET * PACKET;
    ray_count = ray_count < SLICE * MAX_SLICES ? ray_count : SLICE * MAX_SLICES;
    bench_report *report = bench_report_new("batches", "Mray/s", NULL);
    RTCDevice device = rtcNewDevice("threads=1");
    static bench_level levels[MAX_FILES];
    static result results[MAX_FILES];
    uint32_t count = file_count == 0 ? bench_load_levels(levels, only) : 0;
    for (uint32_t i = 0; i < file_count && count < MAX_FILES; i++) {
        count += bench_load_file(files[i], &levels[count]);
    }
    for (uint32_t i = 0; i < count; i++) {
        run_level(device, &levels[i], repetitions, ray_count, report, &results[i]);
    }
    bench_free_levels(levels, count);
    if (count > 0) {
        claim(report, results, count);
    }
    bench_report_print_claims(report);
    rtcReleaseDevice(device);
    free(files);
    return bench_report_close(report, json);
}
