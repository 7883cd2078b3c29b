// SPDX-License-Identifier: MIT
//
// One mesh for agents of any radius, beside a Detour mesh for each: paths, reachability, memory.
//
//   bench_wide [--pairs COUNT (1000)] [--runs RUNS (5)] [--only NAME] [--city TRIANGLES (100000)]
//
// All meshes are Recast's, of cells of 0.15 m; talus has the polygons of the smallest radius. Detour's side is findPath
// and findStraightPath on the mesh that was baked for the radius. Places are Detour's own random ones there; talus is
// asked from the nearest places with room on its mesh. CPU time of one thread, the best run of each side.

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
#include <talus/nav_wide.h>

extern "C" {
#include "cli/sample/sample_level.h"
}

namespace
{

constexpr float CELL = 0.15f, RADII[3] = { 0.3f, 0.6f, 1.2f };
constexpr int MAX_FOUND = 4096;

uint64_t random_state = 5;

float random_unit()
{
    return tl_random_unit_float(&random_state);
}

query_options options;
bench_report *report;

// Bytes that a navmesh holds beside its tiles.
struct byte_count {
    size_t held = 0;

    static void *allocate(size_t size, size_t alignment, void *user)
    {
        void *block = nullptr;
        if (posix_memalign(&block, std::max(alignment, sizeof(void *)), size) != 0) {
            return nullptr;
        }
        ((byte_count *)user)->held += size;
        return block;
    }

    static void release(void *block, size_t size, void *user)
    {
        ((byte_count *)user)->held -= block != nullptr ? size : 0;
        std::free(block);
    }

    tl_allocator allocator()
    {
        return { allocate, release, this };
    }
};

// Two places of a mesh, as both sides know them.
struct place_pair {
    dtPolyRef detour[2];
    float points[2][3];
    tl_nav_location talus[2];       // on talus's own mesh, where there is room
    tl_nav_location talus_plain[2]; // nearest, for the path without a radius
    bool has_room;
};

struct answers {
    size_t both = 0, neither = 0, only_talus = 0, only_detour = 0, no_room = 0;
    double min_room = 1e30; // metres that a path's walls are farther than the radius says
    double talus_length = 0.0, detour_length = 0.0, nodes = 0.0;
};

class arena
{
  public:
    std::string name;
    detour_level level; // of the smallest radius
    std::unique_ptr<tl_nav_query, detour_deleter> query;
    byte_count bytes;
    size_t tile_bytes = 0, detour_bytes = 0;
    std::unique_ptr<tl_navmesh, detour_deleter> navmesh, prepared; // after bytes: they are freed first
    tl_nav_wide_report kept = {};
    double prepared_in = 0.0; // seconds
    std::vector<tl_nav_corner> corners = std::vector<tl_nav_corner>(MAX_FOUND);
    uint64_t checksum = 0; // so that nothing is optimised away

    static size_t detour_size(const dtNavMesh &mesh)
    {
        size_t size = 0;
        for (int i = 0; i < mesh.getMaxTiles(); i++) {
            size += sizeof(dtMeshTile) + (mesh.getTile(i)->header != nullptr ? (size_t)mesh.getTile(i)->dataSize : 0);
        }
        return size;
    }

    bool prepare()
    {
        tl_nav_query_def def = tl_default_nav_query_def();
        def.max_nodes = 1 << 16;
        tl_nav_query *made = nullptr;
        if (tl_nav_query_create(&def, &made, NULL) != TL_OK) {
            return false;
        }
        query.reset(made);
        tl_allocator allocator = bytes.allocator();
        return copy_twin(nullptr, &navmesh) && copy_twin(&allocator, &prepared) && prepare_wide();
    }

    bool prepare_wide()
    {
        tl_nav_wide_def def = tl_default_nav_wide_def();
        def.max_radius = RADII[2];
        double begin = bench_thread_seconds();
        tl_result result = tl_navmesh_prepare_wide(prepared.get(), &def, &kept);
        prepared_in = bench_thread_seconds() - begin;
        return result == TL_OK;
    }

    bool copy_twin(const tl_allocator *allocator, std::unique_ptr<tl_navmesh, detour_deleter> *out)
    {
        tl_navmesh *own = nullptr;
        if (tl_navmesh_create(allocator, &own) != TL_OK) {
            return false;
        }
        out->reset(own);
        tile_bytes = 0;
        for (uint32_t s = 0; s < tl_navmesh_slot_count(level.twin.get()); s++) {
            const tl_nav_tile *tile = tl_navmesh_slot_tile(level.twin.get(), s);
            tile_bytes += tile->blob.size;
            if (tl_navmesh_add_tile(own, tile, TL_NAV_TILE_BORROWED) != TL_OK) {
                return false;
            }
        }
        return true;
    }

    void bench_radius(const detour_level &baked, float radius);

  private:
    std::vector<place_pair> pairs;
    std::vector<dtPolyRef> refs = std::vector<dtPolyRef>(MAX_FOUND);
    std::vector<float> points = std::vector<float>(3 * MAX_FOUND);
    dtQueryFilter filter;

    bool locate(const float *point, float radius, tl_nav_location *plain, tl_nav_location *wide)
    {
        const float near = radius - RADII[0] + 2.0f * CELL;
        const tl_vec3 extents = { 2.0f * CELL, 1.0f, 2.0f * CELL };
        if (tl_navmesh_find_nearest(navmesh.get(), nullptr, { point[0], point[1], point[2] }, extents, plain) !=
            TL_OK) {
            return false;
        }
        const tl_nav_around_request around = { nullptr, *plain, near };
        return tl_nav_query_find_wide_place(query.get(), navmesh.get(), &around, radius, wide) == TL_OK;
    }

    void find_pairs(const detour_level &baked, float radius)
    {
        pairs.clear();
        for (size_t i = 0; i < options.count; i++) {
            place_pair p = {};
            p.has_room = true;
            for (int end = 0; end < 2; end++) {
                baked.query->findRandomPoint(&filter, random_unit, &p.detour[end], p.points[end]);
                p.has_room = locate(p.points[end], radius, &p.talus_plain[end], &p.talus[end]) && p.has_room;
            }
            pairs.push_back(p);
        }
    }

    // Corners of Detour's path, or 0.
    int detour_path(const detour_level &baked, const place_pair &p)
    {
        int count = 0, corner_count = 0;
        baked.query->findPath(p.detour[0], p.detour[1], p.points[0], p.points[1], &filter, refs.data(), &count,
                              MAX_FOUND);
        if (count > 0 && refs[(size_t)count - 1] == p.detour[1]) {
            baked.query->findStraightPath(p.points[0], p.points[1], refs.data(), count, points.data(), nullptr, nullptr,
                                          &corner_count, MAX_FOUND);
        }
        return corner_count;
    }

    tl_nav_wide_path wide_path(const tl_navmesh *asked, const place_pair &p, float radius)
    {
        tl_nav_wide_path path;
        const tl_nav_path_request request = { nullptr, p.talus[0], p.talus[1] };
        tl_nav_query_find_wide_path(query.get(), asked, &request, radius, corners.data(), MAX_FOUND, &path);
        return path;
    }

    answers compare(const detour_level &baked, float radius);
    double time_once(const std::function<void(const place_pair &)> &ask);
};

answers arena::compare(const detour_level &baked, float radius)
{
    answers found;
    for (const place_pair &p : pairs) {
        int corner_count = detour_path(baked, p);
        if (!p.has_room) {
            found.no_room++;
            continue;
        }
        tl_nav_wide_path path = wide_path(prepared.get(), p, radius);
        bool is_complete = path.status == TL_NAV_WIDE_COMPLETE;
        found.nodes += path.node_count;
        found.both += is_complete && corner_count > 0;
        found.neither += !is_complete && corner_count == 0;
        found.only_talus += is_complete && corner_count == 0;
        found.only_detour += !is_complete && corner_count > 0;
        if (is_complete && corner_count > 0) {
            found.talus_length += path.length;
            for (int i = 1; i < corner_count; i++) {
                const float *a = &points[3 * (size_t)(i - 1)], *b = a + 3;
                found.detour_length += std::hypot((double)b[0] - (double)a[0], (double)b[2] - (double)a[2]);
            }
        }
        float clearance = 0.0f;
        if (is_complete && radius > RADII[0] &&
            tl_nav_query_path_clearance(query.get(), navmesh.get(), nullptr, corners.data(), path.corner_count,
                                        2.0f * radius, &clearance) == TL_OK) {
            found.min_room = std::min(found.min_room, (double)clearance + (double)RADII[0] - (double)radius);
        }
    }
    return found;
}

// Microseconds a pair; pairs without room on talus's mesh are left out for both.
double arena::time_once(const std::function<void(const place_pair &)> &ask)
{
    size_t count = 0;
    double begin = bench_thread_seconds();
    for (const place_pair &p : pairs) {
        if (p.has_room) {
            ask(p);
            count++;
        }
    }
    return (bench_thread_seconds() - begin) * 1e6 / (double)std::max(count, (size_t)1);
}

void arena::bench_radius(const detour_level &baked, float radius)
{
    find_pairs(baked, radius);
    answers found = compare(baked, radius);
    double theirs = 1e30, plain = 1e30, gathered = 1e30, ours = 1e30, asked = 1e30;
    for (int run = 0; run < (int)options.runs; run++) {
        theirs = std::min(theirs, time_once([&](const place_pair &p) { checksum += (uint64_t)detour_path(baked, p); }));
        plain = std::min(plain, time_once([&](const place_pair &p) {
                             tl_nav_shortest_path path;
                             const tl_nav_path_request request = { nullptr, p.talus_plain[0], p.talus_plain[1] };
                             const tl_nav_path_buffers buffers = { nullptr, 0, corners.data(), MAX_FOUND };
                             tl_nav_query_find_shortest_path(query.get(), navmesh.get(), &request, &buffers, &path);
                             checksum += path.corner_count;
                         }));
        gathered = std::min(gathered, time_once([&](const place_pair &p) {
                                checksum += wide_path(navmesh.get(), p, radius).corner_count;
                            }));
        ours = std::min(ours, time_once([&](const place_pair &p) {
                            checksum += wide_path(prepared.get(), p, radius).corner_count;
                        }));
        asked = std::min(asked, time_once([&](const place_pair &p) {
                             tl_nav_wide_status status;
                             const tl_nav_path_request request = { nullptr, p.talus[0], p.talus[1] };
                             tl_nav_query_is_wide_reachable(query.get(), prepared.get(), &request, radius, &status);
                             checksum += (uint64_t)status;
                         }));
    }
    size_t pairs_asked = found.both + found.neither + found.only_talus + found.only_detour;
    std::printf("  radius %.1f, microseconds a pair:\n", (double)radius);
    std::printf("    Detour on its own bake %8.2f   exact path without radius %8.2f\n", theirs, plain);
    std::printf("    wide path              %8.2f   rate to Detour's %.2fx, %.1f times the exact path\n", ours,
                theirs / ours, ours / plain);
    std::printf("      not prepared         %8.2f   %.1f times the prepared one\n", gathered, gathered / ours);
    std::printf("      reachable or not     %8.2f   %.1f nodes\n", asked, found.nodes / (double)pairs_asked);
    std::printf(
        "    path by both %zu, by neither %zu, by talus alone %zu, by Detour alone %zu, no room for talus %zu\n",
        found.both, found.neither, found.only_talus, found.only_detour, found.no_room);
    std::printf("    nearest to a wall %+.4f m of the radius; paths are %.4f times as long as Detour's\n",
                found.min_room, found.talus_length / found.detour_length);
    char chart[128], claim[192];
    std::snprintf(chart, sizeof chart, "%s, radius %.1f", name.c_str(), (double)radius);
    bench_report_value(report, chart, "Detour", "path", theirs);
    bench_report_value(report, chart, "talus", "path", ours);
    bench_report_value(report, chart, "talus", "path, not prepared", gathered);
    bench_report_value(report, chart, "talus", "reachable or not", asked);
    bench_report_value(report, chart, "talus", "path without radius", plain);
    bench_report_speed(report, chart, "Detour", theirs / ours, 1.0);
    std::snprintf(claim, sizeof claim, "%s: fraction of pairs answered as by a bake for the radius", chart);
    bench_report_at_least(report, claim, (double)(found.both + found.neither) / (double)pairs_asked, 0.99);
    std::snprintf(claim, sizeof claim, "%s: metres nearer to a wall than the radius", chart);
    bench_report_at_most(report, claim, -found.min_room, (double)CELL);
}

void bench_level(const std::string &name, const tl_mesh_view &view, uint32_t tile_size)
{
    tl_aabb bounds = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)view.triangle_count; i++) {
        bounds = tl_aabb_add_point(bounds, view.vertices[view.indices[i]]);
    }
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = CELL;
    def.cell_height = 0.1f;
    def.agent_radius = RADII[0];
    def.tile_size = tile_size;
    arena a;
    a.name = name + (tile_size > 0 ? " in tiles of " + std::to_string(tile_size) : "");
    if (!a.level.build(def, view, bounds) || !a.level.twin_is_whole || !a.prepare()) {
        std::printf("\n%s: left out, Recast made no mesh of it that both sides know\n", a.name.c_str());
        return;
    }
    std::printf("\n%s: %u tiles, %zu pairs\n", a.name.c_str(), tl_navmesh_tile_count(a.navmesh.get()), options.count);
    a.detour_bytes = arena::detour_size(*a.level.mesh);
    for (float radius : { RADII[1], RADII[2] }) {
        detour_level baked;
        def.agent_radius = radius;
        if (baked.build(def, view, bounds)) {
            a.detour_bytes += arena::detour_size(*baked.mesh);
            a.bench_radius(baked, radius);
        }
    }
    std::printf("  memory: Detour's meshes for three radii %zu KB; talus for all up to %.1f m %zu KB: tiles %zu KB, "
                "navmesh %zu "
                "KB, walls kept %zu KB, prepared in %.2f ms\n",
                a.detour_bytes / 1024, (double)RADII[2], (a.tile_bytes + a.bytes.held) / 1024, a.tile_bytes / 1024,
                (a.bytes.held - a.kept.bytes) / 1024, (size_t)a.kept.bytes / 1024, a.prepared_in * 1e3);
    bench_report_at_most(report, (a.name + ": memory, of Detour's for three radii").c_str(),
                         (double)(a.tile_bytes + a.bytes.held) / (double)a.detour_bytes, 1.0);
}

void bench_file(const std::string &name, uint32_t tile_size)
{
    tl_imported_mesh mesh;
    std::string path = std::string(TALUS_DATA_DIR) + "/levels/" + name + ".obj";
    if (tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) == TL_OK) {
        bench_level(name, tl_imported_mesh_as_view(&mesh), tile_size);
        tl_imported_mesh_free(&mesh);
    }
}

void bench_sample(const char *name, uint32_t triangles, uint32_t tile_size)
{
    const tl_sample_level *sample = tl_sample_find_level(name);
    tl_sample_mesh mesh;
    if (sample != nullptr && tl_sample_build_level(sample, triangles, 1, &mesh) == TL_OK) {
        bench_level(std::string("built-in ") + name, tl_sample_mesh_as_view(&mesh), tile_size);
        tl_sample_mesh_free(&mesh);
    }
}

} // namespace

int main(int argc, char **argv)
{
    options.count = 1000;
    options.city_triangles = 100000;
    const char *json = options.parse(argc, argv, "pairs");
    report = bench_report_new("wide", "us", nullptr);
    for (const char *name : { "nav_test", "dungeon", "undulating" }) {
        if (options.wants(name)) {
            bench_file(name, 0);
            bench_file(name, 128);
        }
    }
    if (options.wants("courtyard")) {
        bench_sample("courtyard", 20000, 128);
    }
    if (options.wants("city")) {
        bench_sample("city", options.city_triangles, 128);
    }
    std::printf("\n");
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
