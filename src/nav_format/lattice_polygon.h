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

/// Whether a polygon's corners are in convex position in the contours' winding, collinear corners allowed.
/// `corners` index `vertices`.
bool tl_nav_is_convex(const int32_t *vertices, const uint32_t *corners, uint32_t count);

/// Twice the area, > 0 for the contours' winding. A convex polygon's is below 2^61.
int64_t tl_nav_double_area(const int32_t *vertices, const uint32_t *corners, uint32_t count);

/// Whether the edge from a to b lies on a side of its tile, and runs along it the way the winding demands.
bool tl_nav_on_side(const int32_t *a, const int32_t *b, uint32_t side, uint32_t tile_size);

/// The lattice axis along a side: 2 (z) on sides 0 and 2, 0 (x) on sides 1 and 3.
static inline uint32_t tl_nav_side_axis(uint32_t side)
{
    return (side & 1u) != 0 ? 0u : 2u;
}

#endif
