// SPDX-License-Identifier: MIT
//
// The module talus-mpi.so: all of MPI that talus uses.
//
// Tiles are dealt out by fetch-and-add on a counter in a window of rank 0, as Global Arrays' NXTVAL does: no rank has
// to be a master, and none waits for one. Where the network cannot add by itself, rank 0 must be inside MPI for it to
// happen; a thread there looks in, while rank 0 bakes. A mutex lets one thread at a time into MPI: Open MPI has no
// windows over plain Ethernet for programs that ask for more.

#include "cli/world/rank_calls.h"

#include <mpi.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>

#ifdef OPEN_MPI
#define RANK_VARIABLE "OMPI_COMM_WORLD_SIZE"
#else
#define RANK_VARIABLE "PMI_SIZE" // MPICH and its kin
#endif

enum { LOOK_IN_NANOSECONDS = 1000000 };

// MPI is one for the process; so is this.
static MPI_Win window;
static pthread_mutex_t mpi_mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_t looker;
static bool has_looker;
static atomic_bool looker_ends;

static void nap_briefly(void)
{
    const struct timespec time = { 0, LOOK_IN_NANOSECONDS };
    nanosleep(&time, NULL);
}

static void *look_in(void *user)
{
    while (!atomic_load(&looker_ends)) {
        int found;
        pthread_mutex_lock(&mpi_mutex);
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, MPI_STATUS_IGNORE);
        pthread_mutex_unlock(&mpi_mutex);
        nap_briefly();
    }
    return user;
}

static bool begin_mpi(uint32_t *index_out, uint32_t *count_out)
{
    int threads, index, count;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &threads) != MPI_SUCCESS) {
        return false;
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &index);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    uint64_t *counters;
    const MPI_Aint size = index == 0 ? (MPI_Aint)sizeof *counters * TL_RANK_COUNTERS : 0;
    MPI_Win_allocate(size, sizeof *counters, MPI_INFO_NULL, MPI_COMM_WORLD, &counters, &window);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window);
    for (int i = 0; i < TL_RANK_COUNTERS && index == 0; i++) {
        counters[i] = 0;
    }
    MPI_Win_sync(window);
    MPI_Barrier(MPI_COMM_WORLD);
    atomic_store(&looker_ends, false);
    has_looker = index == 0 && count > 1 && threads >= MPI_THREAD_SERIALIZED &&
                 pthread_create(&looker, NULL, look_in, NULL) == 0;
    *index_out = (uint32_t)index;
    *count_out = (uint32_t)count;
    return true;
}

static uint64_t add_to_counter(tl_rank_counter counter, uint64_t value)
{
    uint64_t before = 0;
    pthread_mutex_lock(&mpi_mutex);
    MPI_Fetch_and_op(&value, &before, MPI_UINT64_T, 0, (MPI_Aint)counter, MPI_SUM, window);
    MPI_Win_flush(0, window);
    pthread_mutex_unlock(&mpi_mutex);
    return before;
}

// MPI's own waiting takes a whole processor, which others may still bake on.
static void wait_for(MPI_Request *request)
{
    for (int done = 0;;) {
        pthread_mutex_lock(&mpi_mutex);
        MPI_Test(request, &done, MPI_STATUS_IGNORE);
        pthread_mutex_unlock(&mpi_mutex);
        if (done) {
            return;
        }
        nap_briefly();
    }
}

static void gather_numbers(const uint64_t mine[TL_RANK_NUMBERS], uint64_t *all_out)
{
    MPI_Request request;
    pthread_mutex_lock(&mpi_mutex);
    MPI_Igather(mine, TL_RANK_NUMBERS, MPI_UINT64_T, all_out, TL_RANK_NUMBERS, MPI_UINT64_T, 0, MPI_COMM_WORLD,
                &request);
    pthread_mutex_unlock(&mpi_mutex);
    wait_for(&request);
    // A rank that sent its numbers may be done long before others; rank 0 stays for those that still count.
    pthread_mutex_lock(&mpi_mutex);
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    pthread_mutex_unlock(&mpi_mutex);
    wait_for(&request);
}

static void end_mpi(void)
{
    if (has_looker) {
        atomic_store(&looker_ends, true);
        pthread_join(looker, NULL);
        has_looker = false;
    }
    MPI_Win_unlock_all(window);
    MPI_Win_free(&window);
    MPI_Finalize();
}

const tl_rank_calls *tl_rank_calls_of_mpi(void)
{
    static const tl_rank_calls calls = { TL_RANK_CALLS_VERSION, RANK_VARIABLE,  begin_mpi,
                                         add_to_counter,        gather_numbers, end_mpi };
    return &calls;
}
