// SPDX-License-Identifier: MIT
//
// A query's memory (query_memory.c).

#ifndef TALUS_SRC_NAV_QUERY_QUERY_MEMORY_H
#define TALUS_SRC_NAV_QUERY_QUERY_MEMORY_H

#include "nav_query/search/query.h"

/// So that indices and the two marks of heap_at never meet, and buckets fit 32 bits.
#define TL_NAV_MAX_QUERY_NODES 0x40000000u

/// A query with its blocks; max_nodes in [2, TL_NAV_MAX_QUERY_NODES]. NULL allocator: malloc. TL_ERR_MEMORY.
tl_result tl_nav_query_allocate(uint32_t max_nodes, tl_nav_query_sizes sizes, const tl_allocator *allocator,
                                tl_nav_query **query_out);

/// NULL: nothing happens.
void tl_nav_query_release(tl_nav_query *query);

#endif
