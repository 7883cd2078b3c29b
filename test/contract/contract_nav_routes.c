// SPDX-License-Identifier: MIT
//
// nav_routes.h.

#include "contract_world_file.h"

static const char *const ROUTES_FIELDS[] = { "read", "block", NULL };

static tl_result bake_routes(memory_file *file, const tl_host *host, tl_nav_routes **routes_out)
{
    tl_nav_routes_def def = tl_default_nav_routes_def();
    def.read = memory_file_read;
    def.user = file;
    def.host = *host;
    return tl_nav_routes_bake(&def, routes_out, NULL);
}

static tl_result routes_bake(contract_run *run)
{
    memory_file file = level_file_make(NULL, 0);
    tl_nav_routes_def def = tl_default_nav_routes_def();
    tl_nav_routes *routes = NULL;
    def.read = memory_file_read;
    def.user = &file;
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.read = run->variant == 0 ? NULL : memory_file_read;
        def.block = run->variant == 1 ? 3 : def.block;
    }
    file.bytes[100] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    def.host = *run->host;
    const tl_result result = tl_nav_routes_bake(run->what == CONTRACT_NULL_INPUT ? NULL : &def,
                                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &routes, run->report);
    run->is_clear = routes == NULL;
    run->answer = routes != NULL ? contract_hash(routes, (size_t)routes->blob.size, 0) : 0;
    tl_blob_free(routes);
    free(file.bytes);
    return result;
}

static tl_result routes_check(contract_run *run)
{
    const tl_host plain = { NULL, NULL, NULL };
    memory_file file = level_file_make(NULL, 0);
    tl_nav_routes *routes = NULL;
    TEST_RESULT(bake_routes(&file, &plain, &routes), TL_OK);
    routes->block ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const tl_result result =
        tl_nav_routes_check(run->what == CONTRACT_NULL_INPUT ? NULL : routes, routes->blob.size, run->report);
    run->is_clear = true;
    tl_blob_free(routes);
    free(file.bytes);
    return result;
}

// CONTRACT_BAD_BYTES: routes of other tiles.
static tl_result routes_check_tiles(contract_run *run)
{
    const tl_host plain = { NULL, NULL, NULL };
    memory_file file = level_file_make(NULL, 0);
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_routes *routes = NULL;
    tl_nav_world *world = NULL;
    def.read = memory_file_read;
    def.user = &file;
    TEST_RESULT(bake_routes(&file, &plain, &routes), TL_OK);
    TEST_RESULT(tl_nav_world_create(&def, &world, NULL), TL_OK);
    routes->tiles_hash[1] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const tl_result result = tl_nav_routes_check_tiles(CONTRACT_INPUT(run, 0, routes),
                                                       CONTRACT_INPUT(run, 1, tl_nav_world_index(world)), run->report);
    run->is_clear = true;
    tl_nav_world_destroy(world);
    tl_blob_free(routes);
    free(file.bytes);
    return result;
}

// A world with its routes, all tiles in memory.
typedef struct routed_world {
    memory_file *file;
    tl_nav_world *world;
    tl_nav_router *router;
    tl_nav_world_route_request request;
} routed_world;

static routed_world routed_begin(bool with_routes)
{
    const tl_host plain = { NULL, NULL, NULL };
    routed_world open;
    tl_nav_routes *routes = NULL;
    memory_file bare = level_file_make(NULL, 0);
    memset(&open, 0, sizeof open);
    TEST_RESULT(bake_routes(&bare, &plain, &routes), TL_OK);
    open.file = malloc(sizeof *open.file);
    TEST_CHECK(open.file != NULL);
    *open.file = with_routes ? level_file_make(routes, routes->blob.size) : level_file_make(NULL, 0);
    tl_blob_free(routes);
    free(bare.bytes);
    tl_nav_world_def def = tl_default_nav_world_def();
    def.read = memory_file_read;
    def.user = open.file;
    TEST_RESULT(tl_nav_world_create(&def, &open.world, NULL), TL_OK);
    const tl_nav_world_interest interest = { { 10, 0, 10 }, 100 };
    for (int i = 0; i < 32; i++) {
        tl_nav_world_load load;
        TEST_CHECK(!tl_is_error(tl_nav_world_update(open.world, &interest, 1, 8)));
        if (tl_nav_world_begin_load(open.world, &load) == TL_OK) {
            TEST_RESULT(tl_nav_world_run_load(&load), TL_OK);
            TEST_RESULT(tl_nav_world_end_load(&load), TL_OK);
        }
    }
    static const double here[3] = { 4, 0, 10 }, there[3] = { 16, 0, 10 };
    const tl_vec3 extents = tl_vec3_make(1, 1, 1);
    TEST_RESULT(tl_nav_world_find_nearest(open.world, NULL, here, extents, &open.request.start), TL_OK);
    TEST_RESULT(tl_nav_world_find_nearest(open.world, NULL, there, extents, &open.request.goal), TL_OK);
    return open;
}

static void routed_end(routed_world *open)
{
    tl_nav_router_destroy(open->router);
    tl_nav_world_destroy(open->world);
    free(open->file->bytes);
    free(open->file);
}

static tl_result router_create(contract_run *run)
{
    routed_world open = routed_begin(run->what != CONTRACT_NOT_FOUND);
    const tl_result result =
        tl_nav_router_create(run->what == CONTRACT_NULL_INPUT ? NULL : open.world, run->host->allocator,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &open.router, run->report);
    run->is_clear = open.router == NULL;
    run->answer = open.router != NULL;
    routed_end(&open);
    return result;
}

static tl_result router_destroy(contract_run *run)
{
    (void)run;
    tl_nav_router_destroy(NULL);
    return TL_OK;
}

static tl_result find_route(contract_run *run)
{
    routed_world open = routed_begin(true);
    TEST_RESULT(tl_nav_router_create(open.world, NULL, &open.router, NULL), TL_OK);
    if (run->what == CONTRACT_STALE) {
        open.request.goal.polygon = contract_level_get()->stale;
    }
    tl_nav_world_route_point points[64];
    tl_nav_world_route route;
    memset(&route, 0xff, sizeof route);
    uint32_t capacity = 64;
    if (run->what == CONTRACT_SHORT_BUFFER) {
        TEST_RESULT(tl_nav_world_find_route(open.world, open.router, &open.request, points, 64, &route), TL_OK);
        capacity = route.point_count - 1;
    }
    const tl_result result = tl_nav_world_find_route(
        CONTRACT_INPUT(run, 0, open.world), CONTRACT_INPUT(run, 1, open.router), CONTRACT_INPUT(run, 2, &open.request),
        points, capacity, CONTRACT_OUTPUT(run, 0, &route));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&route, sizeof route);
    run->answer = route.point_count;
    run->count = route.point_count;
    routed_end(&open);
    return result;
}

enum { ANSWERS = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) };

const contract_entry CONTRACT_TABLE_nav_routes[] = {
    { "tl_default_nav_routes_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_routes_bake",
      ANSWERS | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) |
          CONTRACT_BIT(BAD_BYTES) | CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED),
      1, 1, ROUTES_FIELDS, routes_bake, NULL },
    { "tl_nav_routes_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(BAD_BYTES), 1, 0, NULL,
      routes_check, NULL },
    { "tl_nav_routes_check_tiles",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(BAD_BYTES), 2, 0, NULL,
      routes_check_tiles, NULL },
    { "tl_nav_router_create", ANSWERS | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NO_MEMORY),
      1, 1, NULL, router_create, NULL },
    { "tl_nav_router_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, router_destroy, NULL },
    { "tl_nav_world_find_route", ANSWERS | CONTRACT_BIT(SHORT_BUFFER) | CONTRACT_BIT(STALE), 3, 1, NULL, find_route,
      NULL },
    { 0 },
};
