// SPDX-License-Identifier: MIT
//
// Shortest distances over the visibility graph from given vertices to all others (dijkstra.c).

#ifndef TALUS_SRC_NAV_QUERY_DIJKSTRA_H
#define TALUS_SRC_NAV_QUERY_DIJKSTRA_H

#include "base/stage.h"
#include "nav_query/prepared/visibility_graph.h"

/// A corner vertex that waits for its turn, by its distance; ties go to the lower vertex.
typedef struct tl_nav_open_vertex {
    double length;
    uint32_t vertex;
} tl_nav_open_vertex;

static inline bool tl_nav_opens_before(tl_nav_open_vertex a, tl_nav_open_vertex b)
{
    return a.length < b.length || (a.length == b.length && a.vertex < b.vertex);
}

#define TL_HEAP(name)                 tl_nav_open_vertex_##name
#define TL_HEAP_ITEM                  tl_nav_open_vertex
#define TL_HEAP_BEFORE(context, a, b) tl_nav_opens_before(a, b)
#include "base/heap.inl"

/// An edge, with its length.
typedef struct tl_nav_dijkstra_edge {
    double length;
    uint32_t to;
    uint32_t padding; ///< 0
} tl_nav_dijkstra_edge;

typedef struct tl_nav_dijkstra {
    const tl_nav_visibility_graph *graph;
    uint32_t edge_count;
    tl_stage *stage;             ///< NULL: silent
    uint32_t *first_edge;        ///< [vertex_room + 1], by corner vertex
    tl_nav_dijkstra_edge *edges; ///< [edge_count] of the graph, measured once
    double *length;              ///< by corner vertex: metres; INFINITY: no way
    uint32_t *before;            ///< by corner vertex: the one before it on the way there; itself for a source
    tl_nav_open_vertex *heap;    ///< [edge_count + vertex_room]: an entry each time a length falls
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

#endif
