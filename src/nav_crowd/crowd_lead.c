// SPDX-License-Identifier: MIT
//
// What a group's followers go by in a step: where their leader is, its trail, how the formation faces. And how fast the
// leader may walk, so that they can. And two exchange their slots where each is in the other's way.
//
// The leader is an agent and not a point that runs ahead: what it cannot do, as to squeeze through a throng, the group
// waits for. The formation wheels no faster than its outermost member can walk, and faces about at once for a new goal
// that lies behind, with the slots dealt anew, as soldiers do: nobody runs around the others.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

// The leader's top speed, as a share of what the slowest can: so that they can catch up.
#define LEAD_SHARE 0.9f

// The leader slows down once somebody is farther from its slot than this share of the distance at which it stands.
#define SLOW_SHARE 0.25f

// Seconds after which one that is held up is not waited for.
#define PATIENCE 10.0f

// The outermost slot moves at most so fast when the formation wheels, as a share of what the slowest can.
#define WHEEL_SHARE 0.5f
#define MAX_WHEEL   3.0f // radians a second

// Cosines of the turns for which slots are dealt anew: for a new goal, and for a leader that is fixed and turns about.
#define NEW_GOAL_COSINE 0.5f
#define ABOUT_COSINE    (-0.5f)

// Two exchange their slots when that saves more than the square of this share of the spacing.
#define EXCHANGE_SHARE 0.5f

#define FIXED_MOVES    0.1f // metres a second from which on a fixed leader walks

static void find_leader(const crowd_step *step, crowd_group *group, uint32_t i)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t status = a->status[i];
    const float speed_sq = a->vx[i] * a->vx[i] + a->vz[i] * a->vz[i];
    bool moves = status == TL_NAV_AGENT_WALKING || status == TL_NAV_AGENT_WAITING || status == TL_NAV_AGENT_QUEUED ||
                 status == TL_NAV_AGENT_ON_LINK;
    if (status == TL_NAV_AGENT_FIXED) {
        const float side = CROWD_RELOCATE_RADII * a->radius[i];
        tl_nav_location at;
        moves = speed_sq > FIXED_MOVES * FIXED_MOVES;
        const bool is_there =
            tl_navmesh_find_nearest(step->navmesh, &crowd->filters[a->filter[i]], tl_crowd_position(crowd, i),
                                    tl_vec3_make(side, a->height[i], side), &at) == TL_OK;
        group->polygon = is_there ? at.polygon : TL_NAV_NO_REF;
        tl_crowd_set3(group->place, 0, is_there ? at.point : tl_crowd_position(crowd, i));
    } else if (status == TL_NAV_AGENT_OFF_MESH) {
        group->polygon = TL_NAV_NO_REF;
    } else if (status != TL_NAV_AGENT_ON_LINK) { // there, as if it stood where it left the ground
        group->polygon = a->path[(size_t)i * crowd->def.max_path];
        tl_crowd_set3(group->place, 0, tl_crowd_position(crowd, i));
    }
    group->velocity[0] = moves ? a->vx[i] : 0.0f;
    group->velocity[1] = moves ? a->vz[i] : 0.0f;
    group->flags = (group->flags & ~CROWD_GROUP_MOVES) | (moves ? CROWD_GROUP_MOVES : 0);
}

static void leave_trail(const tl_nav_crowd *crowd, crowd_group *group)
{
    const crowd_fields *a = &crowd->a;
    if (group->polygon == TL_NAV_NO_REF) {
        return;
    }
    const size_t newest = (size_t)group->first + group->trail_first;
    const float x = group->place[0] - a->trail[3 * newest], z = group->place[2] - a->trail[3 * newest + 2];
    if (group->trail_count > 0 && x * x + z * z < group->spacing * group->spacing) {
        return;
    }
    group->trail_first = (group->trail_first > 0 ? group->trail_first : group->count) - 1;
    group->trail_count = tl_min_u32(group->trail_count + 1, group->count);
    const size_t at = (size_t)group->first + group->trail_first;
    memcpy(a->trail + 3 * at, group->place, sizeof group->place);
    a->trail_polygon[at] = group->polygon;
}

// Where the leader goes, unit; false: nowhere, or so near to its corner that the direction says little.
static bool find_direction(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t i, float out[2])
{
    const crowd_fields *a = &crowd->a;
    float x = group->velocity[0], z = group->velocity[1], least = FIXED_MOVES;
    if (a->status[i] == TL_NAV_AGENT_WALKING && (a->flags[i] & CROWD_CORNER) != 0) {
        x = a->corner[2 * (size_t)i] - a->x[i];
        z = a->corner[2 * (size_t)i + 1] - a->z[i];
        least = a->radius[i];
    } else if (a->status[i] != TL_NAV_AGENT_FIXED) {
        return false;
    }
    const float length = sqrtf(x * x + z * z);
    if (!(length > least)) {
        return false;
    }
    out[0] = x / length;
    out[1] = z / length;
    return true;
}

static void wheel(crowd_group *group, const float toward[2], float angle)
{
    const float x = group->heading[0], z = group->heading[1];
    const float along = x * toward[0] + z * toward[1], across = x * toward[1] - z * toward[0];
    if (along >= 1.0f - 0.5f * angle * angle) {
        group->heading[0] = toward[0];
        group->heading[1] = toward[1];
        return;
    }
    // By the tangent of the half angle, which a small angle's half is: without a sine.
    const float t = across >= 0.0f ? 0.5f * angle : -0.5f * angle;
    const float cosine = (1.0f - t * t) / (1.0f + t * t), sine = 2.0f * t / (1.0f + t * t);
    const float turned_x = x * cosine - z * sine, turned_z = x * sine + z * cosine;
    const float length = sqrtf(turned_x * turned_x + turned_z * turned_z);
    group->heading[0] = length > 0.0f ? turned_x / length : toward[0];
    group->heading[1] = length > 0.0f ? turned_z / length : toward[1];
}

static void face(const crowd_step *step, crowd_group *group, uint32_t leader, float slowest)
{
    float toward[2];
    if (!find_direction(step->crowd, group, leader, toward)) {
        return;
    }
    const float along = group->heading[0] * toward[0] + group->heading[1] * toward[1];
    const bool is_new = (group->flags & CROWD_GROUP_NEW_GOAL) != 0 && along < NEW_GOAL_COSINE;
    const bool turns_about = step->crowd->a.status[leader] == TL_NAV_AGENT_FIXED && along < ABOUT_COSINE;
    group->flags &= ~CROWD_GROUP_NEW_GOAL;
    if (is_new || turns_about) {
        group->heading[0] = toward[0];
        group->heading[1] = toward[1];
        tl_crowd_deal_slots(step->crowd, group);
        return;
    }
    const float rate = tl_min_f32(WHEEL_SHARE * slowest / group->range, MAX_WHEEL);
    wheel(group, toward, tl_min_f32(rate * step->dt, 1.0f));
}

// The slowest of those who are waited for, the leader included; and how far the last of them is behind.
static float find_slowest(const tl_nav_crowd *crowd, crowd_group *group, uint32_t leader)
{
    const crowd_fields *a = &crowd->a;
    float slowest = a->max_speed[leader];
    group->lag = 0.0f;
    for (uint32_t m = group->first + 1; m < group->first + group->count; m++) {
        const uint32_t i = a->member_agent[m], status = a->status[i];
        const bool is_lost = a->lag[m] > group->lost_distance || a->stalled[i] > PATIENCE || !(a->max_speed[i] > 0.0f);
        if (is_lost || status == TL_NAV_AGENT_UNREACHABLE || status == TL_NAV_AGENT_OFF_MESH ||
            status == TL_NAV_AGENT_GAVE_UP) {
            continue;
        }
        slowest = tl_min_f32(slowest, a->max_speed[i]);
        group->lag = tl_max_f32(group->lag, a->lag[m]);
    }
    return slowest;
}

// Metres squared from a member to another one's slot in the formation.
static float squared_way(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t who, uint32_t to)
{
    const uint32_t i = crowd->a.member_agent[who];
    float slot[2];
    tl_crowd_plan_slot(crowd, group, to, slot);
    const float x = group->place[0] + slot[0] - crowd->a.x[i], z = group->place[2] + slot[1] - crowd->a.z[i];
    return x * x + z * z;
}

// One member a step looks for the one with whom an exchange saves most. What was dealt well is so no more when a door
// has changed the order; and two who stand in one another's slots would hold each other up for ever.
static void exchange_slots(const tl_nav_crowd *crowd, crowd_group *group)
{
    const crowd_fields *a = &crowd->a;
    if (group->count < 3 || (group->flags & CROWD_GROUP_IN_ORDER) != 0 || group->formation == TL_NAV_FORMATION_LOOSE ||
        group->formation == TL_NAV_FORMATION_COLUMN) {
        return;
    }
    const uint32_t m = group->first + 1 + (uint32_t)(crowd->head->step % (group->count - 1));
    if ((a->member_flags[m] & CROWD_ON_TRAIL) != 0) {
        return;
    }
    const float own = squared_way(crowd, group, m, m);
    float most = EXCHANGE_SHARE * EXCHANGE_SHARE * group->spacing * group->spacing;
    uint32_t with = m;
    for (uint32_t n = group->first + 1; n < group->first + group->count && own > most; n++) {
        const float saved =
            own + squared_way(crowd, group, n, n) - squared_way(crowd, group, m, n) - squared_way(crowd, group, n, m);
        if (n != m && saved > most && (a->member_flags[n] & CROWD_ON_TRAIL) == 0) {
            most = saved;
            with = n;
        }
    }
    const uint32_t agent = a->member_agent[m];
    a->member_agent[m] = a->member_agent[with];
    a->member_agent[with] = agent;
    a->member[a->member_agent[m]] = m + 1;
    a->member[agent] = with + 1;
}

// Followers read one another's goals while they move, so what they found in the step before becomes their goal now.
static void take_over_slots(const tl_nav_crowd *crowd, const crowd_group *group)
{
    const crowd_fields *a = &crowd->a;
    for (uint32_t m = group->first + 1; m < group->first + group->count; m++) {
        if (a->slot_polygon[m] != TL_NAV_NO_REF) {
            const uint32_t i = a->member_agent[m];
            tl_crowd_set3(a->goal, i, tl_crowd_get3(a->slot, m));
            a->goal_polygon[i] = a->slot_polygon[m];
            a->flags[i] |= CROWD_HAS_GOAL;
        }
    }
}

static void lead(const crowd_step *step, crowd_group *group)
{
    const tl_nav_crowd *crowd = step->crowd;
    const uint32_t leader = crowd->a.member_agent[group->first];
    take_over_slots(crowd, group);
    find_leader(step, group, leader);
    leave_trail(crowd, group);
    const float slowest = find_slowest(crowd, group, leader);
    face(step, group, leader, slowest);
    exchange_slots(crowd, group);
    const float slow = SLOW_SHARE * group->wait_distance;
    const float share = tl_clamp_f32((group->wait_distance - group->lag) / (group->wait_distance - slow), 0.0f, 1.0f);
    group->speed = group->count > 1 ? LEAD_SHARE * slowest * share : slowest;
}

static void lead_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const crowd_step *step = (const crowd_step *)user;
    const uint32_t end = tl_block_end(block, CROWD_BLOCK, step->crowd->def.max_groups);
    for (uint32_t g = block * CROWD_BLOCK; g < end; g++) {
        if (step->crowd->a.groups[g].count > 0) {
            lead(step, &step->crowd->a.groups[g]);
        }
    }
}

void tl_crowd_lead_groups(const crowd_step *step)
{
    if (step->crowd->head->member_count > 0) {
        tl_crowd_run_tasks(step, lead_block, tl_block_count(step->crowd->def.max_groups, CROWD_BLOCK));
    }
}
