// SPDX-License-Identifier: MIT
//
// How well a job spreads over many processes: its tiles' times replayed, tile by tile, as the processes would take
// them.

#ifndef TALUS_WORLD_RANK_REPLAY_H
#define TALUS_WORLD_RANK_REPLAY_H

#include "world/job/plan_file.h"

/// Shares of the processes' time, in [0, 1), in which they wait for the last.
typedef struct tl_world_replay {
    double dealt;        ///< by mpirun: dealt out by falling cost while they run
    double shards;       ///< by --shard
    double dealt_naive;  ///< dealt out in the grid's order
    double shards_naive; ///< shards of equal numbers of tiles, in the grid's order
    double least;        ///< what no order can avoid: the longest tile alone takes so long
} tl_world_replay;

/// `times`: [plan->tile_count], of any unit. `ranks` >= 1 processes of one thread each. TL_ERR_MEMORY.
tl_result tl_world_replay_ranks(const tl_world_plan *plan, const uint64_t *times, uint32_t ranks,
                                tl_world_replay *replay_out);

#endif
