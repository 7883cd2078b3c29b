// SPDX-License-Identifier: MIT
//
// face_clip.c with four corners a register. The file that includes this names the function.

#include "base/compiler.h"
#include "base/lowest_bit.h"
#include "math/simd4d.h"

// Behind the last corner comes the first again.
enum { LANES = TL_SMALL_FACE + 4 };

// A face seen in the patch's plane, counter-clockwise: B's is walked against its order.
typedef struct clip_outline {
    const tl_face *face;
    uint32_t count;
    bool turned;                                       // it is B's
    double x[LANES], y[LANES];                         // corners
    double edge_x[LANES], edge_y[LANES], least[LANES]; // to the next; products of this and more are inside
} clip_outline;

typedef struct face_clip {
    clip_outline a, b;
    const tl_patch_heights *heights;
    tl_patch *patch;
    double inside[TL_SMALL_FACE][LANES]; // of line k of B: each corner of A, times the line's length
} face_clip;

static inline uint32_t clip_corner_at(const clip_outline *o, uint32_t i)
{
    return o->turned ? o->count - 1 - i : i;
}

static inline uint32_t clip_after(const clip_outline *o, uint32_t i)
{
    return i + 1 < o->count ? i + 1 : 0;
}

static inline uint32_t clip_vertex_feature(const clip_outline *o, uint32_t i)
{
    return o->face->vertices[clip_corner_at(o, i)];
}

static inline uint32_t clip_edge_feature(const clip_outline *o, uint32_t i)
{
    return o->face->edges[o->turned ? clip_corner_at(o, clip_after(o, i)) : i];
}

typedef struct four_corners {
    tl_f64x4 x, y;
} four_corners;

static inline tl_f64x4 four_along(tl_vec3d axis, tl_f64x4 x, tl_f64x4 y, tl_f64x4 z)
{
    const tl_f64x4 xy = tl_f64x4_add(tl_f64x4_mul(tl_f64x4_all(axis.x), x), tl_f64x4_mul(tl_f64x4_all(axis.y), y));
    return tl_f64x4_add(xy, tl_f64x4_mul(tl_f64x4_all(axis.z), z));
}

// Corners i .. i + 3.
static inline four_corners project_four(const clip_outline *o, const tl_patch *patch, uint32_t i)
{
    const double *row = &o->face->corners[0].x;
    uint32_t at[4];
    for (uint32_t k = 0; k < 4; k++) {
        at[k] = 3 * clip_corner_at(o, i);
        i = clip_after(o, i);
    }
    const tl_f64x4 x = tl_f64x4_gather(row, at), y = tl_f64x4_gather(row + 1, at), z = tl_f64x4_gather(row + 2, at);
    const four_corners four = { four_along(patch->u, x, y, z), four_along(patch->v, x, y, z) };
    return four;
}

static TL_ALWAYS_INLINE void load_clip_outline(clip_outline *o, uint32_t lanes, const tl_patch *patch)
{
    const four_corners first = project_four(o, patch, 0);
    const tl_f64x4 gap = tl_f64x4_all(-patch->gap);
    four_corners four = first;
    for (uint32_t i = 0; i < lanes; i += 4) {
        const four_corners next = i + 4 < lanes ? project_four(o, patch, i + 4 < o->count ? i + 4 : 0) : first;
        const tl_f64x4 edge_x = tl_f64x4_sub(tl_f64x4_next(four.x, next.x), four.x),
                       edge_y = tl_f64x4_sub(tl_f64x4_next(four.y, next.y), four.y);
        tl_f64x4_store(&o->x[i], four.x);
        tl_f64x4_store(&o->y[i], four.y);
        tl_f64x4_store(&o->edge_x[i], edge_x);
        tl_f64x4_store(&o->edge_y[i], edge_y);
        tl_f64x4_store(&o->least[i], tl_f64x4_mul(gap, tl_f64x4_add(tl_f64x4_abs(edge_x), tl_f64x4_abs(edge_y))));
        four = next;
    }
}

// How far inside points are of lines; either may be one.
static inline tl_f64x4 four_inside(tl_f64x4 edge_x, tl_f64x4 edge_y, tl_f64x4 from_x, tl_f64x4 from_y, tl_f64x4 x,
                                   tl_f64x4 y)
{
    return tl_f64x4_sub(tl_f64x4_mul(edge_x, tl_f64x4_sub(y, from_y)), tl_f64x4_mul(edge_y, tl_f64x4_sub(x, from_x)));
}

// By bits, which corners of `o` are outside of a line.
static TL_ALWAYS_INLINE uint32_t corners_outside(const clip_outline *o, uint32_t lanes, const clip_outline *lines,
                                                 uint32_t line, double *inside)
{
    const tl_f64x4 x = tl_f64x4_all(lines->x[line]), y = tl_f64x4_all(lines->y[line]),
                   edge_x = tl_f64x4_all(lines->edge_x[line]), edge_y = tl_f64x4_all(lines->edge_y[line]),
                   least = tl_f64x4_all(lines->least[line]);
    uint32_t outside = 0;
    for (uint32_t i = 0; i < lanes; i += 4) {
        const tl_f64x4 in = four_inside(edge_x, edge_y, x, y, tl_f64x4_load(&o->x[i]), tl_f64x4_load(&o->y[i]));
        tl_f64x4_store(&inside[i], in);
        outside |= tl_f64x4_less(in, least) << i;
    }
    return outside;
}

// By bits, which lines of `o` a corner is outside of, and which it is behind at all.
static TL_ALWAYS_INLINE uint32_t lines_outside(const clip_outline *o, uint32_t lanes, const clip_outline *corners,
                                               uint32_t corner, uint32_t *behind)
{
    const tl_f64x4 x = tl_f64x4_all(corners->x[corner]), y = tl_f64x4_all(corners->y[corner]);
    uint32_t outside = 0;
    *behind = 0;
    for (uint32_t i = 0; i < lanes; i += 4) {
        const tl_f64x4 in = four_inside(tl_f64x4_load(&o->edge_x[i]), tl_f64x4_load(&o->edge_y[i]),
                                        tl_f64x4_load(&o->x[i]), tl_f64x4_load(&o->y[i]), x, y);
        outside |= tl_f64x4_less(in, tl_f64x4_load(&o->least[i])) << i;
        *behind |= tl_f64x4_less(in, tl_f64x4_all(0.0)) << i;
    }
    return outside;
}

static inline tl_f64x4 four_heights(const tl_patch_heights *h, tl_f64x4 x, tl_f64x4 y)
{
    const tl_f64x4 at_x = tl_f64x4_add(tl_f64x4_all(h->at_origin), tl_f64x4_mul(tl_f64x4_all(h->along_x), x));
    return tl_f64x4_add(at_x, tl_f64x4_mul(tl_f64x4_all(h->along_y), y));
}

// By bits, over which corners both faces are farther apart than the limit.
static TL_ALWAYS_INLINE uint32_t beyond_limit(const clip_outline *o, uint32_t lanes, const tl_patch_heights heights[2],
                                              double limit)
{
    uint32_t beyond = 0;
    for (uint32_t i = 0; i < lanes; i += 4) {
        const tl_f64x4 x = tl_f64x4_load(&o->x[i]), y = tl_f64x4_load(&o->y[i]),
                       apart = tl_f64x4_sub(four_heights(&heights[1], x, y), four_heights(&heights[0], x, y));
        beyond |= tl_f64x4_less(tl_f64x4_all(limit), apart) << i;
    }
    return beyond;
}

static TL_ALWAYS_INLINE void start_clip_outline(clip_outline *o, const tl_face *face, bool turned, uint32_t lanes,
                                                const tl_patch *patch)
{
    o->face = face;
    o->count = face->count;
    o->turned = turned;
    load_clip_outline(o, lanes, patch);
}

// Bit i is that of the corner after i.
static inline uint32_t bits_after(uint32_t bits, uint32_t count)
{
    return bits >> 1 | (bits & 1u) << (count - 1);
}

// Adds a point unless it is too far apart or there already; it is written anyhow, and counted without a branch.
static inline void add_meeting(face_clip *c, tl_point2 p, uint32_t on_a, uint32_t on_b)
{
    tl_patch *patch = c->patch;
    tl_patch_point *point = &patch->points[patch->count];
    uint32_t same = 0;
    for (uint32_t i = 0; i < patch->count; i++) {
        same |= tl_same_place(patch, p.x, p.y, patch->points[i].x, patch->points[i].y) ? 1u : 0u;
    }
    point->x = p.x;
    point->y = p.y;
    point->on_a = tl_patch_height(&c->heights[0], p);
    point->on_b = tl_patch_height(&c->heights[1], p);
    point->features[0] = on_a;
    point->features[1] = on_b;
    point->previous = tl_patch_find_known(patch, (uint64_t)on_a << 32 | on_b);
    patch->count += point->on_b - point->on_a > patch->limit ? 0u : 1u - same;
}

static void add_corners_of_a(face_clip *c, uint32_t corners)
{
    for (; corners != 0; corners &= corners - 1) {
        const uint32_t i = tl_lowest_bit(corners);
        const tl_point2 p = { c->a.x[i], c->a.y[i] };
        add_meeting(c, p, clip_vertex_feature(&c->a, i), c->b.face->feature);
    }
}

static void add_corners_of_b(face_clip *c, uint32_t corners)
{
    for (; corners != 0; corners &= corners - 1) {
        const uint32_t i = tl_lowest_bit(corners);
        const tl_point2 p = { c->b.x[i], c->b.y[i] };
        add_meeting(c, p, c->a.face->feature, clip_vertex_feature(&c->b, i));
    }
}

// Bit 8 k + i: edge i of A crosses edge k of B. False where there are more than a patch holds, which only rounding can
// make.
static bool add_crossings(face_clip *c, uint64_t crossings)
{
    for (; crossings != 0; crossings &= crossings - 1) {
        if (c->patch->count + 1 >= TL_PATCH_POINTS) {
            c->patch->count = 0;
            return false;
        }
        const uint32_t at = tl_lowest_bit(crossings), i = at % 8, k = at / 8;
        const double from = c->inside[k][i], to = c->inside[k][clip_after(&c->a, i)];
        double share = from / (from - to);
        share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
        const tl_point2 p = { c->a.x[i] + c->a.edge_x[i] * share, c->a.y[i] + c->a.edge_y[i] * share };
        add_meeting(c, p, clip_edge_feature(&c->a, i), clip_edge_feature(&c->b, k));
    }
    return true;
}

// Faces of at most so many corners: 4, as most have, or 8.
static TL_ALWAYS_INLINE bool clip_faces(const tl_face *a, const tl_face *b, uint32_t lanes,
                                        const tl_patch_heights heights[2], tl_patch *patch)
{
    face_clip c;
    c.heights = heights;
    c.patch = patch;
    start_clip_outline(&c.a, a, false, lanes, patch);
    start_clip_outline(&c.b, b, true, lanes, patch);
    const uint32_t a_count = a->count, b_count = b->count, all_a = (1u << a_count) - 1u, all_b = (1u << b_count) - 1u;
    const uint32_t near_a = ~beyond_limit(&c.a, lanes, heights, patch->limit) & all_a,
                   near_b = ~beyond_limit(&c.b, lanes, heights, patch->limit) & all_b,
                   edges_a = near_a | bits_after(near_a, a_count), edges_b = near_b | bits_after(near_b, b_count);
    uint32_t outside_a = 0, outside_b = 0, first_behind, behind;
    uint64_t crossings = 0;
    outside_b |= (lines_outside(&c.a, lanes, &c.b, 0, &first_behind) & all_a) != 0 ? 1u : 0u;
    behind = first_behind;
    for (uint32_t k = 0; k < b_count; k++) {
        uint32_t next_behind = first_behind;
        if (k + 1 < b_count) {
            const uint32_t lines = lines_outside(&c.a, lanes, &c.b, k + 1, &next_behind) & all_a;
            outside_b |= (lines != 0 ? 1u : 0u) << (k + 1);
        }
        const uint32_t outside = corners_outside(&c.a, lanes, &c.b, k, c.inside[k]) & all_a,
                       cut = (outside ^ bits_after(outside, a_count)) & (behind ^ next_behind) & edges_a;
        outside_a |= outside;
        crossings |= (uint64_t)(cut & (0u - (edges_b >> k & 1u))) << 8 * k;
        behind = next_behind;
    }
    add_corners_of_a(&c, near_a & ~outside_a);
    add_corners_of_b(&c, near_b & ~outside_b);
    return add_crossings(&c, crossings);
}

bool TL_FACE_CLIP(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch)
{
    return a->count <= 4 && b->count <= 4 ? clip_faces(a, b, 4, heights, patch)
                                          : clip_faces(a, b, TL_SMALL_FACE, heights, patch);
}

#undef TL_FACE_CLIP
