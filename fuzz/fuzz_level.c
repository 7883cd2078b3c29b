// SPDX-License-Identifier: MIT
//
// A level of any few triangles with any settings, through everything that is baked from one: navmesh, links, audit,
// reasons, obstacles. A bake fails by name or its tiles are sound; the order of the triangles does not change a byte;
// obstacles that are gone again leave the bytes of the first bake.

#include "fuzz/fuzz_input.h"

#include <math.h>
#include <string.h>
#include <talus/nav_audit.h>
#include <talus/nav_bake.h>
#include <talus/nav_links.h>
#include <talus/nav_obstacles.h>
#include <talus/nav_query.h>
#include <talus/soup.h>

enum { MAX_VERTICES = 32, MAX_TRIANGLES = 40, MAX_AUDIT_STEPS = 1 << 13, MAX_OBSTACLES = 4 };

typedef struct level {
    fuzz_bytes bytes;
    tl_vec3 vertices[MAX_VERTICES];
    uint32_t indices[3 * MAX_TRIANGLES], reversed[3 * MAX_TRIANGLES];
    uint8_t areas[MAX_TRIANGLES], reversed_areas[MAX_TRIANGLES];
    tl_nav_input input, backwards;
    tl_nav_def def;
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    tl_soup *soup;
} level;

static tl_vec3 next_point(level *l)
{
    const float x = next_grid_coordinate(&l->bytes), y = 0.25f * next_grid_coordinate(&l->bytes);
    return tl_vec3_make(x, y, next_grid_coordinate(&l->bytes));
}

// The same triangles in reverse order too.
static void read_triangles(level *l)
{
    const uint32_t vertex_count = 3 + next_byte(&l->bytes) % (MAX_VERTICES - 2),
                   count = 1 + next_byte(&l->bytes) % MAX_TRIANGLES;
    for (uint32_t i = 0; i < vertex_count; i++) {
        l->vertices[i] = next_point(l);
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t other = count - 1 - i;
        for (uint32_t k = 0; k < 3; k++) {
            l->indices[3 * i + k] = next_byte(&l->bytes) % vertex_count;
            l->reversed[3 * other + k] = l->indices[3 * i + k];
        }
        l->areas[i] = (uint8_t)(next_byte(&l->bytes) % 8 == 0 ? i : TL_NAV_WALKABLE_AREA);
        l->reversed_areas[other] = l->areas[i];
    }
    const tl_mesh_view forwards = { l->vertices, vertex_count, l->indices, count, NULL };
    const tl_mesh_view backwards = { l->vertices, vertex_count, l->reversed, count, NULL };
    l->input.mesh = forwards;
    l->input.areas = l->areas;
    l->backwards.mesh = backwards;
    l->backwards.areas = l->reversed_areas;
}

// Settings between useless and useful; the cells are never so small that a bake takes long.
static void read_def(level *l)
{
    l->def = tl_default_nav_def();
    l->def.cell_size = 0.125f * (float)(1 + next_byte(&l->bytes) % 8);
    l->def.cell_height = 0.0625f * (float)(1 + next_byte(&l->bytes) % 8);
    l->def.agent_height = 0.25f * (float)(1 + next_byte(&l->bytes) % 10);
    l->def.agent_radius = 0.125f * (float)(next_byte(&l->bytes) % 8);
    l->def.agent_max_climb = 0.125f * (float)(next_byte(&l->bytes) % 12);
    l->def.agent_max_slope = (float)(next_byte(&l->bytes) % 90);
    l->def.region_min_size = (float)(next_byte(&l->bytes) % 8);
    l->def.region_merge_size = (float)(next_byte(&l->bytes) % 24);
    l->def.edge_max_len = (float)(next_byte(&l->bytes) % 16);
    l->def.edge_max_error = 0.25f * (float)(next_byte(&l->bytes) % 16);
    l->def.max_verts_per_poly = 3 + next_byte(&l->bytes) % 10;
    l->def.detail_sample_dist = (float)(next_byte(&l->bytes) % 8);
    l->def.partition = (tl_nav_partition)(next_byte(&l->bytes) % 3);
    l->def.polygon_method = (tl_partition_method)(next_byte(&l->bytes) % 2);
    const uint8_t filters = next_byte(&l->bytes);
    l->def.filter_low_hanging_obstacles = filters % 2 == 0;
    l->def.filter_ledge_spans = filters / 2 % 2 == 0;
    l->def.filter_walkable_low_height_spans = filters / 4 % 2 == 0;
    l->def.tile_size = filters / 8 % 2 == 0 ? 0 : 8 + filters / 16;
    l->def.tile_height = filters / 8 % 4 == 3 ? 1.5f : 0.0f;
    const tl_aabb bounds = { { 0, -2, 0 }, { 16, 6, 16 } };
    l->def.bounds = bounds;
}

static bool same_tiles(const tl_nav_tiles *a, const tl_nav_tiles *b)
{
    bool same = a->tile_count == b->tile_count;
    for (uint32_t i = 0; same && i < a->tile_count; i++) {
        same = a->tiles[i]->blob.size == b->tiles[i]->blob.size &&
               memcmp(a->tiles[i], b->tiles[i], (size_t)a->tiles[i]->blob.size) == 0;
    }
    return same;
}

static bool bake(level *l)
{
    const tl_result result = tl_nav_bake(&l->def, &l->input, &l->tiles, NULL);
    tl_nav_tiles backwards;
    require(tl_nav_bake(&l->def, &l->backwards, &backwards, NULL) == result);
    require(result == TL_OK || result == TL_ERR_NOT_FINITE || result == TL_ERR_RANGE || result == TL_ERR_EMPTY);
    require(same_tiles(&l->tiles, &backwards));
    tl_nav_tiles_free(&backwards);
    for (uint32_t i = 0; i < l->tiles.tile_count; i++) {
        require(tl_nav_tile_check(l->tiles.tiles[i], l->tiles.tiles[i]->blob.size, NULL) == TL_OK);
        require(tl_navmesh_add_tile(l->navmesh, l->tiles.tiles[i], TL_NAV_TILE_BORROWED) == TL_OK);
    }
    return result == TL_OK;
}

static void ask_path(level *l, tl_nav_query *query)
{
    tl_nav_ref polygons[128];
    tl_nav_corner corners[128];
    tl_nav_path_buffers buffers = { polygons, 128, corners, 128 };
    const tl_vec3 start = next_point(l), goal = next_point(l), extents = { 2.0f, 4.0f, 2.0f };
    const tl_nav_route_request request = { .start = start, .goal = goal, .half_extents = extents };
    tl_nav_route route;
    const tl_result result = tl_nav_query_find_route(query, l->navmesh, &request, &buffers, &route);
    require(!tl_is_error(result) || result == TL_ERR_NOT_FINITE || result == TL_ERR_NODES);
    if (result == TL_OK) {
        const tl_vec3 way = tl_sub(route.goal.point, route.start.point);
        const float straight = hypotf(way.x, way.z); // lengths are in the plane
        require(route.corner_count >= 2 && isfinite(route.length));
        require(route.path.status != TL_NAV_PATH_COMPLETE || route.length >= 0.999f * straight - 1e-4f);
    }
}

static void find_links(const level *l)
{
    tl_nav_links *links;
    const tl_result result = tl_nav_links_find(NULL, l->navmesh, l->soup, &links, NULL);
    require(result == TL_OK || result == TL_ERR_EMPTY);
    if (result == TL_OK) {
        require(tl_nav_links_check(links, links->blob.size, NULL) == TL_OK);
        const tl_nav_offmesh prototype = tl_default_nav_offmesh();
        require(tl_nav_links_add(links, &prototype, l->navmesh) == TL_OK);
        tl_blob_free(links);
    }
}

static void run_audit(const level *l)
{
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.nav = l->def;
    def.areas = l->areas;
    def.path_count = 4;
    def.max_steps = MAX_AUDIT_STEPS;
    tl_nav_audit audit;
    const tl_result result = tl_nav_audit_run(&def, l->navmesh, l->soup, &audit, NULL);
    require(result == TL_OK || result == TL_ERR_LIMIT || result == TL_ERR_EMPTY);
    tl_nav_audit_free(&audit);
}

static void ask_why(level *l)
{
    tl_nav_why_answer answer;
    const tl_result result = tl_nav_why(&l->def, &l->input, l->navmesh, NULL, next_point(l), &answer, NULL);
    require(!tl_is_error(result) || result == TL_ERR_NOT_FINITE || result == TL_ERR_RANGE);
    require(result != TL_OK || answer.walkable == (answer.reason_count == 0));
}

static tl_nav_obstacle next_obstacle(level *l)
{
    tl_nav_obstacle obstacle;
    memset(&obstacle, 0, sizeof obstacle);
    const uint8_t kind = next_byte(&l->bytes);
    obstacle.shape = kind % 2 == 0 ? TL_NAV_OBSTACLE_CYLINDER : TL_NAV_OBSTACLE_BOX;
    obstacle.area = kind % 4 < 2 ? TL_NAV_NULL_AREA : 7;
    obstacle.base = next_point(l);
    obstacle.height = 0.25f * (float)(next_byte(&l->bytes) % 16);
    obstacle.radius = 0.125f * (float)(1 + next_byte(&l->bytes) % 32);
    obstacle.half_x = obstacle.radius;
    obstacle.half_z = 0.125f * (float)(next_byte(&l->bytes) % 16);
    obstacle.cosine = (float)(next_byte(&l->bytes) % 5) - 2.0f;
    obstacle.sine = 1.0f;
    return obstacle;
}

static void update_all(tl_nav_obstacles *obstacles, tl_navmesh *navmesh)
{
    uint32_t waiting = 0;
    require(tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, &waiting, NULL) == TL_OK && waiting == 0);
}

static void check_bytes(const level *l, const tl_navmesh *navmesh)
{
    for (uint32_t i = 0; i < l->tiles.tile_count; i++) {
        const tl_nav_tile *tile = l->tiles.tiles[i];
        const tl_nav_tile *found = tl_navmesh_find_layer(navmesh, tile->tile_x, tile->layer, tile->tile_z);
        require(found != NULL && found->blob.size == tile->blob.size &&
                memcmp(found, tile, (size_t)tile->blob.size) == 0);
    }
    require(tl_navmesh_tile_count(navmesh) == l->tiles.tile_count);
}

static void put_obstacles(level *l)
{
    tl_nav_obstacles *obstacles;
    tl_nav_obstacle_id ids[MAX_OBSTACLES];
    tl_navmesh *navmesh;
    const uint32_t count = next_byte(&l->bytes) % (MAX_OBSTACLES + 1);
    require(tl_navmesh_create(NULL, &navmesh) == TL_OK);
    require(tl_nav_obstacles_bake(&l->def, &l->input, &obstacles, NULL, NULL) == TL_OK);
    uint32_t added = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_obstacle obstacle = next_obstacle(l);
        const tl_result result = tl_nav_obstacles_add(obstacles, &obstacle, &ids[added], NULL);
        require(result == TL_OK || result == TL_ERR_NOT_FINITE || result == TL_ERR_ARGUMENT);
        added += result == TL_OK ? 1 : 0;
    }
    update_all(obstacles, navmesh);
    for (uint32_t i = 0; i < added; i++) {
        require(tl_nav_obstacles_remove(obstacles, ids[i]) == TL_OK);
        update_all(obstacles, navmesh);
    }
    check_bytes(l, navmesh);
    tl_nav_obstacles_destroy(obstacles);
    tl_navmesh_destroy(navmesh);
}

static void use_navmesh(level *l)
{
    tl_nav_query *query;
    const tl_nav_query_def def = { 2 + next_byte(&l->bytes), NULL, TL_DEF_COOKIE };
    require(tl_nav_query_create(&def, &query, NULL) == TL_OK);
    for (uint32_t i = 0; i < 4; i++) {
        ask_path(l, query);
    }
    if (tl_soup_bake(&l->input.mesh, NULL, &l->soup, NULL) == TL_OK) {
        run_audit(l);
        find_links(l);
    }
    ask_why(l);
    if (l->def.tile_size > 0) {
        put_obstacles(l);
    }
    tl_nav_query_destroy(query);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static level l;
    memset(&l, 0, sizeof l);
    l.bytes = (fuzz_bytes){ data, size };
    require(tl_navmesh_create(NULL, &l.navmesh) == TL_OK);
    read_def(&l);
    read_triangles(&l);
    if (bake(&l)) {
        use_navmesh(&l);
    }
    tl_navmesh_destroy(l.navmesh);
    tl_nav_tiles_free(&l.tiles);
    tl_blob_free(l.soup);
    return 0;
}
