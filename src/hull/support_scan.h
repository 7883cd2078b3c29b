// SPDX-License-Identifier: MIT
//
// Support by scan: all dot products of a small hull, eight at a time.
//
// The first pass keeps only the maximum, so it has no index to carry; the second compares the kept products, raised by
// twice their error bound, with it. Raised, and not the maximum lowered: that would be one more step after the last
// one. Nearly always one vertex remains; else the remaining ones are compared exactly.

#ifndef TALUS_SRC_HULL_SUPPORT_SCAN_H
#define TALUS_SRC_HULL_SUPPORT_SCAN_H

#include "hull/support_climb.h"
#include "math/predicates.h"

// The lowest of the farthest vertices of a mask, which is not 0.
static inline uint32_t tl_hull_decide_exactly(const tl_hull *hull, tl_vec3 direction, uint64_t mask)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t vertex = tl_lowest_bit(mask);
    for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
        uint32_t other = tl_lowest_bit(mask);
        // The rows are padded with the last vertex, whose own bit is lower.
        if (other < hull->vertex_count && tl_compare_along(direction, vertices[other], vertices[vertex]) > 0) {
            vertex = other;
        }
    }
    return vertex;
}

static inline tl_f32x8 scan_dot(const tl_climber *c, const float *x, uint32_t count)
{
    return tl_f32x8_add(
        tl_f32x8_add(tl_f32x8_mul(c->x, tl_f32x8_load(x)), tl_f32x8_mul(c->y, tl_f32x8_load(x + count))),
        tl_f32x8_mul(c->z, tl_f32x8_load(x + 2 * count)));
}

// `size` is |x| + |y| + |z| of the direction.
static inline uint32_t tl_hull_scan(const tl_hull *hull, tl_vec3 direction, const tl_climber *c, float size)
{
    _Static_assert(TL_HULL_SCAN_LIMIT <= 64, "the candidates are one word");
    _Alignas(32) float raised[TL_HULL_SCAN_LIMIT];
    uint32_t count = hull->scan_count;
    const float *rows = tl_hull_scan_rows(hull);
    tl_f32x8 slack = tl_f32x8_all(2.0f * (hull->scan_error * size + TL_SUPPORT_UNDERFLOW));
    tl_f32x8 best = scan_dot(c, rows, count);
    tl_f32x8_store(raised, tl_f32x8_add(best, slack));
    for (uint32_t i = TL_CLIMB_LANES; i < count; i += TL_CLIMB_LANES) {
        tl_f32x8 dot = scan_dot(c, rows + i, count);
        tl_f32x8_store(raised + i, tl_f32x8_add(dot, slack));
        best = tl_f32x8_max(best, dot);
    }
    best = tl_f32x8_largest(best);
    uint64_t mask = tl_f32x8_not_less(tl_f32x8_load(raised), best);
    for (uint32_t i = TL_CLIMB_LANES; i < count; i += TL_CLIMB_LANES) {
        mask |= (uint64_t)tl_f32x8_not_less(tl_f32x8_load(raised + i), best) << i;
    }
    return (mask & (mask - 1)) == 0 ? tl_lowest_bit(mask) : tl_hull_decide_exactly(hull, direction, mask);
}

#endif
