// SPDX-License-Identifier: MIT
//
// Numbers of the vertices at which shortest paths may turn (fans.c).

#ifndef TALUS_SRC_NAV_QUERY_FANS_H
#define TALUS_SRC_NAV_QUERY_FANS_H

#include "nav_query/navmesh/navmesh.h"

/// Finds which walls each edge of a tile's rings has where it starts: walls_of[edge] is one of TL_NAV_WALLS_..., or its
/// own, from TL_NAV_WALLS_FIRST on. Returns how many there are, the shared ones included. Vertices where a path may
/// ever turn have their own: those on a portal, and others by their walls.
uint32_t tl_nav_assign_walls(const tl_nav_rings *rings, uint32_t *walls_of);

/// Numbers the turning vertices of all fans that touch a slot's polygons (fans.c).
void tl_nav_number_fans(tl_navmesh *navmesh, uint32_t slot);
/// The same for the fans that touch one side of a slot's tile: those that change when a tile comes or goes there.
void tl_nav_number_fans_on_side(tl_navmesh *navmesh, uint32_t slot, uint32_t side);

/// Notes near which of the `count` edges of the ring across a seam's edge, at a place among all of the tile's, stands.
void tl_nav_set_seam_twin(const tl_nav_rings *rings, uint64_t place, uint32_t twin, uint32_t count);

#endif
