// SPDX-License-Identifier: MIT
//
// Growth by doubling.

#include "io/files/growable.h"

#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <malloc.h>
#endif

enum { ALIGNMENT = 64, FIRST_ITEMS = 64 };

static void *io_default_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
#ifdef _WIN32
    return _aligned_malloc(size, alignment);
#else
    // aligned_alloc wants a multiple of the alignment.
    return size <= SIZE_MAX - alignment ? aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                                        : NULL;
#endif
}

static void io_default_release(void *block, size_t size, void *user)
{
    (void)size;
    (void)user;
#ifdef _WIN32
    _aligned_free(block);
#else
    free(block);
#endif
}

tl_allocator tl_io_allocator_or_default(const tl_allocator *allocator)
{
    if (allocator != NULL) {
        return *allocator;
    }
    tl_allocator standard = { io_default_allocate, io_default_release, NULL };
    return standard;
}

void *tl_io_allocate(const tl_allocator *allocator, uint64_t size)
{
    return size <= SIZE_MAX ? allocator->allocate((size_t)size, ALIGNMENT, allocator->user) : NULL;
}

void tl_io_release(const tl_allocator *allocator, void *block, uint64_t size)
{
    if (block != NULL) {
        allocator->release(block, (size_t)size, allocator->user);
    }
}

bool tl_io_grow(const tl_allocator *allocator, void **array, uint64_t *capacity, uint64_t used, uint64_t needed,
                size_t item_size)
{
    if (needed <= *capacity) {
        return true;
    }
    uint64_t wanted = *capacity <= UINT64_MAX / 2 ? *capacity * 2 : needed;
    wanted = wanted < FIRST_ITEMS ? FIRST_ITEMS : wanted;
    wanted = wanted < needed ? needed : wanted;
    if (wanted > SIZE_MAX / item_size) {
        return false;
    }
    void *larger = tl_io_allocate(allocator, (size_t)wanted * item_size);
    if (larger == NULL) {
        return false;
    }
    if (used > 0) {
        memcpy(larger, *array, (size_t)used * item_size);
    }
    tl_io_release(allocator, *array, (size_t)*capacity * item_size);
    *array = larger;
    *capacity = wanted;
    return true;
}

tl_result tl_io_progress(const tl_host *host, const char *stage, uint64_t done, uint64_t total)
{
    if (host == NULL || host->progress == NULL || host->progress->update == NULL) {
        return TL_OK;
    }
    return host->progress->update(stage, done, total, host->progress->user) ? TL_OK : TL_ERR_CANCELLED;
}
