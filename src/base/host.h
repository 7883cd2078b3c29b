// SPDX-License-Identifier: MIT
//
// Calling the host: parallel loops and progress, with the defaults that NULL stands for.

#ifndef TALUS_SRC_BASE_HOST_H
#define TALUS_SRC_BASE_HOST_H

#include "base/exact_floats.h"

#include <talus/base.h>

/// Runs task(i, worker, task_user) for each i below count, on the host's tasks or here in order.
void tl_run_tasks(const tl_host *host, tl_task_fn *task, uint32_t count, void *task_user);

/// How many blocks of `size` items make up `count`; each block may be a task.
static inline uint32_t tl_block_count(uint32_t count, uint32_t size)
{
    return count / size + (count % size != 0);
}

/// Behind the last item of a block, which begins at block * size.
static inline uint32_t tl_block_end(uint32_t block, uint32_t size, uint32_t count)
{
    uint32_t first = block * size;
    return count - first < size ? count : first + size;
}

/// How many workers tl_run_tasks may use at once: >= 1.
uint32_t tl_worker_count(const tl_host *host);

/// Calls the progress hook; TL_ERR_CANCELLED when it returns false. `host` may be NULL.
tl_result tl_progress_update(const tl_host *host, const char *stage, uint64_t done, uint64_t total);

/// Writes a failure's place into a report that may be NULL, and returns `result`, so that it reads
/// `return tl_report_fail(report, TL_ERR_INDEX, "triangle", i, "check the index buffer");`
tl_result tl_report_fail(tl_report *report, tl_result result, const char *element, uint64_t index, const char *advice);

/// The same for a field of a def: `return tl_report_field(report, TL_ERR_ARGUMENT, "cell_size", "make it > 0");`
tl_result tl_report_field(tl_report *report, tl_result result, const char *field, const char *advice);

/// Refuses a NULL object, input or needed output at the public edge; `name` is the parameter's.
tl_result tl_refuse_null(const void *pointer, const char *name, tl_report *report);

/// TL_REFUSE_NULL(mesh_out, report) returns TL_ERR_ARGUMENT, field "mesh_out", where it is NULL. Needs base/assert.h.
#define TL_REFUSE_NULL(pointer, report) TL_TRY(tl_refuse_null((pointer), #pointer, (report)))

/// Refuses a def that was zeroed instead of begun with its defaults. `advice` names the function: "begin with
/// tl_default_soup_def()".
tl_result tl_def_check(uint32_t cookie, const char *advice, tl_report *report);

/// Clears a report that may be NULL: no element, stage as given.
void tl_report_begin(tl_report *report, const char *stage);

#endif
