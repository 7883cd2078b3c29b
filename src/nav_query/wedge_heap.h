// SPDX-License-Identifier: MIT
//
// The open wedges of an exact search: a heap with four children a node that holds its keys, so that a comparison
// touches no wedge. Ties go to the older wedge.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_HEAP_H
#define TALUS_SRC_NAV_QUERY_WEDGE_HEAP_H

#include "nav_query/node_pool.h"

static inline bool tl_nav_wedge_before(tl_nav_heap_entry a, tl_nav_heap_entry b)
{
    return a.total < b.total || (a.total == b.total && a.wedge < b.wedge);
}

static inline void tl_nav_wedge_push(tl_nav_query *query, float total, uint32_t wedge)
{
    tl_nav_heap_entry entry = { total, wedge };
    tl_nav_heap_entry *heap = query->wedge_heap;
    uint32_t at = query->open_count++;
    while (at > 0) {
        uint32_t parent = (at - 1) / 4;
        if (!tl_nav_wedge_before(entry, heap[parent])) {
            break;
        }
        heap[at] = heap[parent];
        at = parent;
    }
    heap[at] = entry;
}

/// Moves an entry down from the top to where it belongs.
static inline void tl_nav_wedge_sink(tl_nav_query *query, tl_nav_heap_entry entry)
{
    tl_nav_heap_entry *heap = query->wedge_heap;
    uint32_t count = query->open_count;
    uint32_t at = 0;
    for (;;) {
        uint32_t first = 4 * at + 1;
        if (first >= count) {
            break;
        }
        uint32_t end = first + 4 < count ? first + 4 : count;
        uint32_t least = first;
        for (uint32_t child = first + 1; child < end; child++) {
            least = tl_nav_wedge_before(heap[child], heap[least]) ? child : least;
        }
        if (!tl_nav_wedge_before(heap[least], entry)) {
            break;
        }
        heap[at] = heap[least];
        at = least;
    }
    heap[at] = entry;
}

/// The heap must not be empty.
static inline tl_nav_heap_entry tl_nav_wedge_pop(tl_nav_query *query)
{
    tl_nav_heap_entry top = query->wedge_heap[0];
    tl_nav_heap_entry last = query->wedge_heap[--query->open_count];
    if (query->open_count > 0) {
        tl_nav_wedge_sink(query, last);
    }
    return top;
}

#endif
