// SPDX-License-Identifier: MIT
//
// Mending a prepared navmesh: tiles of a city change, and its visibility graph is brought up to date.
//
//   bench_mend [--triangles N (1000000)] [--edits N (60)] [--pairs N (400)] [--threads N (1)] [--json FILE]
//
// Beside each other: what it takes to prepare the navmesh from nothing, and what a mend takes after an edit of each
// kind: a tile is replaced by an equal one; a crate comes, and its tiles are replaced by rebaked ones, and goes again;
// a tile goes, and comes back. Searches between random places before the edits and after them say what is left of the
// landmarks. Processor time of one thread; with --threads, time on the wall of so many.

#include "base/random.h"
#include "bench_options.h"
#include "cli/sample/sample_level.h"
#include "cli/shared/thread_pool.h"
#include "measure.h"
#include "report.h"

#include <talus/nav_around.h>
#include <talus/nav_bake.h>
#include <talus/nav_obstacles.h>
#include <talus/nav_prepare.h>
#include <talus/nav_query.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_EDITS = 1 << 14, MAX_PAIRS = 1 << 12, RUNS = 5 };

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
    tl_nav_tile_block block;
    tl_nav_tile **tiles; // of the block
    uint32_t tile_count;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
    const tl_tasks *tasks; // that prepare it; NULL: this thread
    tl_nav_query *query;
    tl_vec3 pairs[MAX_PAIRS][2];
    uint32_t pair_count;
} world;

// Without a table, which is made anew after every edit.
static tl_nav_prepared prepare(const world *w)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    def.table_bytes = 0;
    def.tasks = w->tasks;
    tl_nav_prepared made;
    must(tl_navmesh_prepare(w->navmesh, &def, &made), "prepare");
    return made;
}

// Seconds that preparing takes.
static double preparing_seconds(const world *w)
{
    return w->tasks != NULL ? bench_wall_seconds() : bench_thread_seconds();
}

static void bake_world(world *w, uint32_t triangles)
{
    tl_sample_mesh mesh;
    must(tl_sample_build_level(tl_sample_find_level("city"), triangles, 1, &mesh), "sample");
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 64;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        def.bounds = tl_aabb_add_point(def.bounds, mesh.vertices[i]);
    }
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = tl_sample_mesh_as_view(&mesh);
    must(tl_nav_obstacles_bake(&def, &input, &w->obstacles, &w->block, NULL), "bake");
    tl_sample_mesh_free(&mesh);
    must(tl_navmesh_create(NULL, &w->navmesh), "navmesh");
    const uint32_t places = w->block.range.count_x * w->block.range.count_z;
    w->tiles = malloc(places * sizeof *w->tiles);
    must(w->tiles != NULL ? TL_OK : TL_ERR_MEMORY, "list of tiles");
    for (uint32_t i = 0; i < places; i++) {
        for (uint32_t k = 0; k < w->block.stacks[i].count && k < 1; k++) {
            w->tiles[w->tile_count++] = w->block.stacks[i].tiles[k];
        }
    }
    must(tl_navmesh_add_tiles(w->navmesh, w->tiles, w->tile_count, TL_NAV_TILE_BORROWED, NULL), "tiles");
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

// Of mends after edits of one kind.
typedef struct mend_times {
    const char *kind;
    double times[MAX_EDITS];
    uint32_t count;
    double looked;
    tl_nav_prepared made;
} mend_times;

static void mend(const world *w, mend_times *m)
{
    const double began = preparing_seconds(w);
    m->made = prepare(w);
    m->times[m->count++] = (preparing_seconds(w) - began) * 1e3;
    m->looked += m->made.renewed_count;
}

static void report_mends(mend_times *m, bench_report *report)
{
    const double median = bench_quantile(m->times, m->count, 0.5);
    printf("  %-26s median %5.2f ms, 90%% %5.2f, most %5.2f; %4.0f corner vertices look; now %u, %u edges, %.1f MB\n",
           m->kind, median, bench_quantile(m->times, m->count, 0.9), bench_quantile(m->times, m->count, 1.0),
           m->looked / (double)m->count, m->made.corner_vertex_count, m->made.edge_count, 1e-6 * (double)m->made.bytes);
    char claim[96];
    snprintf(claim, sizeof claim, "ms to mend a graph after: %s", m->kind);
    bench_report_at_most(report, claim, median, BAR_MS);
}

static tl_nav_tile *random_tile(const world *w)
{
    return w->tiles[tl_random_bits(&random_state) % w->tile_count];
}

// Puts all tiles that wait into the navmesh.
static void update_tiles(const world *w)
{
    uint32_t waiting = 1;
    while (waiting > 0) {
        must(tl_nav_obstacles_update(w->obstacles, w->navmesh, 64, &waiting, NULL), "update");
    }
}

static tl_nav_obstacle random_crate(const world *w)
{
    tl_nav_obstacle crate;
    memset(&crate, 0, sizeof crate);
    crate.shape = TL_NAV_OBSTACLE_BOX;
    tl_nav_location place;
    const uint64_t random[2] = { tl_random_bits(&random_state), tl_random_bits(&random_state) };
    must(tl_navmesh_random_point(w->navmesh, NULL, random, &place), "place");
    crate.base = place.point;
    crate.half_x = crate.half_z = 0.5f;
    crate.height = 1.0f;
    return crate;
}

static void measure_mends(const world *w, uint32_t edits, bench_report *report)
{
    static mend_times equal = { .kind = "an equal tile" }, crate_comes = { .kind = "a crate comes" },
                      crate_goes = { .kind = "a crate goes" }, goes = { .kind = "a tile goes" },
                      comes = { .kind = "a tile comes" };
    for (uint32_t i = 0; i < edits; i++) {
        const tl_nav_tile *tile = random_tile(w);
        must(tl_navmesh_remove_tile(w->navmesh, tile->tile_x, tile->tile_z), "remove");
        must(tl_navmesh_add_tile(w->navmesh, tile, TL_NAV_TILE_BORROWED), "add");
        mend(w, &equal);
        const tl_nav_obstacle crate = random_crate(w);
        tl_nav_obstacle_id id = 0;
        must(tl_nav_obstacles_add(w->obstacles, &crate, &id, NULL), "crate");
        update_tiles(w);
        mend(w, &crate_comes);
        must(tl_nav_obstacles_remove(w->obstacles, id), "crate");
        update_tiles(w);
        mend(w, &crate_goes);
        tile = random_tile(w);
        must(tl_navmesh_remove_tile(w->navmesh, tile->tile_x, tile->tile_z), "remove");
        mend(w, &goes);
        must(tl_navmesh_add_tile(w->navmesh, tile, TL_NAV_TILE_BORROWED), "add");
        mend(w, &comes);
    }
    report_mends(&equal, report);
    report_mends(&crate_comes, report);
    report_mends(&crate_goes, report);
    report_mends(&goes, report);
    report_mends(&comes, report);
}

int main(int argc, char **argv)
{
    uint32_t triangles = 1000000, edits = 60, pairs = 400, threads = 1;
    const bench_option options[] = { { "triangles", BENCH_COUNT, &triangles, "of the city" },
                                     { "edits", BENCH_COUNT, &edits, "of each kind" },
                                     { "pairs", BENCH_COUNT, &pairs, "of places between which paths are found" },
                                     { "threads", BENCH_COUNT, &threads, "that prepare" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    edits = edits < 1 ? 1 : edits > MAX_EDITS ? MAX_EDITS : edits;
    pairs = pairs < 1 ? 1 : pairs > MAX_PAIRS ? MAX_PAIRS : pairs;
    static world w;
    bench_report *report = bench_report_new("mending a prepared navmesh", "us", NULL);
    bake_world(&w, triangles);
    tl_thread_pool *pool = threads > 1 ? tl_thread_pool_create(threads) : NULL;
    w.tasks = pool != NULL ? tl_thread_pool_tasks(pool) : NULL;
    const double began = preparing_seconds(&w);
    const tl_nav_prepared made = prepare(&w);
    printf("city of %u triangles, %u tiles: prepared in %.1f ms; %u corner vertices, %u edges, %.1f MB\n", triangles,
           w.tile_count, (preparing_seconds(&w) - began) * 1e3, made.corner_vertex_count, made.edge_count,
           1e-6 * (double)made.bytes);
    choose_pairs(&w, pairs);
    measure_paths(&w, "before", report);
    measure_mends(&w, edits, report);
    measure_paths(&w, "after", report);
    bench_report_print_claims(report);
    tl_thread_pool_free(pool);
    tl_nav_query_destroy(w.query);
    tl_navmesh_destroy(w.navmesh);
    tl_nav_obstacles_destroy(w.obstacles);
    tl_nav_tile_block_free(&w.block);
    free(w.tiles);
    return bench_report_close(report, json);
}
