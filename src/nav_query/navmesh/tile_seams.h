// SPDX-License-Identifier: MIT
//
// What a tile that comes in changes around it: links over its seams, both ways, and the rings of all tiles that get
// some. All of it is made before anything is changed, so that a tile comes in whole or not at all.

#ifndef TALUS_SRC_NAV_QUERY_TILE_SEAMS_H
#define TALUS_SRC_NAV_QUERY_TILE_SEAMS_H

#include "nav_query/navmesh/tile_links.h"

/// A tile around a new one that gets links to it: what becomes of its facing side and its rings.
typedef struct tl_nav_seam_neighbour {
    uint32_t slot, side; ///< the new tile's side
    uint32_t added;      ///< links
    tl_nav_side_links facing;
    bool reopens; ///< its rings stay, and closed ways in them open again; else new ones:
    tl_nav_rings rings;
} tl_nav_seam_neighbour;

typedef struct tl_nav_seams {
    tl_nav_seam_neighbour *neighbours; ///< [neighbour_count]
    uint32_t neighbour_count, neighbour_capacity;
    tl_nav_side_links own[TL_NAV_SIDE_COUNT];
    tl_nav_rings rings; ///< the new tile's
} tl_nav_seams;

/// Of the tiles that a side of a place faces: the first one's slot; tl_nav_next_slot gives the others. Beyond a cut
/// lies the place itself.
uint32_t tl_nav_first_facing(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, uint32_t side);

/// The seams of a tile that is to come into a slot. TL_ERR_MEMORY, and then there is nothing to free.
tl_result tl_nav_seams_make(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, tl_nav_seams *seams_out);
void tl_nav_seams_free(const tl_navmesh *navmesh, tl_nav_seams *seams);
/// Of the new tile and of those around it, the most links over seams that one will have.
uint32_t tl_nav_seams_most(const tl_navmesh *navmesh, const tl_nav_seams *seams);
/// Whether a slot gets new rings. NULL: none does.
bool tl_nav_seams_remake(const tl_nav_seams *seams, uint32_t slot);
/// Puts them in place, in the slot, which has its tile, and around it. They are the navmesh's then.
void tl_nav_seams_install(tl_navmesh *navmesh, uint32_t slot, tl_nav_seams *seams);
/// Takes the links to a slot out of the tiles around it.
void tl_nav_unlink_slot(tl_navmesh *navmesh, uint32_t slot);

#endif
