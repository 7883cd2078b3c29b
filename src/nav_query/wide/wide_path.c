// SPDX-License-Identifier: MIT
//
// Paths for agents wider than the one that the mesh was baked for: the public calls.

#include "nav_query/search/query_memory.h"
#include "nav_query/wide/free_pieces.h"
#include "nav_query/wide/wide_search.h"

#include "base/assert.h"
#include "nav_query/exact/shortest_search.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/plane/surface.h"

#include <string.h>

static tl_nav_corner wide_corner(tl_nav_clearance *clearance, const tl_nav_polyline_vertex *vertex)
{
    tl_nav_met home = { vertex->slot, vertex->polygon };
    tl_nav_location at = tl_nav_spot_on_surface(clearance, home, vertex->spot);
    tl_nav_corner corner = { at.point, at.polygon, 0, TL_NAV_NO_REF };
    return corner;
}

static void write_wide_corners(tl_nav_clearance *clearance, const tl_nav_polyline *path, tl_nav_corner *corners,
                               uint32_t capacity, tl_nav_wide_path *out)
{
    tl_vec3 last = { 0.0f, 0.0f, 0.0f };
    for (uint32_t i = 0; i != TL_NAV_NO_NODE; i = path->vertices[i].next) {
        const tl_nav_polyline_vertex *vertex = &path->vertices[i];
        tl_nav_corner corner = wide_corner(clearance, vertex);
        if (vertex->before == TL_NAV_NO_NODE) {
            corner.flags = TL_NAV_CORNER_START;
        } else {
            const tl_nav_polyline_vertex *before = &path->vertices[vertex->before];
            out->length += sqrt(tl_nav_spot_distance_sq(before->spot, vertex->spot));
            out->surface_length += (double)tl_distance(last, corner.point);
            if (vertex->next == TL_NAV_NO_NODE) {
                corner.flags = TL_NAV_CORNER_END;
            } else {
                double turn = tl_nav_spot_turn(before->spot, vertex->spot, path->vertices[vertex->next].spot);
                corner.flags = turn < 0.0 ? TL_NAV_CORNER_LEFT : TL_NAV_CORNER_RIGHT;
            }
        }
        if (out->corner_count < capacity) {
            corners[out->corner_count] = corner;
        }
        out->corner_count++;
        last = corner.point;
    }
}

// Without a wider agent the shortest path is the answer.
static tl_result find_narrow(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                             const tl_nav_path_buffers *buffers, tl_nav_wide_path *path_out)
{
    tl_nav_shortest_path path;
    tl_result result = tl_nav_query_find_shortest_path(query, navmesh, request, buffers, &path);
    path_out->status = path.status == TL_NAV_PATH_COMPLETE       ? TL_NAV_WIDE_COMPLETE
                       : path.status == TL_NAV_PATH_OUT_OF_NODES ? TL_NAV_WIDE_OUT_OF_NODES
                                                                 : TL_NAV_WIDE_UNREACHABLE;
    path_out->corner_count = path.corner_count;
    path_out->length = path.length;
    path_out->surface_length = path.surface_length;
    path_out->node_count = path.node_count;
    return path.corner_count > buffers->corner_capacity && result == TL_OK ? TL_INCOMPLETE : result;
}

// Looks for the pieces that lead to the goal. TL_NAV_WIDE_COMPLETE: there are.
static tl_nav_wide_status search_pieces(tl_nav_wide_search *search)
{
    tl_nav_clearance *clearance = search->clearance;
    search->portals = tl_nav_take_scratch(clearance, clearance->query->max_nodes, sizeof *search->portals);
    if (search->portals == NULL) {
        return TL_NAV_WIDE_OUT_OF_NODES;
    }
    if (!tl_nav_wide_place_end(search, &search->start)) {
        return clearance->is_full ? TL_NAV_WIDE_OUT_OF_NODES : TL_NAV_WIDE_START_BLOCKED;
    }
    if (!tl_nav_wide_place_end(search, &search->goal)) {
        return clearance->is_full ? TL_NAV_WIDE_OUT_OF_NODES : TL_NAV_WIDE_GOAL_BLOCKED;
    }
    bool is_found = tl_nav_wide_run(search);
    return is_found ? TL_NAV_WIDE_COMPLETE : clearance->is_full ? TL_NAV_WIDE_OUT_OF_NODES : TL_NAV_WIDE_UNREACHABLE;
}

static tl_result write_path(tl_nav_wide_search *search, tl_nav_corner *corners_out, uint32_t capacity,
                            tl_nav_wide_path *path_out)
{
    tl_nav_clearance *clearance = search->clearance;
    // Vertices get a quarter of the memory that is left: each one is smaller than what is gathered around it.
    tl_nav_polyline path = { NULL, 0, 0, TL_NAV_NO_NODE };
    path.capacity =
        (uint32_t)((uint64_t)(clearance->scratch.high - clearance->scratch.low) / 4 / sizeof *path.vertices);
    path.vertices = tl_nav_take_scratch(clearance, path.capacity, sizeof *path.vertices);
    if (!tl_nav_wide_funnel(search, &path) || !tl_nav_wide_pull_taut(clearance, &path)) {
        path_out->status = TL_NAV_WIDE_OUT_OF_NODES;
        return TL_OK;
    }
    write_wide_corners(clearance, &path, corners_out, capacity, path_out);
    return path_out->corner_count <= capacity ? TL_OK : TL_INCOMPLETE;
}

// What a path and the question whether there is one have in common, within the nodes that the query has now. `buffers`
// NULL: only the question.
static tl_result find_wide_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                                  float radius, const tl_nav_path_buffers *buffers, tl_nav_wide_path *path_out)
{
    memset(path_out, 0, sizeof *path_out);
    if (!isfinite(radius)) {
        return TL_ERR_NOT_FINITE;
    }
    if (radius < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_shortest_search ends;
    TL_TRY(tl_nav_prepare_shortest(query, navmesh, request, &ends));
    tl_nav_clearance clearance;
    double reach = tl_nav_extra_reach(navmesh->slots[ends.start_slot].tile, radius);
    tl_nav_clearance_begin(query, navmesh, request->filter, reach, &clearance);
    // Corners are rounded to floats at the end.
    path_out->wall_distance = fmax(clearance.least - clearance.slack, 0.0);
    if (!(clearance.least > 0.0)) {
        const tl_nav_path_buffers none = { NULL, 0, NULL, 0 };
        return find_narrow(query, navmesh, request, buffers != NULL ? buffers : &none, path_out);
    }
    if (tl_nav_is_cut_off(&ends)) {
        path_out->status = TL_NAV_WIDE_UNREACHABLE;
        return TL_OK;
    }
    tl_nav_wide_search search = { &clearance,
                                  { tl_nav_spot_of(ends.start), ends.start_slot, ends.start_polygon,
                                    TL_NAV_NO_COMPONENT },
                                  { tl_nav_spot_of(ends.goal), ends.goal_slot, ends.goal_polygon, TL_NAV_NO_COMPONENT },
                                  NULL,
                                  false,
                                  TL_NAV_NO_NODE };
    tl_nav_pool_reset(query);
    path_out->status = search_pieces(&search);
    path_out->node_count = query->node_count;
    return buffers == NULL || path_out->status != TL_NAV_WIDE_COMPLETE
               ? TL_OK
               : write_path(&search, buffers->corners, buffers->corner_capacity, path_out);
}

static tl_result find_wide(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                           float radius, const tl_nav_path_buffers *buffers, tl_nav_wide_path *path_out)
{
    tl_result result;
    do {
        result = find_wide_within(query, navmesh, request, radius, buffers, path_out);
    } while (path_out->status == TL_NAV_WIDE_OUT_OF_NODES && tl_nav_query_grow(query));
    return result;
}

tl_result tl_nav_query_find_wide_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                      const tl_nav_path_request *request, float agent_radius,
                                      tl_nav_corner *corners_out, uint32_t capacity, tl_nav_wide_path *path_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || path_out == NULL ||
        (corners_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_path_buffers buffers = { NULL, 0, corners_out, capacity };
    return find_wide(query, navmesh, request, agent_radius, &buffers, path_out);
}

tl_result tl_nav_query_is_wide_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_path_request *request, float agent_radius,
                                         tl_nav_wide_status *status_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || status_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_wide_path path;
    tl_result result = find_wide(query, navmesh, request, agent_radius, NULL, &path);
    *status_out = path.status;
    return result == TL_INCOMPLETE ? TL_OK : result;
}

const char *tl_nav_wide_status_name(tl_nav_wide_status status)
{
    static const char *const NAMES[] = { "none",         "complete",      "unreachable",
                                         "out of nodes", "start blocked", "goal blocked" };
    return (unsigned)status < TL_COUNT_OF(NAMES) ? NAMES[status] : "unknown";
}

// The nearest wall to the segment from a corner to the next, or `most`.
static bool segment_clearance(tl_nav_clearance *clearance, const tl_nav_corner *corners, uint32_t slot,
                              uint32_t polygon, double *min_sq)
{
    tl_nav_segment segment = { tl_nav_spot_of(corners[0].point), tl_nav_spot_of(corners[1].point) };
    tl_nav_near_walls near;
    tl_nav_scratch scratch = clearance->scratch;
    bool fits = tl_nav_find_walls_near_shape(clearance, slot, polygon, &segment.a, 2, sqrt(*min_sq), &near);
    clearance->scratch = scratch;
    for (uint32_t i = 0; fits && i < near.wall_count; i++) {
        *min_sq = fmin(*min_sq, tl_nav_segments_distance_sq(segment, tl_nav_segment_of_wall(&near.walls[i])));
    }
    return fits;
}

// Within the nodes that the query has now.
static tl_result path_clearance_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                       const tl_nav_corner *corners, uint32_t count, float max_distance,
                                       float *clearance_out)
{
    if (query == NULL || navmesh == NULL || corners == NULL || clearance_out == NULL ||
        !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    *clearance_out = 0.0f;
    if (!isfinite(max_distance)) {
        return TL_ERR_NOT_FINITE;
    }
    if (max_distance < 0.0f || count == 0) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_clearance clearance;
    tl_nav_clearance_begin(query, navmesh, filter, (double)max_distance, &clearance);
    double min_sq = (double)max_distance * (double)max_distance;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t slot = 0;
        uint32_t polygon = 0;
        const tl_nav_corner pair[2] = { corners[i], corners[i + 1 < count ? i + 1 : i] };
        if (!tl_nav_is_finite(corners[i].point)) {
            return TL_ERR_NOT_FINITE;
        }
        if (!tl_nav_split_ref(navmesh, corners[i].polygon, &slot, &polygon)) {
            return TL_ERR_STALE;
        }
        if (!segment_clearance(&clearance, pair, slot, polygon, &min_sq)) {
            return TL_ERR_NODES;
        }
    }
    *clearance_out = (float)sqrt(min_sq);
    return TL_OK;
}

tl_result tl_nav_query_path_clearance(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                      const tl_nav_corner *corners, uint32_t count, float max_distance,
                                      float *clearance_out)
{
    tl_result result;
    do {
        result = path_clearance_within(query, navmesh, filter, corners, count, max_distance, clearance_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
