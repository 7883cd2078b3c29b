// SPDX-License-Identifier: MIT
//
// The way of an agent wider than the navmesh's own, as a route like any other.

#ifndef TALUS_CLI_WIDE_ROUTE_H
#define TALUS_CLI_WIDE_ROUTE_H

#include <talus/nav_wide.h>

/// tl_nav_query_find_route for an agent radius: between the places with room that are nearest to the ends. The route
/// has corners and no polygons. TL_INCOMPLETE: route_out->corner_count says how much room is needed.
tl_result tl_find_wide_route(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                             float agent_radius, const tl_nav_path_buffers *buffers, tl_nav_route *route_out);

#endif
