// SPDX-License-Identifier: MIT
//
// Paths with clearance: for agents wider than the one that the mesh was baked for, on the same mesh. The agent's radius
// is given with the query; the walls are dilated by the difference (their Minkowski sum with a disc), exactly.

#ifndef TALUS_NAV_WIDE_H
#define TALUS_NAV_WIDE_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How the search for a wide path ended.
typedef enum tl_nav_wide_status {
    TL_NAV_WIDE_NONE,          ///< nothing was searched: the call failed, and its result says why
    TL_NAV_WIDE_COMPLETE,      ///< the path leads to the goal
    TL_NAV_WIDE_UNREACHABLE,   ///< proven: no agent as wide gets to the goal
    TL_NAV_WIDE_OUT_OF_NODES,  ///< gave up: the query has too few nodes
    TL_NAV_WIDE_START_BLOCKED, ///< the start is too near to a wall for the agent to stand there
    TL_NAV_WIDE_GOAL_BLOCKED   ///< the goal is
} tl_nav_wide_status;

/// "none", "complete", "unreachable", "out of nodes", "start blocked", "goal blocked"; "unknown" for other
/// numbers.
TL_API const char *tl_nav_wide_status_name(tl_nav_wide_status status);

/// A path with clearance.
typedef struct tl_nav_wide_path {
    tl_nav_wide_status status; ///< how the search ended
    uint32_t corner_count;     ///< of the whole path, though the buffer may hold fewer; 0 without a path
    double wall_distance;  ///< metres in the plane: the path's clearance from the walls of the mesh is at least that
    double length;         ///< metres in the plane, of the corners
    double surface_length; ///< metres in space, straight from corner to corner
    uint32_t node_count;   ///< nodes that the search used
} tl_nav_wide_path;

/// Finds a path for an agent of any radius from the mesh's own upwards, over tiles, seams and floors that lie over one
/// another.
///
/// A mesh is already eroded by the radius of its own agent. A wider agent's center keeps the difference (agent_radius
/// less that of the start's tile) from the walls that are left: edges without a neighbour, and polygons that the filter
/// refuses. Whether there is such a path is decided exactly, up to the rounding of coordinates: a gap exactly as wide
/// as the agent lets it through. The path found is taut, the shortest one in its homotopy class: a path that passes
/// another obstacle on the other side may be shorter. Circles are approximated by 32 chords, so the path keeps 0.995 of
/// the difference; `wall_distance` is that figure. Area costs are ignored. Without a difference the path is that of
/// tl_nav_query_find_shortest_path.
/// tl_nav_query_find_wide_place moves start and goal to where the agent fits. Corners are the start, places where the
/// path turns, and the goal; a corner's polygon holds it, and the path continues there. TL_ERR_ARGUMENT: a negative
/// radius. Sources: docs/notes/paths.md.
TL_API tl_result tl_nav_query_find_wide_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_path_request *request, float agent_radius,
                                             tl_nav_corner *corners_out, uint32_t capacity, tl_nav_wide_path *path_out);

/// Whether there is such a path: its status, as tl_nav_query_find_wide_path would give it, without the path. Errors as
/// there.
TL_API tl_result tl_nav_query_is_wide_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                                const tl_nav_path_request *request, float agent_radius,
                                                tl_nav_wide_status *status_out);

/// How much is precomputed. Begin with tl_default_nav_wide_def.
typedef struct tl_nav_wide_def {
    float max_radius; ///< metres, >= 0: of the widest agent that is served from it
    uint32_t cookie;  ///< TL_DEF_COOKIE, set by tl_default_nav_wide_def
} tl_nav_wide_def;

/// 1.5 m.
TL_API tl_nav_wide_def tl_default_nav_wide_def(void);

/// What tl_navmesh_prepare_wide did.
typedef struct tl_nav_wide_report {
    tl_report base;           ///< the def's field that was refused
    uint64_t bytes;           ///< that the navmesh keeps for this
    uint64_t wall_count;      ///< walls kept, over all polygons
    uint32_t tile_count;      ///< tiles that are prepared
    uint32_t made_tile_count; ///< of them, by this call
} tl_nav_wide_report;

/// Makes wide paths and places fast: finds the walls around each polygon once, up to the distance that an agent of
/// `max_radius` keeps. NULL def: the default one.
///
/// Answers stay the same, bit by bit. It serves radii up to `max_radius` and filters that refuse no polygon; others are
/// answered as without it. When a tile is added or removed, the tiles within the radius and one tile around it are
/// dropped; the next call makes those anew, and no others unless the radius changes. Radius 0 frees the memory.
/// O(polygons, and the pairs of walls around each). Changes the navmesh: no query may run meanwhile. `report_out` may
/// be NULL. TL_ERR_MEMORY; TL_ERR_LIMIT, also where more than some 50,000 lines of sight, parted by vertices, leave a
/// polygon (levels take 2,000 at most): what was made stays. TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT: the radius.
TL_API tl_result tl_navmesh_prepare_wide(tl_navmesh *navmesh, const tl_nav_wide_def *def,
                                         tl_nav_wide_report *report_out);

/// Finds the place nearest to the request's center in the plane where an agent of this radius may stand, among the
/// polygons that are connected with the center's within the request's radius of it. TL_NOT_FOUND: there is none.
/// TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_find_wide_place(tl_nav_query *query, const tl_navmesh *navmesh,
                                              const tl_nav_around_request *request, float agent_radius,
                                              tl_nav_location *place_out);

/// The clearance of a path of straight lines over the surface: how near it comes to a wall in the plane, metres, or
/// max_distance when no wall is nearer. Each corner must lie on its polygon. On TL_ERR_NODES it is 0. TL_ERR_ARGUMENT:
/// no corner, or a negative distance.
TL_API tl_result tl_nav_query_path_clearance(tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_filter *filter, const tl_nav_corner *corners, uint32_t count,
                                             float max_distance, float *clearance_out);

#ifdef __cplusplus
}
#endif

#endif
