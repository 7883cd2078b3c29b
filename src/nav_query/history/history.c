// SPDX-License-Identifier: MIT
//
// Memory that versions of a navmesh share: who releases it only says that the newest version has it no more.
//
// Each block knows the first version that has it. Released in that same version nobody else has seen it, and it goes at
// once. Else it joins the list of blocks that die with the version before, and is freed when no version that is held
// lies between its birth and its death (versions/nav_versions.c). Pages of arrays are stamped with the last version
// that changed them, so that a copy that is some versions old is brought up to date by what has changed since.

#include "nav_query/history/history.h"

#include "base/arena.h"
#include "base/assert.h"

static void *allocate_shared(size_t size, size_t alignment, void *user)
{
    tl_nav_history *history = (tl_nav_history *)user;
    (void)alignment;
    TL_ASSERT(sizeof(tl_nav_block) <= TL_NAV_BLOCK_HEAD && alignment <= TL_NAV_BLOCK_HEAD);
    if (size > SIZE_MAX - TL_NAV_BLOCK_HEAD) {
        return NULL;
    }
    tl_nav_block *block = (tl_nav_block *)tl_allocate(&history->host, size + TL_NAV_BLOCK_HEAD, TL_NAV_BLOCK_HEAD);
    if (block == NULL) {
        return NULL;
    }
    block->next = NULL;
    block->born = history->draft;
    block->size = size + TL_NAV_BLOCK_HEAD;
    block->tile = NULL;
    return (char *)block + TL_NAV_BLOCK_HEAD;
}

void tl_nav_free_block(tl_nav_history *history, tl_nav_block *block)
{
    tl_blob_free(block->tile);
    tl_release(&history->host, block, block->size);
}

static void release_shared(void *memory, size_t size, void *user)
{
    tl_nav_history *history = (tl_nav_history *)user;
    tl_nav_block *block = tl_nav_block_of(memory);
    (void)size;
    TL_ASSERT(block->size == size + TL_NAV_BLOCK_HEAD);
    if (history->ends || block->born == history->draft) {
        tl_nav_free_block(history, block);
        return;
    }
    block->next = history->dying;
    history->dying = block;
    history->waiting_bytes += block->size;
}

void *tl_nav_keep_tile(tl_nav_history *history)
{
    return allocate_shared(1, 1, history);
}

void tl_nav_keep(void *keeper, const void *tile)
{
    if (keeper != NULL) {
        // The navmesh was given the blob to free; const only says that queries never write to it.
        union {
            const void *read;
            void *write;
        } kept = { tile };
        tl_nav_block_of(keeper)->tile = kept.write;
    }
}

tl_allocator tl_nav_history_allocator(tl_nav_history *history)
{
    const tl_allocator allocator = { allocate_shared, release_shared, history };
    return allocator;
}

void tl_nav_touch_all(tl_nav_history *history, uint32_t array, uint64_t count)
{
    if (history == NULL || count == 0) {
        return;
    }
    uint32_t shift = 0;
    while ((count - 1) >> shift >= TL_NAV_PAGES) {
        shift++;
    }
    history->shift[array] = shift;
    for (uint32_t page = 0; page < TL_NAV_PAGES; page++) {
        history->touched[array][page] = history->draft;
    }
}
