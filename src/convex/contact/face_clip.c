// SPDX-License-Identifier: MIT
//
// The intersection of two faces of few corners: one is cut by the line of each edge of the other (Sutherland and
// Hodgman, Reentrant Polygon Clipping, 1974). It is quadratic, but between two rectangles half of the work of a sweep,
// and most edges cut nothing, which one row of products shows.
//
// A line cuts off one run of corners, in whose place come two cuts; the others stay where they are. Rounding can make
// it two runs, of corners within a rounding of the line: then the sweep does it all.

#include "convex/contact/face_patch.h"

#include "math/simd2d.h"

// Lines are edges of A by number, or of B from FIRST_B on. In the table of a face's features its vertices come first,
// then its edges, then the face.
enum { MOST = 2 * TL_SMALL_FACE, FIRST_B = TL_SMALL_FACE, FACE_EDGES = TL_SMALL_FACE, FACE_ITSELF = 2 * TL_SMALL_FACE };

// Behind the last corner comes the first again. A cut adds one corner at most.
typedef struct face_cut {
    tl_point2 corners[MOST + 2];
    uint32_t codes[MOST + 2]; // see code_of
    uint32_t count, b_count;
    tl_point2 outline[TL_SMALL_FACE + 1];
    uint32_t features[2][2 * TL_SMALL_FACE + 1];
    double gap;
} face_cut;

// What a corner lies on, by the tables of A and B, and the line that leads on from it.
static inline uint32_t code_of(uint32_t on_a, uint32_t on_b, uint32_t line)
{
    return on_a | on_b << 8 | line << 16;
}

static inline uint32_t line_after(uint32_t code)
{
    return code >> 16;
}

static inline void set_corner(face_cut *c, uint32_t at, tl_point2 p, uint32_t code)
{
    c->corners[at] = p;
    c->codes[at] = code;
}

static inline void copy_corner(face_cut *c, uint32_t from, uint32_t to)
{
    c->corners[to] = c->corners[from];
    c->codes[to] = c->codes[from];
}

static void load_faces(face_cut *c, const tl_face *a, const tl_face *b, const tl_patch *patch)
{
    for (uint32_t i = 0; i < a->count; i++) {
        set_corner(c, i, tl_patch_project(patch, a->corners[i]), code_of(i, FACE_ITSELF, i));
        c->features[0][i] = a->vertices[i];
        c->features[0][FACE_EDGES + i] = a->edges[i];
    }
    c->count = a->count;
    copy_corner(c, 0, c->count);
    // B is seen from behind: against its order.
    for (uint32_t i = 0, at = b->count; at-- > 0; i++) {
        c->outline[i] = tl_patch_project(patch, b->corners[at]);
        c->features[1][i] = b->vertices[at];
        c->features[1][FACE_EDGES + i] = b->edges[at > 0 ? at - 1 : b->count - 1];
    }
    c->outline[b->count] = c->outline[0];
    c->features[0][FACE_ITSELF] = a->feature;
    c->features[1][FACE_ITSELF] = b->feature;
    c->b_count = b->count;
}

// Where the line that leads on from a corner is cut by edge `by` of B, which or which itself leads on.
static uint32_t cut_code(const face_cut *c, uint32_t from, uint32_t by, bool leaves)
{
    uint32_t line = line_after(from), next_line = leaves ? FIRST_B + by : line;
    if (line < FIRST_B) {
        return code_of(FACE_EDGES + line, FACE_EDGES + by, next_line);
    }
    // Two edges of B that meet: its corner.
    uint32_t edge = line - FIRST_B, next = edge + 1 < c->b_count ? edge + 1 : 0,
             after = by + 1 < c->b_count ? by + 1 : 0;
    return code_of(FACE_ITSELF, next == by ? by : after == edge ? after : FACE_EDGES + by, next_line);
}

// How far inside the line from p to q each corner is, times the line's length; returns by bits which are outside.
static uint32_t find_outside(const face_cut *c, tl_point2 p, tl_point2 q, double *inside)
{
    double edge_x = q.x - p.x, edge_y = q.y - p.y, least = -c->gap * (fabs(edge_x) + fabs(edge_y));
    uint32_t outside = 0;
#if TL_HAS_F64X2
    const double turn[2] = { -edge_y, edge_x };
    const tl_f64x2 across = tl_f64x2_load(turn), from = tl_f64x2_load(&p.x), limit = tl_f64x2_all(least);
    for (uint32_t i = 0; i < c->count; i += 2) { // the one beyond an odd count is the first again
        tl_f64x2 in = tl_f64x2_pair_sums(tl_f64x2_mul(across, tl_f64x2_sub(tl_f64x2_load(&c->corners[i].x), from)),
                                         tl_f64x2_mul(across, tl_f64x2_sub(tl_f64x2_load(&c->corners[i + 1].x), from)));
        tl_f64x2_store(&inside[i], in);
        outside |= tl_f64x2_masks(tl_f64x2_where_less(in, limit)) << i;
    }
#else
    for (uint32_t i = 0; i < c->count; i++) {
        inside[i] = edge_x * (c->corners[i].y - p.y) - edge_y * (c->corners[i].x - p.x);
        outside |= inside[i] < least ? 1u << i : 0u;
    }
#endif
    return outside;
}

// Between corner `at` and the next one, one of which is outside.
static inline tl_point2 cut_between(const face_cut *c, const double *inside, uint32_t at)
{
    tl_point2 cut;
    double share = inside[at] / (inside[at] - inside[at + 1]);
    share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
#if TL_HAS_F64X2
    tl_f64x2 p = tl_f64x2_load(&c->corners[at].x), q = tl_f64x2_load(&c->corners[at + 1].x);
    tl_f64x2_store(&cut.x, tl_f64x2_add(p, tl_f64x2_mul(tl_f64x2_sub(q, p), tl_f64x2_all(share))));
#else
    tl_point2 p = c->corners[at], q = c->corners[at + 1];
    cut.x = p.x + (q.x - p.x) * share;
    cut.y = p.y + (q.y - p.y) * share;
#endif
    return cut;
}

// Corners begin .. end - 1 stay, between the cuts.
static void keep_run(face_cut *c, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; begin > 1 && i < end; i++) {
        copy_corner(c, i, i + 1 - begin);
    }
    c->count = end - begin + 2;
}

// Makes space for the two cuts in place of these corners.
static void replace_run(face_cut *c, uint32_t begin, uint32_t end)
{
    const uint32_t run = end - begin;
    for (uint32_t i = c->count; run == 1 && i-- > end;) {
        copy_corner(c, i, i + 1);
    }
    for (uint32_t i = end; run > 2 && i < c->count; i++) {
        copy_corner(c, i, i - run + 2);
    }
    c->count = c->count - run + 2;
}

// False when the line of edge `by` of B cuts off more than one run of corners.
static bool cut_by(face_cut *c, uint32_t by)
{
    double inside[MOST + 2];
    const uint32_t count = c->count, all = (1u << count) - 1u,
                   outside = find_outside(c, c->outline[by], c->outline[by + 1], inside) & all;
    if (outside == 0) {
        return true;
    }
    const bool from_first = (outside & 1u) != 0;
    const uint32_t run = from_first ? ~outside & all : outside; // what lies in the middle, of either kind
    if (run == 0) {
        c->count = 0;
        return true;
    }
    // By branches rather than by counting bits: pairs at rest have the same cuts for many frames, and what is predicted
    // need not wait for the products.
    uint32_t begin = 1;
    while ((run >> begin & 1u) == 0) {
        begin++;
    }
    uint32_t end = begin + 1;
    while ((run >> end & 1u) != 0) {
        end++;
    }
    if (run >> end != 0) {
        return false;
    }
    inside[count] = inside[0];
    const tl_point2 at_begin = cut_between(c, inside, begin - 1), at_end = cut_between(c, inside, end - 1);
    const uint32_t code_begin = cut_code(c, c->codes[begin - 1], by, !from_first),
                   code_end = cut_code(c, c->codes[end - 1], by, from_first);
    if (from_first) {
        keep_run(c, begin, end);
    } else {
        replace_run(c, begin, end);
    }
    set_corner(c, from_first ? 0 : begin, at_begin, code_begin);
    set_corner(c, from_first ? c->count - 1 : begin + 1, at_end, code_end);
    copy_corner(c, 0, c->count);
    return true;
}

// Those that coincide are neighbours; the first of them stays.
static void add_clipped(const face_cut *c, const tl_patch_heights heights[2], tl_patch *patch)
{
    const tl_point2 first = c->corners[0];
    uint32_t count = c->count;
    while (count > 1 && tl_same_place(patch, c->corners[count - 1].x, c->corners[count - 1].y, first.x, first.y)) {
        count--;
    }
    tl_point2 last = { (double)INFINITY, 0.0 };
    for (uint32_t i = 0; i < count; i++) {
        const tl_point2 p = c->corners[i];
        if (tl_same_place(patch, p.x, p.y, last.x, last.y)) {
            continue;
        }
        last = p;
        double on_a = tl_patch_height(&heights[0], p), on_b = tl_patch_height(&heights[1], p);
        if (!(on_b - on_a > patch->limit)) {
            tl_patch_point *point = &patch->points[patch->count++];
            point->x = p.x;
            point->y = p.y;
            point->on_a = on_a;
            point->on_b = on_b;
            point->features[0] = c->features[0][c->codes[i] & 0xffu];
            point->features[1] = c->features[1][c->codes[i] >> 8 & 0xffu];
            point->previous = tl_patch_find_known(patch, (uint64_t)point->features[0] << 32 | point->features[1]);
        }
    }
    patch->in_order = true;
}

bool tl_face_clip(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch)
{
    face_cut c;
    c.gap = patch->gap;
    load_faces(&c, a, b, patch);
    for (uint32_t by = 0; by < b->count && c.count > 0; by++) {
        if (!cut_by(&c, by)) {
            return false;
        }
    }
    add_clipped(&c, heights, patch);
    return true;
}
