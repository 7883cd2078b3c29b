// SPDX-License-Identifier: MIT
//
// Counts bytes on their way to the host's allocator. The only atomics of a bake: tasks allocate in parallel, and
// their memory is one sum.

#include "base/memory_meter.h"

#include "base/arena.h"

static void *metered_allocate(size_t size, size_t alignment, void *user)
{
    tl_memory_meter *meter = user;
    void *block = meter->host.allocate(size, alignment, meter->host.user);
    if (block != NULL) {
        uint64_t live = atomic_fetch_add_explicit(&meter->live_bytes, size, memory_order_relaxed) + size;
        uint64_t peak = atomic_load_explicit(&meter->peak_bytes, memory_order_relaxed);
        // A failed exchange has read the new peak: it ends at the latest when no other thread allocates.
        while (live > peak && !atomic_compare_exchange_weak_explicit(&meter->peak_bytes, &peak, live,
                                                                     memory_order_relaxed, memory_order_relaxed)) {
        }
    }
    return block;
}

static void metered_release(void *block, size_t size, void *user)
{
    tl_memory_meter *meter = user;
    atomic_fetch_sub_explicit(&meter->live_bytes, size, memory_order_relaxed);
    meter->host.release(block, size, meter->host.user);
}

void tl_memory_meter_init(tl_memory_meter *meter, const tl_allocator *allocator)
{
    meter->allocator.allocate = metered_allocate;
    meter->allocator.release = metered_release;
    meter->allocator.user = meter;
    meter->host = tl_allocator_or_default(allocator);
    atomic_init(&meter->live_bytes, 0);
    atomic_init(&meter->peak_bytes, 0);
}

uint64_t tl_memory_meter_peak(tl_memory_meter *meter)
{
    return atomic_load_explicit(&meter->peak_bytes, memory_order_relaxed);
}
