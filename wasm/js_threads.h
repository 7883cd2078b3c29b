// SPDX-License-Identifier: MIT
//
// Threads for the library's tasks, in the module that has them.

#ifndef TALUS_WASM_JS_THREADS_H
#define TALUS_WASM_JS_THREADS_H

#include <talus/base.h>

/// Tasks on all threads of the pool. NULL where there is but one.
const tl_tasks *tl_js_tasks(void);

/// malloc under a lock, for tasks allocate at the same time. NULL in modules without threads.
const tl_allocator *tl_js_allocator(void);

#endif
