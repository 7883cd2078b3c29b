// SPDX-License-Identifier: MIT
//
// Roads: all straight ways between vertices where shortest paths turn, found once, so that a search knows no polygons.
//
// A bend is such a vertex (fans.c), a road joins two bends that see one another along a line by which a shortest path
// may come and go. Every shortest path is a first leg to a bend, roads, and a last leg; or one leg. For each polygon
// the bends are known that see something of it, among which the ends of the first and last legs are found.

#ifndef TALUS_SRC_NAV_QUERY_ROADS_H
#define TALUS_SRC_NAV_QUERY_ROADS_H

#include "nav_query/exact/shortest_search.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/search/straight_line.h"

#include <math.h>
#include <talus/nav_prepare.h>

/// Lengths to so many sets of places are kept for each bend (landmarks.c). 16 floats are a cache line.
enum { TL_NAV_LANDMARKS = 16 };

#define TL_NAV_ROAD_LEFT  1u ///< a path that comes along it may turn left at its end
#define TL_NAV_ROAD_RIGHT 2u ///< and right

typedef struct tl_nav_bend {
    float x, y, z;
    uint32_t turn;       ///< its number in rings
    uint32_t first_road; ///< they end where the next bend's begin
    tl_nav_ring_walls walls;
    tl_nav_ring_place place; ///< in the ring where its fan begins
} tl_nav_bend;

enum { TL_NAV_VIEWS_AT_ONCE = 8 };

/// From where in a polygon a path may go straight to a bend and turn there (bend_views.c). Point (x, z) is in view i
/// when left_x * z - left_z * x >= left_least, and the same on the right. Behind the last view there is room to read
/// on.
typedef struct tl_nav_views {
    uint32_t *first; ///< [polygon_count + 1]
    float *left_x, *left_z, *left_least;
    float *right_x, *right_z, *right_least;
    uint32_t *bend;
    uint32_t count;
    uint64_t size; ///< of the block, in floats
    float *block;  ///< that all arrays but the first stand in
} tl_nav_views;

/// A straight way between a place and a bend.
typedef struct tl_nav_bend_leg {
    uint32_t bend;
    float length; ///< metres in the plane
    float total;  ///< and straight on to the other end of the path
} tl_nav_bend_leg;

typedef struct tl_nav_road {
    uint32_t to;   ///< bend
    float x, z;    ///< where that is
    uint32_t hand; ///< TL_NAV_ROAD_...
} tl_nav_road;

/// The rank of a hub and the first road of a shortest way there, counted from its bend's first, in one number.
enum { TL_NAV_HUB_ROAD_BITS = 12 };

typedef struct tl_nav_hub {
    uint32_t rank_and_road;
    float length; ///< metres
} tl_nav_hub;

static inline uint32_t tl_nav_hub_rank(const tl_nav_hub *hub)
{
    return hub->rank_and_road >> TL_NAV_HUB_ROAD_BITS;
}

static inline uint32_t tl_nav_hub_road(const tl_nav_hub *hub)
{
    return hub->rank_and_road & ((1u << TL_NAV_HUB_ROAD_BITS) - 1);
}

/// The hubs of all bends (hub_labels.c).
typedef struct tl_nav_hub_labels {
    uint64_t *first;  ///< [bend_count + 1]; NULL: there are none
    tl_nav_hub *hubs; ///< by bend, ascending by rank
    uint64_t count;
    uint32_t *bend; ///< by rank
} tl_nav_hub_labels;

struct tl_nav_roads {
    tl_nav_bend *bends; ///< [bend_count + 1]
    tl_nav_road *roads;
    float (*marks)[TL_NAV_LANDMARKS]; ///< by bend
    uint32_t *slot_first;             ///< by slot: where its polygons begin in the views
    uint32_t bend_count, road_count, polygon_count, slot_count;
    tl_nav_views views;
    float *table;        ///< metres by bend and bend, or NULL (bend_table.c)
    uint16_t *table_way; ///< the same: the next bend on the way from the second to the first
    tl_nav_hub_labels labels;
    uint64_t edit;    ///< of the navmesh for which they hold
    double rounding;  ///< metres within which a point is on a line
    float mark_error; ///< metres by which a difference of two marks may be wrong
};

/// The hands to which a path that comes along (x, z) to a bend may turn there: those on which its walls are.
static inline uint32_t tl_nav_hands_at(const tl_nav_bend *bend, double x, double z, double rounding)
{
    const tl_nav_ring_walls *walls = &bend->walls;
    double size = fabs(x) + fabs(z);
    double to_first = x * (double)walls->first_z - z * (double)walls->first_x;
    double to_last = x * (double)walls->last_z - z * (double)walls->last_x;
    double first_slack = 2.0 * rounding * (size + fabs((double)walls->first_x) + fabs((double)walls->first_z));
    double last_slack = 2.0 * rounding * (size + fabs((double)walls->last_x) + fabs((double)walls->last_z));
    bool left = (to_first <= first_slack) & (to_last <= last_slack);
    bool right = (to_first >= -first_slack) & (to_last >= -last_slack);
    return (left ? TL_NAV_ROAD_LEFT : 0u) | (right ? TL_NAV_ROAD_RIGHT : 0u);
}

/// All polygons around a bend, from wall to wall, turning left; `fan_out` has room for TL_NAV_MAX_FAN.
uint32_t tl_nav_fan_of(const tl_navmesh *navmesh, const tl_nav_bend *bend, tl_nav_ring_place *fan_out);
/// Whether a line that begins in the vertex of a place leads into its polygon, or along an edge of it.
bool tl_nav_line_enters(const tl_nav_line *line, const tl_nav_ring_place *place);

/// Fills in the marks. TL_ERR_MEMORY.
tl_result tl_nav_mark_roads(const tl_allocator *allocator, tl_nav_roads *roads);

/// Finds the roads of a navmesh whose floors do not fork. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_make_roads(tl_navmesh *navmesh, tl_nav_roads **roads_out);
/// Bytes that roads take, but for a table.
uint64_t tl_nav_roads_size(const tl_nav_roads *roads);
void tl_nav_free_roads(const tl_allocator *allocator, tl_nav_roads *roads);

/// Whether the navmesh has roads, and they are those of its tiles.
static inline bool tl_nav_roads_hold(const tl_navmesh *navmesh)
{
    return navmesh->roads != NULL && navmesh->roads->edit == navmesh->edit.number;
}

/// Roads that may be used for a search, or NULL. They know of no off-mesh links.
static inline const tl_nav_roads *tl_nav_roads_for(const tl_nav_shortest_search *search)
{
    bool is_prepared = tl_navmesh_is_prepared(search->navmesh);
    return is_prepared && search->filter == NULL ? search->navmesh->roads : NULL;
}

/// A view as it was found: the cone between two directions from a bend.
typedef struct tl_nav_view {
    uint32_t slot, polygon;
    uint32_t bend;
    int hand; ///< of the turn: 1 left, -1 right
    float right_x, right_z, left_x, left_z;
} tl_nav_view;

typedef struct tl_nav_view_list {
    const tl_allocator *allocator;
    tl_nav_view *views;
    uint64_t count, capacity;
} tl_nav_view_list;

/// Adds the views that a wedge of sight from a bend makes. TL_ERR_MEMORY.
tl_result tl_nav_note_views(tl_nav_view_list *list, const tl_nav_roads *roads, uint32_t bend,
                            const tl_nav_wedge *wedge);
/// Makes the views of roads. TL_ERR_MEMORY, TL_ERR_LIMIT; what was made is freed by tl_nav_free_views.
tl_result tl_nav_group_views(tl_nav_view_list *list, const tl_navmesh *navmesh, tl_nav_roads *roads);
void tl_nav_free_views(const tl_allocator *allocator, tl_nav_roads *roads);

/// The bends to which a path may go straight from its two ends, as far as views tell, each perhaps more than once; in
/// the query's memory for wedges.
typedef struct tl_nav_ends {
    tl_nav_bend_leg *starts, *goals;
    uint32_t start_count, goal_count;
} tl_nav_ends;

/// False: there is no room for them.
bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_roads *roads, tl_nav_ends *ends_out);

/// What the marks of an end of a path would be, at most and at least as the bends tell to which it has a leg.
typedef struct tl_nav_end_marks {
    float least[TL_NAV_LANDMARKS], most[TL_NAV_LANDMARKS];
} tl_nav_end_marks;

void tl_nav_mark_end(const tl_nav_roads *roads, const tl_nav_bend_leg *legs, uint32_t count,
                     tl_nav_end_marks *marks_out);
/// Metres from a bend to that end, at least.
float tl_nav_least_by_marks(const tl_nav_roads *roads, const tl_nav_end_marks *end, uint32_t bend);

/// What a table of all bends takes. Bytes.
uint64_t tl_nav_bend_table_size(const tl_nav_roads *roads);
/// Fills in the table. TL_ERR_MEMORY.
tl_result tl_nav_make_bend_table(const tl_allocator *allocator, tl_nav_roads *roads);
void tl_nav_free_bend_table(const tl_allocator *allocator, tl_nav_roads *roads);
/// Fills in the labels. TL_ERR_LIMIT: they take more bytes than that, or bends have too many roads; TL_ERR_MEMORY.
tl_result tl_nav_make_hub_labels(const tl_allocator *allocator, tl_nav_roads *roads, uint64_t budget);
/// Bytes that they take.
uint64_t tl_nav_hub_labels_size(const tl_nav_roads *roads);
void tl_nav_free_hub_labels(const tl_allocator *allocator, tl_nav_roads *roads);

/// The shortest way from a start to a goal, and the hub that it passes.
typedef struct tl_nav_meeting {
    float length; ///< metres; INFINITY: there is none
    tl_nav_bend_leg *start, *goal;
    uint32_t hub;
} tl_nav_meeting;

/// By the table; `hub` says nothing. Reorders the goals.
tl_nav_meeting tl_nav_best_by_table(const tl_nav_roads *roads, tl_nav_ends *ends);
/// By labels; raises totals by landmarks. `to_hub` is scratch for as many as there are bends.
tl_nav_meeting tl_nav_best_by_labels(const tl_nav_roads *roads, tl_nav_ends *ends, float *to_hub);
/// The bends on that way, the last one first; returns their number, UINT32_MAX: there is no room for them.
uint32_t tl_nav_unpack_meeting(const tl_nav_roads *roads, const tl_nav_meeting *meeting, uint64_t *bends,
                               uint32_t capacity);

/// Metres within which a vertex is on a line between two places of a search.
static inline double tl_nav_line_rounding(const tl_nav_shortest_search *search, const tl_nav_roads *roads)
{
    double start = fmax(fabs((double)search->start.x), fabs((double)search->start.z));
    double goal = fmax(fabs((double)search->goal.x), fabs((double)search->goal.z));
    return fmax(roads->rounding, TL_NAV_ON_LINE * fmax(start, goal));
}

/// What there is room for.
typedef struct tl_nav_path_room {
    tl_nav_corner *corners;
    uint32_t corner_capacity;
    tl_nav_ref *polygons;
    uint32_t polygon_capacity;
} tl_nav_path_room;

/// The shortest path of a search that has roads. False: out of nodes, or a line that touches too much to tell where it
/// goes; the search over polygons will do it. Then nothing of `path_out` counts.
bool tl_nav_find_over_roads(tl_nav_shortest_search *search, const tl_nav_roads *roads, const tl_nav_path_room *room,
                            tl_nav_shortest_path *path_out);
/// The same by search, for a start and a goal that do not see one another.
bool tl_nav_search_roads(tl_nav_shortest_search *search, const tl_nav_roads *roads, const tl_nav_ends *ends,
                         const tl_nav_path_room *room, tl_nav_shortest_path *path_out);

/// Writes the path that goes over bends [0, bend_count), of which the query's heap holds the last one first: the first
/// of its corners and polygons, their true numbers and lengths. Returns UINT32_MAX, or which leg cannot be gone
/// straight: 0 is from the start.
uint32_t tl_nav_write_roads(const tl_nav_shortest_search *search, const tl_nav_roads *roads, const uint64_t *bends,
                            uint32_t bend_count, const tl_nav_path_room *room, tl_nav_shortest_path *path_out);

#endif
