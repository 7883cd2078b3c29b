// SPDX-License-Identifier: MIT
//
// nav_audit.h.

#include "contract.h"

#include <string.h>

static const char *const AUDIT_FIELDS[] = { "volumes", "cell_size", NULL };

static tl_result audit_run(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_nav_audit_def def = tl_default_nav_audit_def();
    // A failing allocation is tried for each one: few paths will do. The others are held against the default def.
    def.path_count = run->what == CONTRACT_NO_MEMORY || run->what == CONTRACT_CANCELLED ? 20 : def.path_count;
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.volume_count = run->variant == 0 ? 1 : 0;
        def.nav.cell_size = run->variant == 1 ? -1.0f : def.nav.cell_size;
    }
    def.host = *run->host;
    tl_nav_audit audit;
    memset(&audit, 0, sizeof audit);
    const tl_result result = tl_nav_audit_run(run->what == CONTRACT_NULL_DEF ? NULL : &def, level->navmesh,
                                              run->what == CONTRACT_NULL_INPUT ? NULL : level->soup,
                                              run->what == CONTRACT_NULL_OUTPUT ? NULL : &audit, run->report);
    run->is_clear = contract_is_zero(&audit, sizeof audit);
    run->answer = audit.step_count + audit.floor_samples + audit.finding_count;
    tl_nav_audit_free(&audit);
    return result;
}

static tl_result audit_free(contract_run *run)
{
    tl_nav_audit audit;
    (void)run;
    memset(&audit, 0, sizeof audit);
    tl_nav_audit_free(NULL);
    tl_nav_audit_free(&audit);
    return TL_OK;
}

// Beside the box, too near to its wall.
static tl_result why(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_nav_def def = tl_default_nav_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.cell_size = -1.0f;
    }
    def.host = *run->host;
    tl_nav_why_answer answer;
    memset(&answer, 0, sizeof answer);
    const tl_result result =
        tl_nav_why(run->what == CONTRACT_NULL_DEF ? NULL : &def,
                   run->what == CONTRACT_NULL_INPUT ? NULL : &level->nav_input, level->navmesh, NULL,
                   tl_vec3_make(7.8f, 0, 10), run->what == CONTRACT_NULL_OUTPUT ? NULL : &answer, run->report);
    run->is_clear = contract_is_zero(&answer, sizeof answer);
    run->answer = (uint64_t)answer.reasons[0].cause << 32 | answer.bake_count;
    return result;
}

static const char *const WHY_FIELDS[] = { "cell_size", NULL };

const contract_entry CONTRACT_TABLE_nav_audit[] = {
    { "tl_nav_probe_from_config", 0, 0, 0, NULL, NULL, "value math: test_audit.c" },
    { "tl_default_nav_audit_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_finding_name", 0, 0, 0, NULL, NULL, "a constant text for every number" },
    { "tl_nav_audit_run",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(CANCELLED),
      1, 1, AUDIT_FIELDS, audit_run, NULL },
    { "tl_nav_audit_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, audit_free, NULL },
    { "tl_nav_cause_name", 0, 0, 0, NULL, NULL, "a constant text for every number" },
    { "tl_nav_cause_text", 0, 0, 0, NULL, NULL, "a constant text for every number" },
    { "tl_nav_why",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY),
      1, 1, WHY_FIELDS, why, NULL },
    { 0 },
};
