// SPDX-License-Identifier: MIT
//
// Edges: all straight ways between vertices where shortest paths turn, found once, so that a search knows no polygons.
//
// A corner vertex is such a vertex (fans.c), an edge joins two corner vertices that see one another along a line by
// which a shortest path may come and go. Every shortest path is a first leg to a corner vertex, edges, and a last leg;
// or one leg. For each polygon the corner vertices are known that see something of it, among which the ends of the
// first and last legs are found.

#ifndef TALUS_SRC_NAV_QUERY_VISIBILITY_GRAPH_H
#define TALUS_SRC_NAV_QUERY_VISIBILITY_GRAPH_H

#include "nav_query/exact/shortest_search.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/search/straight_line.h"

#include <math.h>
#include <talus/nav_prepare.h>

/// Lengths to so many sets of places are kept for each corner vertex (landmarks.c). 16 floats are a cache line.
enum { TL_NAV_LANDMARKS = 16 };

#define TL_NAV_TURN_LEFT  1u ///< a path that comes along it may turn left at its end
#define TL_NAV_TURN_RIGHT 2u ///< and right

typedef struct tl_nav_corner_vertex {
    float x, y, z;
    uint32_t turn;       ///< its number in rings
    uint32_t first_edge; ///< they end where the next corner vertex's begin
    tl_nav_ring_walls walls;
    tl_nav_ring_place place; ///< in the ring where its fan begins
} tl_nav_corner_vertex;

enum { TL_NAV_CONES_AT_ONCE = 8 };

/// From where in a polygon a path may go straight to a corner vertex and turn there (corner_cones.c). Point (x, z) is
/// in cone i when left_x * z - left_z * x >= left_least, and the same on the right. Behind the last cone there is room
/// to read on.
typedef struct tl_nav_corner_cones {
    uint32_t *first; ///< [polygon_count + 1]
    float *left_x, *left_z, *left_least;
    float *right_x, *right_z, *right_least;
    uint32_t *vertex;
    uint32_t count;
    uint64_t size; ///< of the block, in floats
    float *block;  ///< that all arrays but the first stand in
} tl_nav_corner_cones;

/// A straight way between a place and a corner vertex.
struct tl_nav_corner_leg {
    uint32_t vertex;
    float length; ///< metres in the plane
    float total;  ///< and straight on to the other end of the path
};

typedef struct tl_nav_visibility_edge {
    uint32_t to;   ///< corner vertex
    float x, z;    ///< where that is
    uint32_t hand; ///< TL_NAV_TURN_...
} tl_nav_visibility_edge;

/// The rank of a hub and the first edge of a shortest way there, counted from its corner vertex's first, in one number.
enum { TL_NAV_HUB_EDGE_BITS = 12 };

typedef struct tl_nav_hub {
    uint32_t rank_and_edge;
    float length; ///< metres
} tl_nav_hub;

static inline uint32_t tl_nav_hub_rank(const tl_nav_hub *hub)
{
    return hub->rank_and_edge >> TL_NAV_HUB_EDGE_BITS;
}

static inline uint32_t tl_nav_hub_edge(const tl_nav_hub *hub)
{
    return hub->rank_and_edge & ((1u << TL_NAV_HUB_EDGE_BITS) - 1);
}

/// The hubs of all corner vertices (hub_labels.c).
typedef struct tl_nav_hub_labels {
    uint64_t *first;  ///< [vertex_count + 1]; NULL: there are none
    tl_nav_hub *hubs; ///< by corner vertex, ascending by rank
    uint64_t count;
    uint32_t *vertex; ///< by rank
} tl_nav_hub_labels;

struct tl_nav_visibility_graph {
    tl_nav_corner_vertex *vertices; ///< [vertex_count + 1]
    tl_nav_visibility_edge *edges;
    float (*landmarks)[TL_NAV_LANDMARKS]; ///< by corner vertex
    uint32_t *slot_first;                 ///< by slot: where its polygons begin in the cones
    uint32_t vertex_count, edge_count, polygon_count, slot_count;
    tl_nav_corner_cones cones;
    float *table;        ///< metres by corner vertex and corner vertex, or NULL (corner_distances.c)
    uint16_t *table_way; ///< the same: the next corner vertex on the way from the second to the first
    tl_nav_hub_labels labels;
    uint64_t edit;        ///< of the navmesh for which they hold
    double rounding;      ///< metres within which a point is on a line
    float landmark_error; ///< metres by which a difference of two landmark lengths may be wrong
};

/// The hands to which a path that comes along (x, z) to a corner vertex may turn there: those on which its walls are.
static inline uint32_t tl_nav_hands_at(const tl_nav_corner_vertex *vertex, double x, double z, double rounding)
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

/// All polygons around a corner vertex, from wall to wall, turning left; `fan_out` has room for TL_NAV_MAX_FAN.
uint32_t tl_nav_fan_of(const tl_navmesh *navmesh, const tl_nav_corner_vertex *vertex, tl_nav_ring_place *fan_out);
/// Whether a line that begins in the vertex of a place leads into its polygon, or along an edge of it.
bool tl_nav_line_enters(const tl_nav_line *line, const tl_nav_ring_place *place);

/// Fills in the landmark lengths. TL_ERR_MEMORY.
tl_result tl_nav_find_landmarks(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// Finds the edges of a navmesh whose floors do not fork. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_bake_visibility_graph(tl_navmesh *navmesh, tl_nav_visibility_graph **graph_out);
/// Bytes that edges take, but for a table.
uint64_t tl_nav_visibility_graph_size(const tl_nav_visibility_graph *graph);
void tl_nav_free_visibility_graph(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// Whether the navmesh has edges, and they are those of its tiles.
static inline bool tl_nav_has_current_graph(const tl_navmesh *navmesh)
{
    return navmesh->graph != NULL && navmesh->graph->edit == navmesh->edit.number;
}

/// Edges that may be used for a search, or NULL. They know of no off-mesh links.
static inline const tl_nav_visibility_graph *tl_nav_visibility_graph_for(const tl_nav_shortest_search *search)
{
    bool is_prepared = tl_navmesh_is_prepared(search->navmesh);
    return is_prepared && search->filter == NULL ? search->navmesh->graph : NULL;
}

/// A cone as it was found: the cone between two directions from a corner vertex.
typedef struct tl_nav_corner_cone {
    uint32_t slot, polygon;
    uint32_t vertex;
    int hand; ///< of the turn: 1 left, -1 right
    float right_x, right_z, left_x, left_z;
} tl_nav_corner_cone;

typedef struct tl_nav_cone_list {
    const tl_allocator *allocator;
    tl_nav_corner_cone *cones;
    uint64_t count, capacity;
} tl_nav_cone_list;

/// Adds the cones that a wedge of sight from a corner vertex makes. TL_ERR_MEMORY.
tl_result tl_nav_add_cones(tl_nav_cone_list *list, const tl_nav_visibility_graph *graph, uint32_t vertex,
                           const tl_nav_wedge *wedge);
/// Makes the cones of edges. TL_ERR_MEMORY, TL_ERR_LIMIT; what was made is freed by tl_nav_free_cones.
tl_result tl_nav_group_cones(tl_nav_cone_list *list, const tl_navmesh *navmesh, tl_nav_visibility_graph *graph);
void tl_nav_free_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// The corner vertices to which a path may go straight from its two ends, as far as cones tell, each perhaps more than
/// once; in the query's memory for wedges.
typedef struct tl_nav_ends {
    tl_nav_corner_leg *starts, *goals;
    uint32_t start_count, goal_count;
} tl_nav_ends;

/// False: there is no room for them.
bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                      tl_nav_ends *ends_out);

/// What the landmark lengths of an end of a path would be, at most and at least as the corner vertices tell to which it
/// has a leg.
typedef struct tl_nav_landmark_bounds {
    float least[TL_NAV_LANDMARKS], most[TL_NAV_LANDMARKS];
} tl_nav_landmark_bounds;

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out);
/// Metres from a corner vertex to that end, at least.
float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex);

/// What a table of all corner vertices takes. Bytes.
uint64_t tl_nav_corner_distances_size(const tl_nav_visibility_graph *graph);
/// Fills in the table. TL_ERR_MEMORY.
tl_result tl_nav_bake_corner_distances(const tl_allocator *allocator, tl_nav_visibility_graph *graph);
void tl_nav_free_corner_distances(const tl_allocator *allocator, tl_nav_visibility_graph *graph);
/// Fills in the labels. TL_ERR_LIMIT: they take more bytes than that, or corner vertices have too many edges;
/// TL_ERR_MEMORY.
tl_result tl_nav_bake_hub_labels(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint64_t budget);
/// Bytes that they take.
uint64_t tl_nav_hub_labels_size(const tl_nav_visibility_graph *graph);
void tl_nav_free_hub_labels(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// The shortest way from a start to a goal, and the hub that it passes.
typedef struct tl_nav_meeting {
    float length; ///< metres; INFINITY: there is none
    tl_nav_corner_leg *start, *goal;
    uint32_t hub;
} tl_nav_meeting;

/// By the table; `hub` says nothing. Reorders the goals.
tl_nav_meeting tl_nav_best_by_table(const tl_nav_visibility_graph *graph, tl_nav_ends *ends);
/// By labels; raises totals by landmarks. `to_hub` is scratch for as many as there are corner vertices.
tl_nav_meeting tl_nav_best_by_labels(const tl_nav_visibility_graph *graph, tl_nav_ends *ends, float *to_hub);
/// The corner vertices on that way, the last one first; returns their number, UINT32_MAX: there is no room for them.
uint32_t tl_nav_unpack_meeting(const tl_nav_visibility_graph *graph, const tl_nav_meeting *meeting, uint64_t *vertices,
                               uint32_t capacity);

/// Metres within which a vertex is on a line between two places of a search.
static inline double tl_nav_line_rounding(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph)
{
    double start = fmax(fabs((double)search->start.x), fabs((double)search->start.z));
    double goal = fmax(fabs((double)search->goal.x), fabs((double)search->goal.z));
    return fmax(graph->rounding, TL_NAV_ON_LINE * fmax(start, goal));
}

/// The shortest path of a search that has edges. False: out of nodes, or a line that touches too much to tell where it
/// goes; the search over polygons will do it. Then nothing of `path_out` counts.
bool tl_nav_find_over_graph(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                            const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out);

/// Writes the path that goes over corner vertices [0, vertex_count), of which the query's heap holds the last
/// one first: the first of its corners and polygons, their true numbers and lengths. Returns UINT32_MAX, or which leg
/// cannot be gone straight: 0 is from the start.
uint32_t tl_nav_write_graph_path(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                                 const uint64_t *vertices, uint32_t vertex_count, const tl_nav_path_buffers *room,
                                 tl_nav_shortest_path *path_out);

#endif
