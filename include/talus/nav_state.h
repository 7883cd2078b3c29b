// SPDX-License-Identifier: MIT
//
// What a game changes of a navmesh while it runs: flags and areas of polygons. A door that is shut, a bridge that is
// down, a street that burns: flags say by a filter who may pass, and an area's cost how dear it is.
//
// All queries see a change from the next call on: they read the tile, and a changed tile is a copy of the one that was
// added, which stays as it is (a mapped file is not written to). References stay valid, islands are the same (they
// know no flags), and a prepared navmesh stays prepared. Sliced searches that have seen the tile become
// TL_NAV_PATH_STALE. tl_navmesh_slot_tile, tl_navmesh_find_tile and tl_navmesh_resolve give the tile as it is now, so
// that it can be filed or exported as it is; a pointer that they gave before the first change, or before
// tl_navmesh_reset_state, is the caller's to ask for anew.
//
// How long a change lasts: as long as its tile. A tile that is removed, or replaced by one with other bytes, takes its
// changes along, and a tile that is added begins as it was baked. tl_navmesh_replace_tiles, and so
// tl_nav_obstacles_update, leave a tile whose baked bytes are the same where it is, changes included. To carry changes
// over the removal of a tile that comes back, such as one that is streamed, store them before and restore them after.
//
// Functions that change something run alone: no query may run meanwhile, but on other versions (nav_versions.h).
// TL_ERR_ARGUMENT: a needed pointer is NULL.

#ifndef TALUS_NAV_STATE_H
#define TALUS_NAV_STATE_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A polygon's flags, and its area. After an error the output is 0. TL_ERR_STALE.
TL_API tl_result tl_navmesh_polygon_flags(const tl_navmesh *navmesh, tl_nav_ref polygon, uint64_t *flags_out);
TL_API tl_result tl_navmesh_polygon_area(const tl_navmesh *navmesh, tl_nav_ref polygon, uint8_t *area_out);

/// Gives a polygon other flags; 0: no filter passes it. The first change of a tile copies it, O(its bytes), then O(1).
/// TL_ERR_STALE, TL_ERR_MEMORY: nothing is changed.
TL_API tl_result tl_navmesh_set_polygon_flags(tl_navmesh *navmesh, tl_nav_ref polygon, uint64_t flags);
/// Gives a polygon another area, 1 to TL_NAV_MAX_AREA (0, not walkable, is TL_ERR_ARGUMENT: use flags). Else as
/// tl_navmesh_set_polygon_flags.
TL_API tl_result tl_navmesh_set_polygon_area(tl_navmesh *navmesh, tl_nav_ref polygon, uint8_t area);

/// What can be changed of a polygon.
typedef struct tl_nav_polygon_state {
    uint64_t flags;
    uint8_t area; ///< 1 to TL_NAV_MAX_AREA
} tl_nav_polygon_state;

/// Stores the state of all polygons of the tile at a place (`layer` 0 where it is not divided), polygon 0 first.
/// Writes the first `capacity`; `*count_out` is the true count. TL_INCOMPLETE: that is more. TL_NOT_FOUND: there is no
/// such tile. O(polygons).
TL_API tl_result tl_navmesh_store_state(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z,
                                        tl_nav_polygon_state *states_out, uint32_t capacity, uint32_t *count_out);

/// Gives all polygons of the tile at a place the state that was stored of the same tile. TL_NOT_FOUND: there is no such
/// tile. TL_ERR_STALE: it has another number of polygons, so it is another tile; that the tile is the same where the
/// numbers are is the caller's duty. TL_ERR_ARGUMENT: an area is 0; TL_ERR_MEMORY. `report` (may be NULL) names the
/// "state". On failure nothing is changed. O(polygons).
TL_API tl_result tl_navmesh_restore_state(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z,
                                          const tl_nav_polygon_state *states, uint32_t count, tl_report *report);

/// Makes the tile at a place as it was baked, and gives the memory of its copy back. TL_NOT_FOUND: there is no such
/// tile.
TL_API tl_result tl_navmesh_reset_state(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z);

/// Whether a tile in the navmesh has another state than it was baked with, or had since it was added.
TL_API bool tl_navmesh_is_state_changed(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z);

#ifdef __cplusplus
}
#endif

#endif
