// SPDX-License-Identifier: MIT
//
// Nearest points, path and corners in one call: by the exact search where all metres cost the same, which yields the
// corners too; else by A* and the funnel.

#include "base/assert.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/path/path_run.h"

#include <string.h>
#include <talus/nav_query.h>

// The exact path; `*found_out` says whether there was one within the query's nodes.
static tl_result route_exactly(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                               float metre_cost, const tl_nav_path_buffers *buffers, tl_nav_route *route,
                               bool *found_out)
{
    tl_nav_shortest_path path;
    tl_result result = tl_nav_query_find_shortest_path(query, navmesh, request, buffers, &path);
    *found_out = path.status == TL_NAV_PATH_COMPLETE;
    if (*found_out) {
        route->path.status = path.status;
        route->path.polygon_count = path.polygon_count;
        route->path.end = request->goal;
        route->path.cost = metre_cost * (float)path.length;
        route->path.node_count = path.node_count;
        route->corner_count = path.corner_count;
        route->length = (float)path.surface_length;
        bool fits = path.polygon_count <= buffers->polygon_capacity && path.corner_count <= buffers->corner_capacity;
        result = result == TL_OK && !fits ? TL_INCOMPLETE : result;
    }
    return result;
}

static tl_result route_between(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                               const tl_nav_path_buffers *buffers, tl_nav_route *route)
{
    float least = 1.0f;
    bool is_uniform = true;
    if (request->filter != NULL &&
        !tl_nav_filter_costs_again(&query->known_costs, request->filter, &least, &is_uniform)) {
        return TL_ERR_ARGUMENT;
    }
    if (is_uniform) {
        bool found = false;
        tl_result result = route_exactly(query, navmesh, request, least, buffers, route, &found);
        if (found || result != TL_OK) {
            return result;
        }
    }
    TL_TRY(tl_nav_query_find_path(query, navmesh, request, buffers->polygons, buffers->polygon_capacity, &route->path));
    const tl_nav_polygon_path path = { buffers->polygons, route->path.polygon_count, request->start.point,
                                       route->path.end.point };
    return tl_navmesh_straight_path(navmesh, &path, buffers->corners, buffers->corner_capacity, &route->corner_count,
                                    &route->length);
}

static tl_result route_over(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                            const tl_nav_path_buffers *buffers, tl_nav_route *route_out)
{
    const tl_nav_filter *filter = request->filter;
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, request->start, request->half_extents, &route_out->start));
    TL_TRY(tl_navmesh_find_nearest(navmesh, filter, request->goal, request->half_extents, &route_out->goal));
    tl_nav_path_request between = { filter, route_out->start, route_out->goal };
    uint32_t islands[2];
    TL_TRY(tl_navmesh_island(navmesh, route_out->start.polygon, &islands[0]));
    TL_TRY(tl_navmesh_island(navmesh, route_out->goal.polygon, &islands[1]));
    if (islands[0] == islands[1]) {
        return route_between(query, navmesh, &between, buffers, route_out);
    }
    // As near as any path leads.
    TL_TRY(tl_navmesh_find_nearest_reachable(navmesh, filter, route_out->start.polygon, route_out->goal.point,
                                             &between.goal));
    tl_result result = route_between(query, navmesh, &between, buffers, route_out);
    if (route_out->path.status == TL_NAV_PATH_COMPLETE) {
        route_out->path.status = TL_NAV_PATH_UNREACHABLE;
    }
    return result;
}

tl_result tl_nav_query_find_route(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_route_request *request,
                                  const tl_nav_path_buffers *buffers, tl_nav_route *route_out)
{
    static const tl_nav_path_buffers none = { NULL, 0, NULL, 0 };
    const tl_nav_path_buffers *used = buffers != NULL ? buffers : &none;
    if (query == NULL || navmesh == NULL || request == NULL || route_out == NULL || !tl_nav_are_buffers(used)) {
        return TL_ERR_ARGUMENT;
    }
    memset(route_out, 0, sizeof *route_out);
    tl_result result = route_over(query, navmesh, request, used, route_out);
    if (tl_is_error(result)) {
        memset(route_out, 0, sizeof *route_out);
    }
    return result;
}
