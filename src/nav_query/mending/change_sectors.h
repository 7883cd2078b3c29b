// SPDX-License-Identifier: MIT
//
// In which directions corner vertices may see a change, and what they have seen there (change_sectors.c).

#ifndef TALUS_SRC_NAV_QUERY_CHANGE_SECTORS_H
#define TALUS_SRC_NAV_QUERY_CHANGE_SECTORS_H

#include "nav_query/mending/graph_changes.h"
#include "nav_query/mending/sector.h"

/// Roundings of the graph by which what lies at one place, or side by side, may be taken for apart or for overlapping.
#define TL_NAV_PLACE_MARGIN 8.0

/// Slacks of a cone by which it is taken to be wider than it is kept.
#define TL_NAV_CONE_MARGIN 4.0

/// Directions in which a corner vertex sees a convex region that may have changed: the box of a tile, a polygon, or
/// where a corner vertex was that is gone.
typedef struct tl_nav_change_sector {
    tl_nav_sector sector;
    tl_nav_sector_rays rays;
    uint32_t slot;    ///< of the region; TL_NAV_NO_SLOT: a corner vertex
    uint32_t polygon; ///< of the slot; TL_NO_POLYGON: all of it. Or the place of the corner vertex among those gone
} tl_nav_change_sector;

typedef struct tl_nav_change_sectors {
    tl_nav_graph_changes *changes;
    tl_nav_change_sector *sectors;
    uint64_t *first; ///< [changes->first_fresh + 1], by looker: where its sectors begin
    uint64_t count, capacity;
    /// Cones that were seen in a polygon beyond a change, or on one: place of the looker and slot; as value the cone,
    /// as extra its polygon's new number. Sorted.
    tl_nav_pair_list beyond;
    tl_nav_pair_list dropped; ///< slot and cone: those, and others that looks have found
    tl_nav_pair_list lost;    ///< corner vertex and slot, in which all of its cones are dropped
} tl_nav_change_sectors;

/// Marks corner vertices that look all around, and finds for the others their sectors and cones beyond. Notes the slots
/// whose cones may go. Runs on the host's tasks. TL_ERR_MEMORY, TL_ERR_LIMIT. tl_nav_free_change_sectors frees what is
/// returned, after an error too.
tl_result tl_nav_find_change_sectors(tl_nav_graph_changes *changes, const tl_host *host,
                                     tl_nav_change_sectors *sectors_out);
void tl_nav_free_change_sectors(tl_nav_change_sectors *sectors);

/// Whether the edge between two corner vertices that look stays: not both see a change along it.
bool tl_nav_is_edge_kept(const tl_nav_change_sectors *sectors, uint32_t from, uint32_t to);

/// The sector of a cone, a little wider than the cone is kept.
tl_nav_sector tl_nav_sector_of_cone(const tl_nav_corner_cones *cones, uint32_t cone);

static inline bool tl_nav_is_in_box(const tl_nav_plan_box *box, const tl_nav_corner_vertex *vertex)
{
    return vertex->x >= box->low_x && vertex->x <= box->high_x && vertex->z >= box->low_z && vertex->z <= box->high_z;
}

#endif
