// SPDX-License-Identifier: MIT
//
// Reads of a tile that are more than one array access.

#include "nav_format/lattice_polygon.h"

#include "base/exact_floats.h"

uint32_t tl_nav_tile_neighbour(const tl_nav_tile *tile, uint32_t polygon, uint32_t edge)
{
    uint32_t link = tl_nav_tile_links(tile, polygon)[edge];
    if (link == TL_NAV_LINK_WALL || (link & TL_NAV_LINK_PORTAL) == 0) {
        return link == TL_NAV_LINK_WALL ? TL_NO_POLYGON : link;
    }
    return TL_PORTAL | tl_nav_tile_side_of(tile, link & ~TL_NAV_LINK_PORTAL);
}

double tl_nav_tile_polygon_area(const tl_nav_tile *tile, uint32_t polygon)
{
    const uint32_t *first = tl_nav_tile_at(tile, tile->first_corner);
    const uint32_t *corner_vertices = tl_nav_tile_at(tile, tile->corner_vertices);
    int64_t area2 = tl_nav_double_area(tl_nav_tile_at(tile, tile->vertices), corner_vertices + first[polygon],
                                       first[polygon + 1] - first[polygon]);
    return 0.5 * (double)area2 * ((double)tile->cell_size * (double)tile->cell_size);
}
