// SPDX-License-Identifier: MIT
//
// scene_versions.h.

#include "contract.h"

#include <string.h>
#include <talus/scene_versions.h>

enum { VERSION_ITEMS = 2 };

// The level, and the level again above it.
static void place_levels(const contract_run *run, tl_scene_instance instances[VERSION_ITEMS])
{
    memset(instances, 0, VERSION_ITEMS * sizeof *instances);
    for (uint32_t i = 0; i < VERSION_ITEMS; i++) {
        instances[i].soup = contract_level_get()->soup;
        instances[i].pose = tl_transform_identity();
        instances[i].pose.rotation.w = run->what == CONTRACT_ZERO_ROTATION ? 0.0f : 1.0f;
        instances[i].pose.position.y = 20.0f * (float)i;
        instances[i].mask = 1;
    }
}

static uint64_t newest_hit(tl_scene_versions *versions)
{
    const tl_scene_version *version = tl_scene_versions_acquire(versions);
    const tl_ray ray = { { 4, 60, 10 }, { 0, -1, 0 }, INFINITY };
    tl_scene_hit hit;
    const bool hits = tl_scene_cast_ray(version->scene, version->instances, &ray, NULL, &hit);
    tl_scene_versions_release(versions, version);
    return hits ? 1 + hit.instance + 16 * version->number : 0;
}

static tl_result begin_versions(const contract_run *run, tl_scene_versions **versions_out)
{
    tl_scene_instance instances[VERSION_ITEMS];
    place_levels(run, instances);
    return tl_scene_versions_create(instances, VERSION_ITEMS, run->host->allocator, versions_out, NULL);
}

static tl_result create(contract_run *run)
{
    tl_scene_instance instances[VERSION_ITEMS];
    place_levels(run, instances);
    tl_scene_versions *versions = NULL;
    const tl_result result = tl_scene_versions_create(CONTRACT_INPUT(run, 0, instances), VERSION_ITEMS,
                                                      run->what == CONTRACT_NULL_DEF ? NULL : run->host->allocator,
                                                      CONTRACT_OUTPUT(run, 0, &versions), run->report);
    run->is_clear = versions == NULL;
    run->answer = versions != NULL ? newest_hit(versions) : 0;
    tl_scene_versions_destroy(versions);
    return result;
}

static tl_result destroy(contract_run *run)
{
    run->is_clear = true;
    tl_scene_versions_destroy(NULL);
    return TL_OK;
}

static tl_result acquire(contract_run *run)
{
    tl_scene_versions *versions = NULL;
    const tl_result result = begin_versions(run, &versions);
    run->answer = result == TL_OK ? newest_hit(versions) : 0;
    tl_scene_versions_destroy(versions);
    return result;
}

static tl_result release(contract_run *run)
{
    tl_scene_versions *versions = NULL;
    const tl_result result = begin_versions(run, &versions);
    tl_scene_versions_release(versions, NULL);
    tl_scene_versions_destroy(versions);
    return result;
}

static tl_result publish(contract_run *run)
{
    tl_scene_versions *versions = NULL;
    tl_scene_instance instances[VERSION_ITEMS];
    place_levels(run, instances);
    instances[0].pose.position.y = 40.0f;
    tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        result = tl_scene_versions_publish(CONTRACT_INPUT(run, 0, versions), CONTRACT_INPUT(run, 1, instances),
                                           VERSION_ITEMS, run->report);
        run->answer = newest_hit(versions);
    }
    run->is_clear = true;
    tl_scene_versions_destroy(versions);
    return result;
}

static tl_result reclaim(contract_run *run)
{
    tl_scene_versions *versions = NULL;
    tl_scene_versions_state state;
    memset(&state, 0xff, sizeof state);
    tl_result result = begin_versions(run, &versions);
    if (result == TL_OK) {
        result = tl_scene_versions_reclaim(CONTRACT_INPUT(run, 0, versions),
                                           run->what == CONTRACT_NULL_REPORT ? NULL : &state);
    }
    run->is_clear = contract_is_zero(&state, sizeof state);
    run->answer = 1; // the state is no part of the answer: test_scene_versions.c
    tl_scene_versions_destroy(versions);
    return result;
}

#define WRITES                                                                                                         \
    (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NO_MEMORY) |             \
     CONTRACT_BIT(ZERO_ROTATION))

const contract_entry CONTRACT_TABLE_scene_versions[] = {
    { "tl_scene_versions_create", WRITES | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL, create,
      NULL },
    { "tl_scene_versions_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, destroy, NULL },
    { "tl_scene_versions_acquire", CONTRACT_BIT(GOOD), 0, 0, NULL, acquire, NULL },
    { "tl_scene_versions_release", CONTRACT_BIT(GOOD), 0, 0, NULL, release, NULL },
    { "tl_scene_versions_publish", WRITES, 2, 0, NULL, publish, NULL },
    { "tl_scene_versions_reclaim", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_REPORT), 1, 0,
      NULL, reclaim, NULL },
    { 0 },
};
