// SPDX-License-Identifier: MIT
//
// A city that changes while it is read: what an edit costs in versions and on a navmesh that is alone, what entering
// and leaving a version costs beside a read-write lock, and what readers find in a second without edits and beside
// them.
//
//   bench_versions [--triangles N (300000)] [--json FILE]

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "measure.h"
#include "report.h"

#include <talus/nav_obstacles.h>
#include <talus/nav_versions.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDITS = 300, MAX_SWAPS = 16 * EDITS, ENTRIES = 2000000, PAIRS = 256, SLICES = 15, MAX_DELAYS = 1 << 20 };

// Whose routes are counted: of a navmesh that is alone, in versions, those beside edits of another navmesh, and beside
// edits of their own.
enum { ALONE, STILL, APART, BESIDE, READER_KINDS };

static const double SLICE_SECONDS = 0.25;

static void must(tl_result result, const char *what)
{
    if (result != TL_OK) {
        fprintf(stderr, "%s: %s\n", what, tl_result_text(result));
        exit(1);
    }
}

static uint64_t random_state = 1; // of the writer, while there is one

static float random_between(float low, float high)
{
    return low + (high - low) * tl_random_unit_float(&random_state);
}

/// A city twice: alone, and in versions.
typedef struct city {
    tl_nav_def def;
    tl_nav_obstacles *obstacles[2];
    tl_navmesh *alone;
    tl_nav_versions *versions;
} city;

// In the half of the city that readers do not look at.
static tl_nav_obstacle random_crate(const city *c)
{
    const tl_aabb *box = &c->def.bounds;
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = TL_NAV_OBSTACLE_CYLINDER;
    crate.radius = random_between(0.3f, 1.5f);
    crate.height = 2.0f;
    crate.base = tl_vec3_make(random_between(box->min.x, box->max.x), 0.0f,
                              random_between(0.4f * box->min.z + 0.6f * box->max.z, box->max.z));
    return crate;
}

typedef struct swap_times {
    double alone[MAX_SWAPS], inside[MAX_SWAPS], whole[MAX_SWAPS];
    size_t count;
} swap_times;

static void swap_alone(city *c, tl_nav_rebaked_tile *tile, swap_times *times)
{
    const double began = bench_thread_seconds();
    must(tl_navmesh_replace_tiles(c->alone, tile->tile_x, tile->tile_z, &tile->stack), "swap");
    times->alone[times->count] = (bench_thread_seconds() - began) * 1e6;
}

static void swap_in_version(city *c, tl_nav_rebaked_tile *tile, swap_times *times)
{
    const tl_navmesh *reader = tl_nav_versions_acquire(c->versions); // one is in there, as always
    tl_navmesh *draft;
    const double began = bench_thread_seconds();
    must(tl_nav_versions_edit(c->versions, &draft), "edit");
    const double begun = bench_thread_seconds();
    must(tl_navmesh_replace_tiles(draft, tile->tile_x, tile->tile_z, &tile->stack), "swap");
    const double swapped = bench_thread_seconds();
    must(tl_nav_versions_publish(c->versions), "publish");
    times->inside[times->count] = (swapped - begun) * 1e6;
    times->whole[times->count] = (bench_thread_seconds() - began) * 1e6;
    tl_nav_versions_release(c->versions, reader);
}

// The tiles that wait, swapped in both; one version a tile.
static void swap_tiles(city *c, swap_times *times)
{
    while (tl_nav_obstacles_waiting(c->obstacles[0]) > 0 && times->count < MAX_SWAPS) {
        tl_nav_rebaked_tile a, b;
        const tl_result result = tl_nav_obstacles_bake_next(c->obstacles[0], &a, NULL);
        if (result == TL_NOT_FOUND) {
            must(tl_nav_obstacles_bake_next(c->obstacles[1], &b, NULL) == result ? TL_OK : TL_ERR_CORRUPT, "build");
            return; // what waited is as it was
        }
        must(result, "build");
        must(tl_nav_obstacles_bake_next(c->obstacles[1], &b, NULL), "build");
        for (size_t turn = 0; turn < 2; turn++) { // in turn, who is first
            if ((times->count + turn) % 2 == 0) {
                swap_alone(c, &a, times);
            } else {
                swap_in_version(c, &b, times);
            }
        }
        times->count++;
    }
}

static void measure_edits(city *c, bench_report *report)
{
    static swap_times times;
    for (int i = 0; i < EDITS; i++) {
        const tl_nav_obstacle crate = random_crate(c);
        tl_nav_obstacle_id id;
        must(tl_nav_obstacles_add(c->obstacles[0], &crate, &id, NULL), "add");
        must(tl_nav_obstacles_add(c->obstacles[1], &crate, &id, NULL), "add");
        swap_tiles(c, &times);
    }
    const double alone = bench_quantile(times.alone, times.count, 0.5);
    const double inside = bench_quantile(times.inside, times.count, 0.5);
    const double whole = bench_quantile(times.whole, times.count, 0.5);
    printf(
        "%u tiles; a tile swapped alone: median %.1f us, 99%% %.1f; in a draft %.1f us; with a version of its own %.1f "
        "us, 99%% %.1f\n",
        tl_navmesh_tile_count(c->alone), alone, bench_quantile(times.alone, times.count, 0.99), inside, whole,
        bench_quantile(times.whole, times.count, 0.99));
    bench_report_at_most(report, "a swap in a version of its own to a swap alone", whole / alone, 1.5);
}

static void measure_entries(city *c, bench_report *report)
{
    pthread_rwlock_t lock;
    pthread_rwlock_init(&lock, NULL);
    double times[2][9];
    for (int round = 0; round < 9; round++) {
        double began = bench_thread_seconds();
        for (int i = 0; i < ENTRIES; i++) {
            tl_nav_versions_release(c->versions, tl_nav_versions_acquire(c->versions));
        }
        times[0][round] = (bench_thread_seconds() - began) * 1e9 / ENTRIES;
        began = bench_thread_seconds();
        for (int i = 0; i < ENTRIES; i++) {
            pthread_rwlock_rdlock(&lock);
            pthread_rwlock_unlock(&lock);
        }
        times[1][round] = (bench_thread_seconds() - began) * 1e9 / ENTRIES;
    }
    pthread_rwlock_destroy(&lock);
    const double ours = bench_quantile(times[0], 9, 0.5), locked = bench_quantile(times[1], 9, 0.5);
    printf("a version acquired and released: %.1f ns; a read-write lock taken and given back: %.1f ns\n", ours, locked);
    bench_report_at_most(report, "entering and leaving a version to a read-write lock", ours / locked, 1.0);
}

/// A writer that runs until it is told to stop: crates come and go, as fast as it can, each time a version; or, to
/// compare with, the same on the navmesh that is alone, which nobody reads then.
typedef struct writer {
    city *c;
    bool is_alone;
    atomic_bool done;
    uint32_t versions;
} writer;

static void write_tiles(writer *w)
{
    if (w->is_alone) {
        must(tl_nav_obstacles_update(w->c->obstacles[0], w->c->alone, UINT32_MAX, NULL, NULL), "update");
        return;
    }
    tl_navmesh *draft;
    must(tl_nav_versions_edit(w->c->versions, &draft), "edit");
    must(tl_nav_obstacles_update(w->c->obstacles[1], draft, UINT32_MAX, NULL, NULL), "update");
    must(tl_nav_versions_publish(w->c->versions), "publish");
    w->versions++;
}

static void *write_crates(void *user)
{
    writer *w = user;
    tl_nav_obstacles *obstacles = w->c->obstacles[w->is_alone ? 0 : 1];
    while (!atomic_load(&w->done)) {
        const tl_nav_obstacle crate = random_crate(w->c);
        tl_nav_obstacle_id id;
        must(tl_nav_obstacles_add(obstacles, &crate, &id, NULL), "add");
        for (int goes = 0; goes < 2; goes++) {
            write_tiles(w);
            if (goes == 0) {
                must(tl_nav_obstacles_remove(obstacles, id), "remove");
            }
        }
    }
    return NULL;
}

typedef struct reader {
    tl_nav_query *query;
    tl_vec3 ends[PAIRS][2];
    double *delays; // seconds that entering and leaving took, of slices beside edits
    size_t delay_count;
} reader;

// Routes found in a second of the thread's own time; alone where there are no versions.
static double routes_per_second(reader *r, const tl_navmesh *alone, tl_nav_versions *versions, bool notes_delays)
{
    uint32_t count = 0;
    const double began = bench_thread_seconds();
    double now = began;
    while (now - began < SLICE_SECONDS) {
        const double before = bench_wall_seconds();
        const tl_navmesh *navmesh = versions != NULL ? tl_nav_versions_acquire(versions) : alone;
        const double entered = bench_wall_seconds();
        const tl_nav_route_request request = { NULL, r->ends[count % PAIRS][0], r->ends[count % PAIRS][1],
                                               tl_vec3_make(3, 5, 3) };
        tl_nav_corner corners[64];
        tl_nav_ref polygons[512];
        const tl_nav_path_buffers buffers = { polygons, 512, corners, 64 };
        tl_nav_route route;
        (void)tl_nav_query_find_route(r->query, navmesh, &request, &buffers, &route);
        const double found = bench_wall_seconds();
        if (versions != NULL) {
            tl_nav_versions_release(versions, navmesh);
        }
        if (notes_delays && r->delay_count < MAX_DELAYS) {
            r->delays[r->delay_count++] = entered - before + bench_wall_seconds() - found;
        }
        count++;
        now = bench_thread_seconds();
    }
    return (double)count / (now - began);
}

static double routes_beside(reader *r, writer *w, bool is_alone, bool notes_delays)
{
    pthread_t thread;
    w->is_alone = is_alone;
    atomic_store(&w->done, false);
    pthread_create(&thread, NULL, write_crates, w);
    const double rate = routes_per_second(r, NULL, w->c->versions, notes_delays);
    atomic_store(&w->done, true);
    pthread_join(thread, NULL);
    return rate;
}

static void measure_readers(city *c, bench_report *report)
{
    static reader r;
    r.delays = malloc(MAX_DELAYS * sizeof *r.delays);
    must(tl_nav_query_create(NULL, &r.query, NULL), "query");
    const tl_aabb *box = &c->def.bounds;
    for (int i = 0; i < PAIRS; i++) {
        r.ends[i][0] = tl_vec3_make(random_between(box->min.x, box->max.x), 0.0f,
                                    random_between(box->min.z, 0.6f * box->min.z + 0.4f * box->max.z));
        r.ends[i][1] = tl_add(r.ends[i][0], tl_vec3_make(random_between(-25, 25), 0, random_between(-25, 25)));
    }
    double rates[READER_KINDS][SLICES], ratios[READER_KINDS][SLICES];
    writer w = { c, false, false, 0 };
    for (int i = -1; i < SLICES; i++) {
        double now[READER_KINDS];
        now[ALONE] = routes_per_second(&r, c->alone, NULL, false);
        now[STILL] = routes_per_second(&r, NULL, c->versions, false);
        now[APART] = routes_beside(&r, &w, true, false);
        now[BESIDE] = routes_beside(&r, &w, false, i >= 0);
        for (int k = 0; k < READER_KINDS && i >= 0; k++) { // the first ones warm up
            rates[k][i] = now[k];
            ratios[k][i] = now[k] / now[k == STILL ? ALONE : STILL];
        }
    }
    printf("routes a second of a reader's time: alone %.0f, in versions %.0f, beside edits of another navmesh %.0f, "
           "beside %u versions published %.0f\n",
           bench_quantile(rates[ALONE], SLICES, 0.5), bench_quantile(rates[STILL], SLICES, 0.5),
           bench_quantile(rates[APART], SLICES, 0.5), w.versions, bench_quantile(rates[BESIDE], SLICES, 0.5));
    const double longest = bench_quantile(r.delays, r.delay_count, 1.0) * 1e6;
    printf(
        "entering and leaving beside edits, with the clock: median %.3f us, 99.9%% %.3f us, longest %.1f us of %zu\n",
        bench_quantile(r.delays, r.delay_count, 0.5) * 1e6, bench_quantile(r.delays, r.delay_count, 0.999) * 1e6,
        longest, r.delay_count);
    bench_report_at_least(report, "routes in versions to a navmesh alone", bench_quantile(ratios[STILL], SLICES, 0.5),
                          0.97);
    bench_report_value(report, "readers", "edits of another navmesh beside", "to none",
                       bench_quantile(ratios[APART], SLICES, 0.5));
    bench_report_at_least(report, "routes beside edits to routes without", bench_quantile(ratios[BESIDE], SLICES, 0.5),
                          0.97);
    tl_nav_query_destroy(r.query);
    free(r.delays);
}

static void make_city(city *c, const tl_nav_input *input)
{
    c->def = tl_default_nav_def();
    c->def.tile_size = 64;
    for (uint32_t i = 0; i < input->mesh.vertex_count; i++) {
        c->def.bounds = tl_aabb_add_point(c->def.bounds, input->mesh.vertices[i]);
    }
    must(tl_nav_obstacles_bake(&c->def, input, &c->obstacles[0], NULL, NULL), "bake");
    must(tl_nav_obstacles_bake(&c->def, input, &c->obstacles[1], NULL, NULL), "bake");
    must(tl_navmesh_create(NULL, &c->alone), "navmesh");
    must(tl_nav_obstacles_update(c->obstacles[0], c->alone, UINT32_MAX, NULL, NULL), "update");
    must(tl_nav_versions_create(NULL, &c->versions), "versions");
    tl_navmesh *draft;
    must(tl_nav_versions_edit(c->versions, &draft), "edit");
    must(tl_nav_obstacles_update(c->obstacles[1], draft, UINT32_MAX, NULL, NULL), "update");
    must(tl_nav_versions_publish(c->versions), "publish");
}

int main(int argc, char **argv)
{
    uint32_t triangles = 300000;
    const bench_option options[] = { { "triangles", BENCH_COUNT, &triangles, "of the city" }, { NULL, 0, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    tl_sample_mesh mesh;
    must(tl_sample_build_level(tl_sample_find_level("city"), triangles, 1, &mesh), "city");
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = tl_sample_mesh_as_view(&mesh);
    static city c;
    make_city(&c, &input);
    bench_report *report = bench_report_new("versions", "us", NULL);
    measure_edits(&c, report);
    measure_entries(&c, report);
    measure_readers(&c, report);
    bench_report_print_claims(report);
    tl_navmesh_destroy(c.alone);
    tl_nav_versions_destroy(c.versions);
    tl_nav_obstacles_destroy(c.obstacles[0]);
    tl_nav_obstacles_destroy(c.obstacles[1]);
    tl_sample_mesh_free(&mesh);
    return bench_report_close(report, json);
}
