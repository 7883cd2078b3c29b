// SPDX-License-Identifier: MIT
//
// The open nodes of a search: a heap with four children a node, which knows where each node stands, so that a better
// cost moves a node up instead of adding it again. Four children halve the depth and share a cache line.
// Source: Johnson, Priority Queues with Update and Finding Minimum Spanning Trees, 1975.

#include "nav_query/search/node_pool.h"

// A strict order of all nodes, so that the search does not depend on how the heap is laid out.
static bool is_node_before(const tl_nav_query *query, uint32_t a, uint32_t b)
{
    float total_a = query->nodes[a].total;
    float total_b = query->nodes[b].total;
    return total_a < total_b || (total_a == total_b && a < b);
}

#define TL_HEAP(name)                  node_heap_##name
#define TL_HEAP_ITEM                   uint32_t
#define TL_HEAP_CONTEXT                tl_nav_query *
#define TL_HEAP_BEFORE(query, a, b)    is_node_before(query, a, b)
#define TL_HEAP_MOVED(query, node, at) ((query)->nodes[node].heap_at = (at))
#define TL_HEAP_ARITY                  4u
#include "base/heap.inl"

void tl_nav_heap_improve(tl_nav_query *query, uint32_t node)
{
    uint32_t at = query->nodes[node].heap_at;
    node_heap_sift_up(query->heap, at == TL_NAV_NODE_NEW ? query->heap_count++ : at, node, query);
}

uint32_t tl_nav_heap_pop(tl_nav_query *query)
{
    if (query->heap_count == 0) {
        return TL_NAV_NO_NODE;
    }
    uint32_t least = node_heap_pop(query->heap, &query->heap_count, query);
    query->nodes[least].heap_at = TL_NAV_NODE_CLOSED;
    return least;
}
