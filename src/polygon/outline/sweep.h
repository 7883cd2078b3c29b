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

#define TL_NO_SEGMENT UINT32_MAX

/// What a sweep that finds no contact has seen, for those who go the same way again.
typedef struct tl_sweep_record {
    uint32_t *order; // the points by rising x, then z
    uint32_t *below; // in that order, of points with segments: the next one below them, or TL_NO_SEGMENT
} tl_sweep_record;

/// A sweep over an outline's edges that found no contact. Vertices at one place are one point, edges that run along one
/// another there and back are one segment.
typedef struct tl_outline_sweep {
    tl_sweep_record record;
    uint32_t place_count, segment_count; // 0: there was none
    uint32_t *place_of;   // [vertex], or NULL: each vertex has a place of its own, and each edge its segment
    uint32_t *segment_of; // [edge] by the vertex where it starts
} tl_outline_sweep;

/// Room for `point_count` points. False: out of memory.
bool tl_sweep_record_init(tl_sweep_record *record, tl_arena *arena, uint32_t point_count);

/// Whether all points lie at different places and no two segments share a point that is not an end of both. Each
/// segment is there once; NULL: segment i runs from point i to the next, and there are as many. `record` may be NULL.
/// Memory comes from `arena`; TL_ERR_MEMORY is the only error.
tl_result tl_sweep_segments(tl_arena *arena, const tl_lattice_point *points, uint32_t point_count,
                            const tl_lattice_segment *segments, uint32_t segment_count, tl_sweep_record *record,
                            bool *apart_out);

/// Whether the sweep passes a before b.
static inline bool tl_is_swept_first(tl_lattice_point a, tl_lattice_point b)
{
    return a.x != b.x ? a.x < b.x : a.z < b.z;
}

#endif
