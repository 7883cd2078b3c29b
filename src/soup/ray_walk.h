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
#include "soup/ray.h"

#include <float.h>

#define LEAF_EXTENT_TERM 13.0f
#define LEAF_ERROR_TERM  8.0f

typedef struct walk_entry {
    float t; // where the ray enters the child's box, in box t
    uint32_t child;
} walk_entry;

// Each node on the way down leaves at most fifteen siblings behind.
enum { WALK_STACK_SIZE = (TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + 1 };

typedef struct walk_ray {
    tl_f32x16 scale[3], near_base[3], far_base[3];
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

// Puts the children that the ray enters on the stack, the nearest on top.
static inline uint32_t visit_node(const tl_ray_job *job, const walk_ray *ray, const tl_soup_node *node,
                                  walk_entry *stack, uint32_t stack_count)
{
    tl_f32x16 enter = tl_f32x16_all(0.0f);
    tl_f32x16 leave = tl_f32x16_all(job->box_limit);
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 near_plane = tl_f32x16_from_u16(node->plane[job->near_row[i]]);
        tl_f32x16 far_plane = tl_f32x16_from_u16(node->plane[job->far_row[i]]);
        enter = tl_f32x16_max(enter, tl_f32x16_mul_add(near_plane, ray->scale[i], ray->near_base[i]));
        leave = tl_f32x16_min(leave, tl_f32x16_mul_add(far_plane, ray->scale[i], ray->far_base[i]));
    }
    uint32_t mask = tl_f32x16_less_equal(enter, leave) & tl_u32x16_nonzero(node->child);
    float t[TL_SOUP_WIDTH];
    tl_f32x16_store(t, enter);
    uint32_t first = stack_count;
    while (mask != 0) {
        uint32_t lane = lowest_bit(mask);
        mask &= mask - 1;
        walk_entry entry = { t[lane], node->child[lane] };
        uint32_t place = stack_count++;
        for (; place > first && stack[place - 1].t < entry.t; place--) {
            stack[place] = stack[place - 1];
        }
        stack[place] = entry;
    }
    return stack_count;
}

// Bits of lanes that the line may meet: 0-3 first triangles, 4-7 second ones.
static inline uint32_t filter_leaf(const tl_ray_job *job, const tl_leaf_view *leaf, float extent)
{
    const float origin[3] = { job->origin.x, job->origin.y, job->origin.z };
    tl_f32x8 origin_x = tl_f32x8_all(origin[job->axis_x]);
    tl_f32x8 origin_y = tl_f32x8_all(origin[job->axis_y]);
    tl_f32x8 origin_z = tl_f32x8_all(origin[job->axis_z]);
    tl_f32x8 shear_x = tl_f32x8_all(job->shear_x);
    tl_f32x8 shear_y = tl_f32x8_all(job->shear_y);
    uint32_t n = leaf->pair_count;

    tl_f32x8 az = tl_f32x8_sub(tl_f32x8_load_twice(leaf->a[job->axis_z]), origin_z);
    tl_f32x8 ax = tl_f32x8_sub(tl_f32x8_load_twice(leaf->a[job->axis_x]), origin_x);
    tl_f32x8 ay = tl_f32x8_sub(tl_f32x8_load_twice(leaf->a[job->axis_y]), origin_y);
    tl_f32x8 cz = tl_f32x8_sub(tl_f32x8_load_twice(leaf->c[job->axis_z]), origin_z);
    tl_f32x8 cx = tl_f32x8_sub(tl_f32x8_load_twice(leaf->c[job->axis_x]), origin_x);
    tl_f32x8 cy = tl_f32x8_sub(tl_f32x8_load_twice(leaf->c[job->axis_y]), origin_y);
    const float *e = leaf->e[job->axis_z];
    tl_f32x8 ez = tl_f32x8_sub(tl_f32x8_load_halves(e, e + n), origin_z);
    e = leaf->e[job->axis_x];
    tl_f32x8 ex = tl_f32x8_sub(tl_f32x8_load_halves(e, e + n), origin_x);
    e = leaf->e[job->axis_y];
    tl_f32x8 ey = tl_f32x8_sub(tl_f32x8_load_halves(e, e + n), origin_y);
    ax = tl_f32x8_sub(ax, tl_f32x8_mul(shear_x, az));
    ay = tl_f32x8_sub(ay, tl_f32x8_mul(shear_y, az));
    cx = tl_f32x8_sub(cx, tl_f32x8_mul(shear_x, cz));
    cy = tl_f32x8_sub(cy, tl_f32x8_mul(shear_y, cz));
    ex = tl_f32x8_sub(ex, tl_f32x8_mul(shear_x, ez));
    ey = tl_f32x8_sub(ey, tl_f32x8_mul(shear_y, ez));

    tl_f32x8 ae = tl_f32x8_sub(tl_f32x8_mul(ax, ey), tl_f32x8_mul(ay, ex));
    tl_f32x8 ec = tl_f32x8_sub(tl_f32x8_mul(ex, cy), tl_f32x8_mul(ey, cx));
    tl_f32x8 ca = tl_f32x8_sub(tl_f32x8_mul(cx, ay), tl_f32x8_mul(cy, ax));
    float error = job->corner_error * (LEAF_EXTENT_TERM * extent + LEAF_ERROR_TERM * job->corner_error) + FLT_MIN;
    tl_f32x8 lowest = tl_f32x8_min(tl_f32x8_min(ae, ec), ca);
    tl_f32x8 highest = tl_f32x8_max(tl_f32x8_max(ae, ec), ca);
    uint32_t maybe = tl_f32x8_not_less(lowest, tl_f32x8_all(-error)) | tl_f32x8_not_less(tl_f32x8_all(error), highest);
    return maybe & (((1u << n) - 1u) * 0x11u);
}

static inline bool visit_leaf(tl_ray_job *job, const tl_soup_leaf *packed, bool any)
{
    tl_leaf_view leaf = tl_view_leaf(packed);
    uint32_t maybe = filter_leaf(job, &leaf, packed->extent);
    bool hit = false;
    while (maybe != 0) {
        uint32_t bit = lowest_bit(maybe);
        maybe &= maybe - 1;
        uint32_t lane = bit < 4 ? bit : leaf.pair_count + bit - 4;
        if (leaf.ids[lane] != TL_ID_NONE && tl_ray_decide(job, &leaf, lane)) {
            hit = true;
            if (any) {
                break;
            }
        }
    }
    return hit;
}

bool TL_RAY_WALK(tl_ray_job *job, bool any)
{
    const tl_soup_node *nodes = tl_soup_nodes(job->soup);
    walk_ray ray;
    for (uint32_t i = 0; i < 3; i++) {
        ray.scale[i] = tl_f32x16_all(job->plane_scale[i]);
        ray.near_base[i] = tl_f32x16_all(job->near_base[i]);
        ray.far_base[i] = tl_f32x16_all(job->far_base[i]);
    }
    walk_entry stack[WALK_STACK_SIZE];
    uint32_t stack_count = visit_node(job, &ray, nodes, stack, 0);
    bool hit = false;
    while (stack_count > 0) {
        walk_entry entry = stack[--stack_count];
        if (entry.t > job->box_limit) {
            continue;
        }
        if ((entry.child & TL_CHILD_LEAF) == 0) {
            stack_count = visit_node(job, &ray, &nodes[entry.child], stack, stack_count);
        } else if (visit_leaf(job, tl_soup_leaf_at(job->soup, tl_child_leaf_offset(entry.child)), any)) {
            hit = true;
            if (any) {
                break;
            }
        }
    }
    return hit;
}
