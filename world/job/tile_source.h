// SPDX-License-Identifier: MIT
//
// The triangles of a tile's window, out of the store: only the cells that reach into it are read.

#ifndef TALUS_WORLD_TILE_SOURCE_H
#define TALUS_WORLD_TILE_SOURCE_H

#include "world/job/plan_file.h"
#include "world/job/segment_set.h"

/// The store, with the cells that each tile of the plan needs.
typedef struct tl_world_source {
    const tl_world_plan *plan;
    tl_world_segments segments;
    uint64_t *first_cell; ///< [plan->tile_count + 1]
    uint64_t *cells;      ///< segment << 40 | cell
} tl_world_source;

/// Opens the store of a job. TL_ERR_IO and others name the segment. Close with tl_world_source_close in any case.
tl_result tl_world_source_open(const char *job, const tl_world_plan *plan, tl_world_source *source_out,
                               tl_io_error *error_out);
void tl_world_source_close(tl_world_source *source);

/// The triangles of a tile: an input for the bake. Each has vertices of its own.
typedef struct tl_world_window {
    tl_vec3 *vertices; ///< from the grid's origin
    uint32_t *indices;
    uint8_t *areas;
    uint32_t count;
    uint64_t capacity;
    unsigned char *records; ///< scratch
    uint64_t record_capacity;
} tl_world_window;

/// Gathers the triangles of the plan's tile `tile` and proves that they are those of the plan: TL_ERR_STALE when not.
/// The window keeps its memory from call to call; zero it first, and free it with tl_world_window_free.
tl_result tl_world_window_gather(const tl_world_source *source, uint64_t tile, tl_world_window *window,
                                 tl_io_error *error_out);
tl_nav_input tl_world_window_input(const tl_world_window *window);
void tl_world_window_free(tl_world_window *window);

#endif
