// SPDX-License-Identifier: MIT
//
// Roads: all straight ways between vertices where shortest paths turn, found once, so that a search knows no polygons.
//
// A bend is such a vertex (fans.c), a road joins two bends that see one another along a line by which a shortest path
// may come and go. Every shortest path is a first leg to a bend, roads, and a last leg; or one leg. For each polygon
// the bends are known that see something of it, among which the ends of the first and last legs are found.

#ifndef TALUS_SRC_NAV_QUERY_ROADS_H
#define TALUS_SRC_NAV_QUERY_ROADS_H

#include "nav_query/ring_step.h"
#include "nav_query/shortest_search.h"
#include "nav_query/straight_line.h"

#include <math.h>

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

typedef struct tl_nav_road {
    uint32_t to;   ///< bend
    float x, z;    ///< where that is
    uint32_t hand; ///< TL_NAV_ROAD_...
} tl_nav_road;

struct tl_nav_roads {
    tl_nav_bend *bends; ///< [bend_count + 1]
    tl_nav_road *roads;
    float (*marks)[TL_NAV_LANDMARKS]; ///< by bend
    uint32_t *slot_first;             ///< by slot: where its polygons begin in seen_first
    uint32_t *seen_first;             ///< [polygon_count + 1]
    uint32_t *seen;                   ///< bends, by polygon
    uint32_t bend_count, road_count, polygon_count, seen_count, slot_count;
    double rounding;  ///< metres within which a point is on a line
    float mark_error; ///< metres by which a difference of two marks may be wrong
    uint64_t edit;    ///< of the navmesh for which they hold
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

/// The shortest path of a search that has roads. False: out of nodes, or a line that touches too much to tell where it
/// goes; the search over polygons will do it. Then nothing is written.
bool tl_nav_search_roads(tl_nav_shortest_search *search, const tl_nav_roads *roads);

/// What there is room for.
typedef struct tl_nav_path_room {
    tl_nav_corner *corners;
    uint32_t corner_capacity;
    tl_nav_ref *polygons;
    uint32_t polygon_capacity;
} tl_nav_path_room;

/// Writes the path that was found: the first of its corners and polygons, their true numbers and lengths. False: as
/// above.
bool tl_nav_write_roads(const tl_nav_shortest_search *search, const tl_nav_roads *roads, const tl_nav_path_room *room,
                        tl_nav_shortest_path *path_out);

#endif
