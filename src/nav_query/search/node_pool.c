// SPDX-License-Identifier: MIT
//
// The nodes of a search: a fixed pool, and a chained hash table to find the node of a key.
//
// A search leaves its buckets filled; the next one empties just those, so that a short search in a large pool costs
// nothing for the room that it does not use.

#include "nav_query/search/node_pool.h"

#include "base/arena.h"
#include "base/hash.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/path/path_run.h"

#include <string.h>

// So that indices and the two marks of heap_at never meet, and buckets fit 32 bits.
#define MAX_NODES 0x40000000u

tl_nav_query_def tl_default_nav_query_def(void)
{
    tl_nav_query_def def = { 65536, NULL };
    return def;
}

static uint32_t power_of_two_above(uint32_t value)
{
    uint32_t power = 1;
    while (power < value) {
        power *= 2;
    }
    return power;
}

tl_result tl_nav_query_create(const tl_nav_query_def *def, tl_nav_query **query_out)
{
    *query_out = NULL;
    if (def->max_nodes < 2 || def->max_nodes > MAX_NODES) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_query *query = tl_allocate_array(def->allocator, 1, sizeof *query);
    if (query == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(query, 0, sizeof *query);
    query->allocator = tl_allocator_or_default(def->allocator);
    query->max_nodes = def->max_nodes;
    query->bucket_count = power_of_two_above(def->max_nodes);
    query->nodes = tl_allocate_array(def->allocator, query->max_nodes, sizeof *query->nodes);
    query->heap = tl_allocate_array(def->allocator, query->max_nodes, sizeof *query->heap);
    query->buckets = tl_allocate_array(def->allocator, query->bucket_count, sizeof *query->buckets);
    // At most one new root a wedge: the table stays half empty.
    query->root_mask = 2 * query->bucket_count - 1;
    query->wedges = tl_allocate_array(def->allocator, query->max_nodes, sizeof *query->wedges);
    query->stops = tl_allocate_array(def->allocator, query->max_nodes, sizeof *query->stops);
    query->wedge_heap = tl_allocate_array(def->allocator, query->max_nodes, sizeof *query->wedge_heap);
    query->roots = tl_allocate_array(def->allocator, (uint64_t)query->root_mask + 1, sizeof *query->roots);
    query->run = tl_allocate_array(def->allocator, 1, sizeof *query->run);
    if (query->run == NULL || query->wedges == NULL || query->stops == NULL || query->wedge_heap == NULL ||
        query->roots == NULL || query->nodes == NULL || query->heap == NULL || query->buckets == NULL) {
        tl_nav_query_destroy(query);
        return TL_ERR_MEMORY;
    }
    memset(query->run, 0, sizeof *query->run);
    memset(query->buckets, 0xff, (size_t)query->bucket_count * sizeof *query->buckets);
    memset(query->roots, 0, ((size_t)query->root_mask + 1) * sizeof *query->roots);
    *query_out = query;
    return TL_OK;
}

void tl_nav_query_destroy(tl_nav_query *query)
{
    if (query == NULL) {
        return;
    }
    tl_allocator allocator = query->allocator;
    tl_release_array(&allocator, query->nodes, query->max_nodes, sizeof *query->nodes);
    tl_release_array(&allocator, query->heap, query->max_nodes, sizeof *query->heap);
    tl_release_array(&allocator, query->stops, query->max_nodes, sizeof *query->stops);
    tl_release_array(&allocator, query->wedges, query->max_nodes, sizeof *query->wedges);
    tl_release_array(&allocator, query->wedge_heap, query->max_nodes, sizeof *query->wedge_heap);
    tl_release_array(&allocator, query->roots, (uint64_t)query->root_mask + 1, sizeof *query->roots);
    tl_release_array(&allocator, query->buckets, query->bucket_count, sizeof *query->buckets);
    tl_release_array(&allocator, query->run, 1, sizeof *query->run);
    tl_release_array(&allocator, query, 1, sizeof *query);
}

// Keys of one tile follow one another, and so do their buckets: a search in a few tiles stays in a few lines of memory,
// however large the pool.
static uint32_t *bucket_of(tl_nav_query *query, uint64_t key)
{
    uint32_t tile = (uint32_t)tl_hash_mix(key >> TL_NAV_REF_POLYGON_BITS);
    return &query->buckets[(tile + (uint32_t)key) & (query->bucket_count - 1)];
}

void tl_nav_pool_reset(tl_nav_query *query)
{
    for (uint32_t i = 0; i < query->node_count; i++) {
        *bucket_of(query, query->nodes[i].key) = TL_NAV_NO_NODE;
    }
    query->node_count = 0;
    query->heap_count = 0;
    query->pool_generation++;
}

uint32_t tl_nav_pool_get(tl_nav_query *query, uint64_t key)
{
    uint32_t *bucket = bucket_of(query, key);
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
