// SPDX-License-Identifier: MIT
//
// Polygons with the walls around them, kept with the navmesh or gathered (prepared_walls.c).

#ifndef TALUS_SRC_NAV_QUERY_WALL_CELL_H
#define TALUS_SRC_NAV_QUERY_WALL_CELL_H

#include "nav_query/wide/clearance.h"

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

#endif
