// SPDX-License-Identifier: MIT
//
// What corner vertices see, tile by tile: edges and reaches (corner_sights.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_SIGHTS_H
#define TALUS_SRC_NAV_QUERY_CORNER_SIGHTS_H

#include "nav_query/mending/change_sectors.h"

/// What was seen in a mend.
typedef struct tl_nav_seen {
    tl_nav_pair_list edges;   ///< corner vertex, and one that it sees; both ways
    tl_nav_pair_list reaches; ///< corner vertex that has looked, and slot in which it has cones now
} tl_nav_seen;

/// Whether an edge that the graph has stays, whatever is seen.
bool tl_nav_edge_stays(const tl_nav_change_sectors *sectors, uint32_t from, uint32_t to);

/// Makes the edges and reaches of all tiles anew in which some changed: a corner vertex keeps the edges that stay, and
/// has those that were seen besides. Sorts what was seen. TL_ERR_MEMORY, TL_ERR_LIMIT, TL_ERR_CANCELLED: the graph can
/// only be freed.
tl_result tl_nav_remake_sights(const tl_nav_change_sectors *sectors, tl_nav_seen *seen, tl_stage *stage);

#endif
