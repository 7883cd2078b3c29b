// SPDX-License-Identifier: MIT
//
// A city that changes: a box of it baked again, and obstacles that come, move and go, beside DetourTileCache where it
// is installed: the same cylinders in the same tiles, both sides in turn, each until its navmesh is right.
//
//   bench_obstacles [--triangles N (1000000)] [--json FILE]

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "measure.h"
#include "report.h"
#include "tile_cache_peer.h"

#include <talus/nav_obstacles.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDITS = 400, REBUILDS = 20, MAX_TILES = 12 * EDITS, MAX_SIDE = 256 };

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

static void measure_rebuilds(const tl_nav_def *def, const tl_nav_input *input, bench_report *report)
{
    double times[REBUILDS];
    uint32_t tiles = 0;
    for (int i = 0; i < REBUILDS; i++) {
        tl_vec3 at = { random_between(def->bounds.min.x, def->bounds.max.x), 0.0f,
                       random_between(def->bounds.min.z, def->bounds.max.z) };
        tl_aabb box = { { at.x, -100.0f, at.z }, { at.x + 3.0f, 100.0f, at.z + 3.0f } };
        tl_nav_tile_block block;
        double began = bench_process_seconds();
        must(tl_nav_rebake(def, input, box, &block, NULL), "rebuild");
        times[i] = (bench_process_seconds() - began) * 1e3;
        tiles += block.range.count_x * block.range.count_z;
        tl_nav_tile_block_free(&block);
    }
    double median = bench_quantile(times, REBUILDS, 0.5);
    printf("a box of 3 m baked again: median %.2f ms, most %.2f ms, %.1f tiles\n", median,
           bench_quantile(times, REBUILDS, 1.0), (double)tiles / REBUILDS);
    bench_report_at_most(report, "a changed box baked again, ms", median, 20.0);
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

static void compare_with_peer(bench_tile_cache *peer, const char *name, const whole_edits *whole, double bytes,
                              bench_report *report)
{
    static double sorted[2 * EDITS];
    memcpy(sorted, whole->ours, sizeof sorted);
    const double ours = bench_quantile(sorted, whole->count, 0.5);
    memcpy(sorted, whole->theirs, sizeof sorted);
    const double theirs = bench_quantile(sorted, whole->count, 0.5);
    printf("%s: an obstacle added or moved until the navmesh is right: median %.0f us, DetourTileCache %.0f us; kept "
           "of the tiles %.1f MB, its layers, not compressed, %.1f MB\n",
           name, ours, theirs, bytes * 1e-6, bench_tile_cache_bytes(peer) * 1e-6);
    char claim[128];
    snprintf(claim, sizeof claim, "an obstacle's edit to DetourTileCache's time (%s)", name);
    bench_report_at_most(report, claim, ours / theirs, 1.0);
    snprintf(claim, sizeof claim, "kept of the tiles to its layers' bytes (%s)", name);
    bench_report_at_most(report, claim, bytes / bench_tile_cache_bytes(peer), 1.5);
    bench_tile_cache_free(peer);
}
#endif

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
        tl_nav_obstacle crate;
        memset(&crate, 0, sizeof crate);
        crate.shape = TL_NAV_OBSTACLE_CYLINDER;
        crate.radius = random_between(0.3f, 1.5f);
        crate.height = 2.0f;
        crate.base = tl_vec3_make(random_between(def.bounds.min.x, def.bounds.max.x), 0.0f,
                                  random_between(def.bounds.min.z, def.bounds.max.z));
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
    compare_with_peer(peer, name, &whole, bare_bytes + memo_bytes, report);
#endif
    char claim[128];
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
    tl_navmesh_destroy(navmesh);
    tl_nav_obstacles_destroy(obstacles);
}

int main(int argc, char **argv)
{
    uint32_t triangles = 1000000;
    const bench_option options[] = { { "triangles", BENCH_COUNT, &triangles, "of the city" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
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
    bench_report *report = bench_report_new("obstacles", "us", NULL);
    printf("city of %u triangles\n", input.mesh.triangle_count);
    measure_rebuilds(&def, &input, report);
    static const uint32_t tile_sizes[] = { 64, 48, 32 };
    for (size_t i = 0; i < sizeof tile_sizes / sizeof *tile_sizes; i++) {
        measure_obstacles(def, &input, TL_NAV_WATERSHED, tile_sizes[i], report);
        measure_obstacles(def, &input, TL_NAV_MONOTONE, tile_sizes[i], report);
    }
    bench_report_print_claims(report);
    tl_sample_mesh_free(&mesh);
    return bench_report_close(report, json);
}
