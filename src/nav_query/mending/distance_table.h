// SPDX-License-Identifier: MIT
//
// The table of a visibility graph's distances (distance_table.c).

#ifndef TALUS_SRC_NAV_QUERY_DISTANCE_TABLE_H
#define TALUS_SRC_NAV_QUERY_DISTANCE_TABLE_H

#include "nav_query/prepared/visibility_graph.h"

/// Fills in the graph's table. TL_ERR_MEMORY.
tl_result tl_nav_bake_corner_distances(const tl_allocator *allocator, const tl_host *host,
                                       tl_nav_visibility_graph *graph);

#endif
