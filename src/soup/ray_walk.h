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
//
// Lanes that pass get an interval of t, so that most of what is left is settled without ray_decide.c: triangles behind
// the ray or beyond the best are dropped, and one that is surely hit, surely in front of the best, only waits: it is
// decided when another comes too near to tell them apart, or at the end. With m the largest sheared coordinate of the
// lane, E is off by at most e = 4 d m + 2 d^2 + 4 u m^2 <= 5.1 d m + 2 d^2, whether or not the line meets the triangle.
// With D = sum(E), |D| >= 16 e, depths z_i that round once, at most Z, and t = sum(E_i z_i) / D, the true t of a
// triangle that is met differs by at most Z (6.1 e / |D| + 9 u) before the division, its rounding and the product with
// per_depth (two roundings of its own) add 6 u more: taken as Z (7 e / |D| + 24 u).

#include "base/lowest_bit.h"
#include "math/simd16.h"
#include "soup/ray_prepare.h"

#include <float.h>
#include <string.h>

#define LEAF_EXTENT_TERM 13.0f
#define LEAF_ERROR_TERM  8.0f

#define LANE_SIZE_TERM   6.0f
#define LANE_ERROR_TERM  3.0f
#define LANE_MIN_RATIO   16.0f // |D| / e
#define T_RATIO_TERM     7.0f
#define T_ROUNDING       (24.0f * TL_FLOAT_ROUNDING)

// Around a t that is decided: where another's interval must end or begin to be told from it.
#define T_MARGIN (4.0f * TL_FLOAT_ROUNDING)

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

// A child that the ray enters: the bits of the box t where, above the child word. Such t are never negative, so their
// bits have the order of their values, and one integer compare orders entries.
typedef uint64_t walk_entry;

static inline walk_entry make_entry(const uint32_t *t_bits, const tl_soup_node *node, uint32_t lane)
{
    return (uint64_t)t_bits[lane] << 32 | node->child[lane];
}

// What waits on the stack is mostly visited soon, and its lines are then under way.
static inline void prefetch_child(const walk_ray *ray, uint32_t child)
{
#if defined(__GNUC__)
    bool leaf = (child & TL_CHILD_LEAF) != 0;
    const char *base = leaf ? ray->leaves : (const char *)ray->nodes;
    const char *at = base + (leaf ? tl_child_leaf_offset(child) : (uint64_t)child * sizeof(tl_soup_node));
    __builtin_prefetch(at);
    __builtin_prefetch(at + 64);
    __builtin_prefetch(at + 128);
#else
    (void)ray;
    (void)child;
#endif
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
    // Of equal values max gives the second, so the zero goes there: it never becomes -0, whose bits would sort last.
    tl_f32x16 first = tl_f32x16_max(tl_f32x16_max(enter[0], enter[1]), tl_f32x16_max(enter[2], tl_f32x16_all(0.0f)));
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
        walk_entry entry = make_entry(t_bits, node, tl_lowest_bit(mask));
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
static inline uint32_t push_children(const walk_ray *ray, const uint32_t *t_bits, const tl_soup_node *node,
                                     uint32_t mask, walk_entry *stack, uint32_t *stack_count)
{
    uint32_t rest = mask & (mask - 1);
    if (rest == 0) {
        return node->child[tl_lowest_bit(mask)];
    }
    walk_entry a = make_entry(t_bits, node, tl_lowest_bit(mask));
    walk_entry b = make_entry(t_bits, node, tl_lowest_bit(rest));
    walk_entry *top = stack + *stack_count;
    rest &= rest - 1;
    if (rest == 0) {
        top[0] = farther(a, b);
        prefetch_child(ray, (uint32_t)top[0]);
        *stack_count += 1;
        return (uint32_t)nearer(a, b);
    }
    if ((rest & (rest - 1)) != 0) {
        return push_sorted(t_bits, node, mask, stack, stack_count);
    }
    walk_entry c = make_entry(t_bits, node, tl_lowest_bit(rest));
    walk_entry low = nearer(a, b), high = farther(a, b);
    top[0] = farther(high, c);
    high = nearer(high, c);
    top[1] = farther(low, high);
    prefetch_child(ray, (uint32_t)top[1]);
    *stack_count += 2;
    return (uint32_t)nearer(low, high);
}

// A leaf's triangles as the ray sees them.
typedef struct leaf_lanes {
    tl_f32x8 az, ez, cz;             // depths
    tl_f32x8 ax, ay, ex, ey, cx, cy; // sheared
    tl_f32x8 ae, ec, ca;             // sidedness of each edge: the weights of c, a and e
} leaf_lanes;

static inline void load_leaf(const tl_ray_job *job, const walk_ray *ray, const float *floats, uint32_t n,
                             leaf_lanes *lanes)
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
    lanes->az = az;
    lanes->cz = cz;
    lanes->ez = ez;
    lanes->ax = tl_f32x8_sub(ax, tl_f32x8_mul(ray->shear_x, az));
    lanes->ay = tl_f32x8_sub(ay, tl_f32x8_mul(ray->shear_y, az));
    lanes->cx = tl_f32x8_sub(cx, tl_f32x8_mul(ray->shear_x, cz));
    lanes->cy = tl_f32x8_sub(cy, tl_f32x8_mul(ray->shear_y, cz));
    lanes->ex = tl_f32x8_sub(ex, tl_f32x8_mul(ray->shear_x, ez));
    lanes->ey = tl_f32x8_sub(ey, tl_f32x8_mul(ray->shear_y, ez));
    lanes->ae = tl_f32x8_sub(tl_f32x8_mul(lanes->ax, lanes->ey), tl_f32x8_mul(lanes->ay, lanes->ex));
    lanes->ec = tl_f32x8_sub(tl_f32x8_mul(lanes->ex, lanes->cy), tl_f32x8_mul(lanes->ey, lanes->cx));
    lanes->ca = tl_f32x8_sub(tl_f32x8_mul(lanes->cx, lanes->ay), tl_f32x8_mul(lanes->cy, lanes->ax));
}

// Bits of lanes that the line may meet: 0-3 first triangles, 4-7 second ones.
static inline uint32_t filter_leaf(const tl_ray_job *job, const leaf_lanes *lanes, uint32_t n, float extent)
{
    float error = job->corner_error * (LEAF_EXTENT_TERM * extent + LEAF_ERROR_TERM * job->corner_error) + FLT_MIN;
    tl_f32x8 lowest = tl_f32x8_min(tl_f32x8_min(lanes->ae, lanes->ec), lanes->ca);
    tl_f32x8 highest = tl_f32x8_max(tl_f32x8_max(lanes->ae, lanes->ec), lanes->ca);
    uint32_t maybe = tl_f32x8_not_less(lowest, tl_f32x8_all(-error)) | tl_f32x8_not_less(tl_f32x8_all(error), highest);
    return maybe & (((1u << n) - 1u) * 0x11u);
}

static inline tl_f32x8 largest_of_four(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    return tl_f32x8_max(tl_f32x8_max(tl_f32x8_abs(a), tl_f32x8_abs(b)), tl_f32x8_max(tl_f32x8_abs(c), tl_f32x8_abs(d)));
}

// Intervals of t in box t, and which lanes they can be trusted in (clear), which of these the line surely meets.
static inline void find_intervals(const tl_ray_job *job, const leaf_lanes *v, float *low, float *high,
                                  uint32_t *clear_out, uint32_t *sure_out)
{
    tl_f32x8 size = tl_f32x8_max(largest_of_four(v->ax, v->ay, v->ex, v->ey),
                                 tl_f32x8_max(tl_f32x8_abs(v->cx), tl_f32x8_abs(v->cy)));
    tl_f32x8 corner_error = tl_f32x8_all(job->corner_error);
    tl_f32x8 error = tl_f32x8_add(tl_f32x8_mul(size, tl_f32x8_all(LANE_SIZE_TERM)),
                                  tl_f32x8_mul(corner_error, tl_f32x8_all(LANE_ERROR_TERM)));
    error = tl_f32x8_add(tl_f32x8_mul(error, corner_error), tl_f32x8_all(FLT_MIN));
    tl_f32x8 lowest = tl_f32x8_min(tl_f32x8_min(v->ae, v->ec), v->ca);
    tl_f32x8 highest = tl_f32x8_max(tl_f32x8_max(v->ae, v->ec), v->ca);
    tl_f32x8 below = tl_f32x8_sub(tl_f32x8_all(0.0f), error);
    *sure_out = tl_f32x8_less(error, lowest) | tl_f32x8_less(highest, below);

    tl_f32x8 sum = tl_f32x8_add(tl_f32x8_add(v->ae, v->ec), v->ca);
    tl_f32x8 weighted =
        tl_f32x8_add(tl_f32x8_add(tl_f32x8_mul(v->ae, v->cz), tl_f32x8_mul(v->ec, v->az)), tl_f32x8_mul(v->ca, v->ez));
    tl_f32x8 inverse = tl_f32x8_div(tl_f32x8_all(1.0f), sum);
    tl_f32x8 ratio = tl_f32x8_abs(tl_f32x8_mul(error, inverse));
    *clear_out = tl_f32x8_less(ratio, tl_f32x8_all(1.0f / LANE_MIN_RATIO));
    tl_f32x8 t = tl_f32x8_mul(tl_f32x8_mul(weighted, inverse), tl_f32x8_all(job->per_depth));
    tl_f32x8 depth = tl_f32x8_max(tl_f32x8_max(tl_f32x8_abs(v->az), tl_f32x8_abs(v->ez)), tl_f32x8_abs(v->cz));
    tl_f32x8 spread = tl_f32x8_add(tl_f32x8_mul(ratio, tl_f32x8_all(T_RATIO_TERM)), tl_f32x8_all(T_ROUNDING));
    spread = tl_f32x8_mul(tl_f32x8_mul(depth, spread), tl_f32x8_all(fabsf(job->per_depth)));
    tl_f32x8_store(low, tl_f32x8_sub(t, spread));
    tl_f32x8_store(high, tl_f32x8_add(t, spread));
}

// A triangle that is surely hit, surely nearer than the best that was decided, and not decided yet.
typedef struct waiting {
    const tl_soup_leaf *leaf; // NULL: none
    uint32_t lane;
    float ahead; // whatever surely ends before this t is nearer than all that is known
} waiting;

static inline void decide_lane(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t lane, waiting *wait)
{
    if (wait->leaf != NULL) {
        (void)tl_ray_decide(job, wait->leaf, wait->lane);
        wait->leaf = NULL;
    }
    if (leaf != NULL) {
        (void)tl_ray_decide(job, leaf, lane);
    }
    wait->ahead = job->t * (1.0f - T_MARGIN);
}

// Settles the lanes of a leaf that may be hit. True: any hit will do, and there is one.
static inline bool settle_lanes(tl_ray_job *job, const leaf_lanes *lanes, uint32_t maybe, const tl_soup_leaf *leaf,
                                uint32_t n, bool any, waiting *wait)
{
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    float low[8], high[8];
    uint32_t clear = 0, sure = 0;
    if (job->box_scale == 1.0f) {
        find_intervals(job, lanes, low, high, &clear, &sure);
        sure &= job->filter == NULL ? clear : 0u;
    }
    do {
        uint32_t bit = tl_lowest_bit(maybe);
        uint32_t lane = bit < 4 ? bit : n + bit - 4;
        uint32_t is_clear = clear >> bit & 1u, is_sure = sure >> bit & 1u;
        maybe &= maybe - 1;
        if (ids[lane] == TL_ID_NONE || (is_clear && (high[bit] < 0.0f || low[bit] > job->box_limit))) {
            continue;
        }
        if (is_sure && low[bit] > 0.0f && high[bit] < wait->ahead) {
            if (any) {
                return true;
            }
            wait->leaf = leaf;
            wait->lane = lane;
            wait->ahead = low[bit];
            job->box_limit = high[bit];
            continue;
        }
        decide_lane(job, leaf, lane, wait);
        if (any && job->triangle != UINT32_MAX) {
            return true;
        }
    } while (maybe != 0);
    return false;
}

static inline bool visit_leaf(tl_ray_job *job, const walk_ray *ray, uint32_t child, bool any, waiting *wait)
{
    const tl_soup_leaf *leaf = (const tl_soup_leaf *)(const void *)(ray->leaves + tl_child_leaf_offset(child));
    uint32_t n = tl_child_pair_count(child);
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    leaf_lanes lanes;
    load_leaf(job, ray, (const float *)(const void *)(ids + 2 * (size_t)n), n, &lanes);
    uint32_t maybe = filter_leaf(job, &lanes, n, leaf->extent);
    return maybe != 0 && settle_lanes(job, &lanes, maybe, leaf, n, any, wait);
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
    waiting wait = { NULL, 0, job->t * (1.0f - T_MARGIN) };
    for (;;) {
        if ((child & TL_CHILD_LEAF) == 0) {
            const tl_soup_node *node = &ray.nodes[child];
            _Alignas(64) uint32_t t_bits[TL_SOUP_WIDTH]; // one line: a split store is not forwarded
            uint32_t mask = enter_children(job, &ray, node, t_bits);
            if (mask != 0) {
                child = push_children(&ray, t_bits, node, mask, stack, &stack_count);
                continue;
            }
        } else if (visit_leaf(job, &ray, child, any, &wait)) {
            return true;
        }
        uint32_t limit_bits;
        memcpy(&limit_bits, &job->box_limit, sizeof limit_bits);
        walk_entry limit = (uint64_t)limit_bits << 32 | UINT32_MAX;
        do {
            if (stack_count == 0) {
                decide_lane(job, NULL, 0, &wait);
                return job->triangle != UINT32_MAX;
            }
            stack_count--;
        } while (stack[stack_count] > limit);
        child = (uint32_t)stack[stack_count];
    }
}
