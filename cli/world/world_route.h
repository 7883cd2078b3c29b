// SPDX-License-Identifier: MIT
//
// talus world routes, and talus world route.

#ifndef TALUS_CLI_WORLD_ROUTE_H
#define TALUS_CLI_WORLD_ROUTE_H

#include "cli/shared/command.h"

#include <stdint.h>

/// Bakes the routes of a merged file into it, or into another one. `output` NULL: into it.
tl_exit tl_run_world_routes(tl_cli *cli, const char *path, const char *output, uint32_t block);

typedef struct tl_world_route_request {
    const char *file;    ///< a merged file with routes
    const char *ends[2]; ///< "x,y,z" each
    const char *extents; ///< metres around them that are looked at for the navmesh, the text of --extents, or NULL
    const char *output;  ///< NULL, or where a picture of the route goes
    uint32_t size;       ///< pixels along the longer side of its map
} tl_world_route_request;

/// Prints the route from one point to another, and draws it. Where there is none, no picture is written.
tl_exit tl_run_world_route(tl_cli *cli, const tl_world_route_request *request);

#endif
