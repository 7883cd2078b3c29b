// SPDX-License-Identifier: MIT
//
// Merging of polygons across contours.

#ifndef TALUS_SRC_POLYGON_MERGE_CONTOURS_H
#define TALUS_SRC_POLYGON_MERGE_CONTOURS_H

#include "polygon/mesh/polygon_store.h"

/// Merges polygons of one region and area across the longest shared edge first, while they stay strictly convex and
/// have at most `max_corners` corners. *gone becomes how many polygons there are less.
tl_result tl_merge_across_contours(tl_polygon_store *store, tl_arena *scratch, uint32_t max_corners, uint32_t *gone);

#endif
