// SPDX-License-Identifier: MIT
//
// The visibility graph of a navmesh: corner vertices, at which shortest paths turn, and edges between those that see
// one another (visibility_graph.c).
//
// Every shortest path is a first leg to a corner vertex, edges, and a last leg; or one leg. The cones of each polygon
// tell which corner vertices the first and last legs may lead to.

#ifndef TALUS_SRC_NAV_QUERY_VISIBILITY_GRAPH_H
#define TALUS_SRC_NAV_QUERY_VISIBILITY_GRAPH_H

#include "nav_query/exact/shortest_search.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/prepared/corner_cones.h"
#include "nav_query/prepared/kept_legs.h"

#include <math.h>
#include <talus/nav_prepare.h>

/// Landmarks of the graph: distances that are kept for each corner vertex (landmarks.c). 16 floats are a cache line.
enum { TL_NAV_LANDMARKS = 16 };

// To which sides a path may turn at a corner vertex.
#define TL_NAV_TURN_LEFT  1u
#define TL_NAV_TURN_RIGHT 2u

typedef struct tl_nav_corner_vertex {
    float x, y, z;
    uint32_t turn;           ///< its number in rings
    uint32_t first_edge;     ///< its edges end where the next corner vertex's begin
    tl_nav_ring_walls walls; ///< on both sides of the free way around it
    tl_nav_ring_place place; ///< in the ring where its fan begins
} tl_nav_corner_vertex;

/// From one corner vertex to another along which a shortest path may come and go.
typedef struct tl_nav_visibility_edge {
    uint32_t to;    ///< corner vertex
    float x, z;     ///< where that is
    uint32_t turns; ///< TL_NAV_TURN_...: of a path that comes along the edge, at its end
} tl_nav_visibility_edge;

struct tl_nav_visibility_graph {
    tl_nav_corner_vertex *vertices; ///< [vertex_count + 1]
    tl_nav_visibility_edge *edges;
    float (*landmarks)[TL_NAV_LANDMARKS]; ///< metres by corner vertex, from each landmark
    uint32_t *slot_first;                 ///< by slot: where its polygons begin in the cones
    uint32_t *slot_salt;                  ///< by slot: that of its tile (tl_nav_slot); 0: it has none
    uint32_t vertex_count, edge_count, polygon_count, slot_count;
    tl_nav_corner_cones cones;
    float *table;          ///< metres by corner vertex and corner vertex, or NULL (corner_distances.c)
    uint16_t *table_next;  ///< by the same pair: the next corner vertex on the path from the second to the first
    tl_nav_kept_legs kept; ///< where there is a table
    double rounding;       ///< metres within which a point is on a line
    float landmark_error;  ///< metres by which a difference of two landmark distances may be wrong
    uint32_t mends;        ///< of its landmark distances since they were measured
    uint32_t looked;       ///< corner vertices that have looked around when it was baked
};

/// The sides to which a path that comes along (x, z) to a corner vertex may turn there: those on which its walls are.
static inline uint32_t tl_nav_turns_at(const tl_nav_corner_vertex *vertex, double x, double z, double rounding)
{
    const tl_nav_ring_walls *walls = &vertex->walls;
    double size = fabs(x) + fabs(z);
    double to_first = x * (double)walls->first_z - z * (double)walls->first_x;
    double to_last = x * (double)walls->last_z - z * (double)walls->last_x;
    double first_slack = 2.0 * rounding * (size + fabs((double)walls->first_x) + fabs((double)walls->first_z));
    double last_slack = 2.0 * rounding * (size + fabs((double)walls->last_x) + fabs((double)walls->last_z));
    bool left = (to_first <= first_slack) & (to_last <= last_slack);
    bool right = (to_first >= -first_slack) & (to_last >= -last_slack);
    return (left ? TL_NAV_TURN_LEFT : 0u) | (right ? TL_NAV_TURN_RIGHT : 0u);
}

/// Bakes the visibility graph of a navmesh without forks at seams. What the navmesh's graph knows that edits since then
/// have not changed is taken over. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_bake_visibility_graph(const tl_navmesh *navmesh, const tl_host *host,
                                       tl_nav_visibility_graph **graph_out);
/// Bytes that the graph takes, without its table.
uint64_t tl_nav_visibility_graph_size(const tl_nav_visibility_graph *graph);
void tl_nav_free_visibility_graph(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// Whether the navmesh has a graph, and it is that of its tiles.
static inline bool tl_nav_has_current_graph(const tl_navmesh *navmesh)
{
    return navmesh->graph != NULL && navmesh->graph_edit == navmesh->edit.number;
}

/// The graph that a search may use, or NULL: it knows of no off-mesh links and no filter.
static inline const tl_nav_visibility_graph *tl_nav_visibility_graph_for(const tl_nav_shortest_search *search)
{
    bool is_prepared = tl_navmesh_is_prepared(search->navmesh);
    return is_prepared && search->filter == NULL ? search->navmesh->graph : NULL;
}

#endif
