// SPDX-License-Identifier: MIT
//
// nav_versions.h.

#include "contract_nav.h"

// A published navmesh of the level in versions. Versions, drafts and edits fail by memory in one place or another.
static tl_result begin_versions(const contract_run *run, tl_nav_versions **versions_out)
{
    const contract_level *level = contract_level_get();
    tl_navmesh *draft = NULL;
    tl_result result = tl_nav_versions_create(run->host->allocator, versions_out);
    if (result == TL_OK) {
        result = tl_nav_versions_edit(*versions_out, &draft);
    }
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(draft, level->tiles.tiles, level->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
    }
    return result == TL_OK ? tl_nav_versions_publish(*versions_out) : result;
}

static tl_result create(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    const tl_result result = tl_nav_versions_create(run->what == CONTRACT_NULL_DEF ? NULL : run->host->allocator,
                                                    CONTRACT_OUTPUT(run, 0, &versions));
    run->is_clear = versions == NULL;
    tl_nav_versions_destroy(versions);
    return result;
}

static tl_result destroy(contract_run *run)
{
    run->is_clear = true;
    tl_nav_versions_destroy(NULL);
    return TL_OK;
}

static tl_result acquire(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    const tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        const tl_navmesh *navmesh = tl_nav_versions_acquire(versions);
        run->answer = tl_navmesh_tile_count(navmesh);
        tl_nav_versions_release(versions, navmesh);
    }
    tl_nav_versions_destroy(versions);
    return result;
}

static tl_result release(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    const tl_result result = begin_versions(run, &versions);
    tl_nav_versions_release(versions, NULL);
    tl_nav_versions_destroy(versions);
    return result;
}

static tl_result edit(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    tl_navmesh *draft = NULL;
    tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        result = tl_nav_versions_edit(CONTRACT_INPUT(run, 0, versions), CONTRACT_OUTPUT(run, 0, &draft));
    }
    run->is_clear = draft == NULL;
    run->answer = draft != NULL ? tl_navmesh_tile_count(draft) : 0;
    tl_nav_versions_destroy(versions);
    return result;
}

static tl_result publish(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    tl_navmesh *draft = NULL;
    tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        result = tl_nav_versions_edit(versions, &draft);
    }
    if (result == TL_OK) {
        result = tl_nav_versions_publish(CONTRACT_INPUT(run, 0, versions));
    }
    run->is_clear = true;
    tl_nav_versions_destroy(versions);
    return result;
}

static tl_result reclaim(contract_run *run)
{
    tl_nav_versions *versions = NULL;
    tl_nav_versions_state state;
    memset(&state, 0xff, sizeof state);
    tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        result = tl_nav_versions_reclaim(CONTRACT_INPUT(run, 0, versions),
                                         run->what == CONTRACT_NULL_REPORT ? NULL : &state);
    }
    run->is_clear = contract_is_zero(&state, sizeof state);
    run->answer = 1; // the state is no part of the answer: test_nav_versions.c
    tl_nav_versions_destroy(versions);
    return result;
}

#define MADE (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT))

const contract_entry CONTRACT_TABLE_nav_versions[] = {
    { "tl_nav_versions_create",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 0, 1, NULL,
      create, NULL },
    { "tl_nav_versions_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, destroy, NULL },
    { "tl_nav_versions_acquire", CONTRACT_BIT(GOOD), 0, 0, NULL, acquire, NULL },
    { "tl_nav_versions_release", CONTRACT_BIT(GOOD), 0, 0, NULL, release, NULL },
    { "tl_nav_versions_edit", MADE | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1, NULL, edit, NULL },
    { "tl_nav_versions_publish", MADE, 1, 0, NULL, publish, NULL },
    { "tl_nav_versions_reclaim", MADE | CONTRACT_BIT(NULL_REPORT), 1, 0, NULL, reclaim, NULL },
    { 0 },
};
