// SPDX-License-Identifier: MIT
//
// The shortest path on a prepared navmesh (graph_query.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_QUERY_H
#define TALUS_SRC_NAV_QUERY_GRAPH_QUERY_H

#include "nav_query/prepared/visibility_graph.h"

/// Finds the shortest path by the visibility graph. False: out of nodes, or a line touches too much to tell where it
/// leads; then nothing of `path_out` counts, and the search over polygons must find it.
bool tl_nav_find_over_graph(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                            const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out);

#endif
