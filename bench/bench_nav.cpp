// SPDX-License-Identifier: MIT
//
// The navmesh build stage by stage, with Recast in the same process on the same settings where it is installed.
//
//   bench_nav [LEVEL.obj ...] [--cell-size METRES (0.3)] [--repetitions N (5)] [--json FILE]
//
// Without levels: the built-in ones, those of the data folder, and a city of a million triangles in tiles of 64 cells.
// CPU time of one thread, the best of the repetitions, which alternate. `whole` is the build as users call it, for
// Recast the sum of its stages. Memory is the most that was held at one time, counted by the allocator hooks of both;
// each piece is freed when its last reader is done. A tiled level's memory is that of its largest tile.

#include "bench_options.h"
#include "measure.h"
#include "nav_levels.hpp"
#include "report.h"

#ifdef TALUS_HAVE_RECAST
#include "recast_pipeline.hpp"
#include <recastnavigation/RecastAlloc.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace
{

const char *const STAGES[] = { "rasterize", "floors",   "erode",  "distance", "regions",
                               "contours",  "polygons", "detail", "whole" };
/// FLOORS: filters and compaction.
enum stage { RASTERIZE, FLOORS, ERODE, DISTANCE, REGIONS, CONTOURS, POLYGONS, DETAIL, WHOLE, STAGE_COUNT };

// Milliseconds a stage, and the most bytes held.
struct figures {
    double ms[STAGE_COUNT] = {};
    double peak = 0;

    double sum(std::initializer_list<stage> stages) const
    {
        double total = 0;
        for (stage s : stages) {
            total += ms[s];
        }
        return total;
    }

    void add(const figures &part)
    {
        for (int i = 0; i < STAGE_COUNT; i++) {
            ms[i] += part.ms[i];
        }
        peak += part.peak;
    }

    void keep_best(const figures &other)
    {
        for (int i = 0; i < STAGE_COUNT; i++) {
            ms[i] = std::min(ms[i], other.ms[i]);
        }
    }
};

// Runs stage after stage and adds the time that each takes.
struct stopwatch {
    figures *sum;
    int stage = 0;

    template <class run_stage> bool time(run_stage run)
    {
        const double begin = 1e3 * bench_process_seconds();
        const bool done = run();
        sum->ms[stage++] += 1e3 * bench_process_seconds() - begin;
        return done;
    }
};

// ---- Memory ------------------------------------------------------------------------------------------------

// Bytes asked for and not yet given back. A block's size lies before it.
struct meter {
    static constexpr size_t HEAD = 64;
    static size_t live, peak;

    static void *take(size_t size)
    {
        char *block = static_cast<char *>(std::aligned_alloc(HEAD, (HEAD + size + HEAD - 1) / HEAD * HEAD));
        *reinterpret_cast<size_t *>(block) = size;
        live += size;
        peak = std::max(peak, live);
        return block + HEAD;
    }

    static void give_back(void *memory)
    {
        if (memory != nullptr) {
            char *block = static_cast<char *>(memory) - HEAD;
            live -= *reinterpret_cast<size_t *>(block);
            std::free(block);
        }
    }
};
size_t meter::live = 0, meter::peak = 0;

double talus_peak(const bench_part &part)
{
    const tl_allocator allocator = { [](size_t size, size_t, void *) { return meter::take(size); },
                                     [](void *block, size_t, void *) { meter::give_back(block); }, nullptr };
    const tl_host host = { &allocator, nullptr, nullptr };
    tl_nav_input input = {};
    input.mesh = part.mesh.view();
    tl_nav_tile *tile;
    meter::live = meter::peak = 0;
    tl_nav_tile_bake(&part.config, &input, &host, nullptr, &tile, nullptr);
    tl_blob_free(tile);
    return (double)meter::peak;
}

// ---- The builds --------------------------------------------------------------------------------------------

bool time_whole(const bench_part &part, figures *sum)
{
    tl_nav_input input = {};
    input.mesh = part.mesh.view();
    tl_nav_tile *tile;
    stopwatch watch{ sum, WHOLE };
    const bool done =
        watch.time([&] { return !tl_nav_tile_bake(&part.config, &input, nullptr, nullptr, &tile, nullptr); });
    tl_blob_free(tile);
    return done;
}

bool run_talus(const bench_part &part, figures *sum)
{
    const tl_nav_config &config = part.config;
    const tl_mesh_view mesh = part.mesh.view();
    const bool watershed = config.partition == TL_NAV_WATERSHED;
    stopwatch watch{ sum };
    tl_nav_stages s = {};
    tl_nav_compact *compact = &s.compact;
    bool done =
        watch.time([&] { return !tl_nav_rasterize(&config, &mesh, nullptr, nullptr, &s.heightfield, nullptr); }) &&
        watch.time([&] { return !tl_nav_filter_and_compact(&config, &s.heightfield, nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_erode(&config, nullptr, compact, nullptr); }) &&
        watch.time([&] { return !watershed || !tl_nav_distance_field(nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_bake_regions(&config, nullptr, compact, nullptr); }) &&
        watch.time([&] { return !tl_nav_bake_contours(&config, compact, nullptr, &s.contours, nullptr); }) &&
        watch.time([&] {
            tl_polygon_def def = tl_default_polygon_def();
            def.max_verts_per_poly = config.max_verts_per_poly;
            return !tl_polygon_mesh_bake(&s.contours.set, &def, &s.polygons, nullptr);
        }) &&
        watch.time([&] { return !tl_nav_bake_detail(&config, compact, &s.polygons, nullptr, &s.detail, nullptr); });
    tl_nav_stages_free(&s);
    return done && time_whole(part, sum);
}

#ifdef TALUS_HAVE_RECAST
bool run_recast(const bench_part &part, figures *sum)
{
    const tl_nav_config &config = part.config;
    const tl_mesh_view mesh = part.mesh.view();
    const bool watershed = config.partition == TL_NAV_WATERSHED;
    figures own;
    stopwatch watch{ &own };
    recast_pipeline recast;
    bool done = watch.time([&] { return recast.rasterize(config, mesh, 45.0f); }) &&
                watch.time([&] { return recast.filter(config) && recast.build_compact(config); });
    recast.free_heightfield();
    done = done && watch.time([&] { return recast.erode(config); }) &&
           watch.time([&] { return !watershed || recast.distance_field(); }) &&
           watch.time([&] { return recast.regions(config); }) &&
           watch.time([&] { return recast.build_contours(config); }) &&
           watch.time([&] { return recast.build_polygons(config); });
    recast.free_contours();
    done = done && watch.time([&] { return recast.build_detail(config); });
    own.ms[WHOLE] = own.sum({ RASTERIZE, FLOORS, ERODE, DISTANCE, REGIONS, CONTOURS, POLYGONS, DETAIL });
    sum->add(own);
    return done;
}

double recast_peak(const bench_part &part)
{
    rcAllocSetCustom([](size_t size, rcAllocHint) { return meter::take(size); }, meter::give_back);
    meter::live = meter::peak = 0;
    figures ignored;
    run_recast(part, &ignored);
    rcAllocSetCustom(nullptr, nullptr);
    return (double)meter::peak;
}
#else
bool run_recast(const bench_part &, figures *)
{
    return false;
}

double recast_peak(const bench_part &)
{
    return 0;
}
#endif

// ---- Two threads -------------------------------------------------------------------------------------------

void run_on_two_threads(tl_task_fn *task, uint32_t count, void *task_user, void *)
{
    std::atomic<uint32_t> next{ 0 };
    auto work = [&](uint32_t worker) {
        for (uint32_t i; (i = next.fetch_add(1)) < count;) {
            task(i, worker, task_user);
        }
    };
    std::thread other(work, 1);
    work(0);
    other.join();
}

// Wall milliseconds of a level's build.
double wall_ms(const bench_level &level, tl_nav_def def, const tl_tasks *tasks)
{
    def.host.tasks = tasks;
    tl_nav_input input = {};
    input.mesh = level.mesh.view();
    tl_nav_tiles tiles;
    const double begin = 1e3 * bench_wall_seconds();
    const tl_result result = tl_nav_bake(&def, &input, &tiles, nullptr);
    const double ms = 1e3 * bench_wall_seconds() - begin;
    tl_nav_tiles_free(&tiles);
    return result == TL_OK ? ms : 0;
}

void bench_threads(bench_report *report, const bench_level &level, const tl_nav_def &def, int repetitions)
{
    const tl_tasks two = { run_on_two_threads, 2, nullptr };
    double alone = 1e9, together = 1e9;
    for (int r = 0; r < repetitions; r++) {
        alone = std::min(alone, wall_ms(level, def, nullptr));
        together = std::min(together, wall_ms(level, def, &two));
    }
    std::printf("%s, wall ms: one thread %.0f, two %.0f: %.2f times as fast (%u processors)\n", level.name.c_str(),
                alone, together, alone / together, std::thread::hardware_concurrency());
    bench_report_at_least(report, "tiles, two threads", alone / together, 1.9);
}

// ---- Tables ------------------------------------------------------------------------------------------------

void print_row(const char *name, const figures &f)
{
    std::printf("  %-8s", name);
    for (double ms : f.ms) {
        std::printf(" %9.2f", ms);
    }
    std::printf(" %8.2f\n", f.peak * 1e-6);
}

void print_ratio(const figures &ours, const figures &theirs)
{
    std::printf("  %-8s", "ratio");
    for (int i = 0; i < STAGE_COUNT; i++) {
        theirs.ms[i] > 0 ? std::printf(" %9.2f", ours.ms[i] / theirs.ms[i]) : std::printf(" %9s", "-");
    }
    std::printf(" %8.2f\n", ours.peak / theirs.peak);
}

struct bench {
    bench_report *report;
    int repetitions;
    figures talus, recast; ///< sums over the levels
    double worst = 0;      ///< ratio of a level's whole build

    void run(const bench_level &level, const char *chart)
    {
        figures ours, theirs;
        bool done = true, peer_done = true;
        for (int r = 0; r < repetitions; r++) {
            figures our_sum, their_sum;
            for (const bench_part &part : level.parts) {
                done = done && run_talus(part, &our_sum);
                peer_done = peer_done && run_recast(part, &their_sum);
            }
            r == 0 ? ours.add(our_sum) : ours.keep_best(our_sum);
            r == 0 ? theirs.add(their_sum) : theirs.keep_best(their_sum);
        }
        for (const bench_part &part : level.parts) {
            ours.peak = std::max(ours.peak, talus_peak(part));
            theirs.peak = std::max(theirs.peak, recast_peak(part));
        }
        std::printf("%s\n", level.description.c_str());
        if (!done) {
            std::printf("  a stage failed\n");
            return;
        }
        print_row("talus", ours);
        talus.add(ours);
        bench_report_value(report, chart, "talus", level.name.c_str(), ours.ms[WHOLE]);
        if (peer_done) {
            print_row("Recast", theirs);
            print_ratio(ours, theirs);
            recast.add(theirs);
            bench_report_value(report, chart, "Recast", level.name.c_str(), theirs.ms[WHOLE]);
            worst = std::max(worst, ours.ms[WHOLE] / theirs.ms[WHOLE]);
        }
    }

    // How many times as fast as Recast some stages are.
    void claim(const char *stages, std::initializer_list<stage> list, double bar)
    {
        bench_report_speed(report, stages, "Recast", recast.sum(list) / talus.sum(list), bar);
    }

    void print_sum(const char *title) const
    {
        std::printf("%s\n", title);
        print_row("talus", talus);
        if (recast.ms[WHOLE] > 0) {
            print_row("Recast", recast);
            print_ratio(talus, recast);
        }
    }
};

void print_head(const char *title, int repetitions, float cell_size)
{
    std::printf("%s: CPU ms, best of %d, one thread, cells of %.2f m\n  %-8s", title, repetitions, (double)cell_size,
                "");
    for (const char *stage : STAGES) {
        std::printf(" %9s", stage);
    }
    std::printf(" %8s\n", "peak MB");
}

void bench_watershed(bench_report *report, const std::vector<bench_level> &levels, int repetitions)
{
    bench b = { report, repetitions, {}, {} };
    for (const bench_level &level : levels) {
        b.run(level, "watershed");
    }
    b.print_sum("all levels");
    if (b.recast.ms[WHOLE] > 0) {
        b.claim("rasterize", { RASTERIZE }, 2.5);
        b.claim("filter + compact", { FLOORS }, 2.85);
        b.claim("erode + distance + watershed", { ERODE, DISTANCE, REGIONS }, 2.5);
        b.claim("contours + polygons", { CONTOURS, POLYGONS }, 2.5);
        b.claim("detail", { DETAIL }, 2.85);
        b.claim("whole build", { WHOLE }, 2.5);
        bench_report_speed(report, "whole build, the worst level", "Recast", 1.0 / b.worst, 2.5);
        bench_report_at_most(report, "peak memory, fraction of Recast's", b.talus.peak / b.recast.peak, 0.6);
    }
}

// Of whole levels: what layers cost Recast depends on the size of what it divides.
void bench_layers(bench_report *report, std::vector<bench_level> levels, int repetitions)
{
    bench b = { report, repetitions, {}, {} };
    for (bench_level &level : levels) {
        if (level.parts.size() > 1) {
            continue;
        }
        for (bench_part &part : level.parts) {
            part.config.partition = TL_NAV_LAYERS;
        }
        b.run(level, "layers");
    }
    b.print_sum("all levels");
    if (b.recast.ms[WHOLE] > 0) {
        b.claim("layers, whole build, levels of one part", { WHOLE }, 6.6);
    }
}

} // namespace

int main(int argc, char **argv)
{
    tl_nav_def def = tl_default_nav_def();
    uint32_t count = 5;
    const bench_option options[] = { { "cell-size", BENCH_NUMBER, &def.cell_size, "metres" },
                                     { "repetitions", BENCH_COUNT, &count, "of which the best counts" },
                                     { nullptr, BENCH_COUNT, nullptr, nullptr } };
    std::vector<const char *> words((size_t)argc);
    const char *json = nullptr;
    words.resize((size_t)bench_parse(argc, argv, options, words.data(), &json));
    const std::vector<std::string> files(words.begin(), words.end());
    const int repetitions = (int)count;
    std::vector<bench_level> levels = files.empty() ? default_levels(def) : levels_of_files(files, def);
    bench_report *report = bench_report_new("nav", "ms", nullptr);
    print_head("watershed", repetitions, def.cell_size);
    bench_watershed(report, levels, repetitions);
    print_head("layers", 1, def.cell_size);
    bench_layers(report, levels, 1);
    for (const bench_level &level : levels) {
        if (level.parts.size() > 1) {
            tl_nav_def tiled = def;
            tiled.tile_size = TILE_SIZE;
            bench_threads(report, level, tiled, repetitions);
        }
    }
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
