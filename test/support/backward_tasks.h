// SPDX-License-Identifier: MIT
//
// Tasks in another order than they come, without threads.

#ifndef TALUS_TEST_BACKWARD_TASKS_H
#define TALUS_TEST_BACKWARD_TASKS_H

#include <talus/base.h>

/// Runs tasks backwards, workers in turn: what a parallel host may do, without threads.
static inline void test_run_backwards(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    const tl_tasks *tasks = (const tl_tasks *)user;
    for (uint32_t i = count; i-- > 0;) {
        task(i, i % tasks->worker_count, task_user);
    }
}

static inline tl_tasks test_backward_tasks(tl_tasks *self, uint32_t workers)
{
    tl_tasks tasks = { test_run_backwards, workers, self };
    *self = tasks;
    return tasks;
}

#endif
