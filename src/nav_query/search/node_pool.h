// SPDX-License-Identifier: MIT
//
// The nodes of a search: a fixed pool with a hash table from keys, and the heap of open ones.

#ifndef TALUS_SRC_NAV_QUERY_NODE_POOL_H
#define TALUS_SRC_NAV_QUERY_NODE_POOL_H

#include "base/hash.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/search/query.h"

// Values of tl_nav_node.heap_at beside places in the heap.
#define TL_NAV_NODE_NEW     UINT32_MAX
#define TL_NAV_NODE_CLOSED  (UINT32_MAX - 1u)
#define TL_NAV_NODE_AT_HAND (UINT32_MAX - 2u)

/// The value of tl_nav_query.at_hand when no node is: it comes after all of them.
#define TL_NAV_NONE_AT_HAND UINT64_MAX

/// A way into a polygon.
struct tl_nav_node {
    uint64_t key;
    tl_vec3 point; ///< where the polygon is entered
    float cost;    ///< from the start to point
    float total;   ///< cost and estimate to the goal: what the heap is ordered by
    uint32_t parent;
    uint32_t slot, polygon; ///< that is entered
    uint32_t heap_at;
    uint32_t next; ///< in the chain of its bucket
};

/// Forgets all nodes. O(nodes used by the search before).
void tl_nav_pool_reset(tl_nav_query *query);

/// Keys of one tile follow one another, and so do their buckets: a search in a few tiles stays in a few lines of
/// memory, however large the pool.
static inline uint32_t *tl_nav_bucket_of(tl_nav_query *query, uint64_t key)
{
    const uint32_t tile = (uint32_t)((key >> TL_NAV_REF_POLYGON_BITS) * 0x9e3779b97f4a7c15u >> 32);
    return &query->buckets[(tile + (uint32_t)key) & (query->bucket_count - 1)];
}

/// The node of a key, or TL_NAV_NO_NODE.
static inline uint32_t tl_nav_pool_find(tl_nav_query *query, uint64_t key)
{
    uint32_t index = *tl_nav_bucket_of(query, key);
    while (index != TL_NAV_NO_NODE && query->nodes[index].key != key) {
        index = query->nodes[index].next;
    }
    return index;
}

/// A fresh node for a key that has none, of which nothing but the key is set; or TL_NAV_NO_NODE when the pool is used
/// up.
static inline uint32_t tl_nav_pool_add(tl_nav_query *query, uint64_t key)
{
    if (query->node_count == query->max_nodes) {
        return TL_NAV_NO_NODE;
    }
    uint32_t *bucket = tl_nav_bucket_of(query, key);
    const uint32_t index = query->node_count++;
    tl_nav_node *node = &query->nodes[index];
    node->key = key;
    node->heap_at = TL_NAV_NODE_NEW;
    node->next = *bucket;
    *bucket = index;
    return index;
}

/// The node of a key, a fresh one if need be, or TL_NAV_NO_NODE when the pool is used up.
static inline uint32_t tl_nav_pool_get(tl_nav_query *query, uint64_t key)
{
    const uint32_t index = tl_nav_pool_find(query, key);
    return index != TL_NAV_NO_NODE ? index : tl_nav_pool_add(query, key);
}

/// A way into a polygon that a search has found.
typedef struct tl_nav_way_in {
    uint64_t key;
    uint32_t slot, polygon;
    tl_vec3 point; ///< where the polygon is entered
    float cost;    ///< from the start to point
    uint32_t parent;
} tl_nav_way_in;

/// Dijkstra's and A*'s relaxation: the node of the way's key when the way is cheaper than all before it, and then with
/// all of it filled in; the caller sets `total` and improves the heap. `known`: the node of the key, or TL_NAV_NO_NODE.
/// NULL: it is not, or the pool is used up, which sets *is_full.
static inline tl_nav_node *tl_nav_pool_relax_known(tl_nav_query *query, uint32_t known, tl_nav_way_in way,
                                                   bool *is_full)
{
    const uint32_t index = known != TL_NAV_NO_NODE ? known : tl_nav_pool_add(query, way.key);
    if (index == TL_NAV_NO_NODE) {
        *is_full = true;
        return NULL;
    }
    tl_nav_node *node = &query->nodes[index];
    if (known != TL_NAV_NO_NODE && (node->heap_at == TL_NAV_NODE_CLOSED || way.cost >= node->cost)) {
        return NULL;
    }
    node->slot = way.slot;
    node->polygon = way.polygon;
    node->point = way.point;
    node->cost = way.cost;
    node->parent = way.parent;
    return node;
}

static inline tl_nav_node *tl_nav_pool_relax(tl_nav_query *query, tl_nav_way_in way, bool *is_full)
{
    return tl_nav_pool_relax_known(query, tl_nav_pool_find(query, way.key), way, is_full);
}

/// Puts a node into the heap, or moves it after its total has changed. A cheaper way may raise it: where it enters the
/// polygon at another point, from which the goal is farther than what the way is cheaper by.
void tl_nav_heap_improve(tl_nav_query *query, uint32_t node);
/// Takes out the node of the lowest total, ties to the lower index, and marks it closed. TL_NAV_NO_NODE: it is empty.
uint32_t tl_nav_heap_pop(tl_nav_query *query);

#endif
