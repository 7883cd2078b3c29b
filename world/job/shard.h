// SPDX-License-Identifier: MIT
//
// Which part of a job this process is to bake: from an option, or from what schedulers tell their processes.

#ifndef TALUS_WORLD_SHARD_H
#define TALUS_WORLD_SHARD_H

#include "world/job/plan_file.h"

typedef struct tl_world_shard {
    uint32_t index, count; ///< index < count
    const char *source;    ///< static: what said so, such as "SLURM_ARRAY_TASK_ID"; NULL: nothing did, and it is 0 of 1
} tl_world_shard;

/// Looks a variable up, as getenv does; so tests need not change the environment.
typedef const char *tl_world_lookup_fn(const char *name, void *user);

/// `text`: "3/64", the third of 64, or NULL. `count`: the number of shards where the scheduler does not say it; 0: not
/// given. The first of these that is there counts: `text`; Slurm arrays; Open MPI; PMI (MPICH, Intel MPI); Slurm steps;
/// Kubernetes indexed jobs; AWS Batch arrays. TL_ERR_ARGUMENT: what it says is no shard, or the count is missing.
tl_result tl_world_shard_find(const char *text, uint32_t count, tl_world_lookup_fn *lookup, void *user,
                              tl_world_shard *shard_out, tl_io_error *error_out);

/// Tiles are dealt out by falling cost in rounds, one a shard, back and forth: which shard has the tile at a place of a
/// round, and at which place stands a shard's.
static inline uint64_t tl_world_shard_turn(uint64_t round, uint64_t place, uint64_t count)
{
    return round % 2 == 0 ? place : count - 1 - place;
}

/// The tiles of a shard, as indexes into the plan's, by falling cost; `*count_out` of them, freed with free(). NULL:
/// out of memory. Estimated loads of shards differ by one tile at most; every tile is in one shard.
uint64_t *tl_world_shard_tiles(const tl_world_plan *plan, const tl_world_shard *shard, uint64_t *count_out);

#endif
