// SPDX-License-Identifier: MIT
//
// Sixteen coherent rays at once, with the bits of single rays.
//
// The rays of a packet run into the same octant and are sheared along the same axis. A node's sixteen boxes are first
// tested by the interval that holds all rays, for the price of one ray: those that pass go on the stack. A child that
// is taken from it is tested by the sixteen rays, so boxes behind what they have hit meanwhile cost one test for all of
// them. A leaf's triangles are tested one by one, sixteen rays in the lanes, with the bounds of ray_walk.inl.
//
// What the bounds decide for a lane is kept as its pending triangle, and measured at the end. A lane that they leave in
// doubt (it passes an edge too closely, or two triangles lie too near each other along it) leaves the packet, and is
// traced alone from its beginning: that is rare, and keeps every answer that of the single walk.
//
// The interval. Along an axis that the rays run up, a ray enters at plane p at (p - o) s, o its origin and s > 0 its
// plane_scale. With o' the largest o and s' the least s this is (p - o') s' or more where that is positive, and where
// it is not, 0 is the lower bound. It leaves at (p - o) s, which is at most (p - o") s" with o" the least o and s" the
// largest s, or the box lies behind all of them. Each is one product and one sum, as for a ray, and takes the pad of
// ray_prepare.h for its own s. Down an axis the roles of o' and o" change.
//
// Sources: Wald, Slusallek, Benthin, Wagner, Interactive Rendering with Coherent Ray Tracing, 2001; Reshetov, Soupikov,
// Hurley, Multi-Level Ray Tracing Algorithm, 2005 (the interval); Overbeck, Ramamoorthi, Mark, Large Ray Packets for
// Real-time Whitted Ray Tracing, 2008.

#ifndef TALUS_SRC_SOUP_RAY_WALK_PACKET_INL
#define TALUS_SRC_SOUP_RAY_WALK_PACKET_INL

#include "soup/ray/ray_walk_packet_prepare.inl"

// Entries. A packet that would overflow it is traced ray by ray.
#ifndef TL_PACKET_STACK_SIZE // a test has a shorter one
#define TL_PACKET_STACK_SIZE 256
#endif

// Which rays enter a box, given by its planes: near and far along x, y and z.
static TL_ALWAYS_INLINE uint32_t enter_box(const ray_packet *p, const float near_plane[3], const float far_plane[3])
{
    tl_f32x16 enter[3], leave[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 scale = lanes_of(p->plane_scale[i]);
        enter[i] = tl_f32x16_mul_add(tl_f32x16_all(near_plane[i]), scale, lanes_of(p->near_base[i]));
        leave[i] = tl_f32x16_mul_add(tl_f32x16_all(far_plane[i]), scale, lanes_of(p->far_base[i]));
    }
    tl_f32x16 first =
        tl_f32x16_max_bits(tl_f32x16_max_bits(enter[0], enter[1]), tl_f32x16_max_bits(enter[2], tl_f32x16_all(0.0f)));
    tl_f32x16 last =
        tl_f32x16_min_bits(tl_f32x16_min_bits(leave[0], leave[1]), tl_f32x16_min_bits(leave[2], lanes_of(p->limit)));
    return tl_f32x16_less_equal_bits(first, last);
}

static TL_ALWAYS_INLINE uint32_t enter_bounds(const tl_soup *soup, const ray_packet *p)
{
    const float *planes[2] = { &soup->bounds_min.x, &soup->bounds_max.x };
    float near_plane[3], far_plane[3];
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t down = p->backward >> i & 1u;
        near_plane[i] = planes[down][i];
        far_plane[i] = planes[down ^ 1u][i];
    }
    return enter_box(p, near_plane, far_plane);
}

static TL_ALWAYS_INLINE uint32_t enter_child(const ray_packet *p, const walk_ray *ray, const tl_soup_node *node,
                                             uint32_t lane)
{
    float near_plane[3], far_plane[3];
    for (uint32_t i = 0; i < 3; i++) {
        near_plane[i] = plane_row(node, ray->near_rows[i])[lane];
        far_plane[i] = plane_row(node, ray->far_rows[i])[lane];
    }
    return enter_box(p, near_plane, far_plane);
}

// Puts the children of a node that the interval enters on the stack, the nearest on top, each by its place: the number
// of its node times 16 and its lane.
static TL_ALWAYS_INLINE void push_places(const ray_packet *p, const walk_ray *ray, uint32_t number, walk_entry *stack,
                                         uint32_t *stack_count)
{
    const tl_soup_node *node = (const tl_soup_node *)(const void *)ray->nodes + number;
    walk_slab slabs[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 near_plane = lanes_of(plane_row(node, ray->near_rows[i]));
        tl_f32x16 far_plane = lanes_of(plane_row(node, ray->far_rows[i]));
        slabs[i].enter =
            tl_f32x16_mul_add(near_plane, tl_f32x16_all(p->enter_scale[i]), tl_f32x16_all(p->enter_base[i]));
        slabs[i].leave =
            tl_f32x16_mul_add(far_plane, tl_f32x16_all(p->leave_scale[i]), tl_f32x16_all(p->leave_base[i]));
    }
    _Alignas(64) uint32_t t_bits[TL_SOUP_WIDTH];
    walk_entry *base = stack + *stack_count;
    uint32_t count = 0;
    for (uint32_t mask = enter_boxes(slabs, p->last_limit, t_bits); mask != 0; mask &= mask - 1) {
        uint32_t lane = tl_lowest_bit(mask), place = count++;
        walk_entry entry = (uint64_t)t_bits[lane] << 32 | (number * TL_SOUP_WIDTH + lane);
        for (; place > 0 && base[place - 1] < entry; place--) {
            base[place] = base[place - 1];
        }
        base[place] = entry;
    }
    *stack_count += count;
}

// A corner of a leaf in each ray's sheared space.
typedef struct packet_corner {
    tl_f32x16 x, y, z;
} packet_corner;

// A leaf, and what shears its corners for each ray.
typedef struct packet_leaf {
    const float *x, *y, *z; // as in test_leaf
    uint32_t child;
    float extent, error;
    tl_f32x16 origin_x, origin_y, origin_z, shear_x, shear_y;
} packet_leaf;

static TL_ALWAYS_INLINE packet_corner shear_corner(const packet_leaf *leaf, uint32_t at)
{
    packet_corner c;
    c.z = tl_f32x16_sub(tl_f32x16_all(leaf->z[at]), leaf->origin_z);
    c.x = tl_f32x16_sub(tl_f32x16_all(leaf->x[at]), leaf->origin_x);
    c.y = tl_f32x16_sub(tl_f32x16_all(leaf->y[at]), leaf->origin_y);
    c.x = tl_f32x16_mul_sub_from(leaf->shear_x, c.z, c.x);
    c.y = tl_f32x16_mul_sub_from(leaf->shear_y, c.z, c.y);
    return c;
}

static TL_ALWAYS_INLINE tl_f32x16 cross_corners(packet_corner a, packet_corner b)
{
    return tl_f32x16_sub(tl_f32x16_mul(a.x, b.y), tl_f32x16_mul(a.y, b.x));
}

static TL_ALWAYS_INLINE tl_f32x16 corner_across(packet_corner a)
{
    return tl_f32x16_max(tl_f32x16_abs(a.x), tl_f32x16_abs(a.y));
}

// A triangle's corners and weights, as in leaf_lanes.
typedef struct packet_triangle {
    packet_corner a, e, c;
    tl_f32x16 ae, ec, ca;
} packet_triangle;

static TL_ALWAYS_INLINE void leave_packet(ray_packet *p, uint32_t rays)
{
    tl_f32x16_store(p->limit, tl_f32x16_choose(rays, tl_f32x16_all(-1.0f), lanes_of(p->limit)));
}

// Notes a triangle that some rays may meet. They stay in the packet, as something else may surely be hit.
static TL_NOINLINE void note_doubts(ray_packet *p, uint32_t child, uint32_t bit, uint32_t rays)
{
    for (; rays != 0; rays &= rays - 1) {
        if (p->doubt_count == TL_PACKET_DOUBTS) {
            p->alone |= rays;
            return;
        }
        packet_doubt doubt = { child, (uint16_t)bit, (uint16_t)tl_lowest_bit(rays) };
        p->doubts[p->doubt_count++] = doubt;
    }
}

// Settles the rays that may meet a triangle, by bounds as in settle_lanes. For the sizes of the triangle they take the
// leaf's largest: narrower intervals were no faster here.
static TL_ALWAYS_INLINE void settle_rays(ray_packet *p, const packet_leaf *leaf, const packet_triangle *v,
                                         uint32_t maybe, uint32_t met, uint32_t bit, bool any)
{
    tl_f32x16 per_depth = lanes_of(p->plane_scale[p->axes[2]]), size = tl_f32x16_abs(per_depth);
    tl_f32x16 inverse = tl_f32x16_div(tl_f32x16_all(1.0f), tl_f32x16_add(tl_f32x16_add(v->ae, v->ec), v->ca));
    tl_f32x16 weighted = tl_f32x16_add(tl_f32x16_add(tl_f32x16_mul(v->ae, v->c.z), tl_f32x16_mul(v->ec, v->a.z)),
                                       tl_f32x16_mul(v->ca, v->e.z));
    tl_f32x16 t = tl_f32x16_mul(tl_f32x16_mul(weighted, per_depth), inverse);
    tl_f32x16 depth = tl_f32x16_abs(v->a.z);
    tl_f32x16 corner_error = tl_f32x16_mul_add(depth, tl_f32x16_all(TL_RAY_CORNER_ERROR),
                                               tl_f32x16_all(2.0f * TL_RAY_CORNER_ERROR * leaf->extent + FLT_MIN));
    tl_f32x16 farthest = tl_f32x16_max(tl_f32x16_max(corner_across(v->a), corner_across(v->c)), corner_across(v->e));
    tl_f32x16 error = tl_f32x16_mul_add(corner_error, tl_f32x16_all(LANE_ERROR_TERM),
                                        tl_f32x16_mul(farthest, tl_f32x16_all(LANE_SIZE_TERM)));
    error = tl_f32x16_mul_add(error, corner_error, tl_f32x16_all(LANE_UNDERFLOW));
    tl_f32x16 ratio = tl_f32x16_abs(tl_f32x16_mul(error, inverse));
    tl_f32x16 rounding = tl_f32x16_mul(tl_f32x16_all(T_ROUNDING), size);
    tl_f32x16 spread =
        tl_f32x16_mul_add(depth, rounding, tl_f32x16_mul(rounding, tl_f32x16_all(leaf->extent + DEPTH_UNDERFLOW)));
    spread = tl_f32x16_mul_add(ratio, tl_f32x16_mul(tl_f32x16_all(T_RATIO_TERM * leaf->extent), size), spread);
    tl_f32x16 low = tl_f32x16_sub(t, spread), high = tl_f32x16_add(t, spread);
    tl_f32x16 zero = tl_f32x16_all(0.0f), limit = lanes_of(p->limit), ahead = lanes_of(p->ahead);
    uint32_t clear = tl_f32x16_less(ratio, tl_f32x16_all(1.0f / LANE_MIN_RATIO));
    uint32_t gone = (tl_f32x16_less(high, zero) | tl_f32x16_less(limit, low)) & clear;
    maybe &= ~gone;
    uint32_t sure = maybe & met & clear & tl_f32x16_less(zero, low), better = sure & tl_f32x16_less(high, ahead);
    if (any) {
        p->found |= better;
        leave_packet(p, better);
        if ((maybe & ~better) != 0) {
            note_doubts(p, leaf->child, bit, maybe & ~better);
        }
        return;
    }
    uint32_t rivals = sure & ~better;
    if (rivals != 0) {
        rivals &= p->pending & ~p->contested;
        tl_u32x16_store_where(p->rival_child, rivals, leaf->child);
        tl_u32x16_store_where(p->rival_bit, rivals, bit);
    }
    uint32_t doubtful = maybe & ~(better | rivals);
    p->alone |= doubtful;
    p->pending |= better;
    p->contested = (p->contested & ~better) | rivals;
    limit = tl_f32x16_choose(better | rivals, tl_f32x16_min(high, limit), limit);
    tl_f32x16_store(p->limit, tl_f32x16_choose(doubtful, tl_f32x16_all(-1.0f), limit));
    tl_f32x16_store(p->ahead, tl_f32x16_choose(better | rivals, tl_f32x16_min(low, ahead), ahead));
    tl_u32x16_store_where(p->child, better, leaf->child);
    tl_u32x16_store_where(p->bit, better, bit);
}

// Tests a triangle of corners a, e and c. True: some ray's limit has changed.
static TL_ALWAYS_INLINE bool test_triangle(ray_packet *p, const packet_leaf *leaf, const packet_triangle *v,
                                           uint32_t rays, uint32_t bit, bool any)
{
    tl_f32x16 least = tl_f32x16_min(tl_f32x16_min(v->ae, v->ec), v->ca);
    tl_f32x16 most = tl_f32x16_max(tl_f32x16_max(v->ae, v->ec), v->ca);
    tl_f32x16 error = tl_f32x16_all(leaf->error), minus_error = tl_f32x16_all(-leaf->error);
    uint32_t missed = tl_f32x16_less(least, minus_error) & tl_f32x16_less(error, most);
    uint32_t maybe = rays & ~missed;
    if (maybe == 0) {
        return false;
    }
    uint32_t met = tl_f32x16_less(error, least) | tl_f32x16_less(most, minus_error);
    settle_rays(p, leaf, v, maybe, met, bit, any);
    return true;
}

static TL_ALWAYS_INLINE void visit_packet_leaf(ray_packet *p, const walk_ray *ray, uint32_t child, uint32_t rays,
                                               bool any)
{
    const tl_soup_leaf *head = (const tl_soup_leaf *)(const void *)(ray->leaves + tl_child_leaf_offset(child));
    const uint32_t *ids = (const uint32_t *)(const void *)(head + 1);
    uint32_t n = tl_child_pair_count(child);
    const float *floats = (const float *)(const void *)(ids + 2 * (size_t)n);
    size_t stride = 4 * (size_t)n;
    packet_leaf leaf;
    leaf.x = floats + p->axes[0] * stride;
    leaf.y = floats + p->axes[1] * stride;
    leaf.z = floats + p->axes[2] * stride;
    leaf.child = child;
    leaf.extent = head->extent;
    leaf.origin_x = lanes_of(p->origin[p->axes[0]]);
    leaf.origin_y = lanes_of(p->origin[p->axes[1]]);
    leaf.origin_z = lanes_of(p->origin[p->axes[2]]);
    leaf.shear_x = lanes_of(p->shear[0]);
    leaf.shear_y = lanes_of(p->shear[1]);
    leaf.error = p->corner_error * (LEAF_EXTENT_TERM * leaf.extent + LEAF_ERROR_TERM * p->corner_error) + FLT_MIN;
    bool changed = false;
    for (uint32_t i = 0; i < n; i++) {
        packet_triangle v;
        v.a = shear_corner(&leaf, i);
        v.c = shear_corner(&leaf, n + i);
        v.ca = cross_corners(v.c, v.a);
        for (uint32_t second = 0; second < 2 && ids[second * n + i] != TL_ID_NONE; second++) {
            v.e = shear_corner(&leaf, (2 + second) * n + i);
            v.ae = cross_corners(v.a, v.e);
            v.ec = cross_corners(v.e, v.c);
            changed |= test_triangle(p, &leaf, &v, rays, i + 4 * second, any);
        }
    }
    if (changed) {
        p->last_limit = tl_f32x16_largest(lanes_of(p->limit));
    }
}

static TL_ALWAYS_INLINE void walk_packet(const tl_soup *soup, ray_packet *p, bool any)
{
    walk_ray ray;
    ray.near_rows = ray_rows[p->backward];
    ray.far_rows = ray_rows[p->backward ^ 7u];
    ray.node_size = sizeof(tl_soup_node);
    ray.nodes = (const char *)soup + soup->node_offset;
    ray.leaves = (const char *)soup + soup->leaf_offset;
    walk_entry stack[TL_PACKET_STACK_SIZE];
    uint32_t stack_count = 0, place;
    leave_packet(p, ~enter_bounds(soup, p) & PACKET_ALL);
    p->last_limit = tl_f32x16_largest(lanes_of(p->limit));
    push_places(p, &ray, 0, stack, &stack_count);
    while (p->last_limit >= 0.0f && pop_child(stack, &stack_count, p->last_limit, &place)) {
        const tl_soup_node *node = (const tl_soup_node *)(const void *)ray.nodes + place / TL_SOUP_WIDTH;
        uint32_t lane = place % TL_SOUP_WIDTH, child = node->child[lane];
        uint32_t rays = enter_child(p, &ray, node, lane);
        if (rays == 0) {
            continue;
        }
        if ((child & TL_CHILD_LEAF) != 0) {
            visit_packet_leaf(p, &ray, child, rays, any);
        } else if (stack_count <= TL_PACKET_STACK_SIZE - TL_SOUP_WIDTH) {
            push_places(p, &ray, child, stack, &stack_count);
        } else {
            p->alone = p->rays & ~p->found;
            return;
        }
    }
}

#include "soup/ray/ray_walk_packet_measure.inl"

// Whether a ray of an any-hit query meets one of the triangles, from doubt `first` on, that the bounds left in doubt
// for it.
static bool meets_doubted(const tl_ray_batch *batch, const ray_packet *p, uint32_t first)
{
    uint32_t ray = p->doubts[first].ray;
    const tl_vec3 *origin, *target;
    tl_ray_job job;
    job.soup = batch->soup;
    job.filter = NULL; // packets have none
    job.is_segment = batch->rays == NULL;
    tl_ray_of_batch(batch, p->index[ray], &origin, &target, &job.t);
    if (!tl_ray_prepare_inline(&job, origin, target)) {
        return false;
    }
    for (uint32_t i = first; i < p->doubt_count; i++) {
        const packet_doubt *doubt = &p->doubts[i];
        const tl_soup_leaf *leaf = tl_soup_leaf_at(batch->soup, tl_child_leaf_offset(doubt->child));
        uint32_t lane = lane_of_bit(doubt->bit, tl_child_pair_count(doubt->child));
        if (doubt->ray == ray && tl_ray_decide(&job, leaf, lane)) {
            return true;
        }
    }
    return false;
}

// Decides for the rays that hit nothing else. For a ray in doubt that is a third of what tracing it alone takes.
static TL_NOINLINE void decide_doubts(const tl_ray_batch *batch, ray_packet *p)
{
    uint32_t open = p->rays & ~(p->found | p->alone);
    for (uint32_t i = 0; i < p->doubt_count; i++) {
        uint32_t ray = 1u << p->doubts[i].ray;
        if ((open & ray) != 0 && meets_doubted(batch, p, i)) {
            p->found |= ray;
        }
        open &= ~ray;
    }
}

static TL_ALWAYS_INLINE void report_packet(const tl_ray_batch *batch, ray_packet *p)
{
    if (p->doubt_count != 0) {
        decide_doubts(batch, p);
    }
    uint32_t alone = p->alone & p->rays & ~p->found, pending = p->pending & p->rays & ~alone;
    for (uint32_t rays = p->rays & ~alone & ~pending; rays != 0; rays &= rays - 1) {
        uint32_t lane = tl_lowest_bit(rays);
        tl_ray_report(batch, p->index[lane], (p->found >> lane & 1u) != 0);
    }
    if (pending != 0) {
        alone |= measure_packet(batch, p, pending);
    }
    for (; alone != 0; alone &= alone - 1) {
        tl_ray_batch_one(batch, p->index[tl_lowest_bit(alone)]);
    }
}

static TL_NOINLINE void trace_packet(const tl_ray_batch *batch, bool one_origin, ray_packet *p)
{
    if (!prepare_packet(batch->soup, one_origin, p)) {
        for (uint32_t rays = p->rays; rays != 0; rays &= rays - 1) {
            tl_ray_batch_one(batch, p->index[tl_lowest_bit(rays)]);
        }
        return;
    } else if (batch->hits == NULL) {
        walk_packet(batch->soup, p, true);
    } else {
        walk_packet(batch->soup, p, false);
    }
    report_packet(batch, p);
}

// Rays that are coherent but for octant or axis wait for others of their kind: of the same octant and axis, traced from
// the same end. A batch has no more than 16 bits of them.
enum { PACKET_KINDS = 48 };

typedef struct packet_sorter {
    uint32_t count[PACKET_KINDS];
    uint16_t index[PACKET_KINDS][PACKET_RAYS];
    ray_packet packet;
} packet_sorter;

static void trace_kind(const tl_ray_batch *batch, packet_sorter *sorter, uint32_t kind)
{
    ray_packet *p = &sorter->packet;
    uint32_t count = sorter->count[kind];
    sorter->count[kind] = 0;
    if (count < PACKET_RAYS / 4) {
        for (uint32_t i = 0; i < count; i++) {
            tl_ray_batch_one(batch, sorter->index[kind][i]);
        }
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        p->index[i] = sorter->index[kind][i];
    }
    load_packet(batch, count, kind % 2 != 0 ? END_SECOND : END_FIRST, p);
    p->backward = kind >> 1 & 7u;
    p->axes = tl_ray_axes(1u << (kind >> 4));
    trace_packet(batch, false, p);
}

static TL_NOINLINE void sort_packet(const tl_ray_batch *batch, packet_sorter *sorter, const packet_kind *kind)
{
    uint32_t index[PACKET_RAYS]; // the packet's, which others take the place of
    const uint32_t end = sorter->packet.from_target;
    memcpy(index, sorter->packet.index, sizeof index);
    for (uint32_t rays = sorter->packet.rays; rays != 0; rays &= rays - 1) {
        uint32_t lane = tl_lowest_bit(rays);
        uint32_t octant = (kind->backward[0] >> lane & 1u) | (kind->backward[1] >> lane & 1u) << 1 |
                          (kind->backward[2] >> lane & 1u) << 2;
        uint32_t axis = (kind->along[1] >> lane & 1u) | (kind->along[2] >> lane & 1u) << 1;
        uint32_t which = axis << 4 | octant << 1 | end;
        sorter->index[which][sorter->count[which]++] = (uint16_t)index[lane];
        if (sorter->count[which] == PACKET_RAYS) {
            trace_kind(batch, sorter, which);
        }
    }
}

static TL_ALWAYS_INLINE bool all_or_none(uint32_t lanes)
{
    return lanes == 0 || lanes == PACKET_ALL;
}

// Traces the loaded packet if its rays are coherent. False: they are not.
static TL_ALWAYS_INLINE bool trace_coherent(const tl_ray_batch *batch, packet_sorter *sorter)
{
    ray_packet *p = &sorter->packet;
    packet_kind kind = examine_packet(p->soup_size, p);
    if ((kind.near_first & kind.usual) != PACKET_ALL) {
        return false;
    }
    if (!all_or_none(kind.backward[0]) || !all_or_none(kind.backward[1]) || !all_or_none(kind.backward[2]) ||
        !all_or_none(kind.along[0]) || !all_or_none(kind.along[1])) {
        sort_packet(batch, sorter, &kind);
        return true;
    }
    p->backward = (kind.backward[0] & 1u) | (kind.backward[1] & 2u) | (kind.backward[2] & 4u);
    p->axes = tl_ray_axes((kind.along[0] & 1u) | (kind.along[1] & 2u) | (kind.along[2] & 4u));
    trace_packet(batch, kind.at_first == PACKET_ALL, p);
    return true;
}

// The groups of sixteen that are not looked at after one that was not coherent double up to this.
enum { MAX_SKIPPED_GROUPS = 31 };

void TL_RAY_PACKETS(const tl_ray_batch *batch)
{
    packet_sorter sorter;
    memset(sorter.count, 0, sizeof sorter.count);
    tl_f32x4 low = tl_f32x4_load(&batch->soup->bounds_min.x), high = tl_f32x4_load(&batch->soup->bounds_max.x);
    sorter.packet.soup_size = tl_f32x4_get_x(tl_f32x4_max_of_three(tl_f32x4_sub(high, low)));
    uint32_t skip = 0, skipped = 0, apart = 0;
    for (uint32_t first = 0; first < batch->count; first += PACKET_RAYS) {
        uint32_t count = batch->count - first < PACKET_RAYS ? batch->count - first : PACKET_RAYS;
        if (skip != 0) {
            skip--;
            continue;
        }
        for (uint32_t i = 0; i < count; i++) {
            sorter.packet.index[i] = first + i;
        }
        load_packet(batch, count, END_CLOSER, &sorter.packet);
        if (!trace_coherent(batch, &sorter)) {
            skipped = skipped < MAX_SKIPPED_GROUPS ? 2 * skipped + 1 : MAX_SKIPPED_GROUPS;
            skip = skipped;
            continue;
        }
        skipped = 0;
        if (apart < first) {
            tl_ray_batch_apart(batch, apart, first);
        }
        apart = first + count;
    }
    tl_ray_batch_apart(batch, apart, batch->count);
    for (uint32_t i = 0; i < PACKET_KINDS; i++) {
        trace_kind(batch, &sorter, i);
    }
}

#endif
