// SPDX-License-Identifier: MIT
//
// Queries around a place beside Detour's: on the very same polygons, in one process, runs taking turns.
//
//   bench_nav_around [--city TRIANGLES (200000)] [--places COUNT (2000)] [--runs RUNS (5)] [--only NAME] [--json FILE]
//
// The polygons are Recast's, so that both sides ask the same mesh. CPU time of one thread, the best run of each side.

#include "base/random.h"
#include "detour_mesh.hpp"
#include "io/mesh/mesh_import.h"
#include "measure.h"
#include "query_options.hpp"
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <talus/nav_around.h>

extern "C" {
#include "cli/sample/sample_level.h"
}

namespace
{

constexpr float RADIUS = 8.0f;
constexpr int MAX_FOUND = 4096;
constexpr int SLICE = 64;       // nodes
constexpr uint32_t POINTS = 64; // a call

uint64_t random_state = 11;

uint64_t random_bits()
{
    return tl_random_bits(&random_state);
}

float random_unit()
{
    return tl_random_unit_float(&random_state);
}

// A place and a goal as both sides know them.
struct place {
    dtPolyRef detour, detour_goal;
    float point[3], goal_point[3];
    tl_nav_location talus, goal;
};

struct arena {
    std::string name;
    detour_level level;
    std::unique_ptr<dtNavMeshQuery, detour_deleter> detour{ dtAllocNavMeshQuery() };
    std::unique_ptr<tl_nav_query, detour_deleter> query;
    dtQueryFilter filter;
    std::vector<place> places;
    std::vector<dtPolyRef> refs = std::vector<dtPolyRef>(MAX_FOUND), parents = std::vector<dtPolyRef>(MAX_FOUND);
    std::vector<float> costs = std::vector<float>(MAX_FOUND);
    std::vector<tl_nav_field_entry> entries = std::vector<tl_nav_field_entry>(MAX_FOUND);
    std::vector<tl_nav_ref> polygons = std::vector<tl_nav_ref>(MAX_FOUND);
    uint64_t checksum = 0; // so that nothing is optimised away

    bool locate(dtPolyRef *ref, float *point, tl_nav_location *out)
    {
        detour->findRandomPoint(&filter, random_unit, ref, point);
        tl_vec3 extents = { 0.1f, 0.5f, 0.1f };
        return tl_navmesh_find_nearest(level.twin.get(), nullptr, { point[0], point[1], point[2] }, extents, out) ==
               TL_OK;
    }

    bool prepare(size_t count)
    {
        uint32_t polygon_count = 0;
        for (uint32_t s = 0; s < tl_navmesh_slot_count(level.twin.get()); s++) {
            polygon_count += tl_navmesh_slot_tile(level.twin.get(), s)->polygon_count;
        }
        tl_nav_query_def def = tl_default_nav_query_def();
        def.max_nodes = std::max(def.max_nodes, 16 * polygon_count);
        tl_nav_query *made = nullptr;
        if (tl_nav_query_create(&def, &made, NULL) != TL_OK ||
            dtStatusFailed(detour->init(level.mesh.get(), polygon_count < 2048 ? 2048 : 65535))) {
            return false;
        }
        query.reset(made);
        while (places.size() < count) {
            place p;
            if (locate(&p.detour, p.point, &p.talus) && locate(&p.detour_goal, p.goal_point, &p.goal)) {
                places.push_back(p);
            }
        }
        std::printf("\n%s: %u tiles, %u polygons, %zu places\n", name.c_str(), tl_navmesh_tile_count(level.twin.get()),
                    polygon_count, places.size());
        return true;
    }
};

int runs = 5;
bench_report *report;

// Microseconds a question. Short runs are repeated to last a while.
double time_once(const arena &a, const std::function<void(const place &)> &ask)
{
    double begin = bench_thread_seconds(), seconds = 0.0;
    int repeats = 0;
    do {
        for (const place &p : a.places) {
            ask(p);
        }
        repeats++;
        seconds = bench_thread_seconds() - begin;
    } while (seconds < 0.02);
    return seconds * 1e6 / ((double)repeats * (double)a.places.size());
}

void compare(const arena &a, const char *what, const std::function<void(const place &)> &detour,
             const std::function<void(const place &)> &talus)
{
    double theirs = 1e30, ours = 1e30;
    for (int run = 0; run < runs; run++) {
        theirs = std::min(theirs, time_once(a, detour));
        ours = std::min(ours, time_once(a, talus));
    }
    std::printf("  %-22s Detour %9.3f us   talus %9.3f us   %6.2f times as fast, bar 1.0: %s\n", what, theirs, ours,
                theirs / ours, theirs >= ours ? "met" : "MISSED");
    bench_report_value(report, a.name.c_str(), "talus", what, ours);
    bench_report_value(report, a.name.c_str(), "Detour", what, theirs);
    bench_report_speed(report, (a.name + ": " + what).c_str(), "Detour", theirs / ours, 1.0);
}

void bench_random(arena &a)
{
    const tl_navmesh *navmesh = a.level.twin.get();
    compare(
        a, "random point",
        [&](const place &) {
            dtPolyRef ref;
            float point[3];
            a.detour->findRandomPoint(&a.filter, random_unit, &ref, point);
            a.checksum += ref;
        },
        [&](const place &) {
            const uint64_t bits[2] = { random_bits(), random_bits() };
            tl_nav_location at;
            tl_navmesh_random_point(navmesh, nullptr, bits, &at);
            a.checksum += at.polygon;
        });
    compare(
        a, "random reachable",
        [&](const place &p) {
            dtPolyRef ref;
            float point[3];
            a.detour->findRandomPointAroundCircle(p.detour, p.point, RADIUS, &a.filter, random_unit, &ref, point);
            a.checksum += ref;
        },
        [&](const place &p) {
            const uint64_t bits[2] = { random_bits(), random_bits() };
            tl_nav_location at;
            const tl_nav_around_request request = { nullptr, p.talus, RADIUS };
            tl_nav_query_random_reachable(a.query.get(), navmesh, &request, bits, &at);
            a.checksum += at.polygon;
        });
    compare(
        a, "64 random reachable",
        [&](const place &p) {
            for (uint32_t i = 0; i < POINTS; i++) {
                dtPolyRef ref;
                float point[3];
                a.detour->findRandomPointAroundCircle(p.detour, p.point, RADIUS, &a.filter, random_unit, &ref, point);
                a.checksum += ref;
            }
        },
        [&](const place &p) {
            uint64_t bits[2 * POINTS];
            for (uint64_t &number : bits) {
                number = random_bits();
            }
            tl_nav_location at[POINTS];
            const tl_nav_around_request request = { nullptr, p.talus, RADIUS };
            tl_nav_query_random_reachable_points(a.query.get(), navmesh, &request, bits, POINTS, at);
            a.checksum += at[0].polygon;
        });
}

void bench_around(arena &a)
{
    const tl_navmesh *navmesh = a.level.twin.get();
    compare(
        a, "polygons in circle",
        [&](const place &p) {
            int count = 0;
            a.detour->findPolysAroundCircle(p.detour, p.point, RADIUS, &a.filter, a.refs.data(), a.parents.data(),
                                            a.costs.data(), &count, MAX_FOUND);
            a.checksum += (uint64_t)count;
        },
        [&](const place &p) {
            tl_nav_zone zone = tl_nav_zone_circle(p.talus.point, RADIUS);
            tl_nav_field_def field = tl_default_nav_field_def();
            field.zone = &zone;
            uint32_t count = 0;
            tl_nav_query_flood(a.query.get(), navmesh, &p.talus, &field, a.entries.data(), MAX_FOUND, &count);
            a.checksum += count;
        });
    compare(
        a, "walls of a polygon",
        [&](const place &p) {
            float segments[6 * 64];
            int count = 0;
            a.detour->getPolyWallSegments(p.detour, &a.filter, segments, nullptr, &count, 64);
            a.checksum += (uint64_t)count;
        },
        [&](const place &p) {
            tl_nav_wall_segment segments[64];
            uint32_t count = 0;
            tl_navmesh_polygon_walls(navmesh, nullptr, p.talus.polygon, segments, 64, &count);
            a.checksum += count;
        });
}

void bench_sliced(arena &a)
{
    const tl_navmesh *navmesh = a.level.twin.get();
    compare(
        a, "path in slices",
        [&](const place &p) {
            int done = 0, count = 0;
            dtStatus status = a.detour->initSlicedFindPath(p.detour, p.detour_goal, p.point, p.goal_point, &a.filter);
            while (dtStatusInProgress(status)) {
                status = a.detour->updateSlicedFindPath(SLICE, &done);
            }
            a.detour->finalizeSlicedFindPath(a.refs.data(), &count, MAX_FOUND);
            a.checksum += (uint64_t)count;
        },
        [&](const place &p) {
            tl_nav_path_progress progress;
            tl_nav_path path;
            const tl_nav_path_request request = { nullptr, p.talus, p.goal };
            tl_nav_query_begin_path(a.query.get(), navmesh, &request);
            do {
                tl_nav_query_step_path(a.query.get(), SLICE, &progress);
            } while (progress.status == TL_NAV_PATH_UNFINISHED);
            tl_nav_query_write_path(a.query.get(), a.polygons.data(), MAX_FOUND, &path);
            a.checksum += path.polygon_count;
        });
}

// How far each side's random points are from even: the least and the most that a tile gets of its share, by area.
void compare_evenness(arena &a)
{
    const tl_navmesh *navmesh = a.level.twin.get();
    uint32_t tiles = tl_navmesh_tile_count(navmesh);
    if (tiles < 2) {
        return;
    }
    const size_t draws = 2000 * (size_t)tiles;
    std::vector<double> share(tiles), ours(tiles), theirs(tiles);
    double total = 0.0;
    for (uint32_t s = 0; s < tiles; s++) {
        share[s] = tl_navmesh_slot_tile(navmesh, s)->area;
        total += share[s];
    }
    for (size_t i = 0; i < draws; i++) {
        const uint64_t bits[2] = { random_bits(), random_bits() };
        tl_nav_location at;
        dtPolyRef ref;
        float point[3];
        tl_navmesh_random_point(navmesh, nullptr, bits, &at);
        ours[(at.polygon >> 28) & 0xfffff] += 1.0;
        a.detour->findRandomPoint(&a.filter, random_unit, &ref, point);
        theirs[a.level.mesh->decodePolyIdTile(ref) % tiles] += 1.0;
    }
    auto spread = [&](const std::vector<double> &met, double *least, double *most) {
        *least = 1e30;
        *most = 0.0;
        for (uint32_t s = 0; s < tiles; s++) {
            double expected = (double)draws * share[s] / total;
            if (expected > 400.0) {
                *least = std::min(*least, met[s] / expected);
                *most = std::max(*most, met[s] / expected);
            }
        }
    };
    double least[2], most[2];
    spread(theirs, &least[0], &most[0]);
    spread(ours, &least[1], &most[1]);
    std::printf("  %-22s of its share by area a tile gets: Detour %.2f to %.2f, talus %.2f to %.2f\n", "evenness",
                least[0], most[0], least[1], most[1]);
}

void bench_level(const std::string &name, const tl_mesh_view &view, uint32_t tile_size, size_t places)
{
    tl_aabb bounds = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)view.triangle_count; i++) {
        bounds = tl_aabb_add_point(bounds, view.vertices[view.indices[i]]);
    }
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    arena a;
    a.name = name + (tile_size > 0 ? " in tiles of " + std::to_string(tile_size) : "");
    if (!a.level.build(def, view, bounds) || !a.level.twin_is_whole || !a.prepare(places)) {
        std::printf("\n%s: left out, Recast made no mesh of it that both sides know\n", a.name.c_str());
        return;
    }
    bench_random(a);
    bench_around(a);
    bench_sliced(a);
    compare_evenness(a);
}

void bench_file(const std::string &name, uint32_t tile_size, size_t places)
{
    tl_imported_mesh mesh;
    std::string path = std::string(TALUS_DATA_DIR) + "/levels/" + name + ".obj";
    if (tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) == TL_OK) {
        bench_level(name, tl_imported_mesh_as_view(&mesh), tile_size, places);
        tl_imported_mesh_free(&mesh);
    }
}

void bench_sample(const char *name, uint32_t triangles, uint32_t tile_size, size_t places)
{
    const tl_sample_level *sample = tl_sample_find_level(name);
    tl_sample_mesh mesh;
    if (sample != nullptr && tl_sample_build_level(sample, triangles, 1, &mesh) == TL_OK) {
        bench_level(name, tl_sample_mesh_as_view(&mesh), tile_size, places);
        tl_sample_mesh_free(&mesh);
    }
}

} // namespace

int main(int argc, char **argv)
{
    query_options options;
    options.count = 2000;
    options.city_triangles = 200000;
    const char *json = options.parse(argc, argv, "places");
    report = bench_report_new("nav_around", "us", nullptr);
    runs = (int)options.runs;
    for (const char *name : { "nav_test", "dungeon", "undulating" }) {
        if (options.wants(name)) {
            bench_file(name, 0, options.count);
            bench_file(name, 48, options.count);
        }
    }
    if (options.wants("city")) {
        bench_sample("city", options.city_triangles, 64, options.count);
    }
    std::printf("\n");
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
