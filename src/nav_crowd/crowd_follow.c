// SPDX-License-Identifier: MIT
//
// Where a follower's slot is, and how it gets there.
//
// A slot is where a straight ray along the surface leads from the leader, so it is never behind a wall or on another
// floor. Where the ray is cut off, the slot is on the leader's trail, its rank times the spacing behind: in a doorway
// the formation becomes a column, and behind it a formation again. Scaling the formation to the width instead, as many
// do, needs that width, and presses all into one place where it is less than they are wide.
//
// Whoever comes to the trail before its slot does waits for it: so the column forms from those near the door outward,
// and nobody walks back.
//
// A follower walks straight to its slot where that is free, else after the leader: to the newest place of the trail
// that it sees. Only one that sees neither has a path searched.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

// Seconds that a slot stays on the trail after its ray was cut off: rays at a jamb come and go.
#define HOLD 0.5f

// One of a loose group that is too far away comes back within this share of how far it may be.
#define LOOSE_SHARE 0.8f

// Seconds that one is held up within a diameter of its slot before it stands where it is.
#define SETTLE_BESIDE 3.0f

enum {
    TRAIL_EVERY = 4,  // steps between looks for the trail
    TRAIL_RAYS = 16,  // of one look
    SEARCH_EVERY = 16 // steps between requests for a path
};

typedef struct follower_slot {
    tl_nav_location at;
    float velocity[2];
    float ahead[2]; // on the trail: where that leads, unit; else 0
} follower_slot;

static float slot_distance(const tl_nav_crowd *crowd, uint32_t i, tl_vec3 place)
{
    return tl_distance(tl_crowd_position(crowd, i), place);
}

// The end of a ray along the surface; false: it ends at a wall, whose place is `at_out` then, or nothing is known.
static bool cast_along(const crowd_step *step, uint32_t i, const tl_nav_location *from, tl_vec3 to,
                       tl_nav_location *at_out)
{
    const tl_nav_filter *filter = &step->crowd->filters[step->crowd->a.filter[i]];
    tl_nav_ray_hit hit;
    const tl_result result = tl_navmesh_cast_ray(step->navmesh, filter, from, to, NULL, 0, &hit);
    at_out->polygon = TL_NAV_NO_REF;
    if (result != TL_OK && result != TL_INCOMPLETE) {
        return false;
    }
    if (tl_navmesh_closest_point(step->navmesh, hit.polygon, hit.point, &at_out->point, NULL) == TL_OK) {
        at_out->polygon = hit.polygon;
    }
    return at_out->polygon != TL_NAV_NO_REF && !hit.hit;
}

// Where the slot stands in the formation; a loose one is where its member stands, or nearer.
static tl_vec3 plan_slot(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t i, uint32_t m)
{
    const crowd_fields *a = &crowd->a;
    const tl_vec3 leader = tl_crowd_get3(group->place, 0);
    if (group->formation == TL_NAV_FORMATION_LOOSE) {
        const float x = a->x[i] - leader.x, z = a->z[i] - leader.z;
        const float distance = sqrtf(x * x + z * z);
        const float share = distance > group->range ? LOOSE_SHARE * group->range / distance : 1.0f;
        return tl_vec3_make(leader.x + share * x, leader.y, leader.z + share * z);
    }
    float slot[2];
    tl_crowd_plan_slot(crowd, group, m, slot);
    return tl_vec3_make(leader.x + slot[0], leader.y, leader.z + slot[1]);
}

static tl_nav_location trail_place(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t back)
{
    const size_t at = (size_t)group->first + (group->trail_first + back) % group->count;
    const tl_nav_location place = { crowd->a.trail_polygon[at], tl_crowd_get3(crowd->a.trail, (uint32_t)at) };
    return place;
}

// So many metres behind the leader on its trail; false: that is not so long yet.
static bool find_on_trail(const crowd_step *step, const crowd_group *group, uint32_t i, float behind,
                          follower_slot *slot)
{
    if (group->trail_count == 0) {
        return false;
    }
    const tl_vec3 leader = tl_crowd_get3(group->place, 0);
    tl_nav_location older = trail_place(step->crowd, group, 0);
    tl_vec3 newer = leader;
    float share = behind / tl_max_f32(tl_distance(leader, older.point), FLT_MIN);
    if (share > 1.0f) {
        // A whole trail is as long as the column; by rounding, or where it was laid this very step, a little less.
        const bool is_whole = group->trail_count == group->count;
        const float most = (float)(group->trail_count - 1);
        const float past = (behind - tl_distance(leader, older.point)) / group->spacing;
        if (!(past < most) && !is_whole) {
            return false;
        }
        const uint32_t back = past < most ? (uint32_t)past : group->trail_count - 2;
        newer = trail_place(step->crowd, group, back).point;
        older = trail_place(step->crowd, group, back + 1);
        share = past - (float)back; // clamped below
    }
    // From the older place, which followers have before them. At a link the ray ends where that begins.
    tl_vec3 to = tl_lerp(newer, older.point, tl_clamp_f32(share, 0.0f, 1.0f));
    cast_along(step, i, &older, to, &slot->at);
    const float x = newer.x - older.point.x, z = newer.z - older.point.z;
    const float length = sqrtf(x * x + z * z);
    const float speed = sqrtf(group->velocity[0] * group->velocity[0] + group->velocity[1] * group->velocity[1]);
    slot->ahead[0] = length > 0.0f ? x / length : 0.0f;
    slot->ahead[1] = length > 0.0f ? z / length : 0.0f;
    slot->velocity[0] = speed * slot->ahead[0];
    slot->velocity[1] = speed * slot->ahead[1];
    return slot->at.polygon != TL_NAV_NO_REF;
}

static void stand_here(const tl_nav_crowd *crowd, uint32_t i, follower_slot *slot)
{
    slot->at.polygon = crowd->a.path[(size_t)i * crowd->def.max_path];
    slot->at.point = tl_crowd_position(crowd, i);
    slot->velocity[0] = slot->velocity[1] = 0.0f;
}

// The slot by the ray; false: cut off, and `slot` holds how far it came, if that is known.
static bool find_beside(const crowd_step *step, const crowd_group *group, uint32_t i, uint32_t m, follower_slot *slot)
{
    const tl_nav_crowd *crowd = step->crowd;
    const tl_nav_location leader = { group->polygon, tl_crowd_get3(group->place, 0) };
    bool is_free = cast_along(step, i, &leader, plan_slot(crowd, group, i, m), &slot->at);
    if (is_free && group->formation == TL_NAV_FORMATION_LOOSE &&
        fabsf(slot->at.point.y - crowd->a.y[i]) > crowd->a.height[i]) {
        is_free = false; // above or below it
    }
    slot->velocity[0] = group->velocity[0];
    slot->velocity[1] = group->velocity[1];
    slot->ahead[0] = slot->ahead[1] = 0.0f;
    return is_free;
}

// Whether a slot on the trail is still behind the agent.
static bool is_behind(const tl_nav_crowd *crowd, uint32_t i, const follower_slot *slot)
{
    const float x = crowd->a.x[i] - slot->at.point.x, z = crowd->a.z[i] - slot->at.point.z;
    return x * slot->ahead[0] + z * slot->ahead[1] > 0.0f;
}

// False: nothing is known of it now.
static bool find_slot(const crowd_step *step, const crowd_group *group, uint32_t i, uint32_t m, follower_slot *slot)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const bool moves = (group->flags & CROWD_GROUP_MOVES) != 0;
    const float behind = group->spacing * (float)(m - group->first);
    if (group->polygon == TL_NAV_NO_REF) {
        return false;
    }
    follower_slot beside;
    const bool is_column = group->formation == TL_NAV_FORMATION_COLUMN;
    const bool is_free = find_beside(step, group, i, m, &beside);
    a->held[m] = is_free ? tl_max_f32(a->held[m] - step->dt, 0.0f) : HOLD;
    *slot = beside;
    if (is_free && !is_column && !(a->held[m] > 0.0f)) {
        a->member_flags[m] = (a->member_flags[m] & CROWD_TO_TRAIL) | CROWD_EARLY;
        return true;
    }
    if (find_on_trail(step, group, i, behind, slot)) {
        a->member_flags[m] |= CROWD_ON_TRAIL;
        if (!moves || !is_behind(crowd, i, slot)) {
            a->member_flags[m] &= ~CROWD_EARLY;
        }
        if ((a->member_flags[m] & CROWD_EARLY) != 0) {
            stand_here(crowd, i, slot);
        }
        return true;
    }
    a->member_flags[m] &= ~CROWD_ON_TRAIL;
    if (moves && is_column) {
        stand_here(crowd, i, slot); // until the trail is long enough
    } else {
        *slot = beside;
    }
    return slot->at.polygon != TL_NAV_NO_REF;
}

// ---------------------------------------------------------------------------------------------------------
// The way there.

// Whether the straight way to a place is free; then the corridor is that way.
static bool take_straight_way(const crowd_step *step, uint32_t i, const tl_nav_location *to)
{
    tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    tl_nav_ref polygons[CROWD_MAX_PATH];
    uint32_t count = 1;
    tl_vec3 target = to->point;
    if (corridor.path[0] != to->polygon) {
        const tl_nav_location from = { corridor.path[0], corridor.position };
        tl_nav_ray_hit hit;
        if (tl_navmesh_cast_ray(step->navmesh, &crowd->filters[a->filter[i]], &from, to->point, polygons,
                                corridor.capacity, &hit) != TL_OK ||
            hit.hit || tl_navmesh_closest_point(step->navmesh, hit.polygon, hit.point, &target, NULL) != TL_OK ||
            fabsf(target.y - to->point.y) > a->height[i]) { // on another floor
            return false;
        }
        count = hit.polygon_count;
        memcpy(corridor.path, polygons, count * sizeof *polygons);
    }
    corridor.count = count;
    corridor.target = target;
    corridor.reaches = true;
    tl_crowd_keep_corridor(crowd, i, &corridor);
    return true;
}

// The newest place of the trail that the agent sees.
static bool take_way_to_trail(const crowd_step *step, const crowd_group *group, uint32_t i)
{
    const uint32_t stride = (group->trail_count + TRAIL_RAYS - 1) / TRAIL_RAYS;
    for (uint32_t back = 0; back < group->trail_count; back += stride) {
        const tl_nav_location place = trail_place(step->crowd, group, back);
        if (take_straight_way(step, i, &place)) {
            return true;
        }
    }
    return false;
}

// Whether the corridor's end could follow the slot.
static bool move_way_end(const crowd_step *step, uint32_t i, const tl_nav_location *to, tl_nav_query *query)
{
    tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    if (!corridor.reaches || tl_nav_corridor_move_target(&corridor, query, step->navmesh, &crowd->filters[a->filter[i]],
                                                         to->point) != TL_OK) {
        return false;
    }
    tl_crowd_keep_corridor(crowd, i, &corridor);
    return tl_distance(corridor.target, to->point) <= a->radius[i];
}

static void find_way_to_slot(const crowd_step *step, const crowd_group *group, uint32_t i, const tl_nav_location *to,
                             tl_nav_query *query)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t m = a->member[i] - 1;
    const uint64_t turn = crowd->head->step + i;
    if ((a->member_flags[m] & CROWD_TO_TRAIL) == 0 && move_way_end(step, i, to, query)) {
        return;
    }
    if (turn % TRAIL_EVERY != 0) {
        return;
    }
    // Whoever stands on the trail already and sees the slot from nowhere needs a path: a link, or the trail was cut.
    const bool sees_trail = take_way_to_trail(step, group, i);
    const bool is_at_end = slot_distance(crowd, i, tl_crowd_get3(a->target, i)) <= a->radius[i];
    if (sees_trail && !is_at_end) {
        a->member_flags[m] |= CROWD_TO_TRAIL;
    } else if (turn % SEARCH_EVERY == 0 && (is_at_end || a->path_count[i] == 1)) {
        a->flags[i] |= CROWD_NEED_PATH;
        a->member_flags[m] &= ~CROWD_TO_TRAIL;
    }
}

// Whether it may stay where it is: in its slot, or before others where those let it come no nearer.
static bool is_done(const tl_nav_crowd *crowd, uint32_t i, const tl_nav_location *slot, float distance)
{
    const crowd_fields *a = &crowd->a;
    const uint32_t m = a->member[i] - 1;
    const float stay = a->arrive_distance[i];
    if (distance <= stay) {
        return true;
    }
    if (a->status[i] == TL_NAV_AGENT_WALKING && distance <= 2.0f * a->radius[i] && a->stalled[i] > SETTLE_BESIDE) {
        return true;
    }
    const float moved = tl_distance(tl_crowd_get3(a->slot, m), slot->point);
    return a->status[i] == TL_NAV_AGENT_ARRIVED && moved <= stay && a->stalled[i] > 0.0f &&
           distance <= a->stalled[i] + a->radius[i];
}

void tl_crowd_follow(const crowd_step *step, uint32_t i, tl_nav_query *query)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    const uint32_t m = a->member[i] - 1;
    const crowd_group *group = &a->groups[a->member_group[m]];
    follower_slot slot;
    if (!find_slot(step, group, i, m, &slot)) {
        tl_crowd_want_to_stand(step, i);
        return;
    }
    a->lag[m] = slot_distance(crowd, i, slot.at.point);
    const bool is_there = (group->flags & CROWD_GROUP_MOVES) == 0 && is_done(crowd, i, &slot.at, a->lag[m]);
    if (!is_there || a->status[i] != TL_NAV_AGENT_ARRIVED) {
        tl_crowd_set3(a->slot, m, slot.at.point);
        a->slot_polygon[m] = slot.at.polygon;
    }
    if (is_there) {
        a->stalled[i] = a->status[i] == TL_NAV_AGENT_ARRIVED ? a->stalled[i]
                        : a->lag[m] > a->arrive_distance[i]  ? a->lag[m]
                                                             : 0.0f;
        a->status[i] = TL_NAV_AGENT_ARRIVED;
        a->link[i] = TL_NAV_NO_REF;
        tl_crowd_want_to_stand(step, i);
        return;
    }
    if (take_straight_way(step, i, &slot.at)) {
        a->status[i] = TL_NAV_AGENT_WALKING;
        a->link[i] = TL_NAV_NO_REF;
        a->flags[i] &= ~(CROWD_PARTIAL | CROWD_GAVE_UP | CROWD_NEED_PATH | CROWD_ASK_LATER);
        a->member_flags[m] &= ~CROWD_TO_TRAIL;
        tl_crowd_walk_beside(step, i, slot.at.point, slot.velocity);
        return;
    }
    find_way_to_slot(step, group, i, &slot.at, query);
    if (a->status[i] != TL_NAV_AGENT_QUEUED && a->path_count[i] > 1) {
        a->status[i] = TL_NAV_AGENT_WALKING;
    }
    tl_crowd_steer(step, i);
    if (a->status[i] == TL_NAV_AGENT_ARRIVED) { // at the end of a way that is not its slot
        a->status[i] = TL_NAV_AGENT_WALKING;
        a->stalled[i] = 0.0f;
    }
}
