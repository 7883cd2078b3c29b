// SPDX-License-Identifier: MIT
//
// Paths against Detour's: on the very same polygons, which tests the queries alone, and on each one's own bake of the
// same level; and against the floors, which say what hangs together before polygons are made. An argument sets the cell
// size of all levels, and files behind it take their place: test_path_detour 0.1 [LEVEL ...].

#include "detour_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

// Last: cmocka takes the word fail from the standard headers.
#include "level_list.hpp"

namespace
{

const tl_vec3 EXTENTS = { 2.0f, 4.0f, 2.0f };

tl_nav_def make_def(const level &l, uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = l.cell_size;
    def.agent_max_slope = l.max_slope;
    def.bounds = l.bounds();
    def.tile_size = tile_size;
    return def;
}

std::unique_ptr<tl_navmesh, detour_deleter> bake(const level &l, const tl_nav_def &def)
{
    tl_nav_input input = {};
    input.mesh = l.view();
    tl_nav_tiles tiles;
    tl_navmesh *navmesh = nullptr;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, nullptr), TL_OK);
    TEST_RESULT(tl_navmesh_create(nullptr, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles.tiles[i], TL_NAV_TILE_OWNED), TL_OK);
        tiles.tiles[i] = nullptr; // the navmesh's now
    }
    tl_nav_tiles_free(&tiles);
    return std::unique_ptr<tl_navmesh, detour_deleter>(navmesh);
}

test_random detour_random;

float detour_unit()
{
    return test_random_unit(&detour_random);
}

// What one side finds.
struct found_path {
    bool on_mesh, complete;
    double length;
};

found_path find_detour(const detour_level &detour, tl_vec3 start, tl_vec3 goal)
{
    dtQueryFilter filter;
    dtPolyRef start_ref = 0, goal_ref = 0, polygons[2048];
    float near_start[3], near_goal[3], corners[3 * 2048];
    detour.query->findNearestPoly(&start.x, &EXTENTS.x, &filter, &start_ref, near_start);
    detour.query->findNearestPoly(&goal.x, &EXTENTS.x, &filter, &goal_ref, near_goal);
    found_path found = { start_ref != 0 && goal_ref != 0, false, 0.0 };
    if (!found.on_mesh) {
        return found;
    }
    int count = 0, corner_count = 0;
    detour.query->findPath(start_ref, goal_ref, near_start, near_goal, &filter, polygons, &count, 2048);
    found.complete = count > 0 && polygons[count - 1] == goal_ref;
    detour.query->findStraightPath(near_start, near_goal, polygons, count, corners, nullptr, nullptr, &corner_count,
                                   2048);
    for (int i = 1; i < corner_count; i++) {
        found.length += (double)rcVdist(corners + 3 * (i - 1), corners + 3 * i);
    }
    return found;
}

found_path find_talus(const tl_navmesh *navmesh, tl_nav_query *query, tl_vec3 start, tl_vec3 goal)
{
    tl_nav_ref polygons[2048];
    tl_nav_corner corners[2048];
    tl_nav_path_buffers buffers = { polygons, 2048, corners, 2048 };
    tl_nav_route route;
    const tl_nav_route_request request = { nullptr, start, goal, EXTENTS };
    tl_result result = tl_nav_query_find_route(query, navmesh, &request, &buffers, &route);
    if (result == TL_NOT_FOUND) {
        return { false, false, 0.0 };
    }
    TEST_RESULT(result, TL_OK);
    TEST_CHECK(route.path.status != TL_NAV_PATH_OUT_OF_NODES);
    return { true, route.path.status == TL_NAV_PATH_COMPLETE, (double)route.length };
}

std::unique_ptr<tl_nav_query, detour_deleter> make_query(const tl_navmesh *navmesh)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = (uint32_t)tl_navmesh_link_count(navmesh) + 2;
    tl_nav_query *query = nullptr;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    return std::unique_ptr<tl_nav_query, detour_deleter>(query);
}

// Whether the walkable floors below two points hang together, before they are divided into regions, contours and
// polygons: what both answers are measured by.
class floor_flood
{
  public:
    floor_flood(const level &l, const tl_nav_def &tiled)
    {
        tl_nav_def def = tiled;
        // Tiles look beyond the level, one tile does not: at its rim it knows no floor to step from.
        float beyond = tiled.tile_size > 0 ? 8.0f * def.cell_size : 0.0f;
        def.bounds.min = tl_sub(l.bounds().min, tl_vec3_make(beyond, 0.0f, beyond));
        def.bounds.max = tl_add(l.bounds().max, tl_vec3_make(beyond, 0.0f, beyond));
        def.tile_size = 0;
        tl_nav_config config;
        tl_nav_input input = {};
        input.mesh = l.view();
        tl_nav_stages stages = {};
        tl_nav_tile *tile = nullptr;
        TEST_RESULT(tl_nav_config_from_def(&def, def.bounds, 0, 0, &config, nullptr), TL_OK);
        TEST_RESULT(tl_nav_tile_bake(&config, &input, nullptr, &stages, &tile, nullptr), TL_OK);
        tl_blob_free(tile);
        compact = stages.compact;
        stages.compact = {};
        tl_nav_stages_free(&stages);
        islands.assign(compact.span_count, 0);
        for (uint32_t i = 0, island = 0; i < compact.span_count; i++) {
            if (is_walkable(i) && islands[i] == 0) {
                flood(i, ++island);
            }
        }
    }

    ~floor_flood()
    {
        tl_nav_compact_free(&compact);
    }

    bool hang_together(tl_vec3 a, tl_vec3 b) const
    {
        uint32_t island = island_at(a);
        return island != 0 && island == island_at(b);
    }

  private:
    bool is_walkable(uint32_t span) const
    {
        return compact.area[span] != TL_NAV_NULL_AREA;
    }

    void flood(uint32_t first, uint32_t island)
    {
        std::vector<uint32_t> open(1, first);
        islands[first] = island;
        while (!open.empty()) {
            uint32_t at = open.back();
            open.pop_back();
            for (uint32_t d = 0; d < 4; d++) {
                uint32_t beside = tl_nav_compact_neighbour(&compact, at, d);
                if (beside != TL_NAV_NO_SPAN && is_walkable(beside) && islands[beside] == 0) {
                    islands[beside] = island;
                    open.push_back(beside);
                }
            }
        }
    }

    // Of the walkable floor nearest to the point, at most three columns away: polygons are a little off.
    uint32_t island_at(tl_vec3 point) const
    {
        int column_x = (int)((point.x - compact.bounds.min.x) / compact.cell_size);
        int column_z = (int)((point.z - compact.bounds.min.z) / compact.cell_size);
        uint32_t island = 0;
        float best = INFINITY;
        for (int z = std::max(column_z - 3, 0); z <= std::min(column_z + 3, (int)compact.height - 1); z++) {
            for (int x = std::max(column_x - 3, 0); x <= std::min(column_x + 3, (int)compact.width - 1); x++) {
                size_t column = (size_t)z * compact.width + (size_t)x;
                float aside = (float)(std::abs(x - column_x) + std::abs(z - column_z)) * compact.cell_size;
                for (uint32_t i = compact.first_span[column]; i < compact.first_span[column + 1]; i++) {
                    float y = compact.bounds.min.y + (float)compact.floor[i] * compact.cell_height;
                    float distance = aside + std::fabs(y - point.y);
                    if (islands[i] != 0 && distance < best) {
                        best = distance;
                        island = islands[i];
                    }
                }
            }
        }
        return island;
    }

    tl_nav_compact compact;
    std::vector<uint32_t> islands;
};

// How paths of both compare over many pairs.
struct comparison {
    uint32_t pairs = 0, agree = 0, complete = 0, only_talus = 0, only_detour = 0, off_mesh = 0;
    uint32_t proven = 0;         // that differ, and the floors say that talus is right
    uint32_t against_floors = 0; // where the floors say that it is not
    std::vector<double> ratios;  // our length to Detour's

    void add(const found_path &ours, const found_path &theirs)
    {
        if (!ours.on_mesh || !theirs.on_mesh) {
            off_mesh++;
            return;
        }
        pairs++;
        agree += ours.complete == theirs.complete;
        complete += ours.complete && theirs.complete;
        only_talus += ours.complete && !theirs.complete;
        only_detour += !ours.complete && theirs.complete;
        if (ours.complete && theirs.complete && theirs.length > 1.0) {
            ratios.push_back(ours.length / theirs.length);
        }
    }

    bool agrees() const
    {
        return (double)(agree + proven) >= 0.999 * (double)pairs && off_mesh <= (pairs + off_mesh) / 1000;
    }

    double mean() const
    {
        double sum = 0.0;
        for (double ratio : ratios) {
            sum += ratio;
        }
        return ratios.empty() ? 1.0 : sum / (double)ratios.size();
    }

    double quantile(double q) const
    {
        std::vector<double> sorted = ratios;
        std::sort(sorted.begin(), sorted.end());
        return sorted.empty() ? 1.0 : sorted[(size_t)(q * (double)(sorted.size() - 1))];
    }

    void print(const char *what, const std::string &name, uint32_t tile_size) const
    {
        std::printf("%-8s %-12s tile %2u: %5u pairs, %5u complete, agree %.3f%% (only talus %u, only Detour %u; talus "
                    "proven right %u, wrong by the floors %u), off mesh %u; length / Detour's: mean %.5f, 1%% %.4f, "
                    "median %.5f, 99%% %.4f, "
                    "most %.4f\n",
                    what, name.c_str(), tile_size, pairs, complete, 100.0 * agree / (pairs > 0 ? pairs : 1), only_talus,
                    only_detour, proven, against_floors, off_mesh, mean(), quantile(0.01), quantile(0.5),
                    quantile(0.99), quantile(1.0));
    }
};

enum { PAIRS = 4000 };

void paths_agree(void **)
{
    uint64_t complete = 0, unreachable = 0;
    for (const level &l :
         all_levels(8000, { "nav_test", "dungeon", "undulating", "proto-level", "collision_mesh_01", "test_map01" })) {
        for (uint32_t tile_size : { 0u, 48u }) {
            tl_nav_def def = make_def(l, tile_size);
            detour_level detour;
            TEST_CHECK(detour.build(def, l.view(), l.bounds()));
            auto own = bake(l, def);
            auto own_query = make_query(own.get()), twin_query = make_query(detour.twin.get());
            comparison same_polygons, own_bake;
            const floor_flood floors(l, def);
            detour_random.state = 7;
            dtQueryFilter filter;
            for (int i = 0; i < PAIRS; i++) {
                dtPolyRef ref;
                tl_vec3 start, goal;
                detour.query->findRandomPoint(&filter, detour_unit, &ref, &start.x);
                detour.query->findRandomPoint(&filter, detour_unit, &ref, &goal.x);
                found_path theirs = find_detour(detour, start, goal);
                if (detour.twin_is_whole) {
                    same_polygons.add(find_talus(detour.twin.get(), twin_query.get(), start, goal), theirs);
                }
                found_path ours = find_talus(own.get(), own_query.get(), start, goal);
                own_bake.add(ours, theirs);
                if (ours.on_mesh && theirs.on_mesh) {
                    bool reachable = floors.hang_together(start, goal);
                    own_bake.against_floors += ours.complete != reachable;
                    own_bake.proven += ours.complete == reachable && ours.complete != theirs.complete;
                }
            }
            same_polygons.print("same", l.name, tile_size);
            own_bake.print("own bake", l.name, tile_size);
            // Where they differ, Detour has linked a floor with stairs far above it: it compares the straight edges of
            // a seam, with twice the climb, where here the surface itself is compared.
            TEST_CHECK(!detour.twin_is_whole || same_polygons.agrees());
            // With small cells a polygon's slope may reach over the floor of another island. Five in 10,000 were seen.
            TEST_CHECK(own_bake.agrees() && own_bake.against_floors <= PAIRS / 1000);
            TEST_CHECK(same_polygons.only_talus == 0);
            TEST_CHECK(same_polygons.mean() < 1.002 && same_polygons.quantile(0.99) < 1.08);
            TEST_CHECK(own_bake.mean() < 1.02);
            complete += own_bake.complete;
            unreachable += own_bake.pairs - own_bake.complete;
        }
    }
    TEST_CHECK(!wanted_files.empty() || (complete > 16000 && unreachable > 4000));
}

// Pairs with the answers of a newer Detour on its own bake, as text: a header, then a line a pair, start and end in the
// first six numbers, and behind a bar the number of polygons, of corners, the length, and whether it is complete.
void recorded_paths_agree(void **)
{
    wanted_cell_size = 0.0f; // the records' own
    const char *files[] = { "nav_test_cs0.3_w_solo", "nav_test_cs0.3_w_t48",    "dungeon_cs0.3_w_solo",
                            "dungeon_cs0.3_w_t48",   "undulating_cs0.3_w_solo", "undulating_cs0.3_w_t48" };
    for (const char *file : files) {
        std::ifstream in(std::string(TALUS_DATA_DIR) + "/queries/" + file + ".txt");
        std::string line, word, name;
        uint32_t tile_size = 0;
        while (std::getline(in, line) && line[0] != '#') {
            std::istringstream words(line);
            words >> word;
            word == "mesh" ? words >> name : word == "tile" ? words >> tile_size : words >> word;
        }
        level l;
        if (!in || !load_level(name, &l)) {
            continue;
        }
        auto navmesh = bake(l, make_def(l, tile_size));
        auto query = make_query(navmesh.get());
        comparison recorded;
        while (std::getline(in, line)) {
            tl_vec3 start, goal;
            found_path theirs = { true, false, 0.0 };
            int polygons = 0, corners = 0, complete = 0;
            size_t bar = line.find('|');
            TEST_CHECK(bar != std::string::npos);
            TEST_CHECK(std::sscanf(line.c_str(), "%f %f %f %f %f %f", &start.x, &start.y, &start.z, &goal.x, &goal.y,
                                   &goal.z) == 6);
            TEST_CHECK(std::sscanf(line.c_str() + bar + 1, "%d %d %lf %d", &polygons, &corners, &theirs.length,
                                   &complete) == 4);
            theirs.complete = complete != 0;
            recorded.add(find_talus(navmesh.get(), query.get(), start, goal), theirs);
        }
        recorded.print("recorded", name, tile_size);
        TEST_CHECK(recorded.pairs > 9000 && recorded.agrees() && recorded.mean() < 1.005);
    }
}

} // namespace

int main(int argc, char **argv)
{
    take_level_arguments(argc, argv);
    const struct CMUnitTest tests[] = { cmocka_unit_test(paths_agree), cmocka_unit_test(recorded_paths_agree) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
