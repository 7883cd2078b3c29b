// SPDX-License-Identifier: MIT
//
// A stage of a bake and its progress calls, often enough that a host draws a bar and cancels at once.
//
// Progress is called on the bake's own thread only, and not while tasks run. So loops and tasks are cut into steps of a
// bounded amount of work, a few milliseconds for a thread, and progress is called between any two of them.

#ifndef TALUS_SRC_BASE_STAGE_H
#define TALUS_SRC_BASE_STAGE_H

#include "base/exact_floats.h"
#include "base/host.h"

/// Items of a plain loop between two progress calls: 64 Ki items at some 100 ns are 7 ms.
#define TL_STAGE_STEP 0x10000u

typedef struct tl_stage {
    const tl_host *host; ///< NULL: silent
    const char *name;
    uint64_t done, total; ///< in units of the stage's choice
    bool is_cancelled;    ///< progress said so, and is not called again
} tl_stage;

/// The first call of a stage, with 0 done.
tl_result tl_stage_begin(tl_stage *stage, const tl_host *host, const char *name, uint64_t total);

/// Calls progress after `amount` more; `done` stays within the total. A NULL stage is silent. TL_ERR_CANCELLED.
tl_result tl_stage_add(tl_stage *stage, uint64_t amount);

/// The last call of a stage, with all of it done.
tl_result tl_stage_end(tl_stage *stage);

/// The end of the step that begins with item i of `count`: an inner loop up to it needs no look at the stage.
static inline uint32_t tl_stage_step_end(uint32_t i, uint32_t count)
{
    return count - i < TL_STAGE_STEP ? count : i + TL_STAGE_STEP;
}

/// Inside a loop: TL_TRY(tl_stage_tick(stage, i)) calls progress once each TL_STAGE_STEP items, and adds nothing.
static inline tl_result tl_stage_tick(tl_stage *stage, uint64_t i)
{
    return (i & (TL_STAGE_STEP - 1)) == TL_STAGE_STEP - 1 ? tl_stage_add(stage, 0) : TL_OK;
}

/// As tl_run_tasks, in batches of up to `batch` tasks a worker, with progress after each; all tasks together add
/// `amount`.
tl_result tl_stage_run(tl_stage *stage, tl_task_fn *task, uint32_t count, void *task_user, uint32_t batch,
                       uint64_t amount);

/// memcpy in tasks, with progress; adds nothing.
tl_result tl_stage_copy(tl_stage *stage, void *to, const void *from, uint64_t bytes);

/// memset to 0 on this thread, with progress; adds nothing.
tl_result tl_stage_zero(tl_stage *stage, void *to, uint64_t bytes);

#endif
