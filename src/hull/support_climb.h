// SPDX-License-Identifier: MIT
//
// Support by hill climbing over blocks: the vectors from a vertex to its neighbours lie side by side, so one step loads
// two cache lines, takes eight dot products at once and follows a link to the next block.
//
// Vectors and not positions: whether a neighbour is farther is the sign of direction . (neighbour - vertex), whose
// error bound is a few roundings of that short vector, however far from the origin the hull lies. A step is taken only
// when the gain is certain, so the climb cannot run in circles; an end that is not certain is handed to the exact
// climb. The bound is one number a block: to take it lane by lane would be tighter and cost as much as the products.

#ifndef TALUS_SRC_HULL_SUPPORT_CLIMB_H
#define TALUS_SRC_HULL_SUPPORT_CLIMB_H

#include "hull/lanes.h"
#include "hull/support.h"

typedef struct tl_climber {
    tl_lanes x, y, z;
    float size; // |x| + |y| + |z|
} tl_climber;

static inline tl_climber tl_climber_make(tl_vec3 d)
{
    tl_climber c = { tl_lanes_all(d.x), tl_lanes_all(d.y), tl_lanes_all(d.z), fabsf(d.x) + fabsf(d.y) + fabsf(d.z) };
    return c;
}

// The gains of four neighbours.
static inline tl_lanes tl_climber_gains(const tl_climber *c, const tl_climb_block *block, uint32_t lane)
{
    return tl_lanes_add(tl_lanes_add(tl_lanes_mul(c->x, tl_lanes_load(block->x + lane)),
                                     tl_lanes_mul(c->y, tl_lanes_load(block->y + lane))),
                        tl_lanes_mul(c->z, tl_lanes_load(block->z + lane)));
}

// Whether the block's vertex is proven to be the only farthest one.
static inline bool tl_hull_climb_is_farthest(const tl_hull *hull, const tl_climber *c, uint32_t block)
{
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    const float *errors = tl_hull_block_errors(hull);
    for (;; block++) {
        tl_lanes best = tl_lanes_max(tl_climber_gains(c, &blocks[block], 0), tl_climber_gains(c, &blocks[block], 4));
        float error = errors[block] * c->size + TL_SUPPORT_UNDERFLOW;
        if (tl_lanes_mask_ge(best, tl_lanes_all(-error)) != 0) {
            return false;
        }
        if ((blocks[block].link[0] & TL_CLIMB_MORE) == 0) {
            return true;
        }
    }
}

// Climbs from a block to the farthest vertex. TL_NO_VERTEX when rounding leaves the end open: `block` is where then.
static inline uint32_t tl_hull_climb(const tl_hull *hull, const tl_climber *c, uint32_t *block)
{
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    const float *errors = tl_hull_block_errors(hull);
    for (;;) {
        uint32_t at = *block, next = at;
        float gain = 0.0f;
        bool open = false, more;
        do {
            tl_lanes gain0 = tl_climber_gains(c, &blocks[at], 0), gain1 = tl_climber_gains(c, &blocks[at], 4);
            tl_lanes best = tl_lanes_max(gain0, gain1);
            float error = errors[at] * c->size + TL_SUPPORT_UNDERFLOW;
            more = (blocks[at].link[0] & TL_CLIMB_MORE) != 0;
            if (tl_lanes_mask_ge(best, tl_lanes_all(-error)) != 0) {
                float largest = tl_lanes_largest(best);
                open = true;
                if (largest > error && largest > gain) {
                    tl_lanes all = tl_lanes_all(largest);
                    gain = largest;
                    next = blocks[at]
                               .link[tl_lowest_bit(tl_lanes_mask_ge(gain0, all) | tl_lanes_mask_ge(gain1, all) << 4)];
                }
            }
            at++;
        } while (more);
        if (!open) {
            return tl_hull_block_vertices(hull)[*block];
        }
        if (next == *block) {
            return TL_NO_VERTEX;
        }
        *block = next & ~TL_CLIMB_MORE;
    }
}

#endif
