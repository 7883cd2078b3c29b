// SPDX-License-Identifier: MIT
//
// What commands that ask a navmesh share.

#ifndef TALUS_CLI_NAVMESH_QUERY_H
#define TALUS_CLI_NAVMESH_QUERY_H

#include "cli/shared/command.h"

#include <talus/nav_query.h>

/// Reads the text of --extents, where it was given, into `extents`; once more when FILE is open, whose axes it is in.
/// False: it was refused.
bool tl_extents_read(tl_cli *cli, const char *text, tl_vec3 *extents, tl_exit *exit_out);

/// Nodes for every link there is, so that no search gives up.
tl_nav_query_def tl_whole_query_def(const tl_navmesh *navmesh);

/// Around all tiles; tl_aabb_empty() without tiles.
tl_aabb tl_navmesh_bounds(const tl_navmesh *navmesh);

#endif
