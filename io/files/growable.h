// SPDX-License-Identifier: MIT
//
// Arrays that grow over a tl_allocator.
//
// io uses the library's public interface only, so that it links with the shared library too; these are the few
// functions for memory that it needs besides.

#ifndef TALUS_IO_GROWABLE_H
#define TALUS_IO_GROWABLE_H

#include <talus/base.h>

/// The allocator that a NULL stands for: aligned malloc and free.
tl_allocator tl_io_allocator_or_default(const tl_allocator *allocator);

/// `size` > 0 bytes aligned to 64, or NULL: also where no pointer reaches as far. The allocator must not be NULL here
/// and below.
void *tl_io_allocate(const tl_allocator *allocator, uint64_t size);

/// Gives back what tl_io_allocate returned; a NULL block is allowed.
void tl_io_release(const tl_allocator *allocator, void *block, uint64_t size);

/// Grows `*array` to a capacity of `needed` items or more; its first `used` are kept. Capacities double, so n pushes
/// cost O(n). False when memory is out; array and capacity are then as before.
bool tl_io_grow(const tl_allocator *allocator, void **array, uint64_t *capacity, uint64_t used, uint64_t needed,
                size_t item_size);

/// Tells the host's progress hook, if it has one; TL_ERR_CANCELLED when it asks to stop.
tl_result tl_io_progress(const tl_host *host, const char *stage, uint64_t done, uint64_t total);

#endif
