// SPDX-License-Identifier: MIT
//
// The open nodes of a search: a heap with four children a node, which knows where each node stands, so that a better
// cost moves a node up instead of adding it again. Four children halve the depth and share a cache line. An item is a
// node's total and index in one number, so that comparisons touch no node.
// Source: Johnson, Priority Queues with Update and Finding Minimum Spanning Trees, 1975.

#include "nav_query/search/node_pool.h"
#include "nav_query/search/open_items.h"

// Totals are >= 0, and ties go to the lower index: a strict order of all nodes, so that the search does not depend on
// how the heap is laid out.
#define TL_HEAP(name)                  node_heap_##name
#define TL_HEAP_ITEM                   uint64_t
#define TL_HEAP_CONTEXT                tl_nav_query *
#define TL_HEAP_BEFORE(query, a, b)    ((a) < (b))
#define TL_HEAP_MOVED(query, item, at) ((query)->nodes[(uint32_t)(item)].heap_at = (at))
#define TL_HEAP_ARITY                  4u
#include "base/heap.inl"

void tl_nav_heap_improve(tl_nav_query *query, uint32_t node)
{
    const uint32_t at = query->nodes[node].heap_at;
    node_heap_sift_up(query->heap, at == TL_NAV_NODE_NEW ? query->heap_count++ : at,
                      tl_nav_open_key(query->nodes[node].total, node), query);
}

uint32_t tl_nav_heap_pop(tl_nav_query *query)
{
    if (query->heap_count == 0) {
        return TL_NAV_NO_NODE;
    }
    const uint32_t least = (uint32_t)node_heap_pop(query->heap, &query->heap_count, query);
    query->nodes[least].heap_at = TL_NAV_NODE_CLOSED;
    return least;
}
