// SPDX-License-Identifier: MIT
//
// Paths for agents wider than the one that the mesh was baked for, on the same mesh: the radius is given with the
// query.

#ifndef TALUS_NAV_WIDE_H
#define TALUS_NAV_WIDE_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How the search for a wide path ended.
typedef enum tl_nav_wide_status {
    TL_NAV_WIDE_COMPLETE,      ///< the path leads to the goal
    TL_NAV_WIDE_UNREACHABLE,   ///< proven: nothing as wide gets to the goal
    TL_NAV_WIDE_OUT_OF_NODES,  ///< gave up: the query has too few nodes
    TL_NAV_WIDE_START_BLOCKED, ///< the start is too near to a wall for the agent to stand there
    TL_NAV_WIDE_GOAL_BLOCKED   ///< the goal is
} tl_nav_wide_status;

/// A phrase for a status: "complete", "unreachable", "out of nodes", "no room at start", "no room at goal".
TL_API const char *tl_nav_wide_status_name(tl_nav_wide_status status);

typedef struct tl_nav_wide_path {
    tl_nav_wide_status status;
    uint32_t corner_count; ///< of the whole path, though the buffer may hold fewer
    double wall_distance;  ///< metres in the plane: no place of the path is nearer to a wall of the mesh
    double length;         ///< metres in the plane, of the corners
    double surface_length; ///< metres in space, straight from corner to corner
    uint32_t node_count;   ///< nodes that the search used
} tl_nav_wide_path;

/// A path for an agent of any radius from the mesh's own upwards, over tiles, seams and floors over one another.
///
/// A mesh has its own agent's radius taken off around all walls already. A wider agent's centre keeps the difference,
/// agent_radius less that of the start's tile, from the walls that are left: edges with nothing across them, and
/// polygons that the filter refuses. Whether there is such a way is decided exactly, up to the rounding of coordinates:
/// a gap as wide as the agent lets it through. The path found is taut: no way that passes the same obstacles on the
/// same hands is shorter, but one that passes others may be. Turns are rounded by chords of a 32nd of a circle, so the
/// path keeps 0.995 of the difference; `wall_distance` is that figure. Area costs are not looked at.
/// Without a difference the path is that of tl_nav_query_find_shortest_path.
/// start and goal must lie on their polygons; tl_nav_query_find_wide_place moves them to where there is room. Corners
/// are the start, places where the path turns, and the goal; a corner's polygon holds it, and the path goes on there.
/// TL_OK for every status; corner_count is 0 without a path. TL_INCOMPLETE: the first corners were written, counts
/// and lengths are true. TL_NOT_FOUND: a stale reference. TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: a negative radius.
/// Sources: docs/paths.md.
TL_API tl_result tl_nav_query_find_wide_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_path_request *request, float agent_radius,
                                             tl_nav_corner *corners_out, uint32_t capacity, tl_nav_wide_path *path_out);

/// Whether there is such a path: its status, as tl_nav_query_find_wide_path would give it, without the path. Errors as
/// there.
TL_API tl_result tl_nav_query_is_wide_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                                const tl_nav_path_request *request, float agent_radius,
                                                tl_nav_wide_status *status_out);

/// How much is known beforehand. Fill it from tl_default_nav_wide_def.
typedef struct tl_nav_wide_def {
    float max_radius; ///< metres, >= 0: of the widest agent that is served so
    uint32_t cookie;  ///< TL_DEF_COOKIE, set by tl_default_nav_wide_def
} tl_nav_wide_def;

/// 1.5 m.
TL_API tl_nav_wide_def tl_default_nav_wide_def(void);

typedef struct tl_nav_wide_report {
    uint64_t bytes;           ///< that the navmesh keeps for this
    uint64_t wall_count;      ///< walls kept, over all polygons
    uint32_t tile_count;      ///< tiles that are prepared
    uint32_t made_tile_count; ///< of them, by this call
} tl_nav_wide_report;

/// Makes wide paths and places fast: finds the walls around each polygon once, as far as an agent of `max_radius` asks.
///
/// Answers stay the same, bit by bit. It serves radii up to `max_radius` and filters that refuse no polygon; others go
/// as before. When a tile is added or removed, tiles within the radius and one tile around it are dropped; the next
/// call makes those anew, and no others unless the radius changes. Radius 0 gives the memory back. O(polygons, and the
/// pairs of walls around each). Changes the navmesh: no query may run meanwhile. `report_out` may be NULL.
/// TL_ERR_MEMORY, TL_ERR_LIMIT: what was made stays. TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_navmesh_prepare_wide(tl_navmesh *navmesh, const tl_nav_wide_def *def,
                                         tl_nav_wide_report *report_out);

/// The place nearest to the request's center in the plane where an agent of this radius may stand, among the polygons
/// that hang together with the center's within the request's radius of it. TL_NOT_FOUND: there is none, or a stale
/// reference. TL_ERR_LIMIT: the query was out of nodes. TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_find_wide_place(tl_nav_query *query, const tl_navmesh *navmesh,
                                              const tl_nav_around_request *request, float agent_radius,
                                              tl_nav_location *place_out);

/// How near a path of straight lines over the surface comes to a wall, in the plane: metres, or max_distance when no
/// wall is nearer. Each corner must lie on its polygon. TL_ERR_LIMIT: the query was out of nodes. TL_NOT_FOUND: a
/// stale reference. TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: no corner, or a negative distance.
TL_API tl_result tl_nav_query_path_clearance(tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_filter *filter, const tl_nav_corner *corners, uint32_t count,
                                             float max_distance, float *clearance_out);

#ifdef __cplusplus
}
#endif

#endif
