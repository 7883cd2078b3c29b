// SPDX-License-Identifier: MIT
//
// Off-mesh connections of a tile that Detour made: read back, put into a navmesh, and used by a path. Every truncated
// prefix is refused.

extern "C" {
#include "talus_test.h"
}

#include <cstring>
#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <talus/nav_detour.h>
#include <talus/nav_query.h>
#include <vector>

namespace
{

// Two squares of ten cells of half a metre with a gap between them, and links over it.
std::vector<unsigned char> make_tile()
{
    const unsigned short vertices[] = {
        0, 0, 0, 0, 0, 10, 10, 0, 10, 10, 0, 0, 14, 0, 0, 14, 0, 10, 24, 0, 10, 24, 0, 0
    };
    std::vector<unsigned short> polygons(2 * 2 * 6, 0xffff);
    for (unsigned short k = 0; k < 4; k++) {
        polygons[k] = k;
        polygons[12 + k] = (unsigned short)(4 + k);
    }
    unsigned short flags[] = { 1, 1 };
    unsigned char areas[] = { 63, 63 };
    const float ends[] = { 4.8f, 0, 2, 7.2f, 0, 2, 7.2f, 0, 3, 4.8f, 0, 3 };
    const float radii[] = { 0.5f, 0.75f };
    const unsigned short link_flags[] = { 8, 9 };
    const unsigned char link_areas[] = { 5, 6 }, directions[] = { 0, DT_OFFMESH_CON_BIDIR };
    const unsigned int ids[] = { 1001, 1002 };
    dtNavMeshCreateParams params;
    memset(&params, 0, sizeof params);
    params.verts = vertices;
    params.vertCount = 8;
    params.polys = polygons.data();
    params.polyFlags = flags;
    params.polyAreas = areas;
    params.polyCount = 2;
    params.nvp = 6;
    params.offMeshConVerts = ends;
    params.offMeshConRad = radii;
    params.offMeshConFlags = link_flags;
    params.offMeshConAreas = link_areas;
    params.offMeshConDir = directions;
    params.offMeshConUserID = ids;
    params.offMeshConCount = 2;
    params.bmax[0] = 12;
    params.bmax[1] = 1;
    params.bmax[2] = 5;
    params.walkableHeight = 2;
    params.walkableRadius = 0.5f;
    params.walkableClimb = 0.5f;
    params.cs = 0.5f;
    params.ch = 0.25f;
    params.buildBvTree = true;
    unsigned char *data = nullptr;
    int size = 0;
    TEST_CHECK(dtCreateNavMeshData(&params, &data, &size));
    std::vector<unsigned char> bytes(data, data + size);
    dtFree(data);
    return bytes;
}

void test_connections(void **)
{
    std::vector<unsigned char> bytes = make_tile();
    tl_detour_off_mesh links[2];
    uint32_t count = 0;
    TEST_RESULT(tl_detour_read_off_mesh(bytes.data(), bytes.size(), links, 1, &count, nullptr), TL_INCOMPLETE);
    TEST_CHECK(count == 2);
    TEST_RESULT(tl_detour_read_off_mesh(bytes.data(), bytes.size(), links, 2, &count, nullptr), TL_OK);
    TEST_CHECK(count == 2 && links[0].user_id == 1001 && links[1].user_id == 1002);
    TEST_CHECK(!links[0].both_ways && links[1].both_ways && links[0].flags == 8 && links[1].area == 6);
    TEST_CHECK(links[0].radius == 0.5f && links[0].start.x == 4.8f && links[0].end.x == 7.2f &&
               links[1].start.z == 3.0f);
    for (size_t cut = 0; cut < bytes.size(); cut++) {
        std::vector<unsigned char> prefix(bytes.begin(), bytes.begin() + (long)cut);
        TEST_CHECK(tl_detour_read_off_mesh(prefix.data(), prefix.size(), links, 2, &count, nullptr) != TL_OK);
        TEST_CHECK(count == 0);
    }
}

void test_path(void **)
{
    std::vector<unsigned char> bytes = make_tile();
    tl_detour_tiles tiles;
    TEST_RESULT(tl_detour_read(bytes.data(), bytes.size(), nullptr, &tiles, nullptr), TL_OK);
    tl_detour_off_mesh links[2];
    uint32_t count = 0;
    TEST_RESULT(tl_detour_read_off_mesh(bytes.data(), bytes.size(), links, 2, &count, nullptr), TL_OK);
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(nullptr, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles.tiles[0], TL_NAV_TILE_BORROWED), TL_OK);
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_offmesh offmesh = tl_default_nav_offmesh();
        offmesh.start = links[i].start;
        offmesh.end = links[i].end;
        offmesh.radius = links[i].radius;
        offmesh.both_ways = links[i].both_ways;
        offmesh.flags = links[i].flags;
        offmesh.area = links[i].area;
        offmesh.user = links[i].user_id;
        tl_nav_ref ref;
        TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &ref, NULL), TL_OK);
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_ref polygons[16];
    tl_nav_corner corners[16];
    tl_nav_path_buffers buffers = { polygons, 16, corners, 16 };
    tl_nav_route route;
    for (int way = 0; way < 2; way++) {
        tl_vec3 west = tl_vec3_make(1, 0, 1), east = tl_vec3_make(11, 0, 1);
        const tl_nav_route_request request = { nullptr, way == 0 ? west : east, way == 0 ? east : west,
                                               tl_vec3_make(1, 1, 1) };
        TEST_RESULT(tl_nav_query_find_route(query, navmesh, &request, &buffers, &route), TL_OK);
        TEST_CHECK(route.path.status == TL_NAV_PATH_COMPLETE && route.corner_count == 4);
        tl_nav_offmesh_state state;
        TEST_RESULT(tl_navmesh_offmesh_state(navmesh, corners[1].link, &state), TL_OK);
        // East by the nearer one; west by the one that leads both ways.
        TEST_CHECK(state.offmesh.user == (way == 0 ? 1001u : 1002u));
    }
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
    tl_detour_tiles_free(&tiles);
}

} // namespace

int main()
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_connections), cmocka_unit_test(test_path) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
