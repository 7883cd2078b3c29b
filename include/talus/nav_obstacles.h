// SPDX-License-Identifier: MIT
//
// Temporary obstacles: crates, cars, doors and fires that come, move and go while the game runs.
//
// Each tile's compact heightfield is kept as it was before its regions were made. An obstacle marks floors of it, and
// the tiles that it touches are rebaked from there, without a look at the triangles. A tile's bytes depend on the
// obstacles that are there, not on the order in which they came; without any they are those of the first bake.
//
//   tl_nav_obstacles_bake(&def, &input, &obstacles, NULL, NULL);
//   tl_nav_obstacles_add(obstacles, &crate, &id, NULL);
//   tl_nav_obstacles_update(obstacles, navmesh, 4, &waiting, NULL);   each frame, until nothing is waiting
//
// An obstacles object is used by one thread at a time. tl_nav_obstacles_bake_next never touches a navmesh, so queries
// may run meanwhile. tl_nav_obstacles_update changes the navmesh, as tl_navmesh_replace_tiles does: no query may run
// then.

#ifndef TALUS_NAV_OBSTACLES_H
#define TALUS_NAV_OBSTACLES_H

#include <talus/convex.h>
#include <talus/nav_bake.h>
#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_NAV_MAX_OBSTACLE_POINTS 16

typedef enum tl_nav_obstacle_shape {
    TL_NAV_OBSTACLE_CYLINDER,
    TL_NAV_OBSTACLE_BOX,
    TL_NAV_OBSTACLE_PRISM,  ///< upright, over a convex outline
    TL_NAV_OBSTACLE_CONVEX, ///< any shape of convex.h at any pose: hulls, tilted boxes, capsules, cones ...
} tl_nav_obstacle_shape;

/// An obstacle. Lengths in metres.
typedef struct tl_nav_obstacle {
    tl_nav_obstacle_shape shape;
    /// TL_NAV_NULL_AREA: a solid body. Floors where an agent would overlap it are removed: those on which the agent's
    /// upright cylinder, agent_radius and agent_height, with its foot anywhere in the floor's column of voxels, shares
    /// more than touching points with it. So of an upright body the columns go of which any point lies within the
    /// radius of it, from agent_height below its base to its top; a ramp that leans leaves the floors under it where
    /// the agent can stand. What is left keeps the whole radius from the body, in the plan: outlines near it are
    /// simplified only away from it. Another area: floors whose columns' middles lie inside it get that area (a cost, a
    /// danger), and none is removed.
    uint8_t area;
    tl_vec3 base;         ///< all but CONVEX: the centre of its base
    float height;         ///< all but CONVEX: >= 0
    float radius;         ///< CYLINDER: > 0
    float half_x, half_z; ///< BOX: >= 0, before it is turned
    float cosine, sine;   ///< BOX, PRISM: turned about y, so that local x points to (cosine, -sine) in (x, z). Any
                          ///< length; both 0: not turned
    tl_vec3 points[TL_NAV_MAX_OBSTACLE_POINTS]; ///< PRISM: convex outline around base in x and z, either winding; y: 0
    uint32_t point_count;                       ///< PRISM: >= 3
    /// CONVEX: what it is. The hull, points or function that it borrows must live until the obstacle is removed or
    /// changed, and points must be finite.
    tl_convex convex;
    tl_transform pose; ///< CONVEX: from its own frame to the world
} tl_nav_obstacle;

typedef struct tl_nav_obstacles tl_nav_obstacles;

/// An obstacle's id, until it is removed. Ids are not used again, and are not 0.
typedef uint64_t tl_nav_obstacle_id;

/// Bakes a level in tiles and keeps their compact heightfields. `def` needs a tile_size and bounds. Its tasks and
/// progress hook are used now only, a copy of its allocator later too.
///
/// `block_out`: the tiles without obstacles, as by tl_nav_bake_range. NULL: all tiles wait to be baked, and the first
/// updates fill the navmesh. Errors: TL_ERR_ARGUMENT (no tile_size, no bounds), and those of
/// tl_nav_bake; then `*obstacles_out` is NULL.
TL_API tl_result tl_nav_obstacles_bake(const tl_nav_def *def, const tl_nav_input *input,
                                       tl_nav_obstacles **obstacles_out, tl_nav_tile_block *block_out,
                                       tl_nav_bake_report *report_out);
TL_API void tl_nav_obstacles_destroy(tl_nav_obstacles *obstacles);

/// Several tiles are rebaked at once from now on, one a worker, by tl_nav_obstacles_update, and the triangles of
/// tl_nav_obstacles_rebake by as many. The tasks must live until others are set, or until the end; NULL: the calling
/// thread, as at first. Memory then comes from several threads. What is made is the same. TL_ERR_MEMORY, not
/// for NULL: nothing has changed.
TL_API tl_result tl_nav_obstacles_set_tasks(tl_nav_obstacles *obstacles, const tl_tasks *tasks);

/// Adds an obstacle; the tiles that it touches wait to be rebaked. Takes a microsecond or less, and memory only
/// where the list of obstacles grows. TL_ERR_ARGUMENT (a size, an outline that is not convex, a `convex` that no
/// function of convex.h made), TL_ERR_NOT_FINITE, TL_ERR_MEMORY.
TL_API tl_result tl_nav_obstacles_add(tl_nav_obstacles *obstacles, const tl_nav_obstacle *obstacle,
                                      tl_nav_obstacle_id *id_out, tl_report *report_out);
/// Moves an obstacle, or changes its shape: the tiles of its old and its new place wait. TL_ERR_STALE: the id is not in
/// use; else as tl_nav_obstacles_add.
TL_API tl_result tl_nav_obstacles_move(tl_nav_obstacles *obstacles, tl_nav_obstacle_id id,
                                       const tl_nav_obstacle *obstacle, tl_report *report_out);
/// TL_ERR_STALE: the id is not in use.
TL_API tl_result tl_nav_obstacles_remove(tl_nav_obstacles *obstacles, tl_nav_obstacle_id id);

TL_API uint32_t tl_nav_obstacles_count(const tl_nav_obstacles *obstacles);
/// Tiles that wait to be rebaked, or to be found as they were.
TL_API uint32_t tl_nav_obstacles_waiting(const tl_nav_obstacles *obstacles);
/// Bytes of the kept heightfields, of the memos of rebaked tiles and of the list of obstacles.
TL_API uint64_t tl_nav_obstacles_bytes(const tl_nav_obstacles *obstacles);

/// Rebakes, from triangles, the heightfields that a change of the level inside `changed` can have touched; those tiles
/// wait. `input` is the level as it is now; the obstacles stay. Errors as tl_nav_rebake; then nothing is changed.
TL_API tl_result tl_nav_obstacles_rebake(tl_nav_obstacles *obstacles, const tl_nav_input *input, tl_aabb changed,
                                         tl_nav_bake_report *report_out);

/// A rebaked tile: all layers of its place, where it is divided.
typedef struct tl_nav_rebaked_tile {
    int32_t tile_x, tile_z;
    tl_nav_tile_stack stack; ///< the caller's, from the def's allocator; empty: nothing is walkable there now
} tl_nav_rebaked_tile;

/// Rebakes the tile that has waited longest, and drops those before it that need none: all floors of theirs are marked
/// as they were when the tile was last handed out, by this function or by tl_nav_obstacles_bake. Hand its stack to
/// tl_navmesh_replace_tiles, or free it; it does not come again before its floors change. TL_NOT_FOUND: none is left.
/// On failure it keeps waiting.
TL_API tl_result tl_nav_obstacles_bake_next(tl_nav_obstacles *obstacles, tl_nav_rebaked_tile *rebaked_out,
                                            tl_nav_bake_report *report_out);

/// Rebakes up to `max_tiles` waiting tiles, as tl_nav_obstacles_bake_next does, and replaces the old ones in the
/// navmesh, as tl_navmesh_replace_tiles does: a tile or layer whose bytes are the same stays. The navmesh owns the new
/// ones.
/// `*waiting_out` (may be NULL): how many wait still. On failure the tile in work keeps waiting, and the navmesh has
/// the old one or, when it ran out of memory, none or some of its layers.
TL_API tl_result tl_nav_obstacles_update(tl_nav_obstacles *obstacles, tl_navmesh *navmesh, uint32_t max_tiles,
                                         uint32_t *waiting_out, tl_nav_bake_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
