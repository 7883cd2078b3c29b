// SPDX-License-Identifier: MIT
//
// A corridor: the polygons from an agent to its target, kept while both move and tiles are added and removed.
//
// A path is searched once; each step then changes only the corridor's ends, and what is far away is examined when the
// agent comes near:
//
//   tl_nav_ref polygons[256];
//   tl_nav_corridor corridor = tl_nav_corridor_init(polygons, 256);
//   tl_nav_corridor_reset(&corridor, &agent);
//   tl_nav_corridor_find(&corridor, query, navmesh, NULL, &goal, &path);
//   each frame:
//     tl_nav_corridor_repair(&corridor, query, navmesh, NULL, extents, &path);     where tiles may have changed
//     tl_nav_corridor_corners(&corridor, navmesh, corners, 3, &count);             corners[1] is where to go
//     tl_nav_corridor_move(&corridor, query, navmesh, NULL, step);                 corridor.position is where it stands
//     tl_nav_corridor_shorten(&corridor, navmesh, NULL, 20.0f, NULL);              now and then
//
// The memory is the caller's; nothing is allocated. One thread at a time uses a corridor and its query. Results are
// those of all searches (nav_query.h); besides, a corridor that was never reset is TL_ERR_ARGUMENT.

#ifndef TALUS_NAV_CORRIDOR_H
#define TALUS_NAV_CORRIDOR_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Polygons that one move or one improvement may cross.
#define TL_NAV_CORRIDOR_STEP 256

/// Read it freely; change it through the functions below.
typedef struct tl_nav_corridor {
    tl_nav_ref *path;  ///< the caller's buffer: as tl_nav_query_find_path writes it, off-mesh links among the polygons
    uint32_t capacity; ///< >= 1
    uint32_t count;    ///< 0: the corridor was not reset yet
    tl_vec3 position;  ///< of the agent, on the first polygon
    tl_vec3 target;    ///< on the last one: the goal, or as near to it as the path leads
    tl_vec3 goal;      ///< the goal that was requested
    bool reaches;      ///< the target is the goal
} tl_nav_corridor;

/// An empty corridor in the caller's buffer, which must outlive it.
TL_API tl_nav_corridor tl_nav_corridor_init(tl_nav_ref *path, uint32_t capacity);

/// Puts agent and target in one place.
TL_API void tl_nav_corridor_reset(tl_nav_corridor *corridor, const tl_nav_location *at);

/// Searches the path from the agent to a goal and writes it into the corridor (tl_nav_query_find_path). A path that
/// does not fit is cut off where the buffer ends: the agent goes that far, and then searches the rest. A partial path
/// leads to its own end. Errors as those of tl_nav_query_find_path; then the corridor is unchanged.
TL_API tl_result tl_nav_corridor_find(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                      const tl_nav_filter *filter, const tl_nav_location *goal, tl_nav_path *path_out);

/// Copies a path that was found elsewhere, by a sliced search for example. Its first polygon must be the corridor's
/// (TL_ERR_ARGUMENT). `target` lies on its last polygon, and is the goal now. Cut off as above.
TL_API tl_result tl_nav_corridor_set_path(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_ref *path,
                                          uint32_t count, tl_vec3 target);

/// The next corners of the straight path; corners[0] is the position. It examines no more of the path than it must:
/// TL_INCOMPLETE says that there are more corners, and `*count_out` is then the capacity. Errors as those of
/// tl_navmesh_straight_path; TL_ERR_STALE or TL_ERR_ARGUMENT after tiles have changed: repair.
TL_API tl_result tl_nav_corridor_corners(const tl_nav_corridor *corridor, const tl_navmesh *navmesh,
                                         tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out);

/// Moves the agent towards a point, along walls (tl_nav_query_move_along_surface), and the corridor's begin with it.
/// The position gets the surface's height. TL_ERR_LIMIT: more than TL_NAV_CORRIDOR_STEP polygons in one move. After an
/// error the corridor is unchanged.
TL_API tl_result tl_nav_corridor_move(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                      const tl_nav_filter *filter, tl_vec3 to);

/// Moves the target in the same way, to follow something that walks. For a target that jumps, search anew.
TL_API tl_result tl_nav_corridor_move_target(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_filter *filter, tl_vec3 to);

/// Takes the next off-mesh link: the corridor then begins where the link lands. `ends_out` (may be NULL) gets the
/// link's two ends, `link_out` (may be NULL) the link. Call it when the agent stands at a corner with
/// TL_NAV_CORNER_LINK; it does not check the polygons up to the link. TL_NOT_FOUND: there is no link ahead.
/// TL_ERR_STALE: it was removed.
TL_API tl_result tl_nav_corridor_pass_link(tl_nav_corridor *corridor, const tl_navmesh *navmesh,
                                           tl_nav_location ends_out[2], tl_nav_ref *link_out);

/// Shortens by rays: where the straight line along the surface to a point of the path, at most `range` metres away, is
/// free and costs no more than the path to that point, the corridor takes it. Up to four points are tried, the farthest
/// first. For an agent that was pushed aside, and for paths that a neighbouring polygon makes shorter. `*changed_out`
/// may be NULL. Errors as those of tl_nav_corridor_corners; then the corridor is unchanged.
TL_API tl_result tl_nav_corridor_shorten(tl_nav_corridor *corridor, const tl_navmesh *navmesh,
                                         const tl_nav_filter *filter, float range, bool *changed_out);

/// Improves by a local search of at most `max_steps` nodes: its path replaces the first `ahead` polygons where it is
/// cheaper. For doors that have opened, and for targets that have moved far. `*changed_out` may be NULL.
TL_API tl_result tl_nav_corridor_improve(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_filter *filter, uint32_t ahead, uint32_t max_steps,
                                         bool *changed_out);

/// How many of the corridor's first entries are valid: they exist, pass the filter, and each leads to the next. At most
/// `max_count` are checked; when all are valid the result is min(max_count, count).
TL_API uint32_t tl_nav_corridor_check(const tl_nav_corridor *corridor, const tl_navmesh *navmesh,
                                      const tl_nav_filter *filter, uint32_t max_count);

/// Repairs the corridor after tiles have changed. A valid one stays as it is (TL_NAV_PATH_COMPLETE, node_count 0).
/// Otherwise agent and goal are moved to the polygons nearest to them within `half_extents`, and the path is searched
/// anew. Without a polygon near the goal the agent stays, and the status is TL_NAV_PATH_UNREACHABLE; the goal is kept
/// for tiles that come back. TL_NOT_FOUND: no polygon near the agent; the corridor is unchanged. Other errors as those
/// of tl_nav_corridor_find; the corridor is then the agent's polygon alone.
TL_API tl_result tl_nav_corridor_repair(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                        const tl_nav_filter *filter, tl_vec3 half_extents, tl_nav_path *path_out);

#ifdef __cplusplus
}
#endif

#endif
