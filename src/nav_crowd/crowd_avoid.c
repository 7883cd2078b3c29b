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
#include "base/min_max.h"
#include "nav_crowd/crowd_neighbors.h"
#include "nav_crowd/half_plane_program.h"

// Agents keep a little more than their radii apart, which absorbs what a throng without an answer presses in.
#define SKIN_SHARE 0.02f

// What an agent evades of one that has arrived at the goal that both have.
#define BEFORE_STILL_SHARE 0.9f

// The share of an agent's speed that it takes to come off a wall it stands too near to.
#define OFF_WALL_SHARE 0.5f

// What a disc forbids: its middle and velocity as the agent sees them, both radii together, and the share of evading.
typedef struct crowd_disc {
    float x, z, vx, vz;
    float radius;
    float share;                    // of evading; of the room that is left the agent takes the rest
    float horizon, overlap_horizon; // seconds
    bool is_fixed;                  // the agent does all of the evading, and takes all of the room
} crowd_disc;

// `outward`: how far the agent's velocity lies within what is forbidden, < 0: outside of it.
static tl_half_plane share_plane(const crowd_disc *disc, const float velocity[2], float along_x, float along_z,
                                 float outward)
{
    float share = disc->is_fixed ? 1.0f : outward > 0.0f ? disc->share : 1.0f - disc->share;
    const tl_half_plane plane = { velocity[0] - share * outward * along_z, velocity[1] + share * outward * along_x,
                                  along_x, along_z };
    return plane;
}

// Out of the disc by which the cone is cut off: the velocities that reach it at the horizon.
static tl_half_plane leave_cut_off(const crowd_disc *disc, const float velocity[2], float rate)
{
    float wx = disc->vx - disc->x * rate;
    float wz = disc->vz - disc->z * rate;
    float length = sqrtf(wx * wx + wz * wz);
    float unit_x = 1.0f, unit_z = 0.0f;
    if (length > 0.0f) {
        unit_x = wx / length;
        unit_z = wz / length;
    }
    return share_plane(disc, velocity, unit_z, -unit_x, disc->radius * rate - length);
}

// The half-plane of a disc that moves with (vx, vz) less than the agent.
static tl_half_plane avoid_disc(const crowd_disc *disc, const float velocity[2])
{
    const float x = disc->x, z = disc->z, r = disc->radius;
    const float distance_sq = x * x + z * z;
    if (distance_sq <= r * r) {
        return leave_cut_off(disc, velocity, 1.0f / disc->overlap_horizon);
    }
    const float rate = 1.0f / disc->horizon;
    float wx = disc->vx - x * rate;
    float wz = disc->vz - z * rate;
    float inward = wx * x + wz * z;
    if (inward < 0.0f && inward * inward > r * r * (wx * wx + wz * wz)) {
        return leave_cut_off(disc, velocity, rate);
    }
    float leg = sqrtf(distance_sq - r * r);
    float along_x, along_z;
    if (x * wz - z * wx > 0.0f) {
        along_x = (x * leg - z * r) / distance_sq;
        along_z = (x * r + z * leg) / distance_sq;
    } else {
        along_x = -(x * leg + z * r) / distance_sq;
        along_z = -(z * leg - x * r) / distance_sq;
    }
    return share_plane(disc, velocity, along_x, along_z, disc->vx * along_z - disc->vz * along_x);
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
    // An end of the wall: a disc of the clearance, which stands still.
    const float *end = foot < 0.0f ? wall : wall + 2;
    const crowd_disc disc = { end[0] - a->x[i],        end[1] - a->z[i],        a->vx[i], a->vz[i], clearance, 1.0f,
                              crowd->def.wall_horizon, crowd->def.wall_horizon, true };
    float far = clearance + reach;
    if (disc.x * disc.x + disc.z * disc.z > far * far) {
        return false;
    }
    const float velocity[2] = { a->vx[i], a->vz[i] };
    *plane_out = avoid_disc(&disc, velocity);
    return true;
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

// Whether a wall stands between an agent and a neighbour, `x` and `z` from it.
static bool is_behind_wall(const facing_wall *walls, uint32_t count, float x, float z)
{
    bool is_hidden = false;
    for (uint32_t k = 0; k < count; k++) {
        const facing_wall *w = &walls[k];
        const float side = w->side + x * (w->end_z - w->start_z) - z * (w->end_x - w->start_x);
        const float start = w->start_x * z - w->start_z * x;
        const float end = w->end_x * z - w->end_z * x;
        is_hidden |= (side < 0.0f) & ((start > 0.0f) != (end > 0.0f));
    }
    return is_hidden;
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
static float share_of_leader(const tl_nav_crowd *crowd, uint32_t i, uint32_t other, float share)
{
    const crowd_fields *a = &crowd->a;
    const crowd_group *group = tl_crowd_group_of(crowd, i);
    if (group == NULL || tl_crowd_group_of(crowd, other) != group) {
        return share;
    }
    return a->member[other] - 1 == group->first ? LEADER_SHARE
           : a->member[i] - 1 == group->first   ? 1.0f - LEADER_SHARE
                                                : share;
}

static tl_half_plane avoid_neighbor(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbor)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_snapshot *seen = &crowd->seen;
    const uint32_t n = neighbor->snapshot;
    const float velocity[2] = { seen->vx[k], seen->vz[k] };
    float share = 0.5f + 0.5f * (seen->priority[n] - seen->priority[k]);
    const uint32_t still = (seen->kind[k] ^ seen->kind[n]) & CROWD_SEEN_STILL;
    if (still != 0 && tl_crowd_has_goal_of(crowd, seen->agent[k], seen->agent[n])) {
        share = (seen->kind[k] & CROWD_SEEN_STILL) != 0 ? 1.0f - BEFORE_STILL_SHARE : BEFORE_STILL_SHARE;
    }
    share = share_of_leader(crowd, seen->agent[k], seen->agent[n], share);
    crowd_disc disc = { seen->x[n] - seen->x[k],
                        seen->z[n] - seen->z[k],
                        velocity[0] - seen->vx[n],
                        velocity[1] - seen->vz[n],
                        (1.0f + SKIN_SHARE) * (seen->radius[k] + seen->radius[n]),
                        share,
                        crowd->def.agent_horizon,
                        step->dt,
                        (seen->kind[n] & CROWD_SEEN_FIXED) != 0 };
    if (disc.x == 0.0f && disc.z == 0.0f && disc.vx == 0.0f && disc.vz == 0.0f) {
        part_pair(seen->agent[k], seen->agent[n], &disc.vx, &disc.vz);
    }
    return avoid_disc(&disc, velocity);
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
    const uint32_t i = crowd->seen.agent[k];
    crowd_neighbor neighbors[CROWD_MAX_NEIGHBORS];
    uint32_t count = tl_crowd_find_neighbors(crowd, k, neighbors);
    facing_wall walls[CROWD_MAX_WALLS];
    const uint32_t wall_count = find_facing_walls(crowd, i, walls);
    uint32_t seen_count = 0;
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t other = neighbors[n].snapshot;
        // Rim to rim about a corner they see one another, though no line leads from center to center.
        if (neighbors[n].gap < a->radius[i] ||
            !is_behind_wall(walls, wall_count, crowd->seen.x[other] - a->x[i], crowd->seen.z[other] - a->z[i])) {
            neighbors[seen_count++] = neighbors[n];
        }
    }
    tl_crowd_give_way(step, k, neighbors, seen_count);
    tl_half_plane_program program;
    program.count = 0;
    accelerate(step, i, &program);
    for (uint32_t w = 0; w < a->wall_count[i]; w++) {
        const float *wall = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS + 4 * w];
        program.count += avoid_wall(crowd, i, wall, &program.planes[program.count]);
    }
    program.hard_count = program.count;
    for (uint32_t n = 0; n < seen_count; n++) {
        program.planes[program.count++] = avoid_neighbor(step, k, &neighbors[n]);
    }
    tl_half_plane_solve(&program, velocity_out);
}
