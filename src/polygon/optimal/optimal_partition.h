// SPDX-License-Identifier: MIT
//
// Fewest convex polygons for one outline.

#ifndef TALUS_SRC_POLYGON_OPTIMAL_PARTITION_H
#define TALUS_SRC_POLYGON_OPTIMAL_PARTITION_H

#include "polygon/merge/polygon_merge.h"
#include "polygon/optimal/visibility.h"

/// Divides an outline along chords between its corners into as few strictly convex
/// polygons of at most `max_corners` corners (0: any number) as there can be. parts_out->corners are corners of the
/// outline, rising in each polygon. When it would take more than `max_steps` steps, *found is false and nothing is
/// written. TL_ERR_MEMORY is the only error.
tl_result tl_partition_optimally(tl_arena *arena, const tl_triangulated_outline *outline,
                                 const tl_visibility *visibility, uint32_t max_corners, uint64_t max_steps,
                                 tl_convex_parts *parts_out, bool *found);

#endif
