// SPDX-License-Identifier: MIT

#include "cli/level/level_links.h"

#include "cli/shared/json_out.h"
#include "cli/shared/table.h"

#include <stdio.h>
#include <string.h>

void tl_link_options(tl_nav_links_def *def, tl_option table[TL_LINK_OPTIONS])
{
    const float huge = 1e4f;
    const tl_option options[TL_LINK_OPTIONS] = {
        { "drop", 0, TL_OPTION_FLOAT, &def->max_drop, "M", "metres: how far an agent may fall; 0: no drops", NULL, 0,
          huge, 0, 0 },
        { "climb", 0, TL_OPTION_FLOAT, &def->max_climb, "M", "metres: how far an agent climbs up a wall; 0: no climbs",
          NULL, 0, huge, 0, 0 },
        { "jump", 0, TL_OPTION_FLOAT, &def->max_jump, "M",
          "metres: longest jump, from take-off to landing; 0: no jumps", NULL, 0, huge, 0, 0 },
        { "jump-height", 0, TL_OPTION_FLOAT, &def->jump_height, "M", "metres: how high a jump rises", NULL, 0, huge, 0,
          0 },
        { "jump-speed", 0, TL_OPTION_FLOAT, &def->max_speed, "M/S", "metres a second: horizontal speed of a jump", NULL,
          0, huge, 0, 0 },
        { "gravity", 0, TL_OPTION_FLOAT, &def->gravity, "M/S2", "metres a second squared: downwards", NULL, 1e-3f, huge,
          0, 0 },
        { "link-spacing", 0, TL_OPTION_FLOAT, &def->spacing, "M", "metres: distance between places tried along a ledge",
          NULL, 1e-3f, huge, 0, 0 },
        { "link-gain", 0, TL_OPTION_FLOAT, &def->min_gain, "N",
          "keep a link where the path without it is at least this many times as long", NULL, 1, huge, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

bool tl_level_links_find(tl_cli *cli, const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                         tl_level_links *links_out, tl_exit *exit_out)
{
    tl_nav_links_def with_host = *def;
    with_host.host = cli->host;
    tl_result result = tl_nav_links_find(&with_host, navmesh, soup, &links_out->links, &links_out->report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, cli->arguments.words[0], result, &links_out->report.base);
    }
    return result == TL_OK;
}

void tl_level_links_print(const tl_nav_links_report *report)
{
    tl_table table;
    memset(&table, 0, sizeof(table));
    static const char *const titles[] = { "links", "kept", "tried", "blocked", "useless" };
    tl_table_row(&table);
    for (unsigned i = 0; i < 5; ++i) {
        tl_table_text(&table, titles[i]);
    }
    for (int kind = 0; kind < TL_NAV_LINK_KINDS; ++kind) {
        const tl_nav_links_count *count = &report->kinds[kind];
        tl_table_row(&table);
        tl_table_text(&table, tl_nav_link_kind_name((tl_nav_link_kind)kind));
        tl_table_count(&table, count->kept);
        tl_table_count(&table, count->tried);
        tl_table_count(&table, count->blocked);
        tl_table_count(&table, count->useless);
    }
    tl_table_print(&table);
    printf("\n%u places along %u ledges; %u trajectories without a landing, %u jumps too fast\n", report->sample_count,
           report->ledge_count, report->no_landing, report->too_fast);
}

json_t *tl_level_links_json(const tl_nav_links_report *report)
{
    json_t *object = json_pack("{sI sI sI sI}", "ledges", (json_int_t)report->ledge_count, "places",
                               (json_int_t)report->sample_count, "no_landing", (json_int_t)report->no_landing,
                               "too_fast", (json_int_t)report->too_fast);
    for (int kind = 0; kind < TL_NAV_LINK_KINDS; ++kind) {
        const tl_nav_links_count *count = &report->kinds[kind];
        json_object_set_new(object, tl_nav_link_kind_name((tl_nav_link_kind)kind),
                            json_pack("{sI sI sI sI}", "kept", (json_int_t)count->kept, "tried",
                                      (json_int_t)count->tried, "blocked", (json_int_t)count->blocked, "useless",
                                      (json_int_t)count->useless));
    }
    return object;
}

json_t *tl_level_links_list_json(const tl_pack_frame *frame, const tl_nav_links *links)
{
    json_t *list = json_array();
    const tl_nav_jump_link *at = tl_nav_links_array(links);
    for (uint32_t i = 0; i < links->link_count; ++i) {
        json_array_append_new(
            list, json_pack("{ss so so so sb}", "kind", tl_nav_link_kind_name((tl_nav_link_kind)at[i].kind), "start",
                            tl_json_placed(frame, at[i].start), "end", tl_json_placed(frame, at[i].end), "apex",
                            tl_json_float(at[i].apex), "both_ways", (int)at[i].both_ways));
    }
    return list;
}
