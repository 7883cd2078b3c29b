// SPDX-License-Identifier: MIT
//
// What is probably wrong with a level of which nothing, or something odd, is walkable: its units, its up axis, its
// winding, its slopes, or the agent. Each cause is looked for in the triangles, or proven by a bake without it.

#ifndef TALUS_CLI_LEVEL_DOUBT_H
#define TALUS_CLI_LEVEL_DOUBT_H

#include "cli/level/bake_settings.h"

#include <talus/nav_prune.h>

enum { TL_DOUBT_BYTES = 320 };

/// The likeliest cause, and what to do about it.
typedef struct tl_level_doubt {
    const char *cause; ///< "units", "up axis", "winding", "slope", "bounds" ...; NULL: nothing is odd
    char text[TL_DOUBT_BYTES];
} tl_level_doubt;

/// What is odd about a level whatever becomes of it: most of its area would be floor with the other up axis, most of
/// its floors face down, or it is large enough to be in centimetres. O(triangles). The levels that the tests know raise
/// none of these as they are.
tl_level_doubt tl_level_doubt_find(const tl_mesh_view *mesh, tl_aabb bounds, const tl_bake_settings *settings);

/// Why a bake came out without a polygon, from what it and the pruning after it reported. The agent is proven to be too
/// large by bakes with smaller ones. Never without a cause.
tl_level_doubt tl_level_explain_empty(const tl_cli *cli, const tl_level *level, const tl_bake_settings *settings,
                                      const tl_nav_bake_report *baked, const tl_nav_prune_report *pruned);

#endif
