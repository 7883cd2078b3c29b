// SPDX-License-Identifier: MIT

#include "cli/level/area_filter.h"

#include "cli/options/parse_value.h"

#include <stdio.h>
#include <string.h>

void tl_area_filter_options(tl_area_filter *areas, tl_option table[TL_AREA_FILTER_OPTIONS])
{
    const tl_option options[TL_AREA_FILTER_OPTIONS] = {
        { "area-cost", 0, TL_OPTION_TEXTS, &areas->costs, "ID=COST",
          "a metre in area ID, 1 to 255, costs this many metres (1); may be given again", NULL, 0, 0, 0, 0 },
        { "exclude-area", 0, TL_OPTION_TEXTS, &areas->excluded, "ID", "do not enter area ID; may be given again", NULL,
          0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

static bool read_area(const char *text, uint64_t *area_out)
{
    return tl_parse_count_value(text, TL_NAV_MAX_AREA, area_out) == NULL && *area_out > 0;
}

// "ID=COST". False: it is none.
static bool read_cost(const char *word, uint64_t *area_out, float *cost_out)
{
    char id[16];
    const char *equals = strchr(word, '=');
    if (equals == NULL || (size_t)(equals - word) >= sizeof(id)) {
        return false;
    }
    snprintf(id, sizeof(id), "%.*s", (int)(equals - word), word);
    return read_area(id, area_out) && tl_parse_float_value(equals + 1, cost_out) == NULL && *cost_out > 0.0f;
}

static bool passes_areas(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    const tl_area_filter *areas = user;
    return !areas->is_excluded[tl_nav_tile_area(tile, polygon)];
}

bool tl_area_filter_read(tl_cli *cli, tl_area_filter *areas, tl_exit *exit_out)
{
    uint64_t area = 0;
    areas->filter = tl_default_nav_filter();
    for (uint32_t i = 0; i < areas->costs.count; ++i) {
        float cost = 1.0f;
        if (!read_cost(areas->costs.words[i], &area, &cost)) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE,
                                    "--area-cost: '%s' is not ID=COST: an area from 1 to %d and a "
                                    "number above 0",
                                    areas->costs.words[i], TL_NAV_MAX_AREA);
            return false;
        }
        areas->filter.area_cost[area] = cost;
        areas->is_named[area] = true;
    }
    for (uint32_t i = 0; i < areas->excluded.count; ++i) {
        if (!read_area(areas->excluded.words[i], &area)) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--exclude-area: '%s' is no area; use 1 to %d",
                                    areas->excluded.words[i], TL_NAV_MAX_AREA);
            return false;
        }
        areas->is_excluded[area] = true;
        areas->is_named[area] = true;
    }
    // Without the function searches may use what was prepared for filters that pass all.
    if (areas->excluded.count > 0) {
        areas->filter.pass = passes_areas;
        areas->filter.user = areas;
    }
    return true;
}

void tl_area_filter_warn(tl_cli *cli, const tl_area_filter *areas, const tl_navmesh *navmesh, const char *path)
{
    bool is_there[TL_NAV_MAX_AREA + 1] = { false };
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); ++slot) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t i = 0; tile != NULL && i < tile->polygon_count; ++i) {
            is_there[tl_nav_tile_area(tile, i)] = true;
        }
    }
    uint32_t cursor = 0;
    tl_nav_ref link;
    tl_nav_offmesh_state state;
    while (tl_navmesh_next_offmesh(navmesh, &cursor, &link)) {
        if (tl_navmesh_offmesh_state(navmesh, link, &state) == TL_OK) {
            is_there[state.offmesh.area] = true;
        }
    }
    for (int area = 1; area <= TL_NAV_MAX_AREA; ++area) {
        if (areas->is_named[area] && !is_there[area]) {
            tl_cli_warn(cli, "%s: no polygon has area %d; talus info lists the areas", path, area);
        }
    }
}
