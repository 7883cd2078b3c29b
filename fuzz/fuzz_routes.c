// SPDX-License-Identifier: MIT
//
// Untrusted bytes as the routes of a world's file (chunk ROUT): what passes the checks is safe to ask, and says nothing
// impossible. The input is patches of the true chunk, six bytes each: a word's index, and what is written there. The
// file's hashes are made right, so that what is behind them is reached.

#include "fuzz/holed_floor.h"
#include "test/support/memory_file.h"

#include <math.h>
#include <talus/nav_routes.h>

enum { PATCH = 6, PLACES = 6, POINTS = 32 };

static memory_file bare, patched; // without routes, and with the input's
static tl_nav_tiles tiles;
static tl_pack_navmesh *settings;
static tl_nav_routes *routes;

static void write_file(const tl_nav_routes *extra, memory_file *file)
{
    tl_pack_item items[64];
    uint32_t count = 0;
    const tl_pack_item head = { TL_PACK_NAVM, 0, settings, settings->blob.size };
    items[count++] = head;
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        const tl_pack_item tile = { TL_PACK_NAVT, i, tiles.tiles[i], tiles.tiles[i]->blob.size };
        require(count < 63);
        items[count++] = tile;
    }
    if (extra != NULL) {
        const tl_pack_item item = { TL_PACK_ROUT, 0, extra, routes->blob.size };
        items[count++] = item;
    }
    file->size = 0;
    require(tl_pack_write(items, count, NULL, memory_file_write, file, NULL) == TL_OK);
}

// 3 x 3 tiles, and the routes over them.
static void make_world(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.5f;
    def.agent_radius = 0.0f;
    def.tile_size = 14;
    def.region_min_size = 0;
    holed_floor_bake(&def, &tiles);
    require(tl_pack_navmesh_encode(&def, tiles.tiles_x, tiles.tiles_z, tiles.tile_count, NULL, &settings, NULL) ==
            TL_OK);
    write_file(NULL, &bare);
    tl_nav_routes_def routes_def = tl_default_nav_routes_def();
    routes_def.read = memory_file_read;
    routes_def.user = &bare;
    routes_def.block = 2;
    require(tl_nav_routes_bake(&routes_def, &routes, NULL) == TL_OK && routes->gate_count > 4);
}

static void load_all(tl_nav_world *world)
{
    const tl_nav_world_interest everywhere = { { 10, 0, 10 }, 100.0 };
    tl_nav_world_load load;
    tl_result result = tl_nav_world_update(world, &everywhere, 1, 64);
    while (tl_nav_world_begin_load(world, &load) == TL_OK) {
        require(tl_nav_world_run_load(&load) == TL_OK && tl_nav_world_end_load(&load) == TL_OK);
        result = tl_nav_world_update(world, &everywhere, 1, 64);
        require(result == TL_OK || result == TL_NOT_FOUND);
    }
}

static void ask(const tl_nav_world *world, tl_nav_router *router)
{
    tl_nav_location at[PLACES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < PLACES; i++) {
        const double point[3] = { 1.0 + 3.4 * (double)i, 0.0, 1.0 + 3.0 * (double)(i * 5 % 7) };
        const tl_vec3 extents = { 3, 1, 3 };
        count += tl_nav_world_find_nearest(world, NULL, point, extents, &at[count]) == TL_OK;
    }
    for (uint32_t i = 0; i < count * count; i++) {
        const tl_nav_world_route_request request = { at[i / count], at[i % count] };
        tl_nav_world_route_point points[POINTS];
        tl_nav_world_route route;
        const tl_result result = tl_nav_world_find_route(world, router, &request, points, POINTS, &route);
        require(result == TL_OK || result == TL_INCOMPLETE || result == TL_ERR_CORRUPT);
        if (result == TL_OK && route.status == TL_NAV_PATH_COMPLETE) {
            require(route.point_count >= 2 && route.point_count <= POINTS && !isnan(route.length));
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (routes == NULL) {
        make_world();
    }
    tl_nav_routes *copy = aligned_alloc(64, (size_t)(routes->blob.size + 63) / 64 * 64);
    require(copy != NULL);
    memcpy(copy, routes, (size_t)routes->blob.size);
    const size_t words = (size_t)routes->blob.size / 4;
    for (; size >= PATCH; data += PATCH, size -= PATCH) {
        const size_t at = 4 + ((size_t)data[0] | (size_t)data[1] << 8) % (words - 4); // behind the blob's head
        memcpy((uint8_t *)copy + 4 * at, data + 2, 4);
    }
    write_file(copy, &patched);
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    tl_nav_router *router = NULL;
    def.read = memory_file_read;
    def.user = &patched;
    if (tl_nav_world_create(&def, &world, NULL) == TL_OK) {
        require(tl_nav_router_create(world, NULL, &router, NULL) == TL_OK);
        load_all(world);
        ask(world, router);
        tl_nav_router_destroy(router);
        tl_nav_world_destroy(world);
    }
    free(copy);
    return 0;
}
