// SPDX-License-Identifier: MIT
//
// Do any segments meet outside their ends? O(n log n).

#ifndef TALUS_SRC_POLYGON_SWEEP_H
#define TALUS_SRC_POLYGON_SWEEP_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

/// Two points by number; they differ.
typedef struct tl_lattice_segment {
    uint32_t a, b;
} tl_lattice_segment;

/// Whether all points lie at different places and no two segments share a point that is not an end of both. Each
/// segment is there once. Memory comes from `arena`; TL_ERR_MEMORY is the only error.
tl_result tl_sweep_segments(tl_arena *arena, const tl_lattice_point *points, uint32_t point_count,
                            const tl_lattice_segment *segments, uint32_t segment_count, bool *apart_out);

#endif
