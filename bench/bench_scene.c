// SPDX-License-Identifier: MIT
//
// Scenes against Embree 3's instancing, in one process, one ray a call, on one thread: props, buildings and courtyards
// of 300 to 5,000 triangles, each placed many times at random poses. Each repetition runs every system on the same rays
// in turn, in an order that rotates; of each slice of rays the best run counts. Rows are million rays a second, and
// microseconds for builds and for the step after everything, or a tenth of it, has moved. Claims are ratios to Embree
// robust, whose models are built at quality HIGH; its scene of instances is built at quality LOW for the step, the
// fastest that it has, and at MEDIUM for rays and the build.
//
//   bench_scene [--repetitions N (5)] [--rays N (20000)] [--json FILE]
//
// Pin it to a core (taskset -c 1) and keep the machine quiet.

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
#include <talus/scene.h>

enum { KINDS = 4, SLICE_RAYS = 250, MAX_SLICES = 4096, MODELS = 8, SIZES = 2, MAX_INSTANCES = 10000 };
enum { TALUS, ROBUST, FAST, SYSTEMS };

static const uint32_t sizes[SIZES] = { 1000, 10000 };
static const char *const kind_names[KINDS] = { "camera", "incoherent", "occluded", "sight" };
static const char *const system_names[SYSTEMS] = { "talus", "Embree robust", "Embree fast" };

static uint64_t random_state = 1;

// ---------------------------------------------------------------------------------------------------- models

// A bumpy ball of 2 * rows * rows triangles, one metre wide.
static void make_ball(uint32_t rows, bench_level *level)
{
    uint32_t vertex_count = (rows + 1) * (rows + 1);
    tl_vec3 *vertices = malloc(vertex_count * sizeof *vertices);
    uint32_t *indices = malloc(6 * (size_t)rows * rows * sizeof *indices);
    for (uint32_t i = 0; i < vertex_count; i++) {
        double a = 3.14159265 * (i / (rows + 1)) / rows, b = 6.2831853 * (i % (rows + 1)) / rows;
        double r = 0.5 + 0.03 * sin(7 * a) * cos(5 * b);
        vertices[i] = tl_vec3_make((float)(r * sin(a) * cos(b)), (float)(r * cos(a)), (float)(r * sin(a) * sin(b)));
    }
    uint32_t *at = indices;
    for (uint32_t i = 0; i < rows * rows; i++) {
        uint32_t v = i / rows * (rows + 1) + i % rows;
        const uint32_t quad[6] = { v, v + 1, v + rows + 1, v + 1, v + rows + 2, v + rows + 1 };
        memcpy(at, quad, sizeof quad);
        at += 6;
    }
    tl_mesh_view view = { vertices, vertex_count, indices, 2 * rows * rows, NULL };
    snprintf(level->name, sizeof level->name, "ball %u", view.triangle_count);
    level->view = view;
}

// A generated level, moved to the origin and made so many metres wide.
static void make_small(const char *name, uint32_t triangles, float size, bench_level *level)
{
    if (!bench_make_sample(name, triangles, level)) {
        exit(1);
    }
    tl_vec3 *vertices = (tl_vec3 *)(uintptr_t)level->view.vertices;
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < level->view.vertex_count; i++) {
        box = tl_aabb_add_point(box, vertices[i]);
    }
    tl_vec3 wide = tl_aabb_size(box);
    float scale = size / tl_maxf(wide.x, wide.z);
    for (uint32_t i = 0; i < level->view.vertex_count; i++) {
        vertices[i] = tl_scale(tl_sub(vertices[i], tl_aabb_center(box)), scale);
    }
}

// ---------------------------------------------------------------------------------------------------- systems

typedef struct model {
    bench_level level;
    tl_soup *soup;
    RTCScene embree[SYSTEMS];
} model;

typedef struct world {
    uint32_t count;
    tl_scene_instance instances[MAX_INSTANCES];
    uint32_t models[MAX_INSTANCES];
    tl_scene *scene;
    RTCScene embree[SYSTEMS];
    RTCGeometry embree_instances[SYSTEMS][MAX_INSTANCES];
} world;

static void set_matrix(RTCGeometry embree_instance, tl_transform pose)
{
    tl_vec3 x = tl_rotate(pose.rotation, tl_vec3_make(1, 0, 0)), y = tl_rotate(pose.rotation, tl_vec3_make(0, 1, 0));
    tl_vec3 z = tl_rotate(pose.rotation, tl_vec3_make(0, 0, 1)), p = pose.position;
    const float columns[12] = { x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, p.x, p.y, p.z };
    rtcSetGeometryTransform(embree_instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(embree_instance);
}

static RTCScene make_scene(RTCDevice device, world *w, const model *models, uint32_t system,
                           enum RTCBuildQuality quality)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, (system == ROBUST ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                                (quality == RTC_BUILD_QUALITY_LOW ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE));
    rtcSetSceneBuildQuality(scene, quality);
    for (uint32_t i = 0; i < w->count; i++) {
        RTCGeometry embree_instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(embree_instance, models[w->models[i]].embree[system]);
        set_matrix(embree_instance, w->instances[i].pose);
        rtcAttachGeometry(scene, embree_instance);
        w->embree_instances[system][i] = embree_instance;
        rtcReleaseGeometry(embree_instance); // the scene holds it
    }
    return scene;
}

// ---------------------------------------------------------------------------------------------------- queries

typedef struct query {
    tl_vec3 origin, target; // target: direction, or end for sight
} query;

typedef struct answer {
    uint32_t hits;
    double t_sum;
} answer;

static void make_queries(query *queries, uint32_t count, uint32_t kind, tl_aabb bounds)
{
    random_state = kind + 1;
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.05f);
    tl_aabb inner = { tl_add(bounds.min, margin), tl_sub(bounds.max, margin) };
    uint32_t width = (uint32_t)sqrt((double)count / 4);
    tl_vec3 eye = inner.min, forward = inner.min, side = inner.min, up = inner.min;
    for (uint32_t i = 0; i < count; i++) {
        query q = { bench_point_in(&random_state, inner), bench_direction(&random_state) };
        if (kind == 0) {
            uint32_t p = i % (width * width);
            if (p == 0) {
                eye = q.origin;
                forward = tl_normalize(tl_sub(bench_point_in(&random_state, inner), eye));
                side = tl_normalize(tl_cross(forward, tl_vec3_make(0.01f, 1, 0.02f)));
                up = tl_cross(side, forward);
            }
            float x = 2 * ((float)(p % width) + 0.5f) / (float)width - 1;
            float y = 2 * ((float)(p / width) + 0.5f) / (float)width - 1;
            q.origin = eye;
            q.target = tl_normalize(tl_mul_add(tl_mul_add(forward, side, 0.7f * x), up, 0.7f * y));
        } else if (kind == 3) {
            q.target = bench_point_in(&random_state, inner);
        }
        queries[i] = q;
    }
}

static answer run_talus(const world *w, const query *queries, uint32_t count, uint32_t kind)
{
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        tl_ray ray = { queries[i].origin, queries[i].target, INFINITY };
        tl_scene_hit hit;
        if (kind == 3) {
            a.hits += !tl_scene_line_of_sight(w->scene, w->instances, ray.origin, ray.direction, NULL);
        } else if (kind == 2) {
            a.hits += tl_scene_occluded(w->scene, w->instances, &ray, NULL);
        } else if (tl_scene_cast_ray(w->scene, w->instances, &ray, NULL, &hit)) {
            a.hits++;
            a.t_sum += (double)hit.hit.t;
        }
    }
    return a;
}

static answer run_embree(RTCScene scene, const query *queries, uint32_t count, uint32_t kind)
{
    answer a = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        tl_vec3 o = queries[i].origin, d = kind == 3 ? tl_sub(queries[i].target, o) : queries[i].target;
        struct RTCRayHit ray;
        ray.ray.org_x = o.x;
        ray.ray.org_y = o.y;
        ray.ray.org_z = o.z;
        ray.ray.dir_x = d.x;
        ray.ray.dir_y = d.y;
        ray.ray.dir_z = d.z;
        ray.ray.tnear = 0;
        ray.ray.tfar = kind == 3 ? 1 : INFINITY;
        ray.ray.time = 0;
        ray.ray.mask = UINT32_MAX;
        ray.ray.id = 0;
        ray.ray.flags = 0;
        if (kind >= 2) {
            rtcOccluded1(scene, &context, &ray.ray);
            a.hits += ray.ray.tfar < 0;
            continue;
        }
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &ray);
        if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            a.hits++;
            a.t_sum += (double)ray.ray.tfar;
        }
    }
    return a;
}

// One run over all queries; the seconds of each slice that were less than ever go to `best`.
static answer run_slices(const world *w, uint32_t system, const query *queries, uint32_t count, uint32_t kind,
                         double *best)
{
    answer sum = { 0, 0 };
    for (uint32_t first = 0, slice = 0; first < count; first += SLICE_RAYS, slice++) {
        uint32_t rest = count - first < SLICE_RAYS ? count - first : SLICE_RAYS;
        double begin = bench_wall_seconds();
        answer a = system == TALUS ? run_talus(w, queries + first, rest, kind)
                                   : run_embree(w->embree[system], queries + first, rest, kind);
        double seconds = bench_wall_seconds() - begin;
        best[slice] = seconds < best[slice] ? seconds : best[slice];
        sum.hits += a.hits;
        sum.t_sum += a.t_sum;
    }
    return sum;
}

static void time_rays(const world *w, const query *queries, uint32_t count, uint32_t kind, uint32_t repetitions,
                      double seconds[SYSTEMS], answer answers[SYSTEMS])
{
    static double best[SYSTEMS][MAX_SLICES];
    uint32_t slices = (count + SLICE_RAYS - 1) / SLICE_RAYS;
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        for (uint32_t i = 0; i < slices; i++) {
            best[system][i] = 1e30;
        }
    }
    for (uint32_t repetition = 0; repetition < 2 * repetitions; repetition++) {
        for (uint32_t k = 0; k < SYSTEMS; k++) {
            uint32_t system = (repetition + k) % SYSTEMS;
            answers[system] = run_slices(w, system, queries, count, kind, best[system]);
        }
    }
    for (uint32_t system = 0; system < SYSTEMS; system++) {
        seconds[system] = 0;
        for (uint32_t i = 0; i < slices; i++) {
            seconds[system] += best[system][i];
        }
    }
}

// ------------------------------------------------------------------------------------------------------ poses

static tl_quat random_rotation(void)
{
    tl_vec3 axis = bench_direction(&random_state);
    float w = 2 * tl_random_unit_float(&random_state) - 1, s = sqrtf(1 - w * w);
    tl_quat q = { axis.x * s, axis.y * s, axis.z * s, w };
    return q;
}

// A town: things stand in a square, and some lie higher.
static void place(world *w, const model *models, uint32_t count)
{
    random_state = count;
    w->count = count;
    float side = 3.0f * sqrtf((float)count);
    tl_aabb area = { tl_vec3_make(0, 0, 0), tl_vec3_make(side, 0.1f * side, side) };
    for (uint32_t i = 0; i < count; i++) {
        uint32_t m = (uint32_t)(tl_random_unit_float(&random_state) * MODELS);
        tl_scene_instance instance = { .soup = models[m].soup, .mask = 1 };
        instance.pose.rotation = random_rotation();
        instance.pose.position = bench_point_in(&random_state, area);
        w->instances[i] = instance;
        w->models[i] = m;
    }
}

// Every `step`th instance goes a bit, and turns.
static void move(world *w, uint32_t step)
{
    for (uint32_t i = 0; i < w->count; i += step) {
        tl_transform *pose = &w->instances[i].pose;
        pose->position = tl_mul_add(pose->position, bench_direction(&random_state), 0.1f);
        tl_quat turn = { 0, 0.05f, 0, 1 };
        pose->rotation = tl_quat_normalize(tl_quat_mul(turn, pose->rotation));
    }
}

typedef struct changes {
    double build, embree_build; // microseconds
    double refit, embree_low;   // after all have moved
    double refit_tenth, embree_tenth;
    double growth;
} changes;

// What the thread has worked: builds are too long to find a run without a disturbance.
static double microseconds(double begin)
{
    return 1e6 * (bench_thread_seconds() - begin);
}

static void step_embree(world *w, RTCScene scene, uint32_t step, double *best)
{
    double begin = bench_thread_seconds();
    for (uint32_t i = 0; i < w->count; i += step) {
        set_matrix(w->embree_instances[ROBUST][i], w->instances[i].pose);
    }
    rtcCommitScene(scene);
    *best = fmin(*best, microseconds(begin));
}

static void step_talus(world *w, double *best, float *growth)
{
    double begin = bench_thread_seconds();
    if (tl_scene_refit(w->scene, w->instances, w->count, growth, NULL) != TL_OK) {
        exit(1);
    }
    *best = fmin(*best, microseconds(begin));
}

static changes time_changes(RTCDevice device, world *w, const model *models, uint32_t repetitions)
{
    changes best = { 1e30, 1e30, 1e30, 1e30, 1e30, 1e30, 0 };
    for (uint32_t r = 0; r < 4 * repetitions; r++) {
        double begin = bench_thread_seconds();
        tl_blob_free(w->scene);
        w->scene = NULL;
        if (tl_scene_bake(w->instances, w->count, NULL, &w->scene, NULL) != TL_OK) {
            exit(1);
        }
        best.build = fmin(best.build, microseconds(begin));
    }
    for (uint32_t r = 0; r < repetitions; r++) {
        RTCScene scene = make_scene(device, w, models, ROBUST, RTC_BUILD_QUALITY_MEDIUM);
        double begin = bench_thread_seconds();
        rtcCommitScene(scene);
        best.embree_build = fmin(best.embree_build, microseconds(begin));
        rtcReleaseScene(scene);
    }
    RTCScene scene = make_scene(device, w, models, ROBUST, RTC_BUILD_QUALITY_LOW);
    rtcCommitScene(scene);
    float growth = 1;
    for (uint32_t r = 0; r < 2 * repetitions; r++) {
        move(w, 1);
        step_talus(w, &best.refit, &growth);
        step_embree(w, scene, 1, &best.embree_low);
        move(w, 10);
        step_embree(w, scene, 10, &best.embree_tenth);
        step_talus(w, &best.refit_tenth, &growth);
    }
    best.growth = (double)growth;
    rtcReleaseScene(scene);
    return best;
}

// ------------------------------------------------------------------------------------------------------- runs

// What every size is run with.
typedef struct bench_setup {
    RTCDevice device;
    const model *models;
    uint32_t repetitions, ray_count;
    bench_report *report;
} bench_setup;

static void run_size(const bench_setup *setup, uint32_t count, double ratios[KINDS], changes *step)
{
    const RTCDevice device = setup->device;
    const model *models = setup->models;
    const uint32_t repetitions = setup->repetitions, ray_count = setup->ray_count;
    static world w;
    char label[32], chart[64];
    snprintf(label, sizeof label, "%u instances", count);
    place(&w, models, count);
    *step = time_changes(device, &w, models, repetitions);
    printf(
        "%s: build %.0f us (Embree medium %.0f), all moved %.1f (low %.0f), a tenth moved %.1f (%.0f), growth %.2f\n",
        label, step->build, step->embree_build, step->refit, step->embree_low, step->refit_tenth, step->embree_tenth,
        step->growth);
    tl_blob_free(w.scene);
    if (tl_scene_bake(w.instances, w.count, NULL, &w.scene, NULL) != TL_OK) {
        exit(1);
    }
    for (uint32_t system = 1; system < SYSTEMS; system++) {
        w.embree[system] = make_scene(device, &w, models, system, RTC_BUILD_QUALITY_MEDIUM);
        rtcCommitScene(w.embree[system]);
    }
    tl_scene_stats stats = tl_scene_get_stats(w.scene);
    printf("  %.0f bytes an instance, %.1f children a node, depth %u, cost %.2f\n", (double)stats.size / count,
           (double)(stats.instance_count + stats.node_count - 1) / stats.node_count, stats.depth, stats.cost);
    query *queries = malloc(ray_count * sizeof *queries);
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        double seconds[SYSTEMS];
        answer a[SYSTEMS];
        make_queries(queries, ray_count, kind, tl_scene_bounds(w.scene));
        time_rays(&w, queries, ray_count, kind, repetitions, seconds, a);
        snprintf(chart, sizeof chart, "%s, Mray/s", kind_names[kind]);
        printf("  %-10s", kind_names[kind]);
        for (uint32_t system = 0; system < SYSTEMS; system++) {
            double rate = 1e-6 * ray_count / seconds[system];
            printf("  %s %6.2f", system_names[system], rate);
            bench_report_value(setup->report, chart, system_names[system], label, rate);
        }
        ratios[kind] = seconds[ROBUST] / seconds[TALUS];
        printf("   ratio %.2f; hits %.1f%%, robust %+d, fast %+d\n", ratios[kind], 100.0 * a[TALUS].hits / ray_count,
               (int)(a[ROBUST].hits - a[TALUS].hits), (int)(a[FAST].hits - a[TALUS].hits));
        fflush(stdout);
    }
    free(queries);
    rtcReleaseScene(w.embree[ROBUST]);
    rtcReleaseScene(w.embree[FAST]);
    tl_blob_free(w.scene);
    w.scene = NULL;
}

static void claim(bench_report *report, double ratios[SIZES][KINDS], const changes steps[SIZES])
{
    char text[96];
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        for (uint32_t i = 0; i < SIZES; i++) {
            snprintf(text, sizeof text, "%s, %u instances", kind_names[kind], sizes[i]);
            bench_report_speed(report, text, "Embree robust", ratios[i][kind], 1.0);
        }
    }
    for (uint32_t i = 0; i < SIZES; i++) {
        snprintf(text, sizeof text, "bake of %u instances", sizes[i]);
        bench_report_speed(report, text, "Embree's commit at MEDIUM", steps[i].embree_build / steps[i].build, 1.0);
        snprintf(text, sizeof text, "refit, all of %u instances moved", sizes[i]);
        bench_report_speed(report, text, "Embree's commit at LOW", steps[i].embree_low / steps[i].refit, 1.0);
        snprintf(text, sizeof text, "refit, a tenth of %u instances moved", sizes[i]);
        bench_report_speed(report, text, "Embree's commit at LOW", steps[i].embree_tenth / steps[i].refit_tenth, 1.0);
    }
    bench_report_at_most(report, "bake of 1,000 instances, us", steps[0].build, 100);
}

int main(int argc, char **argv)
{
    uint32_t repetitions = 5, ray_count = 20000;
    const bench_option options[] = { { "repetitions", BENCH_COUNT, &repetitions, "of which the best counts" },
                                     { "rays", BENCH_COUNT, &ray_count, "rays of each kind" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    ray_count = ray_count < SLICE_RAYS * MAX_SLICES ? ray_count : SLICE_RAYS * MAX_SLICES;
    bench_report *report = bench_report_new("scene", "Mray/s", NULL);
    RTCDevice device = rtcNewDevice("threads=1");
    static model models[MODELS];
    make_ball(12, &models[0].level);
    make_ball(20, &models[1].level);
    make_ball(32, &models[2].level);
    make_ball(50, &models[3].level);
    make_small("courtyard", 600, 6, &models[4].level);
    make_small("dungeon", 2000, 8, &models[5].level);
    make_small("city", 3000, 8, &models[6].level);
    make_small("terrain", 1000, 4, &models[7].level);
    for (uint32_t i = 0; i < MODELS; i++) {
        if (tl_soup_bake(&models[i].level.view, NULL, &models[i].soup, NULL) != TL_OK) {
            return 1;
        }
        models[i].embree[ROBUST] =
            bench_embree_triangles(device, &models[i].level.view, RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH);
        models[i].embree[FAST] =
            bench_embree_triangles(device, &models[i].level.view, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH);
        printf("%s: %u triangles; ", models[i].level.name, models[i].level.view.triangle_count);
    }
    printf("\n");
    const bench_setup setup = { device, models, repetitions, ray_count, report };
    double ratios[SIZES][KINDS];
    changes steps[SIZES];
    for (uint32_t i = 0; i < SIZES; i++) {
        run_size(&setup, sizes[i], ratios[i], &steps[i]);
    }
    claim(report, ratios, steps);
    bench_report_print_claims(report);
    for (uint32_t i = 0; i < MODELS; i++) {
        rtcReleaseScene(models[i].embree[ROBUST]);
        rtcReleaseScene(models[i].embree[FAST]);
        tl_blob_free(models[i].soup);
        bench_free_levels(&models[i].level, 1);
    }
    rtcReleaseDevice(device);
    return bench_report_close(report, json);
}
