// SPDX-License-Identifier: MIT
//
// Baking: a level to soup, hull and navmesh, in memory.

#ifndef TALUS_CLI_BAKE_LEVEL_H
#define TALUS_CLI_BAKE_LEVEL_H

#include "cli/level/area_sums.h"
#include "cli/level/bake_settings.h"
#include "cli/level/level_links.h"

#include <talus/hull.h>
#include <talus/nav_prune.h>
#include <talus/nav_query.h>
#include <talus/pack.h>
#include <talus/soup.h>

/// What came out. Parts that were not asked for are NULL or zero.
typedef struct tl_bake {
    tl_soup *soup;
    tl_soup_report soup_report;
    tl_hull *hull;
    tl_result hull_result; ///< not TL_OK: the level has no hull (flat), and why
    tl_nav_tiles tiles;
    tl_nav_def nav_def; ///< as it was used
    tl_nav_bake_report nav_report;
    tl_nav_prune_report pruned; ///< zero when nothing was asked for
    tl_nav_tiles removed;       ///< what was pruned
    tl_pack_pruning *pruning;   ///< the rules; NULL: nothing was asked for
    bool walkable;              ///< there is at least one navmesh polygon
    tl_aabb nav_bounds;         ///< what the navmesh was built over
    double nav_area;            ///< square metres in the plane
    tl_area_sums areas;         ///< the same by area
    uint64_t nav_polygons;
    tl_pack_volumes *marks;        ///< NULL: no volumes were given
    tl_pack_areas *triangle_areas; ///< NULL: materials gave none
    tl_pack_offmesh *offmesh;      ///< links set by hand; NULL: none
    tl_level_links links;
} tl_bake;

/// The def that a level's navmesh is baked with; empty bounds: the level's own. Warns of a level whose numbers look
/// wrong.
tl_nav_def tl_bake_begin_nav(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings);
/// False: the failure was reported, and `*exit_out` says how to end. Free with tl_bake_free, also then.
/// A level of which nothing is walkable is no failure: `walkable` is false.
bool tl_bake_level(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake_out,
                   tl_exit *exit_out);
/// A navmesh that borrows the tiles. False: reported. Destroy it, also then.
bool tl_bake_assemble_navmesh(tl_cli *cli, const char *path, const tl_bake *bake, tl_navmesh **navmesh_out,
                              tl_exit *exit_out);
void tl_bake_free(tl_bake *bake);

#endif
