// SPDX-License-Identifier: MIT
//
// Where a climb starts: the vertex that is farthest for the middle of the direction's cell.
//
// The direction is scaled by the hull's box first: the support of a stretched body in direction d is that of the body
// in the stretched direction, so this makes a needle's table as even as a ball's. (Other long bodies are better off
// without; how their faces' normals spread decides.) Then it is projected to the octahedron (octahedral map)
// |x| + |y| + |z| = 1, each half of which (z < 0, z >= 0) turned by 45 degrees is a square: no branch, no fold, and no
// cell is wasted, unlike with a grid over the cube's volume.
// Near: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3, 2014.
//
// A large face is what this map is bad at: the directions of its vertices are wedges that meet in its normal, and no
// square cell is small enough there. A cell among wedges names the face's ring instead: cells by the angle in the
// face's plane.

#ifndef TALUS_SRC_HULL_DIRECTION_TABLE_H
#define TALUS_SRC_HULL_DIRECTION_TABLE_H

#include "base/lowest_bit.h"
#include "base/min_max.h"
#include "hull/support/hull_support.h"

#include <float.h>
#include <string.h>

// Moves 1.0 a little inward, so that cells at the rim need no clamping: more than the roundings of the quotient, less
// than a cell's width would notice.
#define TL_TABLE_INWARD (1.0f - 9.5367432e-7f) // 1 - 2^-20

// The smallest extent that a direction is scaled by, as a share of the largest: about 2^-20.
// From above: a share s crowds the cells into the angle s around the thin axis. A unit vector's components are rounded
// by 2^-24, so 2^-20 leaves 16 steps in that angle; cells of a smaller share would be told apart by rounding alone.
// From below: the largest component of a direction in range is at least 2^-20 (TL_SUPPORT_DIRECTION_MIN), so a scaled
// one sums to at least 2^-40, and half a table's side over it is at most 256 * 2^40 = 2^48: no product of
// tl_table_cell under- or overflows. A body thinner than this only costs its climbs more steps, never the answer.
#define TL_MIN_RELATIVE_EXTENT 1e-6

// An extent over the largest one, so that no product with a direction in range under- or overflows.
static inline double tl_relative_extent(double extent, double largest)
{
    double share = extent / largest;
    return tl_max_f64(TL_MIN_RELATIVE_EXTENT, share);
}

static inline uint32_t tl_table_cell(tl_vec3 scaled, uint32_t side)
{
    float size = fabsf(scaled.x) + fabsf(scaled.y) + fabsf(scaled.z);
    float half = 0.5f * (float)side, inverse = half * TL_TABLE_INWARD / size;
    uint32_t row = (uint32_t)(int32_t)((scaled.x - scaled.y) * inverse + half);
    uint32_t column = (uint32_t)(int32_t)((scaled.x + scaled.y) * inverse + half);
    uint32_t sign;
    memcpy(&sign, &scaled.z, sizeof sign);
    return ((sign >> 31) * side + row) * side + column;
}

// Levels of a cap's ring, and the least cells of one. Ten levels, each a quarter as wide as the one outside, lead from
// the outermost circle, which is about as wide as a cell of the table, to what a float direction can tell.
#define TL_CAP_LEVELS      10u
#define TL_CAP_LEAST_CELLS 8u

// Cells of one level; the outermost, 0, has `cell_count`, a power of two.
static inline uint32_t tl_cap_level_cells(uint32_t cell_count, uint32_t level)
{
    return tl_max_u32(cell_count >> level, TL_CAP_LEAST_CELLS);
}

// Cells of all levels outside of one.
static inline uint32_t tl_cap_cells_before(uint32_t cell_count, uint32_t level)
{
    const uint32_t halvings = tl_lowest_bit(cell_count / TL_CAP_LEAST_CELLS) + 1, halved = tl_min_u32(level, halvings);
    return 2 * cell_count - (2 * cell_count >> halved) + TL_CAP_LEAST_CELLS * (level - halved);
}

// Cells of all of them.
static inline uint32_t tl_cap_cells(uint32_t cell_count)
{
    return tl_cap_cells_before(cell_count, TL_CAP_LEVELS);
}

static inline uint32_t tl_float_exponent(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits >> 23;
}

// The level of a cap's ring whose circle is nearest to a direction `reach` off the normal, in units of the outermost
// circle, for a direction with |x| + |y| + |z| = size: two binades a level.
static inline uint32_t tl_cap_level(float reach, float size)
{
    const int32_t binades = (int32_t)tl_float_exponent(size) - (int32_t)tl_float_exponent(reach);
    return (uint32_t)tl_clamp_i32((binades + 1) / 2, 0, (int32_t)TL_CAP_LEVELS - 1);
}

// The cell of a ring, counted from the table's first.
static inline uint32_t tl_cell_in_ring(const tl_hull *hull, uint32_t index, tl_vec3 d)
{
    const tl_face_ring *ring = &tl_hull_rings(hull)[index];
    const float a = ring->u[0] * d.x + ring->u[1] * d.y + ring->u[2] * d.z;
    const float b = ring->v[0] * d.x + ring->v[1] * d.y + ring->v[2] * d.z;
    const float reach = fabsf(a) + fabsf(b), t = b / tl_maxf(reach, FLT_MIN);
    // 0 .. 4 once around: a diamond's perimeter instead of the angle.
    const float around = 2.0f - copysignf(1.0f - t, a);
    uint32_t first = ring->first, cell_count = ring->cell_count;
    if ((cell_count & TL_RING_OF_CAP) != 0) {
        cell_count &= ~TL_RING_OF_CAP;
        const uint32_t level = tl_cap_level(reach, fabsf(d.x) + fabsf(d.y) + fabsf(d.z));
        first += tl_cap_cells_before(cell_count, level);
        cell_count = tl_cap_level_cells(cell_count, level);
    }
    return first + (uint32_t)(int32_t)(around * (0.25f * TL_TABLE_INWARD * (float)cell_count));
}

// For a direction in the range of hull_support.h.
static inline uint32_t tl_hull_table_start(const tl_hull *hull, tl_vec3 direction)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    uint32_t cell = tl_table_cell(tl_mul(direction, climb->table_scale), climb->table_side);
    const void *table = tl_hull_part(hull, climb->table);
    if (climb->cell_bytes == sizeof(uint16_t)) {
        const uint16_t *cells = table;
        uint32_t start = cells[cell];
        return (start & TL_TABLE_SHORT_RING) == 0
                   ? start
                   : cells[tl_cell_in_ring(hull, start & ~TL_TABLE_SHORT_RING, direction)];
    }
    const uint32_t *cells = table;
    uint32_t start = cells[cell];
    return (start & TL_TABLE_RING) == 0 ? start : cells[tl_cell_in_ring(hull, start & ~TL_TABLE_RING, direction)];
}

#endif
