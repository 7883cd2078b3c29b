// SPDX-License-Identifier: MIT
//
// One thread's search over the cells of a world: what both ends know of each cell above them.

#ifndef TALUS_SRC_NAV_WORLD_ROUTER_H
#define TALUS_SRC_NAV_WORLD_ROUTER_H

#include "nav_world/routes.h"

/// The cells from the place of an end up to the root. Of each, lengths from the end within the cell: to the gates of
/// its separator, then to those of its rim.
typedef struct tl_route_chain {
    uint32_t cells[TL_ROUTE_MAX_DEPTH];
    uint32_t offsets[TL_ROUTE_MAX_DEPTH]; ///< of a cell's lengths in `upper` and `lower`
    uint32_t count;                       ///< 0: the place has no gates
    float *upper, *lower;                 ///< [longest_chain]; `lower` from the block up
} tl_route_chain;

/// Where the shortest way over gates crosses a separator.
typedef struct tl_route_meeting {
    uint32_t levels[2]; ///< in the chain of the start, the cell; in that of the goal, the child that the goal is in
    uint32_t gate;      ///< of the separator
    float length;       ///< INFINITY: there is none
} tl_route_meeting;

/// A way to be taken apart: between two gates of a cell, of which one is in its separator.
typedef struct tl_route_piece {
    uint32_t cell, from, to;
} tl_route_piece;

struct tl_nav_router {
    tl_allocator allocator;
    const tl_nav_world *world;
    tl_nav_query *query;
    tl_route_chain ends[2];
};

/// Takes a route apart into points (route_trace.c). Points behind the capacity are counted only.
typedef struct tl_route_writer {
    const tl_nav_world *world;
    tl_nav_world_route_point *points;
    uint32_t capacity, count;
    int32_t place[2]; ///< that the route is in
    double length;
} tl_route_writer;

void tl_route_write_point(tl_route_writer *writer, const double point[3], double length);
void tl_route_write_gate(tl_route_writer *writer, const tl_nav_gate *gate, double length);
/// Writes the gates from the start's first to the goal's last.
void tl_route_trace(const tl_nav_router *router, const tl_route_meeting *meeting, tl_route_writer *writer);

/// Lengths from an end, to the gates of the rim of a cell of its chain.
static inline const float *tl_route_rim_lengths(const tl_route_tree *tree, const tl_route_chain *chain, uint32_t level)
{
    return chain->upper + chain->offsets[level] + tree->cells[chain->cells[level]].gate_count;
}

#endif
