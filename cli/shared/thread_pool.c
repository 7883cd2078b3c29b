// SPDX-License-Identifier: MIT
//
// A loop is handed out item by item from one atomic counter, so uneven items (tiles of a level) balance themselves.
// The caller works too; it returns when every thread that joined the loop has left it, so the loop's data may live on
// its stack. Who wakes too late to join is not waited for. Work stealing was rejected: items are milliseconds long, one
// counter is never contended.
//
// A bake hands out loops one after another, some of them shorter than the 50 us that waking a thread takes; so threads
// look out for the next loop for a while before they sleep, and the caller does for the last of them to leave.

#include "cli/shared/thread_pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <unistd.h>
#endif

// Looks, with a pause each, before a thread sleeps: some 50 us.
enum { PATIENCE = 1000 };

// One loop. Written under the mutex while nobody is inside, read by the threads that joined it under the mutex.
typedef struct loop {
    tl_task_fn *task;
    void *task_user;
    uint32_t count;
    atomic_uint_fast64_t next; // 64 bits: every worker overshoots by one, which must not wrap
} loop;

typedef struct worker {
    tl_thread_pool *pool;
    uint32_t index;
    pthread_t thread;
} worker;

struct tl_thread_pool {
    tl_tasks tasks;
    pthread_mutex_t mutex;
    pthread_cond_t work_came;
    pthread_cond_t all_left;
    atomic_uint_fast64_t generation; // number of loops begun; written under the mutex
    atomic_uint inside;              // threads in the loop `generation`; written under the mutex
    bool is_open;                    // it may be joined
    bool closing;
    loop current;
    worker workers[]; // worker 0 is the caller, and has no thread
};

static void work(loop *current, uint32_t index)
{
    for (;;) {
        uint64_t item = atomic_fetch_add_explicit(&current->next, 1, memory_order_relaxed);
        if (item >= current->count) {
            return;
        }
        current->task((uint32_t)item, index, current->task_user);
    }
}

static void pause_a_moment(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("isb"); // 10 ns; a yield takes no time on most of them
#endif
}

static void await_loop(const tl_thread_pool *pool, uint64_t seen)
{
    for (int i = 0; i < PATIENCE && atomic_load_explicit(&pool->generation, memory_order_relaxed) == seen; i++) {
        pause_a_moment();
    }
}

static void await_leaving(const tl_thread_pool *pool)
{
    for (int i = 0; i < PATIENCE && atomic_load_explicit(&pool->inside, memory_order_relaxed) != 0; i++) {
        pause_a_moment();
    }
}

static void *thread_main(void *user)
{
    worker *self = user;
    tl_thread_pool *pool = self->pool;
    uint64_t seen = 0;
    pthread_mutex_lock(&pool->mutex);
    for (;;) {
        while ((pool->generation == seen || !pool->is_open) && !pool->closing) {
            pthread_cond_wait(&pool->work_came, &pool->mutex);
        }
        if (pool->closing) {
            break;
        }
        seen = pool->generation;
        pool->inside++;
        pthread_mutex_unlock(&pool->mutex);
        work(&pool->current, self->index);
        pthread_mutex_lock(&pool->mutex);
        if (--pool->inside == 0) {
            pthread_cond_signal(&pool->all_left);
        }
        pthread_mutex_unlock(&pool->mutex);
        await_loop(pool, seen);
        pthread_mutex_lock(&pool->mutex);
    }
    pthread_mutex_unlock(&pool->mutex);
    return NULL;
}

static void run_tasks(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    tl_thread_pool *pool = user;
    if (count <= 1 || pool->tasks.worker_count == 1) {
        for (uint32_t i = 0; i < count; ++i) {
            task(i, 0, task_user);
        }
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    pool->current.task = task;
    pool->current.task_user = task_user;
    pool->current.count = count;
    atomic_store_explicit(&pool->current.next, 0, memory_order_relaxed);
    pool->is_open = true;
    pool->generation++;
    pthread_cond_broadcast(&pool->work_came);
    pthread_mutex_unlock(&pool->mutex);

    work(&pool->current, 0);

    pthread_mutex_lock(&pool->mutex);
    pool->is_open = false;
    pthread_mutex_unlock(&pool->mutex);
    await_leaving(pool);
    pthread_mutex_lock(&pool->mutex);
    while (pool->inside != 0) {
        pthread_cond_wait(&pool->all_left, &pool->mutex);
    }
    pthread_mutex_unlock(&pool->mutex);
}

tl_thread_pool *tl_thread_pool_create(uint32_t worker_count)
{
    tl_thread_pool *pool = calloc(1, sizeof(*pool) + worker_count * sizeof(worker));
    if (pool == NULL) {
        return NULL;
    }
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->work_came, NULL);
    pthread_cond_init(&pool->all_left, NULL);
    pool->tasks.run = run_tasks;
    pool->tasks.user = pool;
    pool->tasks.worker_count = 1;
    for (uint32_t i = 1; i < worker_count; ++i) {
        pool->workers[i].pool = pool;
        pool->workers[i].index = i;
        if (pthread_create(&pool->workers[i].thread, NULL, thread_main, &pool->workers[i]) != 0) {
            break;
        }
        pool->tasks.worker_count++;
    }
    return pool;
}

void tl_thread_pool_free(tl_thread_pool *pool)
{
    if (pool == NULL) {
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    pool->closing = true;
    pthread_cond_broadcast(&pool->work_came);
    pthread_mutex_unlock(&pool->mutex);
    for (uint32_t i = 1; i < pool->tasks.worker_count; ++i) {
        pthread_join(pool->workers[i].thread, NULL);
    }
    pthread_cond_destroy(&pool->all_left);
    pthread_cond_destroy(&pool->work_came);
    pthread_mutex_destroy(&pool->mutex);
    free(pool);
}

const tl_tasks *tl_thread_pool_tasks(const tl_thread_pool *pool)
{
    return &pool->tasks;
}

uint32_t tl_online_processors(void)
{
#ifdef _WIN32
    const DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
#else
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return count > 0 ? (uint32_t)count : 1;
}
