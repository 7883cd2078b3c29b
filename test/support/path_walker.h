// SPDX-License-Identifier: MIT
//
// A character that follows paths of a navmesh physically: it walks at the next corner, and asks anew from where it is
// when it gets no nearer.

#ifndef TALUS_TEST_PATH_WALKER_H
#define TALUS_TEST_PATH_WALKER_H

#include <math.h>
#include <string.h>
#include <talus/character.h>
#include <talus/nav_query.h>

enum { WALKER_POLYGONS = 4096, WALKER_CORNERS = 1024, WALKER_PATIENCE = 60, WALKER_ROUTES = 40 };

#define WALKER_TICK 0.016666668f

typedef enum walker_state { WALKER_WALKS, WALKER_ARRIVED, WALKER_GAVE_UP, WALKER_FELL } walker_state;

typedef struct path_walker {
    const tl_navmesh *navmesh;
    tl_nav_query *query;
    tl_character_mover *mover;
    tl_character_level level;
    tl_character character;
    tl_vec3 goal;
    float speed, floor; ///< metres a second; below `floor` it has fallen out of the level
    tl_nav_ref polygons[WALKER_POLYGONS];
    tl_nav_corner corners[WALKER_CORNERS];
    uint32_t corner_count, next;
    uint32_t routes;       ///< asked so far: 1 when nothing was in the way
    float nearest;         ///< to the next corner
    uint32_t without_gain; ///< ticks
    tl_character_report report;
} path_walker;

static inline float walker_flat_distance(tl_vec3 a, tl_vec3 b)
{
    return sqrtf((a.x - b.x) * (a.x - b.x) + (a.z - b.z) * (a.z - b.z));
}

/// False: there is no complete path from here.
static inline bool walker_ask(path_walker *w)
{
    tl_nav_path_buffers buffers = { w->polygons, WALKER_POLYGONS, w->corners, WALKER_CORNERS };
    tl_nav_route_request request;
    tl_nav_route route;
    memset(&request, 0, sizeof request);
    request.start = w->character.position;
    request.goal = w->goal;
    request.half_extents = tl_vec3_make(1, 2, 1);
    tl_result result = tl_nav_query_find_route(w->query, w->navmesh, &request, &buffers, &route);
    w->routes++;
    w->next = 0;
    w->nearest = INFINITY;
    w->without_gain = 0;
    w->corner_count = route.corner_count;
    return result == TL_OK && route.path.status == TL_NAV_PATH_COMPLETE;
}

/// One tick.
static inline walker_state walker_tick(path_walker *w)
{
    tl_character *c = &w->character;
    while (w->next < w->corner_count && walker_flat_distance(c->position, w->corners[w->next].point) < 0.05f) {
        w->next++;
        w->nearest = INFINITY;
    }
    if (w->next >= w->corner_count && c->grounded != 0) {
        return WALKER_ARRIVED;
    }
    tl_vec3 to = w->next < w->corner_count ? tl_sub(w->corners[w->next].point, c->position) : tl_vec3_make(0, 0, 0);
    to.y = 0;
    float distance = tl_length(to), speed = fminf(w->speed, distance / WALKER_TICK);
    tl_character_step step = { distance > 0 ? tl_scale(to, speed / distance) : to, WALKER_TICK, false };
    step.velocity.y = c->grounded != 0 ? 0 : c->velocity.y - 9.81f * WALKER_TICK;
    if (tl_character_move(w->mover, &w->level, &step, c, &w->report) != TL_OK) {
        return WALKER_GAVE_UP;
    }
    if (c->position.y < w->floor) {
        return WALKER_FELL;
    }
    w->without_gain = distance < w->nearest - 0.01f ? 0 : w->without_gain + 1;
    w->nearest = distance < w->nearest - 0.01f ? distance : w->nearest;
    if (w->without_gain > WALKER_PATIENCE && (w->routes >= WALKER_ROUTES || !walker_ask(w))) {
        return WALKER_GAVE_UP;
    }
    return WALKER_WALKS;
}

#endif
