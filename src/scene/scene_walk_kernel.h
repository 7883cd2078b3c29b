// SPDX-License-Identifier: MIT
//
// The walk through the tree: one source, compiled once for each instruction set by a file that defines TL_SCENE_WALK.
//
// A visit tests eight child boxes, keeps the nearest that is entered at hand, and puts the others on the stack, sorted
// by distance. Items wait there among nodes: what an item finds shortens the line for all behind it.

#include "base/lowest_bit.h"
#include "math/simd8.h"
#include "scene/scene_walk.h"

// A child that the line enters: the bits of the time above the child word. Such times are never negative, so their bits
// have the order of their values.
typedef uint64_t walk_entry;

// Which boxes the line enters before its end, and when.
static TL_ALWAYS_INLINE uint32_t enter_boxes(const tl_scene_line *line, const tl_scene_node *node, float *times)
{
    tl_f32x8 first = tl_f32x8_all(0.0f), last = tl_f32x8_all(line->limit);
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t backward = line->backward >> i & 1u;
        tl_f32x8 scale = tl_f32x8_all(line->scale[i]);
        tl_f32x8 enter =
            tl_f32x8_mul_add(tl_f32x8_load(node->plane[2 * i + backward]), scale, tl_f32x8_all(line->near_base[i]));
        tl_f32x8 leave =
            tl_f32x8_mul_add(tl_f32x8_load(node->plane[2 * i + 1 - backward]), scale, tl_f32x8_all(line->far_base[i]));
        first = tl_f32x8_max_bits(first, enter);
        last = tl_f32x8_min_bits(last, leave);
    }
    tl_f32x8_store(times, first);
    // A negative minimum is below 0, whichever of several it is.
    return ~tl_f32x8_less_bits(last, first) & 0xffu;
}

static inline walk_entry entry_of(const tl_scene_node *node, const float *times, uint32_t lane)
{
    uint32_t bits;
    memcpy(&bits, &times[lane], sizeof bits);
    return (uint64_t)bits << 32 | node->child[lane];
}

// Puts all that is entered on the stack but the nearest, which is returned; the next nearest lies on top. The mask is
// not empty. Any order will do for any hit.
static TL_ALWAYS_INLINE walk_entry push_children(const tl_scene_node *node, const float *times, uint32_t mask, bool any,
                                                 walk_entry *stack, uint32_t *stack_count)
{
    walk_entry *base = stack + *stack_count;
    walk_entry nearest = entry_of(node, times, tl_lowest_bit(mask));
    uint32_t count = 0;
    while ((mask &= mask - 1) != 0) {
        walk_entry entry = entry_of(node, times, tl_lowest_bit(mask));
        uint32_t place = count++;
        if (!any) {
            walk_entry later = entry < nearest ? nearest : entry;
            nearest = entry < nearest ? entry : nearest;
            entry = later;
            for (; place > 0 && base[place - 1] < entry; place--) {
                base[place] = base[place - 1];
            }
        }
        base[place] = entry;
    }
    *stack_count += count;
    return nearest;
}

bool TL_SCENE_WALK(tl_scene_line *line)
{
    const tl_scene_node *nodes = tl_scene_nodes(line->scene);
    walk_entry stack[TL_SCENE_STACK_SIZE];
    uint32_t stack_count = 0;
    walk_entry entry = 0;
    for (;;) {
        uint32_t child = (uint32_t)entry, entered = 0;
        if ((child & TL_CHILD_ITEM) != 0) {
            if (!line->visit(line, child & ~TL_CHILD_ITEM)) {
                return false;
            }
        } else {
            const tl_scene_node *node = &nodes[child];
            float times[TL_SCENE_WIDTH];
            for (uint32_t mask = enter_boxes(line, node, times); mask != 0; mask &= mask - 1) {
                uint32_t bit = mask & (0u - mask);
                entered |= (node->mask[tl_lowest_bit(mask)] & line->mask) != 0 ? bit : 0;
            }
            if (entered != 0) {
                entry = push_children(node, times, entered, line->any, stack, &stack_count);
                continue;
            }
        }
        // What waits is left out when the line has become too short for it.
        uint32_t limit;
        memcpy(&limit, &line->limit, sizeof limit);
        do {
            if (stack_count == 0) {
                return true;
            }
            entry = stack[--stack_count];
        } while (entry >> 32 > limit);
    }
}
