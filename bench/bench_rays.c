// SPDX-License-Identifier: MIT
//
// Rays against Embree 3, in one process, one ray a call, on one thread: the levels of TALUS_DATA_DIR and generated
// ones. Each repetition runs every system on the same rays in turn; the best repetition counts. Rows are million rays a
// second, the last table ratios to Embree (fast, triangles, quality HIGH), geometric mean over levels.
//
//   bench_rays [repetitions [rays [only]]]
//
// `only` is a part of a level's name. Pin it to a core (taskset -c 1) and keep the machine quiet.

#define _POSIX_C_SOURCE 200809L

#include "cli/sample_level.h"
#include "soup/ray.h"

#include <embree3/rtcore.h>
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { KINDS = 5, SYSTEMS = 5, MAX_LEVELS = 32 };

static const char *const kind_names[KINDS] = { "camera", "incoherent", "sight", "segment", "down" };
static const char *const system_names[SYSTEMS] = { "talus", "avx512", "fast", "quads", "robust" };

typedef struct level {
    char name[64];
    tl_vec3 *vertices;
    uint32_t vertex_count;
    uint32_t *indices;
    uint32_t triangle_count;
} level;

typedef struct query {
    tl_vec3 origin, target; // target: direction, or end for sight and segment
    float tmax;
} query;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t random_state = 1;

static float unit(void)
{
    uint64_t z = (random_state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (float)((z ^ (z >> 31)) >> 40) * (1.0f / 16777216.0f);
}

static tl_vec3 point_in(tl_aabb box)
{
    tl_vec3 size = tl_aabb_size(box);
    float x = unit(), y = unit(), z = unit();
    return tl_vec3_make(box.min.x + x * size.x, box.min.y + y * size.y, box.min.z + z * size.z);
}

static tl_vec3 direction(void)
{
    for (;;) {
        tl_vec3 d = tl_vec3_make(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
        float l = tl_length_sq(d);
        if (l > 0.01f && l <= 1) {
            return tl_normalize(d);
        }
    }
}

// ----------------------------------------------------------------------------------------------------- levels

static bool load_obj(const char *path, level *l)
{
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return false;
    }
    char line[512];
    uint32_t vertex_room = 0, index_room = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        tl_vec3 v;
        unsigned a, b, c;
        if (sscanf(line, "v %f %f %f", &v.x, &v.y, &v.z) == 3) {
            if (l->vertex_count == vertex_room) {
                vertex_room = vertex_room * 2 + 1024;
                l->vertices = realloc(l->vertices, vertex_room * sizeof *l->vertices);
            }
            l->vertices[l->vertex_count++] = v;
        } else if (sscanf(line, "f %u %u %u", &a, &b, &c) == 3) {
            if (l->triangle_count == index_room) {
                index_room = index_room * 2 + 1024;
                l->indices = realloc(l->indices, (size_t)index_room * 3 * sizeof *l->indices);
            }
            uint32_t *index = l->indices + 3 * (size_t)l->triangle_count++;
            index[0] = a - 1;
            index[1] = b - 1;
            index[2] = c - 1;
        }
    }
    fclose(file);
    return l->triangle_count > 0;
}

static uint32_t load_levels(level *levels, const char *only)
{
    static const char *const files[] = { "levels/nav_test.obj",    "levels/dungeon.obj",        "levels/undulating.obj",
                                         "levels/proto-level.obj", "models/stanford-bunny.obj", "models/rocker-arm.obj",
                                         "models/fandisk.obj" };
    static const struct {
        const char *name;
        uint32_t triangles;
    } samples[] = { { "dungeon", 50000 }, { "city", 100000 }, { "terrain", 100000 }, { "city", 1000000 } };
    uint32_t count = 0;
    for (uint32_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        level *l = &levels[count];
        memset(l, 0, sizeof *l);
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", TALUS_DATA_DIR, files[i]);
        snprintf(l->name, sizeof l->name, "%s", strchr(files[i], '/') + 1);
        *strchr(l->name, '.') = 0;
        count += (only == NULL || strstr(l->name, only) != NULL) && load_obj(path, l);
    }
    for (uint32_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        level *l = &levels[count];
        memset(l, 0, sizeof *l);
        snprintf(l->name, sizeof l->name, "sample %s %uk", samples[i].name, samples[i].triangles / 1000);
        if (only != NULL && strstr(l->name, only) == NULL) {
            continue;
        }
        tl_sample_mesh mesh;
        if (tl_sample_build_level(tl_sample_find_level(samples[i].name), samples[i].triangles, 1, &mesh) == TL_OK) {
            tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
            l->vertex_count = view.vertex_count;
            l->triangle_count = view.triangle_count;
            l->vertices = malloc(view.vertex_count * sizeof *l->vertices);
            l->indices = malloc((size_t)view.triangle_count * 3 * sizeof *l->indices);
            memcpy(l->vertices, view.vertices, view.vertex_count * sizeof *l->vertices);
            memcpy(l->indices, view.indices, (size_t)view.triangle_count * 3 * sizeof *l->indices);
            count++;
        }
        tl_sample_mesh_free(&mesh);
    }
    return count;
}

// ---------------------------------------------------------------------------------------------------- queries

// Four cameras at random places look at random places, scanline by scanline.
static void make_camera(query *queries, uint32_t count, tl_aabb inner)
{
    uint32_t per_camera = count / 4, width = 1;
    while ((width + 1) * (width + 1) <= per_camera) {
        width++;
    }
    for (uint32_t i = 0, camera = 0; i < count; camera++) {
        tl_vec3 eye = point_in(inner);
        tl_vec3 forward = tl_normalize(tl_sub(point_in(inner), eye));
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
        query q = { point_in(inner), direction(), INFINITY };
        if (kind == 2) {
            q.target = point_in(inner);
        } else if (kind == 3) {
            q.target = tl_mul_add(q.origin, q.target, diagonal * (0.02f + 0.1f * unit()));
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
            tl_ray ray = { q->origin, q->target, q->tmax };
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
        ray.ray.org_x = q->origin.x;
        ray.ray.org_y = q->origin.y;
        ray.ray.org_z = q->origin.z;
        ray.ray.dir_x = d.x;
        ray.ray.dir_y = d.y;
        ray.ray.dir_z = d.z;
        ray.ray.tnear = 0;
        ray.ray.tfar = segment ? 1 : q->tmax;
        ray.ray.time = 0;
        ray.ray.mask = UINT32_MAX;
        ray.ray.id = 0;
        ray.ray.flags = 0;
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
static RTCScene make_scene(RTCDevice device, const level *l, const tl_soup *soup, bool quads, enum RTCSceneFlags flags,
                           enum RTCBuildQuality quality)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, quality);
    RTCGeometry geometry = rtcNewGeometry(device, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    if (quads) {
        tl_soup_stats stats = tl_soup_get_stats(soup);
        uint32_t count = stats.pair_count + stats.single_count;
        float *v =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4 * (size_t)count);
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
    } else {
        float *v = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, l->vertex_count);
        uint32_t *f =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, l->triangle_count);
        memcpy(v, l->vertices, 12 * (size_t)l->vertex_count);
        memcpy(f, l->indices, 12 * (size_t)l->triangle_count);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

// ------------------------------------------------------------------------------------------------------- runs

static double log_ratio[KINDS][SYSTEMS];
static uint32_t ratio_count;

static void bench_level(RTCDevice device, const level *l, uint32_t repetitions, uint32_t ray_count)
{
    tl_mesh_view view = { l->vertices, l->vertex_count, l->indices, l->triangle_count, NULL };
    tl_soup *soup = NULL;
    double t0 = now();
    tl_result result = tl_soup_build(&view, NULL, &soup, NULL);
    double ours = now() - t0;
    if (result != TL_OK) {
        printf("%s: %s\n", l->name, tl_result_text(result));
        return;
    }
    enum RTCBuildQuality high = RTC_BUILD_QUALITY_HIGH, medium = RTC_BUILD_QUALITY_MEDIUM;
    t0 = now();
    rtcReleaseScene(make_scene(device, l, soup, false, RTC_SCENE_FLAG_NONE, medium));
    double embree_medium = now() - t0;
    embree_bytes = 0;
    t0 = now();
    RTCScene fast = make_scene(device, l, soup, false, RTC_SCENE_FLAG_NONE, high);
    double embree_high = now() - t0;
    double fast_bytes = embree_bytes;
    RTCScene quads = make_scene(device, l, soup, true, RTC_SCENE_FLAG_NONE, high);
    RTCScene robust = make_scene(device, l, soup, false, RTC_SCENE_FLAG_ROBUST, high);
    tl_soup_stats stats = tl_soup_get_stats(soup);
    double n = (double)stats.triangle_count;
    printf("%-20s %7u triangles, %.1f%% paired, %.2f references a pair, leaf fill %.2f, %.1f bytes a triangle (Embree "
           "%.1f); build %.2f us a triangle (Embree medium %.2f, high %.2f)\n",
           l->name, stats.triangle_count, 200.0 * (double)stats.pair_count / n,
           (double)stats.reference_count / (double)(stats.pair_count + stats.single_count),
           (double)stats.reference_count / (double)stats.leaf_count, (double)stats.size / n, fast_bytes / n,
           1e6 * ours / n, 1e6 * embree_medium / n, 1e6 * embree_high / n);
    query *queries = malloc(ray_count * sizeof *queries);
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        make_queries(queries, ray_count, kind, tl_soup_bounds(soup));
        double best[SYSTEMS];
        answer a[SYSTEMS];
        for (uint32_t s = 0; s < SYSTEMS; s++) {
            best[s] = 1e30;
        }
        for (uint32_t repetition = 0; repetition < repetitions; repetition++) {
            for (uint32_t s = 0; s < SYSTEMS; s++) {
                t0 = now();
                a[s] = s == 0   ? run_talus(NULL, soup, queries, ray_count, kind)
                       : s == 1 ? run_talus(tl_ray_walk_for(TL_RAY_AVX512), soup, queries, ray_count, kind)
                                : run_embree(s == 2   ? fast
                                             : s == 3 ? quads
                                                      : robust,
                                             queries, ray_count, kind);
                double t = now() - t0;
                best[s] = t < best[s] ? t : best[s];
            }
        }
        printf("  %-10s", kind_names[kind]);
        for (uint32_t s = 0; s < SYSTEMS; s++) {
            printf("  %s %6.2f", system_names[s], (double)ray_count / best[s] * 1e-6);
            log_ratio[kind][s] += log(best[2] / best[s]);
        }
        printf("   hits %.1f%%, fast %+d, robust %+d\n", 100.0 * a[0].hits / ray_count, (int)(a[2].hits - a[0].hits),
               (int)(a[4].hits - a[0].hits));
    }
    fflush(stdout);
    ratio_count++;
    free(queries);
    rtcReleaseScene(fast);
    rtcReleaseScene(quads);
    rtcReleaseScene(robust);
    tl_blob_free(soup, NULL);
}

int main(int argc, char **argv)
{
    uint32_t repetitions = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 5;
    uint32_t ray_count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 20000;
    RTCDevice device = rtcNewDevice("threads=1");
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, NULL);
    static level levels[MAX_LEVELS];
    uint32_t count = load_levels(levels, argc > 3 ? argv[3] : NULL);
    for (uint32_t i = 0; i < count; i++) {
        bench_level(device, &levels[i], repetitions, ray_count);
        free(levels[i].vertices);
        free(levels[i].indices);
    }
    printf("\nratio to Embree fast, geometric mean of %u levels\n%-12s", ratio_count, "");
    for (uint32_t s = 0; s < SYSTEMS; s++) {
        printf("%12s", system_names[s]);
    }
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        printf("\n%-12s", kind_names[kind]);
        for (uint32_t s = 0; s < SYSTEMS; s++) {
            printf("%12.2f", exp(log_ratio[kind][s] / ratio_count));
        }
    }
    printf("\n");
    rtcReleaseDevice(device);
    return 0;
}
