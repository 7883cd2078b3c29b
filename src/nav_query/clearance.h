// SPDX-License-Identifier: MIT
//
// Clearance: how far a place is from the walls around it, in the plane. What wide paths stand on.
//
// An agent wider than the one that the mesh was baked for keeps its centre at least `reach` metres away from all walls.
// What a wall forbids is then a convex set, all that is nearer to it than `reach`; within a polygon, which is convex
// too, that makes questions of connection exact (free_pieces.c).

#ifndef TALUS_SRC_NAV_QUERY_CLEARANCE_H
#define TALUS_SRC_NAV_QUERY_CLEARANCE_H

#include "nav_query/navmesh.h"
#include "nav_query/node_pool.h"
#include "nav_query/plan_segment.h"

/// Memory that is taken from both ends. A copy of it, put back, frees what was taken since.
typedef struct tl_nav_room {
    char *low, *high;
} tl_nav_room;

/// What one wide query works with.
typedef struct tl_nav_clearance {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter; ///< NULL: no polygon is refused
    double reach;                ///< metres that the centre keeps from walls, less `slack`
    double least;                ///< metres that its path keeps: a share of reach, as corners are rounded by chords
    double slack;                ///< metres: what rounding may do to a place
    tl_nav_room room;            ///< what is left of the query's memory
    bool is_full;                ///< it was not enough
} tl_nav_clearance;

/// Metres lost to rounding when a place of a coordinate's size is kept as floats, and distances are taken from it: the
/// place itself, the wall's two ends and the agent's radius are rounded once, the way that leads there a few times.
#define TL_NAV_PLACE_ROUNDINGS 16.0

/// The room is the memory of the query's wedges: no wide query runs an exact search.
void tl_nav_clearance_begin(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter, double reach,
                            tl_nav_clearance *clearance_out);

/// Room for `count` elements, or NULL when it is used up; then is_full is set.
void *tl_nav_take(tl_nav_clearance *clearance, uint64_t count, uint64_t size);

/// A polygon that was met.
typedef struct tl_nav_met {
    uint32_t slot, polygon;
} tl_nav_met;

/// The walls near a convex shape, and the polygons that it touches.
typedef struct tl_nav_near_walls {
    tl_nav_segment *walls;
    uint32_t wall_count;
    tl_nav_met *met; ///< met[-i]: they grow downwards
    uint32_t met_count;
} tl_nav_near_walls;

/// Finds the walls that can be walked to straight, within `distance`, from some spot of a convex shape (1 corner: a
/// spot, 2: a segment, at most 64) that lies in one polygon; the polygons that are met are left out. What the filter
/// refuses is wall.
/// False: out of room, and is_full is set. The list lies in the room; the caller puts `room` back when done.
bool tl_nav_find_walls_of(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *corners,
                          uint32_t count, double distance, tl_nav_near_walls *near_out);

/// The same for a shape that may lie over several polygons, and touches this one.
bool tl_nav_find_near_walls(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *shape,
                            uint32_t count, double distance, tl_nav_near_walls *near_out);

/// A spot as floats, on the surface: in `home`, or where rounding has put it beside that, in the polygon that holds it.
tl_nav_location tl_nav_settle(tl_nav_clearance *clearance, tl_nav_met home, tl_nav_spot spot);

/// Whether no wall is nearer than `distance` to the segment from a to b.
bool tl_nav_is_clear(const tl_nav_near_walls *near, tl_nav_spot a, tl_nav_spot b, double distance);

/// How far a spot lies outside a convex outline, at least; 0 inside.
double tl_nav_outside_by(const tl_nav_spot *corners, uint32_t count, tl_nav_spot spot);

/// A polygon's corners in the plane; returns their number.
uint32_t tl_nav_corner_spots(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon,
                             tl_nav_spot corners[TL_NAV_MAX_CORNERS]);

/// How much farther than a tile's own agent one of this radius stays from walls.
static inline double tl_nav_extra_reach(const tl_nav_tile *tile, float radius)
{
    return fmax((double)radius - (double)tile->agent_radius, 0.0);
}

// ---------------------------------------------------------------------------------------------------------
// Free pieces of a convex outline (free_pieces.c).

#define TL_NAV_NO_FACE UINT32_MAX

/// A stretch of an edge on which the agent's centre may stand.
typedef struct tl_nav_piece {
    double from, to; ///< [0, 1] of the edge
    uint32_t edge;
    uint32_t face; ///< pieces have the same one when there is a free way between them inside the outline
} tl_nav_piece;

typedef struct tl_nav_pieces {
    tl_nav_piece *pieces; ///< in the outline's order
    uint32_t count;
    uint32_t face_count; ///< faces are below it
} tl_nav_pieces;

/// Cuts a convex outline into free pieces. False: out of room.
bool tl_nav_cut_outline(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                        const tl_nav_near_walls *near, tl_nav_pieces *pieces_out);

/// The piece that holds a spot of the outline within `slack`, or NULL.
const tl_nav_piece *tl_nav_piece_at(const tl_nav_pieces *pieces, const tl_nav_spot *corners, uint32_t count,
                                    tl_nav_spot spot, double slack);

/// The face of an outline's pieces that can be reached from a free spot inside it, or TL_NAV_NO_FACE when none can be.
/// `*joined_out` (may be NULL): whether there is a free way inside the outline from the spot to `other`.
/// `*face_out` is undefined when this returns false: out of room.
bool tl_nav_face_of(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                    const tl_nav_near_walls *near, const tl_nav_pieces *pieces, tl_nav_spot spot, tl_nav_spot other,
                    uint32_t *face_out, bool *joined_out);

#endif
