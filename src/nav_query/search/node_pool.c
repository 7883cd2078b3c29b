// SPDX-License-Identifier: MIT
//
// The nodes of a search: a fixed pool, and a chained hash table to find the node of a key.
//
// A search leaves its buckets filled; the next one empties just those, so that a short search in a large pool costs
// nothing for the room that it does not use.

#include "nav_query/search/node_pool.h"

#include "base/hash.h"
#include "nav_query/navmesh/navmesh.h"

#include <string.h>

// Keys of one tile follow one another, and so do their buckets: a search in a few tiles stays in a few lines of memory,
// however large the pool.
static uint32_t *node_bucket_of(tl_nav_query *query, uint64_t key)
{
    uint32_t tile = (uint32_t)tl_hash_mix(key >> TL_NAV_REF_POLYGON_BITS);
    return &query->buckets[(tile + (uint32_t)key) & (query->bucket_count - 1)];
}

void tl_nav_pool_reset(tl_nav_query *query)
{
    for (uint32_t i = 0; i < query->node_count; i++) {
        *node_bucket_of(query, query->nodes[i].key) = TL_NAV_NO_NODE;
    }
    query->node_count = 0;
    query->heap_count = 0;
    query->at_hand = TL_NAV_NONE_AT_HAND;
    query->pool_generation++;
}

uint32_t tl_nav_pool_get(tl_nav_query *query, uint64_t key)
{
    uint32_t *bucket = node_bucket_of(query, key);
    for (uint32_t i = *bucket; i != TL_NAV_NO_NODE; i = query->nodes[i].next) {
        if (query->nodes[i].key == key) {
            return i;
        }
    }
    if (query->node_count == query->max_nodes) {
        return TL_NAV_NO_NODE;
    }
    uint32_t index = query->node_count++;
    tl_nav_node *node = &query->nodes[index];
    memset(node, 0, sizeof *node);
    node->key = key;
    node->parent = TL_NAV_NO_NODE;
    node->heap_at = TL_NAV_NODE_NEW;
    node->next = *bucket;
    *bucket = index;
    return index;
}
