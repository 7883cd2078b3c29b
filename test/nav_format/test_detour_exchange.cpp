// SPDX-License-Identifier: MIT
//
// Tiles exchanged with Detour itself: what talus writes, Detour opens and answers paths on; what Detour has made, talus
// reads, and writes again so that Detour answers as before.

#include "detour_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <talus/nav_detour.h>

// Last: cmocka takes the word fail from the standard headers.
#include "level_list.hpp"

namespace
{

const tl_vec3 EXTENTS = { 2.0f, 4.0f, 2.0f };
enum { PAIRS = 1000, MAX_POLYGONS = 2048 };

struct detour_side {
    std::unique_ptr<dtNavMesh, detour_deleter> mesh{ dtAllocNavMesh() };
    std::unique_ptr<dtNavMeshQuery, detour_deleter> query{ dtAllocNavMeshQuery() };
};

// A set in the way of RecastDemo: its header, then the tiles, each at the reference that it names.
void open_set(const std::vector<unsigned char> &set, detour_side *side)
{
    struct set_header {
        int magic, version, tile_count;
        dtNavMeshParams params;
    } header;
    struct entry {
        dtTileRef reference;
        int size;
    } entry;
    size_t at = sizeof header;
    std::memcpy(&header, set.data(), sizeof header);
    TEST_CHECK(header.magic == ('M' << 24 | 'S' << 16 | 'E' << 8 | 'T') && header.version == 1);
    TEST_CHECK(dtStatusSucceed(side->mesh->init(&header.params)));
    for (int i = 0; i < header.tile_count; i++) {
        std::memcpy(&entry, set.data() + at, sizeof entry);
        at += sizeof entry;
        unsigned char *data = (unsigned char *)dtAlloc((size_t)entry.size, DT_ALLOC_PERM);
        std::memcpy(data, set.data() + at, (size_t)entry.size);
        at += (size_t)entry.size;
        dtTileRef added = 0;
        TEST_CHECK(dtStatusSucceed(side->mesh->addTile(data, entry.size, DT_TILE_FREE_DATA, entry.reference, &added)));
        TEST_CHECK(added == entry.reference);
    }
    TEST_CHECK(at == set.size());
    TEST_CHECK(dtStatusSucceed(side->query->init(side->mesh.get(), 65535)));
}

// As RecastDemo saves it.
std::vector<unsigned char> save_set(const dtNavMesh &mesh)
{
    std::vector<unsigned char> set;
    auto put = [&set](const void *bytes, size_t size) {
        set.insert(set.end(), (const unsigned char *)bytes, (const unsigned char *)bytes + size);
    };
    std::vector<const dtMeshTile *> tiles;
    for (int i = 0; i < mesh.getMaxTiles(); i++) {
        const dtMeshTile *tile = mesh.getTile(i);
        if (tile->header != nullptr) {
            tiles.push_back(tile);
        }
    }
    int head[3] = { 'M' << 24 | 'S' << 16 | 'E' << 8 | 'T', 1, (int)tiles.size() };
    put(head, sizeof head);
    put(mesh.getParams(), sizeof(dtNavMeshParams));
    for (const dtMeshTile *tile : tiles) {
        dtTileRef reference = mesh.getTileRef(tile);
        put(&reference, sizeof reference);
        put(&tile->dataSize, sizeof tile->dataSize);
        put(tile->data, (size_t)tile->dataSize);
    }
    return set;
}

std::vector<unsigned char> write_set(tl_nav_tile *const *tiles, uint32_t count)
{
    const tl_nav_tile *const *list = const_cast<const tl_nav_tile *const *>(tiles);
    std::vector<unsigned char> set(tl_detour_set_size(list, count, TL_DETOUR_REFS_32));
    TEST_RESULT(tl_detour_set_write(list, count, TL_DETOUR_REFS_32, set.data(), set.size(), nullptr), TL_OK);
    return set;
}

test_random random_source;

float unit()
{
    return test_random_unit(&random_source);
}

// Where a path leads over Detour's own polygons.
struct answer {
    std::vector<tl_vec3> corners;
    bool on_mesh, complete;
    int polygon_count;

    double length() const
    {
        double sum = 0.0;
        for (size_t i = 1; i < corners.size(); i++) {
            sum += (double)rcVdist(&corners[i - 1].x, &corners[i].x);
        }
        return sum;
    }
};

answer ask(const detour_side &side, tl_vec3 start, tl_vec3 goal)
{
    dtQueryFilter filter;
    dtPolyRef from = 0, to = 0;
    std::vector<dtPolyRef> polygons(MAX_POLYGONS);
    float near_start[3], near_goal[3];
    side.query->findNearestPoly(&start.x, &EXTENTS.x, &filter, &from, near_start);
    side.query->findNearestPoly(&goal.x, &EXTENTS.x, &filter, &to, near_goal);
    answer found = { {}, from != 0 && to != 0, false, 0 };
    if (found.on_mesh) {
        int corners = 0;
        side.query->findPath(from, to, near_start, near_goal, &filter, polygons.data(), &found.polygon_count,
                             MAX_POLYGONS);
        found.complete = found.polygon_count > 0 && polygons[(size_t)found.polygon_count - 1] == to;
        found.corners.resize(MAX_POLYGONS);
        side.query->findStraightPath(near_start, near_goal, polygons.data(), found.polygon_count, &found.corners[0].x,
                                     nullptr, nullptr, &corners, MAX_POLYGONS);
        found.corners.resize((size_t)corners);
    }
    return found;
}

// How alike two sides answer.
struct likeness {
    uint32_t pairs = 0, same_reach = 0, same_corners = 0, same_length = 0;

    void add(const answer &a, const answer &b)
    {
        pairs++;
        same_reach += a.on_mesh == b.on_mesh && a.complete == b.complete;
        bool same = a.corners.size() == b.corners.size();
        for (size_t i = 0; same && i < a.corners.size(); i++) {
            same = (double)rcVdist(&a.corners[i].x, &b.corners[i].x) < 2e-3;
        }
        same_corners += same;
        same_length += std::fabs(a.length() - b.length()) < 2e-3 * std::max(1.0, a.length());
    }

    void print(const char *what, const std::string &name, uint32_t tile_size) const
    {
        std::printf("%-34s %-12s tile %2u: %u pairs, same reach %u, same corners %u, same length %u\n", what,
                    name.c_str(), tile_size, pairs, same_reach, same_corners, same_length);
    }
};

// Two floors, and links over the gap between them: Detour walks one way, both ways, or not at all, as each link says.
void detour_takes_off_mesh_links(void **)
{
    const tl_vec3 vertices[] = { { 0, 0, 0 },  { 0, 0, 10 },  { 9, 0, 10 },  { 9, 0, 0 },
                                 { 14, 0, 0 }, { 14, 0, 10 }, { 24, 0, 10 }, { 24, 0, 0 } };
    const uint32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    const tl_mesh_view view = { vertices, 8, indices, 4, nullptr };
    tl_detour_off_mesh links[3] = {};
    links[0].start = { 8, 0, 5 };
    links[0].end = { 15, 0, 5 };
    links[0].radius = 0.6f;
    links[0].flags = 1;
    links[0].area = 5;
    links[0].user_id = 77;
    links[1] = links[0];
    links[1].start = { 500, 0, 5 }; // in no tile
    links[2] = links[0];
    links[2].end = { 100, 0, 5 }; // out of all tiles
    for (uint32_t tile_size : { 0u, 32u }) {
        for (bool both_ways : { false, true }) {
            tl_nav_def def = tl_default_nav_def();
            def.tile_size = tile_size;
            const tl_nav_input input = { view, nullptr, nullptr, 0 };
            tl_nav_tiles tiles;
            TEST_RESULT(tl_nav_bake(&def, &input, &tiles, nullptr), TL_OK);
            links[0].both_ways = both_ways;
            const tl_detour_set set = { const_cast<const tl_nav_tile *const *>(tiles.tiles), tiles.tile_count, links, 3,
                                        TL_DETOUR_REFS_32 };
            std::vector<unsigned char> bytes(tl_detour_linked_set_size(&set));
            tl_detour_report report;
            TEST_RESULT(tl_detour_linked_set_write(&set, bytes.data(), bytes.size(), &report), TL_OK);
            TEST_CHECK(report.off_mesh_links == 2 && report.off_mesh_outside == 1 && report.off_mesh_far == 1);
            detour_side linked, bare;
            open_set(bytes, &linked);
            open_set(write_set(tiles.tiles, tiles.tile_count), &bare);
            TEST_CHECK(ask(linked, { 2, 0, 2 }, { 22, 0, 8 }).complete);
            TEST_CHECK(ask(linked, { 22, 0, 8 }, { 2, 0, 2 }).complete == both_ways);
            TEST_CHECK(!ask(bare, { 2, 0, 2 }, { 22, 0, 8 }).complete);
            tl_detour_off_mesh back[3];
            uint32_t count = 0;
            TEST_RESULT(tl_detour_read_off_mesh(bytes.data(), bytes.size(), back, 3, &count, nullptr), TL_OK);
            TEST_CHECK(count == 2 && back[0].user_id == 77 && back[0].area == 5 && back[0].both_ways == both_ways &&
                       back[0].start.x == 8.0f && back[0].end.x == 15.0f && back[0].radius == 0.6f);
            links[0].area = 64;
            TEST_RESULT(tl_detour_linked_set_write(&set, bytes.data(), bytes.size(), &report), TL_ERR_LIMIT);
            links[0].area = 5;
            links[2].radius = 0.0f;
            TEST_RESULT(tl_detour_linked_set_write(&set, bytes.data(), bytes.size(), &report), TL_ERR_ARGUMENT);
            TEST_CHECK(report.base.element_index == 2);
            links[2].radius = 0.6f;
            tl_nav_tiles_free(&tiles);
        }
    }
}

// Detour's own navmesh; read by talus; written again; opened by Detour: the same answers.
void detour_comes_back_the_same(void **)
{
    uint64_t polygons = 0;
    for (const level &l : all_levels(8000, { "nav_test", "dungeon", "undulating" })) {
        for (uint32_t tile_size : { 0u, 48u }) {
            tl_nav_def def = tl_default_nav_def();
            def.cell_size = l.cell_size;
            def.tile_size = tile_size;
            detour_level first;
            TEST_CHECK(first.build(def, l.view(), l.bounds()));
            std::vector<unsigned char> saved = save_set(*first.mesh);
            tl_detour_tiles tiles;
            tl_detour_report report;
            TEST_RESULT(tl_detour_read(saved.data(), saved.size(), nullptr, &tiles, &report), TL_OK);
            TEST_CHECK(report.dropped_polygons == 0 || !first.twin_is_whole);
            detour_side again;
            open_set(write_set(tiles.tiles, tiles.tile_count), &again);
            detour_side original;
            original.mesh = std::move(first.mesh);
            original.query = std::move(first.query);
            likeness alike;
            random_source.state = 11;
            dtQueryFilter filter;
            for (int i = 0; i < PAIRS; i++) {
                dtPolyRef ref;
                tl_vec3 start, goal;
                original.query->findRandomPoint(&filter, unit, &ref, &start.x);
                original.query->findRandomPoint(&filter, unit, &ref, &goal.x);
                alike.add(ask(original, start, goal), ask(again, start, goal));
            }
            alike.print("Detour -> talus -> Detour", l.name, tile_size);
            // Heights are rounded by half a millimetre: where two floors are equally near, or two ways equally long,
            // the choice may fall otherwise; a corner that a straight way just grazes may be named or not.
            TEST_CHECK(alike.same_reach >= PAIRS - 1 && alike.same_length >= PAIRS * 99 / 100);
            TEST_CHECK(alike.same_corners >= PAIRS * 95 / 100);
            polygons += report.polygon_count;
            tl_detour_tiles_free(&tiles);
        }
    }
    TEST_CHECK(polygons > 1000);
}

// A bake of talus's, in Detour: it reaches what talus reaches, by ways of the same length.
void talus_answers_in_detour(void **)
{
    for (const level &l : all_levels(8000, { "nav_test", "dungeon", "undulating" })) {
        for (uint32_t tile_size : { 0u, 48u }) {
            tl_nav_def def = tl_default_nav_def();
            def.cell_size = l.cell_size;
            def.tile_size = tile_size;
            tl_nav_input input = {};
            input.mesh = l.view();
            tl_nav_tiles tiles;
            TEST_RESULT(tl_nav_bake(&def, &input, &tiles, nullptr), TL_OK);
            detour_side side;
            open_set(write_set(tiles.tiles, tiles.tile_count), &side);
            tl_navmesh *made = nullptr;
            TEST_RESULT(tl_navmesh_create(nullptr, &made), TL_OK);
            std::unique_ptr<tl_navmesh, detour_deleter> navmesh(made);
            for (uint32_t i = 0; i < tiles.tile_count; i++) {
                TEST_RESULT(tl_navmesh_add_tile(made, tiles.tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
            }
            tl_nav_query_def query_def = tl_default_nav_query_def();
            query_def.max_nodes = (uint32_t)tl_navmesh_link_count(made) + 2;
            tl_nav_query *query_made = nullptr;
            TEST_RESULT(tl_nav_query_create(&query_def, &query_made, NULL), TL_OK);
            std::unique_ptr<tl_nav_query, detour_deleter> query(query_made);
            uint32_t same_reach = 0, complete = 0, unreachable = 0;
            double ratio = 0.0;
            random_source.state = 13;
            dtQueryFilter filter;
            for (int i = 0; i < PAIRS; i++) {
                dtPolyRef ref;
                tl_vec3 start, goal;
                side.query->findRandomPoint(&filter, unit, &ref, &start.x);
                side.query->findRandomPoint(&filter, unit, &ref, &goal.x);
                answer theirs = ask(side, start, goal);
                std::vector<tl_nav_ref> polygons(MAX_POLYGONS);
                std::vector<tl_nav_corner> corners(MAX_POLYGONS);
                tl_nav_path_buffers buffers = { polygons.data(), MAX_POLYGONS, corners.data(), MAX_POLYGONS };
                tl_nav_route route;
                const tl_nav_route_request request = { nullptr, start, goal, EXTENTS };
                TEST_RESULT(tl_nav_query_find_route(query.get(), made, &request, &buffers, &route), TL_OK);
                bool reached = route.path.status == TL_NAV_PATH_COMPLETE;
                same_reach += reached == theirs.complete;
                unreachable += !reached && !theirs.complete;
                if (reached && theirs.complete && theirs.length() > 1.0) {
                    complete++;
                    ratio += (double)route.length / theirs.length();
                }
            }
            std::printf("%-34s %-12s tile %2u: %d pairs, same reach %u (%u unreachable), mean length / Detour's %.4f\n",
                        "talus -> Detour", l.name.c_str(), tile_size, (int)PAIRS, same_reach, unreachable,
                        ratio / complete);
            TEST_CHECK(same_reach >= PAIRS - 2 && complete > PAIRS / 4);
            TEST_CHECK(ratio / complete > 0.98 && ratio / complete < 1.005);
            tl_nav_tiles_free(&tiles);
        }
    }
}

} // namespace

int main()
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(detour_takes_off_mesh_links),
                                        cmocka_unit_test(detour_comes_back_the_same),
                                        cmocka_unit_test(talus_answers_in_detour) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
