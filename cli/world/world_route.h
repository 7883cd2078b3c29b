// SPDX-License-Identifier: MIT
//
// talus world routes, and talus world route.

#ifndef TALUS_CLI_WORLD_ROUTE_H
#define TALUS_CLI_WORLD_ROUTE_H

#include "cli/shared/command.h"

#include <stdint.h>

/// Bakes the routes of a merged file into it, or into another one. `output` NULL: into it.
tl_exit tl_run_world_routes(tl_cli *cli, const char *path, const char *output, uint32_t block);
/// Prints the route from one point to another, "x,y,z" each. `extents`: metres around them that are looked at for the
/// navmesh, the text of --extents, or NULL.
tl_exit tl_run_world_route(tl_cli *cli, const char *path, const char *const ends[2], const char *extents);

#endif
