// SPDX-License-Identifier: MIT
//
// Reads of a tile that are more than one array access.

#include "nav_format/lattice_polygon.h"

#include "base/exact_floats.h"

uint32_t tl_nav_tile_neighbour(const tl_nav_tile *tile, uint32_t polygon, uint32_t edge)
{
    const uint32_t link = tl_nav_tile_edge_link(tile, polygon, edge);
    if (!tl_nav_is_portal(link)) {
        return link == TL_NAV_LINK_WALL ? TL_NO_POLYGON : link;
    }
    return TL_PORTAL | tl_nav_tile_side_of(tile, tl_nav_link_portal(link));
}

double tl_nav_tile_polygon_area(const tl_nav_tile *tile, uint32_t polygon)
{
    tl_nav_lattice_polygon outline;
    tl_nav_gather_tile_polygon(tile, polygon, &outline);
    return 0.5 * (double)tl_nav_double_area(&outline) * ((double)tile->cell_size * (double)tile->cell_size);
}
