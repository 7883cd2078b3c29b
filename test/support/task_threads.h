// SPDX-License-Identifier: MIT
//
// Tasks on threads that are made for each call, but for the first worker's, which is the caller's: slow, but any number
// of them, and no thread lives between calls.

#ifndef TALUS_TEST_TASK_THREADS_H
#define TALUS_TEST_TASK_THREADS_H

#include "talus_test.h"

#include <pthread.h>
#include <talus/base.h>

enum { TEST_MAX_THREADS = 8 };

typedef struct thread_job {
    tl_task_fn *task;
    uint32_t first, count, stride;
    void *user;
} thread_job;

static inline void *run_stride(void *argument)
{
    thread_job *job = argument;
    for (uint32_t i = job->first; i < job->count; i += job->stride) {
        job->task(i, job->first, job->user);
    }
    return NULL;
}

/// For tl_tasks; `user` points to the number of workers. Worker w takes every n-th item from w on.
static inline void run_on_threads(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    const uint32_t workers = *(const uint32_t *)user;
    pthread_t threads[TEST_MAX_THREADS];
    thread_job jobs[TEST_MAX_THREADS] = { { task, 0, 0, 1, task_user } };
    TEST_CHECK(workers <= TEST_MAX_THREADS);
    for (uint32_t w = 0; w < workers; w++) {
        thread_job job = { task, w, count, workers, task_user };
        jobs[w] = job;
        TEST_CHECK(w == 0 || pthread_create(&threads[w], NULL, run_stride, &jobs[w]) == 0);
    }
    run_stride(&jobs[0]);
    for (uint32_t w = 1; w < workers; w++) {
        pthread_join(threads[w], NULL);
    }
}

#endif
