// SPDX-License-Identifier: MIT
//
// A path over the visibility graph, written as corners and polygons (graph_path.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_PATH_H
#define TALUS_SRC_NAV_QUERY_GRAPH_PATH_H

#include "nav_query/exact/wedge_sight.h"
#include "nav_query/prepared/visibility_graph.h"
#include "nav_query/search/straight_line.h"

/// All polygons around a corner vertex, from wall to wall, turning left; `fan_out` has room for TL_NAV_MAX_FAN.
uint32_t tl_nav_fan_of(const tl_navmesh *navmesh, const tl_nav_corner_vertex *vertex, tl_nav_ring_place *fan_out);
/// Whether a line that begins in the vertex of a place leads into its polygon, or along an edge of it.
bool tl_nav_line_enters(const tl_nav_line *line, const tl_nav_ring_place *place);

/// Metres within which a vertex is on a line between two places of a search.
static inline double tl_nav_line_rounding(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph)
{
    double start = fmax(fabs((double)search->start.x), fabs((double)search->start.z));
    double goal = fmax(fabs((double)search->goal.x), fabs((double)search->goal.z));
    return fmax(graph->rounding, TL_NAV_ON_LINE * fmax(start, goal));
}

/// Writes the path over corner vertices [0, vertex_count), the last one first: the first of its corners and polygons,
/// their true numbers and lengths. Returns UINT32_MAX, or the number of a leg that is not straight: 0 is from the
/// start.
uint32_t tl_nav_write_graph_path(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                                 const uint64_t *vertices, uint32_t vertex_count, const tl_nav_path_buffers *room,
                                 tl_nav_shortest_path *path_out);

#endif
