// SPDX-License-Identifier: MIT
//
// The ways out of a polygon, edge by edge.

#ifndef TALUS_SRC_NAV_QUERY_WAYS_H
#define TALUS_SRC_NAV_QUERY_WAYS_H

#include "nav_query/navmesh/navmesh.h"

typedef struct tl_nav_way {
    uint32_t slot, polygon; ///< where it leads
    uint32_t edge;          ///< of the polygon that is left
    tl_vec3 left, right;    ///< seen looking out
    uint64_t key;           ///< names this way among all of the navmesh
} tl_nav_way;

typedef struct tl_nav_ways {
    const tl_nav_slot *slots;
    const tl_nav_tile *tile;
    uint32_t slot;
    uint32_t first_corner;
    const tl_vec3 *corners;
    uint32_t corner_count;
    uint32_t edge; ///< the next one
    const tl_nav_seam_link *seam, *seam_end;
    uint64_t seam_key; ///< of the next seam link
} tl_nav_ways;

static inline tl_nav_ways tl_nav_ways_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    tl_nav_ways ways;
    ways.slots = navmesh->slots;
    ways.tile = navmesh->slots[slot].tile;
    ways.slot = slot;
    ways.first_corner = tl_nav_tile_first_corner(ways.tile, polygon);
    ways.corners = tl_nav_tile_corners(ways.tile, polygon, &ways.corner_count);
    ways.edge = 0;
    ways.seam = NULL;
    ways.seam_end = NULL;
    ways.seam_key = 0;
    return ways;
}

/// The seam links of a portal. An empty range (both NULL) where no tile lies.
static inline void tl_nav_seam_range(const tl_nav_slot *slot, uint32_t portal, const tl_nav_seam_link **begin_out,
                                     const tl_nav_seam_link **end_out, uint64_t *key_out)
{
    uint32_t side = tl_nav_tile_side_of(slot->tile, portal);
    const tl_nav_side_links *links = &slot->sides[side];
    *begin_out = NULL;
    *end_out = NULL;
    if (links->first != NULL) {
        uint32_t at = portal - tl_nav_tile_side_first(slot->tile, side);
        *begin_out = tl_nav_seam_links_of(links) + links->first[at];
        *end_out = tl_nav_seam_links_of(links) + links->first[at + 1];
        *key_out = (uint64_t)1 << 35 | (uint64_t)side << 32 | links->first[at];
    }
}

/// A way's key: slot (20 bits), then 36 bits: an edge's place among the tile's corners, or seam | side | link.
static inline uint64_t tl_nav_way_key(uint32_t slot, uint64_t place)
{
    return (uint64_t)slot << 36 | place;
}

static inline bool tl_nav_ways_next(tl_nav_ways *ways, tl_nav_way *way_out)
{
    for (;;) {
        if (ways->seam != ways->seam_end) {
            way_out->slot = tl_nav_seam_slot(ways->seam);
            way_out->polygon = tl_nav_seam_polygon(ways->seam);
            way_out->edge = ways->edge - 1;
            const uint32_t portal =
                tl_nav_link_portal(tl_nav_tile_link(ways->tile, ways->first_corner + ways->edge - 1));
            tl_nav_seam_ends(ways->tile, portal, ways->seam, &way_out->left, &way_out->right);
            way_out->key = tl_nav_way_key(ways->slot, ways->seam_key++);
            ways->seam++;
            return true;
        }
        if (ways->edge == ways->corner_count) {
            return false;
        }
        uint32_t edge = ways->edge++;
        const uint32_t link = tl_nav_tile_link(ways->tile, ways->first_corner + edge);
        if (link == TL_NAV_LINK_WALL) {
            continue;
        }
        if ((link & TL_NAV_LINK_PORTAL) != 0) {
            tl_nav_seam_range(&ways->slots[ways->slot], tl_nav_link_portal(link), &ways->seam, &ways->seam_end,
                              &ways->seam_key);
            continue;
        }
        way_out->slot = ways->slot;
        way_out->polygon = link;
        way_out->edge = edge;
        way_out->right = ways->corners[edge];
        way_out->left = ways->corners[edge + 1 < ways->corner_count ? edge + 1 : 0];
        way_out->key = tl_nav_way_key(ways->slot, ways->first_corner + edge);
        return true;
    }
}

#endif
