// SPDX-License-Identifier: MIT
//
// How much memory a build holds: an allocator in front of the host's that counts.

#ifndef TALUS_SRC_BASE_MEMORY_METER_H
#define TALUS_SRC_BASE_MEMORY_METER_H

#include <stdatomic.h>
#include <talus/base.h>

/// Must not move while it is used. Tasks may allocate through it at the same time.
typedef struct tl_memory_meter {
    tl_allocator allocator; ///< to be used instead of the host's; what it gives can be released with the host's
    tl_allocator host;
    atomic_uint_least64_t live_bytes;
    atomic_uint_least64_t peak_bytes;
} tl_memory_meter;

/// NULL allocator: malloc.
void tl_memory_meter_init(tl_memory_meter *meter, const tl_allocator *allocator);

/// The largest sum of bytes held at one time.
uint64_t tl_memory_meter_peak(tl_memory_meter *meter);

#endif
