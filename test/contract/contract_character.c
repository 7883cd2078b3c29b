// SPDX-License-Identifier: MIT
//
// character.h.

#include "contract.h"

#include <string.h>

static const char *const DEF_FIELDS[] = {
    "radius", "height", "step_height", "max_slope", "gap", "max_triangles", NULL
};

static tl_result create(contract_run *run)
{
    tl_character_def def = tl_default_character_def();
    float *const floats[] = { &def.radius, &def.height, &def.step_height, &def.max_slope, &def.gap };
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD && run->variant < 5) {
        *floats[run->variant] = -1.0f;
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.max_triangles = 0;
    }
    def.allocator = run->host->allocator;
    tl_character_mover *mover = NULL;
    const tl_result result = tl_character_mover_create(run->what == CONTRACT_NULL_DEF ? NULL : &def,
                                                       run->what == CONTRACT_NULL_OUTPUT ? NULL : &mover, run->report);
    run->is_clear = mover == NULL;
    run->answer = mover != NULL;
    tl_character_mover_destroy(mover);
    return result;
}

static tl_result destroy(contract_run *run)
{
    (void)run;
    tl_character_mover_destroy(NULL);
    return TL_OK;
}

static const char *const STEP_FIELDS[] = { "seconds", "velocity", "position", "level", NULL };

static tl_result move(contract_run *run)
{
    tl_character_mover *mover;
    TEST_RESULT(tl_character_mover_create(NULL, &mover, NULL), TL_OK);
    tl_character_level level = { .soup = contract_level_get()->soup };
    tl_character_step step = { { 1, 0, 1 }, 0.25f, false };
    tl_character character;
    tl_character_report report;
    memset(&character, 0, sizeof character);
    memset(&report, 0, sizeof report);
    character.position = contract_level_get()->here;
    if (run->what == CONTRACT_BAD_FIELD) {
        step.seconds = run->variant == 0 ? -1.0f : step.seconds;
        step.velocity.x = run->variant == 1 ? NAN : step.velocity.x;
        character.position.y = run->variant == 2 ? INFINITY : character.position.y;
        level.soup = run->variant == 3 ? NULL : level.soup;
    }
    const tl_character before = character;
    const tl_result result =
        tl_character_move(CONTRACT_INPUT(run, 0, mover), CONTRACT_INPUT(run, 1, &level), CONTRACT_INPUT(run, 2, &step),
                          CONTRACT_INPUT(run, 3, &character), run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = memcmp(&before, &character, sizeof before) == 0;
    run->answer = contract_hash(&character, sizeof character, 0);
    tl_character_mover_destroy(mover);
    return result;
}

const contract_entry CONTRACT_TABLE_character[] = {
    { "tl_default_character_def", 0, 0, 0, NULL, NULL, "returns the defaults" },
    { "tl_character_mover_create",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY),
      0, 1, DEF_FIELDS, create, NULL },
    { "tl_character_mover_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, destroy, NULL },
    { "tl_character_move",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT), 4, 0,
      STEP_FIELDS, move, NULL },
    { 0 },
};
