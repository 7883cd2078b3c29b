// SPDX-License-Identifier: MIT
//
// Nearest points, path and corners in one call: by the exact search where all metres cost the same, which has the
// corners already; else by A* and the funnel.

#include "base/assert.h"
#include "nav_query/navmesh/filter.h"

#include <string.h>
#include <talus/nav_query.h>

// The exact path; `*found_out` says whether there was one within the query's nodes.
static tl_result route_exactly(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter, float metre,
                               const tl_nav_location *target, const tl_nav_route_buffers *buffers, tl_nav_route *route,
                               bool *found_out)
{
    tl_nav_shortest_path path;
    tl_result result =
        tl_nav_query_find_shortest_path(query, navmesh, filter, &route->start, target, buffers->corners,
                                        buffers->corner_capacity, buffers->polygons, buffers->polygon_capacity, &path);
    *found_out = path.status == TL_NAV_PATH_COMPLETE;
    if (*found_out) {
        route->path.status = path.status;
        route->path.polygon_count = path.polygon_count;
        route->path.end = *target;
        route->path.cost = metre * (float)path.length;
        route->path.node_count = path.node_count;
        route->corner_count = path.corner_count;
        route->length = (float)path.surface_length;
        bool fits = path.polygon_count <= buffers->polygon_capacity && path.corner_count <= buffers->corner_capacity;
        result = result == TL_OK && !fits ? TL_INCOMPLETE : result;
    }
    return result;
}

static tl_result route_to(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                          const tl_nav_location *target, const tl_nav_route_buffers *buffers, tl_nav_route *route)
{
    float least = 1.0f;
    bool is_uniform = true;
    if (filter != NULL && !tl_nav_filter_costs(filter, &least, &is_uniform)) {
        return TL_ERR_ARGUMENT;
    }
    if (is_uniform) {
        bool found = false;
        tl_result result = route_exactly(query, navmesh, filter, least, target, buffers, route, &found);
        if (found || result != TL_OK) {
            return result;
        }
    }
    TL_TRY(tl_nav_query_find_path(query, navmesh, filter, &route->start, target, buffers->polygons,
                                  buffers->polygon_capacity, &route->path));
    return tl_navmesh_straight_path(navmesh, buffers->polygons, route->path.polygon_count, route->start.point,
                                    route->path.end.point, buffers->corners, buffers->corner_capacity,
                                    &route->corner_count, &route->length);
}

tl_result tl_nav_query_find_route(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                  tl_vec3 start, tl_vec3 goal, tl_vec3 half_extents,
                                  const tl_nav_route_buffers *buffers, tl_nav_route *route_out)
{
    memset(route_out, 0, sizeof *route_out);
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, start, half_extents, &route_out->start));
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, goal, half_extents, &route_out->goal));
    uint32_t islands[2];
    TL_TRY(tl_navmesh_island(navmesh, route_out->start.polygon, &islands[0]));
    TL_TRY(tl_navmesh_island(navmesh, route_out->goal.polygon, &islands[1]));
    if (islands[0] == islands[1]) {
        return route_to(query, navmesh, filter, &route_out->goal, buffers, route_out);
    }
    // As near as any path leads.
    tl_nav_location nearest;
    TL_TRY(
        tl_navmesh_find_nearest_reachable(navmesh, filter, route_out->start.polygon, route_out->goal.point, &nearest));
    tl_result result = route_to(query, navmesh, filter, &nearest, buffers, route_out);
    if (route_out->path.status == TL_NAV_PATH_COMPLETE) {
        route_out->path.status = TL_NAV_PATH_UNREACHABLE;
    }
    return result;
}
