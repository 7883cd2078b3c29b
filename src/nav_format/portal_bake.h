// SPDX-License-Identifier: MIT
//
// Portals: the edges on a tile's border, and how high the surface runs along them.

#ifndef TALUS_SRC_NAV_FORMAT_PORTAL_BAKE_H
#define TALUS_SRC_NAV_FORMAT_PORTAL_BAKE_H

#include "base/arena.h"

#include <talus/nav_tile.h>

typedef struct tl_nav_portals {
    tl_nav_portal *portals; ///< in the tile's order
    uint32_t portal_count;
    uint32_t side_end[4];
    tl_nav_profile_point *profile;
    uint32_t profile_count;
} tl_nav_portals;

/// Gathers a checked source's portals. The arrays live in the arena. TL_ERR_MEMORY, TL_ERR_LIMIT; TL_ERR_ARGUMENT: two
/// cuts that nothing tells apart.
tl_result tl_nav_bake_portals(const tl_nav_tile_source *source, tl_arena *arena, tl_nav_portals *portals_out,
                              tl_report *report);

#endif
