// SPDX-License-Identifier: MIT

#ifndef TALUS_CLI_DRAW_ROUTE_H
#define TALUS_CLI_DRAW_ROUTE_H

#include "cli/draw/draw_scene.h"
#include "cli/draw/draw_source.h"

typedef struct draw_route_ends {
    tl_vec3 from, to;
    float radius; ///< metres, of an agent wider than the navmesh's own; 0: that one
} draw_route_ends;

/// Adds the navmesh and a route over it; `ends` NULL: across the level. Ends without navmesh near them are a warning.
/// False: reported.
bool draw_route_add(draw_source *source, const draw_route_ends *ends, draw_scene *scene, tl_exit *exit_out);

#endif
