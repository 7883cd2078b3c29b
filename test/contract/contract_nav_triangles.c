// SPDX-License-Identifier: MIT
//
// nav_bake.h, its last part: a level's triangles by place. contract_nav_bake.c has the rest.

#include "contract_nav_def.h"

static tl_result nav_triangles_create(contract_run *run)
{
    const tl_nav_def def = contract_nav_def(run, 32);
    tl_nav_triangles *triangles = (tl_nav_triangles *)(uintptr_t)1;
    const tl_result result =
        tl_nav_triangles_create(&def, contract_input_is_null(run, 0) ? NULL : &contract_level_get()->nav_input.mesh,
                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &triangles, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || triangles == NULL;
    if (result == TL_OK) {
        run->answer = tl_nav_triangles_bytes(triangles);
        tl_nav_triangles_destroy(triangles);
    }
    return result;
}

static tl_nav_triangles *make_triangles(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.bounds = CONTRACT_LEVEL_BOUNDS;
    tl_nav_triangles *triangles;
    TEST_RESULT(tl_nav_triangles_create(&def, &contract_level_get()->nav_input.mesh, &triangles, NULL), TL_OK);
    return triangles;
}

static tl_result nav_triangles_change(contract_run *run)
{
    tl_nav_triangles *triangles = make_triangles();
    const uint32_t changed = 0;
    const tl_result result =
        tl_nav_triangles_change(contract_input_is_null(run, 0) ? NULL : triangles,
                                contract_input_is_null(run, 1) ? NULL : &contract_level_get()->nav_input.mesh,
                                contract_input_is_null(run, 2) ? NULL : &changed, 1, run->report);
    run->is_clear = true;
    tl_nav_triangles_destroy(triangles);
    return result;
}

static tl_result nav_triangles_near(contract_run *run)
{
    tl_nav_triangles *triangles = make_triangles();
    const tl_aabb box = { { 1, 0, 1 }, { 2, 1, 2 } };
    tl_nav_near_triangles near;
    memset(&near, 0x55, sizeof near);
    const tl_result result =
        tl_nav_triangles_near(contract_input_is_null(run, 0) ? NULL : triangles,
                              contract_input_is_null(run, 1) ? NULL : &contract_level_get()->nav_input, box,
                              run->what == CONTRACT_NULL_OUTPUT ? NULL : &near, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&near, sizeof near);
    run->answer = result == TL_OK ? near.input.mesh.triangle_count : 0;
    tl_nav_triangles_destroy(triangles);
    return result;
}

static tl_result nav_triangles_frees(contract_run *run)
{
    (void)run;
    tl_nav_triangles_destroy(NULL);
    return TL_OK;
}

const contract_entry CONTRACT_TABLE_nav_triangles[] = {
    { "tl_nav_triangles_create", CALLS | INPUT | OUTPUT | DEFS | CONTRACT_BIT(NO_MEMORY), 1, 1, CONTRACT_NAV_DEF_FIELDS,
      nav_triangles_create, NULL },
    { "tl_nav_triangles_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, nav_triangles_frees, NULL },
    { "tl_nav_triangles_change", CALLS | INPUT, 3, 0, NULL, nav_triangles_change, NULL },
    { "tl_nav_triangles_near", CALLS | INPUT | OUTPUT, 2, 1, NULL, nav_triangles_near, NULL },
    { "tl_nav_triangles_bytes", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_triangles_create, NULL },
    { 0 },
};
