// SPDX-License-Identifier: MIT
//
// Paths: searched when their turn comes, and checked after the navmesh has changed.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <talus/nav_wide.h>

#include <string.h>

enum { MAX_WIDE_CORNERS = 64 };

// A goal where a wide agent does not fit is moved to the nearest place where it does, at most so many radii.
#define WIDE_PLACE_RADII 16.0f

// A wide agent that has been told that its goal is unreachable, and asks again, shows within this time whether it gets
// nearer than it stands.
#define TRY_AGAIN 0.25f // seconds

static tl_vec3 relocate_extents(const tl_nav_crowd *crowd, uint32_t i)
{
    const float side = CROWD_RELOCATE_RADII * crowd->a.radius[i];
    return tl_vec3_make(side, crowd->a.height[i], side);
}

// The polygons under a wide path's lines: what a corridor is made of. Lines that cannot be followed end it.
static void follow_lines(const crowd_step *step, uint32_t i, const tl_nav_corner *corners, uint32_t count,
                         tl_nav_corridor *corridor)
{
    const tl_nav_filter *filter = &step->crowd->filters[step->crowd->a.filter[i]];
    uint32_t filled = 1;
    tl_nav_location at = { corridor->path[0], corridor->position };
    for (uint32_t k = 1; k < count && filled < corridor->capacity; k++) {
        if ((corners[k - 1].flags & TL_NAV_CORNER_LINK) != 0) {
            if (filled + 2 > corridor->capacity) {
                break;
            }
            corridor->path[filled++] = corners[k - 1].link;
            corridor->path[filled++] = corners[k].polygon;
        } else {
            // The first polygon stands there already: it is written again.
            tl_nav_ray_hit hit;
            tl_result result = tl_navmesh_cast_ray(step->navmesh, filter, &at, corners[k].point,
                                                   corridor->path + filled - 1, corridor->capacity - filled + 1, &hit);
            if (result != TL_OK && result != TL_INCOMPLETE) {
                break;
            }
            filled = tl_min_u32(filled - 1 + hit.polygon_count, corridor->capacity);
        }
        at.polygon = corridor->path[filled - 1];
        at.point = corners[k].point;
        corridor->target = at.point;
        corridor->reaches = k + 1 == count && (corners[k].flags & TL_NAV_CORNER_END) != 0;
    }
    corridor->count = filled;
    if (!corridor->reaches || corridor->count == corridor->capacity) {
        corridor->reaches = false;
        tl_vec3 nearest;
        if (tl_navmesh_closest_point(step->navmesh, corridor->path[filled - 1], corridor->target, &nearest, NULL) ==
            TL_OK) {
            corridor->target = nearest;
        }
    }
}

static tl_nav_wide_status find_wide_corridor(const crowd_step *step, uint32_t i, const tl_nav_location *goal,
                                             tl_nav_query *query, tl_nav_corridor *corridor)
{
    const crowd_fields *a = &step->crowd->a;
    const tl_nav_path_request request = { &step->crowd->filters[a->filter[i]],
                                          { corridor->path[0], corridor->position },
                                          *goal };
    tl_nav_corner corners[MAX_WIDE_CORNERS];
    tl_nav_wide_path path;
    tl_result result =
        tl_nav_query_find_wide_path(query, step->navmesh, &request, a->radius[i], corners, MAX_WIDE_CORNERS, &path);
    if (result != TL_OK && result != TL_INCOMPLETE) {
        return TL_NAV_WIDE_START_BLOCKED; // links and filters: the plain path may lead on
    }
    if (path.status == TL_NAV_WIDE_COMPLETE) {
        follow_lines(step, i, corners, tl_min_u32(path.corner_count, MAX_WIDE_CORNERS), corridor);
    }
    return path.status;
}

// Ends a corridor that leads all the way somewhere else than to its goal. One that was cut off is searched on first.
static tl_nav_path_status end_elsewhere(tl_nav_corridor *corridor)
{
    const bool is_whole = corridor->reaches;
    corridor->reaches = false;
    return is_whole ? TL_NAV_PATH_UNREACHABLE : TL_NAV_PATH_COMPLETE;
}

// UNREACHABLE: the corridor ends as near to the goal as a path leads. COMPLETE: it leads there, or is cut off before.
static tl_result find_plain_path(const crowd_step *step, uint32_t i, const tl_nav_location *goal, tl_nav_query *query,
                                 tl_nav_corridor *corridor, tl_nav_path_status *status_out)
{
    const tl_nav_crowd *crowd = step->crowd;
    tl_nav_path path;
    const tl_result result =
        tl_nav_corridor_find(corridor, query, step->navmesh, &crowd->filters[crowd->a.filter[i]], goal, &path);
    const bool is_cut = path.polygon_count > corridor->capacity && path.status == TL_NAV_PATH_UNREACHABLE;
    *status_out = is_cut ? TL_NAV_PATH_COMPLETE : path.status;
    return result;
}

// For an agent wider than the mesh's. Where it fits not near its goal, nowhere on the way, or not where it stands, it
// takes the plain path, and its clearance holds it where that is too narrow (hold_at_wall).
static tl_result find_wide_path(const crowd_step *step, uint32_t i, const tl_nav_location *goal, tl_nav_query *query,
                                tl_nav_corridor *corridor, tl_nav_path_status *status_out)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const tl_nav_around_request around = { &crowd->filters[a->filter[i]], *goal, WIDE_PLACE_RADII * a->radius[i] };
    const bool is_held = a->stalled[i] > CROWD_HELD_AFTER;
    tl_nav_location place = *goal;
    tl_nav_wide_status status = find_wide_corridor(step, i, goal, query, corridor);
    if (status == TL_NAV_WIDE_GOAL_BLOCKED &&
        tl_nav_query_find_wide_place(query, step->navmesh, &around, a->radius[i], &place) == TL_OK) {
        status = find_wide_corridor(step, i, &place, query, corridor);
    }
    if (status == TL_NAV_WIDE_COMPLETE) {
        const float x = place.point.x - goal->point.x, z = place.point.z - goal->point.z;
        const bool is_near = sqrtf(x * x + z * z) <= tl_crowd_kept_off_reach(a, i);
        *status_out = is_near ? TL_NAV_PATH_COMPLETE : end_elsewhere(corridor);
        return TL_OK;
    }
    const tl_result result = find_plain_path(step, i, goal, query, corridor, status_out);
    if (*status_out == TL_NAV_PATH_COMPLETE && status == TL_NAV_WIDE_OUT_OF_NODES) {
        *status_out = TL_NAV_PATH_OUT_OF_NODES;
    } else if (*status_out == TL_NAV_PATH_COMPLETE && (corridor->reaches || is_held)) {
        corridor->reaches = corridor->reaches && status == TL_NAV_WIDE_START_BLOCKED;
        *status_out = TL_NAV_PATH_UNREACHABLE;
    }
    return result;
}

// A goal on an island that the agent is not on: the point nearest to it on its own.
static bool find_nearest_reachable(const crowd_step *step, uint32_t i, tl_nav_location *goal)
{
    const tl_nav_crowd *crowd = step->crowd;
    const tl_nav_ref here = crowd->a.path[(size_t)i * crowd->def.max_path];
    uint32_t from = 0, to = 0;
    if (tl_navmesh_island(step->navmesh, here, &from) != TL_OK ||
        tl_navmesh_island(step->navmesh, goal->polygon, &to) != TL_OK || from == to) {
        return false;
    }
    return tl_navmesh_find_nearest_reachable(step->navmesh, &crowd->filters[crowd->a.filter[i]], here, goal->point,
                                             goal) == TL_OK;
}

void tl_crowd_begin_path(tl_nav_crowd *crowd, uint32_t i, const tl_nav_corridor *corridor, bool is_partial,
                         bool gave_up)
{
    crowd_fields *a = &crowd->a;
    tl_crowd_keep_corridor(crowd, i, corridor);
    a->flags[i] &= ~(CROWD_PARTIAL | CROWD_GAVE_UP | CROWD_NEED_PATH | CROWD_ASK_LATER);
    a->flags[i] |= is_partial ? CROWD_PARTIAL : gave_up ? CROWD_GAVE_UP : 0;
    a->status[i] = TL_NAV_AGENT_WALKING;
    a->link[i] = TL_NAV_NO_REF;
    a->stalled[i] = 0.0f;
}

// Where an agent's goal is now: on the polygon that it was given, or, where that went, on the nearest. False: nowhere.
static bool find_goal(const crowd_step *step, uint32_t i, tl_nav_location *goal_out)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    goal_out->polygon = a->goal_polygon[i];
    goal_out->point = tl_crowd_get3(a->goal, i);
    return tl_navmesh_resolve(step->navmesh, goal_out->polygon, NULL, NULL) == TL_OK ||
           tl_navmesh_find_nearest(step->navmesh, &crowd->filters[a->filter[i]], goal_out->point,
                                   relocate_extents(crowd, i), goal_out) == TL_OK;
}

void tl_crowd_search_path(const crowd_step *step, uint32_t i, tl_nav_query *query)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    tl_nav_location goal;
    a->flags[i] &= ~(CROWD_PARTIAL | CROWD_GAVE_UP | CROWD_NEED_PATH | CROWD_ASK_LATER);
    if (!find_goal(step, i, &goal)) {
        // There is no goal now: it stands until there is.
        a->flags[i] |= CROWD_PARTIAL;
        tl_nav_location here = { a->path[(size_t)i * crowd->def.max_path], tl_crowd_position(crowd, i) };
        tl_crowd_reset_corridor(crowd, i, &here);
        a->status[i] = TL_NAV_AGENT_UNREACHABLE;
        return;
    }
    const bool is_elsewhere = find_nearest_reachable(step, i, &goal);
    const bool is_wide = a->clearance[i] > 0.0f, was_unreachable = a->status[i] == TL_NAV_AGENT_UNREACHABLE;
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    tl_nav_path_status status = TL_NAV_PATH_NONE;
    if ((is_wide ? find_wide_path : find_plain_path)(step, i, &goal, query, &corridor, &status) != TL_OK) {
        // Its own polygon is stale, which the next check finds, or the filter's function refuses costs.
        a->flags[i] |= CROWD_PARTIAL;
        a->status[i] = TL_NAV_AGENT_UNREACHABLE;
        return;
    }
    if (is_elsewhere) {
        status = status == TL_NAV_PATH_COMPLETE ? end_elsewhere(&corridor) : status;
        corridor.reaches = false;
    }
    const bool is_partial = status == TL_NAV_PATH_UNREACHABLE;
    tl_crowd_begin_path(crowd, i, &corridor, is_partial, status != TL_NAV_PATH_COMPLETE);
    if (is_wide && is_partial && was_unreachable) {
        a->stalled[i] = CROWD_HELD_AFTER - TRY_AGAIN;
    }
}

// What is left of a corridor from which an edit took polygons: the agent walks on along it until its search's turn
// comes.
static void cut_corridor(const crowd_step *step, uint32_t i, uint32_t left)
{
    const crowd_fields *a = &step->crowd->a;
    const tl_nav_ref last = a->path[(size_t)i * step->crowd->def.max_path + left - 1];
    tl_vec3 end;
    if (tl_navmesh_closest_point(step->navmesh, last, tl_crowd_get3(a->target, i), &end, NULL) == TL_OK) {
        a->path_count[i] = left;
        a->flags[i] &= ~CROWD_REACHES;
        tl_crowd_set3(a->target, i, end);
    }
}

// Whether no path led to the goal before an edit, and none does now: there is no goal, or it is on another island. For
// a wide agent only a search tells: it is taken for shut off until its turn comes.
static bool is_still_shut_off(const crowd_step *step, uint32_t i)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    if ((a->flags[i] & CROWD_PARTIAL) == 0) {
        return false;
    }
    tl_nav_location goal;
    if (a->clearance[i] > 0.0f || !find_goal(step, i, &goal)) {
        return true;
    }
    uint32_t from = 0, to = 0;
    return tl_navmesh_island(step->navmesh, a->path[(size_t)i * crowd->def.max_path], &from) == TL_OK &&
           tl_navmesh_island(step->navmesh, goal.polygon, &to) == TL_OK && from != to;
}

void tl_crowd_revalidate(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    const uint32_t status = a->status[i];
    if (status == CROWD_FREE || status == TL_NAV_AGENT_FIXED) {
        return;
    }
    const tl_nav_filter *filter = &crowd->filters[a->filter[i]];
    const bool is_on_link = status == TL_NAV_AGENT_ON_LINK;
    tl_nav_ref here = a->path[(size_t)i * crowd->def.max_path];
    a->flags[i] &= ~CROWD_CORNER;
    if (!is_on_link) {
        a->wall_slack[i] = -1.0f;
    }
    if (status == TL_NAV_AGENT_OFF_MESH || tl_navmesh_resolve(step->navmesh, here, NULL, NULL) != TL_OK) {
        if (is_on_link) {
            return; // looked at when it lands
        }
        tl_nav_location at;
        if (tl_navmesh_find_nearest(step->navmesh, filter, tl_crowd_position(crowd, i), relocate_extents(crowd, i),
                                    &at) != TL_OK) {
            a->status[i] = TL_NAV_AGENT_OFF_MESH;
            a->vx[i] = 0.0f;
            a->vz[i] = 0.0f;
            a->wanted_x[i] = 0.0f;
            a->wanted_z[i] = 0.0f;
            return;
        }
        tl_crowd_reset_corridor(crowd, i, &at);
        a->clearance[i] = tl_crowd_clearance(step->navmesh, at.polygon, a->radius[i]);
        a->status[i] = (a->flags[i] & CROWD_HAS_GOAL) != 0 ? TL_NAV_AGENT_WAITING : TL_NAV_AGENT_IDLE;
        a->link[i] = TL_NAV_NO_REF;
        a->flags[i] |= (a->flags[i] & CROWD_HAS_GOAL) != 0 ? CROWD_NEED_PATH : 0;
        return;
    }
    if ((a->flags[i] & CROWD_HAS_GOAL) == 0) {
        return;
    }
    // Whoever has arrived stays; whoever could not get to its goal, or not whole, tries again. Who is shut off as
    // before may get nearer at most, and takes its time: else each edit would fill the queue with those.
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    const uint32_t left = tl_nav_corridor_check(&corridor, step->navmesh, filter, UINT32_MAX);
    const bool is_broken = left < corridor.count;
    const bool is_short = (a->flags[i] & (CROWD_PARTIAL | CROWD_GAVE_UP)) != 0;
    if (status != TL_NAV_AGENT_ARRIVED && (is_broken || is_short)) {
        a->flags[i] |= !is_broken && is_still_shut_off(step, i) ? CROWD_ASK_LATER : CROWD_NEED_PATH;
    }
    if (status == TL_NAV_AGENT_WALKING && is_broken && left > 0) {
        cut_corridor(step, i, left);
    }
}
