// SPDX-License-Identifier: MIT
//
// The inside of a crowd: its state, one block of bytes with an array for each field, and the scratch of a step.
//
// Arrays of fields instead of an array of agents: most passes read two or three fields of all agents. What agents show
// one another is copied once a step, side by side. The state holds no pointer, so that saving it is a copy.

#ifndef TALUS_SRC_NAV_CROWD_CROWD_H
#define TALUS_SRC_NAV_CROWD_CROWD_H

#include "base/host.h"
#include "nav_crowd/slot_deal.h"

#include <talus/nav_around.h>
#include <talus/nav_corridor.h>
#include <talus/nav_crowd.h>

#include <math.h>
#include <stdatomic.h>

enum {
    CROWD_MAX_WALLS = 8,      ///< that an agent keeps
    CROWD_MAX_NEIGHBORS = 32, ///< that a def may ask for
    CROWD_BLOCK = 64,         ///< agents of one task
    CROWD_FREE = 15,          ///< status of a place without an agent
    CROWD_MAX_PATH = 1024,    ///< that a def may ask for
    CROWD_MAX_SHARED = 8,     ///< goals whose paths are found together
};

// What numbers of a crowd may be, so that no product of two of them overflows a float.
#define CROWD_MAX_SIZE   1000.0f ///< metres, or metres a second
#define CROWD_MAX_NUMBER 1e9f    ///< coordinates, velocities of fixed agents, accelerations

/// A polygon that was removed under an agent, or under its goal, is sought anew within so many radii to each side, and
/// within the agent's height.
#define CROWD_RELOCATE_RADII 2.0f

/// A wide agent that hardly comes forward for so long is kept off its goal by walls: no farther from it than so many
/// times what it is wider than the mesh was baked for, it has arrived. In a corner of a right angle it is 1.4 times.
#define CROWD_KEPT_OFF_AFTER 1.0f ///< seconds
#define CROWD_KEPT_OFF_REACH 2.0f
/// Elsewhere it is held before a gap that is too narrow.
#define CROWD_HELD_AFTER 3.0f ///< seconds

#define CROWD_CACHE_LINE 64 ///< bytes
#define CROWD_NO_PLACE   UINT32_MAX
#define CROWD_MAGIC      0x44574f52u ///< "ROWD"
#define CROWD_VERSION    4u

// Flags of an agent.
#define CROWD_HAS_GOAL  1u
#define CROWD_REACHES   2u  ///< the corridor ends at the goal
#define CROWD_PARTIAL   4u  ///< proven: no path leads to the goal, the corridor ends as near to it as one does
#define CROWD_GAVE_UP   8u  ///< the last search was out of nodes
#define CROWD_NEED_PATH 16u ///< asks for a search
#define CROWD_IN_QUEUE  32u
#define CROWD_YIELDS    64u  ///< it goes back from a throng that comes the other way
#define CROWD_CORNER    128u ///< its corner is known, and how the path turns there:
#define CROWD_LEFT      256u
#define CROWD_RIGHT     512u
#define CROWD_ASK_LATER 1024u ///< shut off from its goal, before and after an edit: asks anew when its turn comes
#define CROWD_ALL_FLAGS 2047u

// The upper half of the flags, and of what others see: where the agent travels, past its next corner. Two signed bytes,
// x and z of a direction in parts of 127: enough to tell who comes the other way. Both 0: nowhere.
#define CROWD_TRAVEL_SHIFT 16
#define CROWD_TRAVEL_MASK  0xffff0000u

/// The state's fields: type, name, items for each agent. 64-bit fields come first.
#define CROWD_FIELDS(FIELD)                                                                                            \
    FIELD(uint64_t, goal_polygon, 1)                                                                                   \
    FIELD(uint64_t, link, 1)        /* that is taken or waited for; else TL_NAV_NO_REF */                              \
    FIELD(uint64_t, path, max_path) /* the corridor */                                                                 \
    FIELD(uint32_t, generation, 1)                                                                                     \
    FIELD(uint32_t, status, 1)                                                                                         \
    FIELD(uint32_t, flags, 1)                                                                                          \
    FIELD(uint32_t, member, 1)     /* its place among the members of groups, and 1; 0: none */                         \
    FIELD(uint32_t, next_free, 1)  /* of a free place; else steps that a link was waited for */                        \
    FIELD(uint32_t, path_count, 1) /* 0: fixed */                                                                      \
    FIELD(uint32_t, queue, 1)      /* a ring of places that wait for a path, the oldest at queue_first */              \
    FIELD(float, x, 1)                                                                                                 \
    FIELD(float, y, 1)                                                                                                 \
    FIELD(float, z, 1)                                                                                                 \
    FIELD(float, vx, 1)                                                                                                \
    FIELD(float, vy, 1)                                                                                                \
    FIELD(float, vz, 1)                                                                                                \
    FIELD(float, wanted_x, 1)                                                                                          \
    FIELD(float, wanted_z, 1)                                                                                          \
    FIELD(float, radius, 1)                                                                                            \
    FIELD(float, height, 1)                                                                                            \
    FIELD(float, max_speed, 1)                                                                                         \
    FIELD(float, max_acceleration, 1)                                                                                  \
    FIELD(float, arrive_distance, 1)                                                                                   \
    FIELD(float, priority, 1)                                                                                          \
    FIELD(float, clearance, 1) /* metres that its center keeps from walls */                                           \
    FIELD(float, target, 3)    /* the corridor's end */                                                                \
    FIELD(float, goal, 3)                                                                                              \
    FIELD(float, corner, 2)      /* that it walks to, in x and z */                                                    \
    FIELD(float, wall_center, 2) /* where the walls were looked for */                                                 \
    FIELD(float, wall_slack, 1)  /* metres that it may be away from there; < 0: look again */                          \
    FIELD(float, stalled, 1)     /* seconds that it has hardly come forward; arrived: metres to the goal */            \
    FIELD(float, walls, 4 * CROWD_MAX_WALLS) /* start and end in x and z; on a link: crowd_link_run */                 \
    FIELD(uint8_t, filter, 1)                                                                                          \
    FIELD(uint8_t, wall_count, 1)

/// The fields of the members of groups: those of a group stand one behind the other, by their slots. So does the
/// leader's trail, a ring of places at the group's spacing: as long as the column of its members.
#define CROWD_MEMBER_FIELDS(FIELD)                                                                                     \
    FIELD(uint64_t, trail_polygon, 1)                                                                                  \
    FIELD(uint64_t, slot_polygon, 1)                                                                                   \
    FIELD(float, slot, 3) /* its place, as found last: the goal, from the next step on */                              \
    FIELD(float, trail, 3)                                                                                             \
    FIELD(uint32_t, member_agent, 1) /* its place among the agents */                                                  \
    FIELD(uint32_t, member_group, 1)                                                                                   \
    FIELD(uint32_t, member_flags, 1) /* CROWD_ON_TRAIL and so on */                                                    \
    FIELD(float, offset, 2)          /* of the slot, forward and left */                                               \
    FIELD(float, lag, 1)             /* metres from the slot */                                                        \
    FIELD(float, held, 1)            /* seconds that the slot stays on the trail */

#define CROWD_ON_TRAIL  1u ///< the member's slot is on the leader's trail
#define CROWD_EARLY     2u ///< and is still behind the member, which waits for it
#define CROWD_TO_TRAIL  4u ///< the corridor leads to the trail, from where the slot may be in sight
#define CROWD_FOLLOWING 7u

/// A group of agents. `count` 0: a free place.
typedef struct crowd_group {
    uint64_t polygon; ///< under the leader; TL_NAV_NO_REF: it is not on the navmesh
    float place[3];   ///< of the leader when the step began
    float velocity[2];
    float heading[2]; ///< unit
    float spacing, wait_distance, lost_distance;
    float speed; ///< metres a second that the leader may walk
    float lag;   ///< metres: the largest of those who are waited for
    float range; ///< metres: from the leader to the farthest slot; of a loose group: as far as one may be
    uint32_t formation;
    uint32_t flags; ///< CROWD_GROUP_...
    uint32_t generation;
    uint32_t first, count;             ///< of the members
    uint32_t trail_first, trail_count; ///< of the ring, the newest place first
} crowd_group;

#define CROWD_GROUP_IN_ORDER  1u ///< members keep their slots
#define CROWD_GROUP_NEW_GOAL  2u ///< slots are dealt anew when it leads elsewhere
#define CROWD_GROUP_MOVES     4u ///< the leader walks, or wants to
#define CROWD_GROUP_ALL_FLAGS 7u

/// A goal that many have: their paths come from one tree (crowd_share.c).
typedef struct crowd_shared_goal {
    uint64_t polygon; ///< TL_NAV_NO_REF: none
    float point[3];
    float side, height; ///< metres: where it is sought when its polygon is gone
    uint32_t filter;
} crowd_shared_goal;

typedef struct crowd_head {
    uint32_t magic, version;
    uint64_t size;         ///< bytes in all
    uint64_t edits;        ///< of the navmesh that was seen last
    uint64_t step;         ///< steps so far
    uint64_t milliseconds; ///< of all steps, each rounded
    uint32_t max_agents, max_path;
    uint32_t max_groups, max_members;
    uint32_t member_count; ///< of all groups
    uint32_t unused;
    uint32_t used;  ///< places below have been used once
    uint32_t count; ///< agents
    uint32_t free;  ///< head of the chain of free places
    uint32_t queue_first, queue_count;
    uint32_t filters_changed; ///< 1: agents check their corridors in the next step
    crowd_shared_goal shared[CROWD_MAX_SHARED];
} crowd_head;

/// Where the fields stand in the state.
typedef struct crowd_fields {
#define CROWD_POINTER(type, name, per) type *name;
    CROWD_FIELDS(CROWD_POINTER)
    CROWD_MEMBER_FIELDS(CROWD_POINTER)
#undef CROWD_POINTER
    crowd_group *groups;
} crowd_fields;

/// What an agent on a link keeps in place of its walls.
typedef struct crowd_link_run {
    float from[3], to[3];    ///< metres
    float elapsed, duration; ///< seconds
} crowd_link_run;

/// What agents see of one: the first eight numbers are read as two vectors.
typedef struct crowd_seen_agent {
    float x, z, radius, bottom; ///< y of its feet
    float vx, vz, wanted_x, wanted_z;
    float top; ///< y of its head
    float priority;
    uint32_t kind;  ///< CROWD_SEEN_..., and where it travels
    uint32_t agent; ///< its place
} crowd_seen_agent;

/// What agents see of one another in a step, in the order of the grid's cells: an array of agents, since those around
/// one lie anywhere in it. With an array of each number they were three times as many lines of memory.
typedef struct crowd_snapshot {
    crowd_seen_agent *agents;
    uint32_t count;
    float max_radius;
} crowd_snapshot;

/// One who is near another.
typedef struct crowd_neighbor {
    float gap;         ///< metres between the two rims in the plane; < 0: they overlap
    uint32_t agent;    ///< its place, by which ties are broken
    uint32_t snapshot; ///< where it stands there
} crowd_neighbor;

#define CROWD_SEEN_FIXED   1u ///< others do all of the evading
#define CROWD_SEEN_STILL   2u ///< it has arrived, or has nowhere to go
#define CROWD_SEEN_YIELDS  4u
#define CROWD_SEEN_STALLED 8u  ///< it walks, but is held up
#define CROWD_SEEN_CLAIMS  16u ///< it has been held up for so long that it has the right of way
#define CROWD_SEEN_CUT_OFF 32u ///< it walks as near to its goal as any path leads

/// A uniform grid over the plan that repeats itself every `mask + 1` cells in both directions.
typedef struct crowd_grid {
    uint32_t *first; ///< [cell_count + 1] of the snapshot
    uint32_t *cell;  ///< [max_agents] of each place; then where it stands in the snapshot
    uint32_t cell_count;
    uint32_t mask_x, mask_z, shift_z;
    float cell_size;
} crowd_grid;

/// The tree of a shared goal. It follows from goal, filter and navmesh, and is no part of the state.
typedef struct crowd_tree {
    tl_nav_goal_tree tree;
    crowd_shared_goal of;
    const tl_navmesh *navmesh; ///< NULL: it is to be made
    uint64_t edits;            ///< of the navmesh when it was made
    bool is_asked;             ///< in this step
} crowd_tree;

/// The blocks of agents that one worker takes first, in a cache line of its own.
typedef struct crowd_block_run {
    atomic_uint_least64_t next;
    uint64_t end;
    char behind[CROWD_CACHE_LINE - 2 * sizeof(uint64_t)];
} crowd_block_run;

struct tl_nav_crowd {
    tl_allocator allocator;
    tl_nav_crowd_def def;
    crowd_head *head; ///< of the state
    crowd_fields a;
    uint64_t state_bytes;
    crowd_snapshot seen;
    crowd_grid grid;
    uint32_t *work; ///< [paths_per_step]: places whose paths are searched in this step
    uint32_t work_capacity;
    tl_nav_query **queries; ///< one for each worker
    crowd_block_run *runs;  ///< one for each worker
    uint32_t worker_count;
    tl_nav_filter filters[TL_NAV_CROWD_FILTER_COUNT];
    crowd_tree trees[CROWD_MAX_SHARED];
    tl_slot_deal deal; ///< [max_members] scratch
};

/// A step under way.
typedef struct crowd_step {
    tl_nav_crowd *crowd;
    const tl_navmesh *navmesh;
    float dt;
    uint32_t work_count;
    uint32_t tree_count, shared_count; ///< trees made, and paths by them
    float preferred[2];                ///< unit: the direction that has the right of way now
} crowd_step;

/// Bytes of a state, or 0 when they do not fit a size_t.
uint64_t tl_crowd_state_bytes(const tl_nav_crowd_def *def);
/// Where the fields of a state stand.
crowd_fields tl_crowd_fields_at(void *state, const tl_nav_crowd_def *def);
/// Turns a state's words round, on machines of the other byte order.
void tl_crowd_swap_words(void *state, uint64_t bytes, const tl_nav_crowd_def *def);

/// The place of an agent. TL_ERR_STALE.
tl_result tl_crowd_find(const tl_nav_crowd *crowd, tl_nav_agent agent, uint32_t *place_out);
/// An agent has no goal any more, and stops; or has another one.
void tl_crowd_stop(tl_nav_crowd *crowd, uint32_t i);
void tl_crowd_send(tl_nav_crowd *crowd, uint32_t i, const tl_nav_location *goal);
/// Puts an agent at the end of the queue for paths, unless it is there.
void tl_crowd_enqueue(tl_nav_crowd *crowd, uint32_t i);
/// An agent's corridor, which shares its path. tl_crowd_keep_corridor writes the rest back.
tl_nav_corridor tl_crowd_corridor(const tl_nav_crowd *crowd, uint32_t i);
void tl_crowd_keep_corridor(tl_nav_crowd *crowd, uint32_t i, const tl_nav_corridor *corridor);
/// Gives a standing agent a corridor of its polygon alone.
void tl_crowd_reset_corridor(tl_nav_crowd *crowd, uint32_t i, const tl_nav_location *at);
/// Metres by which an agent is wider than the one that its polygon was baked for.
float tl_crowd_clearance(const tl_navmesh *navmesh, tl_nav_ref polygon, float radius);

/// Gives paths to those who wait for one to a goal that many have, by the tree of that goal, and takes them out of the
/// queue. What the tree does not reach stays in it.
void tl_crowd_share_paths(crowd_step *step);
/// Forgets trees: all, or those of one filter (UINT32_MAX: of all).
void tl_crowd_forget_trees(tl_nav_crowd *crowd, uint32_t filter);
/// An agent walks a path that was found. `status` is that of the search.
void tl_crowd_begin_path(tl_nav_crowd *crowd, uint32_t i, const tl_nav_corridor *corridor, bool is_partial,
                         bool gave_up);
/// Runs a task for blocks of agents, or single items of work.
void tl_crowd_run_tasks(const crowd_step *step, tl_task_fn *task, uint32_t count);

/// Searches an agent's path.
void tl_crowd_search_path(const crowd_step *step, uint32_t i, tl_nav_query *query);
/// Checks an agent's polygon and corridor after the navmesh has changed.
void tl_crowd_revalidate(const crowd_step *step, uint32_t i);

/// Sorts all agents into the grid, and copies what they show.
void tl_crowd_fill_grid(const crowd_step *step);

/// Sets an agent's wanted velocity, and its status.
void tl_crowd_steer(const crowd_step *step, uint32_t i);
/// Looks for the walls around an agent where it has come too far from where that was done.
void tl_crowd_look_for_walls(const crowd_step *step, uint32_t i, tl_nav_query *query);
/// The velocity that an agent takes: it stands at `k` in the snapshot.
void tl_crowd_avoid(const crowd_step *step, uint32_t k, float velocity_out[2]);
/// Whether a wide agent has come as near to a wall as its clearance lets it.
bool tl_crowd_touches_wall(const crowd_fields *a, uint32_t i);
/// Moves an agent along the surface.
void tl_crowd_move(const crowd_step *step, uint32_t i, const float velocity[2], tl_nav_query *query);

/// What a walking agent wants: along its corridor.
void tl_crowd_walk(const crowd_step *step, uint32_t i);
/// The same for one that has a straight way to a place that moves itself.
void tl_crowd_walk_beside(const crowd_step *step, uint32_t i, tl_vec3 place, const float velocity[2]);
/// It stands.
void tl_crowd_want_to_stand(const crowd_step *step, uint32_t i);

/// Takes an agent out of its group.
void tl_crowd_leave_group(tl_nav_crowd *crowd, uint32_t i);
/// Deals a group's slots among its followers, unless they keep their order.
void tl_crowd_deal_slots(const tl_nav_crowd *crowd, crowd_group *group);
/// Before agents move: where each group's leader is, how its formation faces, and how fast it may walk.
void tl_crowd_lead_groups(const crowd_step *step);
/// Sends an agent that follows to its slot, and sets what it wants.
void tl_crowd_follow(const crowd_step *step, uint32_t i, tl_nav_query *query);

/// The direction that has the right of way at a time: the golden angle, again and again.
void tl_crowd_preferred_direction(uint64_t milliseconds, float out[2]);

/// Moves an agent that is on a link.
void tl_crowd_follow_link(const crowd_step *step, uint32_t i);
/// Lets those agents onto their links whose turn it is.
void tl_crowd_grant_links(const crowd_step *step);

static inline tl_vec3 tl_crowd_position(const tl_nav_crowd *crowd, uint32_t i)
{
    return tl_vec3_make(crowd->a.x[i], crowd->a.y[i], crowd->a.z[i]);
}

static inline void tl_crowd_set_position(tl_nav_crowd *crowd, uint32_t i, tl_vec3 position)
{
    crowd->a.x[i] = position.x;
    crowd->a.y[i] = position.y;
    crowd->a.z[i] = position.z;
}

static inline tl_vec3 tl_crowd_get3(const float *items, uint32_t i)
{
    const float *v = items + 3 * (size_t)i;
    return tl_vec3_make(v[0], v[1], v[2]);
}

static inline void tl_crowd_set3(float *items, uint32_t i, tl_vec3 value)
{
    float *v = items + 3 * (size_t)i;
    v[0] = value.x;
    v[1] = value.y;
    v[2] = value.z;
}

/// Metres from an agent to its goal, in the plan.
static inline float tl_crowd_distance_to_goal(const tl_nav_crowd *crowd, uint32_t i)
{
    const tl_vec3 goal = tl_crowd_get3(crowd->a.goal, i);
    const float x = goal.x - crowd->a.x[i], z = goal.z - crowd->a.z[i];
    return sqrtf(x * x + z * z);
}

/// Metres from its goal within which a wide agent has arrived, when walls let it come no nearer.
static inline float tl_crowd_kept_off_reach(const crowd_fields *a, uint32_t i)
{
    return a->arrive_distance[i] + CROWD_KEPT_OFF_REACH * a->clearance[i];
}

/// The group of an agent, or NULL.
static inline crowd_group *tl_crowd_group_of(const tl_nav_crowd *crowd, uint32_t i)
{
    const uint32_t member = crowd->a.member[i];
    return member != 0 ? &crowd->a.groups[crowd->a.member_group[member - 1]] : NULL;
}

/// Whether an agent follows the leader of a group.
static inline bool tl_crowd_follows(const tl_nav_crowd *crowd, uint32_t i)
{
    const crowd_group *group = tl_crowd_group_of(crowd, i);
    return group != NULL && group->first != crowd->a.member[i] - 1;
}

/// Where a member's slot is in the plan, metres in x and z from the leader.
static inline void tl_crowd_plan_slot(const tl_nav_crowd *crowd, const crowd_group *group, uint32_t m, float out[2])
{
    const float forward = crowd->a.offset[2 * (size_t)m], left = crowd->a.offset[2 * (size_t)m + 1];
    out[0] = forward * group->heading[0] + left * group->heading[1];
    out[1] = forward * group->heading[1] - left * group->heading[0];
}

/// The direction in the upper half of `flags`, in parts of 127.
static inline void tl_crowd_travel(uint32_t flags, float out[2])
{
    const int32_t x = (int32_t)(flags >> CROWD_TRAVEL_SHIFT & 255u), z = (int32_t)(flags >> 24);
    out[0] = (float)((x ^ 128) - 128);
    out[1] = (float)((z ^ 128) - 128);
}

/// Whether an agent stands, and wants to.
static inline bool tl_crowd_stands(uint32_t status)
{
    return status != TL_NAV_AGENT_WALKING && status != TL_NAV_AGENT_ON_LINK && status != TL_NAV_AGENT_FIXED;
}

#endif
