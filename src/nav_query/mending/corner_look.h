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

/// What all looks of a mend share, and none changes.
typedef struct tl_nav_look_ground {
    const tl_nav_change_sectors *sectors;
    const tl_nav_graph_changes *changes;
    // Of all polygons, those of slot s from first_polygon[s] on.
    uint32_t *first_polygon; ///< [graph->slot_count + 1]
    bool *is_new;            ///< it came, or may have changed
} tl_nav_look_ground;

/// Looks one after another, and what all of them have seen.
typedef struct tl_nav_corner_look {
    const tl_nav_look_ground *ground;
    tl_nav_query *query;
    tl_nav_seen seen;
    tl_nav_cone_list cones;
    tl_nav_pair_list dropped; ///< slot and cone, as tl_nav_change_sectors.dropped
    uint32_t vertex;          ///< that looks
    uint32_t *last_looks;     ///< [graph->slot_count], by slot: the last look that had cones in it, counted from 1
    uint32_t look_count;
    tl_result result; ///< of all looks; after a failure there is none
    // Of one look towards changes.
    tl_nav_view view;
    tl_nav_number_list is_changed; ///< by wedge: whether its sight leads through a change
    uint32_t *last_anew;           ///< by polygon of the ground: the last look that finds its cones there anew
} tl_nav_corner_look;

/// TL_ERR_MEMORY. tl_nav_free_look_ground frees what it keeps, after an error too.
tl_result tl_nav_make_look_ground(const tl_nav_change_sectors *sectors, tl_nav_look_ground *ground_out);
void tl_nav_free_look_ground(tl_nav_look_ground *ground);

/// Looks from a corner vertex: all around, or towards changes, as its mark says. `look` is all 0 at first. Its result
/// may become TL_ERR_MEMORY, TL_ERR_LIMIT. tl_nav_end_looks frees what it keeps.
void tl_nav_look_from(const tl_nav_look_ground *ground, tl_nav_corner_look *look, uint32_t vertex);
void tl_nav_end_looks(tl_nav_corner_look *look);

#endif
