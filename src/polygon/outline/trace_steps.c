// SPDX-License-Identifier: MIT
//
// Steps come as indices of points, which are local to one outline; the callback gets coordinates.

#include "polygon/outline/trace_steps.h"

#include "base/assert.h"

static const int32_t *coordinates(tl_arena *arena, const tl_lattice_point *points, const uint32_t *indices,
                                  uint32_t count)
{
    int32_t *out = TL_PUSH(arena, int32_t, 2 * (uint64_t)count);
    for (uint32_t i = 0; out != NULL && i < count; i++) {
        out[2 * (size_t)i] = points[indices[i]].x;
        out[2 * (size_t)i + 1] = points[indices[i]].z;
    }
    return out;
}

tl_result tl_trace_step(const tl_step_tracer *tracer, tl_arena *scratch, const tl_lattice_point *points,
                        const tl_traced_step *step)
{
    tl_arena_mark mark = tl_arena_get_mark(scratch);
    tl_polygon_step out;
    out.kind = step->kind;
    out.contour = tracer->contour;
    out.partition_count = step->partition_count;
    out.partitions = coordinates(scratch, points, step->partitions, 2 * step->partition_count);
    out.outline_count = step->outline_count;
    out.outline = coordinates(scratch, points, step->outline, step->outline_count);
    out.corner_count = step->corner_count;
    out.corners = coordinates(scratch, points, step->corners, step->corner_count);
    if (out.partitions == NULL || out.outline == NULL || out.corners == NULL) {
        return TL_ERR_MEMORY;
    }
    tracer->trace->step(&out, tracer->trace->user);
    tl_arena_rollback(scratch, mark);
    return TL_OK;
}
