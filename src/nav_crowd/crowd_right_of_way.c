// SPDX-License-Identifier: MIT
//
// Right of way. ORCA alone stops where two flows meet in a door: each agent's answer is the best one, and it is to
// stand. Four rules change what agents want, never what they may do:
//
//   right    whoever meets others that come the other way keeps to the right, so that flows divide into lanes
//   yield    where that is not enough, whoever is held up by one that still gets on goes back until those have passed:
//            a flow keeps a door as long as it moves through it. Where neither gets on, the flow goes back whose travel
//            is farther from a common direction, which turns by the golden angle: nobody needs to know who is in which
//   aside    whoever stands in the way of one that is held up steps aside, and returns later
//   settle   whoever is held up by those that have arrived at its goal has arrived too
//
// All agents of a flow decide alike, as they compare where they travel past their next corner, not themselves; those
// behind follow those in front. Directions that took turns by the clock alone were slower by half: each turn cut off a
// flow that moved.

#include "nav_crowd/crowd_right_of_way.h"

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
#define YIELD_AFTER  0.5f
#define YIELD_FOR    28.0f
#define SETTLE_AFTER 0.5f
#define SETTLE_LATE  3.0f // beside those who stand there for another goal, or behind a corner
#define SETTLE_AMID  8.0f // beside those who walk, but hardly come past

#define YIELD_SPEED  0.5f   // of the top speed
#define TURN_MS      24000u // how long one direction has the right of way where neither flow moves

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

// The group that an agent leads, or NULL. Its followers make way for it, not it for them.
static const crowd_group *led_by(const tl_nav_crowd *crowd, uint32_t i)
{
    const crowd_group *group = tl_crowd_group_of(crowd, i);
    return group != NULL && !tl_crowd_follows(crowd, i) ? group : NULL;
}

// Whether an agent's goal is farther away than another agent is: else it ends before they meet.
static bool goes_past(const tl_nav_crowd *crowd, const crowd_seen_agent *one, float apart_sq)
{
    const tl_vec3 goal = tl_crowd_get3(crowd->a.goal, one->agent);
    const float x = goal.x - one->x, z = goal.z - one->z;
    return x * x + z * z > apart_sq;
}

// Who has been held up for long goes before who has not, and who is shut off from its goal after all others: it has
// nowhere to go, and presses on before a shut door for as long as that is shut.
static uint32_t rank_of(const crowd_seen_agent *one)
{
    return (one->kind & CROWD_SEEN_CUT_OFF) != 0 ? 0 : (one->kind & CROWD_SEEN_CLAIMS) != 0 ? 2 : 1;
}

// Whether one that comes the other way has the right of way: both unit directions. By rank; else who gets on, and where
// neither does, by the common direction.
static bool loses_to(const crowd_step *step, const crowd_seen_agent *own, const crowd_seen_agent *other,
                     const float mine[2], const float its[2])
{
    const float x = other->x - own->x, z = other->z - own->z;
    const float apart_sq = x * x + z * z;
    const uint32_t rank = rank_of(own), its_rank = rank_of(other);
    const float *preferred = step->preferred;
    const bool loses = rank != its_rank ? its_rank > rank
                                        : (other->kind & CROWD_SEEN_STALLED) == 0 ||
                                              its[0] * preferred[0] + its[1] * preferred[1] >
                                                  mine[0] * preferred[0] + mine[1] * preferred[1];
    return loses && goes_past(step->crowd, own, apart_sq) && goes_past(step->crowd, other, apart_sq);
}

// Whether it comes the other way; makes its way a unit vector.
static bool is_against(const float travel[2], float its[2])
{
    const float length = sqrtf(its[0] * its[0] + its[1] * its[1]);
    its[0] /= length;
    its[1] /= length;
    return its[0] * travel[0] + its[1] * travel[1] < AGAINST_COSINE;
}

// Whether one that yields, and does not come the other way, goes back the way that this one comes.
static bool walks_back_before(const crowd_view *view, uint32_t n, const float ahead[2])
{
    const float x = view->discs.x[n], z = view->discs.z[n];
    return x * ahead[0] + z * ahead[1] > BEFORE_COSINE * sqrtf(x * x + z * z) &&
           view->wanted_x[n] * ahead[0] + view->wanted_z[n] * ahead[1] < 0.0f;
}

// Who is not shut off does not go back with those who are.
static bool takes_along(const crowd_seen_agent *own, const crowd_seen_agent *other)
{
    return (own->kind & CROWD_SEEN_CUT_OFF) != 0 || (other->kind & CROWD_SEEN_CUT_OFF) == 0;
}

static crowd_traffic look_at_traffic(const crowd_step *step, uint32_t k, const crowd_outlook *look,
                                     const crowd_neighbor *neighbors, const crowd_view *view)
{
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_seen_agent *own = &crowd->seen.agents[k];
    const crowd_group *led = led_by(crowd, own->agent);
    // Most are no traffic. Who wants to stand, as a leader that waits for its group, needs no way, whatever lies before
    // it.
    const crowd_traffic_bits bits = tl_crowd_best_kernels()->traffic(view, look);
    const uint32_t against = bits.against & (bits.quick | view->fixed);
    const uint32_t counts = look->held ? against | view->yields : against & ~view->yields;
    const uint32_t all = tl_crowd_neighbor_bits(view->discs.count);
    crowd_traffic traffic = { false, false, false };
    for (uint32_t left = bits.ahead & counts & ~view->still & all; left != 0; left &= left - 1) {
        const uint32_t n = tl_lowest_bit(left);
        if (led != NULL && tl_crowd_group_of(crowd, neighbors[n].agent) == led) {
            continue;
        }
        float its[2] = { look->late ? view->wanted_x[n] : view->way_x[n],
                         look->late ? view->wanted_z[n] : view->way_z[n] };
        const bool meets = (against >> n & 1u) != 0 && is_against(look->travel, its);
        if ((view->yields >> n & 1u) != 0) {
            traffic.follows = traffic.follows || (!meets && walks_back_before(view, n, look->ahead) &&
                                                  takes_along(own, &crowd->seen.agents[neighbors[n].snapshot]));
        } else if (meets) {
            traffic.meets = true;
            if (!look->held) {
                break;
            }
            const crowd_seen_agent *other = &crowd->seen.agents[neighbors[n].snapshot];
            traffic.loses = traffic.loses || loses_to(step, own, other, look->travel, its);
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
    const crowd_seen_agent *agents = crowd->seen.agents, *own = &agents[k];
    const uint32_t i = own->agent;
    const tl_vec3 goal = tl_crowd_get3(crowd->a.goal, i);
    const float x = goal.x - own->x, z = goal.z - own->z;
    const float diameter = 2.0f * own->radius;
    for (uint32_t n = 0; n < count && neighbors[n].gap < RIM_TOUCH_SHARE * own->radius; n++) {
        const crowd_seen_agent *other = &agents[neighbors[n].snapshot];
        const bool is_still = (other->kind & CROWD_SEEN_STILL) != 0;
        float ox = goal.x - other->x, oz = goal.z - other->z;
        const bool is_before = is_still && ox * ox + oz * oz < x * x + z * z;
        const bool is_near = x * x + z * z < diameter * diameter;
        if (is_near && crowd->a.stalled[i] > (is_still ? SETTLE_LATE : SETTLE_AMID)) {
            return true;
        }
        // Around a corner the throng before the goal may be farther from it than who comes to its end.
        const float ahead = (other->x - own->x) * crowd->a.wanted_x[i] + (other->z - own->z) * crowd->a.wanted_z[i];
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
    const crowd_seen_agent *agents = crowd->seen.agents, *own = &agents[k];
    const uint32_t i = own->agent;
    bool is_free = true;
    for (uint32_t n = 0; n < count && neighbors[n].gap < ASIDE_RADII * own->radius; n++) {
        const crowd_seen_agent *other = &agents[neighbors[n].snapshot];
        float x = other->wanted_x, z = other->wanted_z;
        float length = sqrtf(x * x + z * z);
        // One that stands and wants to move makes way itself: it is let out where it goes.
        const bool makes_way = (other->kind & CROWD_SEEN_STILL) != 0 && length > 0.0f;
        if (!makes_way && tl_crowd_has_goal_of(crowd, i, neighbors[n].agent)) {
            continue;
        }
        float dx = own->x - other->x, dz = own->z - other->z;
        is_free = is_free && !(length > 0.0f);
        if (((other->kind & CROWD_SEEN_STALLED) != 0 || makes_way) && x * dx + z * dz > 0.0f) {
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

void tl_crowd_give_way(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbors, const crowd_view *view)
{
    const uint32_t count = view->discs.count;
    const tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t i = crowd->seen.agents[k].agent;
    const float ahead[2] = { a->wanted_x[i], a->wanted_z[i] };
    const float length = sqrtf(ahead[0] * ahead[0] + ahead[1] * ahead[1]);
    a->flags[i] &= ~CROWD_YIELDS;
    // In its slot, beside a leader that is held up, or waiting for its group: it wants to stand.
    const float slow = tl_crowd_follows(crowd, i) ? CROWD_STANDING_SPEED : 0.0f;
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
    const crowd_traffic traffic = look_at_traffic(step, k, &look, neighbors, view);
    // In the open they pass one another: only where walls leave little room somebody must go back.
    const bool is_narrow = a->wall_count[i] > 0;
    const bool loses = traffic.loses && is_narrow;
    if (!loses && traffic.follows && is_late) {
        a->stalled[i] = 0.0f; // some that follow one another in a ring would do so for ever
    }
    if (a->stalled[i] > YIELD_AFTER && (loses || traffic.follows)) {
        a->flags[i] |= CROWD_YIELDS;
        a->wanted_x[i] = -YIELD_SPEED * a->max_speed[i] * x;
        a->wanted_z[i] = -YIELD_SPEED * a->max_speed[i] * z;
    } else if (traffic.meets) {
        a->wanted_x[i] = length * (RIGHT_COSINE * x - RIGHT_SINE * z);
        a->wanted_z[i] = length * (RIGHT_SINE * x + RIGHT_COSINE * z);
    }
}
