// SPDX-License-Identifier: MIT
//
// The open wedges of an exact search: a heap with four children a node that holds its keys, so that a comparison
// touches no wedge and is one of integers. Ties go to the older wedge.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_HEAP_H
#define TALUS_SRC_NAV_QUERY_WEDGE_HEAP_H

#include "nav_query/search/node_pool.h"

#include <string.h>

/// An entry as one number: the bits of a float >= 0 are in the order of its value.
static inline uint64_t tl_nav_heap_key(float total, uint32_t wedge)
{
    uint32_t bits;
    memcpy(&bits, &total, sizeof bits);
    return (uint64_t)bits << 32 | wedge;
}

static inline tl_nav_heap_entry tl_nav_heap_entry_of(uint64_t key)
{
    uint32_t bits = (uint32_t)(key >> 32);
    tl_nav_heap_entry entry = { 0.0f, (uint32_t)key };
    memcpy(&entry.total, &bits, sizeof bits);
    return entry;
}

static inline void tl_nav_wedge_push(tl_nav_query *query, float total, uint32_t wedge)
{
    uint64_t key = tl_nav_heap_key(total, wedge);
    uint64_t *heap = query->wedge_heap;
    uint32_t at = query->open_count++;
    while (at > 0 && key < heap[(at - 1) / 4]) {
        heap[at] = heap[(at - 1) / 4];
        at = (at - 1) / 4;
    }
    heap[at] = key;
}

/// Moves an entry down from the top to where it belongs.
static inline void tl_nav_wedge_sink(tl_nav_query *query, uint64_t key)
{
    uint64_t *heap = query->wedge_heap;
    uint32_t count = query->open_count;
    uint32_t at = 0;
    for (;;) {
        uint32_t first = 4 * at + 1;
        uint32_t least = first;
        if (first + 4 <= count) {
            uint32_t low = first + (heap[first + 1] < heap[first] ? 1u : 0u);
            uint32_t high = first + 2 + (heap[first + 3] < heap[first + 2] ? 1u : 0u);
            least = heap[high] < heap[low] ? high : low;
        } else if (first < count) {
            for (uint32_t child = first + 1; child < count; child++) {
                least = heap[child] < heap[least] ? child : least;
            }
        } else {
            break;
        }
        if (!(heap[least] < key)) {
            break;
        }
        heap[at] = heap[least];
        at = least;
    }
    heap[at] = key;
}

/// The heap must not be empty.
static inline tl_nav_heap_entry tl_nav_wedge_pop(tl_nav_query *query)
{
    uint64_t top = query->wedge_heap[0];
    uint64_t last = query->wedge_heap[--query->open_count];
    if (query->open_count > 0) {
        tl_nav_wedge_sink(query, last);
    }
    return tl_nav_heap_entry_of(top);
}

#endif
