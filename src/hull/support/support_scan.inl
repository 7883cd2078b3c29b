// SPDX-License-Identifier: MIT
//
// Support by scan: all dot products of a small hull, eight at a time.
//
// The first pass keeps only the maximum, so it has no index to carry; the second compares the kept products, raised by
// twice their error bound, with it. Raised, and not the maximum lowered: that would be one more step after the last
// one. Nearly always one vertex remains; else the remaining ones are compared exactly.

#ifndef TALUS_SRC_HULL_SUPPORT_SCAN_H
#define TALUS_SRC_HULL_SUPPORT_SCAN_H

#include "base/compiler.h"
#include "hull/support/support_climb.inl"

static inline tl_f32x8 scan_dot(const tl_climber *c, const float *x, uint32_t count)
{
    return tl_f32x8_add(
        tl_f32x8_add(tl_f32x8_mul(c->x, tl_f32x8_load(x)), tl_f32x8_mul(c->y, tl_f32x8_load(x + count))),
        tl_f32x8_mul(c->z, tl_f32x8_load(x + 2 * count)));
}

static inline tl_f32x8 scan_step(const tl_climber *c, const float *rows, uint32_t count, tl_f32x8 slack, float *raised)
{
    tl_f32x8 dot = scan_dot(c, rows, count);
    tl_f32x8_store(raised, tl_f32x8_add(dot, slack));
    return dot;
}

// Those among more, whose rows come in pairs of eight: two strands, for a maximum waits for the one before it.
static inline uint64_t scan_pairs(const tl_climber *c, const float *rows, uint32_t count, tl_f32x8 slack)
{
    enum { SCAN_LANES = TL_CLIMB_LANES, SCAN_PAIR = TL_SCAN_PAIR };
    _Static_assert(TL_HULL_SCAN_LIMIT <= 64 && TL_HULL_SCAN_LIMIT % SCAN_PAIR == 0, "the candidates are one word");
    _Alignas(32) float raised[TL_HULL_SCAN_LIMIT];
    tl_f32x8 best = scan_step(c, rows, count, slack, raised);
    tl_f32x8 second = scan_step(c, rows + SCAN_LANES, count, slack, raised + SCAN_LANES);
    for (uint32_t i = SCAN_PAIR; i < count; i += SCAN_PAIR) {
        best = tl_f32x8_max(best, scan_step(c, rows + i, count, slack, raised + i));
        second = tl_f32x8_max(second, scan_step(c, rows + i + SCAN_LANES, count, slack, raised + i + SCAN_LANES));
    }
    best = tl_f32x8_largest(tl_f32x8_max(best, second));
    uint64_t mask = 0;
    for (uint32_t i = 0; i < count; i += SCAN_PAIR) {
        uint32_t a = tl_f32x8_not_less(tl_f32x8_load(raised + i), best);
        uint32_t b = tl_f32x8_not_less(tl_f32x8_load(raised + i + SCAN_LANES), best);
        mask |= (uint64_t)(a | b << SCAN_LANES) << i;
    }
    return mask;
}

// `size` is |x| + |y| + |z| of the direction.
static inline tl_f32x8 scan_slack(const tl_hull *hull, float size)
{
    return tl_f32x8_all(2.0f * (hull->scan_error * size + TL_SUPPORT_UNDERFLOW));
}

static inline uint32_t scan_decide(const tl_hull *hull, float x, float y, float z, uint64_t mask)
{
    return (mask & (mask - 1)) == 0 ? tl_lowest_bit(mask) : tl_hull_decide_exact(hull, x, y, z, mask);
}

// Not inlined: its rows' products need a frame that no other way through the query should pay for.
static TL_NOINLINE uint32_t tl_hull_scan(const tl_hull *hull, float x, float y, float z, float size)
{
    const tl_climber c = tl_climber_make(x, y, z);
    const float *rows = tl_hull_scan_rows(hull);
    return scan_decide(hull, x, y, z, scan_pairs(&c, rows, tl_hull_scan_count(hull), scan_slack(hull, size)));
}

// One vertex's dot product: the bits of its lane.
static inline tl_f32x8 scan_dot_of(float x, float y, float z, const float *rows, uint32_t count, uint32_t vertex)
{
    return tl_f32x8_all(x * rows[vertex] + y * rows[count + vertex] + z * rows[2 * count + vertex]);
}

// Of up to eight vertices, whose products need not leave the registers. A hint is right when all the others are less
// for certain: the processor goes on with it while they are compared.
static inline uint32_t scan_eight(const tl_hull *hull, float x, float y, float z, const tl_climber *c, float size,
                                  uint32_t hint)
{
    const float *rows = (const float *)(hull + 1);
    tl_f32x8 dot = scan_dot(c, rows, TL_CLIMB_LANES), raised = tl_f32x8_add(dot, scan_slack(hull, size));
    if (hint < hull->vertex_count &&
        tl_f32x8_not_less(raised, scan_dot_of(x, y, z, rows, TL_CLIMB_LANES, hint)) == 1u << hint) {
        return hint;
    }
    return scan_decide(hull, x, y, z, tl_f32x8_not_less(raised, tl_f32x8_largest(dot)));
}

// Of up to sixteen.
static inline uint32_t scan_sixteen(const tl_hull *hull, float x, float y, float z, const tl_climber *c, float size,
                                    uint32_t hint)
{
    const float *rows = (const float *)(hull + 1);
    tl_f32x8 slack = scan_slack(hull, size);
    tl_f32x8 low = scan_dot(c, rows, TL_SCAN_PAIR), high = scan_dot(c, rows + TL_CLIMB_LANES, TL_SCAN_PAIR);
    tl_f32x8 low_raised = tl_f32x8_add(low, slack), high_raised = tl_f32x8_add(high, slack);
    if (hint < hull->vertex_count) {
        tl_f32x8 best = scan_dot_of(x, y, z, rows, TL_SCAN_PAIR, hint);
        if ((tl_f32x8_not_less(low_raised, best) | tl_f32x8_not_less(high_raised, best) << TL_CLIMB_LANES) ==
            1u << hint) {
            return hint;
        }
    }
    tl_f32x8 best = tl_f32x8_largest(tl_f32x8_max(low, high));
    return scan_decide(hull, x, y, z,
                       tl_f32x8_not_less(low_raised, best) | tl_f32x8_not_less(high_raised, best) << TL_CLIMB_LANES);
}

// Of up to TL_HULL_FEW, which have no blocks to test a hint by.
static inline uint32_t tl_hull_scan_few(const tl_hull *hull, float x, float y, float z, const tl_climber *c, float size,
                                        uint32_t hint)
{
    return hull->vertex_count <= TL_CLIMB_LANES ? scan_eight(hull, x, y, z, c, size, hint)
                                                : scan_sixteen(hull, x, y, z, c, size, hint);
}

#endif
