// SPDX-License-Identifier: MIT
//
// A city that changes: a box of it baked again, and obstacles that come, move and go, beside DetourTileCache where it
// is installed: the same cylinders in the same tiles, both sides in turn, each until its navmesh is right. And many
// that move at once, by one thread and by two.
//
//   bench_obstacles [--triangles N (1000000)] [--json FILE] [LEVEL ...]
//
// With levels, files of meshes, these take the city's place, and what counts are the geometric mean and the worst of
// their ratios to DetourTileCache. Obstacles stand on random triangles that an agent can walk on.

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "cli/shared/thread_pool.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"
#include "tile_cache_peer.h"

#include <talus/nav_obstacles.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDITS = 400, MOVERS = 50, FRAMES = 40, REBUILDS = 20, MAX_TILES = 12 * EDITS, MAX_SIDE = 256 };

static void must(tl_result result, const char *what)
{
    if (result != TL_OK) {
        fprintf(stderr, "%s: %s\n", what, tl_result_text(result));
        exit(1);
    }
}

static uint64_t random_state = 1;

static float random_between(float low, float high)
{
    return low + (high - low) * tl_random_unit_float(&random_state);
}

// With the triangles sorted by place, or without.
static void measure_rebuilds(const tl_nav_def *def, const tl_nav_input *input, tl_nav_triangles *sorted,
                             bench_report *report)
{
    double times[REBUILDS];
    uint32_t tiles = 0;
    for (int i = 0; i < REBUILDS; i++) {
        tl_vec3 at = { random_between(def->bounds.min.x, def->bounds.max.x), 0.0f,
                       random_between(def->bounds.min.z, def->bounds.max.z) };
        tl_aabb box = { { at.x, -100.0f, at.z }, { at.x + 3.0f, 100.0f, at.z + 3.0f } };
        tl_nav_tile_block block;
        tl_nav_near_triangles near = { *input, NULL };
        double began = bench_process_seconds();
        if (sorted != NULL) {
            must(tl_nav_triangles_near(sorted, input, box, &near, NULL), "near");
        }
        must(tl_nav_rebake(def, &near.input, box, &block, NULL), "rebuild");
        times[i] = (bench_process_seconds() - began) * 1e3;
        tiles += block.range.count_x * block.range.count_z;
        tl_nav_tile_block_free(&block);
    }
    double median = bench_quantile(times, REBUILDS, 0.5);
    printf("a box of 3 m baked again%s: median %.2f ms, most %.2f ms, %.1f tiles\n",
           sorted != NULL ? ", triangles sorted by place" : "", median, bench_quantile(times, REBUILDS, 1.0),
           (double)tiles / REBUILDS);
    bench_report_at_most(
        report, sorted != NULL ? "a changed box baked again, triangles sorted, ms" : "a changed box baked again, ms",
        median, 20.0);
}

static void measure_sorted_rebuilds(const tl_nav_def *def, const tl_nav_input *input, bench_report *report)
{
    tl_nav_triangles *sorted;
    const double began = bench_process_seconds();
    must(tl_nav_triangles_create(def, &input->mesh, &sorted, NULL), "triangles");
    printf("triangles sorted by place in %.1f ms, %.1f MB\n", (bench_process_seconds() - began) * 1e3,
           (double)tl_nav_triangles_bytes(sorted) * 1e-6);
    measure_rebuilds(def, input, sorted, report);
    tl_nav_triangles_destroy(sorted);
}

// Times of one stage of the edits: of tiles that obstacles touch for the first time, which learn then what they keep of
// themselves, and of those that they touched before.
typedef struct edit_times {
    double first[MAX_TILES], again[MAX_TILES], swap[MAX_TILES];
    size_t first_count, again_count, swap_count;
    bool seen[MAX_SIDE][MAX_SIDE]; // by tile
} edit_times;

// Makes the tiles that wait, and puts them into the navmesh.
static void make_tiles(tl_nav_obstacles *obstacles, tl_navmesh *navmesh, edit_times *times)
{
    while (tl_nav_obstacles_waiting(obstacles) > 0 && times->swap_count < MAX_TILES) {
        tl_nav_rebaked_tile remade;
        double began = bench_process_seconds();
        const tl_result result = tl_nav_obstacles_bake_next(obstacles, &remade, NULL);
        if (result == TL_NOT_FOUND) {
            return; // what waited is as it was
        }
        must(result, "build");
        double built = bench_process_seconds();
        must(tl_navmesh_replace_tiles(navmesh, remade.tile_x, remade.tile_z, &remade.stack), "swap");
        times->swap[times->swap_count++] = (bench_process_seconds() - built) * 1e6;
        bool *seen = &times->seen[remade.tile_z % MAX_SIDE][remade.tile_x % MAX_SIDE];
        if (*seen) {
            times->again[times->again_count++] = (built - began) * 1e6;
        } else {
            times->first[times->first_count++] = (built - began) * 1e6;
        }
        *seen = true;
    }
}

// From the call until the navmesh is right, both sides in turn.
typedef struct whole_edits {
    double ours[2 * EDITS], theirs[2 * EDITS];
    size_t count;
} whole_edits;

#ifdef TALUS_HAVE_TILE_CACHE
static void measure_peer(bench_tile_cache *peer, const tl_nav_obstacle *crate, bool moves, whole_edits *whole)
{
    double began = bench_process_seconds();
    if (!bench_tile_cache_place(peer, crate->base, crate->radius, crate->height, moves)) {
        fprintf(stderr, "DetourTileCache refused an obstacle\n");
        exit(1);
    }
    whole->theirs[whole->count] = (bench_process_seconds() - began) * 1e6;
}

static bench_tile_cache *make_peer(const tl_nav_def *def, const tl_nav_input *input)
{
    bench_tile_cache *peer = bench_tile_cache_make(def, &input->mesh);
    if (peer == NULL) {
        fprintf(stderr, "DetourTileCache could not be filled\n");
        exit(1);
    }
    return peer;
}

// Ours as a share of the peer's.
typedef struct peer_ratios {
    double time, bytes;
} peer_ratios;

static peer_ratios compare_with_peer(bench_tile_cache *peer, const char *name, const whole_edits *whole, double bytes)
{
    static double sorted[2 * EDITS];
    memcpy(sorted, whole->ours, sizeof sorted);
    const double ours = bench_quantile(sorted, whole->count, 0.5);
    memcpy(sorted, whole->theirs, sizeof sorted);
    const double theirs = bench_quantile(sorted, whole->count, 0.5);
    const double peer_bytes = bench_tile_cache_bytes(peer);
    printf("%s: an obstacle added or moved until the navmesh is right: median %.0f us, DetourTileCache %.0f us (%.2f); "
           "kept of the tiles %.2f MB, its layers, not compressed, %.2f MB (%.2f)\n",
           name, ours, theirs, ours / theirs, bytes * 1e-6, peer_bytes * 1e-6, bytes / peer_bytes);
    bench_tile_cache_free(peer);
    return (peer_ratios){ ours / theirs, bytes / peer_bytes };
}

static void claim_ratios(bench_report *report, const char *name, peer_ratios ratios)
{
    char claim[256];
    snprintf(claim, sizeof claim, "an obstacle's edit to DetourTileCache's time (%s)", name);
    bench_report_at_most(report, claim, ratios.time, 1.0);
    snprintf(claim, sizeof claim, "kept of the tiles to its layers' bytes (%s)", name);
    bench_report_at_most(report, claim, ratios.bytes, 1.5);
}
#endif

static tl_nav_obstacle random_cylinder(const tl_nav_def *def)
{
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = TL_NAV_OBSTACLE_CYLINDER;
    crate.radius = random_between(0.3f, 1.5f);
    crate.height = 2.0f;
    crate.base = tl_vec3_make(random_between(def->bounds.min.x, def->bounds.max.x), 0.0f,
                              random_between(def->bounds.min.z, def->bounds.max.z));
    return crate;
}

// Many that move, until the navmesh is right: milliseconds on the wall of a frame, with one thread and two in turn.
static void measure_movers(const tl_nav_def *def, tl_nav_obstacles *obstacles, tl_navmesh *navmesh, const char *name,
                           bench_report *report)
{
    tl_nav_obstacle movers[MOVERS];
    tl_nav_obstacle_id ids[MOVERS];
    double times[2][FRAMES];
    tl_thread_pool *pool = tl_thread_pool_create(2);
    for (int i = 0; i < MOVERS; i++) {
        movers[i] = random_cylinder(def);
        must(tl_nav_obstacles_add(obstacles, &movers[i], &ids[i], NULL), "add");
    }
    must(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, NULL, NULL), "update");
    for (int frame = 0; frame < 2 * FRAMES; frame++) {
        must(tl_nav_obstacles_set_tasks(obstacles, frame % 2 != 0 ? tl_thread_pool_tasks(pool) : NULL), "tasks");
        const double began = bench_wall_seconds();
        for (int i = 0; i < MOVERS; i++) {
            movers[i].base.x += frame % 4 < 2 ? 0.4f : -0.4f; // there and back, with both
            must(tl_nav_obstacles_move(obstacles, ids[i], &movers[i], NULL), "move");
        }
        must(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, NULL, NULL), "update");
        times[frame % 2][frame / 2] = (bench_wall_seconds() - began) * 1e3;
    }
    must(tl_nav_obstacles_set_tasks(obstacles, NULL), "tasks");
    const double one = bench_quantile(times[0], FRAMES, 0.5), two = bench_quantile(times[1], FRAMES, 0.5);
    printf("%s: %d cylinders moved at once: %.1f ms, two threads %.1f ms (%.2f times as fast)\n", name, MOVERS, one,
           two, one / two);
    bench_report_value(report, "many obstacles in the city", "two threads, times as fast", name, one / two);
    tl_thread_pool_free(pool);
}

static void measure_obstacles(tl_nav_def def, const tl_nav_input *input, tl_nav_partition partition, uint32_t tile_size,
                              bench_report *report)
{
    char name[64];
    snprintf(name, sizeof name, "%s, tiles of %u", partition == TL_NAV_WATERSHED ? "watershed" : "monotone", tile_size);
    def.partition = partition;
    def.tile_size = tile_size;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
    double began = bench_process_seconds();
    must(tl_nav_obstacles_bake(&def, input, &obstacles, NULL, NULL), "bake");
    double bake = bench_process_seconds() - began;
    must(tl_navmesh_create(NULL, &navmesh), "navmesh");
    must(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, NULL, NULL), "update");
    uint32_t tiles = tl_navmesh_tile_count(navmesh);
    const double bare_bytes = (double)tl_nav_obstacles_bytes(obstacles);
    static double add[EDITS];
    static edit_times times;
    static whole_edits whole;
    memset(&times, 0, sizeof times);
    memset(&whole, 0, sizeof whole);
#ifdef TALUS_HAVE_TILE_CACHE
    bench_tile_cache *peer = make_peer(&def, input);
#endif
    for (int i = 0; i < EDITS; i++) {
        tl_nav_obstacle crate = random_cylinder(&def);
        tl_nav_obstacle_id id;
        began = bench_process_seconds();
        must(tl_nav_obstacles_add(obstacles, &crate, &id, NULL), "add");
        add[i] = (bench_process_seconds() - began) * 1e6;
        for (int moves = 0; moves < 2; moves++) {
            if (moves == 1) {
                crate.base.x += 0.4f; // it is pushed on
                crate.base.z -= 0.3f;
                began = bench_process_seconds();
                must(tl_nav_obstacles_move(obstacles, id, &crate, NULL), "move");
            }
            make_tiles(obstacles, navmesh, &times);
            whole.ours[whole.count] = (bench_process_seconds() - began) * 1e6;
#ifdef TALUS_HAVE_TILE_CACHE
            measure_peer(peer, &crate, moves == 1, &whole);
#endif
            whole.count++;
        }
    }
    double add_median = bench_quantile(add, EDITS, 0.5),
           first_median = bench_quantile(times.first, times.first_count, 0.5);
    double again_median = bench_quantile(times.again, times.again_count, 0.5);
    double swap_median = bench_quantile(times.swap, times.swap_count, 0.5);
    const double memo_bytes = (double)tl_nav_obstacles_bytes(obstacles) - bare_bytes;
    printf(
        "%s: baked in %.2f s, floors of %u tiles kept in %.1f MB, and %.1f MB more of %zu touched ones; a cylinder "
        "added: median %.2f us, 99%% %.2f; a tile baked with one for the first time: median %.0f us, 90%% %.0f, 99%% "
        "%.0f; baked again: median %.0f us, 90%% %.0f, 99%% %.0f; swapped in the navmesh: median %.0f us\n",
        name, bake, tiles, bare_bytes * 1e-6, memo_bytes * 1e-6, times.first_count, add_median,
        bench_quantile(add, EDITS, 0.99), first_median, bench_quantile(times.first, times.first_count, 0.9),
        bench_quantile(times.first, times.first_count, 0.99), again_median,
        bench_quantile(times.again, times.again_count, 0.9), bench_quantile(times.again, times.again_count, 0.99),
        swap_median);
#ifdef TALUS_HAVE_TILE_CACHE
    claim_ratios(report, name, compare_with_peer(peer, name, &whole, bare_bytes + memo_bytes));
#endif
    char claim[256];
    snprintf(claim, sizeof claim, "a cylinder added (%s), us", name);
    bench_report_at_most(report, claim, add_median, 100.0);
    snprintf(claim, sizeof claim, "its tile baked, the first time (%s), us", name);
    bench_report_at_most(report, claim, first_median, 400.0);
    snprintf(claim, sizeof claim, "its tile baked again (%s), us", name);
    bench_report_at_most(report, claim, again_median, 200.0);
    bench_report_value(report, "one obstacle in the city", "add", name, add_median);
    bench_report_value(report, "one obstacle in the city", "tile baked, first time", name, first_median);
    bench_report_value(report, "one obstacle in the city", "tile baked again", name, again_median);
    bench_report_value(report, "one obstacle in the city", "tile swapped", name, swap_median);
    measure_movers(&def, obstacles, navmesh, name, report);
    tl_navmesh_destroy(navmesh);
    tl_nav_obstacles_destroy(obstacles);
}

#ifdef TALUS_HAVE_TILE_CACHE
// A point of a random triangle that is not steep.
static tl_vec3 random_place(const tl_mesh_view *mesh)
{
    for (;;) {
        const uint32_t t = (uint32_t)random_between(0.0f, (float)mesh->triangle_count) % mesh->triangle_count;
        const uint32_t *corners = mesh->indices + 3 * (size_t)t;
        const tl_vec3 a = mesh->vertices[corners[0]], b = mesh->vertices[corners[1]], c = mesh->vertices[corners[2]];
        const tl_vec3 up = tl_cross(tl_sub(b, a), tl_sub(c, a));
        if (up.y > 0.8f * tl_length(up)) {
            return tl_lerp(tl_lerp(a, b, random_between(0.0f, 1.0f)), c, random_between(0.0f, 1.0f));
        }
    }
}

static peer_ratios measure_level(const tl_nav_def *def, const tl_nav_input *input, const char *name)
{
    enum { LEVEL_EDITS = 100 };
    static whole_edits whole;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
    memset(&whole, 0, sizeof whole);
    must(tl_nav_obstacles_bake(def, input, &obstacles, NULL, NULL), "bake");
    must(tl_navmesh_create(NULL, &navmesh), "navmesh");
    must(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, NULL, NULL), "update");
    bench_tile_cache *peer = make_peer(def, input);
    for (int i = 0; i < LEVEL_EDITS; i++) {
        tl_nav_obstacle crate;
        memset(&crate, 0, sizeof crate);
        crate.radius = random_between(0.3f, 1.5f);
        crate.height = 2.0f;
        crate.base = random_place(&input->mesh);
        tl_nav_obstacle_id id = 0;
        for (int moves = 0; moves < 2; moves++) {
            crate.base.x += 0.4f * (float)moves;
            crate.base.z -= 0.3f * (float)moves;
            const double began = bench_process_seconds();
            must(moves == 0 ? tl_nav_obstacles_add(obstacles, &crate, &id, NULL)
                            : tl_nav_obstacles_move(obstacles, id, &crate, NULL),
                 "place");
            must(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, NULL, NULL), "update");
            whole.ours[whole.count] = (bench_process_seconds() - began) * 1e6;
            measure_peer(peer, &crate, moves == 1, &whole);
            whole.count++;
        }
    }
    const peer_ratios ratios = compare_with_peer(peer, name, &whole, (double)tl_nav_obstacles_bytes(obstacles));
    tl_navmesh_destroy(navmesh);
    tl_nav_obstacles_destroy(obstacles);
    return ratios;
}

// All levels with one partition and size of tiles.
static void measure_levels(const bench_level *levels, uint32_t count, tl_nav_def def, bench_report *report)
{
    char name[128];
    double time = 0.0, bytes = 0.0;
    peer_ratios worst = { 0.0, 0.0 };
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_input input;
        memset(&input, 0, sizeof input);
        input.mesh = levels[i].view;
        def.bounds = tl_aabb_empty();
        for (uint32_t k = 0; k < 3 * input.mesh.triangle_count; k++) {
            def.bounds = tl_aabb_add_point(def.bounds, input.mesh.vertices[input.mesh.indices[k]]);
        }
        const peer_ratios ratios = measure_level(&def, &input, levels[i].name);
        time += log(ratios.time);
        bytes += log(ratios.bytes);
        worst.time = fmax(worst.time, ratios.time);
        worst.bytes = fmax(worst.bytes, ratios.bytes);
    }
    const char *partition = def.partition == TL_NAV_WATERSHED ? "watershed" : "monotone";
    snprintf(name, sizeof name, "%u levels, %s, tiles of %u, geometric mean", count, partition, def.tile_size);
    claim_ratios(report, name, (peer_ratios){ exp(time / count), exp(bytes / count) });
    snprintf(name, sizeof name, "%u levels, %s, tiles of %u, worst", count, partition, def.tile_size);
    claim_ratios(report, name, worst);
}
#endif

static void measure_files(const char **paths, uint32_t count, bench_report *report)
{
#ifdef TALUS_HAVE_TILE_CACHE
    bench_level *levels = calloc(count, sizeof *levels);
    uint32_t loaded = 0;
    for (uint32_t i = 0; levels != NULL && i < count; i++) {
        if (!bench_load_file(paths[i], &levels[loaded])) {
            fprintf(stderr, "%s: cannot be read\n", paths[i]);
            exit(1);
        }
        loaded++;
    }
    static const uint32_t tile_sizes[] = { 64, 32 };
    for (int k = 0; k < 4; k++) {
        tl_nav_def def = tl_default_nav_def();
        def.tile_size = tile_sizes[k / 2];
        def.partition = k % 2 == 0 ? TL_NAV_MONOTONE : TL_NAV_WATERSHED;
        measure_levels(levels, loaded, def, report);
    }
    bench_free_levels(levels, loaded);
    free(levels);
#else
    (void)paths, (void)count, (void)report;
    fprintf(stderr, "levels are compared with DetourTileCache, which is not installed\n");
    exit(1);
#endif
}

static void measure_city(uint32_t triangles, bench_report *report)
{
    tl_sample_mesh mesh;
    must(tl_sample_build_level(tl_sample_find_level("city"), triangles, 1, &mesh), "city");
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = tl_sample_mesh_as_view(&mesh);
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 64;
    for (uint32_t i = 0; i < input.mesh.vertex_count; i++) {
        def.bounds = tl_aabb_add_point(def.bounds, input.mesh.vertices[i]);
    }
    printf("city of %u triangles\n", input.mesh.triangle_count);
    measure_rebuilds(&def, &input, NULL, report);
    measure_sorted_rebuilds(&def, &input, report);
    static const uint32_t tile_sizes[] = { 64, 48, 32 };
    for (size_t i = 0; i < sizeof tile_sizes / sizeof *tile_sizes; i++) {
        measure_obstacles(def, &input, TL_NAV_WATERSHED, tile_sizes[i], report);
        measure_obstacles(def, &input, TL_NAV_MONOTONE, tile_sizes[i], report);
    }
    tl_sample_mesh_free(&mesh);
}

int main(int argc, char **argv)
{
    uint32_t triangles = 1000000;
    const bench_option options[] = { { "triangles", BENCH_COUNT, &triangles, "of the city" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    const char **levels = malloc((size_t)argc * sizeof *levels);
    if (levels == NULL) {
        return 1;
    }
    const int count = bench_parse(argc, argv, options, levels, &json);
    bench_report *report = bench_report_new("obstacles", "us", NULL);
    if (count > 0) {
        measure_files(levels, (uint32_t)count, report);
    } else {
        measure_city(triangles, report);
    }
    bench_report_print_claims(report);
    free(levels);
    return bench_report_close(report, json);
}
