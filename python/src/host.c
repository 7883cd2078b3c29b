// SPDX-License-Identifier: MIT
//
// The host of bakes and batches: threads by Python's own portable functions, progress by a Python callable. A Ctrl-C
// ends a bake at its next progress call.

#include "binding.h"

#include <stdatomic.h>

typedef struct parallel_loop {
    tl_task_fn *task;
    void *task_user;
    uint32_t count;
    atomic_uint next;    ///< item that nobody has taken
    atomic_uint worker;  ///< number of the next helper thread
    atomic_uint running; ///< threads at work, the caller's included
    PyThread_type_lock all_done;
} parallel_loop;

static void work(parallel_loop *loop, uint32_t worker)
{
    for (uint32_t i; (i = atomic_fetch_add(&loop->next, 1)) < loop->count;) {
        loop->task(i, worker, loop->task_user);
    }
}

static void run_helper(void *user)
{
    parallel_loop *loop = user;
    work(loop, atomic_fetch_add(&loop->worker, 1));
    if (atomic_fetch_sub(&loop->running, 1) == 1) {
        PyThread_release_lock(loop->all_done);
    }
}

// Starts helper threads for one loop: 20 us each, while a loop is worth milliseconds. Where the system has no thread or
// lock left, fewer do the work.
static void run_loop(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    const tl_tasks *tasks = user;
    parallel_loop loop = { .task = task, .task_user = task_user, .count = count };
    atomic_init(&loop.next, 0);
    atomic_init(&loop.worker, 1);
    atomic_init(&loop.running, 1);
    loop.all_done = count > 1 && tasks->worker_count > 1 ? PyThread_allocate_lock() : NULL;
    if (loop.all_done == NULL) {
        work(&loop, 0);
        return;
    }
    PyThread_acquire_lock(loop.all_done, WAIT_LOCK);
    for (uint32_t i = 1; i < tasks->worker_count && i < count; i++) {
        atomic_fetch_add(&loop.running, 1);
        if (PyThread_start_new_thread(run_helper, &loop) == (unsigned long)-1) {
            atomic_fetch_sub(&loop.running, 1);
            break;
        }
    }
    work(&loop, 0);
    if (atomic_fetch_sub(&loop.running, 1) != 1) {
        PyThread_acquire_lock(loop.all_done, WAIT_LOCK);
    }
    PyThread_release_lock(loop.all_done);
    PyThread_free_lock(loop.all_done);
}

static bool update_progress(const char *stage, uint64_t done, uint64_t total, void *user)
{
    binding_host *host = user;
    PyEval_RestoreThread(host->state);
    bool on = PyErr_CheckSignals() == 0;
    if (on && host->callback != NULL) {
        PyObject *answer =
            PyObject_CallFunction(host->callback, "sKK", stage, (unsigned long long)done, (unsigned long long)total);
        on = answer != NULL && answer != Py_False;
        Py_XDECREF(answer);
    }
    host->state = PyEval_SaveThread();
    return on;
}

void binding_tasks(tl_tasks *tasks, unsigned threads)
{
    *tasks = (tl_tasks){ run_loop, threads > 0 ? threads : 1, tasks };
}

void binding_begin(binding_host *host, PyObject *callback, unsigned threads)
{
    host->host = (tl_host){ NULL, &host->tasks, &host->progress };
    binding_tasks(&host->tasks, threads);
    host->progress = (tl_progress){ update_progress, host };
    host->callback = callback != Py_None ? callback : NULL;
    host->state = PyEval_SaveThread();
}

void binding_end(binding_host *host)
{
    PyEval_RestoreThread(host->state);
}
