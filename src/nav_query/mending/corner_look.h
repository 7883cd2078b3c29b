// SPDX-License-Identifier: MIT
//
// What can be seen from a corner vertex (corner_look.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_LOOK_H
#define TALUS_SRC_NAV_QUERY_CORNER_LOOK_H

#include "nav_query/mending/corner_sights.h"

enum { TL_NAV_MAX_VIEW = 32 };

/// The sectors in which a corner vertex looks, apart from one another.
typedef struct tl_nav_view {
    tl_nav_sector sectors[TL_NAV_MAX_VIEW];
    tl_nav_sector_rays rays[TL_NAV_MAX_VIEW]; ///< theirs, while it looks
    uint32_t count;
} tl_nav_view;

/// Looks of corner vertices, and what all of them have seen.
typedef struct tl_nav_corner_look {
    tl_nav_change_sectors *sectors;
    const tl_nav_graph_changes *changes;
    tl_nav_query *query;
    tl_nav_seen seen;
    tl_nav_cone_list cones;
    uint32_t vertex;      ///< that looks
    uint32_t *last_looks; ///< [graph->slot_count], by slot: the last look that had cones in it, counted from 1
    uint32_t look_count;
    tl_result result; ///< of `seen`
    // Of one look towards changes.
    tl_nav_view view;
    tl_nav_number_list is_changed; ///< by wedge: whether its sight leads through a change
    // Of all polygons, those of slot s from first_polygon[s] on.
    uint32_t *first_polygon; ///< [graph->slot_count + 1]
    bool *is_new;            ///< it came, or may have changed
    uint32_t *last_anew;     ///< the last look that finds its cones there anew
} tl_nav_corner_look;

/// TL_ERR_MEMORY. tl_nav_end_looks frees what it keeps, after an error too.
tl_result tl_nav_begin_looks(tl_nav_change_sectors *sectors, tl_nav_corner_look *look_out);
void tl_nav_end_looks(tl_nav_corner_look *look);

/// Looks from a corner vertex: all around, or towards changes, as its mark says. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_look_from(tl_nav_corner_look *look, uint32_t vertex);

#endif
