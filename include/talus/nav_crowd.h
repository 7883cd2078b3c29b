// SPDX-License-Identifier: MIT
//
// A crowd: agents that walk a navmesh to their goals, avoid one another and its walls, and never leave it.
//
//   tl_nav_crowd_create(NULL, &crowd, NULL);
//   tl_nav_agent_def def = tl_default_nav_agent_def();
//   def.position = ...;
//   tl_nav_crowd_add(crowd, navmesh, &def, &agent, NULL);
//   tl_nav_crowd_set_goal(crowd, agent, &goal);
//   each frame:
//     tl_nav_crowd_step(crowd, navmesh, dt, NULL);
//     tl_nav_crowd_agent(crowd, agent, &state);          state.position, state.velocity, state.status
//
// A step searches some of the paths that were asked for, the oldest first; steers every agent along its corridor; finds
// the velocity nearest to the wanted one that ORCA allows among its neighbours and walls; and moves it along the
// surface. Agents read what their neighbours did in the step before, so that the order in which they are computed does
// not count: the same steps give the same bytes for any number of threads.
//
// All that a step reads and writes is one block of bytes beside the navmesh, which can be saved, compared, sent and
// restored: after that the same calls give the same bytes again (rollback, lockstep). A step allocates nothing.
//
// One thread at a time uses a crowd; a step runs the host's tasks. The navmesh may change between steps: agents notice
// and repair their corridors. It must be the same navmesh at each call, or one with the same edits.
//
// Errors that functions share: TL_ERR_ARGUMENT (a NULL), TL_ERR_STALE (an agent that was removed, or never was).

#ifndef TALUS_NAV_CROWD_H
#define TALUS_NAV_CROWD_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// The crowd.

typedef struct tl_nav_crowd tl_nav_crowd;

/// An agent of a crowd. A name is not used again before 2^32 other agents had its place.
typedef uint64_t tl_nav_agent;

#define TL_NAV_NO_AGENT           0u
#define TL_NAV_CROWD_MAX_AGENTS   (1u << 20)
#define TL_NAV_CROWD_FILTER_COUNT 16u ///< filters of one crowd; all begin as the default filter

/// How large a crowd is, and how far it looks ahead. Begin with tl_default_nav_crowd_def.
typedef struct tl_nav_crowd_def {
    uint32_t max_agents;     ///< 1 to TL_NAV_CROWD_MAX_AGENTS; their memory is taken at once. Default 1024
    uint32_t max_path;       ///< polygons of its corridor that an agent keeps, 4 to 1024; it asks for more in time
    uint32_t max_neighbors;  ///< that an agent avoids, the nearest ones, 1 to 32. Default 10
    uint32_t paths_per_step; ///< searches of one step, >= 1; the others wait. Default 64
    uint32_t max_nodes;      ///< of one search, as in tl_nav_query_def. Default 4096: 1 MB for each worker
    float neighbor_distance; ///< metres, > 0: agents whose rims are farther apart do not see one another. Default 4
    float agent_horizon;     ///< seconds, > 0: collisions with agents are avoided so far ahead. Default 2
    float wall_horizon;      ///< seconds, > 0: walls are approached so that they are not reached sooner. Default 0.25
    /// Copied, but for what the hooks point to, which must outlive the crowd. Progress is not called. NULL tasks: the
    /// calling thread.
    tl_host host;
    /// Goals whose paths are found by one search for all that walk there, 0 to 8: those that most agents have, eight at
    /// least. Each takes 56 bytes times max_nodes. Default 4. 0: each agent searches its own path.
    uint32_t max_shared_goals;
    uint32_t max_groups;  ///< at a time, 0 to TL_NAV_CROWD_MAX_AGENTS; 88 bytes each. Default 32
    uint32_t max_members; ///< of all groups together, 0 to TL_NAV_CROWD_MAX_AGENTS; 136 bytes each. Default 256
    uint32_t cookie;      ///< TL_DEF_COOKIE, set by tl_default_nav_crowd_def
} tl_nav_crowd_def;

TL_API tl_nav_crowd_def tl_default_nav_crowd_def(void);

/// Creates an empty crowd and takes all memory that its steps will use. NULL def: the default one. TL_ERR_ARGUMENT
/// (`report`, which may be NULL, names the field), TL_ERR_MEMORY.
TL_API tl_result tl_nav_crowd_create(const tl_nav_crowd_def *def, tl_nav_crowd **crowd_out, tl_report *report);
/// Frees a crowd. NULL: nothing happens.
TL_API void tl_nav_crowd_destroy(tl_nav_crowd *crowd);

/// Copies a filter into one of the crowd's places for them, below TL_NAV_CROWD_FILTER_COUNT; NULL: the default filter.
/// Its functions and their `user` must outlive their use, and be called by several threads at once where the host has
/// tasks. Agents that use it check their corridors in the next step. Filters are not part of the saved state.
/// TL_ERR_ARGUMENT: the place, a filter without its cookie, an area cost, or the slack.
TL_API tl_result tl_nav_crowd_set_filter(tl_nav_crowd *crowd, uint32_t place, const tl_nav_filter *filter);

// ---------------------------------------------------------------------------------------------------------
// Agents.

/// An agent: an upright cylinder that stands on the navmesh. Begin with tl_default_nav_agent_def.
typedef struct tl_nav_agent_def {
    tl_vec3 position; ///< metres; moved to the navmesh's nearest point within reach
    float reach;      ///< metres, >= 0: half the edge of the box in which that point is sought. Default 2
    float radius; ///< metres, > 0, at most 1000. One above the mesh's own keeps the difference from walls. Default 0.3
    float height; ///< metres, > 0, at most 1000: agents whose heights do not overlap ignore one another. Default 1.8
    float max_speed;        ///< metres a second, 0 to 1000. Default 1.4
    float max_acceleration; ///< metres a second squared, > 0; to avoid others an agent may exceed it. Default 8
    float arrive_distance;  ///< metres in the plane, >= 0: so near to its goal an agent has arrived. Default 0.1
    float priority;  ///< 0 to 1: of two agents the one with more evades less. Equal ones evade alike. Default 0.5
    uint32_t filter; ///< the filter's place. Default 0
    bool is_fixed; ///< its motion is the caller's (tl_nav_crowd_set_motion): a player, a vehicle. The others evade it,
                   ///< it evades nobody, and it need not stand on the navmesh
    uint32_t cookie; ///< TL_DEF_COOKIE, set by tl_default_nav_agent_def
} tl_nav_agent_def;

TL_API tl_nav_agent_def tl_default_nav_agent_def(void);

/// What an agent is doing.
typedef enum tl_nav_agent_status {
    TL_NAV_AGENT_IDLE,        ///< it has no goal, and makes way for others
    TL_NAV_AGENT_WAITING,     ///< for its path to be searched
    TL_NAV_AGENT_WALKING,     ///< to its goal
    TL_NAV_AGENT_ARRIVED,     ///< within its arrive_distance, or as near as those that stand there already let it come,
                              ///< or as walls let one come that is wider than the mesh was baked for
    TL_NAV_AGENT_UNREACHABLE, ///< no path leads to the goal, or none as wide as the agent: it stands as near as a path
                              ///< leads, or where the shortest one becomes too narrow
    TL_NAV_AGENT_QUEUED,      ///< at an off-mesh link that another one takes just now
    TL_NAV_AGENT_ON_LINK,     ///< on its way along an off-mesh link
    TL_NAV_AGENT_OFF_MESH,    ///< the navmesh under it was removed; it stands until there is one again
    TL_NAV_AGENT_GAVE_UP,     ///< max_nodes are too few to find the rest of its path: it stands where the path ends
    TL_NAV_AGENT_FIXED        ///< is_fixed
} tl_nav_agent_status;

/// "idle", "waiting", "walking", "arrived", "unreachable", "queued", "on link", "off mesh", "gave up", "fixed";
/// "unknown" for other numbers.
TL_API const char *tl_nav_agent_status_name(tl_nav_agent_status status);

/// Adds an agent, without a goal. NULL def: the default one. TL_NOT_FOUND: no polygon that its filter passes is within
/// reach. TL_ERR_LIMIT: there are max_agents. TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE: `report` (may be NULL) names the
/// field.
TL_API tl_result tl_nav_crowd_add(tl_nav_crowd *crowd, const tl_navmesh *navmesh, const tl_nav_agent_def *def,
                                  tl_nav_agent *agent_out, tl_report *report);
/// Removes an agent, from its group too: where it led one, the next one leads and takes over its goal. O(paths that
/// wait, members of groups).
TL_API tl_result tl_nav_crowd_remove(tl_nav_crowd *crowd, tl_nav_agent agent);

/// Sends an agent to a place on the navmesh; NULL: it stops where it is. It walks its old path until the new one was
/// searched; asking again while it waits keeps its turn. Setting the goal that it has already changes nothing.
/// The goal of an agent that leads a group is the group's.
/// TL_ERR_ARGUMENT: a fixed agent, one that follows in a group, or a polygon that is no polygon. TL_ERR_NOT_FINITE;
/// TL_ERR_RANGE: above 1e9.
TL_API tl_result tl_nav_crowd_set_goal(tl_nav_crowd *crowd, tl_nav_agent agent, const tl_nav_location *goal);

/// Where a fixed agent is now, and how fast it moves, metres a second: call it before each step in which it moves.
/// TL_ERR_ARGUMENT: an agent that is not fixed. TL_ERR_NOT_FINITE; TL_ERR_RANGE: above 1e9.
TL_API tl_result tl_nav_crowd_set_motion(tl_nav_crowd *crowd, tl_nav_agent agent, tl_vec3 position, tl_vec3 velocity);

/// An agent as it is after the last step.
typedef struct tl_nav_agent_state {
    tl_nav_agent_status status;
    tl_vec3 position;   ///< metres, on the surface
    tl_vec3 velocity;   ///< metres a second, as it moved in the last step; y is 0 but for fixed agents
    tl_vec3 wanted;     ///< metres a second: the velocity that steering asked for, before others were avoided
    tl_nav_ref polygon; ///< under it; on a link where the link lands; TL_NAV_NO_REF for fixed agents
    tl_nav_ref link;    ///< TL_NAV_AGENT_ON_LINK: which; else TL_NAV_NO_REF
    tl_vec3 goal;       ///< metres; its position when it has none. Of one that follows: its slot
    float radius, height;
} tl_nav_agent_state;

TL_API tl_result tl_nav_crowd_agent(const tl_nav_crowd *crowd, tl_nav_agent agent, tl_nav_agent_state *state_out);
/// The corners of an agent's corridor from its position on, as tl_nav_corridor_corners gives them: for debug views.
/// TL_NOT_FOUND: it has no path.
TL_API tl_result tl_nav_crowd_corners(const tl_nav_crowd *crowd, const tl_navmesh *navmesh, tl_nav_agent agent,
                                      tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out);

/// Agents in the crowd, fixed ones included. `crowd` must not be NULL.
TL_API uint32_t tl_nav_crowd_count(const tl_nav_crowd *crowd);
/// Iterates over all agents, in an order that adding and removing others does not change. Start with `*cursor` 0; false
/// at the end. No argument may be NULL.
TL_API bool tl_nav_crowd_next(const tl_nav_crowd *crowd, uint32_t *cursor, tl_nav_agent *agent_out);

// ---------------------------------------------------------------------------------------------------------
// Groups: agents that follow a leader, in a formation or loosely.
//
//   tl_nav_group_def def = tl_default_nav_group_def();
//   def.formation = TL_NAV_FORMATION_WEDGE;
//   tl_nav_crowd_add_group(crowd, &def, agents, 7, &group, NULL);     agents[0] leads
//   tl_nav_crowd_set_goal(crowd, agents[0], &goal);                   the others follow
//
// The leader walks a path of its own, or is fixed: a player. Each of the others has a slot beside or behind it, in a
// frame that turns with the leader's way. A slot is where a ray along the surface leads from the leader; where a wall
// cuts that off, as in a doorway, the slot is on the leader's trail instead, and the formation becomes a column until
// it has room again. The leader walks no faster than the slowest, slower while somebody is behind, and waits for those
// who are too far behind. Only the leader's path is searched, unless a member has lost sight of slot and trail.

/// A group of a crowd. A name is not used again before 2^32 other groups had its place.
typedef uint64_t tl_nav_group;

#define TL_NAV_NO_GROUP 0u

/// How the others stand about their leader.
typedef enum tl_nav_formation {
    TL_NAV_FORMATION_LOOSE,  ///< wherever they are, but near to it
    TL_NAV_FORMATION_LINE,   ///< abreast, the leader in the middle
    TL_NAV_FORMATION_COLUMN, ///< one behind the other, on the leader's trail
    TL_NAV_FORMATION_WEDGE,  ///< the leader in front, behind it two rows at 45 degrees
    TL_NAV_FORMATION_RING,   ///< on a circle, the leader in its middle
    TL_NAV_FORMATION_SLOTS   ///< as the def's slots say
} tl_nav_formation;

/// "loose", "line", "column", "wedge", "ring", "slots"; "unknown" for other numbers.
TL_API const char *tl_nav_formation_name(tl_nav_formation formation);

/// A place in the plan of a formation, metres from the leader.
typedef struct tl_nav_formation_slot {
    float forward, left;
} tl_nav_formation_slot;

/// A group. Begin with tl_default_nav_group_def.
typedef struct tl_nav_group_def {
    tl_nav_formation formation; ///< default TL_NAV_FORMATION_LOOSE
    float spacing;              ///< metres, > 0, at most 1000: between neighbours, also in a column. Default 1.2
    float wait_distance; ///< metres, > 0: the leader stands while somebody is so far from its slot, and slows down from
                         ///< a quarter of it on. Default 4
    float lost_distance; ///< metres, > 0: who is farther from its slot is not waited for, nor who is held up for ten
                         ///< seconds. Default 30
    const tl_nav_formation_slot *slots; ///< TL_NAV_FORMATION_SLOTS: one for each agent but the leader; else ignored
    bool keep_order; ///< agent k of the list takes slot k. false: slots are dealt so that the squares of the ways there
                     ///< have the smallest sum (above 64 followers nearly), which crosses no ways; and anew when the
                     ///< leader gets a goal to the side or behind
    uint32_t cookie; ///< TL_DEF_COOKIE, set by tl_default_nav_group_def
} tl_nav_group_def;

TL_API tl_nav_group_def tl_default_nav_group_def(void);

/// Makes a group of `count` >= 1 agents, of which agents[0] leads; the others lose their goals. NULL def: the default
/// one. TL_ERR_LIMIT: max_groups or max_members. TL_ERR_STALE: an agent that is none. TL_ERR_ARGUMENT,
/// TL_ERR_NOT_FINITE: `report` (may be NULL) names the field; "agents": one that is in a group already, or is fixed and
/// does not lead. O(max_groups + count^3) up to 64 followers, then O(max_groups + count).
TL_API tl_result tl_nav_crowd_add_group(tl_nav_crowd *crowd, const tl_nav_group_def *def, const tl_nav_agent *agents,
                                        uint32_t count, tl_nav_group *group_out, tl_report *report);
/// Lets the agents of a group go: the leader keeps its goal, the others stop. O(members of all groups).
TL_API tl_result tl_nav_crowd_remove_group(tl_nav_crowd *crowd, tl_nav_group group);
/// Changes how a group walks; its agents and their leader remain. With slots: as many as it has followers. NULL def:
/// the default one. Errors as those of tl_nav_crowd_add_group; then nothing is changed.
TL_API tl_result tl_nav_crowd_set_formation(tl_nav_crowd *crowd, tl_nav_group group, const tl_nav_group_def *def,
                                            tl_report *report);

/// A group as it is after the last step.
typedef struct tl_nav_group_state {
    tl_nav_formation formation;
    uint32_t count;    ///< of agents, the leader included
    uint32_t in_place; ///< those no farther than half the spacing from their slots; the leader is
    uint32_t on_trail; ///< those whose slots are on the leader's trail
    float lag;         ///< metres: of those who are waited for, the largest distance to a slot
    float speed;       ///< metres a second: what the leader may walk
    tl_vec3 heading;   ///< unit, in the plane: where the formation faces
    tl_nav_agent leader;
} tl_nav_group_state;

TL_API tl_result tl_nav_crowd_group(const tl_nav_crowd *crowd, tl_nav_group group, tl_nav_group_state *state_out);
/// The agents of a group by their slots, the leader first. TL_INCOMPLETE: there are more.
TL_API tl_result tl_nav_crowd_members(const tl_nav_crowd *crowd, tl_nav_group group, tl_nav_agent *agents_out,
                                      uint32_t capacity, uint32_t *count_out);
/// The group that an agent is in, or TL_NAV_NO_GROUP: also for an agent that is none. `crowd` must not be NULL.
TL_API tl_nav_group tl_nav_crowd_group_of(const tl_nav_crowd *crowd, tl_nav_agent agent);

// ---------------------------------------------------------------------------------------------------------
// Steps.

/// What a step did.
typedef struct tl_nav_crowd_step_report {
    uint32_t searched; ///< paths, and trees of paths to shared goals
    uint32_t waiting;  ///< paths that are still to be searched
    uint32_t walking;  ///< agents with each status after the step
    uint32_t arrived;
    uint32_t unreachable;
    uint32_t on_link; ///< queued ones not counted
    uint32_t off_mesh;
    uint32_t shared; ///< paths that were taken from the search of a shared goal
} tl_nav_crowd_step_report;

/// Moves all agents by `dt` seconds, above 0 and at most 1; a game's frame, 1/60 to 1/10 as a rule. `report_out` may be
/// NULL. TL_ERR_ARGUMENT or TL_ERR_NOT_FINITE: dt; then nothing is changed. O(agents, and the searches).
///
/// An agent's center never leaves the polygons that its filter passes; one wider than the mesh's agent keeps 0.995 of
/// the difference from their walls (as wide paths do), unless it stood nearer when it was added or the mesh changed.
/// Sources: van den Berg, Guy, Lin, Manocha, Reciprocal n-Body Collision Avoidance, 2011 (ORCA); docs/notes/crowd.md.
TL_API tl_result tl_nav_crowd_step(tl_nav_crowd *crowd, const tl_navmesh *navmesh, float dt,
                                   tl_nav_crowd_step_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// The state as bytes.

/// Bytes that tl_nav_crowd_save writes: the same for every crowd with the same max_agents, max_path, max_groups and
/// max_members. `crowd` must not be NULL.
TL_API size_t tl_nav_crowd_state_size(const tl_nav_crowd *crowd);

/// Writes the state, `capacity` >= tl_nav_crowd_state_size (TL_ERR_LIMIT). Crowds in the same state give the same
/// bytes, little-endian on every machine. O(max_agents).
TL_API tl_result tl_nav_crowd_save(const tl_nav_crowd *crowd, void *bytes_out, size_t capacity);

/// Puts a crowd in a state that was saved, of itself or of another one of the same sizes. Safe on any bytes; on failure
/// the crowd is as it was. TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_TRUNCATED; TL_ERR_ARGUMENT: of a crowd of another size,
/// or not at a multiple of 8 bytes; TL_ERR_CORRUPT, TL_ERR_NOT_FINITE: `report` (may be NULL) names the "agent" or the
/// "group". O(max_agents + max_groups).
TL_API tl_result tl_nav_crowd_restore(tl_nav_crowd *crowd, const void *bytes, size_t size, tl_report *report);

/// A hash of the bytes that tl_nav_crowd_save would write, to be compared between machines. `crowd` must not be NULL.
TL_API uint64_t tl_nav_crowd_hash(const tl_nav_crowd *crowd);

#ifdef __cplusplus
}
#endif

#endif
