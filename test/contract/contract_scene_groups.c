// SPDX-License-Identifier: MIT
//
// scene_groups.h.

#include "contract.h"

#include <string.h>
#include <talus/scene_groups.h>

// The level, and in the outer group that group twice, one above the other.
typedef struct groups_fixture {
    tl_scene_instance instance;
    tl_scene_placement placements[2];
    tl_scene_group groups[2];
} groups_fixture;

static void make_groups(const contract_run *run, groups_fixture *f)
{
    memset(f, 0, sizeof *f);
    f->instance.soup = contract_level_get()->soup;
    f->instance.mask = 1;
    for (uint32_t i = 0; i < 2; i++) {
        f->placements[i].pose = contract_pose(run, tl_vec3_make(0, 20.0f * (float)i, 0));
    }
    const tl_scene_group inner = { &f->instance, 1, NULL, 0 }, outer = { NULL, 0, f->placements, 2 };
    f->groups[0] = inner;
    f->groups[1] = outer;
}

static uint64_t answer_of(const tl_scene_expansion *e)
{
    uint64_t hash = e->instance_count;
    for (uint32_t i = 0; i < e->instance_count; i++) {
        hash = contract_hash(&e->instances[i].pose.position, sizeof e->instances[i].pose.position, hash);
    }
    return hash;
}

static tl_result expand(contract_run *run)
{
    groups_fixture f;
    make_groups(run, &f);
    tl_scene_expansion e;
    memset(&e, 0, sizeof e);
    const tl_result result = tl_scene_groups_expand(CONTRACT_INPUT(run, 0, f.groups), 2, 1,
                                                    run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                                                    CONTRACT_OUTPUT(run, 0, &e), run->report);
    run->is_clear = contract_is_zero(&e, sizeof e);
    run->answer = result == TL_OK ? answer_of(&e) : 0;
    tl_scene_expansion_free(&e);
    return result;
}

static tl_result place(contract_run *run)
{
    groups_fixture f;
    make_groups(run, &f);
    tl_scene_expansion e;
    TEST_RESULT(tl_scene_groups_expand(f.groups, 2, 1, NULL, &e, NULL), TL_OK);
    const tl_scene_placement at = { 0, contract_pose(run, tl_vec3_make(5, 6, 7)), 2 };
    const tl_result result = tl_scene_groups_place(CONTRACT_INPUT(run, 0, f.groups), 2, CONTRACT_INPUT(run, 1, &e), 1,
                                                   CONTRACT_INPUT(run, 2, &at), run->report);
    run->is_clear = true;
    run->answer = answer_of(&e);
    tl_scene_expansion_free(&e);
    return result;
}

CONTRACT_DEFINE_FREE(expansion_free, tl_scene_expansion, tl_scene_expansion_free)

enum {
    GROUPS_REPORTED =
        CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(ZERO_ROTATION)
};

const contract_entry CONTRACT_TABLE_scene_groups[] = {
    { "tl_scene_groups_expand",
      GROUPS_REPORTED | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1, NULL,
      expand, NULL },
    { "tl_scene_groups_place", GROUPS_REPORTED, 3, 0, NULL, place, NULL },
    { "tl_scene_copy_of", 0, 0, 0, NULL, NULL, "has no way to fail: test_scene_groups.c" },
    { "tl_scene_expansion_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, expansion_free, NULL },
    { 0 },
};
