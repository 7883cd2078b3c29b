// SPDX-License-Identifier: MIT
//
// The kernels of crowd_kernels.h, over the vocabulary of math/simd.h. The file that includes this names the table by
// TL_CROWD_KERNELS.
//
// Finding ten neighbours among twenty candidates and their half-planes was two thirds of a step's instructions, most of
// them for branches that depend on the data. Here all lanes compute every case, and choose.

#include "math/simd.h"

#ifndef TL_CROWD_KERNELS
#error "name the table"
#endif

// Lanes of the four from `k` on that lie before `end`.
static inline uint32_t lanes_before(uint32_t k, uint32_t end)
{
    return end - k >= CROWD_LANES ? (1u << CROWD_LANES) - 1 : (1u << (end - k)) - 1;
}

// Appends the lanes in `mask` whose heads are above `low`: without a branch, so each writes, and those out of it are
// written over.
static inline void append_found(crowd_scan *scan, uint32_t mask, uint32_t k, float low, tl_f32x4 gap)
{
    const crowd_seen_agent *agents = scan->seen->agents;
    float gaps[CROWD_LANES];
    tl_f32x4_store(gaps, gap);
    uint32_t count = scan->count;
    for (uint32_t lane = 0; lane < CROWD_LANES; lane++) {
        scan->gap[count] = gaps[lane];
        scan->at[count] = k + lane;
        count += mask >> lane & 1u & (uint32_t)(agents[k + lane].top > low);
    }
    scan->count = count;
}

static bool scan_spans(crowd_scan *scan)
{
    const crowd_seen_agent *agents = scan->seen->agents;
    const uint32_t self = scan->self, full = scan->full;
    const crowd_seen_agent *own = &agents[self];
    const tl_f32x4 own_x = tl_f32x4_all(own->x), own_z = tl_f32x4_all(own->z), high = tl_f32x4_all(own->top);
    const tl_f32x4 own_radius = tl_f32x4_all(own->radius), reach = tl_f32x4_all(scan->reach);
    for (; scan->next_span < scan->span_count; scan->next_span++) {
        crowd_span *span = &scan->spans[scan->next_span];
        for (uint32_t k = span->begin; k < span->end; k += CROWD_LANES) {
            if (scan->count > full) {
                span->begin = k;
                return false;
            }
            tl_f32x4 x = tl_f32x4_load(&agents[k].x), z = tl_f32x4_load(&agents[k + 1].x);
            tl_f32x4 radius = tl_f32x4_load(&agents[k + 2].x), bottom = tl_f32x4_load(&agents[k + 3].x);
            tl_f32x4_transpose(&x, &z, &radius, &bottom);
            const tl_f32x4 dx = tl_f32x4_sub(x, own_x), dz = tl_f32x4_sub(z, own_z);
            const tl_f32x4 rims = tl_f32x4_add(radius, own_radius);
            const tl_f32x4 far = tl_f32x4_add(reach, rims);
            const tl_f32x4 distance_sq = tl_f32x4_add(tl_f32x4_mul(dx, dx), tl_f32x4_mul(dz, dz));
            const uint32_t out = tl_f32x4_less_equal(tl_f32x4_mul(far, far), distance_sq) |
                                 tl_f32x4_less_equal(high, bottom) | (self - k < CROWD_LANES ? 1u << (self - k) : 0);
            const uint32_t near = lanes_before(k, span->end) & ~out;
            if (near != 0) {
                append_found(scan, near, k, own->bottom, tl_f32x4_sub(tl_f32x4_sqrt(distance_sq), rims));
            }
        }
    }
    scan->next_span = scan->span_count = 0;
    return true;
}

// By comparing each with all: no branch depends on the data, while each step of an insertion mispredicts one.
static bool rank_gaps(float *gaps, uint32_t count, uint32_t *ranks_out)
{
    const tl_f32x4 one = tl_f32x4_all(1.0f), none = tl_f32x4_all(0.0f);
    for (uint32_t i = count; i % CROWD_LANES != 0; i++) {
        gaps[i] = INFINITY;
    }
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i += CROWD_LANES) {
        const tl_f32x4 mine = tl_f32x4_load(gaps + i);
        tl_f32x4 before = none;
        for (uint32_t k = 0; k < count; k++) {
            before = tl_f32x4_add(before, tl_f32x4_if_less(tl_f32x4_all(gaps[k]), mine, one, none));
        }
        int32_t ranks[CROWD_LANES];
        tl_f32x4_store_whole(ranks, before);
        for (uint32_t lane = 0; lane < CROWD_LANES; lane++) {
            ranks_out[i + lane] = (uint32_t)ranks[lane];
            sum += i + lane < count ? (uint32_t)ranks[lane] : 0;
        }
    }
    return sum == count * (count - 1) / 2; // equal ones have the smaller rank of the two
}

// Where some of four do not just walk.
static inline void view_kinds(const crowd_seen_agent *const four[CROWD_LANES], uint32_t k, crowd_view *view)
{
    for (uint32_t lane = 0; lane < CROWD_LANES; lane++) {
        const crowd_seen_agent *one = four[lane];
        const uint32_t at = k + lane;
        view->fixed |= one->kind / CROWD_SEEN_FIXED % 2 << at;
        view->still |= one->kind / CROWD_SEEN_STILL % 2 << at;
        view->yields |= one->kind / CROWD_SEEN_YIELDS % 2 << at;
        if ((one->kind & CROWD_SEEN_FIXED) != 0) {
            view->wanted_x[at] = view->way_x[at] = one->vx;
            view->wanted_z[at] = view->way_z[at] = one->vz;
        }
    }
}

// Four neighbours from lane `k` on, turned from their order in memory.
static inline void view_four(const crowd_seen_agent *const four[CROWD_LANES], const crowd_seen_agent *own,
                             float radius_share, uint32_t k, crowd_view *view)
{
    crowd_discs *discs = &view->discs;
    tl_f32x4 x = tl_f32x4_load(&four[0]->x), z = tl_f32x4_load(&four[1]->x);
    tl_f32x4 radius = tl_f32x4_load(&four[2]->x), bottom = tl_f32x4_load(&four[3]->x);
    tl_f32x4_transpose(&x, &z, &radius, &bottom);
    tl_f32x4_store(discs->x + k, tl_f32x4_sub(x, tl_f32x4_all(own->x)));
    tl_f32x4_store(discs->z + k, tl_f32x4_sub(z, tl_f32x4_all(own->z)));
    const tl_f32x4 radii = tl_f32x4_add(tl_f32x4_all(own->radius), radius);
    tl_f32x4_store(discs->radius + k, tl_f32x4_mul(tl_f32x4_all(radius_share), radii));
    tl_f32x4 vx = tl_f32x4_load(&four[0]->vx), vz = tl_f32x4_load(&four[1]->vx);
    tl_f32x4 wanted_x = tl_f32x4_load(&four[2]->vx), wanted_z = tl_f32x4_load(&four[3]->vx);
    tl_f32x4_transpose(&vx, &vz, &wanted_x, &wanted_z);
    tl_f32x4_store(discs->vx + k, tl_f32x4_sub(tl_f32x4_all(own->vx), vx));
    tl_f32x4_store(discs->vz + k, tl_f32x4_sub(tl_f32x4_all(own->vz), vz));
    tl_f32x4_store(view->wanted_x + k, wanted_x);
    tl_f32x4_store(view->wanted_z + k, wanted_z);
    uint32_t kinds = 0;
    for (uint32_t lane = 0; lane < CROWD_LANES; lane++) {
        float way[2];
        tl_crowd_travel(four[lane]->kind, way);
        view->way_x[k + lane] = way[0];
        view->way_z[k + lane] = way[1];
        view->priority[k + lane] = four[lane]->priority;
        kinds |= four[lane]->kind;
    }
    if ((kinds & (CROWD_SEEN_FIXED | CROWD_SEEN_STILL | CROWD_SEEN_YIELDS)) != 0) {
        view_kinds(four, k, view);
    }
}

static void view_neighbors(const crowd_snapshot *seen, uint32_t self, const crowd_neighbor *neighbors, uint32_t count,
                           float radius_share, crowd_view *view_out)
{
    const crowd_seen_agent *own = &seen->agents[self];
    view_out->discs.count = count;
    view_out->discs.own_vx = own->vx;
    view_out->discs.own_vz = own->vz;
    view_out->fixed = view_out->still = view_out->yields = 0;
    for (uint32_t k = 0; k < count; k += CROWD_LANES) {
        const crowd_seen_agent *four[CROWD_LANES];
        for (uint32_t lane = 0; lane < CROWD_LANES; lane++) {
            four[lane] = k + lane < count ? &seen->agents[neighbors[k + lane].snapshot] : own;
        }
        view_four(four, own, radius_share, k, view_out);
    }
}

static crowd_traffic_bits look_at_view(const crowd_view *view, const crowd_outlook *look)
{
    const tl_f32x4 zero = tl_f32x4_all(0.0f);
    const tl_f32x4 least_sq = tl_f32x4_all(CROWD_STANDING_SPEED * CROWD_STANDING_SPEED);
    const tl_f32x4 ahead_x = tl_f32x4_all(look->ahead[0]), ahead_z = tl_f32x4_all(look->ahead[1]);
    const tl_f32x4 travel_x = tl_f32x4_all(look->travel[0]), travel_z = tl_f32x4_all(look->travel[1]);
    uint32_t behind = 0, along = 0, quick = 0;
    for (uint32_t k = 0; k < view->discs.count; k += CROWD_LANES) {
        const tl_f32x4 x = tl_f32x4_load(view->discs.x + k), z = tl_f32x4_load(view->discs.z + k);
        const tl_f32x4 before = tl_f32x4_add(tl_f32x4_mul(x, ahead_x), tl_f32x4_mul(z, ahead_z));
        behind |= tl_f32x4_less_equal(before, zero) << k;
        const tl_f32x4 wanted_x = tl_f32x4_load(view->wanted_x + k), wanted_z = tl_f32x4_load(view->wanted_z + k);
        const tl_f32x4 speed_sq = tl_f32x4_add(tl_f32x4_mul(wanted_x, wanted_x), tl_f32x4_mul(wanted_z, wanted_z));
        quick |= tl_f32x4_less_equal(least_sq, speed_sq) << k;
        const tl_f32x4 way_x = tl_f32x4_load((look->late ? view->wanted_x : view->way_x) + k);
        const tl_f32x4 way_z = tl_f32x4_load((look->late ? view->wanted_z : view->way_z) + k);
        const tl_f32x4 toward = tl_f32x4_add(tl_f32x4_mul(way_x, travel_x), tl_f32x4_mul(way_z, travel_z));
        along |= tl_f32x4_less_equal(zero, toward) << k;
    }
    const crowd_traffic_bits bits = { ~behind, ~along, quick };
    return bits;
}

// Two vectors of the plan.
typedef struct crowd_lanes {
    tl_f32x4 x, z;
} crowd_lanes;

// Lanes of c where a < b, else of d.
static inline crowd_lanes if_less(tl_f32x4 a, tl_f32x4 b, crowd_lanes c, crowd_lanes d)
{
    const crowd_lanes lanes = { tl_f32x4_if_less(a, b, c.x, d.x), tl_f32x4_if_less(a, b, c.z, d.z) };
    return lanes;
}

// Along the leg of the cone that is nearer to w.
static inline crowd_lanes along_leg(crowd_lanes to, tl_f32x4 radius, tl_f32x4 distance_sq, crowd_lanes w)
{
    const tl_f32x4 leg = tl_f32x4_sqrt(tl_f32x4_sub(distance_sq, tl_f32x4_mul(radius, radius)));
    const tl_f32x4 x_leg = tl_f32x4_mul(to.x, leg), z_leg = tl_f32x4_mul(to.z, leg);
    const tl_f32x4 x_radius = tl_f32x4_mul(to.x, radius), z_radius = tl_f32x4_mul(to.z, radius);
    const crowd_lanes left = { tl_f32x4_sub(x_leg, z_radius), tl_f32x4_add(x_radius, z_leg) };
    const crowd_lanes right = { tl_f32x4_neg(tl_f32x4_add(x_leg, z_radius)),
                                tl_f32x4_neg(tl_f32x4_sub(z_leg, x_radius)) };
    const tl_f32x4 side = tl_f32x4_sub(tl_f32x4_mul(to.x, w.z), tl_f32x4_mul(to.z, w.x));
    const crowd_lanes along = if_less(tl_f32x4_all(0.0f), side, left, right);
    const crowd_lanes unit = { tl_f32x4_div(along.x, distance_sq), tl_f32x4_div(along.z, distance_sq) };
    return unit;
}

static inline void store_plane(tl_half_plane *plane, tl_f32x4 lanes)
{
    float four[CROWD_LANES];
    tl_f32x4_store(four, lanes);
    memcpy(plane, four, sizeof *plane);
}

// The half-planes of four discs. `outward`: how far the agent's velocity lies within what is forbidden, < 0: outside of
// it. Velocities that lead to the disc within its time are those in a cone, cut off by the disc that is reached at the
// end of that time: out of the cut-off, where w comes from its inner side or the discs overlap, else out of a leg.
static inline void avoid_four(const crowd_discs *discs, uint32_t k, tl_half_plane *planes_out)
{
    const tl_f32x4 zero = tl_f32x4_all(0.0f);
    const crowd_lanes to = { tl_f32x4_load(discs->x + k), tl_f32x4_load(discs->z + k) };
    const crowd_lanes velocity = { tl_f32x4_load(discs->vx + k), tl_f32x4_load(discs->vz + k) };
    const tl_f32x4 radius = tl_f32x4_load(discs->radius + k);
    const tl_f32x4 radius_sq = tl_f32x4_mul(radius, radius);
    const tl_f32x4 distance_sq = tl_f32x4_add(tl_f32x4_mul(to.x, to.x), tl_f32x4_mul(to.z, to.z));
    const tl_f32x4 rate =
        tl_f32x4_if_less(radius_sq, distance_sq, tl_f32x4_all(discs->rate), tl_f32x4_all(discs->overlap_rate));
    const crowd_lanes w = { tl_f32x4_sub(velocity.x, tl_f32x4_mul(to.x, rate)),
                            tl_f32x4_sub(velocity.z, tl_f32x4_mul(to.z, rate)) };
    const tl_f32x4 w_sq = tl_f32x4_add(tl_f32x4_mul(w.x, w.x), tl_f32x4_mul(w.z, w.z));
    const tl_f32x4 inward = tl_f32x4_add(tl_f32x4_mul(w.x, to.x), tl_f32x4_mul(w.z, to.z));
    // 1: out of a leg; 0: out of the cut-off.
    tl_f32x4 is_leg =
        tl_f32x4_if_less(tl_f32x4_mul(radius_sq, w_sq), tl_f32x4_mul(inward, inward), zero, tl_f32x4_all(1.0f));
    is_leg = tl_f32x4_if_less(inward, zero, is_leg, tl_f32x4_all(1.0f));
    is_leg = tl_f32x4_if_less(radius_sq, distance_sq, is_leg, zero);

    const tl_f32x4 length = tl_f32x4_sqrt(w_sq);
    const crowd_lanes apart = { tl_f32x4_div(w.x, length), tl_f32x4_div(w.z, length) };
    const crowd_lanes any = { tl_f32x4_all(1.0f), zero };
    const crowd_lanes unit = if_less(zero, length, apart, any);
    const crowd_lanes cut = { unit.z, tl_f32x4_neg(unit.x) };
    const tl_f32x4 cut_outward = tl_f32x4_sub(tl_f32x4_mul(radius, rate), length);
    const crowd_lanes leg = along_leg(to, radius, distance_sq, w);
    const tl_f32x4 leg_outward = tl_f32x4_sub(tl_f32x4_mul(velocity.x, leg.z), tl_f32x4_mul(velocity.z, leg.x));

    crowd_lanes along = if_less(zero, is_leg, leg, cut);
    const tl_f32x4 outward = tl_f32x4_if_less(zero, is_leg, leg_outward, cut_outward);
    const tl_f32x4 share =
        tl_f32x4_if_less(zero, outward, tl_f32x4_load(discs->evade + k), tl_f32x4_load(discs->room + k));
    const tl_f32x4 change = tl_f32x4_mul(share, outward);
    tl_f32x4 x = tl_f32x4_sub(tl_f32x4_all(discs->own_vx), tl_f32x4_mul(change, along.z));
    tl_f32x4 z = tl_f32x4_add(tl_f32x4_all(discs->own_vz), tl_f32x4_mul(change, along.x));
    tl_f32x4_transpose(&x, &z, &along.x, &along.z);
    store_plane(&planes_out[0], x);
    store_plane(&planes_out[1], z);
    store_plane(&planes_out[2], along.x);
    store_plane(&planes_out[3], along.z);
}

static void avoid_discs(const crowd_discs *discs, tl_half_plane *planes_out)
{
    for (uint32_t k = 0; k < discs->count; k += CROWD_LANES) {
        avoid_four(discs, k, planes_out + k);
    }
}

const crowd_kernels TL_CROWD_KERNELS = { scan_spans, rank_gaps, view_neighbors, look_at_view, avoid_discs };
