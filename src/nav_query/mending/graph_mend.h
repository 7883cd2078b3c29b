// SPDX-License-Identifier: MIT
//
// Bringing a visibility graph up to date with its navmesh (graph_mend.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_MEND_H
#define TALUS_SRC_NAV_QUERY_GRAPH_MEND_H

#include "base/stage.h"
#include "nav_query/prepared/visibility_graph.h"

/// Whether a graph can be mended, and need not be baked afresh.
bool tl_nav_can_mend_graph(const tl_navmesh *navmesh, const tl_nav_visibility_graph *graph);
/// Makes the graph, which may be one of nothing, that of the navmesh's tiles, which have no forks at seams.
/// TL_ERR_MEMORY, TL_ERR_LIMIT, TL_ERR_CANCELLED: it can only be freed.
tl_result tl_nav_mend_graph(const tl_navmesh *navmesh, const tl_host *host, tl_nav_visibility_graph *graph);

#endif
