// SPDX-License-Identifier: MIT
//
// Allocator defaults and the build arena.
//
// The arena is a chain of blocks, each at least an eighth of all before it: a build's memory is few large allocations,
// freed by one call, and little of it lies idle. A request larger than the next block gets a block of its own size.

#include "base/arena.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/min_max.h"

#include <stdlib.h>
#include <string.h>
#if defined(_WIN32)
#include <malloc.h>
#endif

enum { MIN_BLOCK_BYTES = 4 * 1024, LIVE_SHARE = 8, ARENA_ALIGNMENT = 64, FIRST_ITEMS = 64 };

struct tl_arena_block {
    tl_arena_block *older;
    size_t size; // bytes in all, this head included
    size_t used; // bytes, this head included
};

static size_t round_up_to(size_t value, size_t alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

static void *aligned_malloc(size_t size, size_t alignment, void *user)
{
    (void)user;
    if (size > SIZE_MAX - alignment) {
        return NULL;
    }
#if defined(_WIN32)
    return _aligned_malloc(size, alignment);
#else
    // aligned_alloc wants a size that is a multiple of the alignment.
    return aligned_alloc(alignment, round_up_to(size, alignment));
#endif
}

static void aligned_release(void *block, size_t size, void *user)
{
    (void)size;
    (void)user;
#if defined(_WIN32)
    _aligned_free(block);
#else
    free(block);
#endif
}

tl_allocator tl_allocator_or_default(const tl_allocator *allocator)
{
    if (allocator != NULL && allocator->allocate != NULL) {
        return *allocator;
    }
    tl_allocator standard = { aligned_malloc, aligned_release, NULL };
    return standard;
}

void *tl_allocate(const tl_allocator *allocator, size_t size, size_t alignment)
{
    tl_allocator used = tl_allocator_or_default(allocator);
    return used.allocate(size, alignment, used.user);
}

void tl_release(const tl_allocator *allocator, void *block, size_t size)
{
    if (block != NULL) {
        tl_allocator used = tl_allocator_or_default(allocator);
        used.release(block, size, used.user);
    }
}

// Bytes of an array, at least one, or 0 when they do not fit a size_t.
static size_t array_bytes(uint64_t count, size_t size)
{
    // Two numbers below 2^32 have a product below 2^64; a division takes as long as all the rest of a push.
    const bool is_small = ((count | size) >> 32) == 0;
    const uint64_t limit = SIZE_MAX - ARENA_ALIGNMENT;
    if (is_small ? count * size > limit : size != 0 && count > limit / size) {
        return 0;
    }
    size_t bytes = (size_t)count * size;
    return bytes > 0 ? bytes : 1;
}

void *tl_allocate_array(const tl_allocator *allocator, uint64_t count, size_t size)
{
    size_t bytes = array_bytes(count, size);
    return bytes > 0 ? tl_allocate(allocator, bytes, ARENA_ALIGNMENT) : NULL;
}

void tl_release_array(const tl_allocator *allocator, void *array, uint64_t count, size_t size)
{
    tl_release(allocator, array, array_bytes(count, size));
}

void *tl_grow_array(const tl_allocator *allocator, void *items, uint64_t *capacity, size_t size)
{
    uint64_t more = *capacity > 0 ? 2 * *capacity : FIRST_ITEMS;
    void *grown = tl_allocate_array(allocator, more, size);
    if (grown != NULL) {
        if (*capacity > 0) {
            memcpy(grown, items, (size_t)*capacity * size);
        }
        tl_release_array(allocator, items, *capacity, size);
        *capacity = more;
    }
    return grown;
}

// The header before a blob in memory, never in a file: the allocator. Its size keeps the blob aligned.
typedef struct tl_blob_owner {
    uint64_t magic;
    size_t size; // of the whole block, this included
    tl_allocator allocator;
    char padding[TL_BLOB_ALIGNMENT - sizeof(uint64_t) - sizeof(size_t) - sizeof(tl_allocator)];
} tl_blob_owner;

_Static_assert(sizeof(tl_blob_owner) == TL_BLOB_ALIGNMENT, "a blob follows its owner and stays aligned");

#define BLOB_OWNER_MAGIC 0x72656e776f6c6274u // "tblowner"

void *tl_blob_allocate(const tl_allocator *allocator, uint32_t magic, uint32_t version, uint64_t size)
{
    return tl_blob_allocate_part(allocator, magic, version, size, size, size);
}

void *tl_blob_allocate_part(const tl_allocator *allocator, uint32_t magic, uint32_t version, uint64_t size,
                            uint64_t unset_begin, uint64_t unset_end)
{
    if (size > SIZE_MAX - TL_BLOB_ALIGNMENT - sizeof(tl_blob_owner)) {
        return NULL;
    }
    size_t rounded = round_up_to((size_t)size, TL_BLOB_ALIGNMENT);
    tl_blob_owner *owner = tl_allocate(allocator, sizeof(tl_blob_owner) + rounded, TL_BLOB_ALIGNMENT);
    tl_blob *blob = NULL;
    if (owner != NULL) {
        memset(owner, 0, sizeof *owner);
        owner->magic = BLOB_OWNER_MAGIC;
        owner->size = sizeof *owner + rounded;
        owner->allocator = tl_allocator_or_default(allocator);
        blob = (tl_blob *)(owner + 1);
        memset(blob, 0, (size_t)unset_begin);
        memset((char *)blob + unset_end, 0, rounded - (size_t)unset_end);
        blob->magic = magic;
        blob->version = version;
        blob->size = rounded;
    }
    return blob;
}

void tl_blob_free(void *blob)
{
    if (blob != NULL) {
        tl_blob_owner *owner = (tl_blob_owner *)blob - 1;
        TL_ASSERT(owner->magic == BLOB_OWNER_MAGIC); // else it was mapped or copied, and is not the library's to free
        tl_allocator allocator = owner->allocator;
        owner->magic = 0;
        allocator.release(owner, owner->size, allocator.user);
    }
}

void tl_blob_array_free(const tl_allocator *allocator, void *blobs, uint64_t count)
{
    for (uint64_t i = 0; blobs != NULL && i < count; i++) {
        void *blob;
        memcpy(&blob, (const char *)blobs + i * sizeof blob, sizeof blob);
        tl_blob_free(blob);
    }
    tl_release_array(allocator, blobs, count, sizeof(void *));
}

void tl_blob_hand_over(void *blob, const tl_allocator *allocator)
{
    if (blob != NULL) {
        tl_blob_owner *owner = (tl_blob_owner *)blob - 1;
        TL_ASSERT(owner->magic == BLOB_OWNER_MAGIC);
        owner->allocator = tl_allocator_or_default(allocator);
    }
}

void tl_arena_init(tl_arena *arena, const tl_allocator *allocator)
{
    memset(arena, 0, sizeof *arena);
    arena->allocator = tl_allocator_or_default(allocator);
}

void tl_arena_init_with(tl_arena *arena, const tl_allocator *allocator, void *memory, size_t bytes)
{
    tl_arena_init(arena, allocator);
    TL_ASSERT((uintptr_t)memory % ARENA_ALIGNMENT == 0 && bytes > ARENA_ALIGNMENT);
    arena->newest = arena->lent = (tl_arena_block *)memory;
    arena->lent->older = NULL;
    arena->lent->size = bytes;
    arena->lent->used = round_up_to(sizeof(tl_arena_block), ARENA_ALIGNMENT);
}

static void free_newest(tl_arena *arena)
{
    tl_arena_block *block = arena->newest;
    arena->newest = block->older;
    if (block == arena->lent) {
        arena->lent = NULL;
        return;
    }
    arena->live_bytes -= block->size;
    arena->allocator.release(block, block->size, arena->allocator.user);
}

void tl_arena_free(tl_arena *arena)
{
    while (arena->newest != NULL) {
        free_newest(arena);
    }
}

static bool add_block(tl_arena *arena, size_t bytes)
{
    size_t head = round_up_to(sizeof(tl_arena_block), ARENA_ALIGNMENT);
    if (bytes > SIZE_MAX - head - ARENA_ALIGNMENT) {
        return false;
    }
    size_t size = round_up_to((size_t)(arena->live_bytes / LIVE_SHARE), ARENA_ALIGNMENT);
    size = (size_t)tl_max_u64(size, MIN_BLOCK_BYTES);
    if (size < head + bytes) {
        size = round_up_to(head + bytes, ARENA_ALIGNMENT);
    }
    tl_arena_block *block = arena->allocator.allocate(size, ARENA_ALIGNMENT, arena->allocator.user);
    if (block == NULL) {
        return false;
    }
    block->older = arena->newest;
    block->size = size;
    block->used = head;
    arena->newest = block;
    arena->live_bytes += size;
    if (arena->live_bytes > arena->peak_bytes) {
        arena->peak_bytes = arena->live_bytes;
    }
    return true;
}

static TL_NOINLINE void *push_into_new_block(tl_arena *arena, size_t bytes)
{
    if (!add_block(arena, bytes)) {
        return NULL;
    }
    tl_arena_block *block = arena->newest;
    void *memory = (char *)block + block->used;
    block->used += bytes;
    return memory;
}

void *tl_arena_push(tl_arena *arena, uint64_t count, size_t size)
{
    size_t bytes = array_bytes(count, size);
    if (bytes == 0) {
        return NULL;
    }
    size_t alignment = bytes >= ARENA_ALIGNMENT ? ARENA_ALIGNMENT : 16;
    tl_arena_block *block = arena->newest;
    if (block == NULL) {
        return push_into_new_block(arena, bytes);
    }
    size_t start = round_up_to(block->used, alignment);
    if (start > block->size || bytes > block->size - start) {
        return push_into_new_block(arena, bytes);
    }
    block->used = start + bytes;
    return (char *)block + start;
}

void *tl_arena_push_zero(tl_arena *arena, uint64_t count, size_t size)
{
    void *memory = tl_arena_push(arena, count, size);
    if (memory != NULL) {
        memset(memory, 0, array_bytes(count, size));
    }
    return memory;
}

void *tl_arena_grow(tl_arena *arena, const void *items, uint32_t *capacity, uint32_t first, size_t size)
{
    uint32_t more = *capacity > 0 ? 2 * *capacity : first;
    void *grown = more > *capacity ? tl_arena_push(arena, more, size) : NULL;
    if (grown != NULL) {
        if (*capacity > 0) {
            memcpy(grown, items, *capacity * size);
        }
        *capacity = more;
    }
    return grown;
}

bool tl_arena_reserve(tl_arena *arena, uint64_t bytes)
{
    const tl_arena_block *block = arena->newest;
    if (block != NULL && block->size - block->used >= bytes) {
        return true;
    }
    return bytes <= SIZE_MAX && add_block(arena, (size_t)bytes);
}

tl_arena_mark tl_arena_get_mark(const tl_arena *arena)
{
    tl_arena_mark mark = { arena->newest, arena->newest != NULL ? arena->newest->used : 0 };
    return mark;
}

void tl_arena_rollback(tl_arena *arena, tl_arena_mark mark)
{
    while (arena->newest != mark.block) {
        TL_ASSERT(arena->newest != NULL);
        free_newest(arena);
    }
    if (mark.block != NULL) {
        mark.block->used = mark.used;
    }
}
