// SPDX-License-Identifier: MIT
//
// What the versions of a navmesh share, and which parts of it the version being made has changed (history.c).
//
// A navmesh that is alone has no history: all functions here take NULL for that, and do nothing.

#ifndef TALUS_SRC_NAV_QUERY_HISTORY_H
#define TALUS_SRC_NAV_QUERY_HISTORY_H

#include <talus/base.h>

/// In front of each block of memory that versions share.
typedef struct tl_nav_block {
    struct tl_nav_block *next; ///< in a list of blocks that wait to be freed
    uint64_t born;             ///< the first version that has it
    size_t size;               ///< bytes in all, this head included
    void *tile;                ///< a blob that is freed together with it, or NULL
} tl_nav_block;

enum { TL_NAV_BLOCK_HEAD = 64 }; ///< bytes of that head: they keep the alignment which allocators promise

/// Arrays that each version has a copy of, which is brought up to date page by page.
typedef enum tl_nav_paged_array {
    TL_NAV_PAGED_SLOTS,
    TL_NAV_PAGED_BUCKETS,
    TL_NAV_PAGED_AREAS,
    TL_NAV_PAGED_ISLAND_NODES,
    TL_NAV_PAGED_LABELS, ///< one array for each kind of islands
    TL_NAV_PAGED_ARRAYS = TL_NAV_PAGED_LABELS + 2
} tl_nav_paged_array;

enum { TL_NAV_PAGES = 2048 }; ///< of an array, at most: they grow with it

typedef struct tl_nav_history {
    tl_allocator host;
    uint64_t draft;         ///< number of the version that is being made, or will be next
    tl_nav_block *dying;    ///< blocks that the draft has no more, and versions before it have
    uint64_t waiting_bytes; ///< of blocks that wait to be freed
    bool ends;              ///< all is freed at once
    uint32_t shift[TL_NAV_PAGED_ARRAYS];
    uint64_t touched[TL_NAV_PAGED_ARRAYS][TL_NAV_PAGES]; ///< the last version that changed the page
    uint64_t offmesh_touched;                            ///< the same of the table of off-mesh links
} tl_nav_history;

/// The allocator of a navmesh in versions: what older versions have waits until they are gone.
tl_allocator tl_nav_history_allocator(tl_nav_history *history);
/// Memory that frees an owned tile together with itself, once tl_nav_keep has said which. NULL: out of memory.
void *tl_nav_keep_tile(tl_nav_history *history);
/// NULL keeper: nothing happens. NULL tile: it is not freed after all.
void tl_nav_keep(void *keeper, const void *tile);
/// Frees a block whatever versions have it.
void tl_nav_free_block(tl_nav_history *history, tl_nav_block *block);

/// Notes that the draft changes an element of an array.
static inline void tl_nav_touch(tl_nav_history *history, uint32_t array, uint64_t index)
{
    if (history != NULL) {
        history->touched[array][index >> history->shift[array]] = history->draft;
    }
}
/// Notes that the draft changes all of an array, which has room for `count` now.
void tl_nav_touch_all(tl_nav_history *history, uint32_t array, uint64_t count);

static inline void tl_nav_touch_offmesh(tl_nav_history *history)
{
    if (history != NULL) {
        history->offmesh_touched = history->draft;
    }
}

/// The head of what the allocator above gave.
static inline tl_nav_block *tl_nav_block_of(void *memory)
{
    return (tl_nav_block *)(void *)((char *)memory - TL_NAV_BLOCK_HEAD);
}

/// Whether older versions have what that allocator gave: it must not be written to.
static inline bool tl_nav_is_shared(const tl_nav_history *history, void *memory)
{
    return history != NULL && memory != NULL && tl_nav_block_of(memory)->born != history->draft;
}

#endif
