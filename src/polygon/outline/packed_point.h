// SPDX-License-Identifier: MIT
//
// A lattice point in 64 bits, x and z side by side, so that both are compared at once: a subtraction in each half
// leaves a guard bit above the coordinate where it borrows none. Coordinates lie within +-2^29, so 31 bits hold them as
// differences from -2^30, and the guard is the 32nd.

#ifndef TALUS_SRC_POLYGON_PACKED_POINT_H
#define TALUS_SRC_POLYGON_PACKED_POINT_H

#include "base/min_max.h"
#include "polygon/outline/lattice_point.h"

#define TL_PACKED_GUARDS 0x8000000080000000u
#define TL_PACKED_ORIGIN 0x40000000u

/// All points between a lowest and a highest x and z. The guards of `high` are set.
typedef struct tl_packed_range {
    uint64_t low, high;
} tl_packed_range;

static inline uint64_t tl_pack_point(tl_lattice_point p)
{
    return (uint64_t)((uint32_t)p.x + TL_PACKED_ORIGIN) << 32 | ((uint32_t)p.z + TL_PACKED_ORIGIN);
}

static inline tl_packed_range tl_packed_range_of(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c)
{
    const tl_lattice_point low = { tl_min_i32(tl_min_i32(a.x, b.x), c.x), tl_min_i32(tl_min_i32(a.z, b.z), c.z) };
    const tl_lattice_point high = { tl_max_i32(tl_max_i32(a.x, b.x), c.x), tl_max_i32(tl_max_i32(a.z, b.z), c.z) };
    const tl_packed_range range = { tl_pack_point(low), tl_pack_point(high) | TL_PACKED_GUARDS };
    return range;
}

static inline bool tl_in_packed_range(const tl_packed_range *range, uint64_t packed)
{
    return ((range->high - packed) & ((packed | TL_PACKED_GUARDS) - range->low) & TL_PACKED_GUARDS) == TL_PACKED_GUARDS;
}

/// Whether two ranges share a point.
static inline bool tl_packed_ranges_meet(const tl_packed_range *a, const tl_packed_range *b)
{
    const uint64_t a_reaches = a->high - b->low, b_reaches = b->high - a->low;
    return (a_reaches & b_reaches & TL_PACKED_GUARDS) == TL_PACKED_GUARDS;
}

#endif
