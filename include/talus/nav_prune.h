// SPDX-License-Identifier: MIT
//
// Leaving out of a finished navmesh what no agent can use: islands that no given point hangs together with, islands
// inside solids, small islands. An island is what hangs together over tiles and links, so this is asked of all tiles at
// once; a tile that is baked again later comes back whole, and the set is pruned again.

#ifndef TALUS_NAV_PRUNE_H
#define TALUS_NAV_PRUNE_H

#include <talus/mesh.h>
#include <talus/nav_bake.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What is left out; by default nothing is.
typedef struct tl_nav_prune_def {
    /// Metres: places where agents are. Islands without one are left out, unless seed_count is 0; those with one stay,
    /// whatever the rules below say. Each must have a polygon within seed_extents (TL_NOT_FOUND names the seed).
    const tl_vec3 *seeds;
    uint32_t seed_count;
    tl_vec3 seed_extents; ///< half extents; default (2, 4, 2)

    /// Triangles whose closed parts (tl_closed_parts_find; weld them first) are solids: islands inside one are left
    /// out. Of the closed parts around a point the one of least volume decides: a solid when it faces outwards, free
    /// space when it faces inwards, as a room does. An island is inside when the middles of all its polygons are, half
    /// an agent's height above the floor. NULL: no island is inside.
    const tl_mesh_view *solids;

    double min_area; ///< square metres: smaller islands, over all tiles, are left out. Default 0
    tl_host host;    ///< its allocator is the one that the tiles came from
} tl_nav_prune_def;

TL_API tl_nav_prune_def tl_default_nav_prune_def(void);

/// Islands left out for one reason.
typedef struct tl_nav_pruned {
    uint32_t islands;
    uint64_t polygons;
    double area; ///< square metres in the plane
} tl_nav_pruned;

/// Each island that is left out counts once, for the first reason in this order.
typedef struct tl_nav_prune_report {
    tl_report base;
    tl_nav_pruned inside, unreachable, small;
    uint32_t island_count;  ///< that there were
    uint32_t solid_count;   ///< closed parts of `solids` that face outwards
    uint32_t removed_tiles; ///< nothing of them is left
    uint32_t changed_tiles;
} tl_nav_prune_report;

/// Prunes all tiles of a navmesh. Tiles of which nothing is left go, those of which something goes are baked again
/// (tl_nav_tile_subset), the others stay as they are. The same bytes for any number of workers.
///
/// On failure the tiles are as before, and the report (which may be NULL) names the element. Errors: TL_NOT_FOUND
/// (a seed), TL_ERR_NOT_FINITE (a seed), TL_ERR_ARGUMENT (tiles that are no navmesh, extents or area below 0),
/// TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_nav_prune(const tl_nav_prune_def *def, tl_nav_tiles *tiles, tl_nav_prune_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
