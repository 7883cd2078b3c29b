// SPDX-License-Identifier: MIT
//
// What an agent wants: along its corridor's straight path, round corners with some room, slower before its goal. And
// when it has arrived: where many have one goal, those who come last stand where the others leave room, and stay there.

#include "base/min_max.h"
#include "nav_crowd/crowd_neighbors.h"

#include <math.h>
#include <string.h>

// Room that an agent leaves at a corner, as a share of its radius: those who turn there abreast need not press into it.
#define CORNER_SHARE 0.5f

// An agent takes a link once it is so near to it, as a share of its radius.
#define LINK_SHARE 1.0f

// Below this share of its top speed towards its corner an agent is held up; it is not any more when it has walked a
// third of that time.
#define PROGRESS_SHARE 0.25f
#define RECOVERY       3.0f
#define MAX_STALLED    30.0f // seconds: more than anybody goes back for (crowd_right_of_way.c)

// One that follows a leader on its way is not held up while it wants to walk slower than this share of its top speed.
#define BESIDE_SHARE 0.5f

// The corner that the path turns at, `x` and `z` from here, to its left (side 1) or right (-1): moved aside by the room
// that is left there: the point where a tangent touches the circle around it.
static void pass_corner(float x, float z, float side, float room, float toward_out[2])
{
    toward_out[0] = x;
    toward_out[1] = z;
    float distance_sq = x * x + z * z;
    if (side == 0.0f || !(distance_sq > 0.0f)) {
        return;
    }
    if (distance_sq <= room * room) { // beside the corner: past it, at a right angle
        toward_out[0] = -side * z;
        toward_out[1] = side * x;
        return;
    }
    float leg = sqrtf(distance_sq - room * room);
    float cosine = leg / sqrtf(distance_sq), sine = side * room / sqrtf(distance_sq);
    toward_out[0] = cosine * (cosine * x - sine * z);
    toward_out[1] = cosine * (sine * x + cosine * z);
}

static bool is_kept_off(const crowd_fields *a, uint32_t i, float distance)
{
    return a->clearance[i] > 0.0f && a->stalled[i] > CROWD_KEPT_OFF_AFTER && distance <= tl_crowd_kept_off_reach(a, i);
}

// The wanted velocity: `speed` towards a direction.
static void want(const crowd_step *step, uint32_t i, float toward_x, float toward_z, float speed)
{
    crowd_fields *a = &step->crowd->a;
    float length = sqrtf(toward_x * toward_x + toward_z * toward_z);
    float scale = length > 0.0f ? speed / length : 0.0f;
    a->wanted_x[i] = toward_x * scale;
    a->wanted_z[i] = toward_z * scale;
}

void tl_crowd_want_to_stand(const crowd_step *step, uint32_t i)
{
    want(step, i, 0.0f, 0.0f, 0.0f);
}

// The end of the corridor is reached. Where an edit took the floor of the goal, that is not the goal itself.
static void arrive(const crowd_step *step, uint32_t i)
{
    crowd_fields *a = &step->crowd->a;
    const uint32_t flags = a->flags[i];
    a->stalled[i] = 0.0f;
    if ((flags & CROWD_REACHES) != 0) {
        a->status[i] = TL_NAV_AGENT_ARRIVED;
        a->stalled[i] = tl_crowd_distance_to_goal(step->crowd, i);
    } else if ((flags & CROWD_IN_QUEUE) != 0) {
        a->status[i] = TL_NAV_AGENT_WAITING;
    } else if ((flags & CROWD_PARTIAL) != 0) {
        a->status[i] = TL_NAV_AGENT_UNREACHABLE;
    } else if ((flags & CROWD_GAVE_UP) != 0 && a->path_count[i] == 1) {
        a->status[i] = TL_NAV_AGENT_GAVE_UP;
    } else {
        a->flags[i] |= CROWD_NEED_PATH;
        a->status[i] = TL_NAV_AGENT_WAITING;
    }
    tl_crowd_want_to_stand(step, i);
}

// A wide agent before a gap that is too narrow: where its path is known to lead through such gaps it stands there from
// now on; where that is not known it asks. False: it may walk on.
static bool hold_at_wall(const crowd_step *step, uint32_t i)
{
    crowd_fields *a = &step->crowd->a;
    const uint32_t flags = a->flags[i];
    if (!(a->clearance[i] > 0.0f) || !(a->stalled[i] > CROWD_HELD_AFTER) || !tl_crowd_touches_wall(a, i)) {
        return false;
    }
    if ((flags & (CROWD_PARTIAL | CROWD_GAVE_UP)) == 0) {
        a->flags[i] |= (flags & CROWD_REACHES) == 0 ? CROWD_NEED_PATH : 0;
        return false;
    }
    // A path that reaches the goal began where the agent did not fit: here it may, and find a wider one.
    a->flags[i] |= (flags & CROWD_REACHES) != 0 ? CROWD_ASK_LATER : 0;
    a->status[i] = (flags & CROWD_PARTIAL) != 0 ? TL_NAV_AGENT_UNREACHABLE : TL_NAV_AGENT_GAVE_UP;
    a->stalled[i] = 0.0f;
    tl_crowd_want_to_stand(step, i);
    return true;
}

// A group's leader walks as its followers can.
static float top_speed(const tl_nav_crowd *crowd, uint32_t i)
{
    const crowd_group *group = tl_crowd_group_of(crowd, i);
    return group == NULL || tl_crowd_follows(crowd, i) ? crowd->a.max_speed[i]
                                                       : tl_min_f32(crowd->a.max_speed[i], group->speed);
}

// How long an agent has hardly come forward: towards where it wants to go now.
static void note_progress(const crowd_step *step, uint32_t i, float x, float z)
{
    crowd_fields *a = &step->crowd->a;
    float forward = a->vx[i] * x + a->vz[i] * z;
    float enough = PROGRESS_SHARE * top_speed(step->crowd, i) * sqrtf(x * x + z * z);
    float stalled = forward < enough ? a->stalled[i] + step->dt : a->stalled[i] - RECOVERY * step->dt;
    a->stalled[i] = tl_clamp_f32(stalled, 0.0f, MAX_STALLED);
}

// Before its goal an agent goes so slowly that the square of its speed is this share of acceleration times distance. 2
// is enough to stop there; with 1 or more, one that was pushed aside may go round its goal for ever.
#define BRAKE_SHARE 0.5f

// Steps between looks for the corner, while it is far and the agent stays in one polygon.
enum { CORNER_STEPS = 8 };

static void head_for(const crowd_step *step, uint32_t i, float x, float z, float speed)
{
    const crowd_fields *a = &step->crowd->a;
    const uint32_t flags = a->flags[i];
    const float side = (flags & CROWD_LEFT) != 0 ? 1.0f : (flags & CROWD_RIGHT) != 0 ? -1.0f : 0.0f;
    float toward[2];
    pass_corner(x, z, side, a->clearance[i] + CORNER_SHARE * a->radius[i], toward);
    note_progress(step, i, toward[0], toward[1]);
    want(step, i, toward[0], toward[1], speed);
}

// Whether the corner of the steps before is still where the agent heads. The straight path is a third of a step's time.
static bool head_on(const crowd_step *step, uint32_t i)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    if ((a->flags[i] & CROWD_CORNER) == 0 || (crowd->head->step + i) % CORNER_STEPS == 0) {
        return false;
    }
    const float x = a->corner[2 * (size_t)i] - a->x[i], z = a->corner[2 * (size_t)i + 1] - a->z[i];
    // Near it the path may turn, arrive or take a link.
    const float reach = 2.0f * (a->radius[i] + a->clearance[i]) + a->arrive_distance[i] +
                        a->max_speed[i] * (step->dt + a->max_speed[i] / a->max_acceleration[i]);
    if (x * x + z * z <= reach * reach) {
        return false;
    }
    head_for(step, i, x, z, top_speed(crowd, i));
    return true;
}

// Where an agent travels, for others to see: to the corner after the next one. Those who come to a door along its wall
// from both sides face one another, but travel the same way.
static uint32_t travel_flags(const crowd_fields *a, uint32_t i, const tl_nav_corner *corner)
{
    const float x = corner->point.x - a->x[i], z = corner->point.z - a->z[i];
    const float length = sqrtf(x * x + z * z);
    const float scale = length > 0.0f ? 127.0f / length : 0.0f;
    const uint32_t bytes = ((uint32_t)(int32_t)(x * scale) & 255u) | ((uint32_t)(int32_t)(z * scale) & 255u) << 8;
    return bytes << CROWD_TRAVEL_SHIFT;
}

static void keep_corner(crowd_fields *a, uint32_t i, const tl_nav_corner *corner, const tl_nav_corner *after)
{
    uint32_t flags = CROWD_CORNER | travel_flags(a, i, after);
    flags |= (corner->flags & TL_NAV_CORNER_LEFT) != 0 ? CROWD_LEFT : 0;
    flags |= (corner->flags & TL_NAV_CORNER_RIGHT) != 0 ? CROWD_RIGHT : 0;
    a->flags[i] = (a->flags[i] & ~(CROWD_LEFT | CROWD_RIGHT | CROWD_TRAVEL_MASK)) | flags;
    a->corner[2 * (size_t)i] = corner->point.x;
    a->corner[2 * (size_t)i + 1] = corner->point.z;
}

// A corner so near, in radii, is looked past: and so far past it, metres.
#define LOOK_RADII  3.0f
#define LOOK_BEYOND 20.0f

// Rays past a near corner. Whoever is pushed to the other side of an inner vertex by those who stand there would else
// be led around that vertex, and back again when it is pushed once more, for ever.
static bool look_past_corner(const crowd_step *step, uint32_t i, tl_nav_corridor *corridor)
{
    tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const float x = a->corner[2 * (size_t)i] - a->x[i], z = a->corner[2 * (size_t)i + 1] - a->z[i];
    const float near = LOOK_RADII * a->radius[i];
    if ((a->flags[i] & (CROWD_LEFT | CROWD_RIGHT)) == 0 || a->clearance[i] > 0.0f || x * x + z * z > near * near ||
        (crowd->head->step + i) % CORNER_STEPS != 0) {
        return false;
    }
    bool changed = false;
    return tl_nav_corridor_shorten(corridor, step->navmesh, &crowd->filters[a->filter[i]], near + LOOK_BEYOND,
                                   &changed) == TL_OK &&
           changed;
}

void tl_crowd_walk(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    if (head_on(step, i)) {
        return;
    }
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    if (look_past_corner(step, i, &corridor)) {
        tl_crowd_keep_corridor(crowd, i, &corridor);
    }
    tl_nav_corner corners[3];
    uint32_t count = 0;
    tl_result result = tl_nav_corridor_corners(&corridor, step->navmesh, corners, 3, &count);
    if ((result != TL_OK && result != TL_INCOMPLETE) || count < 2) {
        a->flags[i] |= CROWD_NEED_PATH;
        tl_crowd_want_to_stand(step, i);
        return;
    }
    if ((a->flags[i] & (CROWD_REACHES | CROWD_PARTIAL | CROWD_IN_QUEUE)) == 0 &&
        a->path_count[i] <= corridor.capacity / 2 && (a->flags[i] & CROWD_GAVE_UP) == 0) {
        a->flags[i] |= CROWD_NEED_PATH; // a path that was cut off: before its end is reached
    }
    // Where a link begins under the agent's feet, the first corner is the link.
    const bool links_here = (corners[0].flags & TL_NAV_CORNER_LINK) != 0;
    const tl_nav_corner *next = links_here ? &corners[0] : &corners[1];
    float x = next->point.x - a->x[i], z = next->point.z - a->z[i];
    float distance = sqrtf(x * x + z * z);
    float speed = top_speed(crowd, i);
    if ((next->flags & TL_NAV_CORNER_LINK) != 0) {
        if (distance <= LINK_SHARE * a->radius[i]) {
            a->status[i] = TL_NAV_AGENT_QUEUED;
            a->link[i] = next->link;
            tl_crowd_want_to_stand(step, i);
            return;
        }
    } else if ((next->flags & TL_NAV_CORNER_END) != 0) {
        if (distance <= a->arrive_distance[i] || is_kept_off(a, i, distance)) {
            arrive(step, i);
            return;
        }
        speed = tl_min_f32(speed, sqrtf(BRAKE_SHARE * a->max_acceleration[i] * distance));
        speed = tl_min_f32(speed, distance / step->dt);
    }
    if (hold_at_wall(step, i)) {
        return;
    }
    keep_corner(a, i, next, count >= 3 && !links_here ? &corners[2] : next);
    head_for(step, i, x, z, speed);
}

// As fast as the place, and as much faster as it is away, with the brakes of one that comes to a goal.
void tl_crowd_walk_beside(const crowd_step *step, uint32_t i, tl_vec3 place, const float velocity[2])
{
    crowd_fields *a = &step->crowd->a;
    const float x = place.x - a->x[i], z = place.z - a->z[i];
    const float distance = sqrtf(x * x + z * z);
    const float closing = tl_min_f32(sqrtf(BRAKE_SHARE * a->max_acceleration[i] * distance), distance / step->dt);
    const float rate = distance > 0.0f ? closing / distance : 0.0f;
    const float toward_x = velocity[0] + rate * x, toward_z = velocity[1] + rate * z;
    const float speed = tl_min_f32(sqrtf(toward_x * toward_x + toward_z * toward_z), a->max_speed[i]);
    tl_nav_corner ahead;
    memset(&ahead, 0, sizeof ahead);
    ahead.point = tl_vec3_make(a->x[i] + toward_x, a->y[i], a->z[i] + toward_z);
    keep_corner(a, i, &ahead, &ahead);
    a->flags[i] &= ~CROWD_CORNER;
    const bool place_moves = velocity[0] != 0.0f || velocity[1] != 0.0f;
    if (place_moves && speed < BESIDE_SHARE * a->max_speed[i]) {
        a->stalled[i] = 0.0f;
    } else {
        note_progress(step, i, toward_x, toward_z);
    }
    want(step, i, toward_x, toward_z, speed);
}

// An agent that stands at its link until it may take it; pushed away it walks back.
static void wait_for_link(const crowd_step *step, uint32_t i)
{
    crowd_fields *a = &step->crowd->a;
    a->status[i] = TL_NAV_AGENT_WALKING;
    uint64_t link = a->link[i];
    a->link[i] = TL_NAV_NO_REF;
    tl_crowd_walk(step, i);
    bool waits_on = a->status[i] == TL_NAV_AGENT_QUEUED && a->link[i] == link;
    a->next_free[i] = waits_on ? a->next_free[i] + (a->next_free[i] < UINT32_MAX) : 0;
}

void tl_crowd_steer(const crowd_step *step, uint32_t i)
{
    const uint32_t status = step->crowd->a.status[i];
    if (status == TL_NAV_AGENT_WALKING) {
        tl_crowd_walk(step, i);
    } else if (status == TL_NAV_AGENT_QUEUED) {
        wait_for_link(step, i);
    } else {
        tl_crowd_want_to_stand(step, i);
    }
}
