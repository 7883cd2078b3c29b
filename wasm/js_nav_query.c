// SPDX-License-Identifier: MIT
//
// Points, paths, and what lies around. Start and goal are points, for which the nearest polygon is sought, or places on
// a polygon already: `on_polygon` has bit 0 for the start and bit 1 for the goal, whose references stand in the slot.

#include "js_navmesh.h"
#include "js_threads.h"

#include <stdlib.h>
#include <string.h>

enum { WITH_POLYGONS = 8 };

static tl_result find_place(const tl_js_navmesh *self, uint32_t flags, uint32_t which, tl_vec3 point,
                            tl_vec3 half_extents, tl_nav_location *place_out)
{
    if ((flags >> which & 1u) != 0) {
        place_out->polygon = tl_js_u64(which);
        place_out->point = point;
        return TL_OK;
    }
    return tl_navmesh_find_nearest(self->navmesh, tl_js_filter_of(flags), point, half_extents, place_out);
}

/// Slot: the place.
tl_result TL_JS_EXPORT(js_find_nearest)(const tl_js_navmesh *self, uint32_t flags, float x, float y, float z, float hx,
                                        float hy, float hz)
{
    tl_nav_location place;
    const tl_result result = find_place(self, flags, 0, tl_vec3_make(x, y, z), tl_vec3_make(hx, hy, hz), &place);
    tl_js_put_place(0, &place);
    return result;
}

/// Slot: the place it starts from; then the point that can be reached.
tl_result TL_JS_EXPORT(js_find_reachable)(const tl_js_navmesh *self, uint32_t flags, float x, float y, float z)
{
    tl_nav_location place;
    const tl_result result = tl_navmesh_find_nearest_reachable(self->navmesh, tl_js_filter_of(flags), tl_js_u64(0),
                                                               tl_vec3_make(x, y, z), &place);
    tl_js_put_place(0, &place);
    return result;
}

/// Slot: the reference and the point; then the closest point and whether it is inside.
tl_result TL_JS_EXPORT(js_closest_point)(const tl_js_navmesh *self)
{
    tl_vec3 closest;
    bool inside;
    const tl_result result = tl_navmesh_closest_point(self->navmesh, tl_js_u64(0), tl_js_vec3(1), &closest, &inside);
    tl_js_put(tl_js_put_vec3(0, closest), inside);
    return result;
}

/// Slot: the reference; then the height.
tl_result TL_JS_EXPORT(js_height)(const tl_js_navmesh *self, float x, float z)
{
    float height;
    const tl_result result = tl_navmesh_height(self->navmesh, tl_js_u64(0), x, z, &height);
    tl_js_put(0, (double)height);
    return result;
}

/// Slot: the reference; then the island.
tl_result TL_JS_EXPORT(js_island)(const tl_js_navmesh *self)
{
    uint32_t island;
    const tl_result result = tl_navmesh_island(self->navmesh, tl_js_u64(0), &island);
    tl_js_put(0, island);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Paths.

static bool grow_path(tl_js_navmesh *self, uint32_t corners, uint32_t polygons)
{
    if (corners > self->corner_capacity) {
        free(self->corners);
        self->corner_capacity = corners + corners / 2 + 64;
        self->corners = malloc(self->corner_capacity * sizeof *self->corners);
    }
    if (polygons > self->polygon_capacity) {
        free(self->polygons);
        self->polygon_capacity = polygons + polygons / 2 + 64;
        self->polygons = malloc(self->polygon_capacity * sizeof *self->polygons);
    }
    if (self->corners == NULL || self->polygons == NULL) {
        self->corner_capacity = self->corners == NULL ? 0 : self->corner_capacity;
        self->polygon_capacity = self->polygons == NULL ? 0 : self->polygon_capacity;
        return false;
    }
    return true;
}

tl_result tl_js_put_corners(uint32_t at, const tl_nav_corner *corners, uint32_t count)
{
    tl_nav_ref *refs = tl_js_buffer_room(count * (sizeof(tl_nav_ref) + sizeof(tl_vec3) + sizeof(uint32_t)));
    if (refs == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_vec3 *points = (tl_vec3 *)(void *)(refs + count);
    uint32_t *flags = (uint32_t *)(void *)(points + count);
    for (uint32_t i = 0; i < count; i++) {
        refs[i] = corners[i].polygon;
        points[i] = corners[i].point;
        flags[i] = corners[i].flags;
    }
    at = tl_js_put_pointer(tl_js_put(at, count), refs);
    tl_js_put_pointer(tl_js_put_pointer(at, points), flags);
    return TL_OK;
}

/// The shortest path. Slot: status, lengths, nodes, start, goal, polygons, corners. TL_NOT_FOUND: no polygon is near
/// the start or the goal.
tl_result TL_JS_EXPORT(js_find_path)(tl_js_navmesh *self, uint32_t flags, float sx, float sy, float sz, float gx,
                                     float gy, float gz, float hx, float hy, float hz)
{
    const tl_vec3 half = tl_vec3_make(hx, hy, hz);
    tl_nav_path_request request;
    request.filter = tl_js_filter_of(flags);
    tl_nav_query *query;
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result == TL_OK) {
        result = find_place(self, flags, 0, tl_vec3_make(sx, sy, sz), half, &request.start);
    }
    if (result == TL_OK) {
        result = find_place(self, flags, 1, tl_vec3_make(gx, gy, gz), half, &request.goal);
    }
    if (result != TL_OK) {
        return result;
    }
    tl_nav_shortest_path path;
    uint32_t corners = 64, polygons = (flags & WITH_POLYGONS) != 0 ? 256 : 0;
    do {
        if (!grow_path(self, corners, polygons > 0 ? polygons : 1)) {
            return TL_ERR_MEMORY;
        }
        const tl_nav_path_buffers buffers = { self->polygons, polygons > 0 ? self->polygon_capacity : 0, self->corners,
                                              self->corner_capacity };
        result = tl_nav_query_find_shortest_path(query, self->navmesh, &request, &buffers, &path);
        corners = path.corner_count;
        polygons = polygons > 0 ? path.polygon_count : 0;
    } while (result == TL_INCOMPLETE);
    uint32_t at = tl_js_put(0, path.status);
    at = tl_js_put(tl_js_put(tl_js_put(at, path.length), path.lower_bound), path.surface_length);
    at = tl_js_put_place(tl_js_put_place(tl_js_put(at, path.node_count), &request.start), &request.goal);
    at = tl_js_put_pointer(tl_js_put(at, polygons), self->polygons);
    return result == TL_OK ? tl_js_put_corners(at, self->corners, path.corner_count) : result;
}

/// The cheapest path by area costs. Slot: as js_find_path, the cost in the place of the lower bound.
tl_result TL_JS_EXPORT(js_find_route)(tl_js_navmesh *self, uint32_t flags, float sx, float sy, float sz, float gx,
                                      float gy, float gz, float hx, float hy, float hz)
{
    const tl_nav_route_request request = { tl_js_filter_of(flags), tl_vec3_make(sx, sy, sz), tl_vec3_make(gx, gy, gz),
                                           tl_vec3_make(hx, hy, hz) };
    tl_nav_query *query;
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_route route;
    uint32_t corners = 64, polygons = 256;
    do {
        if (!grow_path(self, corners, polygons)) {
            return TL_ERR_MEMORY;
        }
        const tl_nav_path_buffers buffers = { self->polygons, self->polygon_capacity, self->corners,
                                              self->corner_capacity };
        result = tl_nav_query_find_route(query, self->navmesh, &request, &buffers, &route);
        polygons = route.path.polygon_count;
        corners = route.corner_count > self->corner_capacity ? route.corner_count : self->corner_capacity;
    } while (result == TL_INCOMPLETE);
    double plane = 0.0;
    for (uint32_t i = 1; result == TL_OK && i < route.corner_count; i++) {
        const tl_vec3 step = tl_sub(self->corners[i].point, self->corners[i - 1].point);
        plane += (double)tl_length(tl_vec3_make(step.x, 0.0f, step.z));
    }
    uint32_t at = tl_js_put(0, route.path.status);
    at = tl_js_put(tl_js_put(tl_js_put(at, plane), (double)route.path.cost), (double)route.length);
    at = tl_js_put_place(tl_js_put_place(tl_js_put(at, route.path.node_count), &route.start), &route.goal);
    at = tl_js_put_pointer(tl_js_put(at, route.path.polygon_count), self->polygons);
    return result == TL_OK ? tl_js_put_corners(at, self->corners, route.corner_count) : result;
}

/// A path for a wider agent. Slot: as js_find_path, the distance to walls in the place of the lower bound.
tl_result TL_JS_EXPORT(js_find_wide_path)(tl_js_navmesh *self, uint32_t flags, float radius, float sx, float sy,
                                          float sz, float gx, float gy, float gz, float hx, float hy, float hz)
{
    const tl_vec3 half = tl_vec3_make(hx, hy, hz);
    tl_nav_path_request request;
    request.filter = tl_js_filter_of(flags);
    tl_nav_query *query;
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result == TL_OK) {
        result = find_place(self, flags, 0, tl_vec3_make(sx, sy, sz), half, &request.start);
    }
    if (result == TL_OK) {
        result = find_place(self, flags, 1, tl_vec3_make(gx, gy, gz), half, &request.goal);
    }
    if (result != TL_OK) {
        return result;
    }
    tl_nav_wide_path path;
    uint32_t corners = 64;
    do {
        if (!grow_path(self, corners, 1)) {
            return TL_ERR_MEMORY;
        }
        result = tl_nav_query_find_wide_path(query, self->navmesh, &request, radius, self->corners,
                                             self->corner_capacity, &path);
        corners = path.corner_count;
    } while (result == TL_INCOMPLETE);
    uint32_t at = tl_js_put(0, path.status);
    at = tl_js_put(tl_js_put(tl_js_put(at, path.length), path.wall_distance), path.surface_length);
    at = tl_js_put_place(tl_js_put_place(tl_js_put(at, path.node_count), &request.start), &request.goal);
    at = tl_js_put_pointer(tl_js_put(at, 0), NULL);
    return result == TL_OK ? tl_js_put_corners(at, self->corners, path.corner_count) : result;
}

/// Slot: bytes for a table; then kind, corner vertices, edges, bytes.
tl_result TL_JS_EXPORT(js_prepare)(tl_js_navmesh *self)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    def.table_bytes = (uint64_t)tl_js_slot[0];
    def.tasks = tl_js_tasks();
    tl_nav_prepared prepared;
    const tl_result result = tl_navmesh_prepare(self->navmesh, &def, &prepared);
    tl_js_report = prepared.base;
    uint32_t at = tl_js_put(tl_js_put(0, prepared.kind), prepared.corner_vertex_count);
    tl_js_put(tl_js_put(at, prepared.edge_count), (double)prepared.bytes);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Around a place. Slot: the place that is asked about, reference and point.

/// Slot: the start; then hit, t, point, normal, polygon.
tl_result TL_JS_EXPORT(js_surface_ray)(const tl_js_navmesh *self, uint32_t flags, float x, float y, float z)
{
    const tl_nav_location start = tl_js_place(0);
    tl_nav_ray_hit hit;
    const tl_result result =
        tl_navmesh_cast_ray(self->navmesh, tl_js_filter_of(flags), &start, tl_vec3_make(x, y, z), NULL, 0, &hit);
    uint32_t at = tl_js_put(tl_js_put(0, hit.hit), (double)hit.t);
    at = tl_js_put_vec3(tl_js_put_vec3(at, hit.point), hit.normal);
    tl_js_put_u64(at, hit.polygon);
    return result;
}

/// Slot: the start; then the end.
tl_result TL_JS_EXPORT(js_move)(tl_js_navmesh *self, uint32_t flags, float x, float y, float z)
{
    const tl_nav_move_request request = { tl_js_filter_of(flags), tl_js_place(0), tl_vec3_make(x, y, z) };
    tl_nav_query *query;
    tl_nav_move move;
    memset(&move, 0, sizeof move);
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result == TL_OK) {
        result = tl_nav_query_move_along_surface(query, self->navmesh, &request, NULL, 0, &move);
    }
    tl_js_put_place(0, &move.end);
    return result;
}

/// Slot: the center; then hit, distance, point, normal, polygon.
tl_result TL_JS_EXPORT(js_find_wall)(tl_js_navmesh *self, uint32_t flags, float radius)
{
    const tl_nav_around_request request = { tl_js_filter_of(flags), tl_js_place(0), radius };
    tl_nav_query *query;
    tl_nav_wall wall;
    memset(&wall, 0, sizeof wall);
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result == TL_OK) {
        result = tl_nav_query_find_wall(query, self->navmesh, &request, &wall);
    }
    uint32_t at = tl_js_put(tl_js_put(0, wall.hit), (double)wall.distance);
    at = tl_js_put_vec3(tl_js_put_vec3(at, wall.point), wall.normal);
    tl_js_put_u64(at, wall.polygon);
    return result;
}

/// Slot: the center; then the place.
tl_result TL_JS_EXPORT(js_find_wide_place)(tl_js_navmesh *self, uint32_t flags, float radius, float agent_radius)
{
    const tl_nav_around_request request = { tl_js_filter_of(flags), tl_js_place(0), radius };
    tl_nav_query *query;
    tl_nav_location place;
    memset(&place, 0, sizeof place);
    tl_result result = tl_js_navmesh_query(self, &query);
    if (result == TL_OK) {
        result = tl_nav_query_find_wide_place(query, self->navmesh, &request, agent_radius, &place);
    }
    tl_js_put_place(0, &place);
    return result;
}

/// Slot: two random numbers of 64 bits, then the center if it is around one; then the place.
tl_result TL_JS_EXPORT(js_random_point)(tl_js_navmesh *self, uint32_t flags, int32_t around, float radius)
{
    const uint64_t random[2] = { tl_js_u64(0), tl_js_u64(1) };
    tl_nav_location place;
    memset(&place, 0, sizeof place);
    tl_result result;
    if (around) {
        const tl_nav_around_request request = { tl_js_filter_of(flags), tl_js_place(2), radius };
        tl_nav_query *query;
        result = tl_js_navmesh_query(self, &query);
        if (result == TL_OK) {
            result = tl_nav_query_random_reachable(query, self->navmesh, &request, random, &place);
        }
    } else {
        result = tl_navmesh_random_point(self->navmesh, tl_js_filter_of(flags), random, &place);
    }
    tl_js_put_place(0, &place);
    return result;
}
