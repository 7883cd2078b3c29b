// SPDX-License-Identifier: MIT
//
// Shorter corridors: by rays, and by a local search.
//
// Both look for another way to a point of the straight path, and take it where it is cheaper. The path behind that
// point stays as it is, so a corridor never gets longer. Detour takes whatever a ray has crossed, and whatever way a
// short search has found, without comparing costs.

#include "base/assert.h"
#include "math/tolerance.h"
#include "nav_query/corridor/corridor_path.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/path/funnel.h"

// How far a look goes. Stack: 12 KB for points, 2 KB for corners.
enum { MAX_AHEAD_CORNERS = 64, MAX_AHEAD_POINTS = 256, MAX_AHEAD_RAYS = 4 };

// The straight path up to the first link, with its crossings.
typedef struct path_ahead {
    tl_nav_corner corners[MAX_AHEAD_CORNERS];
    tl_nav_trace_point points[MAX_AHEAD_POINTS];
    uint32_t corner_count, count;
} path_ahead;

static tl_result look_ahead(const tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                            path_ahead *ahead)
{
    ahead->count = 0;
    tl_result result =
        tl_nav_corridor_corners(corridor, navmesh, ahead->corners, MAX_AHEAD_CORNERS, &ahead->corner_count);
    if (result != TL_OK && result != TL_INCOMPLETE) {
        return result;
    }
    uint32_t last = 1;
    while (last + 1 < ahead->corner_count && (ahead->corners[last].flags & TL_NAV_CORNER_LINK) == 0) {
        last++;
    }
    ahead->corner_count = last + 1;
    // Polygons up to the last corner's.
    uint32_t polygon_count = 1;
    while (polygon_count < corridor->count && corridor->path[polygon_count - 1] != ahead->corners[last].polygon) {
        polygon_count++;
    }
    const tl_nav_trace_request trace = { filter,         corridor->path,      polygon_count,
                                         ahead->corners, ahead->corner_count, TL_NAV_CORNER_CROSSING };
    result = tl_navmesh_trace_path(navmesh, &trace, ahead->points, MAX_AHEAD_POINTS, &ahead->count, NULL);
    ahead->count = ahead->count < MAX_AHEAD_POINTS ? ahead->count : MAX_AHEAD_POINTS;
    return result == TL_INCOMPLETE ? TL_OK : result;
}

// The place of a polygon in the corridor before its first link, or UINT32_MAX.
static uint32_t corridor_index_of(const tl_nav_corridor *corridor, tl_nav_ref polygon)
{
    uint32_t count = tl_nav_corridor_before_link(corridor);
    for (uint32_t i = count; i > 0; i--) {
        if (corridor->path[i - 1] == polygon) {
            return i - 1;
        }
    }
    return UINT32_MAX;
}

// Whether a cost is lower than another by more than the rounding of sums over so many pieces.
static bool is_cheaper(float cost, float than)
{
    return cost < than * (1.0f - TL_FLOAT_GAMMA(MAX_AHEAD_POINTS));
}

// Goes straight to a point of the path, if that is free and cheaper.
static tl_result try_sight(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                           const tl_nav_trace_point *to, bool *changed)
{
    tl_nav_ref polygons[TL_NAV_CORRIDOR_STEP];
    tl_nav_location from = { corridor->path[0], corridor->position };
    tl_nav_ray_hit hit;
    tl_result result = tl_navmesh_cast_ray(navmesh, filter, &from, to->point, polygons, TL_NAV_CORRIDOR_STEP, &hit);
    if (result != TL_OK || hit.hit) {
        return result == TL_INCOMPLETE ? TL_OK : result;
    }
    uint32_t place = corridor_index_of(corridor, hit.polygon);
    if (place == UINT32_MAX) {
        return TL_OK; // another polygon that shares the point
    }
    const tl_nav_corner ends[2] = { { corridor->position, from.polygon, TL_NAV_CORNER_START, TL_NAV_NO_REF },
                                    { to->point, hit.polygon, TL_NAV_CORNER_END, TL_NAV_NO_REF } };
    uint32_t count = 0;
    float cost = 0.0f;
    const tl_nav_trace_request trace = { filter, polygons, hit.polygon_count, ends, 2, 0 };
    result = tl_navmesh_trace_path(navmesh, &trace, NULL, 0, &count, &cost);
    if (result != TL_INCOMPLETE || !is_cheaper(cost, to->cost)) {
        return TL_OK;
    }
    tl_nav_corridor_replace(corridor, navmesh, polygons, hit.polygon_count, place + 1);
    *changed = true;
    return TL_OK;
}

tl_result tl_nav_corridor_shorten(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                  float range, bool *changed_out)
{
    bool changed = false;
    path_ahead ahead;
    if (corridor == NULL || navmesh == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    if (changed_out != NULL) {
        *changed_out = false;
    }
    TL_TRY(look_ahead(corridor, navmesh, filter, &ahead));
    // What lies before the first turn is seen already.
    uint32_t turn = 1;
    while (turn < ahead.count && (ahead.points[turn].flags & (TL_NAV_CORNER_LEFT | TL_NAV_CORNER_RIGHT)) == 0) {
        turn++;
    }
    uint32_t far_end = ahead.count;
    while (far_end > turn + 1 && ahead.points[far_end - 1].length > range) {
        far_end--;
    }
    for (uint32_t ray = 0; ray < MAX_AHEAD_RAYS && far_end > turn + 1 && !changed; ray++) {
        TL_TRY(try_sight(corridor, navmesh, filter, &ahead.points[far_end - 1], &changed));
        far_end = turn + 1 + (far_end - turn - 1) / 2;
    }
    if (changed_out != NULL) {
        *changed_out = changed;
    }
    return TL_OK;
}

// Searches a path within `max_steps`; `*count_out` 0: none was found, or none that fits.
static tl_result search_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                               uint32_t max_steps, tl_nav_ref polygons[TL_NAV_CORRIDOR_STEP], uint32_t *count_out)
{
    tl_nav_path_progress progress;
    tl_nav_path path;
    *count_out = 0;
    TL_TRY(tl_nav_query_begin_path(query, navmesh, request));
    TL_TRY(tl_nav_query_step_path(query, max_steps, &progress));
    if (progress.status == TL_NAV_PATH_COMPLETE &&
        tl_nav_query_write_path(query, polygons, TL_NAV_CORRIDOR_STEP, &path) == TL_OK) {
        *count_out = path.polygon_count;
    }
    return TL_OK;
}

static bool is_cheaper_way(const tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                           const tl_nav_ref *polygons, uint32_t polygon_count, const tl_nav_trace_point *to)
{
    tl_nav_corner corners[MAX_AHEAD_CORNERS];
    uint32_t corner_count = 0;
    uint32_t count = 0;
    float cost = 0.0f;
    const tl_nav_polygon_path path = { polygons, polygon_count, corridor->position, to->point };
    if (tl_navmesh_straight_path(navmesh, &path, corners, MAX_AHEAD_CORNERS, &corner_count, NULL) != TL_OK) {
        return false;
    }
    const tl_nav_trace_request trace = { filter, polygons, polygon_count, corners, corner_count, 0 };
    return tl_navmesh_trace_path(navmesh, &trace, NULL, 0, &count, &cost) == TL_INCOMPLETE &&
           is_cheaper(cost, to->cost);
}

tl_result tl_nav_corridor_improve(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                  const tl_nav_filter *filter, uint32_t ahead, uint32_t max_steps, bool *changed_out)
{
    path_ahead path;
    if (corridor == NULL || query == NULL || navmesh == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    if (changed_out != NULL) {
        *changed_out = false;
    }
    TL_TRY(look_ahead(corridor, navmesh, filter, &path));
    // The last point of the path that lies on the first `ahead` polygons and behind its begin.
    uint32_t to = path.count - 1;
    while (to > 0 && corridor_index_of(corridor, path.points[to].polygon) > ahead) {
        to--;
    }
    if (to == 0) {
        return TL_OK;
    }
    tl_nav_ref polygons[TL_NAV_CORRIDOR_STEP];
    uint32_t count = 0;
    const tl_nav_path_request request = { filter,
                                          { corridor->path[0], corridor->position },
                                          { path.points[to].polygon, path.points[to].point } };
    TL_TRY(search_within(query, navmesh, &request, max_steps, polygons, &count));
    if (count > 0 && is_cheaper_way(corridor, navmesh, filter, polygons, count, &path.points[to])) {
        tl_nav_corridor_replace(corridor, navmesh, polygons, count,
                                corridor_index_of(corridor, path.points[to].polygon) + 1);
        if (changed_out != NULL) {
            *changed_out = true;
        }
    }
    return TL_OK;
}
