// SPDX-License-Identifier: MIT
//
// The route of an agent of any radius, from the navmesh's own upwards.

#ifndef TALUS_CLI_AGENT_ROUTE_H
#define TALUS_CLI_AGENT_ROUTE_H

#include <talus/nav_wide.h>

/// tl_nav_query_find_route for an agent radius, metres; 0: the navmesh's own agent. A wider agent's route leads between
/// the places with room for it that are nearest to the ends, and has corners and no polygons. TL_INCOMPLETE: the counts
/// say what the buffers must hold.
tl_result tl_agent_route_find(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                              float agent_radius, const tl_nav_path_buffers *buffers, tl_nav_route *route_out);

#endif
