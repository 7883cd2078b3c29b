// SPDX-License-Identifier: MIT
//
// Creating a query: one block of memory for each kind of item that searches keep.

#include "base/arena.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "nav_query/path/path_run.h"
#include "nav_query/prepared/graph_search.h"
#include "nav_query/search/local_search.h"
#include "nav_query/search/node_pool.h"

#include <string.h>

// So that indices and the two marks of heap_at never meet, and buckets fit 32 bits.
#define MAX_QUERY_NODES 0x40000000u

_Static_assert(sizeof(tl_nav_wedge) >= sizeof(tl_nav_local_node), "a wedge has room for a local node");
_Static_assert(sizeof(tl_nav_wedge) >= sizeof(tl_nav_corner_leg), "a wedge has room for a leg");
_Static_assert(sizeof(tl_nav_wedge) >= 2 * sizeof(tl_sort_item), "wedges have room for items and their scratch");

tl_nav_query_def tl_default_nav_query_def(void)
{
    tl_nav_query_def def = { 65536, NULL, TL_DEF_COOKIE };
    return def;
}

static uint32_t power_of_two_from(uint32_t value)
{
    uint32_t power = 1;
    while (power < value) {
        power *= 2;
    }
    return power;
}

static bool allocate_blocks(tl_nav_query *query)
{
    const tl_allocator *allocator = &query->allocator;
    query->nodes = tl_allocate_array(allocator, query->max_nodes, sizeof *query->nodes);
    query->heap = tl_allocate_array(allocator, query->max_nodes, sizeof *query->heap);
    query->buckets = tl_allocate_array(allocator, query->bucket_count, sizeof *query->buckets);
    query->wedges = tl_allocate_array(allocator, query->max_nodes, sizeof *query->wedges);
    query->open = tl_allocate_array(allocator, query->max_nodes, sizeof *query->open);
    query->stops = tl_allocate_array(allocator, query->max_nodes, sizeof *query->stops);
    query->roots = tl_allocate_array(allocator, (uint64_t)query->root_mask + 1, sizeof *query->roots);
    query->run = tl_allocate_array(allocator, 1, sizeof *query->run);
    return query->nodes != NULL && query->heap != NULL && query->buckets != NULL && query->wedges != NULL &&
           query->open != NULL && query->stops != NULL && query->roots != NULL && query->run != NULL;
}

tl_result tl_nav_query_create(const tl_nav_query_def *def, tl_nav_query **query_out)
{
    const tl_nav_query_def used = def != NULL ? *def : tl_default_nav_query_def();
    if (query_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *query_out = NULL;
    if (used.cookie != TL_DEF_COOKIE || used.max_nodes < 2 || used.max_nodes > MAX_QUERY_NODES) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_query *query = tl_allocate_array(used.allocator, 1, sizeof *query);
    if (query == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(query, 0, sizeof *query);
    query->allocator = tl_allocator_or_default(used.allocator);
    query->max_nodes = used.max_nodes;
    query->bucket_count = power_of_two_from(used.max_nodes);
    // At most one new root a wedge: the table stays half empty.
    query->root_mask = 2 * query->bucket_count - 1;
    query->item_bytes = query->max_nodes * sizeof *query->wedges;
    if (!allocate_blocks(query)) {
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
    tl_release_array(&allocator, query->buckets, query->bucket_count, sizeof *query->buckets);
    tl_release_array(&allocator, query->wedges, query->max_nodes, sizeof *query->wedges);
    tl_release_array(&allocator, query->open, query->max_nodes, sizeof *query->open);
    tl_release_array(&allocator, query->stops, query->max_nodes, sizeof *query->stops);
    tl_release_array(&allocator, query->roots, (uint64_t)query->root_mask + 1, sizeof *query->roots);
    tl_release_array(&allocator, query->run, 1, sizeof *query->run);
    tl_release_array(&allocator, query, 1, sizeof *query);
}
