// SPDX-License-Identifier: MIT
//
// Merging of one contour's triangles into convex polygons.

#ifndef TALUS_SRC_POLYGON_POLYGON_MERGE_H
#define TALUS_SRC_POLYGON_POLYGON_MERGE_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/trace_steps.h"

/// The polygons made of one contour: polygon p has the corners corners[first[p] .. first[p + 1] - 1].
typedef struct tl_convex_parts {
    uint32_t count;
    uint32_t *first;   // [count + 1]
    uint32_t *corners; // numbers as in the triangles
    uint32_t *part_of; // [triangle] the polygon that holds it; only where some edges are joined first
} tl_convex_parts;

/// What to merge.
typedef struct tl_merge_input {
    const tl_lattice_point *points;
    const uint32_t *corners; // [3 * triangle_count] indices of points
    const uint32_t *twins;   // [3 * triangle_count] as tl_triangulate gives them
    uint32_t triangle_count;
    uint32_t max_corners;         // 0: any number
    const uint8_t *joined_first;  // [3 * triangle_count] or NULL: edges that go before all others, on both sides
    const tl_step_tracer *tracer; // or NULL
    const uint32_t *places;       // [triangle] its place at first, as tl_triangulate gives it, or NULL: its number
} tl_merge_input;

/// Merges triangles across the longest shared edge first, while the result is strictly convex and has at most
/// max_corners corners. Results lie in `arena`. TL_ERR_MEMORY is the only error. O(n log n).
tl_result tl_merge_triangles(tl_arena *arena, const tl_merge_input *input, tl_convex_parts *parts_out);

#endif
