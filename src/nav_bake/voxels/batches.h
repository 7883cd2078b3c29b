// SPDX-License-Identifier: MIT
//
// A loop of independent items that may fail, on the host's tasks, with progress in between.

#ifndef TALUS_SRC_NAV_BAKE_BATCHES_H
#define TALUS_SRC_NAV_BAKE_BATCHES_H

#include <talus/base.h>

typedef tl_result tl_batch_fn(uint32_t index, uint32_t worker, void *user);

/// Runs fn for each index below count. Returns the result of the lowest index that fails, whatever the number of
/// workers. With a progress hook the items run in batches of `per_worker` for each worker, and the hook is called
/// between them; a batch is finished also when one of its items fails.
tl_result tl_run_batches(const tl_host *host, const char *stage, tl_batch_fn *fn, uint32_t count, uint32_t per_worker,
                         void *user);

#endif
