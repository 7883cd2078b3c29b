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
#include "nav_query/prepared/corner_names.h"
#include "nav_query/prepared/kept_legs.h"

#include <math.h>
#include <talus/nav_prepare.h>

/// Landmarks of the graph: distances that are kept for each corner vertex (landmarks.c). A multiple of 8.
enum { TL_NAV_LANDMARKS = 40 };

// To which sides a path may turn at a corner vertex.
#define TL_NAV_TURN_LEFT  1u
#define TL_NAV_TURN_RIGHT 2u

/// No corner vertex.
#define TL_NAV_NO_VERTEX UINT32_MAX

/// From one corner vertex to another along which a shortest path may come and go.
typedef struct tl_nav_visibility_edge {
    uint32_t to; ///< corner vertex
    float x, z;  ///< where that is
} tl_nav_visibility_edge;

/// A corner vertex keeps its number as long as its name in rings stays, or another one stands where it stood between
/// the same walls. Then the number is free, and the next new corner vertex takes it.
typedef struct tl_nav_corner_vertex {
    float x, y, z;
    uint32_t turn;           ///< its name in rings; 0: the number is free
    tl_nav_ring_walls walls; ///< on both sides of the free way around it
    tl_nav_ring_place place; ///< in the ring where its fan begins
    uint32_t next;           ///< of those whose fans begin in the same tile, or of free numbers; or TL_NAV_NO_VERTEX
    uint32_t edge_count, reach_count;
    const tl_nav_visibility_edge
        *edges; ///< [edge_count] by rising `to`, and behind them its reach, in its tile's block
} tl_nav_corner_vertex;

/// The first edge of a corner vertex that leads to `to` or to one of a higher number.
static inline uint32_t tl_nav_find_visibility_edge(const tl_nav_corner_vertex *vertex, uint32_t to)
{
    uint32_t begin = 0, end = vertex->edge_count;
    while (begin < end) {
        const uint32_t middle = begin + (end - begin) / 2;
        if (vertex->edges[middle].to < to) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// The slots whose polygons have cones of a corner vertex: reach_count of them, by rising number.
static inline const uint32_t *tl_nav_reach_of(const tl_nav_corner_vertex *vertex)
{
    return vertex->edge_count + vertex->reach_count > 0
               ? (const uint32_t *)(const void *)(vertex->edges + vertex->edge_count)
               : NULL;
}

/// A box in the plan.
typedef struct tl_nav_plan_box {
    float low_x, low_z, high_x, high_z;
} tl_nav_plan_box;

/// An edge of a ring that a graph was made from.
typedef struct tl_nav_known_edge {
    float x, z;      ///< where it starts
    uint32_t to;     ///< tl_nav_ring_edge.to
    uint32_t vertex; ///< the corner vertex there, or TL_NAV_NO_VERTEX
} tl_nav_known_edge;

/// The rings of a tile that a graph was made from (known_rings.c). An edit compares them with those that are there.
typedef struct tl_nav_known_rings {
    uint32_t *first; ///< [polygon_count + 1], by polygon; the block that all arrays stand in, or NULL: there is no tile
    tl_nav_known_edge *edges; ///< those of polygon p at [first[p], first[p + 1])
    tl_nav_ring_seam *seams;  ///< by tl_nav_ring_seam_number
    uint32_t polygon_count, edge_count, seam_count;
} tl_nav_known_rings;

/// What the graph keeps by slot. An edit writes that of the tiles that it is seen from, and of no others.
typedef struct tl_nav_graph_tile {
    uint32_t salt;         ///< that of the slot's tile (tl_nav_slot); 0: it has none
    tl_nav_plan_box box;   ///< around its polygons
    uint32_t first_vertex; ///< of those whose fans begin in it (tl_nav_corner_vertex.next)
    uint32_t *sights;      ///< their edges and reaches
    uint64_t sight_words;  ///< 4 bytes each
    tl_nav_corner_cones cones;
    tl_nav_known_rings rings;
} tl_nav_graph_tile;

struct tl_nav_visibility_graph {
    tl_nav_corner_vertex *vertices;       ///< [vertex_capacity]
    float (*landmarks)[TL_NAV_LANDMARKS]; ///< [vertex_capacity] metres, from each landmark
    tl_nav_graph_tile *tiles;             ///< [slot_count]
    uint32_t vertex_room;                 ///< the numbers of corner vertices are below; some may be free
    uint32_t vertex_capacity;
    uint32_t vertex_count; ///< that are there
    uint32_t free_vertex;  ///< the first free number, or TL_NAV_NO_VERTEX
    uint32_t slot_count;
    uint32_t edge_count;
    uint64_t tile_bytes;   ///< of the tiles' blocks
    float *table;          ///< metres by corner vertex and corner vertex, or NULL (corner_distances.c)
    uint16_t *table_next;  ///< by the same pair: the next corner vertex on the path from the second to the first
    tl_nav_kept_legs kept; ///< where there is a table
    double rounding;       ///< metres within which a point is on a line
    float landmark_error;  ///< metres by which a difference of two landmark distances may be wrong
    uint64_t lowered;      ///< landmark distances since they were measured
    uint32_t last_fan;     ///< the navmesh's, when it was mended last
    uint32_t looked;       ///< corner vertices that have looked around when it was mended last
    // Queries read none of these; older versions of the navmesh leave them to the newest.
    tl_nav_corner_names names;
    uint8_t *marks;   ///< [vertex_capacity] while it is mended: graph_changes.h; else 0
    uint32_t *orders; ///< [vertex_capacity], of those that look while it is mended: the place among them
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

/// A graph of nothing. NULL: out of memory.
tl_nav_visibility_graph *tl_nav_create_visibility_graph(const tl_allocator *allocator);
void tl_nav_free_visibility_graph(const tl_allocator *allocator, tl_nav_visibility_graph *graph);
/// Releases the block; there is no tile then.
void tl_nav_free_known_rings(const tl_allocator *allocator, tl_nav_known_rings *rings);
/// Bytes of the block.
uint64_t tl_nav_known_rings_size(const tl_nav_known_rings *rings);
/// Bytes that the graph takes, without its table.
uint64_t tl_nav_visibility_graph_size(const tl_nav_visibility_graph *graph);

/// Makes room for so many more corner vertices. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_reserve_corner_vertices(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint64_t more);
/// A free number, for which there is room. The caller writes the corner vertex.
uint32_t tl_nav_take_corner_vertex(tl_nav_visibility_graph *graph);
void tl_nav_give_corner_vertex(tl_nav_visibility_graph *graph, uint32_t vertex);
/// Makes room for the slots of the navmesh, and copies what older versions of it read. TL_ERR_MEMORY.
tl_result tl_nav_own_graph_arrays(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph);

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
