// SPDX-License-Identifier: MIT
//
// The route that the path stage shows: between the ends given, or across the level.

#include "cli/draw/draw_route.h"

#include "cli/draw/draw_stage.h"
#include "cli/level/agent_route.h"
#include "cli/level/navmesh_query.h"

#include <stdlib.h>
#include <string.h>

// Corners of a wide path around the end of a wall.
enum { HALF_CIRCLE = 17 };

// A route over the navmesh: what is needed to draw it.
typedef struct draw_route {
    tl_nav_query *query;
    tl_nav_path_buffers buffers;
    tl_nav_route route;
} draw_route;

static void free_route(draw_route *route)
{
    tl_nav_query_destroy(route->query);
    free(route->buffers.polygons);
    free(route->buffers.corners);
}

static tl_result make_route_room(const tl_navmesh *navmesh, draw_route *route)
{
    memset(route, 0, sizeof *route);
    uint64_t links = tl_navmesh_link_count(navmesh) + 2;
    if (links > UINT32_MAX / (2 * HALF_CIRCLE)) {
        return TL_ERR_LIMIT;
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    // A path that keeps away from walls needs room for those near it, however few polygons there are.
    def.max_nodes = links > def.max_nodes ? (uint32_t)links : def.max_nodes;
    // A path enters each polygon at most once, by one link; a straight path has a corner a portal, and two ends; one
    // that keeps away from walls has half a circle more a portal, at most.
    route->buffers.polygon_capacity = (uint32_t)links;
    route->buffers.corner_capacity = HALF_CIRCLE * ((uint32_t)links + 2);
    route->buffers.polygons = malloc((size_t)links * sizeof *route->buffers.polygons);
    route->buffers.corners = malloc(route->buffers.corner_capacity * sizeof *route->buffers.corners);
    if (route->buffers.polygons == NULL || route->buffers.corners == NULL) {
        return TL_ERR_MEMORY;
    }
    return tl_nav_query_create(&def, &route->query, NULL);
}

static tl_result find_drawn_route(const tl_navmesh *navmesh, draw_route *route, const tl_nav_route_request *request,
                                  float radius)
{
    return tl_agent_route_find(route->query, navmesh, request, radius, &route->buffers, &route->route);
}

static tl_result find_given_route(const tl_navmesh *navmesh, const draw_route_ends *ends, draw_route *route)
{
    const tl_nav_route_request request = { .start = ends->from,
                                           .goal = ends->to,
                                           .half_extents = { 2.0f, 4.0f, 2.0f } };
    return find_drawn_route(navmesh, route, &request, ends->radius);
}

// Without ends given: across the level, the longer one of its two diagonals that leads all the way, at the height of
// whatever floor is nearest there.
static tl_result find_longest_route(const draw_source *source, draw_route *route)
{
    const tl_navmesh *navmesh = source->input.navmesh;
    const tl_aabb bounds = tl_navmesh_bounds(navmesh);
    tl_vec3 size = tl_aabb_size(bounds);
    float longest = -1.0f;
    int best = 0;
    tl_vec3 from[2] = { bounds.min, { bounds.min.x, bounds.min.y, bounds.max.z } };
    tl_vec3 to[2] = { bounds.max, { bounds.max.x, bounds.min.y, bounds.min.z } };
    tl_result result = TL_NOT_FOUND;
    for (int i = 0; i < 3; i++) {
        int diagonal = i < 2 ? i : best;
        const tl_nav_route_request request = { .start = from[diagonal], .goal = to[diagonal], .half_extents = size };
        tl_result found = find_drawn_route(navmesh, route, &request, 0.0f);
        if (found != TL_OK && found != TL_NOT_FOUND) {
            return found;
        }
        bool complete = found == TL_OK && route->route.path.status == TL_NAV_PATH_COMPLETE;
        float length = found != TL_OK ? -1.0f : complete ? 1e6f + route->route.length : route->route.length;
        if (length > longest) {
            longest = length;
            best = diagonal;
            result = found;
        }
    }
    return result;
}

bool draw_route_add(draw_source *source, const draw_route_ends *ends, draw_scene *scene, tl_exit *exit_out)
{
    if (!draw_need_navmesh(source, exit_out)) {
        return false;
    }
    const tl_navmesh *navmesh = source->input.navmesh;
    if (tl_navmesh_tile_count(navmesh) == 0) {
        tl_cli_warn(source->cli, "%s: nothing is walkable; the picture shows no path", source->input.path);
        return true;
    }
    draw_route route;
    tl_result result = make_route_room(navmesh, &route);
    if (result == TL_OK) {
        result = ends != NULL ? find_given_route(navmesh, ends, &route) : find_longest_route(source, &route);
    }
    if (result == TL_OK) {
        draw_stage_route(scene, navmesh, &route.route, &route.buffers);
    } else if (result == TL_NOT_FOUND) {
        draw_stage_navmesh(scene, navmesh);
        tl_cli_warn(source->cli, "%s: there is no navmesh near %s; the picture shows no path", source->input.path,
                    route.route.start.polygon == TL_NAV_NO_REF ? "the start" : "the goal");
    } else {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, NULL);
    }
    free_route(&route);
    return result == TL_OK || result == TL_NOT_FOUND;
}
