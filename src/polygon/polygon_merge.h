// SPDX-License-Identifier: MIT
//
// Merging of one contour's triangles into convex polygons.

#ifndef TALUS_SRC_POLYGON_POLYGON_MERGE_H
#define TALUS_SRC_POLYGON_POLYGON_MERGE_H

#include "base/arena.h"
#include "polygon/lattice.h"

/// The polygons made of one contour: polygon p has the corners corners[first[p] .. first[p + 1] - 1].
typedef struct tl_convex_parts {
    uint32_t count;
    uint32_t *first;   // [count + 1]
    uint32_t *corners; // numbers as in the triangles
    uint32_t *part_of; // [triangle] the polygon that holds it; only where some edges are joined first
} tl_convex_parts;

/// Merges triangles across the longest shared edge first, while the result is strictly convex and has at most
/// `max_corners` corners (0: any number). `corners` are 3 a triangle, indices of points; `twins` as tl_triangulate
/// gives them. joined_first (may be NULL) marks edges that go before all others, on both sides. Results lie in `arena`.
/// TL_ERR_MEMORY is the only error. O(n log n).
tl_result tl_merge_triangles(tl_arena *arena, const tl_lattice_point *points, const uint32_t *corners,
                             const uint32_t *twins, const uint8_t *joined_first, uint32_t triangle_count,
                             uint32_t max_corners, tl_convex_parts *parts_out);

#endif
