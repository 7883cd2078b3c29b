// SPDX-License-Identifier: MIT
//
// How readers enter the newest of some versions and leave it again, and how the writer knows that a version is free:
// one atomic addition each, without a loop.
//
// A count of references for each version, split in two: the door holds the newest version's index and how many have
// entered it; a version counts who has left. Opening the door for the next one exchanges it, which tells how many
// entered the version before for good. That is free when as many have left. Why counts, and what else was looked at:
// nav_versions.c. Source: Williams, C++ Concurrency in Action, 2012, 7.2.4 (split counts).

#ifndef TALUS_SRC_BASE_VERSION_DOOR_H
#define TALUS_SRC_BASE_VERSION_DOOR_H

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

// A version's index in the upper bits, who entered in the lower ones. 2^54 entries at 20 million a second take 28 years
// without a version being published.
enum { TL_DOOR_COUNT_BITS = 54, TL_DOOR_MAX_VERSIONS = 1024, TL_DOOR_CACHE_LINE = 64 };

typedef struct tl_version_door {
    char before[TL_DOOR_CACHE_LINE];
    atomic_uint_least64_t word;
    char behind[TL_DOOR_CACHE_LINE];
} tl_version_door;

/// Readers that have left a version, in a cache line of its own.
typedef struct tl_version_leavers {
    char before[TL_DOOR_CACHE_LINE];
    atomic_uint_least64_t count;
    char behind[TL_DOOR_CACHE_LINE];
} tl_version_leavers;

static inline void tl_version_door_init(tl_version_door *door)
{
    memset(door->before, 0, sizeof door->before);
    memset(door->behind, 0, sizeof door->behind);
    atomic_init(&door->word, 0);
}

static inline void tl_version_leavers_init(tl_version_leavers *leavers)
{
    memset(leavers->before, 0, sizeof leavers->before);
    memset(leavers->behind, 0, sizeof leavers->behind);
    atomic_init(&leavers->count, 0);
}

/// Enters the newest version: its index.
static inline uint32_t tl_version_enter(tl_version_door *door)
{
    return (uint32_t)(atomic_fetch_add_explicit(&door->word, 1, memory_order_acquire) >> TL_DOOR_COUNT_BITS);
}

static inline void tl_version_leave(tl_version_leavers *leavers)
{
    (void)atomic_fetch_add_explicit(&leavers->count, 1, memory_order_release);
}

/// Makes a version the newest, which nobody has entered yet. Returns how many had entered the one before.
static inline uint64_t tl_version_open(tl_version_door *door, uint32_t index, tl_version_leavers *leavers)
{
    atomic_store_explicit(&leavers->count, 0, memory_order_relaxed);
    const uint64_t word = (uint64_t)index << TL_DOOR_COUNT_BITS;
    return atomic_exchange_explicit(&door->word, word, memory_order_acq_rel) &
           (((uint64_t)1 << TL_DOOR_COUNT_BITS) - 1);
}

/// How many have entered the newest version so far.
static inline uint64_t tl_version_entered(tl_version_door *door)
{
    return atomic_load_explicit(&door->word, memory_order_acquire) & (((uint64_t)1 << TL_DOOR_COUNT_BITS) - 1);
}

static inline uint64_t tl_version_left(tl_version_leavers *leavers)
{
    return atomic_load_explicit(&leavers->count, memory_order_acquire);
}

#endif
