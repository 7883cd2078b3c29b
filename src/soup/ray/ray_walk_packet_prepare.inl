// SPDX-License-Identifier: MIT
//
// Sixteen rays in lanes: loading them, what they have in common, and the constants of their filters. Part of
// ray_walk_packet.inl.

enum { PACKET_RAYS = 16, PACKET_ALL = 0xffff };

// A triangle that a ray of an any-hit query may meet.
typedef struct packet_doubt {
    uint32_t child; // its leaf
    uint16_t bit;   // as in leaf_lanes
    uint16_t ray;
} packet_doubt;

#ifndef TL_PACKET_DOUBTS // a test has fewer
#define TL_PACKET_DOUBTS 64
#endif

// A packet's rays, in lanes. What one value serves all rays for is the largest of theirs.
typedef struct ray_packet {
    _Alignas(64) float origin[3][PACKET_RAYS];
    float target[3][PACKET_RAYS]; // as in tl_ray_job
    float direction[3][PACKET_RAYS];
    float tmax[PACKET_RAYS];
    float plane_scale[3][PACKET_RAYS], near_base[3][PACKET_RAYS], far_base[3][PACKET_RAYS];
    float shear[2][PACKET_RAYS];
    float limit[PACKET_RAYS]; // as in walk_best; -1: the ray has left the packet
    float ahead[PACKET_RAYS];
    uint32_t child[PACKET_RAYS]; // the pending triangle, as in walk_best
    uint32_t bit[PACKET_RAYS];
    uint32_t rival_child[PACKET_RAYS]; // another one, surely hit too, that the bounds cannot tell from it
    uint32_t rival_bit[PACKET_RAYS];
    packet_doubt doubts[TL_PACKET_DOUBTS];
    uint32_t doubt_count;
    uint32_t index[PACKET_RAYS]; // of the ray in the batch
    uint32_t rays;               // bits: lanes that hold one
    bool from_target;            // segments are traced from their second end
    uint32_t alone;              // bits: rays to be traced alone
    uint32_t found;              // bits: rays of an any-hit query that hit something
    uint32_t pending, contested; // bits: rays that have a pending triangle, and those that have a rival to it
    uint32_t backward;
    const uint32_t *axes;
    float soup_size; // the largest side of the soup's box
    float reach, corner_error;
    float last_limit; // the largest limit
    // The interval that holds all rays.
    _Alignas(16) float enter_scale[4], enter_base[4], leave_scale[4], leave_base[4];
} ray_packet;

static TL_ALWAYS_INLINE tl_f32x16 lanes_of(const float *sixteen)
{
    return tl_f32x16_load(sixteen);
}

// Sixteen rays, a vector for each of their seven floats. A segment reaches to 1.
typedef struct packet_vectors {
    tl_f32x16 origin[3], target[3], tmax;
} packet_vectors;

static TL_ALWAYS_INLINE packet_vectors load_rays(const tl_ray_batch *batch, const uint32_t *index)
{
    bool is_ray = batch->rays != NULL;
    tl_f32x16 low[4], high[4]; // rays i, 4 + i, 8 + i and 12 + i, a quarter each: their first and last four floats
    for (uint32_t i = 0; i < 4; i++) {
        tl_f32x4 from[4], to[4];
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t ray = index[4 * k + i];
            const float *at = is_ray ? &batch->rays[ray].origin.x : &batch->segments[ray].a.x;
            from[k] = tl_f32x4_load(at);
            to[k] = tl_f32x4_load(at + (is_ray ? 3 : 2));
        }
        low[i] = tl_f32x16_join(from[0], from[1], from[2], from[3]);
        high[i] = tl_f32x16_join(to[0], to[1], to[2], to[3]);
    }
    tl_f32x16_transpose(low);
    tl_f32x16_transpose(high);
    const tl_f32x16 *target = is_ray ? high : high + 1; // a segment's were read from a.z on
    packet_vectors v = { { low[0], low[1], low[2] },
                         { target[0], target[1], target[2] },
                         is_ray ? high[3] : tl_f32x16_all(1.0f) };
    return v;
}

// How far points lie from the first of them, along the axis where that is most.
static TL_ALWAYS_INLINE float spread_of(const tl_f32x16 point[3])
{
    tl_f32x16 farthest = tl_f32x16_all(0.0f);
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 away = tl_f32x16_sub(point[i], tl_f32x16_all(tl_f32x16_first(point[i])));
        farthest = tl_f32x16_max(farthest, tl_f32x16_abs(away));
    }
    return tl_f32x16_largest(farthest);
}

static TL_ALWAYS_INLINE void swap_ends(packet_vectors *v)
{
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 origin = v->origin[i];
        v->origin[i] = v->target[i];
        v->target[i] = origin;
    }
}

// The end from which a packet's rays are traced. Sight is the same from both, so lines to one place, as to a light, are
// traced from there. Rays that were sorted by their octant keep the end that it was found for.
typedef enum packet_end { END_FIRST, END_SECOND, END_CLOSER } packet_end;

// Loads the rays of p->index, of which the first `count` are meant.
static TL_ALWAYS_INLINE void load_packet(const tl_ray_batch *batch, uint32_t count, packet_end end, ray_packet *p)
{
    for (uint32_t i = count; i < PACKET_RAYS; i++) {
        p->index[i] = p->index[count - 1];
    }
    p->rays = (1u << count) - 1u;
    packet_vectors v = load_rays(batch, p->index);
    bool is_sight = batch->segments != NULL && batch->hits == NULL;
    p->from_target = end == END_SECOND || (end == END_CLOSER && is_sight && spread_of(v.target) < spread_of(v.origin));
    if (p->from_target) {
        swap_ends(&v);
    }
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16_store(p->origin[i], v.origin[i]);
        tl_f32x16_store(p->target[i], v.target[i]);
        tl_f32x16_store(p->direction[i], batch->rays != NULL ? v.target[i] : tl_f32x16_sub(v.target[i], v.origin[i]));
    }
    tl_f32x16_store(p->tmax, v.tmax);
}

// What sixteen rays have in common.
typedef struct packet_kind {
    uint32_t usual;       // bits: rays that the float filters take as they are
    uint32_t near_first;  // bits: rays that begin near the first one and run nearly as it does
    uint32_t at_first;    // bits: rays that begin where the first one does
    uint32_t backward[3]; // bits: rays that run down an axis
    uint32_t along[3];    // bits: rays whose direction is largest along an axis, the lowest of them
} packet_kind;

// Coherent rays: their directions, scaled to a largest component of 1, differ by this from the first one's: a wide
// interval still costs less than rays apart.
#define PACKET_SPREAD 1.0f
// Their origins by this share of the soup's largest side.
#define PACKET_ORIGIN_SPREAD 0.02f

static TL_ALWAYS_INLINE packet_kind examine_packet(float soup_size, const ray_packet *p)
{
    packet_kind kind;
    tl_f32x16 size[3], smallest = tl_f32x16_all(TL_RAY_SMALLEST_INCLINE);
    kind.usual = tl_f32x16_less(tl_f32x16_all(0.0f), lanes_of(p->tmax));
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 direction = lanes_of(p->direction[i]);
        size[i] = tl_f32x16_abs(direction);
        tl_f32x16 magnitude = tl_f32x16_add(tl_f32x16_abs(lanes_of(p->origin[i])), size[i]);
        kind.usual &= tl_f32x16_less(magnitude, tl_f32x16_all(TL_RAY_FILTER_MAX));
        kind.backward[i] = tl_f32x16_less(direction, tl_f32x16_all(0.0f)) & ~tl_f32x16_less(size[i], smallest);
    }
    tl_f32x16 largest = tl_f32x16_max(tl_f32x16_max(size[0], size[1]), size[2]);
    kind.usual &= tl_f32x16_less(tl_f32x16_all(TL_RAY_DIRECTION_MIN), largest) &
                  tl_f32x16_less(largest, tl_f32x16_all(TL_RAY_DIRECTION_MAX));
    kind.along[0] = ~tl_f32x16_less(size[0], largest) & PACKET_ALL;
    kind.along[1] = ~tl_f32x16_less(size[1], largest) & ~kind.along[0] & PACKET_ALL;
    kind.along[2] = ~(kind.along[0] | kind.along[1]) & PACKET_ALL;
    // |d / largest - first / its largest|, without the divisions.
    tl_f32x16 first_largest = tl_f32x16_all(tl_f32x16_first(largest));
    tl_f32x16 max_turn = tl_f32x16_mul(tl_f32x16_mul(largest, tl_f32x16_all(PACKET_SPREAD)), first_largest);
    tl_f32x16 max_move = tl_f32x16_all(PACKET_ORIGIN_SPREAD * soup_size);
    kind.near_first = kind.at_first = PACKET_ALL;
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 direction = lanes_of(p->direction[i]), origin = lanes_of(p->origin[i]);
        tl_f32x16 first = tl_f32x16_mul(tl_f32x16_all(tl_f32x16_first(direction)), largest);
        tl_f32x16 turn = tl_f32x16_abs(tl_f32x16_sub(tl_f32x16_mul(direction, first_largest), first));
        tl_f32x16 move = tl_f32x16_abs(tl_f32x16_sub(origin, tl_f32x16_all(tl_f32x16_first(origin))));
        kind.near_first &= ~(tl_f32x16_less(max_turn, turn) | tl_f32x16_less(max_move, move));
        kind.at_first &= ~tl_f32x16_less(tl_f32x16_all(0.0f), move);
    }
    return kind;
}

// Negative along the axes of its bits.
static const float backward_signs[8][4] = { { 1, 1, 1, 1 },  { -1, 1, 1, 1 },  { 1, -1, 1, 1 },  { -1, -1, 1, 1 },
                                            { 1, 1, -1, 1 }, { -1, 1, -1, 1 }, { 1, -1, -1, 1 }, { -1, -1, -1, 1 } };

static TL_ALWAYS_INLINE tl_f32x4 least_of_each(const tl_f32x16 v[3])
{
    tl_f32x16 zero = tl_f32x16_all(0.0f);
    return tl_f32x4_neg(
        tl_f32x16_largest_of_each(tl_f32x16_sub(zero, v[0]), tl_f32x16_sub(zero, v[1]), tl_f32x16_sub(zero, v[2])));
}

// Slabs of each ray and of the interval. Origins lie between `low` and `high`.
static TL_ALWAYS_INLINE void prepare_slabs(ray_packet *p, tl_f32x4 low, tl_f32x4 high, tl_f32x4 reach)
{
    tl_f32x4 farthest = tl_f32x4_max(tl_f32x4_abs(low), tl_f32x4_abs(high));
    tl_f32x4 plane_error =
        tl_f32x4_mul_add(tl_f32x4_add(farthest, reach), tl_f32x4_all(TL_RAY_PLANE_ERROR), tl_f32x4_all(FLT_MIN));
    _Alignas(16) float errors[4];
    tl_f32x4_store(errors, plane_error);
    tl_f32x16 steep[3], smallest = tl_f32x16_all(TL_RAY_SMALLEST_INCLINE);
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 direction = lanes_of(p->direction[i]);
        uint32_t flat = tl_f32x16_less(tl_f32x16_abs(direction), smallest);
        tl_f32x16 inverse = tl_f32x16_div(tl_f32x16_all(1.0f), tl_f32x16_choose(flat, smallest, direction));
        steep[i] = tl_f32x16_abs(inverse);
        tl_f32x16 pad = tl_f32x16_mul(tl_f32x16_all(errors[i]), steep[i]);
        tl_f32x16 at = tl_f32x16_mul(lanes_of(p->origin[i]), inverse);
        tl_f32x16_store(p->plane_scale[i], inverse);
        tl_f32x16_store(p->near_base[i], tl_f32x16_sub(tl_f32x16_sub(tl_f32x16_all(0.0f), at), pad));
        tl_f32x16_store(p->far_base[i], tl_f32x16_sub(pad, at));
    }
    tl_f32x4 least = least_of_each(steep), most = tl_f32x16_largest_of_each(steep[0], steep[1], steep[2]);
    tl_f32x4 signs = tl_f32x4_load(backward_signs[p->backward]);
    tl_f32x4 enter_scale = tl_f32x4_mul(signs, least), leave_scale = tl_f32x4_mul(signs, most);
    tl_f32x4_store(p->enter_scale, enter_scale);
    tl_f32x4_store(p->leave_scale, leave_scale);
    tl_f32x4_store(p->enter_base, tl_f32x4_mul_sub_from(tl_f32x4_choose(signs, high, low), enter_scale,
                                                        tl_f32x4_neg(tl_f32x4_mul(plane_error, least))));
    tl_f32x4_store(p->leave_base, tl_f32x4_mul_sub_from(tl_f32x4_choose(signs, low, high), leave_scale,
                                                        tl_f32x4_mul(plane_error, most)));
}

// Prepares rays of one octant and one axis. False: they are too far away for this.
static TL_ALWAYS_INLINE bool prepare_packet(const tl_soup *soup, bool one_origin, ray_packet *p)
{
    const tl_f32x16 origin[3] = { lanes_of(p->origin[0]), lanes_of(p->origin[1]), lanes_of(p->origin[2]) };
    tl_f32x4 low =
        tl_f32x4_make(tl_f32x16_first(origin[0]), tl_f32x16_first(origin[1]), tl_f32x16_first(origin[2]), 0.0f);
    tl_f32x4 high = low;
    if (!one_origin) {
        low = least_of_each(origin);
        high = tl_f32x16_largest_of_each(origin[0], origin[1], origin[2]);
    }
    tl_f32x4 bounds_min = tl_f32x4_load(&soup->bounds_min.x), bounds_max = tl_f32x4_load(&soup->bounds_max.x);
    tl_f32x4 below =
        tl_f32x4_max(tl_f32x4_abs(tl_f32x4_sub(low, bounds_min)), tl_f32x4_abs(tl_f32x4_sub(high, bounds_min)));
    tl_f32x4 above =
        tl_f32x4_max(tl_f32x4_abs(tl_f32x4_sub(low, bounds_max)), tl_f32x4_abs(tl_f32x4_sub(high, bounds_max)));
    tl_f32x4 reach = tl_f32x4_max_of_three(tl_f32x4_max(below, above));
    p->reach = tl_f32x4_get_x(reach);
    p->corner_error = p->reach * TL_RAY_CORNER_ERROR + FLT_MIN;
    if (!(p->reach < TL_RAY_INTERVALS_MAX) || p->reach > TL_RAY_FAR * p->soup_size) {
        return false;
    }
    prepare_slabs(p, low, high, reach);
    tl_f32x16 per_depth = lanes_of(p->plane_scale[p->axes[2]]);
    for (uint32_t i = 0; i < 2; i++) {
        tl_f32x16_store(p->shear[i], tl_f32x16_mul(lanes_of(p->direction[p->axes[i]]), per_depth));
    }
    tl_f32x16 tmax = lanes_of(p->tmax);
    tl_f32x16 limit = tl_f32x16_add(tmax, tl_f32x16_all(FLT_MIN));
    tl_f32x16_store(p->limit, tl_f32x16_choose(p->rays, limit, tl_f32x16_all(-1.0f)));
    tl_f32x16_store(p->ahead, tl_f32x16_mul(tmax, tl_f32x16_all(1.0f - T_MARGIN)));
    p->alone = p->found = p->pending = p->contested = p->doubt_count = 0;
    p->last_limit = INFINITY;
    return true;
}
