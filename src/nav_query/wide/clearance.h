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
    double cover; ///< metres: once a wall is nearer than that to all of a polygon, no others need be found; 0: all are
    bool is_enough;         ///< of walls beyond a distance at which one forbids all of a polygon, none need be found
    tl_nav_scratch scratch; ///< what is left of the query's memory
    bool is_full;           ///< it was not enough
    bool is_out_of_beams;   ///< full, for lines of sight branch without end (visible_walls.c)
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
void *tl_nav_take_scratch(tl_nav_clearance *clearance, uint64_t count, uint64_t size);

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
    bool is_covered; ///< a wall is nearer than `cover` to all of the shape; others may be missing
    double
        within; ///< metres: no wall nearer than that is missing; less than asked for only where `is_enough` allows it
} tl_nav_near_walls;

/// Finds the walls that can be walked to straight, within `distance`, from some spot of a convex shape (1 corner: a
/// spot, 2: a segment, at most 64) that lies in one polygon; the polygons that are met are left out. What the filter
/// refuses is wall. Those within a lesser distance are the first ones of the list.
/// False: out of scratch memory, and is_full is set. The list lies in the scratch memory; the caller restores `scratch`
/// when done.
bool tl_nav_find_visible_walls(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *corners,
                               uint32_t count, double distance, tl_nav_near_walls *near_out);

/// The same for a shape that may lie over several polygons, and touches this one.
bool tl_nav_find_walls_near_shape(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon,
                                  const tl_nav_spot *shape, uint32_t count, double distance,
                                  tl_nav_near_walls *near_out);

/// The walls near a shape that may lie over several polygons and touches this one, within the reach of it and of a
/// polygon that it touches; in no order. It takes what is kept, and one wall too many where that is seen from elsewhere
/// in such a polygon.
bool tl_nav_find_kept_walls_near_shape(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon,
                                       const tl_nav_spot *shape, uint32_t count, tl_nav_near_walls *near_out);

/// A spot as floats, on the surface: in `home`, or where rounding has put it beside that, in the polygon that holds it.
tl_nav_location tl_nav_spot_on_surface(tl_nav_clearance *clearance, tl_nav_met home, tl_nav_spot spot);

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

#endif
