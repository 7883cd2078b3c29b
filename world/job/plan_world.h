// SPDX-License-Identifier: MIT
//
// Planning a world: inputs into the store, tiles with their keys into the job's plan.

#ifndef TALUS_WORLD_PLAN_WORLD_H
#define TALUS_WORLD_PLAN_WORLD_H

#include "world/job/plan_file.h"

typedef struct tl_world_plan_def {
    const char *input, *job; ///< paths
    tl_nav_def nav;          ///< tile_size > 0; its host is used for all; empty bounds: those of the world
    tl_world_reading reading;
    bool has_origin;  ///< else it is chosen: 0, but on axes where the world lies beyond 16,384 m its middle
    double origin[3]; ///< metres
    uint64_t memory;  ///< bytes for segments in the making, of all workers
} tl_world_plan_def;

typedef struct tl_world_plan_report {
    uint64_t inputs, inputs_read, segments;
    uint64_t triangles, degenerate; ///< of all inputs, read now or before
    uint64_t tiles;                 ///< that hold triangles
    uint64_t store_bytes;
    uint32_t tiles_x, tiles_z;
    double origin[3];
} tl_world_plan_report;

/// Makes or renews the plan of a job. What is in the store already is not read again. `error_out` is told of the first
/// input, in the list's order, that cannot be read.
tl_result tl_world_plan_make(const tl_world_plan_def *def, tl_world_plan_report *report_out, tl_io_error *error_out);

#endif
