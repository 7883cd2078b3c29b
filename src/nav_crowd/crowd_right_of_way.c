// SPDX-License-Identifier: MIT
//
// Right of way. ORCA alone stops where two flows meet in a door: each agent's answer is the best one, and it is to
// stand. Four rules change what agents want, never what they may do:
//
//   right    whoever meets others that come the other way keeps to the right, so that flows divide into lanes
//   yield    where that is not enough, whoever is held up by one that still gets on goes back until those have passed:
//   a
//            flow keeps a door as long as it moves through it. Where neither gets on, the flow goes back whose travel
//            is farther from a common direction, which turns by the golden angle: nobody needs to know who is in which
//   aside    whoever stands in the way of one that is held up steps aside, and returns later
//   settle   whoever is held up by those that have arrived at its goal has arrived too
//
// All agents of a flow decide alike, as they compare where they travel past their next corner, not themselves; those
// behind follow those in front. Directions that took turns by the clock alone were slower by half: each turn cut off a
// flow that moved.

#include "base/lowest_bit.h"
#include "base/min_max.h"
#include "nav_crowd/crowd_neighbors.h"

// Two directions are against one another when their cosine is below this.
#define AGAINST_COSINE (-0.3f)

// One that yields is followed when it stands within this cone: wider ones let some follow one another in a ring.
#define BEFORE_COSINE 0.7f

// To the right by about 20 degrees.
#define RIGHT_COSINE 0.94f
#define RIGHT_SINE   0.342f

// Seconds that an agent is held up before it goes back, how long it does so at most, and before it settles.
#define YIELD_AFTER    0.5f
#define YIELD_FOR      28.0f
#define SETTLE_AFTER   0.5f
#define SETTLE_LATE    3.0f // beside those who stand there for another goal, or behind a corner
#define SETTLE_AMID    8.0f // beside those who walk, but hardly come past

#define STANDING_SPEED 0.2f   // metres a second: who wants less does not claim a door
#define YIELD_SPEED    0.5f   // of the top speed
#define TURN_MS        24000u // how long one direction has the right of way where neither flow moves

// An agent that stands steps aside for those within so many of its radii, at a part of its speed: a little along their
// way, and off it.
#define ASIDE_RADII 1.0f
#define ASIDE_SPEED 0.4f
#define ASIDE_ALONG 0.3f

// Rims that are so near touch, as a share of the radius.
#define RIM_TOUCH_SHARE 0.5f

// Of the golden angle, 2.39996 radians: multiples of it come near no direction too often.
#define GOLDEN_COSINE (-0.7373688780783197)
#define GOLDEN_SINE   0.6754902942615238

void tl_crowd_preferred_direction(uint64_t milliseconds, float out[2])
{
    // Powers of a rotation, without a sine: squared and multiplied.
    double x = 1.0, z = 0.0;
    double c = GOLDEN_COSINE, s = GOLDEN_SINE;
    for (uint32_t turn = (uint32_t)(milliseconds / TURN_MS % 1024); turn != 0; turn >>= 1) {
        if ((turn & 1) != 0) {
            double t = x * c - z * s;
            z = x * s + z * c;
            x = t;
        }
        double t = c * c - s * s;
        s = 2.0 * c * s;
        c = t;
    }
    out[0] = (float)x;
    out[1] = (float)z;
}

typedef struct crowd_traffic {
    bool meets;   // others that come the other way
    bool loses;   // if held: the right of way to one of them: one that gets on, or goes the preferred direction
    bool follows; // if held: one that yields
} crowd_traffic;

// Where one of the others goes, as a vector of any length. Fixed ones go where they move. `now`: by what it wants at
// present, not by where it travels.
static void way_of(const crowd_snapshot *seen, uint32_t other, bool now, float its[2])
{
    const uint32_t kind = seen->kind[other];
    tl_crowd_travel(kind, its);
    its[0] = now ? seen->wanted_x[other] : its[0];
    its[1] = now ? seen->wanted_z[other] : its[1];
    its[0] = (kind & CROWD_SEEN_FIXED) != 0 ? seen->vx[other] : its[0];
    its[1] = (kind & CROWD_SEEN_FIXED) != 0 ? seen->vz[other] : its[1];
}

// Whether one of the others may come the other way, by all that takes no root: most go elsewhere. Who wants to stand,
// as a leader that waits for its group, needs no way, whatever lies before it. Without a branch: they are of all kinds.
static bool may_come_against(const crowd_snapshot *seen, uint32_t other, const float travel[2], const float its[2])
{
    const float x = seen->wanted_x[other], z = seen->wanted_z[other];
    const bool moves =
        (x * x + z * z >= STANDING_SPEED * STANDING_SPEED) | ((seen->kind[other] & CROWD_SEEN_FIXED) != 0);
    return moves & (its[0] * travel[0] + its[1] * travel[1] < 0.0f);
}

// Whether it does; makes its way a unit vector.
static bool comes_against(const crowd_snapshot *seen, uint32_t other, const float travel[2], float its[2])
{
    if (!may_come_against(seen, other, travel, its)) {
        return false;
    }
    const float length = sqrtf(its[0] * its[0] + its[1] * its[1]);
    its[0] /= length;
    its[1] /= length;
    return its[0] * travel[0] + its[1] * travel[1] < AGAINST_COSINE;
}

// The group that an agent leads, or NULL. Its followers make way for it, not it for them.
static const crowd_group *led_by(const tl_nav_crowd *crowd, uint32_t i)
{
    const crowd_group *group = tl_crowd_group_of(crowd, i);
    return group != NULL && !tl_crowd_follows(crowd, i) ? group : NULL;
}

// Whether an agent's goal is farther away than another agent is: else it ends before they meet.
static bool goes_past(const tl_nav_crowd *crowd, uint32_t k, float apart_sq)
{
    const tl_vec3 goal = tl_crowd_get3(crowd->a.goal, crowd->seen.agent[k]);
    const float x = goal.x - crowd->seen.x[k], z = goal.z - crowd->seen.z[k];
    return x * x + z * z > apart_sq;
}

// Whether one that comes the other way has the right of way: both unit directions. Who has been held up for long goes
// before who has not; else who gets on, and where neither does, by the common direction.
static bool loses_to(const crowd_step *step, uint32_t k, uint32_t other, const float mine[2], const float its[2])
{
    const crowd_snapshot *seen = &step->crowd->seen;
    const float x = seen->x[other] - seen->x[k], z = seen->z[other] - seen->z[k];
    const float apart_sq = x * x + z * z;
    const uint32_t claims = seen->kind[k] & CROWD_SEEN_CLAIMS, its_claims = seen->kind[other] & CROWD_SEEN_CLAIMS;
    const float *preferred = step->preferred;
    const bool loses = claims != its_claims ? its_claims != 0
                                            : (seen->kind[other] & CROWD_SEEN_STALLED) == 0 ||
                                                  its[0] * preferred[0] + its[1] * preferred[1] >
                                                      mine[0] * preferred[0] + mine[1] * preferred[1];
    return loses && goes_past(step->crowd, k, apart_sq) && goes_past(step->crowd, other, apart_sq);
}

// What an agent looks at traffic with.
typedef struct crowd_outlook {
    float ahead[2];  // unit: where it heads now
    float travel[2]; // unit: where it goes past its corner
    bool held;       // for so long that it may go back: else it only keeps to the right
    bool late;       // others are taken by what they want at present, not by where they travel
} crowd_outlook;

// The neighbours before an agent, a bit each, that may come the other way; and those that yield, where it is held.
static uint32_t find_traffic(const crowd_snapshot *seen, uint32_t k, const crowd_outlook *look,
                             const crowd_neighbor *neighbors, uint32_t count)
{
    const float x = seen->x[k], z = seen->z[k];
    uint32_t found = 0;
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t other = neighbors[n].snapshot, kind = seen->kind[other];
        float its[2];
        way_of(seen, other, look->late, its);
        const bool is_before = (seen->x[other] - x) * look->ahead[0] + (seen->z[other] - z) * look->ahead[1] > 0.0f;
        const bool yields = (kind & CROWD_SEEN_YIELDS) != 0, stands = (kind & CROWD_SEEN_STILL) != 0;
        const bool counts = yields ? look->held : may_come_against(seen, other, look->travel, its);
        found |= (uint32_t)(is_before & !stands & counts) << n;
    }
    return found;
}

static crowd_traffic look_at_traffic(const crowd_step *step, uint32_t k, const crowd_outlook *look,
                                     const crowd_neighbor *neighbors, uint32_t count)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_snapshot *seen = &crowd->seen;
    crowd_traffic traffic = { false, false, false };
    const crowd_group *led = led_by(crowd, seen->agent[k]);
    for (uint32_t left = find_traffic(seen, k, look, neighbors, count); left != 0; left &= left - 1) {
        const uint32_t other = neighbors[tl_lowest_bit(left)].snapshot;
        if (led != NULL && tl_crowd_group_of(crowd, seen->agent[other]) == led) {
            continue;
        }
        float its[2];
        way_of(seen, other, look->late, its);
        const bool is_against = comes_against(seen, other, look->travel, its);
        if ((seen->kind[other] & CROWD_SEEN_YIELDS) != 0) {
            // It goes back the way that this one comes.
            const float *ahead = look->ahead;
            float dx = seen->x[other] - seen->x[k], dz = seen->z[other] - seen->z[k];
            bool is_before = dx * ahead[0] + dz * ahead[1] > BEFORE_COSINE * sqrtf(dx * dx + dz * dz);
            float back = seen->wanted_x[other] * ahead[0] + seen->wanted_z[other] * ahead[1];
            traffic.follows = traffic.follows || (is_before && !is_against && back < 0.0f);
        } else if (is_against) {
            traffic.meets = true;
            if (!look->held) {
                break;
            }
            traffic.loses = traffic.loses || loses_to(step, k, other, look->travel, its);
        }
    }
    return traffic;
}

bool tl_crowd_has_goal_of(const tl_nav_crowd *crowd, uint32_t i, uint32_t other)
{
    const crowd_fields *a = &crowd->a;
    const tl_vec3 goal = tl_crowd_get3(a->goal, i), its = tl_crowd_get3(a->goal, other);
    float x = its.x - goal.x, z = its.z - goal.z;
    const float rims = a->radius[i] + a->radius[other];
    return (a->flags[i] & CROWD_HAS_GOAL) != 0 && x * x + z * z <= rims * rims && fabsf(its.y - goal.y) < a->height[i];
}

// Whether an agent touches one that has arrived at the same goal and stands nearer to it; or any that wants to get
// there, where it stands at the goal itself. Who stands there for another goal steps aside: where that does not help
// for long, the agent has come as near as it can, too.
static bool stands_before_goal(const tl_nav_crowd *crowd, uint32_t k, const crowd_neighbor *neighbors, uint32_t count)
{
    const crowd_snapshot *seen = &crowd->seen;
    const uint32_t i = seen->agent[k];
    const tl_vec3 goal = tl_crowd_get3(crowd->a.goal, i);
    const float x = goal.x - seen->x[k], z = goal.z - seen->z[k];
    const float diameter = 2.0f * seen->radius[k];
    for (uint32_t n = 0; n < count && neighbors[n].gap < RIM_TOUCH_SHARE * seen->radius[k]; n++) {
        const uint32_t other = neighbors[n].snapshot;
        const bool is_still = (seen->kind[other] & CROWD_SEEN_STILL) != 0;
        float ox = goal.x - seen->x[other], oz = goal.z - seen->z[other];
        const bool is_before = is_still && ox * ox + oz * oz < x * x + z * z;
        const bool is_near = x * x + z * z < diameter * diameter;
        if (is_near && crowd->a.stalled[i] > (is_still ? SETTLE_LATE : SETTLE_AMID)) {
            return true;
        }
        // Around a corner the throng before the goal may be farther from it than who comes to its end.
        const float ahead =
            (seen->x[other] - seen->x[k]) * crowd->a.wanted_x[i] + (seen->z[other] - seen->z[k]) * crowd->a.wanted_z[i];
        const bool is_end = is_still && ahead > 0.0f && crowd->a.stalled[i] > SETTLE_LATE;
        if ((is_before || is_near || is_end) && tl_crowd_has_goal_of(crowd, i, neighbors[n].agent)) {
            return true;
        }
    }
    return false;
}

// An agent that stands steps aside for one that it holds up, and walks back to its goal when nobody is there any more.
static void step_aside(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbors, uint32_t count)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const crowd_snapshot *seen = &crowd->seen;
    const uint32_t i = seen->agent[k];
    bool is_free = true;
    for (uint32_t n = 0; n < count && neighbors[n].gap < ASIDE_RADII * seen->radius[k]; n++) {
        const uint32_t other = neighbors[n].snapshot;
        float x = seen->wanted_x[other], z = seen->wanted_z[other];
        float length = sqrtf(x * x + z * z);
        // One that stands and wants to move makes way itself: it is let out where it goes.
        const bool makes_way = (seen->kind[other] & CROWD_SEEN_STILL) != 0 && length > 0.0f;
        if (!makes_way && tl_crowd_has_goal_of(crowd, i, neighbors[n].agent)) {
            continue;
        }
        float dx = seen->x[k] - seen->x[other], dz = seen->z[k] - seen->z[other];
        is_free = is_free && !(length > 0.0f);
        if (((seen->kind[other] & CROWD_SEEN_STALLED) != 0 || makes_way) && x * dx + z * dz > 0.0f) {
            float side = x * dz - z * dx >= 0.0f ? 1.0f : -1.0f;
            float speed = ASIDE_SPEED * a->max_speed[i] / length;
            float across = makes_way ? ASIDE_ALONG * side : side, along = makes_way ? 1.0f : ASIDE_ALONG;
            a->wanted_x[i] = speed * (along * x - across * z);
            a->wanted_z[i] = speed * (along * z + across * x);
            return;
        }
    }
    float stay = tl_max_f32(a->stalled[i], a->arrive_distance[i]) + a->radius[i];
    if (is_free && a->status[i] == TL_NAV_AGENT_ARRIVED && tl_crowd_distance_to_goal(crowd, i) > stay) {
        a->status[i] = TL_NAV_AGENT_WALKING;
        a->stalled[i] = 0.0f;
    }
}

void tl_crowd_give_way(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbors, uint32_t count)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t i = crowd->seen.agent[k];
    const float ahead[2] = { a->wanted_x[i], a->wanted_z[i] };
    const float length = sqrtf(ahead[0] * ahead[0] + ahead[1] * ahead[1]);
    a->flags[i] &= ~CROWD_YIELDS;
    // In its slot, beside a leader that is held up, or waiting for its group: it wants to stand.
    const float slow = tl_crowd_follows(crowd, i) ? STANDING_SPEED : 0.0f;
    if (tl_crowd_stands(a->status[i]) || length <= slow) {
        step_aside(step, k, neighbors, count);
        return;
    }
    if (a->stalled[i] > SETTLE_AFTER && (a->flags[i] & CROWD_REACHES) != 0 &&
        stands_before_goal(crowd, k, neighbors, count)) {
        a->status[i] = TL_NAV_AGENT_ARRIVED;
        a->wanted_x[i] = 0.0f;
        a->wanted_z[i] = 0.0f;
        a->stalled[i] = tl_crowd_distance_to_goal(crowd, i);
        return;
    }
    const float x = ahead[0] / length, z = ahead[1] / length;
    // Two in a corner may hold each other up for ever though they travel the same way.
    const bool is_held = a->stalled[i] > YIELD_AFTER, is_late = a->stalled[i] > YIELD_AFTER + YIELD_FOR;
    float travel[2];
    tl_crowd_travel(a->flags[i], travel);
    const float far = sqrtf(travel[0] * travel[0] + travel[1] * travel[1]);
    const bool is_known = far > 0.0f && !is_late;
    const crowd_outlook look = {
        { x, z }, { is_known ? travel[0] / far : x, is_known ? travel[1] / far : z }, is_held, is_late
    };
    const crowd_traffic traffic = look_at_traffic(step, k, &look, neighbors, count);
    // In the open they pass one another: only where walls leave little room somebody must go back.
    const bool is_narrow = a->wall_count[i] > 0;
    const bool loses = traffic.loses && is_narrow;
    if (!loses && traffic.follows && is_late) {
        a->stalled[i] = 0.0f; // some that follow one another in a ring would do so for ever
    }
    if (is_held && (loses || traffic.follows)) {
        a->flags[i] |= CROWD_YIELDS;
        a->wanted_x[i] = -YIELD_SPEED * a->max_speed[i] * x;
        a->wanted_z[i] = -YIELD_SPEED * a->max_speed[i] * z;
    } else if (traffic.meets) {
        a->wanted_x[i] = length * (RIGHT_COSINE * x - RIGHT_SINE * z);
        a->wanted_z[i] = length * (RIGHT_SINE * x + RIGHT_COSINE * z);
    }
}
