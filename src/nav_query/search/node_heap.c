// SPDX-License-Identifier: MIT
//
// The open nodes of a search: a heap with four children a node, which knows where each node stands, so that a better
// cost moves a node up instead of adding it again. Four children halve the depth and share a cache line. An item is a
// node's total and index in one number, so that comparisons touch no node.
// The best node that came in since the last one left is kept at hand, beside the heap: most steps of a search go on
// with what they have just found, and then the heap is left alone. Where its top is better, the two change places in
// one pass. Source: Johnson, Priority Queues with Update and Finding Minimum Spanning Trees, 1975.

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

static void add_to_heap(tl_nav_query *query, uint64_t item)
{
    node_heap_sift_up(query->heap, query->heap_count++, item, query);
}

void tl_nav_heap_improve(tl_nav_query *query, uint32_t node)
{
    const uint32_t at = query->nodes[node].heap_at;
    const uint64_t item = tl_nav_open_key(query->nodes[node].total, node);
    if (at < query->heap_count && item <= query->heap[at]) {
        node_heap_sift_up(query->heap, at, item, query);
    } else if (at < query->heap_count) {
        node_heap_sift_down(query->heap, query->heap_count, at, item, query);
    } else if (at == TL_NAV_NODE_NEW && item > query->at_hand) {
        add_to_heap(query, item);
    } else {
        if (at == TL_NAV_NODE_NEW && query->at_hand != TL_NAV_NONE_AT_HAND) {
            add_to_heap(query, query->at_hand);
        }
        query->at_hand = item;
        query->nodes[node].heap_at = TL_NAV_NODE_AT_HAND;
    }
}

uint32_t tl_nav_heap_pop(tl_nav_query *query)
{
    const uint64_t at_hand = query->at_hand;
    uint64_t least = at_hand;
    if (at_hand == TL_NAV_NONE_AT_HAND) {
        if (query->heap_count == 0) {
            return TL_NAV_NO_NODE;
        }
        least = node_heap_pop(query->heap, &query->heap_count, query);
    } else if (query->heap_count > 0 && query->heap[0] < at_hand) {
        least = query->heap[0];
        node_heap_sift_down(query->heap, query->heap_count, 0, at_hand, query);
    }
    query->at_hand = TL_NAV_NONE_AT_HAND;
    query->nodes[(uint32_t)least].heap_at = TL_NAV_NODE_CLOSED;
    return (uint32_t)least;
}
