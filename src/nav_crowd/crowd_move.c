// SPDX-License-Identifier: MIT
//
// The move: along the surface, sliding along walls, so that no velocity leads off the mesh.
//
// Most steps end in the polygon in which they begin, and are done after one test of it; the others move the corridor's
// begin. A wide agent's step is cut first where it would come nearer to a wall than it may: velocities avoid that
// already, but where neighbours press, and where walls turn between two steps, this is what holds.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <math.h>

// The part of the clearance that a wide agent keeps in any case: what wide paths keep, whose circles are 32 chords.
#define KEPT_CLEARANCE 0.995f

// The share of its top speed below which an agent that wants to stand does: ORCA's answers in a standing throng. Who
// makes way for others wants to move: in a throng there is often room for less than that.
#define STANDING_SHARE 0.05f

enum { MAX_CUTS = 6 };

// An agent that pushes against walls comes that near to them, as a share of its radius.
#define WALL_TOUCH_SHARE 0.1f

static float distance_sq_to(const float segment[4], float x, float z)
{
    float wx = segment[2] - segment[0], wz = segment[3] - segment[1];
    float length_sq = wx * wx + wz * wz;
    float t = length_sq > 0.0f ? ((x - segment[0]) * wx + (z - segment[1]) * wz) / length_sq : 0.0f;
    t = tl_clamp_f32(t, 0.0f, 1.0f);
    float dx = segment[0] + t * wx - x, dz = segment[1] + t * wz - z;
    return dx * dx + dz * dz;
}

bool tl_crowd_touches_wall(const crowd_fields *a, uint32_t i)
{
    const float near = a->clearance[i] + WALL_TOUCH_SHARE * a->radius[i];
    bool touches = false;
    for (uint32_t k = 0; k < a->wall_count[i]; k++) {
        const float *wall = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS + 4 * k];
        touches = touches || distance_sq_to(wall, a->x[i], a->z[i]) <= near * near;
    }
    return touches;
}

// Whether the step to a point keeps the clearance, or comes no nearer to the walls that it is too near to already. The
// nearest points of two segments that do not cross are an end of one and a point of the other.
static bool keeps_clearance(const tl_nav_crowd *crowd, uint32_t i, float x, float z)
{
    const crowd_fields *a = &crowd->a;
    const float kept = KEPT_CLEARANCE * a->clearance[i];
    const float way[4] = { a->x[i], a->z[i], x, z };
    for (uint32_t k = 0; k < a->wall_count[i]; k++) {
        const float *wall = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS + 4 * k];
        float nearest = tl_min_f32(distance_sq_to(way, wall[0], wall[1]), distance_sq_to(way, wall[2], wall[3]));
        nearest = tl_min_f32(nearest, distance_sq_to(wall, x, z));
        if (nearest < kept * kept && nearest < distance_sq_to(wall, a->x[i], a->z[i])) {
            return false;
        }
    }
    return true;
}

// Where the slide along walls ends; false: not as far from them as it must, or nowhere.
static bool slide_keeps_clearance(const crowd_step *step, uint32_t i, tl_vec3 to, tl_nav_query *query)
{
    const tl_nav_crowd *crowd = step->crowd;
    const tl_nav_move_request request = { &crowd->filters[crowd->a.filter[i]],
                                          { crowd->a.path[(size_t)i * crowd->def.max_path],
                                            tl_crowd_position(crowd, i) },
                                          to };
    tl_nav_move move;
    return tl_nav_query_move_along_surface(query, step->navmesh, &request, NULL, 0, &move) == TL_OK &&
           keeps_clearance(crowd, i, move.end.point.x, move.end.point.z);
}

// Whether an agent that wants to stand is pushed by so little that it does.
static bool is_still(const crowd_fields *a, uint32_t i, const float velocity[2])
{
    const float still = STANDING_SHARE * a->max_speed[i];
    return tl_crowd_stands(a->status[i]) && a->wanted_x[i] == 0.0f && a->wanted_z[i] == 0.0f &&
           velocity[0] * velocity[0] + velocity[1] * velocity[1] < still * still;
}

static void stay(tl_nav_crowd *crowd, uint32_t i)
{
    crowd->a.vx[i] = 0.0f;
    crowd->a.vz[i] = 0.0f;
}

void tl_crowd_move(const crowd_step *step, uint32_t i, const float velocity[2], tl_nav_query *query)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    if (is_still(a, i, velocity)) {
        stay(crowd, i);
        return;
    }
    const tl_vec3 from = tl_crowd_position(crowd, i);
    tl_vec3 to = { from.x + velocity[0] * step->dt, from.y, from.z + velocity[1] * step->dt };
    if (a->clearance[i] > 0.0f) {
        float share = 1.0f;
        for (uint32_t cut = 0; cut < MAX_CUTS && !keeps_clearance(crowd, i, to.x, to.z); cut++) {
            share *= 0.5f;
            to.x = from.x + share * velocity[0] * step->dt;
            to.z = from.z + share * velocity[1] * step->dt;
        }
        if (!keeps_clearance(crowd, i, to.x, to.z)) {
            stay(crowd, i);
            return;
        }
    }
    tl_vec3 on_polygon;
    bool inside = false;
    const tl_nav_ref polygon = a->path[(size_t)i * crowd->def.max_path];
    tl_result result = tl_navmesh_closest_point(step->navmesh, polygon, to, &on_polygon, &inside);
    if (result == TL_OK && inside) {
        tl_crowd_set_position(crowd, i, on_polygon);
    } else {
        if (a->clearance[i] > 0.0f && !slide_keeps_clearance(step, i, to, query)) {
            stay(crowd, i);
            return;
        }
        tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
        result = tl_nav_corridor_move(&corridor, query, step->navmesh, &crowd->filters[a->filter[i]], to);
        if (result != TL_OK) {
            stay(crowd, i);
            return;
        }
        tl_crowd_keep_corridor(crowd, i, &corridor);
    }
    a->vx[i] = (a->x[i] - from.x) / step->dt;
    a->vz[i] = (a->z[i] - from.z) / step->dt;
}
