// SPDX-License-Identifier: MIT

#include "cli/level/agent_route.h"

#include <string.h>

static tl_nav_path_status status_of(tl_nav_wide_status status)
{
    return status == TL_NAV_WIDE_COMPLETE       ? TL_NAV_PATH_COMPLETE
           : status == TL_NAV_WIDE_OUT_OF_NODES ? TL_NAV_PATH_OUT_OF_NODES
                                                : TL_NAV_PATH_UNREACHABLE;
}

static tl_result find_wide_route(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                                 float agent_radius, const tl_nav_path_buffers *buffers, tl_nav_route *route_out)
{
    const tl_vec3 half_extents = request->half_extents;
    const tl_vec3 ends[2] = { request->start, request->goal };
    tl_nav_location *places[2] = { &route_out->start, &route_out->goal };
    memset(route_out, 0, sizeof *route_out);
    for (int i = 0; i < 2; i++) {
        tl_nav_location near;
        tl_result result = tl_navmesh_find_nearest(navmesh, request->filter, ends[i], half_extents, &near);
        if (result == TL_OK) {
            const tl_nav_around_request around = { .filter = request->filter,
                                                   .center = near,
                                                   .radius = tl_minf(half_extents.x, half_extents.z) };
            result = tl_nav_query_find_wide_place(query, navmesh, &around, agent_radius, places[i]);
        }
        if (result != TL_OK) {
            return result;
        }
    }
    tl_nav_wide_path path;
    const tl_nav_path_request between = { request->filter, route_out->start, route_out->goal };
    tl_result result = tl_nav_query_find_wide_path(query, navmesh, &between, agent_radius, buffers->corners,
                                                   buffers->corner_capacity, &path);
    route_out->path.status = status_of(path.status);
    route_out->corner_count = path.corner_count;
    route_out->length = (float)path.surface_length;
    if (path.corner_count == 0 && buffers->corner_capacity > 0) {
        const tl_nav_corner stay = { route_out->start.point, route_out->start.polygon, TL_NAV_CORNER_START,
                                     TL_NAV_NO_REF };
        buffers->corners[0] = stay;
        route_out->corner_count = 1;
    }
    return result;
}

tl_result tl_agent_route_find(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                              float agent_radius, const tl_nav_path_buffers *buffers, tl_nav_route *route_out)
{
    return agent_radius > 0.0f ? find_wide_route(query, navmesh, request, agent_radius, buffers, route_out)
                               : tl_nav_query_find_route(query, navmesh, request, buffers, route_out);
}
