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
    uint32_t next; ///< of a bucket's list
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

/// Buckets of a search's queue: those that wait lie within the longest edge of one another.
enum { TL_NAV_DIJKSTRA_BUCKETS = 1024 };

/// One search, which can be run again and again.
typedef struct tl_nav_dijkstra {
    tl_result result; ///< of all runs; after a failure nothing is run
    double *length;   ///< by corner vertex: metres; INFINITY: no way
    uint32_t *before; ///< by corner vertex: the one before it on the way there; itself for a source
    // Its queue: a heap of those in the bucket that is open, and lists of those in later ones.
    tl_nav_open_vertex *heap, *later;
    uint64_t heap_capacity, later_capacity;
    uint32_t heap_count, later_count;
    uint32_t first_free; ///< place in `later` to use again; TL_NAV_NO_VERTEX: none
    uint64_t open_bucket;
    uint32_t first[TL_NAV_DIJKSTRA_BUCKETS];           ///< where the list of a bucket begins, if it has its bit
    uint64_t has_items[TL_NAV_DIJKSTRA_BUCKETS / 64u]; ///< a bit a bucket
} tl_nav_dijkstra;

/// The lengths of a graph's edges, and a search for each worker of the host.
typedef struct tl_nav_dijkstra_team {
    const tl_allocator *allocator;
    const tl_nav_visibility_graph *graph;
    tl_stage *stage; ///< whose progress is called within a search where the host has one worker
    uint32_t worker_count;
    uint32_t edge_count;
    uint32_t *first_edge;        ///< [vertex_room + 1], by corner vertex
    tl_nav_dijkstra_edge *edges; ///< [edge_count] of the graph
    double buckets_a_metre;
    tl_nav_dijkstra *searches; ///< [worker_count], each made when its worker needs it
} tl_nav_dijkstra_team;

static inline double tl_nav_visibility_edge_length(const tl_nav_corner_vertex *from, const tl_nav_visibility_edge *edge)
{
    double x = (double)edge->x - (double)from->x;
    double z = (double)edge->z - (double)from->z;
    return sqrt(x * x + z * z);
}

/// TL_ERR_MEMORY: nothing is left to free.
tl_result tl_nav_dijkstra_begin(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_stage *stage,
                                tl_nav_dijkstra_team *team_out);
void tl_nav_dijkstra_end(tl_nav_dijkstra_team *team);

/// Measures from `source_count` corner vertices, from the nearest of them to each, and adds nothing to progress. The
/// search belongs to the worker, until it runs again. NULL: something failed, see tl_nav_dijkstra_result.
const tl_nav_dijkstra *tl_nav_dijkstra_run(tl_nav_dijkstra_team *team, uint32_t worker, const uint32_t *sources,
                                           uint32_t source_count);

/// What has failed so far, while nothing runs: TL_ERR_MEMORY, TL_ERR_CANCELLED; then only tl_nav_dijkstra_end may be
/// called. Or TL_OK.
tl_result tl_nav_dijkstra_result(const tl_nav_dijkstra_team *team);

#endif
