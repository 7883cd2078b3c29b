// SPDX-License-Identifier: MIT
//
// nav_links.h.

#include "contract.h"

#include <string.h>

static const char *const LINKS_FIELDS[] = { "spacing", "max_drop",  "max_jump", "jump_height", "max_speed",
                                            "gravity", "max_climb", "min_gain", "max_nodes",   NULL };

static tl_nav_links_def links_def(const contract_run *run)
{
    tl_nav_links_def def = tl_default_nav_links_def();
    float *const values[] = { &def.spacing,   &def.max_drop, &def.max_jump,  &def.jump_height,
                              &def.max_speed, &def.gravity,  &def.max_climb, &def.min_gain };
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    if (run->what == CONTRACT_BAD_FIELD && run->variant < 8) {
        *values[run->variant] = run->variant % 2 == 0 ? -1.0f : NAN;
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.max_nodes = 0;
    }
    def.host = *run->host;
    return def;
}

static tl_result links_find(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_links_def def = links_def(run);
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_nav_links *links = NULL;
    tl_nav_links_report report = { 0 };
    const tl_result result = tl_nav_links_find(
        run->what == CONTRACT_NULL_DEF ? NULL : &def, null_input && run->variant == 0 ? NULL : level->navmesh,
        null_input && run->variant == 1 ? NULL : level->soup, run->what == CONTRACT_NULL_OUTPUT ? NULL : &links,
        run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = links == NULL;
    if (links != NULL) {
        TEST_CHECK(links->link_count > 0);
        run->answer = contract_hash(links, (size_t)links->blob.size, 0);
    }
    tl_blob_free(links);
    return result;
}

static tl_nav_links *make_links(void)
{
    const contract_level *level = contract_level_get();
    tl_nav_links *links;
    TEST_RESULT(tl_nav_links_find(NULL, level->navmesh, level->soup, &links, NULL), TL_OK);
    return links;
}

static tl_result links_check(contract_run *run)
{
    tl_nav_links *links = make_links();
    if (run->what == CONTRACT_BAD_BYTES) {
        links->links++;
    }
    run->is_clear = true;
    const tl_result result =
        tl_nav_links_check(run->what == CONTRACT_NULL_INPUT ? NULL : links, links->blob.size, run->report);
    tl_blob_free(links);
    return result;
}

static tl_result links_add(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const tl_nav_offmesh prototype = tl_default_nav_offmesh();
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_nav_links *links = make_links();
    tl_navmesh *navmesh;
    tl_result result = tl_navmesh_create(run->host->allocator, &navmesh);
    for (uint32_t i = 0; i < level->tiles.tile_count && result == TL_OK; i++) {
        result = tl_navmesh_add_tile(navmesh, level->tiles.tiles[i], TL_NAV_TILE_BORROWED);
    }
    run->is_clear = true;
    if (result == TL_OK) {
        result = tl_nav_links_add(null_input && run->variant == 0 ? NULL : links,
                                  run->what == CONTRACT_NULL_DEF ? NULL : &prototype,
                                  null_input && run->variant == 1 ? NULL : navmesh);
        uint32_t cursor = 0;
        tl_nav_ref ref;
        while (tl_navmesh_next_offmesh(navmesh, &cursor, &ref)) {
            run->answer++;
        }
        run->is_clear = run->answer == 0;
    }
    tl_navmesh_destroy(navmesh);
    tl_blob_free(links);
    return result;
}

const contract_entry CONTRACT_TABLE_nav_links[] = {
    { "tl_nav_link_kind_name", 0, 0, 0, NULL, NULL, "a constant text for every number: test_nav_links.c" },
    { "tl_default_nav_links_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_links_find",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(CANCELLED),
      2, 1, LINKS_FIELDS, links_find, NULL },
    { "tl_nav_links_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES), 1, 0, NULL,
      links_check, NULL },
    { "tl_nav_links_add",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY), 2, 0, NULL,
      links_add, NULL },
    { "tl_nav_jump_link_point", 0, 0, 0, NULL, NULL, "value math: test_nav_links.c" },
    { 0 },
};
