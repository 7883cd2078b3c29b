// SPDX-License-Identifier: MIT
//
// Support by hill climbing over blocks: the vectors from a vertex to its neighbours lie side by side, so one step loads
// two cache lines, takes eight dot products at once and follows a link to the next vertex.
//
// Vectors and not positions: whether a neighbour is farther is the sign of direction . (neighbour - vertex), whose
// error bound is a few roundings of the sum of its three absolute products, however far from the origin the hull lies.
// The bound is taken lane by lane: one for the block would be that of its longest edge, and leave a prism of many
// corners, whose long edges stand beside very short ones, undecided most of the time.
//
// A step is taken only when the gain is certain, so the climb cannot run in circles; what is open at its end is
// compared exactly.

#ifndef TALUS_SRC_HULL_SUPPORT_CLIMB_H
#define TALUS_SRC_HULL_SUPPORT_CLIMB_H

#include "base/lowest_bit.h"
#include "hull/support/hull_support.h"
#include "math/simd8.h"
#include "math/tolerance.h"

// A vector is rounded once; then a product, two sums, and what is made of them takes three more roundings.
#define TL_CLIMB_ERROR TL_FLOAT_GAMMA(8)

typedef struct tl_climber {
    tl_f32x8 x, y, z;
} tl_climber;

static inline tl_climber tl_climber_make(float x, float y, float z)
{
    tl_climber c = { tl_f32x8_all(x), tl_f32x8_all(y), tl_f32x8_all(z) };
    return c;
}

// direction . each neighbour's vector, and the sum of the three products' sizes, which bounds how wrong it may be.
typedef struct tl_climb_gains {
    tl_f32x8 gain, size;
} tl_climb_gains;

static inline tl_climb_gains tl_climber_gains_at(const tl_climber *c, const tl_climb_block *block)
{
    tl_f32x8 x = tl_f32x8_mul(c->x, tl_f32x8_load(block->x));
    tl_f32x8 y = tl_f32x8_mul(c->y, tl_f32x8_load(block->y));
    tl_f32x8 z = tl_f32x8_mul(c->z, tl_f32x8_load(block->z));
    tl_climb_gains g = { tl_f32x8_add(tl_f32x8_add(x, y), z),
                         tl_f32x8_add(tl_f32x8_add(tl_f32x8_abs(x), tl_f32x8_abs(y)), tl_f32x8_abs(z)) };
    return g;
}

// Bit i: neighbour i may be as far as the vertex itself, or farther.
static inline uint32_t tl_climber_open(tl_climb_gains g)
{
    return tl_f32x8_not_less(tl_f32x8_mul_add(g.size, tl_f32x8_all(TL_CLIMB_ERROR), g.gain),
                             tl_f32x8_all(-TL_SUPPORT_UNDERFLOW));
}

// The block that goes on with the neighbours of the same vertex, TL_NO_VERTEX when there is none.
static inline uint32_t tl_climb_block_after(const tl_climb_block *block)
{
    uint32_t link = block->link[TL_CLIMB_LANES - 1];
    return (link & TL_CLIMB_MORE) != 0 ? link & ~TL_CLIMB_MORE : TL_NO_VERTEX;
}

// What the first blocks of a vertex and of one neighbour tell.
typedef enum tl_climb_look {
    TL_LOOK_PROVEN, // the vertex is the only farthest one
    TL_LOOK_HUB,    // none in its first block is farther; it has more of them
    TL_LOOK_FAR     // neither
} tl_climb_look;

// Looks whether a vertex is the farthest, or else the only neighbour of it that may be farther: `vertex` is that then.
// A direction that has turned a little leaves a vertex over one of its edges; one that has nothing to do with it has
// half of the neighbours farther, and there is no use in going on from here. Five lanes tell, for the last ones often
// repeat the first neighbour; what they miss costs time only.
static inline tl_climb_look tl_climber_look(const tl_climber *c, const tl_climb_block *blocks, uint32_t *vertex)
{
    const tl_climb_block *block = &blocks[*vertex];
    uint32_t open = tl_climber_open(tl_climber_gains_at(c, block));
    if (open != 0) {
        if ((open & (open - 1) & 0x1fu) != 0) {
            return TL_LOOK_FAR;
        }
        *vertex = block->link[tl_lowest_bit(open)];
        block = &blocks[*vertex];
        open = tl_climber_open(tl_climber_gains_at(c, block));
    }
    return open != 0 ? TL_LOOK_FAR : tl_climb_block_after(block) == TL_NO_VERTEX ? TL_LOOK_PROVEN : TL_LOOK_HUB;
}

// Climbs from a vertex to the farthest one. False when rounding leaves the end open: `vertex` is where then.
static inline bool tl_hull_climb_blocks(const tl_hull *hull, const tl_climber *c, uint32_t *vertex)
{
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    for (;;) {
        uint32_t next = *vertex;
        float min_gain = TL_SUPPORT_UNDERFLOW;
        bool open = false;
        for (uint32_t at = *vertex; at != TL_NO_VERTEX; at = tl_climb_block_after(&blocks[at])) {
            tl_climb_gains g = tl_climber_gains_at(c, &blocks[at]);
            if (tl_climber_open(g) == 0) {
                continue;
            }
            open = true;
            tl_f32x8 certain = tl_f32x8_mul_sub_from(g.size, tl_f32x8_all(TL_CLIMB_ERROR), g.gain);
            tl_f32x8 best = tl_f32x8_largest(certain);
            if (tl_f32x8_first(best) > min_gain) {
                min_gain = tl_f32x8_first(best);
                next = blocks[at].link[tl_lowest_bit(tl_f32x8_not_less(certain, best))];
            }
        }
        if (!open) {
            return true;
        }
        if (next == *vertex) {
            return false;
        }
        *vertex = next;
    }
}

#endif
