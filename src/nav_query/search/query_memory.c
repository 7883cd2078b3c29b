// SPDX-License-Identifier: MIT
//
// A query's memory: one block for each kind of item that searches keep.

#include "nav_query/search/query_memory.h"

#include "base/arena.h"
#include "base/radix_sort.h"
#include "nav_query/search/local_search.h"
#include "nav_query/search/node_pool.h"
#include "nav_query/search/wedge.h"

#include <string.h>

_Static_assert(sizeof(tl_nav_wedge) >= sizeof(tl_nav_local_node), "a wedge has room for a local node");
_Static_assert(sizeof(tl_nav_wedge) >= 2 * sizeof(tl_sort_item), "wedges have room for items and their scratch");

static uint32_t power_of_two_from(uint32_t value)
{
    uint32_t power = 1;
    while (power < value) {
        power *= 2;
    }
    return power;
}

// A block of no items stays NULL.
static bool allocate_block(const tl_nav_query *query, uint64_t count, size_t size, void **block_out)
{
    *block_out = size > 0 ? tl_allocate_array(&query->allocator, count, size) : NULL;
    return size == 0 || *block_out != NULL;
}

// All blocks but the run; false: some are missing.
static bool allocate_blocks(tl_nav_query *query)
{
    const tl_allocator *allocator = &query->allocator;
    query->bucket_count = power_of_two_from(query->max_nodes);
    // At most one new root a wedge: the table stays half empty.
    query->root_mask = 2 * query->bucket_count - 1;
    query->item_bytes = query->max_nodes * sizeof *query->wedges;
    query->nodes = tl_allocate_array(allocator, query->max_nodes, sizeof *query->nodes);
    query->heap = tl_allocate_array(allocator, query->max_nodes, sizeof *query->heap);
    query->buckets = tl_allocate_array(allocator, query->bucket_count, sizeof *query->buckets);
    query->wedges = tl_allocate_array(allocator, query->max_nodes, sizeof *query->wedges);
    query->open = tl_allocate_array(allocator, query->max_nodes, sizeof *query->open);
    query->roots = tl_allocate_array(allocator, (uint64_t)query->root_mask + 1, sizeof *query->roots);
    void *stops;
    const bool have_stops = allocate_block(query, query->max_nodes, query->sizes.stop, &stops);
    query->stops = stops;
    return query->nodes != NULL && query->heap != NULL && query->buckets != NULL && query->wedges != NULL &&
           query->open != NULL && query->roots != NULL && have_stops;
}

static void release_blocks(const tl_nav_query *query)
{
    const tl_allocator *allocator = &query->allocator;
    tl_release_array(allocator, query->nodes, query->max_nodes, sizeof *query->nodes);
    tl_release_array(allocator, query->heap, query->max_nodes, sizeof *query->heap);
    tl_release_array(allocator, query->buckets, query->bucket_count, sizeof *query->buckets);
    tl_release_array(allocator, query->wedges, query->max_nodes, sizeof *query->wedges);
    tl_release_array(allocator, query->open, query->max_nodes, sizeof *query->open);
    tl_release_array(allocator, query->stops, query->max_nodes, query->sizes.stop);
    tl_release_array(allocator, query->roots, (uint64_t)query->root_mask + 1, sizeof *query->roots);
}

static void clear_tables(tl_nav_query *query)
{
    memset(query->buckets, 0xff, (size_t)query->bucket_count * sizeof *query->buckets);
    memset(query->roots, 0, ((size_t)query->root_mask + 1) * sizeof *query->roots);
}

tl_result tl_nav_query_allocate(uint32_t max_nodes, tl_nav_query_sizes sizes, const tl_allocator *allocator,
                                tl_nav_query **query_out)
{
    *query_out = NULL;
    tl_nav_query *query = tl_allocate_array(allocator, 1, sizeof *query);
    if (query == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(query, 0, sizeof *query);
    query->allocator = tl_allocator_or_default(allocator);
    query->sizes = sizes;
    query->max_nodes = max_nodes;
    query->node_limit = max_nodes;
    void *run;
    const bool have_run = allocate_block(query, 1, sizes.run, &run);
    query->run = run;
    if (!allocate_blocks(query) || !have_run) {
        tl_nav_query_release(query);
        return TL_ERR_MEMORY;
    }
    if (query->run != NULL) {
        memset(query->run, 0, sizes.run);
    }
    clear_tables(query);
    *query_out = query;
    return TL_OK;
}

tl_result tl_nav_query_make_room(tl_nav_query *query, uint32_t nodes)
{
    const uint32_t wanted = nodes < query->node_limit ? nodes : query->node_limit;
    if (wanted <= query->max_nodes) {
        return TL_OK;
    }
    tl_nav_query grown = *query;
    grown.max_nodes = wanted;
    if (!allocate_blocks(&grown)) {
        release_blocks(&grown);
        return TL_ERR_MEMORY;
    }
    release_blocks(query);
    // Generations go on: a run in slices that was under way knows by them that its nodes are gone.
    grown.pool_generation++;
    grown.generation = grown.generation == UINT32_MAX ? 1 : grown.generation + 1;
    grown.node_count = grown.heap_count = 0;
    grown.wedge_count = grown.open_count = grown.stop_count = 0;
    grown.root_count = grown.repeat_count = 0;
    *query = grown;
    clear_tables(query);
    return TL_OK;
}

bool tl_nav_query_grow(tl_nav_query *query)
{
    return query->max_nodes < query->node_limit && tl_nav_query_make_room(query, 2 * query->max_nodes) == TL_OK;
}

void tl_nav_query_release(tl_nav_query *query)
{
    if (query == NULL) {
        return;
    }
    tl_allocator allocator = query->allocator;
    release_blocks(query);
    tl_release_array(&allocator, query->run, 1, query->sizes.run);
    tl_release_array(&allocator, query, 1, sizeof *query);
}
