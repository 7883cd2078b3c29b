// SPDX-License-Identifier: MIT
//
// Putting the ends of off-mesh links on polygons and taking them off.

#ifndef TALUS_SRC_NAV_QUERY_OFFMESH_ANCHOR_H
#define TALUS_SRC_NAV_QUERY_OFFMESH_ANCHOR_H

#include "nav_query/navmesh/navmesh.h"

/// The first end of a link that is anchored in a slot, TL_NAV_NO_END when there is none; then the next one in its
/// bucket. Others than this polygon's are among them.
static inline uint32_t tl_nav_first_anchor(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_offmesh_table *table = &navmesh->offmesh;
    return navmesh->slots[slot].anchor_count > 0 ? table->buckets[tl_nav_anchor_bucket(table, slot, polygon)]
                                                 : TL_NAV_NO_END;
}

/// Anchors the ends of off-mesh links near a slot anew, after its tile has come, or for those that stood on it, before
/// it is freed but after it can be found no more. Seeds the islands where a link was lost.
void tl_nav_anchor_near(tl_navmesh *navmesh, uint32_t slot, bool tile_leaves);
/// Anchors both ends of a link that is anchored nowhere, where there are polygons.
void tl_nav_anchor_link(tl_navmesh *navmesh, uint32_t index);
/// Takes both ends of a link off their polygons.
void tl_nav_release_anchors(tl_navmesh *navmesh, uint32_t index);
/// tl_navmesh_find_nearest among all polygons, those that no filter passes too (nearest_polygon.c).
tl_result tl_nav_find_nearest_of_any_flags(const tl_navmesh *navmesh, tl_vec3 center, tl_vec3 half_extents,
                                           tl_nav_location *location_out);
/// Puts all anchored ends into fresh buckets.
void tl_nav_fill_buckets(tl_nav_offmesh_table *table);

#endif
