// SPDX-License-Identifier: MIT
//
// The walk through the tree: one source, compiled once for each instruction set by a file that defines TL_RAY_WALK.
//
// A visit tests sixteen child boxes, sorts those that are hit by distance and goes on with the nearest. A leaf tests
// its four pairs at once: with corners a, e, c both triangles of a pair take one formula, in eight lanes. Two of the
// text's three tests per triangle are shared or saved there only in a scalar loop; in lanes it is cheaper to compute
// E(a, e), E(e, c) and E(c, a) for all eight than to choose.
//
// A lane is rejected when two edges have opposite signs beyond the error bound. If the line does meet the triangle, its
// sheared corners lie no farther from the ray than the triangle is wide: |coordinates| <= 2 L, L the largest extent in
// the leaf. With corner error d = 8 u M, E is then off by at most 4 d (2 L + d) + 2 d^2 + 4 u (2 L + d)^2
// <= 12 d L + 7 d^2, as L <= 2 M. Underflow adds less than FLT_MIN.

#include "math/simd.h"
#include "soup/ray_prepare.h"

#include <float.h>
#include <string.h>

#define LEAF_EXTENT_TERM 13.0f
#define LEAF_ERROR_TERM  8.0f

// Each node on the way down leaves at most fifteen siblings behind.
enum { WALK_STACK_SIZE = (TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + 1 };

// A ray's constants, spread over the lanes.
typedef struct walk_ray {
    tl_f32x16 scale[3], near_base[3], far_base[3];
    uint32_t near_row[3]; // of tl_soup_node.plane: the ray enters by it and leaves by its neighbour
    tl_f32x8 origin_x, origin_y, origin_z, shear_x, shear_y;
    const tl_soup_node *nodes;
    const char *leaves;
} walk_ray;

static inline uint32_t lowest_bit(uint32_t mask)
{
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctz(mask);
#else
    uint32_t bit = 0;
    while ((mask >> bit & 1) == 0) {
        bit++;
    }
    return bit;
#endif
}

// A child that the ray enters: the bits of the box t where, above the child word. Such t are never negative, so their
// bits have the order of their values, and one integer compare orders entries.
typedef uint64_t walk_entry;

static inline walk_entry make_entry(const uint32_t *t_bits, const tl_soup_node *node, uint32_t lane)
{
    return (uint64_t)t_bits[lane] << 32 | node->child[lane];
}

static inline walk_entry nearer(walk_entry a, walk_entry b)
{
    return a < b ? a : b;
}

static inline walk_entry farther(walk_entry a, walk_entry b)
{
    return a < b ? b : a;
}

// Which children the ray enters, and where.
static inline uint32_t enter_children(const tl_ray_job *job, const walk_ray *ray, const tl_soup_node *node,
                                      uint32_t *t_bits)
{
    tl_f32x16 enter[3], leave[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 near_plane = tl_f32x16_from_u16(node->plane[ray->near_row[i]]);
        tl_f32x16 far_plane = tl_f32x16_from_u16(node->plane[ray->near_row[i] ^ 1u]);
        enter[i] = tl_f32x16_mul_add(near_plane, ray->scale[i], ray->near_base[i]);
        leave[i] = tl_f32x16_mul_add(far_plane, ray->scale[i], ray->far_base[i]);
    }
    // The zero last: of equal values max gives the second, so that -0 becomes +0, whose bits sort first.
    tl_f32x16 first = tl_f32x16_max(tl_f32x16_max(enter[0], enter[1]), tl_f32x16_max(enter[2], tl_f32x16_all(0.0f)));
    first = tl_f32x16_max(first, tl_f32x16_all(0.0f));
    tl_f32x16 last =
        tl_f32x16_min(tl_f32x16_min(leave[0], leave[1]), tl_f32x16_min(leave[2], tl_f32x16_all(job->box_limit)));
    tl_f32x16_store_bits(t_bits, first);
    return tl_f32x16_less_equal(first, last) & tl_u32x16_nonzero(node->child);
}

// Puts all of some children on the stack but the nearest, which is returned; the next nearest lies on top.
static inline uint32_t push_sorted(const uint32_t *t_bits, const tl_soup_node *node, uint32_t mask, walk_entry *stack,
                                   uint32_t *stack_count)
{
    walk_entry *base = stack + *stack_count;
    uint32_t count = 0;
    do {
        walk_entry entry = make_entry(t_bits, node, lowest_bit(mask));
        mask &= mask - 1;
        uint32_t place = count++;
        for (; place > 0 && base[place - 1] < entry; place--) {
            base[place] = base[place - 1];
        }
        base[place] = entry;
    } while (mask != 0);
    *stack_count += count - 1;
    return (uint32_t)base[count - 1];
}

// The same, without branches for two and three children, which are most visits; `mask` is not empty.
static inline uint32_t push_children(const uint32_t *t_bits, const tl_soup_node *node, uint32_t mask, walk_entry *stack,
                                     uint32_t *stack_count)
{
    uint32_t rest = mask & (mask - 1);
    if (rest == 0) {
        return node->child[lowest_bit(mask)];
    }
    walk_entry a = make_entry(t_bits, node, lowest_bit(mask));
    walk_entry b = make_entry(t_bits, node, lowest_bit(rest));
    walk_entry *top = stack + *stack_count;
    rest &= rest - 1;
    if (rest == 0) {
        top[0] = farther(a, b);
        *stack_count += 1;
        return (uint32_t)nearer(a, b);
    }
    if ((rest & (rest - 1)) != 0) {
        return push_sorted(t_bits, node, mask, stack, stack_count);
    }
    walk_entry c = make_entry(t_bits, node, lowest_bit(rest));
    walk_entry low = nearer(a, b), high = farther(a, b);
    top[0] = farther(high, c);
    high = nearer(high, c);
    top[1] = farther(low, high);
    *stack_count += 2;
    return (uint32_t)nearer(low, high);
}

// Bits of lanes that the line may meet: 0-3 first triangles, 4-7 second ones.
static inline uint32_t filter_leaf(const tl_ray_job *job, const walk_ray *ray, const float *floats, uint32_t n,
                                   float extent)
{
    size_t x = (size_t)job->axis_x * n, y = (size_t)job->axis_y * n, z = (size_t)job->axis_z * n;
    const float *c = floats + 3 * (size_t)n, *e = floats + 6 * (size_t)n;
    tl_f32x8 az = tl_f32x8_sub(tl_f32x8_load_twice(floats + z), ray->origin_z);
    tl_f32x8 ax = tl_f32x8_sub(tl_f32x8_load_twice(floats + x), ray->origin_x);
    tl_f32x8 ay = tl_f32x8_sub(tl_f32x8_load_twice(floats + y), ray->origin_y);
    tl_f32x8 cz = tl_f32x8_sub(tl_f32x8_load_twice(c + z), ray->origin_z);
    tl_f32x8 cx = tl_f32x8_sub(tl_f32x8_load_twice(c + x), ray->origin_x);
    tl_f32x8 cy = tl_f32x8_sub(tl_f32x8_load_twice(c + y), ray->origin_y);
    tl_f32x8 ez = tl_f32x8_sub(tl_f32x8_load_halves(e + 2 * z, e + 2 * z + n), ray->origin_z);
    tl_f32x8 ex = tl_f32x8_sub(tl_f32x8_load_halves(e + 2 * x, e + 2 * x + n), ray->origin_x);
    tl_f32x8 ey = tl_f32x8_sub(tl_f32x8_load_halves(e + 2 * y, e + 2 * y + n), ray->origin_y);
    ax = tl_f32x8_sub(ax, tl_f32x8_mul(ray->shear_x, az));
    ay = tl_f32x8_sub(ay, tl_f32x8_mul(ray->shear_y, az));
    cx = tl_f32x8_sub(cx, tl_f32x8_mul(ray->shear_x, cz));
    cy = tl_f32x8_sub(cy, tl_f32x8_mul(ray->shear_y, cz));
    ex = tl_f32x8_sub(ex, tl_f32x8_mul(ray->shear_x, ez));
    ey = tl_f32x8_sub(ey, tl_f32x8_mul(ray->shear_y, ez));

    tl_f32x8 ae = tl_f32x8_sub(tl_f32x8_mul(ax, ey), tl_f32x8_mul(ay, ex));
    tl_f32x8 ec = tl_f32x8_sub(tl_f32x8_mul(ex, cy), tl_f32x8_mul(ey, cx));
    tl_f32x8 ca = tl_f32x8_sub(tl_f32x8_mul(cx, ay), tl_f32x8_mul(cy, ax));
    float error = job->corner_error * (LEAF_EXTENT_TERM * extent + LEAF_ERROR_TERM * job->corner_error) + FLT_MIN;
    tl_f32x8 lowest = tl_f32x8_min(tl_f32x8_min(ae, ec), ca);
    tl_f32x8 highest = tl_f32x8_max(tl_f32x8_max(ae, ec), ca);
    uint32_t maybe = tl_f32x8_not_less(lowest, tl_f32x8_all(-error)) | tl_f32x8_not_less(tl_f32x8_all(error), highest);
    return maybe & (((1u << n) - 1u) * 0x11u);
}

static inline bool visit_leaf(tl_ray_job *job, const walk_ray *ray, uint32_t child, bool any)
{
    const tl_soup_leaf *leaf = (const tl_soup_leaf *)(const void *)(ray->leaves + tl_child_leaf_offset(child));
    uint32_t n = tl_child_pair_count(child);
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    uint32_t maybe = filter_leaf(job, ray, (const float *)(const void *)(ids + 2 * (size_t)n), n, leaf->extent);
    bool hit = false;
    while (maybe != 0) {
        uint32_t bit = lowest_bit(maybe);
        maybe &= maybe - 1;
        uint32_t lane = bit < 4 ? bit : n + bit - 4;
        if (ids[lane] != TL_ID_NONE && tl_ray_decide(job, leaf, lane)) {
            hit = true;
            if (any) {
                break;
            }
        }
    }
    return hit;
}

static inline void spread_ray(const tl_ray_job *job, walk_ray *ray)
{
    for (uint32_t i = 0; i < 3; i++) {
        ray->scale[i] = tl_f32x16_all(job->plane_scale[i]);
        ray->near_base[i] = tl_f32x16_all(job->near_base[i]);
        ray->far_base[i] = tl_f32x16_all(job->far_base[i]);
        ray->near_row[i] = 2 * i + (job->backward >> i & 1u);
    }
    ray->origin_x = tl_f32x8_all(job->origin.lane[job->axis_x]);
    ray->origin_y = tl_f32x8_all(job->origin.lane[job->axis_y]);
    ray->origin_z = tl_f32x8_all(job->origin.lane[job->axis_z]);
    ray->shear_x = tl_f32x8_all(job->shear_x);
    ray->shear_y = tl_f32x8_all(job->shear_y);
    ray->nodes = tl_soup_nodes(job->soup);
    ray->leaves = (const char *)job->soup + job->soup->leaf_offset;
}

bool TL_RAY_WALK(tl_ray_job *job, tl_vec3 origin, tl_vec3 target, bool any)
{
    if (!tl_ray_prepare_inline(job, origin, target)) {
        return false;
    }
    walk_ray ray;
    spread_ray(job, &ray);
    walk_entry stack[WALK_STACK_SIZE];
    uint32_t stack_count = 0;
    uint32_t child = 0;
    bool hit = false;
    for (;;) {
        if ((child & TL_CHILD_LEAF) == 0) {
            const tl_soup_node *node = &ray.nodes[child];
            uint32_t t_bits[TL_SOUP_WIDTH];
            uint32_t mask = enter_children(job, &ray, node, t_bits);
            if (mask != 0) {
                child = push_children(t_bits, node, mask, stack, &stack_count);
                continue;
            }
        } else if (visit_leaf(job, &ray, child, any)) {
            hit = true;
            if (any) {
                return true;
            }
        }
        uint32_t limit_bits;
        memcpy(&limit_bits, &job->box_limit, sizeof limit_bits);
        walk_entry limit = (uint64_t)limit_bits << 32 | UINT32_MAX;
        do {
            if (stack_count == 0) {
                return hit;
            }
            stack_count--;
        } while (stack[stack_count] > limit);
        child = (uint32_t)stack[stack_count];
    }
}
