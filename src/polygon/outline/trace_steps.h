// SPDX-License-Identifier: MIT
//
// Reports the steps of dividing a contour to the caller's callback.

#ifndef TALUS_SRC_POLYGON_TRACE_STEPS_H
#define TALUS_SRC_POLYGON_TRACE_STEPS_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

#include <talus/polygon.h>

typedef struct tl_step_tracer {
    const tl_polygon_trace *trace;
    uint32_t contour;
} tl_step_tracer;

/// A tl_polygon_step by indices of points.
typedef struct tl_traced_step {
    tl_polygon_step_kind kind;
    const uint32_t *partitions; // [2 * partition_count]
    uint32_t partition_count;
    const uint32_t *outline;
    uint32_t outline_count;
    const uint32_t *corners;
    uint32_t corner_count;
} tl_traced_step;

/// Calls the trace. What it takes from `scratch` is given back. TL_ERR_MEMORY is the only error.
tl_result tl_trace_step(const tl_step_tracer *tracer, tl_arena *scratch, const tl_lattice_point *points,
                        const tl_traced_step *step);

#endif
