// SPDX-License-Identifier: MIT
//
// The farthest vertices of a row of directions, for the direction table.
//
// On a line of directions each vertex is farthest over one interval, and the neighbour that overtakes it first is the
// next one's. So the cost is that of one climb's step for each interval, not for each direction. Nothing is proven
// here: the table only says where a climb starts.

#ifndef TALUS_SRC_HULL_SUPPORT_MARCH_H
#define TALUS_SRC_HULL_SUPPORT_MARCH_H

#include "hull/support/support_climb.inl"

// Where wedges crowd, so many changes of vertex within one cell end the march.
#define TL_MARCH_CHANGES 8u

static inline tl_f32x8 tl_climber_dot(const tl_climber *c, const tl_climb_block *block)
{
    return tl_f32x8_add(
        tl_f32x8_add(tl_f32x8_mul(c->x, tl_f32x8_load(block->x)), tl_f32x8_mul(c->y, tl_f32x8_load(block->y))),
        tl_f32x8_mul(c->z, tl_f32x8_load(block->z)));
}

// For directions from + k step, 0 <= k < count, `vertex` being that of `from`: writes 1 .. count cells, returns how
// many.
static inline uint32_t tl_hull_march_blocks(const tl_hull *hull, tl_vec3 from, tl_vec3 step, uint32_t count,
                                            uint32_t vertex, uint32_t *cells)
{
    const tl_climb_block *blocks = tl_hull_blocks(hull);
    tl_climber here = tl_climber_make(from.x, from.y, from.z), onward = tl_climber_make(step.x, step.y, step.z);
    tl_f32x8 never = tl_f32x8_all(-INFINITY), zero = tl_f32x8_all(0.0f);
    uint32_t filled = 0;
    cells[filled++] = vertex;
    for (uint32_t changes = 0; filled < count && changes < TL_MARCH_CHANGES; changes++) {
        float overtaken = INFINITY;
        uint32_t next = vertex;
        for (uint32_t at = vertex; at != TL_NO_VERTEX; at = tl_climb_block_after(&blocks[at])) {
            tl_f32x8 gain = tl_climber_dot(&here, &blocks[at]), rate = tl_climber_dot(&onward, &blocks[at]);
            // Minus the k at which a neighbour overtakes.
            tl_f32x8 k = tl_f32x8_if_less(zero, rate, tl_f32x8_div(gain, rate), never), first = tl_f32x8_largest(k);
            if (-tl_f32x8_first(first) < overtaken) {
                overtaken = -tl_f32x8_first(first);
                next = blocks[at].link[tl_lowest_bit(tl_f32x8_not_less(k, first))];
            }
        }
        while (filled < count && (float)filled <= overtaken) {
            cells[filled++] = vertex;
            changes = 0;
        }
        vertex = next;
    }
    return filled;
}

#endif
