// SPDX-License-Identifier: MIT
//
// Follows a straight path polygon by polygon: where it crosses from one into the next, and what it costs.
//
// Corners say in which polygon the path continues, so each portal belongs to one leg, and where the leg's line meets
// the portal's needs no search. A portal that contains a corner is crossed there.

#include "base/assert.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/offmesh.h"
#include "nav_query/path/funnel.h"
#include "nav_query/plane/side.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/portal_between.h"

#include <string.h>

typedef struct path_trace {
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    const tl_nav_ref *polygons;
    uint32_t polygon_count;
    uint32_t keep; // flags of crossings that are written
    uint32_t at;   // in polygons: where the path is
    tl_vec3 point;
    double cost, length;
    tl_nav_trace_point *points;
    uint32_t capacity, count;
    tl_nav_trace_point last; // written
} path_trace;

// Writes a point; one in the place of the point before it becomes part of that.
static void write_trace_point(path_trace *trace, uint32_t flags)
{
    bool joins = trace->count > 0 && tl_nav_is_same_place(trace->point, trace->last.point) &&
                 (trace->last.flags & TL_NAV_CORNER_LINK) == 0;
    trace->count += joins ? 0 : 1;
    trace->last.flags = flags | (joins ? trace->last.flags : 0);
    trace->last.point = trace->point;
    trace->last.polygon = trace->polygons[trace->at];
    trace->last.cost = (float)trace->cost;
    trace->last.length = (float)trace->length;
    if (trace->count <= trace->capacity) {
        trace->points[trace->count - 1] = trace->last;
    }
}

// Goes straight to a point of the current polygon. At a seam, edges may have two heights in one place; the first stays.
static tl_result go_to(path_trace *trace, tl_vec3 point)
{
    if (tl_nav_is_same_place(trace->point, point)) {
        return TL_OK;
    }
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_split_ref(trace->navmesh, trace->polygons[trace->at], &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    const tl_nav_tile *tile = trace->navmesh->slots[slot].tile;
    trace->cost += (double)tl_nav_cost_between(trace->filter, tile, polygon, trace->point, point);
    trace->length += (double)tl_distance(trace->point, point);
    trace->point = point;
    return TL_OK;
}

// Where the leg from a to b crosses a portal; on the portal, whatever rounding says.
static tl_vec3 leg_crossing(tl_vec3 a, tl_vec3 b, tl_vec3 left, tl_vec3 right)
{
    double of_right = tl_nav_turn(a, b, right);
    double of_left = tl_nav_turn(a, b, left);
    if (of_right == of_left) {
        return tl_nav_closest_on_edge(right, left, a);
    }
    double t = of_right / (of_right - of_left);
    return !(t > 0.0) ? right : t >= 1.0 ? left : tl_lerp(right, left, (float)t);
}

// Crosses into the next polygon on the leg from a to b.
static tl_result trace_portal(path_trace *trace, tl_vec3 a, tl_vec3 b)
{
    const tl_nav_ref *from = &trace->polygons[trace->at];
    uint32_t slots[2], polygons[2];
    tl_vec3 left, right;
    if (trace->at + 1 >= trace->polygon_count || tl_nav_is_offmesh(from[1])) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(trace->navmesh, from[0], &slots[0], &polygons[0]) ||
        !tl_nav_split_ref(trace->navmesh, from[1], &slots[1], &polygons[1])) {
        return TL_ERR_STALE;
    }
    if (!tl_nav_portal_between(trace->navmesh, from[0], slots[1], polygons[1], &left, &right)) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(go_to(trace, leg_crossing(a, b, left, right)));
    trace->at++;
    uint8_t areas[2] = { tl_nav_tile_area(trace->navmesh->slots[slots[0]].tile, polygons[0]),
                         tl_nav_tile_area(trace->navmesh->slots[slots[1]].tile, polygons[1]) };
    uint32_t flags = TL_NAV_CORNER_CROSSING | (areas[0] != areas[1] ? TL_NAV_CORNER_AREA : 0);
    if ((flags & trace->keep) != 0) {
        write_trace_point(trace, flags);
    }
    return TL_OK;
}

// From a corner to the next one, over polygons or by a link.
static tl_result follow(path_trace *trace, const tl_nav_corner *from, const tl_nav_corner *to, bool is_last)
{
    if ((from->flags & TL_NAV_CORNER_LINK) != 0) {
        const tl_nav_offmesh_entry *link = tl_nav_find_offmesh(&trace->navmesh->offmesh, from->link);
        if (link == NULL) {
            return TL_ERR_STALE;
        }
        if (trace->at + 2 >= trace->polygon_count || trace->polygons[trace->at + 1] != from->link) {
            return TL_ERR_ARGUMENT;
        }
        float factor = trace->filter != NULL ? trace->filter->area_cost[link->offmesh.area] : 1.0f;
        trace->cost += (double)factor * link->cost;
        trace->length += (double)tl_distance(from->point, to->point);
        trace->at += 2;
        trace->point = to->point;
        return TL_OK;
    }
    while (is_last ? trace->at + 1 < trace->polygon_count : trace->polygons[trace->at] != to->polygon) {
        TL_TRY(trace_portal(trace, from->point, to->point));
    }
    return go_to(trace, to->point);
}

tl_result tl_navmesh_trace_path(const tl_navmesh *navmesh, const tl_nav_trace_request *request,
                                tl_nav_trace_point *points_out, uint32_t capacity, uint32_t *count_out, float *cost_out)
{
    if (navmesh == NULL || request == NULL || count_out == NULL || (points_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (cost_out != NULL) {
        *cost_out = 0.0f;
    }
    if (!tl_nav_filter_is_begun(request->filter) || request->polygons == NULL || request->polygon_count == 0 ||
        request->corners == NULL || request->corner_count < 2) {
        return TL_ERR_ARGUMENT;
    }
    path_trace trace;
    memset(&trace, 0, sizeof trace);
    trace.navmesh = navmesh;
    trace.filter = request->filter;
    trace.polygons = request->polygons;
    trace.polygon_count = request->polygon_count;
    trace.keep = request->keep;
    trace.points = points_out;
    trace.capacity = capacity;
    const tl_nav_corner *corners = request->corners;
    trace.point = corners[0].point;
    write_trace_point(&trace, corners[0].flags);
    for (uint32_t i = 1; i < request->corner_count; i++) {
        TL_TRY(follow(&trace, &corners[i - 1], &corners[i], i + 1 == request->corner_count));
        write_trace_point(&trace, corners[i].flags);
    }
    *count_out = trace.count;
    if (cost_out != NULL) {
        *cost_out = (float)trace.cost;
    }
    return trace.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
