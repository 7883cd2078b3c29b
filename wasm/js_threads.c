// SPDX-License-Identifier: MIT
//
// A pool of threads in shared memory. Each is a worker of JavaScript with an instance of the module over the memory of
// the first one (js/src/threads.js): it calls js_thread_run, which never returns, and sleeps there until a loop begins.
// So a loop begins by waking them, without a message between workers.
//
// A door guards each loop: threads go in while it is open, the caller closes it when no item is left, and returns when
// the last one has left. A thread that wakes late finds it closed, and nobody waits for it.
//
// Rejected: Emscripten's pthreads. They come with its JavaScript, which the modules do without, and Emscripten refuses
// them in modules that stand alone. All that is needed of them is here.

#include "js_threads.h"

#include "js_slot.h"

#ifdef __wasm_atomics__

#include <stdatomic.h>
#include <stdlib.h>

static struct {
    tl_task_fn *task;
    void *user;
    uint32_t count;
} loop; // written while the door is shut

static atomic_uint_least64_t next_item; // 64 bits: every thread overshoots by one, which must not wrap
static _Atomic int calls;               // of run_tasks; threads sleep on it
static _Atomic int door;                // OPEN, and the number of threads inside
static atomic_bool lost;                // a task has trapped
static atomic_flag heap = ATOMIC_FLAG_INIT;
static bool may_sleep; // whether the caller's thread may: a page's own may not
static size_t pages_seen;

enum { OPEN = 1 << 30, LOOKS = 2000 }; // looks for the next loop before a thread falls asleep: some microseconds

// JavaScript's, whose views end where memory ended when they were made.
extern void emscripten_notify_memory_growth(size_t memory_index);

static void wake(_Atomic int *word, uint32_t count)
{
    __builtin_wasm_memory_atomic_notify((int *)word, count);
}

// Until the word is another one, or somebody wakes it.
static void sleep_while(_Atomic int *word, int value)
{
    __builtin_wasm_memory_atomic_wait32((int *)word, value, -1);
}

// ---------------------------------------------------------------------------------------------------------
// Loops.

static void work(uint32_t worker)
{
    for (;;) {
        const uint64_t item = atomic_fetch_add_explicit(&next_item, 1, memory_order_relaxed);
        if (item >= loop.count) {
            return;
        }
        loop.task((uint32_t)item, worker, loop.user);
    }
}

static bool go_in(void)
{
    int inside = atomic_load(&door);
    while ((inside & OPEN) != 0) {
        if (atomic_compare_exchange_weak(&door, &inside, inside + 1)) {
            return true;
        }
    }
    return false;
}

static void go_out(void)
{
    if (atomic_fetch_sub(&door, 1) == 1) {
        wake(&door, 1);
    }
}

static void close_door(void)
{
    int inside = atomic_fetch_and(&door, ~OPEN) & ~OPEN;
    while (inside != 0) {
        if (may_sleep) {
            sleep_while(&door, inside);
        }
        inside = atomic_load(&door);
    }
}

// Threads that allocate make the memory larger, which only their own JavaScript is told.
static void tell_growth(void)
{
    const size_t pages = __builtin_wasm_memory_size(0);
    if (pages != pages_seen) {
        pages_seen = pages;
        emscripten_notify_memory_growth(0);
    }
}

static void run_tasks(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    const tl_tasks *tasks = user;
    const uint32_t others = (count < tasks->worker_count ? count : tasks->worker_count) - 1;
    loop.task = task;
    loop.user = task_user;
    loop.count = count;
    atomic_store(&next_item, 0);
    atomic_store(&door, OPEN);
    atomic_fetch_add(&calls, 1);
    wake(&calls, others);
    work(0);
    close_door();
    tell_growth();
    if (atomic_load(&lost)) {
        __builtin_trap(); // as the task did
    }
}

static tl_tasks pool = { run_tasks, 1, &pool };

const tl_tasks *tl_js_tasks(void)
{
    return pool.worker_count > 1 ? &pool : NULL;
}

// ---------------------------------------------------------------------------------------------------------
// Memory.

static void *locked_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    const size_t whole = (size + alignment - 1) & ~(alignment - 1);
    if (whole < size) {
        return NULL;
    }
    while (atomic_flag_test_and_set_explicit(&heap, memory_order_acquire)) {
    }
    void *block = aligned_alloc(alignment, whole);
    atomic_flag_clear_explicit(&heap, memory_order_release);
    return block;
}

static void locked_release(void *block, size_t size, void *user)
{
    (void)size;
    (void)user;
    while (atomic_flag_test_and_set_explicit(&heap, memory_order_acquire)) {
    }
    free(block);
    atomic_flag_clear_explicit(&heap, memory_order_release);
}

const tl_allocator *tl_js_allocator(void)
{
    static const tl_allocator locked = { locked_allocate, locked_release, NULL };
    return &locked;
}

// ---------------------------------------------------------------------------------------------------------
// What js/src/threads.js calls.

/// All threads are there: `count` with the caller's.
void TL_JS_EXPORT(js_threads_begin)(uint32_t count, int32_t caller_may_sleep)
{
    may_sleep = caller_may_sleep != 0;
    pages_seen = __builtin_wasm_memory_size(0);
    pool.worker_count = count;
}

/// A new thread's stack, which begins at its top. No C may be on the thread's stack before.
void TL_JS_EXPORT(js_thread_stack)(void *top)
{
    __asm__ volatile(".globaltype __stack_pointer, i32\n"
                     "local.get %0\n"
                     "global.set __stack_pointer"
                     :
                     : "r"(top));
}

/// What thread `worker` does as long as it lives.
void TL_JS_EXPORT(js_thread_run)(uint32_t worker)
{
    for (;;) {
        const int seen = atomic_load(&calls);
        if (go_in()) {
            work(worker);
            go_out();
        }
        for (uint32_t i = 0; i < LOOKS && atomic_load_explicit(&calls, memory_order_relaxed) == seen; i++) {
        }
        sleep_while(&calls, seen);
    }
}

/// A thread's task has trapped: its caller must not wait for it.
void TL_JS_EXPORT(js_thread_lost)(void)
{
    atomic_store(&lost, true);
    go_out();
}

#else

const tl_tasks *tl_js_tasks(void)
{
    return NULL;
}

const tl_allocator *tl_js_allocator(void)
{
    return NULL;
}

#endif
