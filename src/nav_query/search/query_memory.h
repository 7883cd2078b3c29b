// SPDX-License-Identifier: MIT
//
// A query's memory (query_memory.c).

#ifndef TALUS_SRC_NAV_QUERY_QUERY_MEMORY_H
#define TALUS_SRC_NAV_QUERY_QUERY_MEMORY_H

#include "nav_query/search/query.h"

/// So that indices and the two marks of heap_at never meet, and buckets fit 32 bits.
#define TL_NAV_MAX_QUERY_NODES 0x40000000u

/// A query with its blocks for max_nodes, which is all that it gets; in [2, TL_NAV_MAX_QUERY_NODES]. NULL allocator:
/// malloc. TL_ERR_MEMORY.
tl_result tl_nav_query_allocate(uint32_t max_nodes, tl_nav_query_sizes sizes, const tl_allocator *allocator,
                                tl_nav_query **query_out);

/// Makes room for at least that many nodes, at most node_limit. What the query held is forgotten, but for its run.
/// TL_ERR_MEMORY: it is as before.
tl_result tl_nav_query_make_room(tl_nav_query *query, uint32_t nodes);

/// Doubles the memory of a query whose search was out of nodes. False: it has all that it may have, or there is no more
/// memory; else the search begins anew.
bool tl_nav_query_grow(tl_nav_query *query);

/// NULL: nothing happens.
void tl_nav_query_release(tl_nav_query *query);

#endif
