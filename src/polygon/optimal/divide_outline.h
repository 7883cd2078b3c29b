// SPDX-License-Identifier: MIT
//
// From an outline to convex polygons, by the method asked for.

#ifndef TALUS_SRC_POLYGON_DIVIDE_OUTLINE_H
#define TALUS_SRC_POLYGON_DIVIDE_OUTLINE_H

#include "polygon/merge/polygon_merge.h"
#include "polygon/outline/outline.h"

typedef struct tl_division {
    tl_convex_parts parts;   // corners are nodes of the outline
    uint32_t triangle_count; // of the triangulation, before merging
    uint32_t lower_bound;    // no way to divide the outline along chords between its corners takes fewer polygons
} tl_division;

/// Triangles of an outline, walk after walk. Corners are nodes; twins as tl_triangulate gives them, and once bridges
/// are paired, on bridges too.
typedef struct tl_outline_triangles {
    uint32_t count;
    uint32_t *corners;
    uint32_t *twins;
    uint32_t *places;      // [triangle] as tl_triangulate gives it, or NULL
    uint32_t bridge_count; // pairs of edges that are on the outline there and back
} tl_outline_triangles;

/// Divides an outline that has walks. Results lie in `arena`. Errors: TL_ERR_MEMORY, and TL_ERR_SELF_INTERSECTION where
/// the outline is not as tl_outline_prepare makes it. `tracer` may be NULL.
tl_result tl_divide_outline(tl_arena *arena, const tl_outline *outline, tl_partition_method method,
                            uint32_t max_corners, const tl_step_tracer *tracer, tl_division *division_out);

/// Pairs edges without a twin that run there and back between two corners. Adds the pairs to *pair_count.
tl_result tl_pair_edges(tl_arena *arena, const uint32_t *corners, uint32_t *twins, uint32_t edge_count,
                        uint32_t *pair_count);

/// Fewest polygons: exact where the outline is small enough and has no bridges; *is_exact says so. Takes triangles
/// whose bridges are not paired; pairs them where it is not exact.
tl_result tl_divide_optimally(tl_arena *arena, const tl_outline *outline, uint32_t max_corners,
                              tl_outline_triangles *triangles, tl_convex_parts *parts_out, bool *is_exact);

#endif
