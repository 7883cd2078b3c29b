// SPDX-License-Identifier: MIT
//
// A world of tiles that is streamed from a file's bytes, far from the origin: its routes as they are baked, and what is
// answered by them, with all tiles in memory and with those of both ends alone.

#include "../support/memory_file.h"
#include "golden.h"

enum { ROUTES = 150, POINTS = 64 };

/// The file of the tiles; `routes` may be NULL.
static memory_file pack_world(const tl_nav_def *def, const tl_nav_tiles *tiles, const tl_nav_routes *routes)
{
    static const double origin[3] = { 1e7, -300, 2e7 };
    memory_file file = { NULL, 0, 0 };
    tl_pack_navmesh *navmesh;
    tl_pack_frame *frame;
    tl_pack_item *items = calloc((size_t)tiles->tile_count + 3, sizeof *items);
    must(items != NULL ? TL_OK : TL_ERR_MEMORY, "calloc");
    MUST(tl_pack_navmesh_encode(def, tiles->tiles_x, tiles->tiles_z, tiles->tile_count, NULL, &navmesh, NULL));
    MUST(tl_pack_frame_encode(TL_PACK_AXES_Z_UP, origin, NULL, &frame, NULL));
    uint32_t count = 0;
    items[count++] = (tl_pack_item){ TL_PACK_NAVM, 0, navmesh, navmesh->blob.size };
    items[count++] = (tl_pack_item){ TL_PACK_FRAM, 0, frame, frame->blob.size };
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        items[count++] = (tl_pack_item){ TL_PACK_NAVT, i, tiles->tiles[i], tiles->tiles[i]->blob.size };
    }
    if (routes != NULL) {
        items[count++] = (tl_pack_item){ TL_PACK_ROUT, 0, routes, routes->blob.size };
    }
    MUST(tl_pack_write(items, count, NULL, memory_file_write, &file, NULL));
    tl_blob_free(navmesh);
    tl_blob_free(frame);
    free(items);
    return file;
}

static tl_nav_world *open_world(memory_file *file)
{
    tl_nav_world *world;
    tl_nav_world_def def = tl_default_nav_world_def();
    def.read = memory_file_read;
    def.user = file;
    def.frame_reach = 10.0;
    MUST(tl_nav_world_create(&def, &world, NULL));
    return world;
}

/// Loads what is wanted, in order.
static void settle(tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count)
{
    tl_nav_world_load load;
    tl_result updated;
    do {
        updated = tl_nav_world_update(world, interests, count, 64);
        must(updated == TL_NOT_FOUND ? TL_OK : updated, "tl_nav_world_update");
        while (tl_nav_world_begin_load(world, &load) == TL_OK) {
            MUST(tl_nav_world_run_load(&load));
            MUST(tl_nav_world_end_load(&load));
            updated = TL_OK;
        }
    } while (updated == TL_OK);
}

/// Places of the level in whole 1024ths; the level is z up.
static void roll_place(dice *random, double out[3])
{
    out[0] = 1e7 + (double)roll_between(random, 0, 40);
    out[1] = -300.0 - (double)roll_between(random, 0, 40);
    out[2] = 2e7 + (double)roll_between(random, 0, 4);
}

static void digest_route(digest *d, tl_nav_world *world, tl_nav_router *router, double ends[2][3])
{
    static tl_nav_world_route_point points[POINTS];
    const tl_vec3 extents = { 3, 3, 6 };
    tl_nav_world_route_request request;
    tl_nav_world_route route;
    tl_nav_location *at[2] = { &request.start, &request.goal };
    for (int i = 0; i < 2; i++) {
        const tl_result found = tl_nav_world_find_nearest(world, NULL, ends[i], extents, at[i]);
        digest_u32(d, (uint32_t)found);
        if (found != TL_OK) {
            return;
        }
        digest_vec3(d, at[i]->point);
    }
    digest_result(d, tl_nav_world_find_route(world, router, &request, points, POINTS, &route));
    digest_u32(d, (uint32_t)route.status);
    digest_f64(d, route.length);
    digest_f64(d, route.lower_bound);
    for (uint32_t i = 0; i < route.point_count && i < POINTS; i++) {
        digest_f64(d, points[i].point[0]);
        digest_f64(d, points[i].point[1]);
        digest_f64(d, points[i].length);
    }
}

static void digest_routes(memory_file *file, const char *part, bool whole)
{
    dice random = { 77 };
    tl_nav_world *world = open_world(file);
    tl_nav_router *router;
    digest d = digest_begin();
    MUST(tl_nav_router_create(world, NULL, &router, NULL));
    for (uint32_t i = 0; i < ROUTES; i++) {
        double ends[2][3];
        tl_nav_world_interest interests[2];
        for (int e = 0; e < 2; e++) {
            roll_place(&random, ends[e]);
            memcpy(interests[e].point, ends[e], sizeof ends[e]);
            interests[e].radius = whole ? 1000.0 : 6.0;
        }
        settle(world, interests, 2);
        digest_route(&d, world, router, ends);
    }
    digest_print(&d, "world", part);
    tl_nav_router_destroy(router);
    tl_nav_world_destroy(world);
}

void golden_world(const tl_mesh_view *view)
{
    tl_nav_tiles tiles;
    tl_nav_routes *routes;
    tl_nav_def def = tl_default_nav_def();
    const tl_nav_input input = { *view, NULL, NULL, 0 };
    def.tile_size = 20;
    def.bounds = (tl_aabb){ { 0, -1, 0 }, { 40, 14, 40 } };
    MUST(tl_nav_bake(&def, &input, &tiles, NULL));
    memory_file bare = pack_world(&def, &tiles, NULL);
    tl_nav_routes_def routes_def = tl_default_nav_routes_def();
    routes_def.read = memory_file_read;
    routes_def.user = &bare;
    routes_def.block = 2;
    MUST(tl_nav_routes_bake(&routes_def, &routes, NULL));
    digest d = digest_begin();
    digest_blob(&d, routes);
    digest_print(&d, "world", "routes");
    memory_file file = pack_world(&def, &tiles, routes);
    digest_routes(&file, "all-loaded", true);
    digest_routes(&file, "ends-loaded", false);
    tl_blob_free(routes);
    tl_nav_tiles_free(&tiles);
    free(bare.bytes);
    free(file.bytes);
}
