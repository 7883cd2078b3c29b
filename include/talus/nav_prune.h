// SPDX-License-Identifier: MIT
//
// Removing from a finished navmesh what no agent can use: connected components (islands) that hold no seed point,
// islands inside solids, and small islands. An island spans tiles and off-mesh links, so all tiles are pruned at once;
// a tile that is baked again later comes back whole, and the set is pruned again.

#ifndef TALUS_NAV_PRUNE_H
#define TALUS_NAV_PRUNE_H

#include <talus/mesh.h>
#include <talus/nav_bake.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What is removed; by default nothing is.
typedef struct tl_nav_prune_def {
    /// Metres: places where agents start. Islands without one are removed, unless seed_count is 0; those with one are
    /// kept, whatever the rules below say. Each must have a polygon within seed_extents.
    const tl_vec3 *seeds;
    uint32_t seed_count;
    tl_vec3 seed_extents; ///< metres, half extents, >= 0. Default (2, 4, 2)

    /// Triangles, welded, whose closed parts (tl_closed_parts_find) are solids: islands inside one are removed. Of the
    /// closed parts around a point the one of least volume decides: it is a solid when it faces outwards, and free
    /// space when it faces inwards, as a room does. An island is inside when the middles of all its polygons are, half
    /// an agent's height above the floor. NULL (the default): no island is inside.
    const tl_mesh_view *solids;

    double min_area; ///< square metres, >= 0: smaller islands, over all tiles, are removed. Default 0
    tl_host host;    ///< progress (stage "prune") and memory, also of the tiles that are baked again
    uint32_t cookie; ///< set by tl_default_nav_prune_def
} tl_nav_prune_def;

TL_API tl_nav_prune_def tl_default_nav_prune_def(void);

/// Islands removed for one reason.
typedef struct tl_nav_pruned {
    uint32_t islands;
    uint64_t polygons;
    double area; ///< square metres in the plane
} tl_nav_pruned;

/// Each removed island counts once, for the first reason in this order.
typedef struct tl_nav_prune_report {
    tl_report base;
    tl_nav_pruned inside, unreachable, small;
    uint32_t island_count;  ///< before pruning
    uint32_t solid_count;   ///< closed parts of `solids` that face outwards
    uint32_t removed_tiles; ///< tiles of which nothing is left
    uint32_t changed_tiles; ///< tiles that lost some of their polygons
} tl_nav_prune_report;

/// Why a polygon was removed: its flags in the tiles of what was removed.
enum { TL_NAV_PRUNED_INSIDE = 1, TL_NAV_PRUNED_UNREACHABLE = 2, TL_NAV_PRUNED_SMALL = 4 };

/// Prunes all tiles of a navmesh. Tiles of which nothing is left are removed, those that lose polygons are baked again
/// (tl_nav_tile_subset), the others stay as they are. The same bytes for any number of workers.
///
/// `removed_out` (may be NULL): what was removed, as tiles of its own, freed with tl_nav_tiles_free; the flags of their
/// polygons say why. tl_nav_audit_run and tl_nav_why take it, as a navmesh, so that they know what was removed on
/// purpose.
///
/// `def` NULL: the default one. `report_out` may be NULL. On failure the tiles are as before, `*removed_out` is zeroed.
/// TL_ERR_ARGUMENT (a field; element "seed": no polygon is near it; element "tile": the tiles are no navmesh),
/// TL_ERR_NOT_FINITE (a seed), TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_nav_prune(const tl_nav_prune_def *def, tl_nav_tiles *tiles, tl_nav_tiles *removed_out,
                              tl_nav_prune_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
