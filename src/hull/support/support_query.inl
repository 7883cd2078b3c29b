// SPDX-License-Identifier: MIT
//
// The support query: one source, compiled once for each instruction set by a file that defines TL_SUPPORT_QUERY,
// TL_SUPPORT_CLIMB and TL_SUPPORT_MARCH.
//
// First the caller's hint, which a scan of very few vertices tests by the way. Then a scan of a small hull, or a start
// from the direction table. The start is right nearly always, so the processor goes on with it while its neighbours are
// still being tested: the proof costs arithmetic, but no waiting. A hint or a start that is one edge off is seen at
// once.
//
// Float arithmetic decides whenever its error bound allows; what it leaves open is settled exactly. So the answer is a
// true maximiser, and does not depend on the hint, on the way it was found, or on the instruction set.
//
// The query has no frame: a direction goes around as three floats, for a struct has a place in memory; and what needs
// one is not inlined. A frame of 32-byte registers is aligned first, which would be a fifth of a short query.

#include "hull/support/direction_table.h"
#include "hull/support/support_climb.inl"
#include "hull/support/support_march.inl"
#include "hull/support/support_scan.inl"
#include "math/predicates.h"
#include "math/tolerance.h"

typedef enum climb_end { END_FARTHEST, END_LEVEL, END_HIGHER } climb_end;

// Of the gain by double arithmetic from one vertex to another, as a share of its three absolute products: a difference,
// a product and two sums, four times. No product of a float and a difference of two underflows in double.
#define TL_SETTLE_ERROR TL_DOUBLE_GAMMA(16)

// As tl_compare_along(direction, a, b), of which it is the quick half: a hull's edges are short beside its distance
// from the origin.
static inline int settle_compare(tl_vec3 direction, tl_vec3 a, tl_vec3 b)
{
    const double x = (double)direction.x * ((double)a.x - (double)b.x);
    const double y = (double)direction.y * ((double)a.y - (double)b.y);
    const double z = (double)direction.z * ((double)a.z - (double)b.z);
    const double gain = x + y + z, error = TL_SETTLE_ERROR * (fabs(x) + fabs(y) + fabs(z));
    return gain > error ? 1 : gain < -error ? -1 : tl_compare_along(direction, a, b);
}

// Compares exactly what rounding left open around a vertex: nothing is as far; something is exactly as far; or
// something is farther, and `vertex` becomes the farthest of it.
static inline climb_end settle(const tl_hull *hull, tl_vec3 direction, const tl_climber *climber, uint32_t *vertex)
{
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t best = *vertex;
    climb_end end = END_FARTHEST;
    for (uint32_t at = *vertex; at != TL_NO_VERTEX; at = tl_climb_block_after(&blocks[at])) {
        // The last lane of all blocks but a vertex's last one is no neighbour, and repeats the first.
        uint32_t lanes = tl_climb_block_after(&blocks[at]) != TL_NO_VERTEX ? 0x7fu : 0xffu;
        uint32_t open = tl_climber_open(tl_climber_gains_at(climber, &blocks[at])) & lanes;
        for (; open != 0; open &= open - 1) {
            const uint32_t lane = tl_lowest_bit(open), other = blocks[at].link[lane];
            if (lane > 0 && other == blocks[at].link[0]) {
                break; // unused lanes repeat the first neighbour
            }
            const int order = settle_compare(direction, vertices[other], vertices[best]);
            best = order > 0 ? other : best;
            end = order > 0 ? END_HIGHER : order == 0 && end == END_FARTHEST && other != best ? END_LEVEL : end;
        }
    }
    *vertex = best;
    return end;
}

// Not inlined, so that the query itself needs little stack.
TL_NOINLINE uint32_t TL_SUPPORT_CLIMB(const tl_hull *hull, float x, float y, float z, uint32_t vertex)
{
    const tl_vec3 direction = { x, y, z };
    tl_climber climber = tl_climber_make(x, y, z);
    if (tl_hull_climb_blocks(hull, &climber, &vertex)) {
        return vertex;
    }
    // What follows is as hard to tell: no float step would be certain.
    climb_end end;
    do {
        end = settle(hull, direction, &climber, &vertex);
    } while (end == END_HIGHER);
    return end == END_LEVEL ? tl_hull_climb_exact(hull, direction, vertex) : vertex;
}

uint32_t TL_SUPPORT_MARCH(const tl_hull *hull, tl_vec3 from, tl_vec3 step, uint32_t count, uint32_t vertex,
                          uint32_t *cells)
{
    return tl_hull_march_blocks(hull, from, step, count, vertex, cells);
}

uint32_t TL_SUPPORT_QUERY(const tl_hull *hull, float x, float y, float z, uint32_t hint)
{
    const tl_climber climber = tl_climber_make(x, y, z);
    const float size = fabsf(x) + fabsf(y) + fabsf(z);
    if (!(size >= TL_SUPPORT_DIRECTION_MIN && size <= TL_SUPPORT_DIRECTION_MAX)) {
        return tl_hull_support_unusual(hull, x, y, z, hint);
    }
    if (hull->vertex_count <= TL_HULL_FEW) {
        return tl_hull_scan_few(hull, x, y, z, &climber, size, hint);
    }
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    if (hint < hull->vertex_count) {
        const tl_climb_look look = tl_climber_look(&climber, blocks, &hint);
        if (look != TL_LOOK_FAR) {
            return look == TL_LOOK_PROVEN ? hint : TL_SUPPORT_CLIMB(hull, x, y, z, hint);
        }
    }
    if (hull->vertex_count <= TL_HULL_SCAN_LIMIT) {
        return tl_hull_scan(hull, x, y, z, size);
    }
    uint32_t start = tl_hull_table_start(hull, tl_vec3_make(x, y, z));
    const tl_climb_look look = tl_climber_look(&climber, blocks, &start);
    return look == TL_LOOK_PROVEN ? start : TL_SUPPORT_CLIMB(hull, x, y, z, start);
}
