// SPDX-License-Identifier: MIT
//
// The navmesh build stage by stage, with Recast in the same process on the same settings where it is installed.
//
//   bench_nav [LEVEL.obj ...] [--repetitions N (3)] [--stages 1] [--cell-size METRES (0.3)] [--json FILE]
//
// Without levels: the built-in ones, those of the data folder, and a city of a million triangles in tiles of 64 cells.
// Each level gets a line for each setting, ratios to Recast: time, peak memory, walkable floors after erosion; and how
// many times as fast two threads are as one. Their geometric mean and the worst level are what is claimed. --stages 1
// shows every stage of every level in cells of --cell-size too, and the sums.
// CPU time of one thread, the best of the repetitions, which alternate. `whole` is the build as users call it, for
// Recast the sum of its stages. Memory is the most that was held at one time, counted by the allocator hooks of both;
// each piece is freed when its last reader is done. A tiled level's memory is that of its largest tile.

#include "bench_options.h"
#include "measure.h"
#include "nav_levels.hpp"
#include "report.h"
#include "second_thread.hpp"

#ifdef TALUS_HAVE_RECAST
#include "recast_pipeline.hpp"
#include <recastnavigation/RecastAlloc.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

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

// Walkable floors after erosion.
double talus_floors(const bench_part &part)
{
    const tl_mesh_view mesh = part.mesh.view();
    tl_nav_stages s = {};
    double floors = 0;
    if (!tl_nav_rasterize(&part.config, &mesh, nullptr, nullptr, &s.heightfield, nullptr) &&
        !tl_nav_filter_and_compact(&part.config, &s.heightfield, nullptr, &s.compact, nullptr) &&
        !tl_nav_erode(&part.config, nullptr, &s.compact, nullptr)) {
        floors = (double)std::count_if(s.compact.area, s.compact.area + s.compact.span_count,
                                       [](uint8_t area) { return area != TL_NAV_NULL_AREA; });
    }
    tl_nav_stages_free(&s);
    return floors;
}

double recast_floors(const bench_part &part)
{
#ifdef TALUS_HAVE_RECAST
    recast_pipeline recast;
    if (recast.rasterize(part.config, part.mesh.view(), 45.0f) && recast.filter(part.config) &&
        recast.build_compact(part.config) && recast.erode(part.config)) {
        return (double)std::count_if(recast.compact->areas, recast.compact->areas + recast.compact->spanCount,
                                     [](unsigned char area) { return area != RC_NULL_AREA; });
    }
#endif
    (void)part;
    return 0;
}

// ---- Two threads -------------------------------------------------------------------------------------------

// Wall milliseconds of a level's build, in tiles or in one piece.
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

// How many times as fast two threads are as one.
double thread_speed(const bench_level &level, const tl_nav_def &def, int repetitions)
{
    second_thread second;
    const tl_tasks two = second.tasks();
    double alone = 1e9, together = 1e9;
    for (int r = 0; r < repetitions; r++) {
        alone = std::min(alone, wall_ms(level, def, nullptr));
        together = std::min(together, wall_ms(level, def, &two));
    }
    return alone / together;
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

// ---- Ratios, a level a line ----------------------------------------------------------------------------------

struct setting {
    const char *name;
    float cell_size;
    tl_nav_partition partition;
    double mean_bar, worst_bar; ///< of the time
};

const setting SETTINGS[] = { { "0.3 m watershed", 0.3f, TL_NAV_WATERSHED, 0.22, 0.4 },
                             { "0.1 m watershed", 0.1f, TL_NAV_WATERSHED, 0.18, 0.35 },
                             { "0.1 m monotone", 0.1f, TL_NAV_MONOTONE, 0.2, 0.35 } };
const setting CITY = { "city in tiles of 64", 0.3f, TL_NAV_WATERSHED, 0.2, 0.35 };
/// A part with more columns takes Recast minutes and gigabytes: its line says so.
constexpr uint64_t MOST_COLUMNS = 16000000;

// Ratios to Recast: their geometric mean, and the worst.
struct ratios {
    double log_sum = 0, worst = 0;
    int count = 0;

    void add(double ratio)
    {
        log_sum += std::log(ratio);
        worst = std::max(worst, ratio);
        count++;
    }

    double mean() const
    {
        return count > 0 ? std::exp(log_sum / count) : 0;
    }
};

// The best of the repetitions of whole builds, which alternate; false when one of them fails.
bool time_both(const bench_level &level, int repetitions, figures *ours, figures *theirs)
{
    for (int r = 0; r < repetitions; r++) {
        figures our_sum, their_sum;
        for (const bench_part &part : level.parts) {
            if (!time_whole(part, &our_sum) || !run_recast(part, &their_sum)) {
                return false;
            }
        }
        r == 0 ? ours->add(our_sum) : ours->keep_best(our_sum);
        r == 0 ? theirs->add(their_sum) : theirs->keep_best(their_sum);
    }
    return true;
}

struct level_ratios {
    ratios time, memory, threads;
    double largest_difference = 0; ///< of walkable floors, a fraction
};

void ratio_line(const bench_level &level, const tl_nav_def &def, int repetitions, level_ratios *all)
{
    std::printf("  %-46s", level.name.c_str());
    for (const bench_part &part : level.parts) {
        if ((uint64_t)part.config.width * part.config.height > MOST_COLUMNS) {
            std::printf(" left out: %u x %u columns\n", part.config.width, part.config.height);
            return;
        }
    }
    figures ours, theirs;
    if (!time_both(level, repetitions, &ours, &theirs)) {
        std::printf(" no result from one of the two\n");
        return;
    }
    double our_floors = 0, their_floors = 0;
    for (const bench_part &part : level.parts) {
        ours.peak = std::max(ours.peak, talus_peak(part));
        theirs.peak = std::max(theirs.peak, recast_peak(part));
        our_floors += talus_floors(part);
        their_floors += recast_floors(part);
    }
    const double speed = thread_speed(level, def, repetitions);
    const double time = ours.ms[WHOLE] / theirs.ms[WHOLE], memory = ours.peak / theirs.peak;
    all->time.add(time);
    all->memory.add(memory);
    all->threads.add(speed);
    all->largest_difference = std::max(all->largest_difference, std::fabs(our_floors / their_floors - 1));
    std::printf(" %9.2f %9.2f %7.2f %8.3f %8.2f %9.4f %8.2f\n", ours.ms[WHOLE], theirs.ms[WHOLE], time,
                ours.peak * 1e-6, memory, our_floors / their_floors, speed);
}

void bench_ratios(bench_report *report, const std::vector<bench_level> &levels, tl_nav_def def, const setting &s,
                  int repetitions)
{
    std::printf("%s, best of %d\n  %-46s %9s %9s %7s %8s %8s %9s %8s\n", s.name, repetitions, "", "ms", "Recast",
                "time", "peak MB", "memory", "floors", "threads");
    level_ratios all;
    for (const bench_level &level : levels) {
        ratio_line(level, def, repetitions, &all);
    }
    if (all.time.count == 0) {
        return;
    }
    std::printf("  %-46s %9s %9s %7.3f %8s %8.3f %9s %8.2f\n  %-46s %9s %9s %7.2f %8s %8.2f %8.2f%%\n",
                "geometric mean", "", "", all.time.mean(), "", all.memory.mean(), "", all.threads.mean(), "worst", "",
                "", all.time.worst, "", all.memory.worst, 100 * all.largest_difference);
    const std::string name = s.name;
    bench_report_at_most(report, (name + ": time, fraction of Recast's, mean").c_str(), all.time.mean(), s.mean_bar);
    bench_report_at_most(report, (name + ": time, worst level").c_str(), all.time.worst, s.worst_bar);
    bench_report_at_most(report, (name + ": peak memory, mean").c_str(), all.memory.mean(), 0.5);
    bench_report_at_most(report, (name + ": peak memory, worst level").c_str(), all.memory.worst, 1.0);
    bench_report_at_most(report, (name + ": walkable floors, difference").c_str(), all.largest_difference, 0.005);
    bench_report_at_least(report, (name + ": two threads").c_str(), all.threads.mean(), 1.7);
}

void bench_setting(bench_report *report, const std::vector<std::string> &files, const setting &s, int repetitions)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = s.cell_size;
    def.partition = s.partition;
    const bool tiled = &s == &CITY;
    const std::vector<bench_level> levels = tiled           ? city_in_tiles(def)
                                            : files.empty() ? default_levels(def)
                                                            : levels_of_files(files, def);
    def.tile_size = tiled ? TILE_SIZE : 0;
    bench_ratios(report, levels, def, s, repetitions);
}

void bench_stages(bench_report *report, const std::vector<std::string> &files, const tl_nav_def &def, int repetitions)
{
    const std::vector<bench_level> levels = files.empty() ? default_levels(def) : levels_of_files(files, def);
    print_head("watershed", repetitions, def.cell_size);
    bench_watershed(report, levels, repetitions);
    print_head("layers", 1, def.cell_size);
    bench_layers(report, levels, 1);
}

} // namespace

int main(int argc, char **argv)
{
    tl_nav_def def = tl_default_nav_def();
    uint32_t count = 3, stages = 0;
    const bench_option options[] = { { "cell-size", BENCH_NUMBER, &def.cell_size, "metres, of the stages" },
                                     { "repetitions", BENCH_COUNT, &count, "of which the best counts" },
                                     { "stages", BENCH_COUNT, &stages, "1: every stage too" },
                                     { nullptr, BENCH_COUNT, nullptr, nullptr } };
    std::vector<const char *> words((size_t)argc);
    const char *json = nullptr;
    words.resize((size_t)bench_parse(argc, argv, options, words.data(), &json));
    const std::vector<std::string> files(words.begin(), words.end());
    const int repetitions = (int)count;
    bench_report *report = bench_report_new("nav", "ms", nullptr);
    for (const setting &s : SETTINGS) {
        bench_setting(report, files, s, repetitions);
    }
    if (files.empty()) {
        bench_setting(report, files, CITY, repetitions);
    }
    if (stages > 0) {
        bench_stages(report, files, def, repetitions);
    }
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
