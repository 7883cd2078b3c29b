// SPDX-License-Identifier: MIT
//
// Polygons around a start in the order of what it costs to enter them, in a query's node pool.

#ifndef TALUS_SRC_NAV_QUERY_FLOOD_H
#define TALUS_SRC_NAV_QUERY_FLOOD_H

#include "nav_query/navmesh/navmesh.h"
#include "nav_query/plane/zone.h"
#include "nav_query/search/node_pool.h"

typedef struct tl_nav_flood {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    bool in_metres; ///< costs are metres, whatever the filter says
    float max_cost;
    const tl_nav_zone_test *zone; ///< NULL: everywhere
    bool out_of_nodes;
    bool all_pass; ///< the filter refuses nothing
} tl_nav_flood;

/// The end of an off-mesh link by which the way into a node was begun, or TL_NAV_NO_END.
static inline uint64_t *tl_nav_flood_end(tl_nav_query *query, uint32_t node)
{
    return &query->link_ends[node];
}

/// Floods from a point of a polygon. Afterwards the query's nodes [0, node_count) are the polygons, the start's first;
/// their keys are references. False: the reference is stale.
bool tl_nav_flood_run(tl_nav_flood *flood, const tl_nav_location *start);

#endif
