// SPDX-License-Identifier: MIT
//
// Putting the ends of off-mesh links on polygons and taking them off.

#ifndef TALUS_SRC_NAV_QUERY_OFFMESH_ANCHOR_H
#define TALUS_SRC_NAV_QUERY_OFFMESH_ANCHOR_H

#include "nav_query/navmesh/navmesh.h"

/// Anchors both ends of a link that is anchored nowhere, where there are polygons.
void tl_nav_anchor_link(tl_navmesh *navmesh, uint32_t index);
/// Takes both ends of a link off their polygons.
void tl_nav_release_anchors(tl_navmesh *navmesh, uint32_t index);
/// Puts all anchored ends into fresh buckets.
void tl_nav_fill_buckets(tl_nav_offmesh_table *table);

#endif
