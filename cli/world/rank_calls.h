// SPDX-License-Identifier: MIT
//
// What talus asks of MPI: four calls. The module that makes them is a file of its own, so that the program starts
// without MPI's libraries, and runs where there are none.

#ifndef TALUS_CLI_RANK_CALLS_H
#define TALUS_CLI_RANK_CALLS_H

#include <stdbool.h>
#include <stdint.h>

enum { TL_RANK_CALLS_VERSION = 1, TL_RANK_NUMBERS = 8 };

/// Numbers that all processes of a run add to.
typedef enum tl_rank_counter { TL_RANK_TAKEN, TL_RANK_DONE, TL_RANK_COUNTERS } tl_rank_counter;

typedef struct tl_rank_calls {
    uint32_t version;     ///< TL_RANK_CALLS_VERSION
    const char *variable; ///< of the environment: set by this MPI's mpirun for each process
    /// Joins the processes. False: MPI does not start. All others are called between begin and end, by one thread.
    bool (*begin)(uint32_t *index_out, uint32_t *count_out);
    /// Adds to a counter that all share, at once for all; returns what it was.
    uint64_t (*add)(tl_rank_counter counter, uint64_t value);
    /// Waits, asleep, until all processes have called it; the first one gets the numbers of all into
    /// `all_out[count][TL_RANK_NUMBERS]`.
    void (*gather)(const uint64_t mine[TL_RANK_NUMBERS], uint64_t *all_out);
    void (*end)(void);
} tl_rank_calls;

typedef const tl_rank_calls *tl_rank_calls_fn(void);

/// The module's one name.
const tl_rank_calls *tl_rank_calls_of_mpi(void);

#endif
