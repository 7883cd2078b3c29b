// SPDX-License-Identifier: MIT
//
// The open nodes of a search: a heap with four children a node, which knows where each node stands, so that a better
// cost moves a node up instead of adding it again. Four children halve the depth and share a cache line.
// Source: Johnson, Priority Queues with Update and Finding Minimum Spanning Trees, 1975.

#include "nav_query/search/node_pool.h"

enum { ARITY = 4 };

// A strict order of all nodes, so that the search does not depend on how the heap is laid out.
static bool before(const tl_nav_query *query, uint32_t a, uint32_t b)
{
    float total_a = query->nodes[a].total;
    float total_b = query->nodes[b].total;
    return total_a < total_b || (total_a == total_b && a < b);
}

static void place(tl_nav_query *query, uint32_t at, uint32_t node)
{
    query->heap[at] = node;
    query->nodes[node].heap_at = at;
}

static void sift_up(tl_nav_query *query, uint32_t at, uint32_t node)
{
    while (at > 0) {
        uint32_t parent = (at - 1) / ARITY;
        if (!before(query, node, query->heap[parent])) {
            break;
        }
        place(query, at, query->heap[parent]);
        at = parent;
    }
    place(query, at, node);
}

static void sift_down(tl_nav_query *query, uint32_t at, uint32_t node)
{
    for (;;) {
        uint32_t first = at * ARITY + 1;
        if (first >= query->heap_count) {
            break;
        }
        uint32_t end = first + ARITY < query->heap_count ? first + ARITY : query->heap_count;
        uint32_t least = first;
        for (uint32_t child = first + 1; child < end; child++) {
            if (before(query, query->heap[child], query->heap[least])) {
                least = child;
            }
        }
        if (!before(query, query->heap[least], node)) {
            break;
        }
        place(query, at, query->heap[least]);
        at = least;
    }
    place(query, at, node);
}

void tl_nav_heap_improve(tl_nav_query *query, uint32_t node)
{
    uint32_t at = query->nodes[node].heap_at;
    sift_up(query, at == TL_NAV_NODE_NEW ? query->heap_count++ : at, node);
}

uint32_t tl_nav_heap_pop(tl_nav_query *query)
{
    if (query->heap_count == 0) {
        return TL_NAV_NO_NODE;
    }
    uint32_t least = query->heap[0];
    uint32_t last = query->heap[--query->heap_count];
    if (query->heap_count > 0) {
        sift_down(query, 0, last);
    }
    query->nodes[least].heap_at = TL_NAV_NODE_CLOSED;
    return least;
}
