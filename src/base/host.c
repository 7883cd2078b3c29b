// SPDX-License-Identifier: MIT
//
// Calls of the host's hooks, and the defaults where it has none.

#include "base/host.h"

#include <string.h>

void tl_run_tasks(const tl_host *host, tl_task_fn *task, uint32_t count, void *task_user)
{
    if (host != NULL && host->tasks != NULL && count > 1) {
        host->tasks->run(task, count, task_user, host->tasks->user);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        task(i, 0, task_user);
    }
}

uint32_t tl_worker_count(const tl_host *host)
{
    return host != NULL && host->tasks != NULL && host->tasks->worker_count > 1 ? host->tasks->worker_count : 1;
}

tl_result tl_progress_update(const tl_host *host, const char *stage, uint64_t done, uint64_t total)
{
    if (host == NULL || host->progress == NULL || host->progress->update == NULL) {
        return TL_OK;
    }
    return host->progress->update(stage, done, total, host->progress->user) ? TL_OK : TL_ERR_CANCELLED;
}

tl_result tl_report_fail(tl_report *report, tl_result result, const char *element, uint64_t index, const char *advice)
{
    if (report != NULL) {
        report->element = element;
        report->element_index = index;
        report->advice = advice;
    }
    return result;
}

tl_result tl_report_field(tl_report *report, tl_result result, const char *field, const char *advice)
{
    if (report != NULL) {
        report->field = field;
        report->advice = advice;
    }
    return result;
}

tl_result tl_refuse_null(const void *pointer, const char *name, tl_report *report)
{
    return pointer != NULL ? TL_OK : tl_report_field(report, TL_ERR_ARGUMENT, name, "it is needed, and is NULL");
}

tl_result tl_def_check(uint32_t cookie, const char *advice, tl_report *report)
{
    return cookie == TL_DEF_COOKIE ? TL_OK : tl_report_field(report, TL_ERR_ARGUMENT, "cookie", advice);
}

void tl_report_begin(tl_report *report, const char *stage)
{
    if (report != NULL) {
        memset(report, 0, sizeof *report);
        report->stage = stage;
        report->element_index = TL_NO_ELEMENT;
    }
}
