// SPDX-License-Identifier: MIT
//
// A* over the visibility graph (graph_search.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_SEARCH_H
#define TALUS_SRC_NAV_QUERY_GRAPH_SEARCH_H

#include "nav_query/prepared/path_ends.h"
#include "nav_query/prepared/visibility_graph.h"

/// A node: a corner vertex that the search has reached.
struct tl_nav_stop {
    double cost;    ///< metres from the start
    double to_goal; ///< metres straight to the goal, where that may be seen; < 0: it is not
    float total;    ///< cost and estimate
    float estimate; ///< metres to the goal, at least; < 0: not asked for yet
    uint32_t vertex;
    uint32_t parent; ///< stop; TL_NAV_NO_NODE: the start
    bool is_start;   ///< not the corner vertex's own: whether the start sees it is not known yet
    bool has_asked_landmarks;
};

/// Finds the path of a start and a goal that do not see one another. False: out of nodes, or a line touches too much to
/// tell where it leads.
bool tl_nav_search_graph(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph, const tl_nav_ends *ends,
                         const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out);

#endif
