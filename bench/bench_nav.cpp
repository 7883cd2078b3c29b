// SPDX-License-Identifier: MIT
//
// The navmesh build stage by stage, with Recast in the same process on the same settings where it is installed.
//
//   bench_nav [cell size, metres (0.3)] [repetitions (5)] [level.obj ...]
//
// Without levels: the built-in ones, and those of the data folder. CPU time of one thread, the best of the repetitions.

#include "io/mesh_import.h"

#ifdef TALUS_HAVE_RECAST
#include "../test/recast_pipeline.hpp"
#endif

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <talus/nav_build.h>
#include <vector>

extern "C" {
#include "cli/sample_level.h"
}

namespace
{

const char *const STAGES[] = { "rasterize", "filter",   "compact",  "erode", "distance",
                               "regions",   "contours", "polygons", "detail" };
constexpr int STAGE_COUNT = 9;

struct times {
    double ms[STAGE_COUNT];
};

double now_ms()
{
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

// Runs stage after stage, keeping the best time of each; false when one fails.
struct stopwatch {
    times *best;
    int stage = 0;

    template <class run_stage> bool time(run_stage run)
    {
        double begin = now_ms();
        bool done = run();
        best->ms[stage] = std::min(best->ms[stage], now_ms() - begin);
        stage++;
        return done;
    }
};

bool run_talus(const tl_nav_config &config, const tl_mesh_view &mesh, times *best)
{
    stopwatch watch{ best };
    tl_nav_stages s = {};
    tl_nav_compact *compact = &s.compact;
    bool done =
        watch.time([&] { return !tl_nav_rasterize(&config, &mesh, nullptr, nullptr, &s.heightfield, nullptr); }) &&
        watch.time([&] {
            tl_nav_filter_low_hanging_obstacles(&config, &s.heightfield);
            tl_nav_filter_ledge_spans(&config, &s.heightfield);
            tl_nav_filter_walkable_low_height_spans(&config, &s.heightfield);
            return true;
        }) &&
        watch.time([&] { return !tl_nav_compact_build(&config, &s.heightfield, nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_erode(&config, nullptr, compact); }) &&
        watch.time([&] { return !tl_nav_distance_field(nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_build_regions(&config, nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_build_contours(&config, compact, nullptr, &s.contours, nullptr); }) &&
        watch.time([&] {
            tl_polygon_def def = tl_default_polygon_def();
            def.max_verts_per_poly = config.max_verts_per_poly;
            return !tl_polygon_mesh_build(&s.contours.set, &def, &s.polygons, nullptr);
        }) &&
        watch.time([&] { return !tl_nav_build_detail(&config, compact, &s.polygons, nullptr, &s.detail, nullptr); });
    tl_nav_stages_free(&s, nullptr);
    return done;
}

#ifdef TALUS_HAVE_RECAST
bool run_recast(const tl_nav_config &config, const tl_mesh_view &mesh, times *best)
{
    stopwatch watch{ best };
    recast_pipeline recast;
    return watch.time([&] { return recast.rasterize(config, mesh, 45.0f); }) &&
           watch.time([&] { return recast.filter(config); }) &&
           watch.time([&] { return recast.build_compact(config); }) &&
           watch.time([&] { return recast.erode(config); }) && watch.time([&] { return recast.distance_field(); }) &&
           watch.time([&] { return recast.regions(config); }) &&
           watch.time([&] { return recast.build_contours(config); }) &&
           watch.time([&] { return recast.build_polygons(config); }) &&
           watch.time([&] { return recast.build_detail(config); });
}
#endif

double sum_of(const times &t)
{
    double sum = 0;
    for (double ms : t.ms) {
        sum += ms;
    }
    return sum;
}

void print_row(const char *name, const times &t)
{
    std::printf("  %-8s", name);
    for (double ms : t.ms) {
        std::printf(" %9.2f", ms);
    }
    std::printf(" %9.2f\n", sum_of(t));
}

void print_ratio(const times &ours, const times &theirs)
{
    std::printf("  %-8s", "ratio");
    for (int i = 0; i < STAGE_COUNT; i++) {
        std::printf(" %9.2f", ours.ms[i] / theirs.ms[i]);
    }
    std::printf(" %9.2f\n", sum_of(ours) / sum_of(theirs));
}

struct totals {
    times talus = {}, recast = {};
};

void add(times *sum, const times &part)
{
    for (int i = 0; i < STAGE_COUNT; i++) {
        sum->ms[i] += part.ms[i];
    }
}

void bench_level(const std::string &name, const tl_mesh_view &mesh, float cell_size, int repetitions, totals *sum)
{
    tl_aabb bounds = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)mesh.triangle_count; i++) {
        bounds = tl_aabb_add_point(bounds, mesh.vertices[mesh.indices[i]]);
    }
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    tl_nav_config config;
    if (tl_nav_config_make(&def, bounds, 0, 0, &config, nullptr) != TL_OK) {
        std::printf("%s: no lattice\n", name.c_str());
        return;
    }
    times talus, recast;
    std::fill(talus.ms, talus.ms + STAGE_COUNT, 1e9);
    recast = talus;
    bool done = true, peer_done = false;
    for (int r = 0; r < repetitions; r++) {
        done = done && run_talus(config, mesh, &talus);
#ifdef TALUS_HAVE_RECAST
        peer_done = run_recast(config, mesh, &recast);
#endif
    }
    std::printf("%s: %u triangles, %u x %u columns\n", name.c_str(), mesh.triangle_count, config.width, config.height);
    if (!done) {
        std::printf("  a stage failed\n");
        return;
    }
    print_row("talus", talus);
    add(&sum->talus, talus);
    if (peer_done) {
        print_row("Recast", recast);
        print_ratio(talus, recast);
        add(&sum->recast, recast);
    }
}

void bench_file(const std::string &path, float cell_size, int repetitions, totals *sum)
{
    tl_imported_mesh mesh;
    if (tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) != TL_OK) {
        return;
    }
    bench_level(path.substr(path.find_last_of('/') + 1), tl_imported_mesh_as_view(&mesh), cell_size, repetitions, sum);
    tl_imported_mesh_free(&mesh);
}

void bench_samples(float cell_size, int repetitions, totals *sum)
{
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; i++) {
        tl_sample_mesh mesh;
        if (tl_sample_build_level(&levels[i], levels[i].default_triangles, 1, &mesh) == TL_OK) {
            bench_level(levels[i].name, tl_sample_mesh_as_view(&mesh), cell_size, repetitions, sum);
        }
        tl_sample_mesh_free(&mesh);
    }
}

} // namespace

int main(int argc, char **argv)
{
    const float cell_size = argc > 1 ? std::strtof(argv[1], nullptr) : 0.3f;
    const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
    std::printf("CPU ms, best of %d, one thread, cells of %.2f m\n  %-8s", repetitions, (double)cell_size, "");
    for (const char *stage : STAGES) {
        std::printf(" %9s", stage);
    }
    std::printf(" %9s\n", "sum");
    totals sum;
    for (int i = 3; i < argc; i++) {
        bench_file(argv[i], cell_size, repetitions, &sum);
    }
    if (argc <= 3) {
        bench_samples(cell_size, repetitions, &sum);
        const char *files[] = { "nav_test", "dungeon", "undulating", "proto-level", "collision_mesh_01", "test_map01" };
        for (const char *file : files) {
            bench_file(std::string(TALUS_DATA_DIR) + "/levels/" + file + ".obj", cell_size, repetitions, &sum);
        }
    }
    std::printf("all levels\n");
    print_row("talus", sum.talus);
    if (sum_of(sum.recast) > 0) {
        print_row("Recast", sum.recast);
        print_ratio(sum.talus, sum.recast);
    }
    return 0;
}
