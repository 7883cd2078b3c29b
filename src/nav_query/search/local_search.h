// SPDX-License-Identifier: MIT
//
// A search around a place: the polygons that it met, and from which, in the query's memory. Nothing to clear.

#ifndef TALUS_SRC_NAV_QUERY_LOCAL_SEARCH_H
#define TALUS_SRC_NAV_QUERY_LOCAL_SEARCH_H

#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/search/root_table.h"

/// A polygon that was met.
struct tl_nav_local_node {
    double cost; ///< for searches that have one
    uint32_t slot, polygon;
    uint32_t parent; ///< node, or TL_NAV_NO_NODE
};

/// Forgets what the query knew.
static inline void tl_nav_local_begin(tl_nav_query *query)
{
    query->wedge_count = 0;
    query->open_count = 0;
    tl_nav_next_generation(query);
}

/// A polygon's number in the table of roots.
static inline uint64_t tl_nav_polygon_number(uint32_t slot, uint32_t polygon)
{
    return (uint64_t)1 << 63 | (uint64_t)slot << 32 | polygon;
}

/// A node for a polygon that was not met before; TL_NAV_NO_NODE when it was, or when the pool is used up: then
/// `*full_out` is set.
static inline uint32_t tl_nav_local_add(tl_nav_query *query, uint32_t slot, uint32_t polygon, uint32_t parent,
                                        bool *full_out)
{
    bool found = false;
    const uint64_t number = tl_nav_polygon_number(slot, polygon);
    if (query->wedge_count == query->max_nodes) {
        tl_nav_probe_roots(query, number, &found);
        *full_out = *full_out || !found;
        return TL_NAV_NO_NODE;
    }
    // There are no more polygons in the table than nodes: it is never full.
    tl_nav_find_root(query, number, &found);
    if (found) {
        return TL_NAV_NO_NODE;
    }
    uint32_t index = query->wedge_count++;
    tl_nav_local_node *node = &query->local_nodes[index];
    node->slot = slot;
    node->polygon = polygon;
    node->parent = parent;
    return index;
}

#endif
