// SPDX-License-Identifier: MIT
//
// BVH traversal by a ray: one source, compiled once for each instruction set by a file that defines TL_RAY_WALK.
//
// A visit tests sixteen child boxes and continues with the nearest that is hit; the others wait on a stack, sorted by
// distance, or in the node's order when any hit will do. A leaf tests its four pairs at once: with corners a, e, c one
// formula serves both triangles of a pair, in eight lanes. Ericson's article shares or saves two of the three tests per
// triangle, which pays only in a scalar loop; in lanes it is cheaper to compute E(a, e), E(e, c) and E(c, a) for all
// eight than to choose.
//
// The edge tests are those of Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013, used as a filter
// with error bounds.
//
// A lane is rejected when two edges have opposite signs beyond the error bound. If the line does meet the triangle, its
// sheared corners lie no farther from the ray than the triangle is wide: |coordinates| <= 2 L, L the largest extent in
// the leaf. With corner error d = 8 u M, E is then off by at most
// 4 d (2 L + d) + 2 d^2 + 4 u (2 L + d)^2 <= 12 d L + 7 d^2, as L <= 2 M. Underflow adds less than FLT_MIN. The bound
// of a leaf is e = 13 d L + 8 d^2 + FLT_MIN.
//
// A lane is surely met when all three E are beyond e on one side. For rounding is monotonic, so E = x y' - y x', each
// product rounded once, has the sign of the exact expression; three equal signs mean that the triangle of the computed
// corners holds the origin, so these are within 2 L + 2 d, the bound e is valid, and no true sign differs. That is why
// these products must not be fused.
//
// Lanes that pass get an interval of t, which settles most of them without ray_decide.c: triangles behind the ray or
// beyond the best are dropped, and one that is surely hit, surely in front of the best and of its leaf's others, is
// measured (ray_measure.h). The walk goes on meanwhile: its limit is the interval, not t. With D = sum(E) and depths
// z_i, t = sum(E_i z_i) / D times per_depth. Let the line meet the triangle. With m the largest of its computed
// coordinates across the ray, and Z of its depths, no corner is farther away than M' = m + Z, as X = x' + S Z: it is
// off by d' = 8 u M'. E is off by at most 4 d' m + 2 d'^2 + 4 u m^2 <= 4.5 d' m + 2 d'^2; taken as e = 5.5 d' m + 3
// d'^2 + FLT_MIN. True weights have one sign, so the true quotient T lies among the depths, and errors of the weights
// move it by at most e sum(|z_i - T|) / |D| <= 2 e s / |D|, with s the largest depth less the smallest. With |D| >= 64
// e, roundings of depths, products, sums and the quotient add 18 u Z, per_depth (two of its own) and its product 3 u Z.
// Taken as 2.25 e s / |D| + 26 u Z. (The triangle's own size tells more than L: that of the largest in the leaf, for
// all three depths, left one in six of some rays in doubt whether they begin before a floor or behind it.)
//
// Underflow. Products of the depths' sum, and that sum times per_depth, err by 2^-150 each, which 1 / |D| makes large:
// with e taken as 2^-77 at least, so that |D| >= 2^-71, and |per_depth| >= 2^-20, by less than 2^-58.9 |per_depth|,
// about 28 u 2^-39.7 |per_depth|. So 2^-38 is added to Z. It also covers the rounding of a reported t below FLT_MIN,
// 2^-150 in t, as long as box t is not more than 2^70 of t. Triangles much smaller than 10^-10 m are decided in double.
//
// All of this is in box t: a power of two times t.

#include "base/compiler.h"
#include "base/lowest_bit.h"
#include "base/min_max.h"
#include "math/simd16.h"
#include "soup/layout/compact_layout.h"
#include "soup/ray/ray_filter.h"
#include "soup/ray/ray_measure.h"
#include "soup/ray/ray_prepare.h"

#include <float.h>
#include <stddef.h>
#include <string.h>

#define LEAF_EXTENT_TERM 13.0f
#define LEAF_ERROR_TERM  8.0f

#define LANE_SIZE_TERM   5.5f
#define LANE_ERROR_TERM  3.0f
#define LANE_MIN_RATIO   64.0f // |D| / e
#define T_RATIO_TERM     2.25f
#define T_ROUNDING       (28.0f * TL_FLOAT_ROUNDING)
#define LANE_UNDERFLOW   0x1p-77f
#define DEPTH_UNDERFLOW  0x1p-38f // metres

// Margin around a decided t: another's interval must end before or begin after it to be told apart.
#define T_MARGIN (4.0f * TL_FLOAT_ROUNDING)

// A segment's t that is not 1, with its rounding and the error of ray_measure.h.
#define SURELY_BEYOND_END (1.0f + 0x1p-22f)

// Each node on the path leaves at most fifteen siblings behind; tl_u32x16_compress_pairs may write sixteen.
enum { WALK_STACK_SIZE = (TL_SOUP_WIDTH - 1) * TL_SOUP_MAX_DEPTH + TL_SOUP_WIDTH };

// Byte offsets in a plain node of the planes by which a ray enters, indexed by its bits `backward`. It leaves by those
// of ~backward.
static const uint32_t ray_rows[8][4] = { { 0, 128, 256, 0 },  { 64, 128, 256, 0 }, { 0, 192, 256, 0 },
                                         { 64, 192, 256, 0 }, { 0, 128, 320, 0 },  { 64, 128, 320, 0 },
                                         { 0, 192, 320, 0 },  { 64, 192, 320, 0 } };
static_assert(sizeof(((tl_soup_node *)0)->plane[0]) == 64, "rows of walk_rows");

// What a visit needs besides the job.
typedef struct walk_ray {
    const uint32_t *near_rows;
    const uint32_t *far_rows;
    uint32_t node_size; // bytes
    const char *nodes;
    const char *leaves;
} walk_ray;

// A child that the ray enters: the bits of the box t of the entry point, above the child word. Such t are never
// negative, so their bits sort as their values do, and one integer compare orders entries.
typedef uint64_t walk_entry;

static inline walk_entry make_entry(const uint32_t *t_bits, const uint32_t *children, uint32_t lane)
{
    return (uint64_t)t_bits[lane] << 32 | children[lane];
}

// A child on the stack is mostly visited soon, and its cache lines are then on their way.
static inline void prefetch_child(const walk_ray *ray, uint32_t child)
{
    bool leaf = (child & TL_CHILD_LEAF) != 0;
    const char *base = leaf ? ray->leaves : ray->nodes;
    const char *at = base + (leaf ? tl_child_leaf_offset(child) : (uint64_t)child * ray->node_size);
    tl_prefetch(at);
    tl_prefetch(at + 64);
    tl_prefetch(at + 128);
}

static inline walk_entry nearer_entry(walk_entry a, walk_entry b)
{
    return a < b ? a : b;
}

static inline walk_entry farther_entry(walk_entry a, walk_entry b)
{
    return a < b ? b : a;
}

static inline const float *plane_row(const tl_soup_node *node, uint32_t row)
{
    return (const float *)(const void *)((const char *)node + row);
}

// Where the ray enters boxes along an axis, and where it leaves them.
typedef struct walk_slab {
    tl_f32x16 enter, leave;
} walk_slab;

// Which of sixteen boxes the ray enters, and where.
static TL_ALWAYS_INLINE uint32_t enter_boxes(const walk_slab slabs[3], float limit, uint32_t *t_bits)
{
    // The last maximum leaves nothing negative. A negative minimum is below it, whichever of several it is.
    tl_f32x16 first = tl_f32x16_max_bits(tl_f32x16_max_bits(slabs[0].enter, slabs[1].enter),
                                         tl_f32x16_max_bits(slabs[2].enter, tl_f32x16_all(0.0f)));
    tl_f32x16 last = tl_f32x16_min_bits(tl_f32x16_min_bits(slabs[0].leave, slabs[1].leave),
                                        tl_f32x16_min_bits(slabs[2].leave, tl_f32x16_all(limit)));
    tl_f32x16_store_bits(t_bits, first);
    return tl_f32x16_less_equal_bits(first, last);
}

static TL_ALWAYS_INLINE uint32_t enter_children(const tl_ray_job *job, const walk_ray *ray, const tl_soup_node *node,
                                                float limit, uint32_t *t_bits)
{
    walk_slab slabs[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 scale = tl_f32x16_all(job->plane_scale[i]);
        tl_f32x16 near_plane = tl_f32x16_load(plane_row(node, ray->near_rows[i]));
        tl_f32x16 far_plane = tl_f32x16_load(plane_row(node, ray->far_rows[i]));
        slabs[i].enter = tl_f32x16_mul_add(near_plane, scale, tl_f32x16_all(job->near_base[i]));
        slabs[i].leave = tl_f32x16_mul_add(far_plane, scale, tl_f32x16_all(job->far_base[i]));
    }
    return enter_boxes(slabs, limit, t_bits);
}

// Puts all of some children on the stack but the nearest, which is returned; the next nearest lies on top.
static inline uint32_t push_sorted(const uint32_t *t_bits, const uint32_t *children, uint32_t mask, walk_entry *stack,
                                   uint32_t *stack_count)
{
    walk_entry *base = stack + *stack_count;
    uint32_t count = 0;
    do {
        walk_entry entry = make_entry(t_bits, children, tl_lowest_bit(mask));
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

// The same, without branches for two and three children, which are most visits; `mask` is not empty. When any hit will
// do, sorting costs more than it saves: the lowest lane comes first, and one child is no special case.
static TL_ALWAYS_INLINE uint32_t push_children(const walk_ray *ray, const uint32_t *t_bits, const uint32_t *children,
                                               uint32_t mask, bool any, walk_entry *stack, uint32_t *stack_count)
{
    uint32_t rest = mask & (mask - 1);
    uint32_t first = tl_lowest_bit(mask);
    walk_entry *top = stack + *stack_count;
    if (any) {
        tl_u32x16_compress_pairs(top, rest, t_bits, children);
        *stack_count += tl_bit_count(rest);
        return children[first];
    }
    if (rest == 0) {
        return children[first];
    }
    walk_entry a = make_entry(t_bits, children, first);
    walk_entry b = make_entry(t_bits, children, tl_lowest_bit(rest));
    rest &= rest - 1;
    if (rest == 0) {
        top[0] = farther_entry(a, b);
        prefetch_child(ray, (uint32_t)top[0]);
        *stack_count += 1;
        return (uint32_t)nearer_entry(a, b);
    }
    if ((rest & (rest - 1)) != 0) {
        return push_sorted(t_bits, children, mask, stack, stack_count);
    }
    walk_entry c = make_entry(t_bits, children, tl_lowest_bit(rest));
    walk_entry low = nearer_entry(a, b), high = farther_entry(a, b);
    top[0] = farther_entry(high, c);
    high = nearer_entry(high, c);
    top[1] = farther_entry(low, high);
    prefetch_child(ray, (uint32_t)top[1]);
    *stack_count += 2;
    return (uint32_t)nearer_entry(low, high);
}

// A leaf's triangles in the ray's sheared space.
typedef struct leaf_lanes {
    tl_f32x8 ax, ex, cx, ay, ey, cy; // across the ray
    tl_f32x8 az, ez, cz;             // depths
    tl_f32x8 ae, ec, ca;             // sidedness of each edge: the weights of c, a and e
    uint32_t maybe;                  // bits of lanes that the line may meet: 0-3 first triangles, 4-7 second ones
    tl_f32x8 sure;                   // signs: lanes that it meets
} leaf_lanes;

static inline tl_f32x8 cross_lanes(tl_f32x8 ax, tl_f32x8 ay, tl_f32x8 bx, tl_f32x8 by)
{
    return tl_f32x8_sub(tl_f32x8_mul(ax, by), tl_f32x8_mul(ay, bx));
}

static TL_ALWAYS_INLINE void test_leaf(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, leaf_lanes *lanes)
{
    const float *floats = (const float *)(const void *)((const uint32_t *)(const void *)(leaf + 1) + 2 * (size_t)n);
    size_t stride = 4 * (size_t)n;
    const float *x = floats + job->axes[0] * stride, *y = floats + job->axes[1] * stride;
    const float *z = floats + job->axes[2] * stride;
    tl_f32x8 origin_x = tl_f32x8_all(job->leaf_origin[0]), origin_y = tl_f32x8_all(job->leaf_origin[1]);
    tl_f32x8 origin_z = tl_f32x8_all(job->leaf_origin[2]);
    tl_f32x8 shear_x = tl_f32x8_all(job->shear[0]), shear_y = tl_f32x8_all(job->shear[1]);
    tl_f32x8 az = tl_f32x8_sub(tl_f32x8_load_twice(z), origin_z);
    tl_f32x8 cz = tl_f32x8_sub(tl_f32x8_load_twice(z + n), origin_z);
    tl_f32x8 ez = tl_f32x8_sub(tl_f32x8_load_halves(z + 2 * n, z + 3 * n), origin_z);
    tl_f32x8 ax = tl_f32x8_sub(tl_f32x8_load_twice(x), origin_x);
    tl_f32x8 cx = tl_f32x8_sub(tl_f32x8_load_twice(x + n), origin_x);
    tl_f32x8 ex = tl_f32x8_sub(tl_f32x8_load_halves(x + 2 * n, x + 3 * n), origin_x);
    tl_f32x8 ay = tl_f32x8_sub(tl_f32x8_load_twice(y), origin_y);
    tl_f32x8 cy = tl_f32x8_sub(tl_f32x8_load_twice(y + n), origin_y);
    tl_f32x8 ey = tl_f32x8_sub(tl_f32x8_load_halves(y + 2 * n, y + 3 * n), origin_y);
    ax = tl_f32x8_mul_sub_from(shear_x, az, ax);
    cx = tl_f32x8_mul_sub_from(shear_x, cz, cx);
    ex = tl_f32x8_mul_sub_from(shear_x, ez, ex);
    ay = tl_f32x8_mul_sub_from(shear_y, az, ay);
    cy = tl_f32x8_mul_sub_from(shear_y, cz, cy);
    ey = tl_f32x8_mul_sub_from(shear_y, ez, ey);
    tl_f32x8 ae = cross_lanes(ax, ay, ex, ey), ec = cross_lanes(ex, ey, cx, cy), ca = cross_lanes(cx, cy, ax, ay);
    tl_f32x8 error = tl_f32x8_all(
        job->corner_error * (LEAF_EXTENT_TERM * leaf->extent + LEAF_ERROR_TERM * job->corner_error) + FLT_MIN);
    // The signs of these tell which edges are surely negative, and which surely positive.
    tl_f32x8 below_ae = tl_f32x8_add(ae, error), above_ae = tl_f32x8_sub(error, ae);
    tl_f32x8 below_ec = tl_f32x8_add(ec, error), above_ec = tl_f32x8_sub(error, ec);
    tl_f32x8 below_ca = tl_f32x8_add(ca, error), above_ca = tl_f32x8_sub(error, ca);
    tl_f32x8 below = tl_f32x8_or(tl_f32x8_or(below_ae, below_ec), below_ca);
    tl_f32x8 above = tl_f32x8_or(tl_f32x8_or(above_ae, above_ec), above_ca);
    uint32_t rejected = tl_f32x8_signs(tl_f32x8_and(below, above));
    lanes->maybe = ~rejected & (((1u << n) - 1u) * 0x11u);
    lanes->sure = tl_f32x8_or(tl_f32x8_and(tl_f32x8_and(below_ae, below_ec), below_ca),
                              tl_f32x8_and(tl_f32x8_and(above_ae, above_ec), above_ca));
    lanes->ax = ax;
    lanes->cx = cx;
    lanes->ex = ex;
    lanes->ay = ay;
    lanes->cy = cy;
    lanes->ey = ey;
    lanes->az = az;
    lanes->cz = cz;
    lanes->ez = ez;
    lanes->ae = ae;
    lanes->ec = ec;
    lanes->ca = ca;
}

// How near the best hit so far is, in box t.
typedef struct walk_best {
    float limit; // what surely lies beyond it is no better
    float ahead; // what surely lies before it is better
} walk_best;

static inline walk_best best_of_job(const tl_ray_job *job)
{
    walk_best best = { job->box_limit, job->t * job->box_t.scale * (1.0f - T_MARGIN) };
    return best;
}

static inline uint32_t lane_of_bit(uint32_t bit, uint32_t n)
{
    return bit < 4 ? bit : n + bit - 4;
}

#include "soup/ray/ray_walk_measure.inl"

// The lanes of a leaf that may be hit, as far as the float filters tell.
typedef struct walk_lanes {
    uint32_t maybe; // bits
    uint32_t met;   // bits: the line meets them
    uint32_t clear; // bits: t is within the bounds
    float low[8], high[8];
} walk_lanes;

enum { NO_LANE = 8 };

static TL_NOINLINE void settle_each(tl_ray_job *job, const walk_lanes *lanes, const tl_soup_leaf *leaf, uint32_t n)
{
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    for (uint32_t maybe = lanes->maybe; maybe != 0; maybe &= maybe - 1) {
        uint32_t bit = tl_lowest_bit(maybe), lane = lane_of_bit(bit, n);
        bool beyond = (lanes->clear >> bit & 1u) != 0 && lanes->low[bit] > job->box_limit;
        // With spatial splits several leaves may hold a triangle.
        if (beyond || ids[lane] == TL_ID_NONE || (ids[lane] & TL_ID_INDEX) == job->triangle) {
            continue;
        }
        if ((lanes->met >> bit & 1u) == 0 || !measure_each(job, leaf, n, bit)) {
            (void)tl_ray_decide(job, leaf, lane);
        }
    }
}

static TL_ALWAYS_INLINE tl_f32x8 farthest_across(const leaf_lanes *v)
{
    tl_f32x8 a = tl_f32x8_max_bits(tl_f32x8_abs(v->ax), tl_f32x8_abs(v->ay));
    tl_f32x8 c = tl_f32x8_max_bits(tl_f32x8_abs(v->cx), tl_f32x8_abs(v->cy));
    tl_f32x8 e = tl_f32x8_max_bits(tl_f32x8_abs(v->ex), tl_f32x8_abs(v->ey));
    return tl_f32x8_max_bits(tl_f32x8_max_bits(a, c), e);
}

// The lane of `better` whose interval ends first, or NO_LANE; `maybe` holds all of them, and was known long before. By
// branches, which the processor predicts: work on the lane then begins before the division above has told which it is.
static TL_ALWAYS_INLINE uint32_t nearest_lane(const walk_lanes *lanes, uint32_t maybe, uint32_t better)
{
    uint32_t nearest = NO_LANE;
    do {
        uint32_t bit = tl_lowest_bit(maybe);
        if ((better >> bit & 1u) != 0 && (nearest == NO_LANE || lanes->high[bit] < lanes->high[nearest])) {
            nearest = bit;
            TL_KEEP_BRANCH(nearest);
        }
        maybe &= maybe - 1;
    } while (maybe != 0);
    return nearest;
}

// Whether the filter lets a triangle count that is surely hit, by its id word and the weights' sign.
static bool word_counts(const tl_ray_job *job, uint32_t id, bool negative)
{
    const bool positive = negative == tl_id_is_reversed(id);
    const tl_seen seen = (job->per_depth > 0.0f) == positive ? TL_SEEN_BACK : TL_SEEN_FRONT;
    return tl_ray_filter_accepts(job->soup, job->filter, id & TL_ID_INDEX, seen);
}

// Which of the lanes that are surely hit the filter ignores, with all triangles in them. All weights of such a lane
// have one sign, that of `negative` for the order of its slots, and so it is known from which side the ray comes.
static TL_NOINLINE uint32_t ignored_lanes(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, uint32_t sure,
                                          uint32_t negative)
{
    uint32_t ignored = 0;
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    for (; sure != 0; sure &= sure - 1) {
        uint32_t bit = tl_lowest_bit(sure), id = ids[lane_of_bit(bit, n)];
        const bool is_negative = (negative >> bit & 1u) != 0;
        const uint32_t *word = tl_soup_coincident(job->soup, id);
        bool counts, is_last;
        do {
            id = word != NULL ? *word : id;
            counts = word_counts(job, id, is_negative);
            is_last = word == NULL || (*word++ & TL_ID_LAST) != 0;
        } while (!counts && !is_last);
        ignored |= (uint32_t)!counts << bit;
    }
    return ignored;
}

// Settles the lanes of a leaf of n pairs that may be hit. True: any hit will do, and there is one.
static TL_ALWAYS_INLINE bool settle_lanes(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, const leaf_lanes *v,
                                          bool any, walk_best *best)
{
    float per_depth = job->per_depth;
    float size = fabsf(per_depth);
    tl_f32x8 sum = tl_f32x8_add(tl_f32x8_add(v->ae, v->ec), v->ca);
    tl_f32x8 inverse = tl_f32x8_div(tl_f32x8_all(1.0f), sum);
    tl_f32x8 weighted =
        tl_f32x8_add(tl_f32x8_add(tl_f32x8_mul(v->ae, v->cz), tl_f32x8_mul(v->ec, v->az)), tl_f32x8_mul(v->ca, v->ez));
    tl_f32x8 t = tl_f32x8_mul(tl_f32x8_mul(weighted, tl_f32x8_all(per_depth)), inverse);
    tl_f32x8 deepest = tl_f32x8_max(tl_f32x8_max(v->az, v->cz), v->ez);
    tl_f32x8 nearest_z = tl_f32x8_min(tl_f32x8_min(v->az, v->cz), v->ez);
    tl_f32x8 depth = tl_f32x8_max(tl_f32x8_abs(deepest), tl_f32x8_abs(nearest_z));
    tl_f32x8 across = farthest_across(v);
    tl_f32x8 corner_error =
        tl_f32x8_mul_add(tl_f32x8_add(across, depth), tl_f32x8_all(TL_RAY_CORNER_ERROR), tl_f32x8_all(FLT_MIN));
    tl_f32x8 error = tl_f32x8_mul_add(corner_error, tl_f32x8_all(LANE_ERROR_TERM),
                                      tl_f32x8_mul(across, tl_f32x8_all(LANE_SIZE_TERM)));
    error = tl_f32x8_mul_add(error, corner_error, tl_f32x8_all(LANE_UNDERFLOW));
    tl_f32x8 ratio = tl_f32x8_abs(tl_f32x8_mul(error, inverse));
    float rounding = T_ROUNDING * size;
    tl_f32x8 spread = tl_f32x8_mul_add(depth, tl_f32x8_all(rounding), tl_f32x8_all(rounding * DEPTH_UNDERFLOW));
    tl_f32x8 slope = tl_f32x8_mul(tl_f32x8_sub(deepest, nearest_z), tl_f32x8_all(T_RATIO_TERM * size));
    spread = tl_f32x8_mul_add(ratio, slope, spread);
    tl_f32x8 low = tl_f32x8_sub(t, spread), high = tl_f32x8_add(t, spread);
    uint32_t clear = tl_f32x8_less(ratio, tl_f32x8_all(1.0f / LANE_MIN_RATIO)) & (job->has_intervals ? 0xffu : 0u);
    uint32_t gone = tl_f32x8_less(high, tl_f32x8_all(0.0f)) | tl_f32x8_less(tl_f32x8_all(best->limit), low);
    uint32_t maybe = v->maybe & ~(gone & clear);
    if (maybe == 0) {
        return false;
    }
    uint32_t met = tl_f32x8_signs(v->sure) & (job->has_intervals ? 0xffu : 0u);
    uint32_t sure = met & tl_f32x8_less(tl_f32x8_all(0.0f), low) & clear;
    if (job->filter != NULL) {
        maybe &= ~ignored_lanes(job, leaf, n, maybe & sure, tl_f32x8_signs(v->ae));
        if (maybe == 0) {
            return false;
        }
    }
    uint32_t better = maybe & sure & tl_f32x8_less(high, tl_f32x8_all(best->ahead));
    if (any && better != 0) {
        return true;
    }
    walk_lanes lanes;
    tl_f32x8_store(lanes.low, low);
    tl_f32x8_store(lanes.high, high);
    uint32_t nearest = nearest_lane(&lanes, v->maybe, better);
    if (nearest != NO_LANE) {
        uint32_t behind = clear & tl_f32x8_less(tl_f32x8_all(lanes.high[nearest]), low);
        if ((maybe & ~behind & ~(1u << nearest)) == 0 && measure_met(job, leaf, n, nearest)) {
            // The bounds, not t itself: the walk goes on before that is known.
            best->limit = lanes.high[nearest];
            best->ahead = lanes.low[nearest];
            return false;
        }
    }
    lanes.maybe = maybe;
    lanes.met = met;
    lanes.clear = clear;
    settle_each(job, &lanes, leaf, n);
    *best = best_of_job(job);
    return any && job->triangle != UINT32_MAX;
}

static TL_ALWAYS_INLINE bool visit_leaf(tl_ray_job *job, const walk_ray *ray, uint32_t child, bool any, walk_best *best)
{
    const tl_soup_leaf *leaf = (const tl_soup_leaf *)(const void *)(ray->leaves + tl_child_leaf_offset(child));
    uint32_t n = tl_child_pair_count(child);
    leaf_lanes lanes;
    test_leaf(job, leaf, n, &lanes);
    return lanes.maybe != 0 && settle_lanes(job, leaf, n, &lanes, any, best);
}

// The end of a walk: false when nothing was hit. (A sure hit has ended an any-hit query before.)
static TL_ALWAYS_INLINE bool report_hit(const tl_ray_job *job, tl_ray_hit *hit)
{
    if (job->triangle == UINT32_MAX) {
        return false;
    }
    if (hit != NULL) {
        tl_ray_describe_inline(job, hit);
    }
    return true;
}

static TL_ALWAYS_INLINE void begin_walk(const tl_ray_job *job, uint32_t node_size, walk_ray *ray, walk_best *best)
{
    ray->near_rows = ray_rows[job->backward];
    ray->far_rows = ray_rows[job->backward ^ 7u];
    ray->node_size = node_size;
    ray->nodes = (const char *)job->soup + job->soup->node_offset;
    ray->leaves = (const char *)job->soup + job->soup->leaf_offset;
    *best = best_of_job(job);
}

// The next child in front of the limit. False: none is left.
static TL_ALWAYS_INLINE bool pop_child(const walk_entry *stack, uint32_t *stack_count, float limit, uint32_t *child)
{
    uint32_t limit_bits;
    memcpy(&limit_bits, &limit, sizeof limit_bits);
    walk_entry last = (uint64_t)limit_bits << 32 | UINT32_MAX;
    do {
        if (*stack_count == 0) {
            return false;
        }
        --*stack_count;
    } while (stack[*stack_count] > last);
    *child = (uint32_t)stack[*stack_count];
    return true;
}

static TL_ALWAYS_INLINE bool walk_soup(tl_ray_job *job, tl_ray_hit *hit)
{
    const bool any = hit == NULL;
    walk_ray ray;
    walk_best best;
    begin_walk(job, sizeof(tl_soup_node), &ray, &best);
    walk_entry stack[WALK_STACK_SIZE];
    uint32_t stack_count = 0, child = 0;
    for (;;) {
        if ((child & TL_CHILD_LEAF) == 0) {
            const tl_soup_node *node = (const tl_soup_node *)(const void *)(ray.nodes + child * sizeof(tl_soup_node));
            _Alignas(64) uint32_t t_bits[TL_SOUP_WIDTH]; // one line: a split store is not forwarded
            uint32_t mask = enter_children(job, &ray, node, best.limit, t_bits);
            if (mask != 0) {
                child = push_children(&ray, t_bits, node->child, mask, any, stack, &stack_count);
                continue;
            }
        } else if (visit_leaf(job, &ray, child, any, &best)) {
            return true;
        }
        if (!pop_child(stack, &stack_count, best.limit, &child)) {
            return report_hit(job, hit);
        }
    }
}

#include "soup/ray/ray_walk_compact.inl"

bool TL_RAY_WALK(const tl_soup *soup, const tl_vec3 *origin, const tl_vec3 *target, float tmax, bool is_segment,
                 const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    tl_ray_job job;
    job.soup = soup;
    job.filter = tl_ray_filter_in_use(soup, filter);
    job.is_segment = is_segment;
    job.t = tmax;
    if (!tl_ray_prepare_inline(&job, origin, target) || (job.outside != 0 && !tl_ray_meets_bounds(&job))) {
        return false;
    }
    if (soup->layout == TL_SOUP_COMPACT) {
        return walk_compact(&job, hit_out);
    }
    return hit_out == NULL ? walk_soup(&job, NULL) : walk_soup(&job, hit_out);
}
