// SPDX-License-Identifier: MIT
//
// The processes that one mpirun started, when it did.

#ifndef TALUS_CLI_RANKS_H
#define TALUS_CLI_RANKS_H

#include "cli/world/rank_calls.h"

typedef struct tl_ranks {
    const tl_rank_calls *calls; ///< NULL: this process is alone, and is 0 of 1
    uint32_t index, count;
} tl_ranks;

/// Joins the other processes where mpirun started this one and the MPI module is there. What mpirun does not start
/// loads nothing. NULL: joined or alone; else why the module, which is there, cannot be used, and the process is alone.
const char *tl_ranks_join(tl_ranks *ranks_out);

/// Gathers what each process has to say: the first gets all of it. `all_out[ranks->count][TL_RANK_NUMBERS]`.
void tl_ranks_gather(const tl_ranks *ranks, const uint64_t mine[TL_RANK_NUMBERS], uint64_t *all_out);
void tl_ranks_leave(tl_ranks *ranks);

#endif
