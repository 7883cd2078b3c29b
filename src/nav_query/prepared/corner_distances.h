// SPDX-License-Identifier: MIT
//
// The table of all-pairs shortest distances between corner vertices (corner_distances.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_DISTANCES_H
#define TALUS_SRC_NAV_QUERY_CORNER_DISTANCES_H

#include "nav_query/prepared/path_ends.h"

/// Bytes that the table takes; UINT64_MAX: there are more corner vertices than it can hold.
uint64_t tl_nav_corner_distances_size(const tl_nav_visibility_graph *graph);
/// Releases the table.
void tl_nav_free_corner_distances(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// The best pair of legs by the table. Reorders the legs.
tl_nav_meeting tl_nav_best_by_table(const tl_nav_visibility_graph *graph, tl_nav_ends *ends);
/// The corner vertices on the path of a pair, the last one first. Returns their number; UINT32_MAX: more than capacity.
uint32_t tl_nav_unpack_table(const tl_nav_visibility_graph *graph, const tl_nav_meeting *meeting, uint64_t *vertices,
                             uint32_t capacity);

#endif
