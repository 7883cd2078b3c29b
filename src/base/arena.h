// SPDX-License-Identifier: MIT
//
// One arena per build: memory is taken from large blocks and given back all at once, so a build has one exit.

#ifndef TALUS_SRC_BASE_ARENA_H
#define TALUS_SRC_BASE_ARENA_H

#include "base/exact_floats.h"

#include <talus/base.h>

typedef struct tl_arena_block tl_arena_block;

/// Not thread safe: parallel tasks take an arena each.
typedef struct tl_arena {
    tl_allocator allocator;
    tl_arena_block *newest;
    tl_arena_block *lent; ///< the block that is not the allocator's, or NULL
    uint64_t live_bytes;  ///< taken from the allocator now
    uint64_t peak_bytes;  ///< the most it ever was
} tl_arena;

/// A place in the arena to which it can be rolled back.
typedef struct tl_arena_mark {
    tl_arena_block *block;
    size_t used;
} tl_arena_mark;

/// The allocator that NULL, or a zeroed one, stands for: aligned malloc and free.
tl_allocator tl_allocator_or_default(const tl_allocator *allocator);

void *tl_allocate(const tl_allocator *allocator, size_t size, size_t alignment);
void tl_release(const tl_allocator *allocator, void *block, size_t size);

/// count * size bytes aligned to 64, or NULL when that overflows or memory is out. count 0 gives a valid block.
void *tl_allocate_array(const tl_allocator *allocator, uint64_t count, size_t size);
/// Gives back what tl_allocate_array(allocator, count, size) returned; NULL is allowed.
void tl_release_array(const tl_allocator *allocator, void *array, uint64_t count, size_t size);

/// Doubles the capacity of a full array and keeps its items; `*capacity` is then the new one. NULL when memory is out:
/// the array is as it was.
void *tl_grow_array(const tl_allocator *allocator, void *items, uint64_t *capacity, size_t size);

/// A zeroed blob of at least `size` bytes, rounded up to TL_BLOB_ALIGNMENT, its head filled; NULL when memory is out.
void *tl_blob_allocate(const tl_allocator *allocator, uint32_t magic, uint32_t version, uint64_t size);

/// The same, but bytes [unset_begin, unset_end) hold anything: the caller writes them all. sizeof(tl_blob) <=
/// unset_begin <= unset_end <= size.
void *tl_blob_allocate_part(const tl_allocator *allocator, uint32_t magic, uint32_t version, uint64_t size,
                            uint64_t unset_begin, uint64_t unset_end);

/// Frees `count` blobs and the array of pointers to them, which tl_allocate_array gave; NULL is allowed.
void tl_blob_array_free(const tl_allocator *allocator, void *blobs, uint64_t count);

/// From now on the blob is freed by another allocator, for the same memory: one that metered it hands it over to the
/// host's own. NULL blob: nothing happens.
void tl_blob_hand_over(void *blob, const tl_allocator *allocator);

/// NULL allocator: malloc. Takes no memory yet.
void tl_arena_init(tl_arena *arena, const tl_allocator *allocator);
/// The same, but what fits into `bytes` of memory that the caller lends, and that outlives the arena, costs the
/// allocator nothing: of small builds most time would be its. `memory` is aligned to 64.
void tl_arena_init_with(tl_arena *arena, const tl_allocator *allocator, void *memory, size_t bytes);
void tl_arena_free(tl_arena *arena);

/// count * size bytes, uninitialized, aligned to 64 when that is at least 64 bytes, else to 16. NULL when memory is
/// out.
void *tl_arena_push(tl_arena *arena, uint64_t count, size_t size);
/// The same, zeroed.
void *tl_arena_push_zero(tl_arena *arena, uint64_t count, size_t size);

/// An array of the arena with more room, its items kept: twice `*capacity`, or `first` > 0 when that is 0. The old one
/// stays until the arena is rolled back. NULL, and `*capacity` as it was: memory is out, or the count would not fit
/// 32 bits.
void *tl_arena_grow(tl_arena *arena, const void *items, uint32_t *capacity, uint32_t first, size_t size);

/// Makes sure that pushes of so many bytes together take one block at most, so that rolling back and pushing again
/// costs the allocator nothing. False: out of memory.
bool tl_arena_reserve(tl_arena *arena, uint64_t bytes);

tl_arena_mark tl_arena_get_mark(const tl_arena *arena);
/// Frees all that was pushed since the mark.
void tl_arena_rollback(tl_arena *arena, tl_arena_mark mark);

#define TL_PUSH(arena, type, count)      ((type *)tl_arena_push((arena), (count), sizeof(type)))
#define TL_PUSH_ZERO(arena, type, count) ((type *)tl_arena_push_zero((arena), (count), sizeof(type)))

#endif
