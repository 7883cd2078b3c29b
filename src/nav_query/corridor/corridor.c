// SPDX-License-Identifier: MIT
//
// Corridors: a path that follows its agent.
//
// A move reports the polygons that it crossed. Behind the last polygon that the corridor and the move share, the
// corridor stays as it was; before it, it becomes the way back over the polygons of the move. So a step forward drops
// polygons, a step aside adds them, and nothing is searched. The target's end is updated in the same way. Source: Mikko
// Mononen, Detour, dtPathCorridor, for the idea.

#include "nav_query/corridor/corridor_path.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "math/tolerance.h"
#include "nav_query/path/funnel.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/portal_between.h"

#include <string.h>

tl_nav_corridor tl_nav_corridor_init(tl_nav_ref *path, uint32_t capacity)
{
    tl_nav_corridor corridor;
    memset(&corridor, 0, sizeof corridor);
    corridor.path = path;
    corridor.capacity = capacity;
    return corridor;
}

void tl_nav_corridor_reset(tl_nav_corridor *corridor, const tl_nav_location *at)
{
    TL_ASSERT(corridor != NULL && corridor->capacity > 0 && at != NULL);
    corridor->path[0] = at->polygon;
    corridor->count = 1;
    corridor->position = at->point;
    corridor->target = at->point;
    corridor->goal = at->point;
    corridor->reaches = true;
}

// Ends the corridor after `count` entries, or before: not in a link. The target is then that polygon's point nearest to
// the goal.
static void cut_off(tl_nav_corridor *corridor, const tl_navmesh *navmesh, uint32_t count)
{
    corridor->count = count;
    while (corridor->count > 1 && tl_nav_is_offmesh(corridor->path[corridor->count - 1])) {
        corridor->count--;
    }
    corridor->reaches = false;
    tl_vec3 nearest;
    tl_nav_ref last = corridor->path[corridor->count - 1];
    // A stale polygon has no points: the corridor ends where the agent is, until it is repaired.
    bool exists = tl_navmesh_closest_point(navmesh, last, corridor->goal, &nearest, NULL) == TL_OK;
    corridor->target = exists ? nearest : corridor->position;
}

void tl_nav_corridor_replace(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_ref *entries,
                             uint32_t count, uint32_t replaced)
{
    uint32_t kept = corridor->count - replaced;
    uint32_t begin = count < corridor->capacity ? count : corridor->capacity;
    uint32_t fits = kept < corridor->capacity - begin ? kept : corridor->capacity - begin;
    memmove(corridor->path + begin, corridor->path + replaced, fits * sizeof *corridor->path);
    if (begin > 0) {
        memcpy(corridor->path, entries, begin * sizeof *corridor->path);
    }
    corridor->count = begin + fits;
    if (begin < count || fits < kept) {
        cut_off(corridor, navmesh, corridor->count);
    }
}

uint32_t tl_nav_corridor_before_link(const tl_nav_corridor *corridor)
{
    uint32_t count = 0;
    while (count < corridor->count && !tl_nav_is_offmesh(corridor->path[count])) {
        count++;
    }
    return count;
}

tl_result tl_nav_corridor_find(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                               const tl_nav_filter *filter, const tl_nav_location *goal, tl_nav_path *path_out)
{
    if (corridor == NULL || goal == NULL || path_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    if (corridor->count == 0) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_path_request request = { filter, { corridor->path[0], corridor->position }, *goal };
    tl_result result = tl_nav_query_find_path(query, navmesh, &request, corridor->path, corridor->capacity, path_out);
    if (result != TL_OK && result != TL_INCOMPLETE) {
        return result;
    }
    corridor->goal = goal->point;
    corridor->target = path_out->end.point;
    corridor->reaches = path_out->status == TL_NAV_PATH_COMPLETE;
    corridor->count = path_out->polygon_count;
    if (result == TL_INCOMPLETE) {
        cut_off(corridor, navmesh, corridor->capacity);
    }
    return TL_OK;
}

tl_result tl_nav_corridor_set_path(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_ref *path,
                                   uint32_t count, tl_vec3 target)
{
    if (corridor == NULL || navmesh == NULL || path == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(target)) {
        return TL_ERR_NOT_FINITE;
    }
    if (count == 0 || corridor->count == 0 || path[0] != corridor->path[0]) {
        return TL_ERR_ARGUMENT;
    }
    corridor->target = target;
    corridor->goal = target;
    corridor->reaches = true;
    tl_nav_corridor_replace(corridor, navmesh, path, count, corridor->count);
    return TL_OK;
}

tl_result tl_nav_corridor_corners(const tl_nav_corridor *corridor, const tl_navmesh *navmesh,
                                  tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out)
{
    if (corridor == NULL || navmesh == NULL || count_out == NULL || (corners_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_polygon_path path = { corridor->path, corridor->count, corridor->position, corridor->target };
    return tl_nav_first_corners(navmesh, &path, corners_out, capacity, count_out);
}

// The move of one of the corridor's ends: the polygons that it went through, and where it ended on the surface.
typedef struct end_move {
    tl_nav_ref polygons[TL_NAV_CORRIDOR_STEP];
    uint32_t polygon_count;
    tl_vec3 point;
} end_move;

static tl_result move_end(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_move_request *request,
                          end_move *out)
{
    tl_nav_move move;
    tl_result result =
        tl_nav_query_move_along_surface(query, navmesh, request, out->polygons, TL_NAV_CORRIDOR_STEP, &move);
    if (result != TL_OK) {
        return result == TL_INCOMPLETE ? TL_ERR_LIMIT : result;
    }
    out->polygon_count = move.polygon_count;
    out->point = move.end.point;
    return tl_navmesh_height(navmesh, move.end.polygon, move.end.point.x, move.end.point.z, &out->point.y);
}

// A coordinate of a position on a portal and those of its ends are rounded to float: as a share of the largest one.
#define ON_PORTAL_ERROR ((double)TL_FLOAT_GAMMA(6))

static bool lies_on_portal(tl_vec3 point, tl_vec3 left, tl_vec3 right)
{
    tl_vec3 nearest = tl_nav_closest_on_edge(right, left, point);
    double x = (double)nearest.x - (double)point.x;
    double z = (double)nearest.z - (double)point.z;
    double size = fabs((double)point.x) + fabs((double)point.z);
    return fabs(x) + fabs(z) <= ON_PORTAL_ERROR * size;
}

// The last polygon that the corridor enters in the very place where the agent stands. Where the way goes along the edge
// of a polygon that it has left, as beside a ramp, a move from that polygon would stay in it.
static uint32_t entered(const tl_nav_corridor *corridor, const tl_navmesh *navmesh)
{
    uint32_t at = 0;
    uint32_t slot = 0;
    uint32_t polygon = 0;
    tl_vec3 left, right;
    while (at + 1 < corridor->count && tl_nav_split_ref(navmesh, corridor->path[at + 1], &slot, &polygon) &&
           tl_nav_portal_between(navmesh, corridor->path[at], slot, polygon, &left, &right) &&
           lies_on_portal(corridor->position, left, right)) {
        at++;
    }
    return at;
}

tl_result tl_nav_corridor_move(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                               const tl_nav_filter *filter, tl_vec3 to)
{
    end_move move;
    tl_nav_ref back[TL_NAV_CORRIDOR_STEP];
    if (corridor == NULL || navmesh == NULL || corridor->count == 0) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t begin = entered(corridor, navmesh);
    const tl_nav_move_request request = { filter, { corridor->path[begin], corridor->position }, to };
    TL_TRY(move_end(query, navmesh, &request, &move));
    // Where the move and the corridor meet last: at their common begin if nowhere else.
    uint32_t last_in_path = begin;
    uint32_t last_in_move = 0;
    for (uint32_t i = begin; i < corridor->count; i++) {
        for (uint32_t k = 0; k < move.polygon_count; k++) {
            if (corridor->path[i] == move.polygons[k]) {
                last_in_path = i;
                last_in_move = k;
            }
        }
    }
    uint32_t back_count = 0;
    for (uint32_t k = move.polygon_count; k > last_in_move; k--) {
        back[back_count++] = move.polygons[k - 1];
    }
    corridor->position = move.point;
    tl_nav_corridor_replace(corridor, navmesh, back, back_count, last_in_path + 1);
    return TL_OK;
}

tl_result tl_nav_corridor_move_target(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                      const tl_nav_filter *filter, tl_vec3 to)
{
    end_move move;
    if (corridor == NULL || navmesh == NULL || corridor->count == 0) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_move_request request = { filter, { corridor->path[corridor->count - 1], corridor->target }, to };
    TL_TRY(move_end(query, navmesh, &request, &move));
    uint32_t first_in_path = corridor->count - 1;
    uint32_t last_in_move = 0;
    for (uint32_t i = corridor->count; i > 0; i--) {
        for (uint32_t k = 0; k < move.polygon_count; k++) {
            if (corridor->path[i - 1] == move.polygons[k]) {
                first_in_path = i - 1;
                last_in_move = k;
            }
        }
    }
    uint32_t added = move.polygon_count - 1 - last_in_move;
    uint32_t fits = tl_min_u32(added, corridor->capacity - (first_in_path + 1));
    memcpy(corridor->path + first_in_path + 1, move.polygons + last_in_move + 1, fits * sizeof *corridor->path);
    corridor->count = first_in_path + 1 + fits;
    corridor->target = move.point;
    corridor->goal = move.point;
    if (fits < added) {
        cut_off(corridor, navmesh, corridor->count);
    }
    return TL_OK;
}

tl_result tl_nav_corridor_pass_link(tl_nav_corridor *corridor, const tl_navmesh *navmesh, tl_nav_location ends_out[2],
                                    tl_nav_ref *link_out)
{
    if (corridor == NULL || navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t at = tl_nav_corridor_before_link(corridor);
    tl_vec3 ends[2];
    if (at == 0 || at + 1 >= corridor->count) {
        return TL_NOT_FOUND;
    }
    if (tl_nav_find_link(navmesh, &corridor->path[at - 1], ends) != TL_OK) {
        return TL_ERR_STALE;
    }
    for (int i = 0; i < 2 && ends_out != NULL; i++) {
        ends_out[i].polygon = corridor->path[i == 0 ? at - 1 : at + 1];
        ends_out[i].point = ends[i];
    }
    if (link_out != NULL) {
        *link_out = corridor->path[at];
    }
    corridor->position = ends[1];
    tl_nav_corridor_replace(corridor, navmesh, NULL, 0, at + 1);
    return TL_OK;
}
