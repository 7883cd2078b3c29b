// SPDX-License-Identifier: MIT
//
// Support by hill climbing over blocks: the vectors from a vertex to its neighbours lie side by side, so one step loads
// two cache lines, takes eight dot products at once and follows a link to the next block.
//
// Vectors and not positions: whether a neighbour is farther is the sign of direction . (neighbour - vertex), whose
// error bound is a few roundings of that short vector, however far from the origin the hull lies. A step is taken only
// when the gain is certain, so the climb cannot run in circles; an end that is not certain is handed to the exact
// climb.

#include "hull/support.h"

#include "hull/lanes.h"
#include "math/tolerance.h"

// A vector rounded once, a product, two sums; the sum of magnitudes and the two comparisons' own roundings: less than
// eight in a row.
#define EDGE_ERROR TL_FLOAT_GAMMA(8)

typedef struct climber {
    tl_lanes x, y, z;
    tl_lanes abs_x, abs_y, abs_z;
} climber;

static inline climber make_climber(tl_vec3 direction)
{
    climber c = { tl_lanes_all(direction.x),
                  tl_lanes_all(direction.y),
                  tl_lanes_all(direction.z),
                  tl_lanes_all(fabsf(direction.x) * EDGE_ERROR),
                  tl_lanes_all(fabsf(direction.y) * EDGE_ERROR),
                  tl_lanes_all(fabsf(direction.z) * EDGE_ERROR) };
    return c;
}

// The gains of four neighbours, and their error bounds.
static inline tl_lanes gains(const climber *c, const tl_climb_block *block, uint32_t lane, tl_lanes *errors_out)
{
    tl_lanes x = tl_lanes_load(block->x + lane);
    tl_lanes y = tl_lanes_load(block->y + lane);
    tl_lanes z = tl_lanes_load(block->z + lane);
    *errors_out =
        tl_lanes_add(tl_lanes_add(tl_lanes_mul(c->abs_x, tl_lanes_abs(x)), tl_lanes_mul(c->abs_y, tl_lanes_abs(y))),
                     tl_lanes_mul(c->abs_z, tl_lanes_abs(z)));
    return tl_lanes_add(tl_lanes_add(tl_lanes_mul(c->x, x), tl_lanes_mul(c->y, y)), tl_lanes_mul(c->z, z));
}

static inline uint32_t not_surely_lower(const climber *c, const tl_climb_block *block)
{
    tl_lanes error0, error1;
    tl_lanes gain0 = gains(c, block, 0, &error0);
    tl_lanes gain1 = gains(c, block, 4, &error1);
    tl_lanes limit = tl_lanes_all(-TL_SUPPORT_UNDERFLOW);
    return tl_lanes_mask_ge(tl_lanes_max(tl_lanes_add(gain0, error0), tl_lanes_add(gain1, error1)), limit);
}

bool tl_hull_climb_is_farthest(const tl_hull *hull, tl_vec3 direction, uint32_t block)
{
    climber c = make_climber(direction);
    const tl_climb_block *at = tl_hull_blocks(hull) + block;
    while (not_surely_lower(&c, at) == 0) {
        if ((at->link[0] & TL_CLIMB_MORE) == 0) {
            return true;
        }
        at++;
    }
    return false;
}

uint32_t tl_hull_climb(const tl_hull *hull, tl_vec3 direction, uint32_t block)
{
    climber c = make_climber(direction);
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    for (;;) {
        const tl_climb_block *at = blocks + block;
        uint32_t open = 0, next = block;
        float best = TL_SUPPORT_UNDERFLOW;
        bool more;
        do {
            tl_lanes error0, error1;
            tl_lanes gain0 = gains(&c, at, 0, &error0);
            tl_lanes gain1 = gains(&c, at, 4, &error1);
            tl_lanes upper = tl_lanes_max(tl_lanes_add(gain0, error0), tl_lanes_add(gain1, error1));
            more = (at->link[0] & TL_CLIMB_MORE) != 0;
            uint32_t not_lower = tl_lanes_mask_ge(upper, tl_lanes_all(-TL_SUPPORT_UNDERFLOW));
            if (not_lower != 0) {
                open |= not_lower;
                tl_lanes lower0 = tl_lanes_sub(gain0, error0), lower1 = tl_lanes_sub(gain1, error1);
                float largest = tl_lanes_largest(tl_lanes_max(lower0, lower1));
                if (largest > best) {
                    tl_lanes all = tl_lanes_all(largest);
                    uint32_t lanes = tl_lanes_mask_ge(lower0, all) | tl_lanes_mask_ge(lower1, all) << 4;
                    best = largest;
                    next = at->link[tl_lowest_bit(lanes)] & ~TL_CLIMB_MORE;
                }
            }
            at++;
        } while (more);
        if (open == 0) {
            return tl_hull_block_vertices(hull)[block];
        }
        if (next == block) {
            return tl_hull_climb_exact(hull, direction, tl_hull_block_vertices(hull)[block]);
        }
        block = next;
    }
}
