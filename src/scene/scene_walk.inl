// SPDX-License-Identifier: MIT
//
// Traversal of the top-level BVH: one source, compiled once for each instruction set by a file that defines
// TL_SCENE_WALK.
//
// A visit tests eight child boxes, continues with the nearest that is entered, and puts the others on the stack, sorted
// by distance. Instances wait there among nodes: a hit in one instance shortens the line for all behind it.

#include "base/assert.h"
#include "base/compiler.h"
#include "base/lowest_bit.h"
#include "math/simd8.h"
#include "scene/scene_walk.h"

// A child that the line enters, with the bits of its key above the child word: the time when, or, where any hit will
// do, how short the line's part inside is, since a long one is the likelier to end there. Keys are never negative, so
// their bits have the order of their values.
typedef uint64_t scene_entry;

// Byte offsets in a node of the planes by which a line enters boxes, indexed by its bits `backward`. It leaves by those
// of ~backward.
static const uint32_t scene_rows[8][3] = { { 0, 64, 128 }, { 32, 64, 128 }, { 0, 96, 128 }, { 32, 96, 128 },
                                           { 0, 64, 160 }, { 32, 64, 160 }, { 0, 96, 160 }, { 32, 96, 160 } };
static_assert(sizeof(((tl_scene_node *)0)->plane[0]) == 32, "rows of walk_rows");

typedef struct walk_place {
    const tl_scene_node *nodes;
    const tl_scene_record *records;
    const uint32_t *near_rows, *far_rows;
} walk_place;

static inline tl_f32x8 load_row(const tl_scene_node *node, uint32_t row)
{
    return tl_f32x8_load((const float *)(const void *)((const char *)node + row));
}

// Which boxes the line enters before its end; and when, or for how long when any hit will do.
static TL_ALWAYS_INLINE uint32_t enter_instance_boxes(const tl_scene_line *line, const walk_place *place,
                                                      const tl_scene_node *node, float *keys)
{
    tl_f32x8 first = tl_f32x8_all(0.0f), last = tl_f32x8_all(line->limit);
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x8 scale = tl_f32x8_all(line->scale[i]);
        tl_f32x8 enter = tl_f32x8_mul_add(load_row(node, place->near_rows[i]), scale, tl_f32x8_all(line->near_base[i]));
        tl_f32x8 leave = tl_f32x8_mul_add(load_row(node, place->far_rows[i]), scale, tl_f32x8_all(line->far_base[i]));
        first = tl_f32x8_max_bits(first, enter);
        last = tl_f32x8_min_bits(last, leave);
    }
    tl_f32x8_store(keys, line->any ? tl_f32x8_sub(last, first) : first);
    // A negative minimum is below 0, whichever of several it is.
    return ~tl_f32x8_less_bits(last, first) & 0xffu;
}

// The entered children below which some instance counts.
static TL_NOINLINE uint32_t mask_children(const tl_scene_node *node, uint32_t entered, uint32_t mask)
{
    uint32_t chosen = 0;
    for (uint32_t rest = entered; rest != 0; rest &= rest - 1) {
        chosen |= (node->mask[tl_lowest_bit(rest)] & mask) != 0 ? rest & (0u - rest) : 0;
    }
    return chosen;
}

// A child on the stack is mostly visited soon, and its cache lines are then on their way.
static inline void prefetch_scene_child(const tl_scene_line *line, const walk_place *place, uint32_t child)
{
    uint32_t instance = child & ~TL_CHILD_INSTANCE;
    bool is_instance = instance != child;
    const char *at = is_instance ? (const char *)&place->records[instance] : (const char *)&place->nodes[child];
    tl_prefetch(at);
    tl_prefetch(at + 64);
    tl_prefetch(is_instance ? (const char *)&line->instances[instance] : at + 128);
}

static inline scene_entry entry_of(const tl_scene_line *line, const tl_scene_node *node, const float *keys,
                                   uint32_t lane)
{
    uint32_t bits;
    memcpy(&bits, &keys[lane], sizeof bits);
    bits ^= line->any ? INT32_MAX : 0; // the longest first
    return (uint64_t)bits << 32 | node->child[lane];
}

static inline scene_entry earlier_entry(scene_entry a, scene_entry b)
{
    return a < b ? a : b;
}

static inline scene_entry later_entry(scene_entry a, scene_entry b)
{
    return a < b ? b : a;
}

// Puts all entered children but the first by key on the stack, and returns that one; the next lies on top. The mask is
// not empty.
static TL_ALWAYS_INLINE scene_entry push_scene_children(const tl_scene_line *line, const walk_place *place,
                                                        const tl_scene_node *node, const float *keys, uint32_t mask,
                                                        scene_entry *stack, uint32_t *stack_count)
{
    scene_entry *base = stack + *stack_count;
    scene_entry nearest = entry_of(line, node, keys, tl_lowest_bit(mask));
    mask &= mask - 1;
    if (mask == 0) {
        return nearest;
    }
    scene_entry second = entry_of(line, node, keys, tl_lowest_bit(mask));
    base[0] = later_entry(nearest, second);
    nearest = earlier_entry(nearest, second);
    prefetch_scene_child(line, place, (uint32_t)base[0]);
    uint32_t count = 1;
    while ((mask &= mask - 1) != 0) {
        scene_entry entry = entry_of(line, node, keys, tl_lowest_bit(mask));
        uint32_t at = count++;
        scene_entry later = later_entry(entry, nearest);
        nearest = earlier_entry(entry, nearest);
        prefetch_scene_child(line, place, (uint32_t)later);
        for (; at > 0 && base[at - 1] < later; at--) {
            base[at] = base[at - 1];
        }
        base[at] = later;
    }
    *stack_count += count;
    return nearest;
}

bool TL_SCENE_WALK(tl_scene_line *line)
{
    walk_place place;
    place.nodes = tl_scene_nodes(line->scene);
    place.records = tl_scene_records(line->scene);
    place.near_rows = scene_rows[line->backward];
    place.far_rows = scene_rows[~line->backward & 7u];
    scene_entry stack[TL_SCENE_STACK_SIZE];
    uint32_t stack_count = 0;
    scene_entry entry = 0;
    for (;;) {
        uint32_t child = (uint32_t)entry;
        if ((child & TL_CHILD_INSTANCE) != 0) {
            if (!line->visit(line, child & ~TL_CHILD_INSTANCE)) {
                return false;
            }
        } else {
            const tl_scene_node *node = &place.nodes[child];
            float keys[TL_SCENE_WIDTH];
            uint32_t entered = enter_instance_boxes(line, &place, node, keys);
            if (line->mask != UINT32_MAX) {
                entered = mask_children(node, entered, line->mask);
            }
            if (entered != 0) {
                entry = push_scene_children(line, &place, node, keys, entered, stack, &stack_count);
                continue;
            }
        }
        // Waiting entries are dropped when the line has become too short for them.
        uint32_t limit;
        memcpy(&limit, &line->limit, sizeof limit);
        do {
            if (stack_count == 0) {
                return true;
            }
            entry = stack[--stack_count];
        } while (!line->any && entry >> 32 > limit);
    }
}
