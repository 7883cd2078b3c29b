// SPDX-License-Identifier: MIT
//
// ORCA: which velocities keep an agent clear of its walls and neighbours, each as one half-plane, and the one nearest
// to what it wants.
//
// Two agents collide within the horizon when their relative velocity lies in a truncated cone. Each of them takes its
// share of the shortest change that leaves the cone; if both do, they do not collide, and as both choose the same side
// there is no oscillation. Detour samples velocities and scores them, and its agents press into one another and
// tremble; social forces need steps of a few milliseconds. Walls are half-planes too: a velocity must not use up the
// distance to a wall within the wall horizon. They are never relaxed.
//
// Source: van den Berg, Guy, Lin, Manocha, Reciprocal n-Body Collision Avoidance, 2011.

#include "base/hash.h"
#include "base/lowest_bit.h"
#include "base/min_max.h"
#include "nav_crowd/crowd_neighbors.h"
#include "nav_crowd/crowd_right_of_way.h"

#include <string.h>

// Agents keep a little more than their radii apart, which absorbs what a throng without an answer presses in.
#define SKIN_SHARE 0.02f

// What an agent evades of one that has arrived at the goal that both have.
#define BEFORE_STILL_SHARE 0.9f

// The share of an agent's speed that it takes to come off a wall it stands too near to.
#define OFF_WALL_SHARE 0.5f

// An end of a wall is a disc of the clearance, which stands still.
static bool avoid_wall_end(const tl_nav_crowd *crowd, uint32_t i, const float end[2], float reach,
                           tl_half_plane *plane_out)
{
    const crowd_fields *a = &crowd->a;
    const float x = end[0] - a->x[i], z = end[1] - a->z[i];
    const float far = a->clearance[i] + reach;
    if (x * x + z * z > far * far) {
        return false;
    }
    crowd_discs discs;
    memset(&discs, 0, sizeof discs);
    discs.x[0] = x;
    discs.z[0] = z;
    discs.vx[0] = discs.own_vx = a->vx[i];
    discs.vz[0] = discs.own_vz = a->vz[i];
    discs.radius[0] = a->clearance[i];
    discs.evade[0] = discs.room[0] = 1.0f;
    discs.rate = discs.overlap_rate = 1.0f / crowd->def.wall_horizon;
    discs.count = 1;
    tl_half_plane planes[CROWD_LANES];
    tl_crowd_best_kernels()->avoid(&discs, planes);
    *plane_out = planes[0];
    return true;
}

// Keeps the agent from using up the distance to a wall within the horizon. False: it cannot, or stands behind it.
static bool avoid_wall(const tl_nav_crowd *crowd, uint32_t i, const float wall[4], tl_half_plane *plane_out)
{
    const crowd_fields *a = &crowd->a;
    const float ax = a->x[i] - wall[0], az = a->z[i] - wall[1];
    float along_x = wall[2] - wall[0], along_z = wall[3] - wall[1];
    const float length = sqrtf(along_x * along_x + along_z * along_z);
    const float reach = a->max_speed[i] * crowd->def.wall_horizon;
    const float clearance = a->clearance[i];
    if (!(length > 0.0f)) {
        return false;
    }
    along_x /= length;
    along_z /= length;
    // Towards the walkable side.
    const float nx = along_z, nz = -along_x;
    const float distance = ax * nx + az * nz;
    const float foot = ax * along_x + az * along_z;
    if (foot >= 0.0f && foot <= length) {
        float room = tl_max_f32(distance, clearance > 0.0f ? distance : 0.0f) - clearance;
        if (room > reach || distance < -reach - clearance) {
            return false;
        }
        float rate = room / crowd->def.wall_horizon;
        rate = tl_max_f32(rate, -OFF_WALL_SHARE * a->max_speed[i]);
        const tl_half_plane plane = { -rate * nx, -rate * nz, nz, -nx };
        *plane_out = plane;
        return true;
    }
    if (!(clearance > 0.0f) || distance < 0.0f) {
        return false;
    }
    return avoid_wall_end(crowd, i, foot < 0.0f ? wall : wall + 2, reach, plane_out);
}

// A wall of which the agent is on the walkable side, seen from the agent.
typedef struct facing_wall {
    float start_x, start_z, end_x, end_z;
    float side; // of the agent: twice the area of the triangle that it forms with the wall, >= 0
} facing_wall;

static uint32_t find_facing_walls(const tl_nav_crowd *crowd, uint32_t i, facing_wall *out)
{
    const crowd_fields *a = &crowd->a;
    uint32_t count = 0;
    for (uint32_t k = 0; k < a->wall_count[i]; k++) {
        const float *wall = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS + 4 * k];
        const facing_wall facing = { wall[0] - a->x[i], wall[1] - a->z[i], wall[2] - a->x[i], wall[3] - a->z[i],
                                     (a->x[i] - wall[0]) * (wall[3] - wall[1]) -
                                         (a->z[i] - wall[1]) * (wall[2] - wall[0]) };
        out[count] = facing;
        count += facing.side >= 0.0f;
    }
    return count;
}

// Notes which neighbours a wall stands before, seen from the agent: all lanes alike, without a branch.
static void mark_hidden(const facing_wall *w, const crowd_discs *discs, uint32_t hidden[CROWD_MAX_NEIGHBORS])
{
    const float x_wall = w->end_x - w->start_x, z_wall = w->end_z - w->start_z;
    for (uint32_t n = 0; n < tl_crowd_lanes_end(discs->count); n++) {
        const float x = discs->x[n], z = discs->z[n];
        const float side = w->side + x * z_wall - z * x_wall;
        const float start = w->start_x * z - w->start_z * x;
        const float end = w->end_x * z - w->end_z * x;
        hidden[n] |= (uint32_t)(side < 0.0f) & ((uint32_t)(start > 0.0f) ^ (uint32_t)(end > 0.0f));
    }
}

// Takes those away that the agent does not see. Rim to rim about a corner two see one another, though no line leads
// from center to center. Returns how many are left.
static uint32_t drop_hidden(const tl_nav_crowd *crowd, uint32_t i, const crowd_discs *discs, crowd_neighbor *neighbors)
{
    facing_wall walls[CROWD_MAX_WALLS];
    const uint32_t wall_count = find_facing_walls(crowd, i, walls);
    uint32_t hidden[CROWD_MAX_NEIGHBORS] = { 0 };
    uint32_t seen_count = 0;
    if (wall_count == 0) {
        return discs->count;
    }
    for (uint32_t k = 0; k < wall_count; k++) {
        mark_hidden(&walls[k], discs, hidden);
    }
    for (uint32_t n = 0; n < discs->count; n++) {
        const crowd_neighbor neighbor = neighbors[n];
        neighbors[seen_count] = neighbor;
        seen_count += (neighbor.gap < crowd->a.radius[i]) | (hidden[n] == 0);
    }
    return seen_count;
}

// A direction for two agents in the same place with the same velocity, each the other's opposite.
static void part_pair(uint32_t i, uint32_t other, float *x, float *z)
{
    uint32_t low = tl_min_u32(i, other);
    uint64_t bits = tl_hash_mix(((uint64_t)low << 32 | tl_max_u32(i, other)) + 1);
    // Stereographic: every direction of a half circle, without a sine.
    float t = (float)(bits >> 40) * 0x1p-23f - 1.0f;
    float scale = (i == low ? 1.0f : -1.0f) / (1.0f + t * t);
    *x = 2.0f * t * scale;
    *z = (1.0f - t * t) * scale;
}

// What an agent evades of its leader, who evades the rest: a group's leader goes where it will.
#define LEADER_SHARE 0.9f

// Of two in one group, of which one leads; else `share`.
static float share_of_leader(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t i, uint32_t other,
                             float share)
{
    const crowd_fields *a = &crowd->a;
    if (tl_crowd_group_of(crowd, other) != group) {
        return share;
    }
    return a->member[other] - 1 == group->first ? LEADER_SHARE
           : a->member[i] - 1 == group->first   ? 1.0f - LEADER_SHARE
                                                : share;
}

// What an agent evades of a neighbour, `share` but for those that it knows: its group's, or who has arrived at the goal
// that both have.
static float share_of_known(const tl_nav_crowd *crowd, uint32_t k, uint32_t n, const crowd_group *group, float share)
{
    const crowd_seen_agent *own = &crowd->seen.agents[k], *other = &crowd->seen.agents[n];
    const uint32_t still = (own->kind ^ other->kind) & CROWD_SEEN_STILL;
    if (still != 0 && tl_crowd_has_goal_of(crowd, own->agent, other->agent)) {
        share = (own->kind & CROWD_SEEN_STILL) != 0 ? 1.0f - BEFORE_STILL_SHARE : BEFORE_STILL_SHARE;
    }
    return group != NULL ? share_of_leader(crowd, group, own->agent, other->agent, share) : share;
}

// Which shares the agent takes of evading, and of the room: by priorities, of equal ones half. Fixed ones do nothing of
// the evading, and leave all of the room.
static void share_evading(const tl_nav_crowd *crowd, uint32_t k, const crowd_neighbor *neighbors, crowd_view *view)
{
    const crowd_seen_agent *own = &crowd->seen.agents[k];
    const crowd_group *group = tl_crowd_group_of(crowd, own->agent);
    crowd_discs *discs = &view->discs;
    const uint32_t all = tl_crowd_neighbor_bits(discs->count);
    const uint32_t still = (own->kind & CROWD_SEEN_STILL) != 0 ? ~view->still & all : view->still & all;
    for (uint32_t n = 0; n < tl_crowd_lanes_end(discs->count); n++) {
        discs->evade[n] = 0.5f + 0.5f * (view->priority[n] - own->priority);
    }
    for (uint32_t n = 0; n < discs->count && (still != 0 || group != NULL); n++) {
        discs->evade[n] = share_of_known(crowd, k, neighbors[n].snapshot, group, discs->evade[n]);
    }
    for (uint32_t n = 0; n < tl_crowd_lanes_end(discs->count); n++) {
        discs->room[n] = 1.0f - discs->evade[n];
    }
    for (uint32_t left = view->fixed & all; left != 0; left &= left - 1) {
        discs->evade[tl_lowest_bit(left)] = discs->room[tl_lowest_bit(left)] = 1.0f;
    }
}

static void part_pairs(const tl_nav_crowd *crowd, uint32_t k, const crowd_neighbor *neighbors, crowd_discs *discs)
{
    for (uint32_t n = 0; n < discs->count; n++) {
        if (discs->x[n] == 0.0f && discs->z[n] == 0.0f && discs->vx[n] == 0.0f && discs->vz[n] == 0.0f) {
            part_pair(crowd->seen.agents[k].agent, neighbors[n].agent, &discs->vx[n], &discs->vz[n]);
        }
    }
}

// The neighbours' half-planes, behind those of the walls.
static void avoid_neighbors(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbors, crowd_view *view,
                            tl_half_plane_program *program)
{
    const tl_nav_crowd *crowd = step->crowd;
    crowd_discs *discs = &view->discs;
    discs->rate = 1.0f / crowd->def.agent_horizon;
    discs->overlap_rate = 1.0f / step->dt;
    share_evading(crowd, k, neighbors, view);
    part_pairs(crowd, k, neighbors, discs);
    tl_crowd_best_kernels()->avoid(discs, &program->planes[program->count]);
    program->count += discs->count;
}

// What the agent can come to in this step of what it wants.
static void accelerate(const crowd_step *step, uint32_t i, tl_half_plane_program *program)
{
    const crowd_fields *a = &step->crowd->a;
    float dx = a->wanted_x[i] - a->vx[i];
    float dz = a->wanted_z[i] - a->vz[i];
    float change = sqrtf(dx * dx + dz * dz);
    float most = a->max_acceleration[i] * step->dt;
    float share = change > most ? most / change : 1.0f;
    float x = a->vx[i] + share * dx;
    float z = a->vz[i] + share * dz;
    // A push may have made it faster than it walks.
    float speed = sqrtf(x * x + z * z);
    float cut = speed > a->max_speed[i] ? a->max_speed[i] / speed : 1.0f;
    program->max_length = a->max_speed[i];
    program->wanted_x = x * cut;
    program->wanted_z = z * cut;
}

void tl_crowd_avoid(const crowd_step *step, uint32_t k, float velocity_out[2])
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t i = crowd->seen.agents[k].agent;
    crowd_neighbor neighbors[CROWD_MAX_NEIGHBORS];
    uint32_t count = tl_crowd_find_neighbors(crowd, k, neighbors);
    crowd_view view;
    const crowd_kernels *kernels = tl_crowd_best_kernels();
    kernels->view(&crowd->seen, k, neighbors, count, 1.0f + SKIN_SHARE, &view);
    const uint32_t seen_count = drop_hidden(crowd, i, &view.discs, neighbors);
    if (seen_count < count) {
        kernels->view(&crowd->seen, k, neighbors, seen_count, 1.0f + SKIN_SHARE, &view);
    }
    tl_crowd_give_way(step, k, neighbors, &view);
    tl_half_plane_program program;
    program.count = 0;
    accelerate(step, i, &program);
    for (uint32_t w = 0; w < a->wall_count[i]; w++) {
        const float *wall = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS + 4 * w];
        program.count += avoid_wall(crowd, i, wall, &program.planes[program.count]);
    }
    program.hard_count = program.count;
    avoid_neighbors(step, k, neighbors, &view, &program);
    tl_half_plane_solve(&program, velocity_out);
}
