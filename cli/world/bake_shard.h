// SPDX-License-Identifier: MIT
//
// talus world bake: a shard of a world's job, by this process alone or together with the others of an mpirun.

#ifndef TALUS_CLI_BAKE_SHARD_H
#define TALUS_CLI_BAKE_SHARD_H

#include "cli/shared/command.h"
#include "world/job/bake_tiles.h"

#include <jansson.h>

typedef struct tl_world_bake_request {
    const char *job;   ///< path
    const char *shard; ///< --shard, or NULL
    uint32_t shards;   ///< --shards, or 0
    bool as_planned;
} tl_world_bake_request;

tl_exit tl_run_world_bake(tl_cli *cli, const tl_world_bake_request *request);

/// The shard that an option or the scheduler says. `has_ranks`: MPI deals out the tiles, so what its launcher sets does
/// not count. False: reported.
bool tl_find_world_shard(tl_cli *cli, const char *text, uint32_t count, bool has_ranks, tl_world_shard *shard_out,
                         tl_exit *exit_out);
json_t *tl_world_shard_json(const tl_world_shard *shard);
void tl_print_world_shard(const tl_world_shard *shard);

#endif
