// SPDX-License-Identifier: MIT
//
// The rings that a visibility graph was made from, kept to be compared with those that are there after an edit
// (known_rings.c).

#ifndef TALUS_SRC_NAV_QUERY_KNOWN_RINGS_H
#define TALUS_SRC_NAV_QUERY_KNOWN_RINGS_H

#include "nav_query/mending/number_lists.h"
#include "nav_query/prepared/visibility_graph.h"

/// Makes those of a tile that is there, of the corner vertices that the graph has now. TL_ERR_MEMORY: there are none.
tl_result tl_nav_keep_rings(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph, uint32_t slot);

/// The new number of a polygon is added to `map` for each of a tile's known rings, TL_NO_POLYGON where it is gone: one
/// with the same corners in the plan, in the same order. TL_ERR_MEMORY.
tl_result tl_nav_map_polygons(const tl_navmesh *navmesh, const tl_nav_known_rings *known, uint32_t slot,
                              tl_nav_number_list *map);

/// Whether a polygon's ring has the points of a known one.
bool tl_nav_has_known_points(const tl_nav_known_rings *known, uint32_t polygon, const tl_nav_ring *ring);

tl_nav_plan_box tl_nav_box_of_edges(const tl_nav_known_edge *edges, uint32_t count);

#endif
