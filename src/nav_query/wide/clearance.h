// SPDX-License-Identifier: MIT
//
// Clearance: how far a place is from the walls around it, in the plane.
//
// An agent wider than the one that the mesh was baked for keeps its centre at least `reach` metres away from all walls.
// So a wall forbids its Minkowski sum with a disc, a stadium: a convex set, as a polygon is, which makes questions of
// connection within a polygon exact (free_pieces.c).

#ifndef TALUS_SRC_NAV_QUERY_CLEARANCE_H
#define TALUS_SRC_NAV_QUERY_CLEARANCE_H

#include "nav_query/navmesh/navmesh.h"
#include "nav_query/plane/plan_segment.h"
#include "nav_query/search/node_pool.h"

/// Memory that is taken from both ends. A copy of it, put back, frees what was taken since.
typedef struct tl_nav_scratch {
    char *low, *high;
} tl_nav_scratch;

/// What one wide query works with.
typedef struct tl_nav_clearance {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter; ///< NULL: no polygon is refused
    double reach;                ///< metres that the centre keeps from walls, less `slack`
    double least;                ///< metres that its path keeps: a share of reach, as corners are rounded by chords
    double slack;                ///< metres: what rounding may do to a place
    double touch;                ///< metres, squared: what lies no farther apart touches
    tl_nav_scratch scratch;      ///< what is left of the query's memory
    bool is_full;                ///< it was not enough
} tl_nav_clearance;

/// Metres lost to rounding when a place of a coordinate's size is kept as floats, and distances are taken from it: the
/// place itself, the wall's two ends and the agent's radius are rounded once, the way that leads there a few times.
#define TL_NAV_PLACE_ROUNDINGS 16.0

/// The scratch memory is the query's wide_memory.
void tl_nav_clearance_begin(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter, double reach,
                            tl_nav_clearance *clearance_out);

/// How near two places of a navmesh touch, in metres, squared. It follows from the least power of two above all
/// coordinates: so it changes hardly ever as tiles come in, and what was found before holds.
double tl_nav_touch_of(const tl_navmesh *navmesh);

/// Scratch memory for `count` elements, or NULL when it is used up; then is_full is set.
void *tl_nav_take(tl_nav_clearance *clearance, uint64_t count, uint64_t size);

/// A polygon that was met.
typedef struct tl_nav_met {
    uint32_t slot, polygon;
} tl_nav_met;

/// A wall near a shape.
typedef struct tl_nav_near_wall {
    /// Metres, squared: how far from the shape one must look to see it. No less than the distance from the shape to the
    /// part of the wall that is seen from it, nor than that to any edge that it is seen through.
    float distance_sq;
    float a_x, a_z, b_x, b_z;
} tl_nav_near_wall;

static inline tl_nav_segment tl_nav_segment_of_wall(const tl_nav_near_wall *wall)
{
    tl_nav_segment segment = { { (double)wall->a_x, (double)wall->a_z }, { (double)wall->b_x, (double)wall->b_z } };
    return segment;
}

/// The walls near a convex shape, and the polygons that it touches.
typedef struct tl_nav_near_walls {
    const tl_nav_near_wall *walls; ///< the nearest first, ties by coordinates: the same wherever they come from
    uint32_t wall_count;
    tl_nav_met *met; ///< met[-i]: they grow downwards
    uint32_t met_count;
} tl_nav_near_walls;

/// Finds the walls that can be walked to straight, within `distance`, from some spot of a convex shape (1 corner: a
/// spot, 2: a segment, at most 64) that lies in one polygon; the polygons that are met are left out. What the filter
/// refuses is wall. Those within a lesser distance are the first ones of the list.
/// False: out of scratch memory, and is_full is set. The list lies in the scratch memory; the caller restores `scratch`
/// when done.
bool tl_nav_find_walls_of(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *corners,
                          uint32_t count, double distance, tl_nav_near_walls *near_out);

/// The same for a shape that may lie over several polygons, and touches this one.
bool tl_nav_find_near_walls(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *shape,
                            uint32_t count, double distance, tl_nav_near_walls *near_out);

/// The walls near a shape that may lie over several polygons and touches this one, within the reach of it and of a
/// polygon that it touches; in no order. It takes what is kept, and one wall too many where that is seen from elsewhere
/// in such a polygon.
bool tl_nav_find_cell_walls(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *shape,
                            uint32_t count, tl_nav_near_walls *near_out);

/// A spot as floats, on the surface: in `home`, or where rounding has put it beside that, in the polygon that holds it.
tl_nav_location tl_nav_settle(tl_nav_clearance *clearance, tl_nav_met home, tl_nav_spot spot);

/// Whether no wall is nearer than `distance` to the segment from a to b.
bool tl_nav_is_clear(const tl_nav_near_walls *near, tl_nav_spot a, tl_nav_spot b, double distance);

/// How far a spot lies outside a convex outline, at least; 0 inside.
double tl_nav_outside_by(const tl_nav_spot *corners, uint32_t count, tl_nav_spot spot);

/// How many of a list's first walls are nearer than a distance.
uint32_t tl_nav_count_within(const tl_nav_near_wall *walls, uint32_t count, double distance);

/// A polygon's corners in the plane; returns their number.
uint32_t tl_nav_corner_spots(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon,
                             tl_nav_spot corners[TL_NAV_MAX_CORNERS]);

/// How much farther than a tile's own agent one of this radius stays from walls.
static inline double tl_nav_extra_reach(const tl_nav_tile *tile, float radius)
{
    return fmax((double)radius - (double)tile->agent_radius, 0.0);
}

// ---------------------------------------------------------------------------------------------------------
// Polygons with the walls around them, kept or gathered (prepared_walls.c).

/// A wall that comes near to a side of a polygon's outline.
typedef struct tl_nav_wall_hit {
    /// Metres, squared, rounded down: it takes nothing off the side for a lesser reach. Where the side is itself a
    /// wall: tl_nav_side_distance_sq, and -1 for that wall.
    float distance_sq;
    uint32_t wall; ///< of the polygon's
} tl_nav_wall_hit;

/// Two walls with the middle between them inside the outline.
typedef struct tl_nav_wall_pair {
    double distance_sq; ///< metres between them, squared
    uint32_t a, b;      ///< a < b
} tl_nav_wall_pair;

/// A polygon and the walls near it.
typedef struct tl_nav_wall_cell {
    tl_nav_spot corners[TL_NAV_MAX_CORNERS];
    uint32_t count;
    tl_nav_near_walls near; ///< of the polygon's outline
    /// What is precomputed; NULL and 0: nothing is.
    const uint32_t *side_first;    ///< [count + 1]: where each side's hits begin
    const tl_nav_wall_hit *hits;   ///< the nearest first
    const tl_nav_wall_pair *pairs; ///< the nearest first; those that meet in a corner of the outline are left out
    uint32_t pair_count;
    double distance; ///< metres: all walls within it
    bool is_kept;
} tl_nav_wall_cell;

/// The distance of two walls of a list. Whether the middle between the spots where they come nearest to each other lies
/// in the outline.
bool tl_nav_pair_walls(const tl_nav_spot *corners, uint32_t count, const tl_nav_near_wall *walls, uint32_t a,
                       uint32_t b, tl_nav_wall_pair *pair_out);

/// Whether a wall is a side of an outline, from end to end.
bool tl_nav_is_side(const tl_nav_spot *corners, uint32_t count, uint32_t side, const tl_nav_near_wall *wall);
/// How near it comes to one: metres, squared.
float tl_nav_side_distance_sq(const tl_nav_spot *corners, uint32_t count, uint32_t side, const tl_nav_near_wall *wall);

/// A polygon with all walls within `distance`: those that are kept with the navmesh, or else gathered. False: out of
/// scratch memory, and is_full is set. What was gathered lies in the scratch memory; the caller restores `scratch` when
/// done.
bool tl_nav_wall_cell_of(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, double distance,
                         tl_nav_wall_cell *cell_out);
/// The same, gathered.
bool tl_nav_gather_cell(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, double distance,
                        tl_nav_wall_cell *cell_out);

// ---------------------------------------------------------------------------------------------------------
// Free pieces of a convex outline (free_pieces.c).

#define TL_NAV_NO_COMPONENT UINT32_MAX

/// A stretch of an edge on which the agent's centre may stand.
typedef struct tl_nav_piece {
    double from, to; ///< [0, 1] of the edge
    uint32_t edge;
    uint32_t component; ///< pieces have the same one when there is a free way between them inside the outline
} tl_nav_piece;

typedef struct tl_nav_pieces {
    tl_nav_piece *pieces; ///< in the outline's order
    uint32_t count;
    uint32_t component_count; ///< components are below it
} tl_nav_pieces;

/// Cuts a polygon's outline into free pieces. False: out of scratch memory.
bool tl_nav_cut_cell(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, tl_nav_pieces *pieces_out);

/// The same for any convex outline.
bool tl_nav_cut_outline(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                        const tl_nav_near_walls *near, tl_nav_pieces *pieces_out);

/// The piece that holds a spot of the outline within `slack`, or NULL.
const tl_nav_piece *tl_nav_piece_at(const tl_nav_pieces *pieces, const tl_nav_spot *corners, uint32_t count,
                                    tl_nav_spot spot, double slack);

/// The component of an outline's pieces that can be reached from a free spot inside it, or TL_NAV_NO_COMPONENT when
/// none can be.
/// `*joined_out` (may be NULL): whether there is a free way inside the outline from the spot to `other`.
/// `*component_out` is undefined when this returns false: out of scratch memory.
bool tl_nav_component_at(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, const tl_nav_pieces *pieces,
                         tl_nav_spot spot, tl_nav_spot other, uint32_t *component_out, bool *joined_out);

#endif
