// SPDX-License-Identifier: MIT
//
// The vertices of a path with clearance, as a linked list in an array.

#ifndef TALUS_SRC_NAV_QUERY_POLYLINE_H
#define TALUS_SRC_NAV_QUERY_POLYLINE_H

#include "nav_query/plane/plan_segment.h"
#include "nav_query/search/node_pool.h"

/// A vertex of a path. Paths are linked lists, so that they may be changed in the middle.
typedef struct tl_nav_polyline_vertex {
    tl_nav_spot spot;
    tl_nav_spot center; ///< the spot is a corner of the cap around it, if is_cap
    bool is_cap;
    bool is_taut;           ///< pulled in vain, and since then it has the same neighbours
    uint32_t slot, polygon; ///< the path continues in it
    uint32_t pass;          ///< the caller's: how many portals it is behind (wide_funnel.c)
    uint32_t before, next;  ///< TL_NAV_NO_NODE at the ends
} tl_nav_polyline_vertex;

/// A path as a list of vertices.
typedef struct tl_nav_polyline {
    tl_nav_polyline_vertex *vertices; ///< [0]: the path's start
    uint32_t count, capacity;
    uint32_t last; ///< the path's end
} tl_nav_polyline;

/// Inserts a vertex behind another (TL_NAV_NO_NODE: the first of all), no corner of a cap; returns its number, or
/// TL_NAV_NO_NODE: the capacity is used up.
uint32_t tl_nav_polyline_insert(tl_nav_polyline *path, uint32_t behind, tl_nav_spot spot, uint32_t slot,
                                uint32_t polygon);

#endif
