// SPDX-License-Identifier: MIT
//
// Baking a job's tiles, and how far it is.

#ifndef TALUS_WORLD_BAKE_TILES_H
#define TALUS_WORLD_BAKE_TILES_H

#include "world/job/shard.h"

typedef struct tl_world_bake_report {
    uint64_t tiles;     ///< of the shard; with a dealer, those that it dealt to this process
    uint64_t there;     ///< were there already
    uint64_t baked;     ///< now
    uint64_t failed;    ///< named one by one in `fail`
    uint64_t triangles; ///< of the tiles baked now, those of borders several times
    uint64_t bytes;     ///< of the files written now
} tl_world_bake_report;

/// Several processes that bake one shard together: what deals its tiles out to them while they run.
typedef struct tl_world_dealer {
    /// Adds `count` to a number that the processes share and that began at 0; returns what it was.
    uint64_t (*take)(uint64_t count, void *user);
    /// Adds the tiles that this process has done; returns how many all have done, for its progress.
    uint64_t (*done)(uint64_t count, void *user);
    uint32_t processes;
    void *user;
} tl_world_dealer;

/// How many of the `left` tiles of a list a process of that many workers takes at a time. Towards the end fewer, so
/// that none waits long for the last.
uint64_t tl_world_deal_size(uint64_t left, uint32_t workers, uint32_t processes);

typedef struct tl_world_bake_def {
    const char *job; ///< path
    tl_world_shard shard;
    const tl_world_dealer *dealer; ///< NULL: this process bakes all of the shard
    tl_host host;
    bool as_planned; ///< do not look whether the inputs changed since the plan
    /// Told of each tile that fails, on the calling thread; the others are baked all the same.
    void (*fail)(const tl_io_error *error, void *user);
    void *user;
} tl_world_bake_def;

/// Bakes the tiles of a shard that are not there yet. When tiles failed: the first one's result and error.
/// TL_ERR_STALE: an input changed since the plan. On TL_ERR_CANCELLED the tiles that are done stay.
tl_result tl_world_bake(const tl_world_bake_def *def, tl_world_bake_report *report_out, tl_io_error *error_out);

typedef struct tl_world_status {
    uint64_t inputs, triangles;
    uint64_t tiles, there; ///< of the job, or of the shard that was asked for
    uint64_t cost, cost_there;
    uint32_t tiles_x, tiles_z;
    uint32_t missing_x, missing_z; ///< the first that is missing, by z, then x
    uint64_t timed;                ///< tiles whose time was noted (tile_times.h)
    uint64_t nanoseconds;          ///< of processor time, of those
    uint64_t longest;              ///< nanoseconds
    uint32_t longest_x, longest_z;
} tl_world_status;

tl_result tl_world_look(const char *job, const tl_world_shard *shard, tl_world_status *status_out,
                        tl_io_error *error_out);

/// TL_ERR_STALE, by name, when an input of a plan is there and is no longer the file that was planned. Inputs that are
/// not there, as on a cluster's nodes, are not asked for: the store holds them.
tl_result tl_world_inputs_unchanged(const tl_world_plan *plan, tl_io_error *error_out);

/// The plan of a job.
tl_result tl_world_plan_of_job(const char *job, tl_world_plan *plan_out, tl_io_error *error_out);

#endif
