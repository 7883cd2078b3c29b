// SPDX-License-Identifier: MIT
//
// Exact plane geometry on the contours' lattice.
//
// Proof of range: coordinates lie within +-2^29, so differences within 2^30, a product of two within 2^60, and a turn,
// a squared length or a dot product, each two such products, within 2^61. All fit int64_t.
//
// A turn is > 0 where an outer contour bends inward to its floor (a convex corner), so the floor lies on the side of
// positive turns: "left" below. Seen from above with x to the right and z down, as tools draw it, contours run
// clockwise.

#ifndef TALUS_SRC_POLYGON_LATTICE_POINT_H
#define TALUS_SRC_POLYGON_LATTICE_POINT_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tl_lattice_point {
    int32_t x, z;
} tl_lattice_point;

/// Doubled signed area of a, b, c: > 0 when c lies left of the line from a to b, 0 when on it.
static inline int64_t tl_turn(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c)
{
    return ((int64_t)c.x - a.x) * ((int64_t)b.z - a.z) - ((int64_t)b.x - a.x) * ((int64_t)c.z - a.z);
}

static inline bool tl_same_point(tl_lattice_point a, tl_lattice_point b)
{
    return a.x == b.x && a.z == b.z;
}

static inline int64_t tl_distance2(tl_lattice_point a, tl_lattice_point b)
{
    int64_t dx = (int64_t)b.x - a.x;
    int64_t dz = (int64_t)b.z - a.z;
    return dx * dx + dz * dz;
}

/// (b - a) . (c - a)
static inline int64_t tl_dot2(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c)
{
    return ((int64_t)b.x - a.x) * ((int64_t)c.x - a.x) + ((int64_t)b.z - a.z) * ((int64_t)c.z - a.z);
}

/// For p on the line through a and b: whether it lies on the closed segment.
static inline bool tl_within_span(tl_lattice_point a, tl_lattice_point b, tl_lattice_point p)
{
    return (a.x < b.x ? a.x <= p.x && p.x <= b.x : b.x <= p.x && p.x <= a.x) &&
           (a.z < b.z ? a.z <= p.z && p.z <= b.z : b.z <= p.z && p.z <= a.z);
}

#endif
