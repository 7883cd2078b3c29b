// SPDX-License-Identifier: MIT
//
// Navmesh queries beside Detour's: on the very same polygons, in one process, runs taking turns.
//
//   bench_query [--city TRIANGLES (1000000)] [--pairs COUNT (10000)] [--runs RUNS (5)] [--only NAME]
//               [--prepared 1 (searches on prepared navmeshes alone)] [--table 1 (the table over all levels alone)]
//               [--json FILE]
//
// Pairs: the recorded ones of the data folder, and 10,000 seeded ones on the built-in city in tiles. The polygons are
// Recast's, so that both sides search the same mesh. CPU time of one thread, the best run of each side. Lengths are
// compared in the plan (x and z), in which both sides pull their paths straight.

#include "base/random.h"
#include "detour_mesh.hpp"
#include "io/mesh/mesh_import.h"
#include "measure.h"
#include "query_options.hpp"
#include "query_table.hpp"
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <talus/nav_prepare.h>

extern "C" {
#include "cli/sample/sample_level.h"
}

namespace
{

const tl_vec3 EXTENTS = { 2.0f, 4.0f, 2.0f };
constexpr int MAX_POLYGONS = 2048;
constexpr float WALL_RADIUS = 10.0f;

// What is asked.
struct question {
    tl_vec3 start, goal, near_point, target;
};

// The same place as both sides know it.
struct place {
    dtPolyRef detour = 0;
    float detour_point[3] = {};
    tl_nav_location talus = {};
};

struct located_pair {
    place start, goal;
    tl_vec3 near_point, target;
    bool complete = false;
    double moved = 0.0; // metres: Detour moves ends that lie outside its polygon; far moved, lengths say nothing
    double detour_length = 0.0;
};

uint64_t random_state = 1;

float random_unit()
{
    return tl_random_unit_float(&random_state);
}

double plan_length(const float *points, size_t count, size_t stride)
{
    double length = 0.0;
    for (size_t i = 1; i < count; i++) {
        const float *a = points + (i - 1) * stride, *b = points + i * stride;
        length += std::hypot((double)b[0] - (double)a[0], (double)b[2] - (double)a[2]);
    }
    return length;
}

double plan_distance(const float *point, tl_vec3 place)
{
    return std::hypot((double)point[0] - (double)place.x, (double)point[2] - (double)place.z);
}

// One level with everything that its queries need.
struct arena {
    std::string name;
    detour_level level;
    std::unique_ptr<dtNavMeshQuery, detour_deleter> detour{ dtAllocNavMeshQuery() };
    std::unique_ptr<tl_nav_query, detour_deleter> talus;
    std::vector<located_pair> pairs;
    std::vector<size_t> complete, incomplete; // of pairs
    dtQueryFilter filter;
    std::vector<dtPolyRef> detour_polygons = std::vector<dtPolyRef>(MAX_POLYGONS);
    std::vector<float> detour_corners = std::vector<float>(3 * MAX_POLYGONS);
    std::vector<tl_nav_ref> polygons = std::vector<tl_nav_ref>(1 << 16);
    std::vector<tl_nav_corner> corners = std::vector<tl_nav_corner>(1 << 16);
    uint64_t checksum = 0; // so that nothing is optimised away

    const tl_navmesh *navmesh() const
    {
        return level.twin.get();
    }

    bool locate(tl_vec3 point, place *out)
    {
        detour->findNearestPoly(&point.x, &EXTENTS.x, &filter, &out->detour, out->detour_point);
        if (out->detour == 0) {
            return false;
        }
        tl_vec3 on_mesh = { out->detour_point[0], out->detour_point[1], out->detour_point[2] };
        if (tl_navmesh_find_nearest(navmesh(), nullptr, on_mesh, EXTENTS, &out->talus) != TL_OK) {
            return false;
        }
        std::memcpy(out->detour_point, &out->talus.point, sizeof out->detour_point);
        return true;
    }

    int detour_path(const located_pair &p, bool *complete_out)
    {
        int count = 0, corner_count = 0;
        detour->findPath(p.start.detour, p.goal.detour, p.start.detour_point, p.goal.detour_point, &filter,
                         detour_polygons.data(), &count, MAX_POLYGONS);
        *complete_out = count > 0 && detour_polygons[(size_t)count - 1] == p.goal.detour;
        if (*complete_out) {
            detour->findStraightPath(p.start.detour_point, p.goal.detour_point, detour_polygons.data(), count,
                                     detour_corners.data(), nullptr, nullptr, &corner_count, MAX_POLYGONS);
        }
        return corner_count;
    }

    uint32_t talus_path(const located_pair &p)
    {
        tl_nav_path path;
        uint32_t count = 0;
        const tl_nav_path_request request = { nullptr, p.start.talus, p.goal.talus };
        if (tl_nav_query_find_path(talus.get(), navmesh(), &request, polygons.data(), (uint32_t)polygons.size(),
                                   &path) != TL_OK ||
            path.status != TL_NAV_PATH_COMPLETE) {
            return 0;
        }
        const tl_nav_polygon_path found = { polygons.data(), path.polygon_count, p.start.talus.point,
                                            p.goal.talus.point };
        tl_navmesh_straight_path(navmesh(), &found, corners.data(), (uint32_t)corners.size(), &count, nullptr);
        return count;
    }

    // Length in the plane, < 0 without a path; `*corner_count_out` counts for the checksum.
    double shortest_path(const located_pair &p, uint32_t *corner_count_out)
    {
        tl_nav_shortest_path path;
        const tl_nav_path_request request = { nullptr, p.start.talus, p.goal.talus };
        const tl_nav_path_buffers buffers = { polygons.data(), (uint32_t)polygons.size(), corners.data(),
                                              (uint32_t)corners.size() };
        tl_nav_query_find_shortest_path(talus.get(), navmesh(), &request, &buffers, &path);
        *corner_count_out = path.corner_count;
        return path.status == TL_NAV_PATH_COMPLETE ? path.length : -1.0;
    }

    bool prepare(const std::vector<question> &questions)
    {
        uint32_t polygon_count = 0;
        for (uint32_t s = 0; s < tl_navmesh_slot_count(navmesh()); s++) {
            polygon_count += tl_navmesh_slot_tile(navmesh(), s)->polygon_count;
        }
        tl_nav_query_def def = tl_default_nav_query_def();
        tl_nav_query *query = nullptr;
        // Exact searches over a whole city use many nodes. Those that are not used cost nothing.
        def.max_nodes = std::max(def.max_nodes, 16 * polygon_count);
        // Detour's pool has the usual 2048 nodes where they suffice: it is cleared by every search.
        if (tl_nav_query_create(&def, &query, NULL) != TL_OK ||
            dtStatusFailed(detour->init(level.mesh.get(), polygon_count < 2048 ? 2048 : 65535))) {
            return false;
        }
        talus.reset(query);
        for (const question &q : questions) {
            located_pair p;
            if (!locate(q.start, &p.start) || !locate(q.goal, &p.goal)) {
                continue;
            }
            p.near_point = q.near_point;
            p.target = q.target;
            int corner_count = detour_path(p, &p.complete);
            p.detour_length = plan_length(detour_corners.data(), (size_t)corner_count, 3);
            if (corner_count > 1) {
                p.moved = plan_distance(&detour_corners[0], p.start.talus.point) +
                          plan_distance(&detour_corners[3 * (size_t)corner_count - 3], p.goal.talus.point);
            }
            (p.complete ? complete : incomplete).push_back(pairs.size());
            pairs.push_back(p);
        }
        std::printf("\n%s: %u tiles, %u polygons, %zu pairs, %zu of them without a path\n", name.c_str(),
                    tl_navmesh_tile_count(navmesh()), polygon_count, pairs.size(), incomplete.size());
        return true;
    }
};

int runs = 5;
bool prepared_only = false; // so that a large level need not be searched polygon by polygon
bench_report *report;
std::string current; // the level at hand

// The best time of a run over all indices, in microseconds a query. Short runs are repeated to last a while.
double time_once(const std::vector<size_t> &indices, const std::function<void(size_t)> &query)
{
    double begin = bench_thread_seconds(), seconds = 0.0;
    int repeats = 0;
    do {
        for (size_t i : indices) {
            query(i);
        }
        repeats++;
        seconds = bench_thread_seconds() - begin;
    } while (seconds < 0.02);
    return seconds * 1e6 / ((double)repeats * (double)indices.size());
}

// Both sides in turns; prints a row with the ratio of their speeds and whether it reaches the bar.
void compare(const char *what, double bar, const std::vector<size_t> &indices,
             const std::function<void(size_t)> &detour, const std::function<void(size_t)> &talus)
{
    if (indices.empty()) {
        return;
    }
    double theirs = 1e30, ours = 1e30;
    for (int run = 0; run < runs; run++) {
        theirs = std::min(theirs, time_once(indices, detour));
        ours = std::min(ours, time_once(indices, talus));
    }
    std::printf("  %-29s Detour %9.3f us   talus %9.3f us   %6.2f times as fast, bar %.1f: %s\n", what, theirs, ours,
                theirs / ours, bar, theirs >= bar * ours ? "met" : "MISSED");
    bench_report_value(report, current.c_str(), "talus", what, ours);
    bench_report_value(report, current.c_str(), "Detour", what, theirs);
    bench_report_speed(report, (current + ": " + what).c_str(), "Detour", theirs / ours, bar);
}

// How the lengths of complete paths compare. Rounding: both sides hold corners in floats.
void compare_lengths(const arena &a, const char *what, const std::vector<double> &lengths)
{
    double sum = 0.0, most = 0.0;
    size_t longer = 0, lost = 0, compared = 0;
    std::vector<double> ratios;
    for (size_t k = 0; k < a.complete.size(); k++) {
        double theirs = a.pairs[a.complete[k]].detour_length, ours = lengths[k];
        if (ours < 0.0) {
            lost++;
            continue;
        }
        double moved = a.pairs[a.complete[k]].moved;
        if (moved > 1e-3) {
            continue;
        }
        compared++;
        // Half a float's step at these coordinates, for each end of a leg.
        const tl_vec3 &place = a.pairs[a.complete[k]].goal.talus.point;
        double rounding = 2.5e-7 * (std::fabs((double)place.x) + std::fabs((double)place.z)) + 1e-5 * (1.0 + theirs);
        longer += ours > theirs + moved + rounding;
        if (theirs > 1.0) {
            ratios.push_back(theirs / ours);
            sum += theirs / ours;
            most = std::max(most, ours / theirs);
        }
    }
    if (ratios.empty()) {
        return;
    }
    std::sort(ratios.begin(), ratios.end());
    auto quantile = [&](double q) { return ratios[(size_t)(q * (double)(ratios.size() - 1))]; };
    std::printf("  %-22s %zu compared: Detour's are longer by %.3f%% on average, 99%% quantile %.2f%%, most %.2f%%; "
                "talus longer in %zu (at most %.6fx), no path in %zu   %s\n",
                what, compared, 100.0 * (sum / (double)ratios.size() - 1.0), 100.0 * (quantile(0.99) - 1.0),
                100.0 * (quantile(1.0) - 1.0), longer, most, lost, longer + lost == 0 ? "met" : "MISSED");
}

std::vector<size_t> all_indices(const arena &a)
{
    std::vector<size_t> all(a.pairs.size());
    for (size_t i = 0; i < all.size(); i++) {
        all[i] = i;
    }
    return all;
}

// `how` tells the rows of a prepared navmesh from the others. Polygons and corners of the shortest path: one call of
// ours answers what takes two of Detour's; the two that answer as Detour's do stand beside it.
void bench_paths(arena &a, double bar, const std::string &how)
{
    auto detour = [&](size_t i) {
        bool complete;
        a.checksum += (uint64_t)a.detour_path(a.pairs[i], &complete);
    };
    compare(("path + straight" + how).c_str(), bar, a.complete, detour, [&](size_t i) {
        uint32_t count;
        a.shortest_path(a.pairs[i], &count);
        a.checksum += count;
    });
    compare(("path, then straight" + how).c_str(), 1.0, a.complete, detour,
            [&](size_t i) { a.checksum += a.talus_path(a.pairs[i]); });
    std::vector<double> lengths;
    for (size_t i : a.complete) {
        uint32_t count = a.talus_path(a.pairs[i]);
        lengths.push_back(
            count == 0 ? -1.0 : plan_length(&a.corners[0].point.x, count, sizeof(tl_nav_corner) / sizeof(float)));
    }
    compare_lengths(a, ("lengths, two calls" + how).c_str(), lengths);
    lengths.clear();
    for (size_t i : a.complete) {
        uint32_t count;
        lengths.push_back(a.shortest_path(a.pairs[i], &count));
    }
    compare_lengths(a, ("lengths" + how).c_str(), lengths);
}

// Islands make these instant; a prepared navmesh has no part in it.
void bench_unreachable(arena &a)
{
    compare(
        "unreachable", 1.0, a.incomplete,
        [&](size_t i) {
            bool complete;
            a.checksum += (uint64_t)a.detour_path(a.pairs[i], &complete);
        },
        [&](size_t i) { a.checksum += a.talus_path(a.pairs[i]); });
}

// The searches again, over the visibility graph.
void bench_prepared(arena &a, double bar)
{
    double begin = bench_thread_seconds();
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    tl_nav_prepared made;
    if (tl_navmesh_prepare(a.level.twin.get(), &def, &made) != TL_OK || !tl_navmesh_is_prepared(a.navmesh())) {
        std::printf("  prepared               no visibility graph\n");
        return;
    }
    std::printf("  prepared               in %.2f ms: %s, %u corner vertices, %u edges, %.2f MB\n",
                1e3 * (bench_thread_seconds() - begin), tl_nav_prepared_kind_name(made.kind), made.corner_vertex_count,
                made.edge_count, 1e-6 * (double)made.bytes);
    bench_paths(a, bar, ", prepared");
}

void bench_places(arena &a)
{
    std::vector<size_t> all = all_indices(a);
    compare(
        "nearest", 1.0, all,
        [&](size_t i) {
            dtPolyRef ref;
            float point[3];
            a.detour->findNearestPoly(&a.pairs[i].near_point.x, &EXTENTS.x, &a.filter, &ref, point);
            a.checksum += ref;
        },
        [&](size_t i) {
            tl_nav_location found;
            tl_navmesh_find_nearest(a.navmesh(), nullptr, a.pairs[i].near_point, EXTENTS, &found);
            a.checksum += found.polygon;
        });
    compare(
        "slide", 1.0, all,
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            float end[3];
            int count;
            a.detour->moveAlongSurface(p.start.detour, p.start.detour_point, &p.target.x, &a.filter, end,
                                       a.detour_polygons.data(), &count, 64);
            a.checksum += (uint64_t)count;
        },
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            const tl_nav_move_request request = { nullptr, p.start.talus, p.target };
            tl_nav_move move;
            tl_nav_query_move_along_surface(a.talus.get(), a.navmesh(), &request, a.polygons.data(), 64, &move);
            a.checksum += move.polygon_count;
        });
    compare(
        "wall distance", 1.0, all,
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            float distance, point[3], normal[3];
            a.detour->findDistanceToWall(p.start.detour, p.start.detour_point, WALL_RADIUS, &a.filter, &distance, point,
                                         normal);
            a.checksum += (uint64_t)distance;
        },
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            const tl_nav_around_request request = { nullptr, p.start.talus, WALL_RADIUS };
            tl_nav_wall wall;
            tl_nav_query_find_wall(a.talus.get(), a.navmesh(), &request, &wall);
            a.checksum += (uint64_t)wall.distance;
        });
    compare(
        "surface ray", 1.0, all,
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            float t, normal[3];
            int count;
            a.detour->raycast(p.start.detour, p.start.detour_point, p.goal.detour_point, &a.filter, &t, normal,
                              a.detour_polygons.data(), &count, MAX_POLYGONS);
            a.checksum += (uint64_t)count;
        },
        [&](size_t i) {
            const located_pair &p = a.pairs[i];
            tl_nav_ray_hit hit;
            tl_navmesh_cast_ray(a.navmesh(), nullptr, &p.start.talus, p.goal.talus.point, a.polygons.data(),
                                MAX_POLYGONS, &hit);
            a.checksum += hit.polygon_count;
        });
}

// Where slides and walls are not Detour's.
void compare_places(arena &a)
{
    size_t slides = 0, walls = 0;
    for (const located_pair &p : a.pairs) {
        float end[3], distance, point[3], normal[3];
        int count;
        const tl_nav_move_request move_request = { nullptr, p.start.talus, p.target };
        const tl_nav_around_request wall_request = { nullptr, p.start.talus, WALL_RADIUS };
        tl_nav_move own_move;
        tl_nav_wall wall;
        a.detour->moveAlongSurface(p.start.detour, p.start.detour_point, &p.target.x, &a.filter, end,
                                   a.detour_polygons.data(), &count, 64);
        tl_nav_query_move_along_surface(a.talus.get(), a.navmesh(), &move_request, nullptr, 0, &own_move);
        double theirs = plan_distance(end, p.target), ours = plan_distance(&own_move.end.point.x, p.target);
        slides += ours > theirs + 2e-3;
        a.detour->findDistanceToWall(p.start.detour, p.start.detour_point, WALL_RADIUS, &a.filter, &distance, point,
                                     normal);
        tl_nav_query_find_wall(a.talus.get(), a.navmesh(), &wall_request, &wall);
        walls += std::fabs((double)wall.distance - (double)distance) > 2e-3;
    }
    std::printf("  %-22s of %zu slides %zu end farther from their target than Detour's, %zu wall distances differ\n",
                "agreement", a.pairs.size(), slides, walls);
}

void bench_arena(arena &a, const std::vector<question> &questions, double path_bar)
{
    if (!a.level.twin_is_whole) {
        std::printf("\n%s: left out, Recast made an invalid polygon\n", a.name.c_str());
        return;
    }
    if (!a.prepare(questions)) {
        std::printf("\n%s: no queries\n", a.name.c_str());
        return;
    }
    current = a.name;
    if (!prepared_only) {
        bench_paths(a, 1.0, "");
        bench_unreachable(a);
        bench_places(a);
        compare_places(a);
    }
    bench_prepared(a, path_bar);
}

tl_aabb bounds_of(const tl_mesh_view &mesh)
{
    tl_aabb bounds = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)mesh.triangle_count; i++) {
        bounds = tl_aabb_add_point(bounds, mesh.vertices[mesh.indices[i]]);
    }
    return bounds;
}

tl_nav_def make_def(float cell_size, uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    def.tile_size = tile_size;
    return def;
}

// A file of pairs: a header, then a line a pair of four points, and behind a bar what Detour once answered.
void bench_recorded(const std::string &file, size_t max_pairs)
{
    std::ifstream in(std::string(TALUS_DATA_DIR) + "/queries/" + file + ".txt");
    std::string line, mesh_name;
    unsigned tile_size = 0;
    float cell_size = 0.3f;
    while (std::getline(in, line) && line[0] != '#') {
        char name[64];
        if (std::sscanf(line.c_str(), "mesh %63s", name) == 1) {
            mesh_name = name;
        }
        std::sscanf(line.c_str(), "tile %u", &tile_size);
        std::sscanf(line.c_str(), "cs %f", &cell_size);
    }
    std::vector<question> questions;
    while (questions.size() < max_pairs && std::getline(in, line)) {
        question q;
        float *numbers[] = { &q.start.x, &q.goal.x, &q.near_point.x, &q.target.x };
        const char *at = line.c_str();
        for (float *number : numbers) {
            for (int k = 0; k < 3; k++) {
                char *end = nullptr;
                number[k] = std::strtof(at, &end);
                at = end;
            }
        }
        questions.push_back(q);
    }
    tl_imported_mesh mesh;
    std::string path = std::string(TALUS_DATA_DIR) + "/levels/" + mesh_name + ".obj";
    if (questions.empty() || tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) != TL_OK) {
        return;
    }
    tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
    arena a;
    a.name = file;
    if (a.level.build(make_def(cell_size, tile_size), view, bounds_of(view))) {
        bench_arena(a, questions, 2.0);
    }
    tl_imported_mesh_free(&mesh);
}

// Random points of the surface; beside each start a point near it and one to slide to.
std::vector<question> seeded_questions(arena &a, size_t count)
{
    std::vector<question> questions(count);
    random_state = 7;
    for (question &q : questions) {
        dtPolyRef ref;
        a.level.query->findRandomPoint(&a.filter, random_unit, &ref, &q.start.x);
        a.level.query->findRandomPoint(&a.filter, random_unit, &ref, &q.goal.x);
        tl_vec3 off = { random_unit() - 0.5f, random_unit() - 0.5f, random_unit() - 0.5f };
        q.near_point = tl_mul_add(q.start, off, 2.0f);
        q.target = tl_add(q.start, tl_vec3_make(6.0f * (random_unit() - 0.5f), 0.0f, 6.0f * (random_unit() - 0.5f)));
    }
    return questions;
}

void bench_sample(const char *name, uint32_t triangles, float cell_size, uint32_t tile_size, size_t pairs, double bar)
{
    const tl_sample_level *sample = tl_sample_find_level(name);
    tl_sample_mesh mesh;
    if (sample != nullptr && tl_sample_build_level(sample, triangles, 1, &mesh) == TL_OK) {
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        arena a;
        a.name = std::string(name) + " in tiles of " + std::to_string(tile_size);
        if (a.level.build(make_def(cell_size, tile_size), view, bounds_of(view))) {
            bench_arena(a, seeded_questions(a, pairs), bar);
        }
        tl_sample_mesh_free(&mesh);
    }
}

} // namespace

int main(int argc, char **argv)
{
    query_options options;
    options.count = 10000;
    options.city_triangles = 1000000;
    const char *json = options.parse(argc, argv, "pairs");
    report = bench_report_new("query", "us", nullptr);
    runs = (int)options.runs;
    prepared_only = options.prepared_only != 0;
    const char *files[] = { "nav_test_cs0.3_w_solo", "nav_test_cs0.3_w_t48",    "dungeon_cs0.3_w_solo",
                            "dungeon_cs0.3_w_t48",   "undulating_cs0.3_w_solo", "undulating_cs0.3_w_t48" };
    for (const char *file : files) {
        if (options.table_only == 0 && options.wants(file)) {
            bench_recorded(file, options.count);
        }
    }
    if (options.table_only == 0 && options.wants("city")) {
        bench_sample("city", options.city_triangles, 0.3f, 64, options.count, 5.0);
    }
    query_options table = options;
    table.count = std::min(table.count, 1000u);
    table.runs = std::min(table.runs, 3u);
    bench_query_table(table, report);
    std::printf("\n");
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
