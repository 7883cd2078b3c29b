// SPDX-License-Identifier: MIT
//
// From triangles to a path: bake a navmesh in memory, and find a path around a wall.

#include <talus/nav_bake.h>
#include <talus/nav_query.h>

#include <math.h>
#include <stdio.h>

enum { MAX_POLYGONS = 64, MAX_CORNERS = 64 };

// A floor 20 m square, and a wall 3 m high with a passage around its end at z = 6.
static const tl_vec3 VERTICES[] = { { -10, 0, -10 },  { -10, 0, 10 }, { 10, 0, 10 },  { 10, 0, -10 },
                                    { 0, 0, -10 },    { 0, 0, 6 },    { 0, 3, 6 },    { 0, 3, -10 },
                                    { 0.5f, 0, -10 }, { 0.5f, 0, 6 }, { 0.5f, 3, 6 }, { 0.5f, 3, -10 } };
static const uint32_t INDICES[] = { 0, 1,  2, 0, 2, 3,  4, 5,  6, 4, 6, 7,  8, 11, 10,
                                    8, 10, 9, 5, 9, 10, 5, 10, 6, 7, 6, 10, 7, 10, 11 };

// The navmesh borrows the tiles: they stay while it is used.
static tl_result bake(tl_navmesh *navmesh, tl_nav_tiles *tiles)
{
    tl_nav_input input = { { VERTICES, 12, INDICES, 10, NULL }, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.agent_radius = 0.4f;
    tl_nav_bake_report report;
    tl_result result = tl_nav_bake(&def, &input, tiles, &report);
    if (result != TL_OK) {
        return result;
    }
    printf("%u regions, %u polygons, %u tile\n", report.region_count, report.polygon_count, report.tile_count);
    return tl_navmesh_add_tiles(navmesh, tiles->tiles, tiles->tile_count, TL_NAV_TILE_BORROWED, NULL);
}

static tl_result walk(const tl_navmesh *navmesh, float *length_out)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query;
    tl_result result = tl_nav_query_create(&def, &query, NULL);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_ref polygons[MAX_POLYGONS];
    tl_nav_corner corners[MAX_CORNERS];
    tl_nav_path_buffers buffers = { polygons, MAX_POLYGONS, corners, MAX_CORNERS };
    tl_nav_route route;
    const tl_nav_route_request request = { .start = { -5, 0, -5 }, .goal = { 5, 0, -5 }, .half_extents = { 1, 2, 1 } };
    result = tl_nav_query_find_route(query, navmesh, &request, &buffers, &route);
    if (result == TL_OK && route.path.status == TL_NAV_PATH_COMPLETE) {
        printf("%g m through %u polygons:\n", (double)route.length, route.path.polygon_count);
        for (uint32_t i = 0; i < route.corner_count; i++) {
            printf("  %g %g %g\n", (double)corners[i].point.x, (double)corners[i].point.y, (double)corners[i].point.z);
        }
        *length_out = route.length;
    }
    tl_nav_query_destroy(query);
    return result;
}

int main(void)
{
    tl_navmesh *navmesh;
    tl_nav_tiles tiles = { 0 };
    float length = 0.0f;
    tl_result result = tl_navmesh_create(NULL, &navmesh);
    if (result == TL_OK) {
        result = bake(navmesh, &tiles);
    }
    if (result == TL_OK) {
        result = walk(navmesh, &length);
    }
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
    if (result != TL_OK) {
        fprintf(stderr, "talus: %s\n", tl_result_text(result));
        return 1;
    }
    // Around the wall's bare end it would be 24.4 m; the agent's radius and the straightened contour add up to a metre
    // on each side.
    return length > 24.4f && length < 27.0f ? 0 : 1;
}
