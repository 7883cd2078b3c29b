// SPDX-License-Identifier: MIT
//
// How long each tile's bake took: notes beside the tiles, whose bytes they leave alone.
//
// Each process appends to a file of its own, `times/*.times`, after every batch. A record, little-endian: u32 magic
// "TLT1", u32 x, u32 z, u32 zero, u64 key twice, u64 nanoseconds of processor time, u64 checksum of the 40 bytes
// before. Records that were cut off or altered are passed over; of several for one tile the least disturbed counts, the
// shortest.

#ifndef TALUS_WORLD_TILE_TIMES_H
#define TALUS_WORLD_TILE_TIMES_H

#include "world/job/plan_file.h"

enum { TL_WORLD_TIME_RECORD = 48 };

/// The file that this process appends to. All zero: not named yet. Free `path` with free().
typedef struct tl_world_times {
    char *path;
} tl_world_times;

void tl_world_time_encode(const tl_world_tile *tile, uint64_t nanoseconds,
                          unsigned char record_out[TL_WORLD_TIME_RECORD]);
/// Appends records to this process's file in the job. `shard` keeps names of processes apart. TL_ERR_IO, TL_ERR_MEMORY.
tl_result tl_world_times_append(tl_world_times *times, const char *job, uint32_t shard, const void *records,
                                size_t count, tl_io_error *error_out);

/// The nanoseconds of each tile of the plan, 0 where none is noted: [plan->tile_count], freed with free(). A job
/// without notes has only zeros. TL_ERR_IO, TL_ERR_MEMORY; `*times_out` is NULL then.
tl_result tl_world_times_read(const char *job, const tl_world_plan *plan, uint64_t **times_out, tl_io_error *error_out);

#endif
