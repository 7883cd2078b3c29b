// SPDX-License-Identifier: MIT
//
// Items in batches: the progress hook may be called on the caller's thread only, so it is called between batches.

#include "nav_bake/voxels/batches.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

typedef struct batch_failure {
    uint32_t index; ///< the lowest one that failed
    tl_result result;
} batch_failure;

typedef struct batch_run {
    tl_batch_fn *fn;
    void *user;
    uint32_t first;
    batch_failure *failures; ///< [worker_count]
} batch_run;

static void run_item(uint32_t index, uint32_t worker, void *task_user)
{
    batch_run *run = task_user;
    const uint32_t item = run->first + index;
    batch_failure *failure = &run->failures[worker];
    if (failure->result != TL_OK && failure->index < item) {
        return; // all the rest is for nothing
    }
    tl_result result = run->fn(item, worker, run->user);
    if (result != TL_OK) {
        failure->index = item;
        failure->result = result;
    }
}

static tl_result first_failure(const batch_run *run, uint32_t worker_count)
{
    const batch_failure *first = NULL;
    for (uint32_t w = 0; w < worker_count; w++) {
        const batch_failure *failure = &run->failures[w];
        if (failure->result != TL_OK && (first == NULL || failure->index < first->index)) {
            first = failure;
        }
    }
    return first != NULL ? first->result : TL_OK;
}

static tl_result run_all(batch_run *run, const tl_host *host, const char *stage, uint32_t count, uint32_t per_worker)
{
    const uint32_t worker_count = tl_worker_count(host);
    const uint64_t batch = host != NULL && host->progress != NULL ? (uint64_t)worker_count * per_worker : count;
    for (uint64_t done = 0; done < count; done += batch) {
        TL_TRY(tl_progress_update(host, stage, done, count));
        run->first = (uint32_t)done;
        tl_run_tasks(host, run_item, (uint32_t)(count - done < batch ? count - done : batch), run);
        TL_TRY(first_failure(run, worker_count));
    }
    return tl_progress_update(host, stage, count, count);
}

tl_result tl_run_batches(const tl_host *host, const char *stage, tl_batch_fn *fn, uint32_t count, uint32_t per_worker,
                         void *user)
{
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    const uint32_t worker_count = tl_worker_count(host);
    batch_run run = { fn, user, 0, tl_allocate_array(allocator, worker_count, sizeof(batch_failure)) };
    if (run.failures == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t w = 0; w < worker_count; w++) {
        run.failures[w] = (batch_failure){ 0, TL_OK };
    }
    tl_result result = run_all(&run, host, stage, count, per_worker);
    tl_release_array(allocator, run.failures, worker_count, sizeof(batch_failure));
    return result;
}
