// SPDX-License-Identifier: MIT
//
// The check of a tile's source.

#ifndef TALUS_SRC_NAV_FORMAT_SOURCE_CHECK_H
#define TALUS_SRC_NAV_FORMAT_SOURCE_CHECK_H

#include <talus/nav_tile.h>

/// Refuses a source that would not become a valid tile, and names the element. O(corners, times corners a polygon).
tl_result tl_nav_tile_check_source(const tl_nav_tile_source *source, tl_report *report);

/// The link's target has an edge that runs back over the same two vertices and links here.
/// `first` and `links` are as in a tile; the target must be < polygon count.
bool tl_nav_links_back(const uint32_t *first, const uint32_t *corner_vertices, const uint32_t *links, uint32_t polygon,
                       uint32_t corner);

#endif
