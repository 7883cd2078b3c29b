// SPDX-License-Identifier: MIT
//
// Exact predicates of polygons on the lattice. Coordinates are within +-TL_MAX_CONTOUR_COORDINATE (2^29), so a
// difference is within 2^30, a product within 2^60, and all sums here fit 64 bits.

#ifndef TALUS_SRC_NAV_FORMAT_LATTICE_POLYGON_H
#define TALUS_SRC_NAV_FORMAT_LATTICE_POLYGON_H

#include <talus/nav_tile.h>

/// Twice the signed area of abc in the plane; < 0 when c lies on the inner side of the edge from a to b.
static inline int64_t tl_nav_area2(const int32_t *a, const int32_t *b, const int32_t *c)
{
    return ((int64_t)b[0] - a[0]) * ((int64_t)c[2] - a[2]) - ((int64_t)c[0] - a[0]) * ((int64_t)b[2] - a[2]);
}

/// A polygon's corners, one behind the other.
typedef struct tl_nav_lattice_polygon {
    int32_t points[3 * TL_NAV_MAX_CORNERS];
    uint32_t count;
} tl_nav_lattice_polygon;

/// Gathers corners that index `vertices`; at most TL_NAV_MAX_CORNERS.
void tl_nav_gather_polygon(const int32_t *vertices, const uint32_t *corners, uint32_t count,
                           tl_nav_lattice_polygon *polygon_out);
/// The same of a tile's polygon.
void tl_nav_gather_tile_polygon(const tl_nav_tile *tile, uint32_t polygon, tl_nav_lattice_polygon *polygon_out);

/// Whether a polygon's corners are in convex position in the contours' winding, collinear corners allowed.
bool tl_nav_is_convex(const tl_nav_lattice_polygon *polygon);

/// Twice the area, > 0 for the contours' winding. A convex polygon's is below 2^61.
int64_t tl_nav_double_area(const tl_nav_lattice_polygon *polygon);

/// Whether the edge from a to b lies on a side of its tile, and runs along it the way the winding demands.
bool tl_nav_on_side(const int32_t *a, const int32_t *b, uint32_t side, uint32_t tile_size);

/// Where a point of a tile's lattice lies, metres.
static inline tl_vec3 tl_nav_lattice_position(const tl_nav_tile *tile, tl_nav_lattice_point point)
{
    return tl_vec3_make(
        tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, point.at[0], tile->cell_size),
        tl_nav_tile_position(tile->origin.y, 0, 0, point.at[1], tile->cell_height),
        tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, point.at[2], tile->cell_size));
}

/// The lattice axis along a side: 2 (z) on sides 0 and 2, 0 (x) on sides 1 and 3.
static inline uint32_t tl_nav_side_axis(uint32_t side)
{
    return (side & 1u) != 0 ? 0u : 2u;
}

#endif
