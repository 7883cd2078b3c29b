// SPDX-License-Identifier: MIT
//
// Progress within a stage.

#include "base/stage.h"

#include "base/assert.h"
#include "base/min_max.h"

#include <string.h>

// What was cancelled within a task stays so behind it.
static tl_result call_progress(tl_stage *stage)
{
    const tl_result result = stage->is_cancelled
                                 ? TL_ERR_CANCELLED
                                 : tl_progress_update(stage->host, stage->name, stage->done, stage->total);
    stage->is_cancelled = result == TL_ERR_CANCELLED;
    return result;
}

tl_result tl_stage_begin(tl_stage *stage, const tl_host *host, const char *name, uint64_t total)
{
    stage->host = host;
    stage->name = name;
    stage->done = 0;
    stage->total = total;
    stage->is_cancelled = false;
    return call_progress(stage);
}

tl_result tl_stage_add(tl_stage *stage, uint64_t amount)
{
    if (stage == NULL) {
        return TL_OK;
    }
    stage->done += tl_min_u64(amount, stage->total - stage->done);
    return call_progress(stage);
}

tl_result tl_stage_end(tl_stage *stage)
{
    stage->done = stage->total;
    return call_progress(stage);
}

typedef struct batch_of_tasks {
    tl_task_fn *task;
    void *user;
    uint32_t first;
} batch_of_tasks;

static void run_one_of_batch(uint32_t index, uint32_t worker, void *user)
{
    const batch_of_tasks *b = user;
    b->task(b->first + index, worker, b->user);
}

tl_result tl_stage_run(tl_stage *stage, tl_task_fn *task, uint32_t count, void *task_user, uint32_t batch,
                       uint64_t amount)
{
    const tl_host *host = stage != NULL ? stage->host : NULL;
    if (host == NULL || host->progress == NULL) {
        tl_run_tasks(host, task, count, task_user);
        return tl_stage_add(stage, amount);
    }
    const uint64_t at_once = (uint64_t)batch * tl_worker_count(host);
    uint64_t added = 0;
    for (uint64_t first = 0; first < count; first += at_once) {
        batch_of_tasks b = { task, task_user, (uint32_t)first };
        const uint64_t some = tl_min_u64(at_once, count - first);
        tl_run_tasks(host, run_one_of_batch, (uint32_t)some, &b);
        const uint64_t until = (uint64_t)((double)amount * ((double)(first + some) / (double)count));
        TL_TRY(tl_stage_add(stage, until - added));
        added = until;
    }
    return TL_OK;
}

// Pages that are written first cost more than the copy: 1 MB takes up to half a millisecond.
enum { COPY_BYTES = 1 << 20, COPY_BATCH = 32 };

typedef struct copy_job {
    char *to;
    const char *from;
    uint64_t bytes;
} copy_job;

static void copy_piece(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const copy_job *job = user;
    const uint64_t first = (uint64_t)index * COPY_BYTES;
    memcpy(job->to + first, job->from + first, (size_t)tl_min_u64(COPY_BYTES, job->bytes - first));
}

tl_result tl_stage_copy(tl_stage *stage, void *to, const void *from, uint64_t bytes)
{
    copy_job job = { to, from, bytes };
    const uint32_t pieces = (uint32_t)(bytes / COPY_BYTES + (bytes % COPY_BYTES != 0));
    return tl_stage_run(stage, copy_piece, pieces, &job, COPY_BATCH, 0);
}

tl_result tl_stage_zero(tl_stage *stage, void *to, uint64_t bytes)
{
    for (uint64_t at = 0; at < bytes; at += COPY_BYTES) {
        memset((char *)to + at, 0, (size_t)tl_min_u64(COPY_BYTES, bytes - at));
        TL_TRY(tl_stage_add(stage, 0));
    }
    return TL_OK;
}
