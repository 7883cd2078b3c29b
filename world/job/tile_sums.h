// SPDX-License-Identifier: MIT
//
// What each tile has of a segment: how many triangles can touch it, and the sum of their hashes.
//
// Sums of all segments add up to the tile's content, whatever segment a triangle came in. A segment's sums are kept in
// a file: when one input changes, only its segments are read again.

#ifndef TALUS_WORLD_TILE_SUMS_H
#define TALUS_WORLD_TILE_SUMS_H

#include "world/job/segment_set.h"
#include "world/job/tile_grid.h"

typedef struct tl_world_tile_sum {
    uint32_t tile; ///< z * tiles_x + x
    uint32_t triangles;
    tl_content_hash sum;
} tl_world_tile_sum;

typedef struct tl_world_tile_sums {
    tl_world_tile_sum *rows; ///< [count] by tile
    uint64_t count;
} tl_world_tile_sums;

/// The hash of a record in its cell.
tl_content_hash tl_world_record_hash(const tl_world_cell *cell, const unsigned char *record);

/// Sums a segment, by one pass over it. O(triangles). Free with tl_world_tile_sums_free.
tl_result tl_world_tile_sums_make(const tl_world_grid *grid, const tl_world_segment *segment,
                                  tl_world_tile_sums *sums_out, tl_io_error *error_out);
/// The same, out of the file `path` where that holds them, else into it.
tl_result tl_world_tile_sums_get(const tl_world_grid *grid, const tl_world_segment *segment, const char *path,
                                 tl_world_tile_sums *sums_out, tl_io_error *error_out);
/// Adds `more`, and takes its memory.
bool tl_world_tile_sums_add(tl_world_tile_sums *sums, tl_world_tile_sums *more);
void tl_world_tile_sums_free(tl_world_tile_sums *sums);

#endif
