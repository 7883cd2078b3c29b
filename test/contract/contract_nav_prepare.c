// SPDX-License-Identifier: MIT
//
// nav_prepare.h.

#include "contract_nav.h"

static tl_result prepare(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_navmesh *navmesh = NULL;
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    tl_nav_prepared prepared;
    memset(&prepared, 0, sizeof prepared);
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    def.progress = run->host->progress;
    tl_result result = tl_navmesh_create(run->host->allocator, &navmesh);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(navmesh, level->tiles.tiles, level->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
    }
    if (result == TL_OK) {
        result = tl_navmesh_prepare(CONTRACT_INPUT(run, 0, navmesh), run->what == CONTRACT_NULL_DEF ? NULL : &def,
                                    run->wants_report ? &prepared : NULL);
        run->answer = tl_navmesh_is_prepared(navmesh) ? 1 : 0;
    }
    run->own_report = prepared.base;
    run->is_clear = prepared.kind == TL_NAV_PREPARED_NONE && prepared.bytes == 0 &&
                    (navmesh == NULL || !tl_navmesh_is_prepared(navmesh));
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result default_prepare_def(contract_run *run)
{
    const tl_nav_prepare_def def = tl_default_nav_prepare_def();
    run->is_clear = true;
    return def.cookie == TL_DEF_COOKIE ? TL_OK : TL_ERR_ARGUMENT;
}

const contract_entry CONTRACT_TABLE_nav_prepare[] = {
    { "tl_default_nav_prepare_def", CONTRACT_BIT(GOOD), 0, 0, NULL, default_prepare_def, NULL },
    { "tl_nav_prepared_kind_name", 0, 0, 0, NULL, NULL, "a constant text for every number: test_visibility_graph.c" },
    { "tl_navmesh_prepare",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED),
      1, 0, NULL, prepare, NULL },
    { "tl_navmesh_is_prepared", 0, 0, 0, NULL, NULL, "returns a value; asked in tl_navmesh_prepare's calls" },
    { 0 },
};
