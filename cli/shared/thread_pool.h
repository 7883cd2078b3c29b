// SPDX-License-Identifier: MIT
//
// POSIX threads behind the task hook: what the core does not bring along.

#ifndef TALUS_CLI_THREAD_POOL_H
#define TALUS_CLI_THREAD_POOL_H

#include <talus/base.h>

typedef struct tl_thread_pool tl_thread_pool;

/// A pool of `worker_count` workers (>= 1): the thread that runs a loop is worker 0, the others are threads of the pool
/// that sleep in between, but for the first 50 us. When the system refuses threads the pool has fewer. NULL when memory
/// is out.
tl_thread_pool *tl_thread_pool_create(uint32_t worker_count);
/// Ends the threads. No loop may be running. NULL is allowed.
void tl_thread_pool_free(tl_thread_pool *pool);

/// The hook for a tl_host. Lives as long as the pool. One loop at a time, from one thread.
const tl_tasks *tl_thread_pool_tasks(const tl_thread_pool *pool);

/// Processors that are online now, >= 1.
uint32_t tl_online_processors(void);

#endif
