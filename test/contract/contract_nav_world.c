// SPDX-License-Identifier: MIT
//
// nav_world.h.

#include "contract_world_file.h"

static const char *const WORLD_FIELDS[] = { "read", "budget", "frame_reach", NULL };

static tl_result world_create(contract_run *run)
{
    memory_file file = level_file_make(NULL, 0);
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    def.read = memory_file_read;
    def.user = &file;
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.read = run->variant == 0 ? NULL : memory_file_read;
        def.budget = run->variant == 1 ? 1 : def.budget;
        def.frame_reach = run->variant == 2 ? 0.0 : def.frame_reach;
    }
    file.bytes[100] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    def.allocator = run->host->allocator;
    const tl_result result = tl_nav_world_create(run->what == CONTRACT_NULL_INPUT ? NULL : &def,
                                                 run->what == CONTRACT_NULL_OUTPUT ? NULL : &world, run->report);
    run->is_clear = world == NULL;
    run->answer = world != NULL;
    tl_nav_world_destroy(world);
    free(file.bytes);
    return result;
}

static tl_result world_destroy(contract_run *run)
{
    (void)run;
    tl_nav_world_destroy(NULL);
    return TL_OK;
}

// A world, with all tiles in memory or none.
typedef struct open_world {
    memory_file *file;
    tl_nav_world *world;
    tl_nav_world_interest interest;
    contract_nav nav;
} open_world;

static void load_all(open_world *open)
{
    tl_nav_world_load load;
    for (int i = 0; i < 32; i++) {
        TEST_CHECK(!tl_is_error(tl_nav_world_update(open->world, &open->interest, 1, 8)));
        if (tl_nav_world_begin_load(open->world, &load) == TL_OK) {
            TEST_RESULT(tl_nav_world_run_load(&load), TL_OK);
            TEST_RESULT(tl_nav_world_end_load(&load), TL_OK);
        }
    }
}

static open_world world_begin(const contract_run *run, bool loaded)
{
    static const double here[3] = { 4, 0, 10 }, there[3] = { 16, 0, 10 };
    const tl_nav_world_interest interest = { { 10, 0, 10 }, 100 };
    const tl_vec3 extents = tl_vec3_make(1, 1, 1);
    open_world open;
    memset(&open, 0, sizeof open);
    open.file = malloc(sizeof *open.file);
    TEST_CHECK(open.file != NULL);
    *open.file = level_file_make(NULL, 0);
    tl_nav_world_def def = tl_default_nav_world_def();
    def.read = memory_file_read;
    def.user = open.file;
    def.allocator = run->host->allocator;
    TEST_RESULT(tl_nav_world_create(&def, &open.world, NULL), TL_OK);
    open.interest = interest;
    open.nav = contract_nav_begin(run);
    if (loaded) {
        load_all(&open);
        TEST_RESULT(tl_nav_world_find_nearest(open.world, NULL, here, extents, &open.nav.here), TL_OK);
        TEST_RESULT(tl_nav_world_find_nearest(open.world, NULL, there, extents, &open.nav.there), TL_OK);
    }
    if (run->what == CONTRACT_STALE) {
        open.nav.here.polygon = contract_level_get()->stale;
    }
    return open;
}

static void world_end(open_world *open)
{
    tl_nav_world_destroy(open->world);
    free(open->file->bytes);
    free(open->file);
}

static tl_result world_update(contract_run *run)
{
    open_world open = world_begin(run, false);
    const tl_result result =
        tl_nav_world_update(CONTRACT_INPUT(run, 0, open.world), CONTRACT_INPUT(run, 1, &open.interest), 1, 4);
    run->is_clear = true;
    if (result == TL_OK && run->what == CONTRACT_NOT_FOUND) {
        const tl_result again = tl_nav_world_update(open.world, &open.interest, 1, 4);
        world_end(&open);
        return again;
    }
    world_end(&open);
    return result;
}

// A load as far as `stage`: begun, run, handed back.
static tl_result world_load(contract_run *run, int stage)
{
    open_world open = world_begin(run, false);
    tl_nav_world_load load;
    memset(&load, 0xff, sizeof load);
    if (run->what == CONTRACT_NOT_FOUND) {
        open.interest.point[0] = 1e6;
    }
    TEST_RESULT(tl_nav_world_update(open.world, &open.interest, 1, 4), TL_OK);
    tl_result result = TL_OK;
    if (stage == 0) {
        result = tl_nav_world_begin_load(CONTRACT_INPUT(run, 0, open.world), CONTRACT_OUTPUT(run, 0, &load));
        run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&load, sizeof load);
    } else {
        run->is_clear = true;
        TEST_RESULT(tl_nav_world_begin_load(open.world, &load), TL_OK);
        result = tl_nav_world_run_load(stage == 1 ? CONTRACT_INPUT(run, 0, &load) : &load);
    }
    if (stage == 2) {
        result = tl_nav_world_end_load(CONTRACT_INPUT(run, 0, &load));
    }
    world_end(&open);
    return result;
}

static tl_result world_begin_load(contract_run *run)
{
    return world_load(run, 0);
}

static tl_result world_run_load(contract_run *run)
{
    return world_load(run, 1);
}

static tl_result world_end_load(contract_run *run)
{
    return world_load(run, 2);
}

static tl_result world_get_state(contract_run *run)
{
    open_world open = world_begin(run, false);
    tl_nav_world_state state;
    memset(&state, 0xff, sizeof state);
    const tl_result result =
        tl_nav_world_get_state(CONTRACT_INPUT(run, 0, open.world), CONTRACT_OUTPUT(run, 0, &state));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&state, sizeof state);
    world_end(&open);
    return result;
}

static tl_result world_covers(contract_run *run)
{
    open_world open = world_begin(run, true);
    const double center[3] = { 10, 0, 10 };
    const tl_result result =
        tl_nav_world_covers(CONTRACT_INPUT(run, 0, open.world), CONTRACT_INPUT(run, 1, center), 5.0);
    run->is_clear = true;
    world_end(&open);
    return result;
}

static tl_result world_nearest(contract_run *run)
{
    open_world open = world_begin(run, true);
    const double here[3] = { 4, 0, 10 }, nowhere[3] = { 500, 0, 500 };
    tl_nav_location location;
    memset(&location, 0xff, sizeof location);
    const tl_result result =
        tl_nav_world_find_nearest(CONTRACT_INPUT(run, 0, open.world), contract_nav_filter(run, &open.nav),
                                  CONTRACT_INPUT(run, 1, run->what == CONTRACT_NOT_FOUND ? nowhere : here),
                                  tl_vec3_make(1, 1, 1), CONTRACT_OUTPUT(run, 0, &location));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&location, sizeof location);
    run->answer = contract_hash(&location.point, sizeof location.point, 0);
    world_end(&open);
    return result;
}

static tl_result world_path(contract_run *run)
{
    open_world open = world_begin(run, true);
    const tl_nav_path_request request = { contract_nav_filter(run, &open.nav), open.nav.here, open.nav.there };
    tl_nav_shortest_path path;
    tl_nav_corner corners[CONTRACT_CAPACITY];
    tl_result result = TL_OK;
    do {
        const tl_nav_path_buffers buffers = { NULL, 0, open.nav.capacity > 0 ? corners : NULL, open.nav.capacity };
        memset(&path, 0xff, sizeof path);
        result = tl_nav_world_find_path(CONTRACT_INPUT(run, 0, open.world), CONTRACT_INPUT(run, 1, open.nav.query),
                                        CONTRACT_INPUT(run, 2, &request), &buffers, CONTRACT_OUTPUT(run, 0, &path));
    } while (contract_nav_shorten(run, path.corner_count, &open.nav));
    run->is_clear = contract_nav_is_clear(run, result, &path, sizeof path);
    run->answer = path.corner_count;
    world_end(&open);
    return result;
}

static tl_result world_ray(contract_run *run)
{
    open_world open = world_begin(run, true);
    const double end[3] = { 16, 0, 10 };
    tl_nav_ray_hit hit;
    memset(&hit, 0xff, sizeof hit);
    const tl_result result = tl_nav_world_cast_ray(
        CONTRACT_INPUT(run, 0, open.world), contract_nav_filter(run, &open.nav), CONTRACT_INPUT(run, 1, &open.nav.here),
        CONTRACT_INPUT(run, 2, end), CONTRACT_OUTPUT(run, 0, &hit));
    run->is_clear = contract_nav_is_clear(run, result, &hit, sizeof hit);
    run->answer = contract_hash(&hit.point, sizeof hit.point, 0);
    world_end(&open);
    return result;
}

enum { ASKS = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT), ANSWERS = ASKS | CONTRACT_BIT(NULL_OUTPUT) };

const contract_entry CONTRACT_TABLE_nav_world[] = {
    { "tl_default_nav_world_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_world_create",
      ANSWERS | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) |
          CONTRACT_BIT(BAD_BYTES) | CONTRACT_BIT(NO_MEMORY),
      1, 1, WORLD_FIELDS, world_create, NULL },
    { "tl_nav_world_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, world_destroy, NULL },
    { "tl_nav_world_update", ASKS | CONTRACT_BIT(NOT_FOUND), 2, 0, NULL, world_update, NULL },
    { "tl_nav_world_begin_load", ANSWERS | CONTRACT_BIT(NOT_FOUND), 1, 1, NULL, world_begin_load, NULL },
    { "tl_nav_world_run_load", ASKS, 1, 0, NULL, world_run_load, NULL },
    { "tl_nav_world_end_load", ASKS, 1, 0, NULL, world_end_load, NULL },
    { "tl_nav_world_get_state", ANSWERS, 1, 1, NULL, world_get_state, NULL },
    { "tl_nav_world_place_in", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_nav_world_place_out", 0, 0, 0, NULL, NULL, "fills a value; what it is given is the caller's duty" },
    { "tl_nav_world_index", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_nav_world_navmesh", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_nav_world_covers", ASKS, 2, 0, NULL, world_covers, NULL },
    { "tl_nav_world_find_nearest",
      ANSWERS | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NOT_FOUND), 2, 1, NULL, world_nearest,
      NULL },
    { "tl_nav_world_find_path",
      ANSWERS | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(SHORT_BUFFER) | CONTRACT_BIT(STALE), 3,
      1, NULL, world_path, NULL },
    { "tl_nav_world_cast_ray", ANSWERS | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(STALE), 3, 1,
      NULL, world_ray, NULL },
    { 0 },
};
