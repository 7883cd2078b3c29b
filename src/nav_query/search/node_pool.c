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

void tl_nav_pool_reset(tl_nav_query *query)
{
    for (uint32_t i = 0; i < query->node_count; i++) {
        *tl_nav_bucket_of(query, query->nodes[i].key) = TL_NAV_NO_NODE;
    }
    query->node_count = 0;
    query->heap_count = 0;
    query->at_hand = TL_NAV_NONE_AT_HAND;
    query->pool_generation++;
}
