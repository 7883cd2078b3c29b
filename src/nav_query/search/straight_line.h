// SPDX-License-Identifier: MIT
//
// The polygons along a straight line between two points that are thought to see one another (straight_line.c).

#ifndef TALUS_SRC_NAV_QUERY_STRAIGHT_LINE_H
#define TALUS_SRC_NAV_QUERY_STRAIGHT_LINE_H

#include "nav_query/navmesh/ring_step.h"

typedef struct tl_nav_line {
    const tl_navmesh *navmesh;
    double x, z;       ///< from here,
    double on_x, on_z; ///< so far
    uint32_t turn;     ///< to the vertex of this number (tl_nav_turn_of); 0: to the polygon
    uint32_t slot, polygon;
    double rounding; ///< metres within which a vertex is on the line
} tl_nav_line;

/// Metres to the right of the line, times its length.
static inline double tl_nav_right_of_line(const tl_nav_line *line, const tl_vec3 *vertex)
{
    return line->on_x * ((double)vertex->z - line->z) - line->on_z * ((double)vertex->x - line->x);
}

typedef enum tl_nav_line_end {
    TL_NAV_LINE_ARRIVES,
    TL_NAV_LINE_BLOCKED,
    TL_NAV_LINE_UNCLEAR ///< it touches more polygons than are looked at
} tl_nav_line_end;

/// The polygons of a path, as far as there is room for them.
typedef struct tl_nav_trail {
    tl_nav_ref *polygons;
    uint32_t capacity, count;
    uint32_t slot, polygon; ///< the last one
} tl_nav_trail;

/// Adds a polygon, unless it is the last one.
static inline void tl_nav_add_to_trail(tl_nav_trail *trail, const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    if (trail->count > 0 && trail->slot == slot && trail->polygon == polygon) {
        return;
    }
    if (trail->count < trail->capacity) {
        trail->polygons[trail->count] = tl_nav_make_ref(navmesh, slot, polygon);
    }
    trail->count++;
    trail->slot = slot;
    trail->polygon = polygon;
}

/// Goes along the line from a polygon that holds its beginning; `trail` (may be NULL) gets the polygons that are
/// crossed.
tl_nav_line_end tl_nav_walk_line(const tl_nav_line *line, uint32_t slot, uint32_t polygon, tl_nav_trail *trail);

#endif
