// SPDX-License-Identifier: MIT
//
// A path with clearance is made in three steps: which free pieces of portals it crosses (wide_search.c), how it gets
// from one to the next within each polygon (wide_funnel.c, wide_local_path.c), and how short it becomes when it is
// pulled taut (wide_pull_taut.c).

#ifndef TALUS_SRC_NAV_QUERY_WIDE_SEARCH_H
#define TALUS_SRC_NAV_QUERY_WIDE_SEARCH_H

#include "nav_query/wide/free_pieces.h"
#include "nav_query/wide/polyline.h"

#include <talus/nav_wide.h>

/// Where a path starts or ends.
typedef struct tl_nav_wide_end {
    tl_nav_spot spot;
    uint32_t slot, polygon;
    uint32_t component; ///< of its polygon's pieces; TL_NAV_NO_COMPONENT: it can leave by none
} tl_nav_wide_end;

/// A stretch of a portal, from its right end to its left one.
typedef struct tl_nav_wide_portal {
    float right_x, right_z, left_x, left_z;
} tl_nav_wide_portal;

typedef struct tl_nav_wide_search {
    tl_nav_clearance *clearance;
    tl_nav_wide_end start, goal;
    tl_nav_wide_portal *portals; ///< [max_nodes]: the piece that each node crosses
    bool is_joined;              ///< there is a free way from start to goal within their polygon
    uint32_t last;               ///< node of the goal, when found
} tl_nav_wide_search;

/// Finds the component of free pieces that an end stands in. False: nearer to a wall than the reach, or out of scratch
/// memory (is_full).
bool tl_nav_wide_place_end(tl_nav_wide_search *search, tl_nav_wide_end *end);

/// Finds the pieces of portals that lead to the goal: nodes of the query, from `last` over their parents to the
/// start's. False: there are none, or the query is out of nodes or scratch memory (is_full).
bool tl_nav_wide_run(tl_nav_wide_search *search);

/// Writes the path that was found: pulled straight through its portals, with local paths where a wall is too near.
/// False: out of scratch memory (is_full).
bool tl_nav_wide_funnel(const tl_nav_wide_search *search, tl_nav_polyline *path);

/// Adds the vertices of a free way, the shortest there is, between two that stand in one polygon, `behind` and its
/// next. False: out of scratch memory (is_full).
bool tl_nav_wide_local_path(tl_nav_clearance *clearance, tl_nav_polyline *path, uint32_t behind);

/// Pulls a free path taut. False: out of scratch memory (is_full); the path is free all the same.
bool tl_nav_wide_pull_taut(tl_nav_clearance *clearance, tl_nav_polyline *path);

#endif
