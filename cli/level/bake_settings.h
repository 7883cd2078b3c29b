// SPDX-License-Identifier: MIT
//
// What to bake, and how: one option a field of the defs.

#ifndef TALUS_CLI_BAKE_SETTINGS_H
#define TALUS_CLI_BAKE_SETTINGS_H

#include "cli/level/hand_links.h"
#include "cli/level/level_areas.h"

#include <talus/nav_bake.h>
#include <talus/nav_links.h>

typedef struct tl_bake_settings {
    tl_level_settings level;
    bool soup, nav, hull;
    bool links; ///< needs soup and nav
    tl_nav_links_def links_def;
    int soup_layout;    ///< a tl_soup_layout
    tl_nav_def nav_def; ///< the host is set when baking
    int partition;      ///< a tl_nav_partition
    int polygon_method; ///< a tl_partition_method
    const char *bounds; ///< "x,y,z,x,y,z", or NULL: the level's own
    tl_area_settings areas;
    tl_option_texts seeds; ///< "x,y,z" each: islands without one are left out
    bool drop_inside;      ///< islands inside solids are left out
    float min_island_area; ///< square metres: smaller islands are left out
    tl_hand_link_settings hand_links;
} tl_bake_settings;

enum { TL_NAV_OPTIONS = 29, TL_PART_OPTIONS = 6 };

/// Soup and navmesh, no hull; Recast's defaults.
tl_bake_settings tl_default_bake_settings(void);
/// The def with what the options chose.
tl_nav_def tl_bake_nav_def(const tl_bake_settings *settings);

/// Options for the navmesh's def, named as its fields, for areas and for pruning.
void tl_nav_options(tl_bake_settings *settings, tl_option table[TL_NAV_OPTIONS]);
/// Reads the text of --bounds into the def. False: it was refused.
bool tl_bake_take_bounds(tl_cli *cli, tl_bake_settings *settings, tl_exit *exit_out);
/// Options for which parts are baked.
void tl_part_options(tl_bake_settings *settings, tl_option table[TL_PART_OPTIONS]);

#endif
