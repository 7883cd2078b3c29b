// SPDX-License-Identifier: MIT
//
// Shortest distances over the visibility graph from given vertices to all others (dijkstra.c).

#ifndef TALUS_SRC_NAV_QUERY_DIJKSTRA_H
#define TALUS_SRC_NAV_QUERY_DIJKSTRA_H

#include "base/stage.h"
#include "nav_query/prepared/visibility_graph.h"

typedef struct tl_nav_open_vertex {
    double length;
    uint32_t vertex;
} tl_nav_open_vertex;

typedef struct tl_nav_dijkstra {
    const tl_nav_visibility_graph *graph;
    tl_stage *stage;          ///< NULL: silent
    double *length;           ///< by corner vertex: metres; INFINITY: no way
    uint32_t *before;         ///< by corner vertex: the one before it on the way there; itself for a source
    tl_nav_open_vertex *heap; ///< [edge_count + corner_vertex_count]: an entry each time a length falls
    uint32_t heap_count;
} tl_nav_dijkstra;

static inline double tl_nav_visibility_edge_length(const tl_nav_corner_vertex *from, const tl_nav_visibility_edge *edge)
{
    double x = (double)edge->x - (double)from->x;
    double z = (double)edge->z - (double)from->z;
    return sqrt(x * x + z * z);
}

/// TL_ERR_MEMORY: nothing is left to free.
tl_result tl_nav_dijkstra_init(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_stage *stage,
                               tl_nav_dijkstra *lengths_out);
void tl_nav_dijkstra_free(const tl_allocator *allocator, tl_nav_dijkstra *lengths);

/// Measures from `source_count` corner vertices, from the nearest of them to each. Calls progress and adds nothing to
/// it: TL_ERR_CANCELLED, after which only tl_nav_dijkstra_free may be called.
tl_result tl_nav_dijkstra_run(tl_nav_dijkstra *lengths, const uint32_t *sources, uint32_t source_count);

/// Opens a corner vertex at the length that it has.
void tl_nav_dijkstra_open(tl_nav_dijkstra *lengths, uint32_t vertex);
/// Lowers the lengths of all to what leads over corner vertices that are open. Errors as above.
tl_result tl_nav_dijkstra_spread(tl_nav_dijkstra *lengths);

#endif
