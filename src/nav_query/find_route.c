// SPDX-License-Identifier: MIT
//
// Nearest points, path and straight path in one call.

#include "base/assert.h"

#include <string.h>
#include <talus/nav_query.h>

// A path to the point of the start's island that is nearest to the goal.
static tl_result lead_near(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                           const tl_nav_route_buffers *buffers, tl_nav_route *route)
{
    tl_nav_location nearest;
    TL_TRY(tl_navmesh_find_nearest_reachable(navmesh, filter, route->start.polygon, route->goal.point, &nearest));
    TL_TRY(tl_nav_query_find_path(query, navmesh, filter, &route->start, &nearest, buffers->polygons,
                                  buffers->polygon_capacity, &route->path));
    if (route->path.status == TL_NAV_PATH_COMPLETE) {
        route->path.status = TL_NAV_PATH_UNREACHABLE;
    }
    return TL_OK;
}

tl_result tl_nav_query_find_route(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                  tl_vec3 start, tl_vec3 goal, tl_vec3 half_extents,
                                  const tl_nav_route_buffers *buffers, tl_nav_route *route_out)
{
    memset(route_out, 0, sizeof *route_out);
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, start, half_extents, &route_out->start));
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, goal, half_extents, &route_out->goal));
    TL_TRY(tl_nav_query_find_path(query, navmesh, filter, &route_out->start, &route_out->goal, buffers->polygons,
                                  buffers->polygon_capacity, &route_out->path));
    uint32_t islands[2];
    TL_TRY(tl_navmesh_island(navmesh, route_out->start.polygon, &islands[0]));
    TL_TRY(tl_navmesh_island(navmesh, route_out->goal.polygon, &islands[1]));
    if (islands[0] != islands[1]) {
        TL_TRY(lead_near(query, navmesh, filter, buffers, route_out));
    }
    return tl_navmesh_straight_path(navmesh, buffers->polygons, route_out->path.polygon_count, route_out->start.point,
                                    route_out->path.end.point, buffers->corners, buffers->corner_capacity,
                                    &route_out->corner_count, &route_out->length);
}
