// SPDX-License-Identifier: MIT
//
// Traversal of the top-level BVH: one source, compiled once for each instruction set by a file that defines
// TL_SCENE_WALK.
//
// A visit tests sixteen child boxes and continues with the nearest that is entered; the others wait in its frame on the
// stack, instances among nodes: a hit in one instance shortens the line for all behind it.

#include "base/assert.h"
#include "base/compiler.h"
#include "math/simd16.h"
#include "scene/scene_ray.inl"

// 12 u, and what the bound itself rounds.
#define LINE_ERROR TL_FLOAT_GAMMA(12.2)

// Products of what is farther away could overflow.
#define MAX_LINE_REACH 1e15f

// Shorter directions are denormal in an instance's space, where roundings are no longer relative.
#define SHORTEST        1e-30f

#define LARGEST_INVERSE 0x1p70f

// Directions whose largest component is within these bounds are tested against instances' own boxes.
#define USUAL_DIRECTION 0x1p20f

// Byte offsets in a node of the planes by which a line enters boxes, indexed by its bits `backward`. It leaves by those
// of ~backward.
static const uint32_t scene_rows[8][3] = { { 0, 128, 256 }, { 64, 128, 256 }, { 0, 192, 256 }, { 64, 192, 256 },
                                           { 0, 128, 320 }, { 64, 128, 320 }, { 0, 192, 320 }, { 64, 192, 320 } };
static_assert(sizeof(((tl_scene_node *)0)->plane[0]) == 64, "rows of scene_rows");

// The nodes on the path from the root, each with the children that wait in it. A child's key is the time when the line
// enters its box, or, where any hit will do, how much shorter its part inside is than the longest, since a long one is
// the likelier to end there. Keys are never negative, so their bits have the order of their values; the lowest four
// hold the lane. The next child is the least lane: nothing is sorted, and no branch depends on how many children there
// are.
typedef struct scene_stack {
    _Alignas(64) float keys[TL_SCENE_MAX_DEPTH][TL_SCENE_WIDTH];
    const tl_scene_node *node[TL_SCENE_MAX_DEPTH];
} scene_stack;

// Of a lane that is not there: beyond any number, as bits.
#define NO_SCENE_KEY   0x7ffffff0u
#define SCENE_KEY_LANE 15u

#define SIXTEEN_OF(x)  x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x
static const uint32_t key_bits[TL_SCENE_WIDTH] = { SIXTEEN_OF(NO_SCENE_KEY) };
static const uint32_t key_lanes[TL_SCENE_WIDTH] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
// The sixteen from 15 - i on take lane i out.
static const uint32_t taken_lanes[2 * TL_SCENE_WIDTH] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, NO_SCENE_KEY };

static inline tl_f32x16 bit_lanes(const uint32_t *sixteen)
{
    return tl_f32x16_load((const float *)(const void *)sixteen);
}

static inline tl_f32x16 load_row(const tl_scene_node *node, uint32_t row)
{
    return tl_f32x16_load((const float *)(const void *)((const char *)node + row));
}

// The keys of the boxes that the line enters before its end.
static TL_ALWAYS_INLINE tl_f32x16 enter_instance_boxes(const tl_scene_line *line, const tl_scene_node *node, bool any)
{
    const uint32_t *near_rows = scene_rows[line->backward], *far_rows = scene_rows[~line->backward & 7u];
    tl_f32x16 first = tl_f32x16_all(0.0f), last = tl_f32x16_all(line->limit);
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 scale = tl_f32x16_all(line->scale[i]);
        tl_f32x16 enter = tl_f32x16_mul_add(load_row(node, near_rows[i]), scale, tl_f32x16_all(line->near_base[i]));
        tl_f32x16 leave = tl_f32x16_mul_add(load_row(node, far_rows[i]), scale, tl_f32x16_all(line->far_base[i]));
        first = tl_f32x16_max_bits(first, enter);
        last = tl_f32x16_min_bits(last, leave);
    }
    // A negative minimum is below 0, whichever of several it is.
    tl_f32x16 missed = tl_f32x16_where_less_bits(last, first), key = first;
    if (any) {
        tl_f32x16 shorter = tl_f32x16_sub(tl_f32x16_all(line->longest), tl_f32x16_sub(last, first));
        key = tl_f32x16_max_bits(shorter, tl_f32x16_all(0.0f));
    }
    return tl_f32x16_or(tl_f32x16_and(tl_f32x16_or(key, missed), bit_lanes(key_bits)), bit_lanes(key_lanes));
}

// Takes out the children below which no instance counts.
static TL_NOINLINE void mask_children(const tl_scene_node *node, uint32_t mask, float *keys)
{
    for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
        if ((node->mask[i] & mask) == 0) {
            const uint32_t none = NO_SCENE_KEY | i;
            memcpy(&keys[i], &none, sizeof none);
        }
    }
}

// Keys beyond the line's end are of no use any more.
static inline uint32_t last_key(const tl_scene_line *line, bool any)
{
    uint32_t bits;
    memcpy(&bits, &line->limit, sizeof bits);
    return any ? NO_SCENE_KEY - 1 : bits | SCENE_KEY_LANE;
}

static TL_ALWAYS_INLINE bool visit_on_line(tl_scene_line *line, uint32_t instance, tl_scene_line_kind kind)
{
    return kind == TL_SCENE_LINE_RAY     ? visit_by_ray(line, instance)
           : kind == TL_SCENE_LINE_SIGHT ? visit_by_sight(line, instance)
                                         : line->visit(line, instance);
}

static inline void prefetch_scene_child(const tl_scene_line *line, const tl_scene_node *nodes, uint32_t child)
{
    uint32_t instance = child & ~TL_CHILD_INSTANCE;
    const tl_scene_record *records = tl_scene_records(line->scene);
    const char *at = instance != child ? (const char *)&records[instance] : (const char *)&nodes[child];
    tl_prefetch(at);
    tl_prefetch(at + 64);
}

static TL_ALWAYS_INLINE bool walk_scene(tl_scene_line *line, tl_scene_line_kind kind, bool any)
{
    const tl_scene_node *nodes = tl_scene_nodes(line->scene), *node = nodes;
    scene_stack stack;
    uint32_t waiting = 0; // nodes
    uint32_t last = last_key(line, any);
    for (;;) {
        tl_prefetch(node->child); // needed last, and not beside the planes
        tl_f32x16 keys = enter_instance_boxes(line, node, any);
        if (line->mask != UINT32_MAX) {
            tl_f32x16_store(stack.keys[waiting], keys);
            mask_children(node, line->mask, stack.keys[waiting]);
            keys = tl_f32x16_load(stack.keys[waiting]);
        }
        uint32_t least = tl_f32x16_least_bits(keys);
        for (;;) {
            if (least > last) {
                if (waiting == 0) {
                    return true;
                }
                waiting--;
                keys = tl_f32x16_load(stack.keys[waiting]);
                node = stack.node[waiting];
                least = tl_f32x16_least_bits(keys);
                continue;
            }
            uint32_t child = node->child[least & SCENE_KEY_LANE];
            keys = tl_f32x16_or(keys, bit_lanes(&taken_lanes[SCENE_KEY_LANE - (least & SCENE_KEY_LANE)]));
            least = tl_f32x16_least_bits(keys);
            if ((child & TL_CHILD_INSTANCE) == 0) {
                tl_f32x16_store(stack.keys[waiting], keys);
                stack.node[waiting] = node;
                waiting += least < NO_SCENE_KEY;
                node = &nodes[child];
                break;
            }
            prefetch_scene_child(line, nodes, node->child[least & SCENE_KEY_LANE]);
            if (!visit_on_line(line, child & ~TL_CHILD_INSTANCE, kind)) {
                return false;
            }
            last = last_key(line, any);
        }
    }
}

static TL_ALWAYS_INLINE tl_f32x4 sum_of_three(tl_f32x4 a)
{
    return tl_f32x4_all(tl_f32x4_get_x(a) + tl_f32x4_get_y(a) + tl_f32x4_get_z(a));
}

// What is computed once a line. False: it is out of range for the filters.
static TL_ALWAYS_INLINE bool prepare_line(tl_scene_line *line)
{
    tl_f32x4 from = tl_f32x4_load_three(&line->from.x), along = tl_f32x4_load_three(&line->direction.x);
    tl_f32x4 half = tl_f32x4_load_three(&line->half.x);
    tl_f32x4 largest = tl_f32x4_max_of_three(tl_f32x4_abs(along));
    tl_f32x4 per_t = tl_f32x4_if_less(tl_f32x4_all(0.0f), largest, largest, tl_f32x4_all(1.0f));
    tl_f32x4 steep = tl_f32x4_all(LARGEST_INVERSE);
    tl_f32x4 inverse = tl_f32x4_div(per_t, along);
    inverse = tl_f32x4_if_less(tl_f32x4_abs(inverse), steep, inverse, steep);
    tl_f32x4 below = tl_f32x4_abs(tl_f32x4_sub(from, tl_f32x4_load_three(&line->scene->bounds.min.x)));
    tl_f32x4 above = tl_f32x4_abs(tl_f32x4_sub(from, tl_f32x4_load_three(&line->scene->bounds.max.x)));
    tl_f32x4 farthest = tl_f32x4_max_of_three(tl_f32x4_max(below, above)), size = sum_of_three(tl_f32x4_abs(from));
    tl_f32x4 reach = tl_f32x4_add(farthest, size);
    tl_f32x4 pad = tl_f32x4_mul_add(reach, tl_f32x4_all(LINE_ERROR), tl_f32x4_all(FLT_MIN));
    pad = tl_f32x4_mul(tl_f32x4_add(pad, half), tl_f32x4_abs(inverse));
    tl_f32x4 base = tl_f32x4_mul(from, inverse);
    tl_f32x4_store(line->scale, inverse);
    tl_f32x4_store(line->near_base, tl_f32x4_neg(tl_f32x4_add(base, pad)));
    tl_f32x4_store(line->far_base, tl_f32x4_sub(pad, base));
    line->backward = tl_f32x4_signs(inverse) & 7u;
    line->per_t = tl_f32x4_get_x(per_t);
    float along_size = tl_f32x4_get_x(sum_of_three(tl_f32x4_abs(along)));
    line->size = tl_f32x4_get_x(size) + (line->kind == TL_SCENE_LINE_SIGHT ? along_size : 0.0f);
    line->limit = tl_scene_line_time(line, line->limit);
    tl_f32x4 whole = tl_f32x4_add(reach, tl_f32x4_max_of_three(half));
    line->longest = 4.0f * tl_f32x4_get_x(whole);
    line->is_usual = (line->per_t <= USUAL_DIRECTION) & (line->per_t >= 1.0f / USUAL_DIRECTION);
    // An empty scene's box is infinite, and a difference of points may be.
    return (tl_f32x4_get_x(whole) <= MAX_LINE_REACH) & (line->per_t >= SHORTEST) & (line->per_t <= FLT_MAX);
}

static TL_NOINLINE bool visit_every(tl_scene_line *line)
{
    for (uint32_t i = 0; i < line->scene->instance_count; i++) {
        uint32_t lane = tl_scene_places(line->scene)[i].lane;
        uint32_t mask = tl_scene_nodes(line->scene)[lane / TL_SCENE_WIDTH].mask[lane % TL_SCENE_WIDTH];
        if ((mask & line->mask) != 0 && !visit_on_line(line, i, line->kind)) {
            return false;
        }
    }
    return true;
}

// Each in a function of its own, and so with one stack.
static TL_NOINLINE bool walk_by_ray(tl_scene_line *line)
{
    return walk_scene(line, TL_SCENE_LINE_RAY, false);
}

static TL_NOINLINE bool walk_by_any_ray(tl_scene_line *line)
{
    return walk_scene(line, TL_SCENE_LINE_RAY, true);
}

static TL_NOINLINE bool walk_by_sight(tl_scene_line *line)
{
    return walk_scene(line, TL_SCENE_LINE_SIGHT, true);
}

static TL_NOINLINE bool walk_by_other(tl_scene_line *line)
{
    return line->any ? walk_scene(line, TL_SCENE_LINE_OTHER, true) : walk_scene(line, TL_SCENE_LINE_OTHER, false);
}

bool TL_SCENE_WALK(tl_scene_line *line)
{
    if (!prepare_line(line)) {
        line->is_usual = false;
        return visit_every(line);
    }
    return line->kind == TL_SCENE_LINE_SIGHT   ? walk_by_sight(line)
           : line->kind == TL_SCENE_LINE_OTHER ? walk_by_other(line)
           : line->any                         ? walk_by_any_ray(line)
                                               : walk_by_ray(line);
}
