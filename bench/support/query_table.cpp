// SPDX-License-Identifier: MIT
//
// Queries beside Detour's over many levels: the geometric mean and the worst level of each row, with its bar.
//
// Every level is baked by Recast in one piece and in tiles of 48 cells, the city in tiles of 64; both sides hold the
// same polygons. Areas are dealt to polygons by a hash of their number, so that rows with costs have four areas in a
// mosaic; all other rows give each area the cost 1. Rates are those of one thread; both sides take turns, and the best
// run of each counts.

#include "query_table.hpp"

#include "base/random.h"
#include "detour_mesh.hpp"
#include "io/mesh/mesh_import.h"
#include "measure.h"
#include "query_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <dirent.h>
#include <functional>
#include <recastnavigation/DetourNode.h>
#include <string>
#include <talus/nav_around.h>
#include <talus/nav_prepare.h>

extern "C" {
#include "cli/sample/sample_level.h"
}

namespace
{

constexpr int MAX_POLYGONS = 2048;
constexpr float AROUND_RADIUS = 8.0f;
constexpr unsigned AREA_KINDS = 4;
const float AREA_COSTS[AREA_KINDS + 1] = { 1.0f, 1.0f, 2.0f, 4.0f, 10.0f };

uint64_t checksum, bytes_in_use;
uint32_t runs = 3;

void *count_allocate(size_t size, size_t alignment, void *)
{
    void *block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    bytes_in_use += block != nullptr ? size : 0;
    return block;
}

void count_release(void *block, size_t size, void *)
{
    bytes_in_use -= block != nullptr ? size : 0;
    std::free(block);
}

const tl_allocator COUNTING = { count_allocate, count_release, nullptr };

struct end_place {
    dtPolyRef detour;
    float point[3];
    tl_nav_location talus;
};

struct end_pair {
    end_place start, goal;
};

struct table_level {
    std::string name;
    group in;
    detour_level level;
    std::unique_ptr<dtNavMeshQuery, detour_deleter> detour{ dtAllocNavMeshQuery() };
    std::unique_ptr<tl_nav_query, detour_deleter> query;
    dtQueryFilter even, uneven;
    tl_nav_filter costs = tl_default_nav_filter();
    std::vector<end_pair> reachable, cut_off;
    std::vector<dtPolyRef> refs = std::vector<dtPolyRef>(MAX_POLYGONS);
    std::vector<float> points = std::vector<float>(3 * MAX_POLYGONS);
    std::vector<tl_nav_ref> polygons = std::vector<tl_nav_ref>(1 << 14);
    std::vector<tl_nav_corner> corners = std::vector<tl_nav_corner>(1 << 14);
    uint64_t random_state = 7;

    const tl_navmesh *navmesh() const
    {
        return level.twin.get();
    }
    tl_nav_path_buffers buffers()
    {
        return { polygons.data(), (uint32_t)polygons.size(), corners.data(), (uint32_t)corners.size() };
    }
};

uint64_t *detour_random;

float random_unit()
{
    return tl_random_unit_float(detour_random);
}

bool find_end(table_level &l, end_place *out)
{
    const tl_vec3 extents = { 0.1f, 0.5f, 0.1f };
    detour_random = &l.random_state;
    return dtStatusSucceed(l.detour->findRandomPoint(&l.even, random_unit, &out->detour, out->point)) &&
           tl_navmesh_find_nearest(l.navmesh(), nullptr, { out->point[0], out->point[1], out->point[2] }, extents,
                                   &out->talus) == TL_OK;
}

int detour_path(table_level &l, const end_pair &p, const dtQueryFilter &filter, int *polygon_count_out)
{
    int corner_count = 0;
    l.detour->findPath(p.start.detour, p.goal.detour, p.start.point, p.goal.point, &filter, l.refs.data(),
                       polygon_count_out, MAX_POLYGONS);
    float end[3] = { p.goal.point[0], p.goal.point[1], p.goal.point[2] };
    if (*polygon_count_out > 0 && l.refs[(size_t)*polygon_count_out - 1] != p.goal.detour) {
        l.detour->closestPointOnPoly(l.refs[(size_t)*polygon_count_out - 1], p.goal.point, end, nullptr);
    }
    l.detour->findStraightPath(p.start.point, end, l.refs.data(), *polygon_count_out, l.points.data(), nullptr, nullptr,
                               &corner_count, MAX_POLYGONS);
    return corner_count;
}

// Metres in the plane.
double talus_one_call(table_level &l, const end_pair &p, const tl_nav_filter *filter = nullptr)
{
    tl_nav_shortest_path path;
    const tl_nav_path_request request = { filter, p.start.talus, p.goal.talus };
    const tl_nav_path_buffers room = l.buffers();
    tl_nav_query_find_shortest_path(l.query.get(), l.navmesh(), &request, &room, &path);
    checksum += path.corner_count;
    return path.status == TL_NAV_PATH_COMPLETE ? path.length : -1.0;
}

uint32_t talus_two_calls(table_level &l, const end_pair &p, const tl_nav_filter *filter)
{
    tl_nav_path path;
    uint32_t count = 0;
    const tl_nav_path_request request = { filter, p.start.talus, p.goal.talus };
    tl_nav_query_find_path(l.query.get(), l.navmesh(), &request, l.polygons.data(), (uint32_t)l.polygons.size(), &path);
    const tl_nav_polygon_path found = { l.polygons.data(), path.polygon_count, p.start.talus.point, path.end.point };
    tl_navmesh_straight_path(l.navmesh(), &found, l.corners.data(), (uint32_t)l.corners.size(), &count, nullptr);
    checksum += count;
    return count;
}

// To the nearest point that the start reaches, and there.
void talus_nearest_reachable(table_level &l, const end_pair &p)
{
    end_pair moved = p;
    tl_navmesh_find_nearest_reachable(l.navmesh(), nullptr, p.start.talus.polygon, p.goal.talus.point,
                                      &moved.goal.talus);
    talus_one_call(l, moved);
}

double time_once(const std::vector<end_pair> &pairs, const std::function<void(const end_pair &)> &ask)
{
    const double begin = bench_thread_seconds();
    double seconds = 0.0;
    int repeats = 0;
    do {
        for (const end_pair &p : pairs) {
            ask(p);
        }
        repeats++;
        seconds = bench_thread_seconds() - begin;
    } while (seconds < 0.01);
    return seconds / (double)repeats;
}

void note(const table_level &l, row which, double ratio)
{
    values[l.in][which].push_back({ l.name, ratio });
}

void compare(const table_level &l, row which, const std::vector<end_pair> &pairs,
             const std::function<void(const end_pair &)> &detour, const std::function<void(const end_pair &)> &talus)
{
    if (pairs.size() < 20) {
        return;
    }
    double theirs = 1e30, ours = 1e30;
    for (uint32_t run = 0; run < runs; run++) {
        theirs = std::min(theirs, time_once(pairs, detour));
        ours = std::min(ours, time_once(pairs, talus));
    }
    note(l, which, theirs / ours);
}

// What a path costs over areas, leg by leg, so that Detour's corners are judged by our polygons too. < 0: rounding led
// a leg into a wall.
double cost_along(table_level &l, const end_pair &p, const std::vector<tl_vec3> &points)
{
    std::vector<tl_nav_ref> crossed(1 << 12);
    tl_nav_location at = p.start.talus;
    double cost = 0.0;
    for (size_t i = 1; i < points.size(); i++) {
        tl_nav_ray_hit hit;
        float leg = 0.0f;
        uint32_t count = 0;
        if (tl_navmesh_cast_ray(l.navmesh(), nullptr, &at, points[i], crossed.data(), (uint32_t)crossed.size(), &hit) !=
                TL_OK ||
            hit.t < 0.9999f) {
            return -1.0;
        }
        const tl_nav_corner ends[2] = { { at.point, at.polygon, TL_NAV_CORNER_START, TL_NAV_NO_REF },
                                        { hit.point, hit.polygon, TL_NAV_CORNER_END, TL_NAV_NO_REF } };
        const tl_nav_trace_request request = { &l.costs, crossed.data(), hit.polygon_count, ends, 2, 0 };
        if (tl_is_error(tl_navmesh_trace_path(l.navmesh(), &request, nullptr, 0, &count, &leg))) {
            return -1.0;
        }
        cost += (double)leg;
        at = { hit.polygon, points[i] };
    }
    return cost;
}

// Of all paths with slack, whose corners are judged beside Detour's.
double area_cost_ratio(table_level &l, float slack)
{
    double theirs = 0.0, ours = 0.0;
    tl_nav_filter filter = l.costs;
    filter.slack = slack;
    for (const end_pair &p : l.reachable) {
        int polygon_count = 0;
        const int count = detour_path(l, p, l.uneven, &polygon_count);
        std::vector<tl_vec3> their_points, our_points;
        for (int i = 0; i < count; i++) {
            const float *c = &l.points[3 * (size_t)i];
            their_points.push_back({ c[0], c[1], c[2] });
        }
        const uint32_t corner_count = talus_two_calls(l, p, &filter);
        for (uint32_t i = 0; i < corner_count; i++) {
            our_points.push_back(l.corners[i].point);
        }
        const double a = cost_along(l, p, their_points), b = cost_along(l, p, our_points);
        if (a >= 0.0 && b >= 0.0) { // of both sides or of none
            theirs += a;
            ours += b;
        }
    }
    return theirs > 0.0 ? ours / theirs : 0.0;
}

void compare_area_costs(table_level &l)
{
    const row rows[] = { AREA_PATH_COST, SLACK_AREA_PATH_COST };
    for (int i = 0; i < 2; i++) {
        const double ratio = area_cost_ratio(l, i == 0 ? 0.0f : 0.1f);
        if (ratio > 0.0) {
            note(l, rows[i], ratio);
        }
    }
}

double detour_bytes(const table_level &l)
{
    const dtNavMesh &mesh = *l.level.mesh;
    double bytes = sizeof mesh;
    for (int i = 0; i < mesh.getMaxTiles(); i++) {
        bytes += sizeof(dtMeshTile) + sizeof(dtMeshTile *);
        const dtMeshTile *tile = mesh.getTile(i);
        bytes += tile->header != nullptr ? tile->dataSize : 0;
    }
    return bytes;
}

double talus_bytes(const table_level &l)
{
    tl_navmesh *copy = nullptr;
    const uint64_t before = bytes_in_use;
    double bytes = 0.0;
    if (tl_navmesh_create(&COUNTING, &copy) != TL_OK) {
        return 0.0;
    }
    for (uint32_t s = 0; s < tl_navmesh_slot_count(l.navmesh()); s++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(l.navmesh(), s);
        if (tile != nullptr) {
            tl_navmesh_add_tile(copy, tile, TL_NAV_TILE_BORROWED);
            bytes += (double)tile->blob.size;
        }
    }
    bytes += (double)(bytes_in_use - before);
    tl_navmesh_destroy(copy);
    return bytes;
}

bool make_queries(table_level &l, uint32_t polygon_count)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = std::max(def.max_nodes, 16 * polygon_count);
    tl_nav_query *made = nullptr;
    if (tl_nav_query_create(&def, &made, nullptr) != TL_OK ||
        dtStatusFailed(l.detour->init(l.level.mesh.get(), polygon_count < 2048 ? 2048 : 65535))) {
        return false;
    }
    l.query.reset(made);
    for (unsigned k = 1; k <= AREA_KINDS; k++) {
        l.uneven.setAreaCost((int)k, AREA_COSTS[k]);
        l.costs.area_cost[k] = AREA_COSTS[k];
    }
    return true;
}

// A query for 65,536 nodes, as Detour's holds at most, after the level's paths.
void measure_query_memory(table_level &l)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = 65536;
    def.allocator = &COUNTING;
    tl_nav_query *counted = nullptr;
    const uint64_t before = bytes_in_use;
    if (tl_nav_query_create(&def, &counted, nullptr) != TL_OK) {
        return;
    }
    std::unique_ptr<tl_nav_query, detour_deleter> kept(counted);
    std::swap(l.query, kept);
    for (const end_pair &p : l.reachable) {
        talus_one_call(l, p);
    }
    const double ours = (double)(bytes_in_use - before);
    std::swap(l.query, kept);
    dtNavMeshQuery *theirs = dtAllocNavMeshQuery();
    if (dtStatusSucceed(theirs->init(l.level.mesh.get(), 65535))) {
        const double bytes = sizeof *theirs + theirs->getNodePool()->getMemUsed() + 65535.0 * sizeof(dtNode *);
        note(l, QUERY_MEMORY, ours / bytes);
    }
    dtFreeNavMeshQuery(theirs);
}

double plan_length(const float *points, int count)
{
    double length = 0.0;
    for (int i = 1; i < count; i++) {
        const float *a = &points[3 * i - 3], *b = &points[3 * i];
        length += std::hypot((double)b[0] - (double)a[0], (double)b[2] - (double)a[2]);
    }
    return length;
}

// Paths that end where they were asked to, of a metre or more.
void compare_lengths(table_level &l)
{
    excess sums[SLACK_KINDS] = {};
    size_t count = 0;
    for (const end_pair &p : l.reachable) {
        int polygon_count = 0;
        const int corner_count = detour_path(l, p, l.even, &polygon_count);
        const double shortest = talus_one_call(l, p);
        if (polygon_count == 0 || l.refs[(size_t)polygon_count - 1] != p.goal.detour || shortest < 1.0) {
            continue;
        }
        count++;
        for (unsigned k = 0; k < SLACK_KINDS; k++) {
            tl_nav_filter filter = tl_default_nav_filter();
            filter.slack = SLACKS[k];
            const double length = k == 0 ? plan_length(l.points.data(), corner_count) : talus_one_call(l, p, &filter);
            sums[k].mean += length / shortest - 1.0;
            sums[k].most = std::max(sums[k].most, length / shortest - 1.0);
        }
    }
    for (unsigned k = 0; k < SLACK_KINDS && count > 0; k++) {
        excesses[l.in][k].push_back({ sums[k].mean / (double)count, sums[k].most });
    }
}

void compare_paths(table_level &l)
{
    const auto detour = [&l](const end_pair &p) {
        int polygon_count = 0;
        checksum += (uint64_t)detour_path(l, p, l.even, &polygon_count);
    };
    const auto detour_uneven = [&l](const end_pair &p) {
        int polygon_count = 0;
        checksum += (uint64_t)detour_path(l, p, l.uneven, &polygon_count);
    };
    compare(l, ONE_CALL, l.reachable, detour, [&l](const end_pair &p) { talus_one_call(l, p); });
    for (unsigned k = 1; k < SLACK_KINDS; k++) {
        tl_nav_filter filter = tl_default_nav_filter();
        filter.slack = SLACKS[k];
        compare(l, (row)(FIRST_SLACK + k - 1), l.reachable, detour,
                [&l, &filter](const end_pair &p) { talus_one_call(l, p, &filter); });
    }
    compare_lengths(l);
    compare(l, TWO_CALLS, l.reachable, detour, [&l](const end_pair &p) { talus_two_calls(l, p, nullptr); });
    compare(l, AREA_COST, l.reachable, detour_uneven, [&l](const end_pair &p) { talus_two_calls(l, p, &l.costs); });
    tl_nav_filter loose = l.costs;
    loose.slack = 0.1f;
    compare(l, SLACK_AREA_COST, l.reachable, detour_uneven,
            [&l, &loose](const end_pair &p) { talus_two_calls(l, p, &loose); });
    compare(l, UNREACHABLE, l.cut_off, detour, [&l](const end_pair &p) { talus_nearest_reachable(l, p); });
    compare_area_costs(l);
    if (tl_navmesh_prepare(l.level.twin.get(), nullptr, nullptr) == TL_OK && tl_navmesh_is_prepared(l.navmesh())) {
        compare(l, PREPARED, l.reachable, detour, [&l](const end_pair &p) { talus_one_call(l, p); });
    }
}

void compare_places(table_level &l)
{
    compare(
        l, RANDOM_AROUND, l.reachable,
        [&l](const end_pair &p) {
            dtPolyRef ref;
            float point[3];
            l.detour->findRandomPointAroundCircle(p.start.detour, p.start.point, AROUND_RADIUS, &l.even, random_unit,
                                                  &ref, point);
            checksum += ref;
        },
        [&l](const end_pair &p) {
            const uint64_t bits[2] = { tl_random_bits(&l.random_state), tl_random_bits(&l.random_state) };
            const tl_nav_around_request request = { nullptr, p.start.talus, AROUND_RADIUS };
            tl_nav_location at;
            tl_nav_query_random_reachable(l.query.get(), l.navmesh(), &request, bits, &at);
            checksum += at.polygon;
        });
    compare(
        l, HEIGHT, l.reachable,
        [&l](const end_pair &p) {
            float height = 0.0f;
            l.detour->getPolyHeight(p.start.detour, p.start.point, &height);
            checksum += (uint64_t)(int64_t)height;
        },
        [&l](const end_pair &p) {
            float height = 0.0f;
            tl_navmesh_height(l.navmesh(), p.start.talus.polygon, p.start.point[0], p.start.point[2], &height);
            checksum += (uint64_t)(int64_t)height;
        });
}

void measure_level(const std::string &name, group in, const tl_mesh_view &view, uint32_t tile_size, size_t pairs)
{
    table_level l;
    l.name = name;
    l.in = in;
    l.level.area_kinds = AREA_KINDS;
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    tl_aabb bounds = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)view.triangle_count; i++) {
        bounds = tl_aabb_add_point(bounds, view.vertices[view.indices[i]]);
    }
    uint32_t polygon_count = 0;
    if (!l.level.build(def, view, bounds) || !l.level.twin_is_whole) {
        std::printf("  %s, %s: left out, Recast made an invalid polygon\n", name.c_str(), GROUP_NAMES[in]);
        return;
    }
    for (uint32_t s = 0; s < tl_navmesh_slot_count(l.navmesh()); s++) {
        polygon_count += tl_navmesh_slot_tile(l.navmesh(), s)->polygon_count;
    }
    if (polygon_count == 0 || !make_queries(l, polygon_count)) {
        return;
    }
    for (size_t tries = 0; tries < 4 * pairs && l.reachable.size() < pairs; tries++) {
        end_pair p;
        uint32_t islands[2];
        if (find_end(l, &p.start) && find_end(l, &p.goal) &&
            tl_navmesh_island(l.navmesh(), p.start.talus.polygon, &islands[0]) == TL_OK &&
            tl_navmesh_island(l.navmesh(), p.goal.talus.polygon, &islands[1]) == TL_OK) {
            std::vector<end_pair> &list = islands[0] == islands[1] ? l.reachable : l.cut_off;
            if (list.size() < pairs) {
                list.push_back(p);
            }
        }
    }
    measure_query_memory(l);
    note(l, MESH_MEMORY, talus_bytes(l) / detour_bytes(l));
    compare_paths(l);
    compare_places(l);
    std::printf("  %-44s %-9s", name.c_str(), GROUP_NAMES[in]);
    for (int r = 0; r < ROWS; r++) {
        const std::vector<row_value> &list = values[in][r];
        if (!list.empty() && list.back().level == name) {
            std::printf(" %5.2f", list.back().ratio);
        } else {
            std::printf("     -");
        }
    }
    std::printf("\n");
    std::fflush(stdout);
}

void measure_files(const query_options &options)
{
    const std::string folder = std::string(TALUS_DATA_DIR) + "/levels";
    std::vector<std::string> names;
    if (DIR *open = opendir(folder.c_str())) {
        while (const dirent *entry = readdir(open)) {
            const std::string file = entry->d_name;
            if (file.size() > 4 && file.substr(file.size() - 4) == ".obj" && options.wants(file)) {
                names.push_back(file);
            }
        }
        closedir(open);
    }
    std::sort(names.begin(), names.end());
    for (const std::string &file : names) {
        tl_imported_mesh mesh;
        if (tl_import_mesh((folder + "/" + file).c_str(), nullptr, &mesh, nullptr) == TL_OK) {
            const std::string name = file.substr(0, file.size() - 4);
            measure_level(name, SOLO, tl_imported_mesh_as_view(&mesh), 0, options.count);
            measure_level(name, TILED, tl_imported_mesh_as_view(&mesh), 48, options.count);
            tl_imported_mesh_free(&mesh);
        }
    }
}

void measure_samples(const query_options &options)
{
    uint32_t count = 0;
    const tl_sample_level *samples = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; i++) {
        const std::string name = samples[i].name;
        const bool is_city = name == "city";
        tl_sample_mesh mesh;
        if (!options.wants(name) ||
            tl_sample_build_level(&samples[i], is_city ? options.city_triangles : samples[i].default_triangles, 1,
                                  &mesh) != TL_OK) {
            continue;
        }
        const tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        if (!is_city) {
            measure_level("sample " + name, SOLO, view, 0, options.count);
        }
        measure_level("sample " + name, is_city ? CITY : TILED, view, is_city ? 64 : 48, options.count);
        tl_sample_mesh_free(&mesh);
    }
}

} // namespace

void bench_query_table(const query_options &options, bench_report *report)
{
    runs = options.runs;
    std::printf(
        "\nEach level, rows in the order of the table below; times as fast as Detour, or its share of memory:\n");
    measure_files(options);
    measure_samples(options);
    std::printf("\nTimes as fast as Detour (memory and cost: share of Detour's):\n");
    for (int r = 0; r < ROWS; r++) {
        for (int g = 0; g < GROUPS; g++) {
            print_row((group)g, (row)r, report);
        }
    }
    for (unsigned k = 0; k < SLACK_KINDS; k++) {
        for (int g = 0; g < GROUPS; g++) {
            print_excess((group)g, k);
        }
    }
    std::printf("  (checksum %llu)\n", (unsigned long long)checksum);
}
