// SPDX-License-Identifier: MIT
//
// The two ends of a path over the visibility graph: legs to corner vertices that a path may reach straight.

#ifndef TALUS_SRC_NAV_QUERY_PATH_ENDS_H
#define TALUS_SRC_NAV_QUERY_PATH_ENDS_H

#include "nav_query/exact/shortest_search.h"

/// A straight leg between an end of the path and a corner vertex.
struct tl_nav_corner_leg {
    uint32_t vertex;
    float length; ///< metres in the plane
    float total;  ///< metres: length, and on to the other end of the path at least
};

/// The legs of both ends, as far as the cones tell, each vertex perhaps more than once; in query->legs.
typedef struct tl_nav_ends {
    tl_nav_corner_leg *starts, *goals;
    uint32_t start_count, goal_count;
} tl_nav_ends;

/// The best pair of a start's leg and a goal's leg.
typedef struct tl_nav_meeting {
    float length; ///< metres of the path; INFINITY: there is none
    tl_nav_corner_leg *start, *goal;
} tl_nav_meeting;

typedef struct tl_nav_visibility_graph tl_nav_visibility_graph; // visibility_graph.h

/// The corner vertices whose cones hold the start, and those whose cones hold the goal. False: the query is too small.
bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                      tl_nav_ends *ends_out);

#endif
