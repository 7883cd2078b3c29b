// SPDX-License-Identifier: MIT
//
// nav_prune.h.

#include "contract.h"

#include <string.h>

static const char *const PRUNE_FIELDS[] = { "seeds", "seed_extents", "min_area", NULL };

// Islands of less than 20 square metres go: the top of the box. With a NULL def all stay.
static tl_nav_prune_def prune_def(const contract_run *run)
{
    tl_nav_prune_def def = tl_default_nav_prune_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.seed_count = run->variant == 0 ? 1 : 0;
        def.seed_extents.x = run->variant == 1 ? -1.0f : 2.0f;
        def.min_area = run->variant == 2 ? -1.0 : 0.0;
    } else if (run->what == CONTRACT_NO_MEMORY || run->what == CONTRACT_CANCELLED) {
        def.min_area = 20.0;
    }
    def.host = *run->host;
    return def;
}

static tl_result prune(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_prune_def def = prune_def(run);
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&level->nav_def, &level->nav_input, &tiles, NULL), TL_OK);
    const uint32_t count = tiles.tile_count;
    tl_nav_prune_report report = { 0 };
    tl_nav_tiles removed;
    memset(&removed, 0xff, sizeof removed);
    const tl_result result =
        tl_nav_prune(run->what == CONTRACT_NULL_DEF ? NULL : &def, run->what == CONTRACT_NULL_INPUT ? NULL : &tiles,
                     &removed, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = tiles.tile_count == count && removed.tile_count == 0 && removed.tiles == NULL;
    for (uint32_t i = 0; i < removed.tile_count; i++) {
        run->answer = contract_hash(removed.tiles[i], (size_t)removed.tiles[i]->blob.size, run->answer);
    }
    tl_nav_tiles_free(&removed);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        run->answer = contract_hash(tiles.tiles[i], (size_t)tiles.tiles[i]->blob.size, run->answer);
    }
    tl_nav_tiles_free(&tiles);
    return result;
}

const contract_entry CONTRACT_TABLE_nav_prune[] = {
    { "tl_default_nav_prune_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_prune",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED),
      1, 0, PRUNE_FIELDS, prune, NULL },
    { 0 },
};
