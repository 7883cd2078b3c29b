// SPDX-License-Identifier: MIT
//
// Mending a prepared navmesh: a tile of a city is taken out and put back, and its visibility graph brought up to date.
//
//   bench_mend [--triangles N (1000000)] [--edits N (60)] [--pairs N (400)] [--json FILE]
//
// Beside each other: what it takes to prepare the navmesh from nothing, what a mend takes, and searches between random
// places before the edits and after them, which say what is left of the landmarks. Processor time of one thread.

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "measure.h"
#include "report.h"

#include <talus/nav_around.h>
#include <talus/nav_bake.h>
#include <talus/nav_prepare.h>
#include <talus/nav_query.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_EDITS = 1 << 16, MAX_PAIRS = 1 << 12, RUNS = 5 };

static const double BAR_MS = 5.0;

static void must(tl_result result, const char *what)
{
    if (result != TL_OK) {
        fprintf(stderr, "%s: %s\n", what, tl_result_text(result));
        exit(1);
    }
}

static uint64_t random_state = 3;

typedef struct world {
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    tl_nav_query *query;
    tl_vec3 pairs[MAX_PAIRS][2];
    uint32_t pair_count;
} world;

// Without a table, which is made anew after every edit.
static tl_nav_prepared prepare(const world *w)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    def.table_bytes = 0;
    tl_nav_prepared made;
    must(tl_navmesh_prepare(w->navmesh, &def, &made), "prepare");
    return made;
}

static void bake_world(world *w, uint32_t triangles)
{
    tl_sample_mesh mesh;
    must(tl_sample_build_level(tl_sample_find_level("city"), triangles, 1, &mesh), "sample");
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 64;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = tl_sample_mesh_as_view(&mesh);
    must(tl_nav_bake(&def, &input, &w->tiles, NULL), "bake");
    tl_sample_mesh_free(&mesh);
    must(tl_navmesh_create(NULL, &w->navmesh), "navmesh");
    must(tl_navmesh_add_tiles(w->navmesh, w->tiles.tiles, w->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL), "tiles");
}

// Places have other polygons once their tile was put back.
static tl_nav_path_request request_of(const world *w, uint32_t pair)
{
    tl_nav_path_request request = { NULL, { 0, { 0.0f, 0.0f, 0.0f } }, { 0, { 0.0f, 0.0f, 0.0f } } };
    const tl_vec3 extents = { 0.1f, 0.5f, 0.1f };
    must(tl_navmesh_find_nearest(w->navmesh, NULL, w->pairs[pair][0], extents, &request.start), "start");
    must(tl_navmesh_find_nearest(w->navmesh, NULL, w->pairs[pair][1], extents, &request.goal), "goal");
    return request;
}

static tl_nav_shortest_path find_path(const world *w, uint32_t pair)
{
    const tl_nav_path_request request = request_of(w, pair);
    tl_nav_shortest_path path;
    must(tl_nav_query_find_shortest_path(w->query, w->navmesh, &request, NULL, &path), "path");
    return path;
}

// Random pairs with a path between them.
static void choose_pairs(world *w, uint32_t count)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = 1u << 20;
    must(tl_nav_query_create(&def, &w->query, NULL), "query");
    for (w->pair_count = 0; w->pair_count < count;) {
        for (int end = 0; end < 2; end++) {
            tl_nav_location place;
            const uint64_t random[2] = { tl_random_bits(&random_state), tl_random_bits(&random_state) };
            must(tl_navmesh_random_point(w->navmesh, NULL, random, &place), "place");
            w->pairs[w->pair_count][end] = place.point;
        }
        w->pair_count += find_path(w, w->pair_count).status == TL_NAV_PATH_COMPLETE ? 1 : 0;
    }
}

static void measure_paths(const world *w, const char *when, bench_report *report)
{
    double best = 1e30, metres = 0.0, nodes = 0.0;
    for (int run = 0; run < RUNS; run++) {
        const double began = bench_thread_seconds();
        metres = nodes = 0.0;
        for (uint32_t i = 0; i < w->pair_count; i++) {
            const tl_nav_shortest_path path = find_path(w, i);
            metres += path.length;
            nodes += (double)path.node_count;
        }
        const double took = (bench_thread_seconds() - began) * 1e6 / (double)w->pair_count;
        best = took < best ? took : best;
    }
    printf("  paths %s: %.1f us, %.0f nodes; %.3f m in all\n", when, best, nodes / (double)w->pair_count, metres);
    bench_report_value(report, "paths", "us", when, best);
}

static void measure_mends(const world *w, uint32_t edits, bench_report *report)
{
    static double times[MAX_EDITS];
    double looked = 0.0;
    tl_nav_prepared made = { .bytes = 0 };
    for (uint32_t i = 0; i < edits; i++) {
        const tl_nav_tile *tile = w->tiles.tiles[tl_random_bits(&random_state) % w->tiles.tile_count];
        must(tl_navmesh_remove_tile(w->navmesh, tile->tile_x, tile->tile_z), "remove");
        must(tl_navmesh_add_tile(w->navmesh, tile, TL_NAV_TILE_BORROWED), "add");
        const double began = bench_thread_seconds();
        made = prepare(w);
        times[i] = (bench_thread_seconds() - began) * 1e3;
        looked += made.renewed_count;
    }
    const double median = bench_quantile(times, edits, 0.5);
    printf("  mend: median %.2f ms, 90%% %.2f, most %.2f; %.0f corner vertices look; now %u, %u edges, %.1f MB\n",
           median, bench_quantile(times, edits, 0.9), bench_quantile(times, edits, 1.0), looked / (double)edits,
           made.corner_vertex_count, made.edge_count, 1e-6 * (double)made.bytes);
    bench_report_at_most(report, "ms to mend a graph after a tile was put back", median, BAR_MS);
}

int main(int argc, char **argv)
{
    uint32_t triangles = 1000000, edits = 60, pairs = 400;
    const bench_option options[] = { { "triangles", BENCH_COUNT, &triangles, "of the city" },
                                     { "edits", BENCH_COUNT, &edits, "tiles that are taken out and put back" },
                                     { "pairs", BENCH_COUNT, &pairs, "of places between which paths are found" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    edits = edits < 1 ? 1 : edits > MAX_EDITS ? MAX_EDITS : edits;
    pairs = pairs < 1 ? 1 : pairs > MAX_PAIRS ? MAX_PAIRS : pairs;
    static world w;
    bench_report *report = bench_report_new("mending a prepared navmesh", "us", NULL);
    bake_world(&w, triangles);
    const double began = bench_thread_seconds();
    const tl_nav_prepared made = prepare(&w);
    printf("city of %u triangles, %u tiles: prepared in %.1f ms; %u corner vertices, %u edges, %.1f MB\n", triangles,
           w.tiles.tile_count, (bench_thread_seconds() - began) * 1e3, made.corner_vertex_count, made.edge_count,
           1e-6 * (double)made.bytes);
    choose_pairs(&w, pairs);
    measure_paths(&w, "before", report);
    measure_mends(&w, edits, report);
    measure_paths(&w, "after", report);
    bench_report_print_claims(report);
    tl_nav_query_destroy(w.query);
    tl_navmesh_destroy(w.navmesh);
    tl_nav_tiles_free(&w.tiles);
    return bench_report_close(report, json);
}
