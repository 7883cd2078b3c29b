// SPDX-License-Identifier: MIT
//
// The corners of the intersection of two convex polygons, by a sweep: each polygon is a lower and an upper chain of
// edges, both walked once from left to right, and between two neighbouring corners of any of the four chains all are
// straight. So it is linear in the corners of both (Shamos and Hoey, Geometric Intersection Problems, 1976), needs no
// buffer for the polygons, which may have any number of corners, and ends whatever the coordinates are. The chase of
// O'Rourke et al. (1982) is linear too, but decides by signs that coinciding edges, which faces at rest have, make
// random.
//
// Two chains that differ by no more than the gap are level: they cross only when one is clearly above before, and
// clearly below after. A corner that is level with a chain lies on it.

#include "convex/contact/face_patch.h"

enum { LOW_A, HIGH_A, LOW_B, HIGH_B, CHAINS };

// Corners of a face that are kept projected; faces of more are walked.
enum { OUTLINE_CORNERS = 32 };

// A face in the patch's plane, counter-clockwise. Corners have handles: indices of `points`, or, with no points, the
// face's.
typedef struct face_outline {
    const tl_face *face;
    const tl_patch *patch;
    bool backwards; // against the face's order
    uint32_t count; // of points
    tl_point2 points[OUTLINE_CORNERS];
    uint32_t corners[OUTLINE_CORNERS];
    uint32_t low_left, high_left, low_right, high_right; // handles of the ends of both chains
} face_outline;

typedef struct face_chain {
    const face_outline *of;
    uint32_t at, end; // handles; the current edge leads on from `at`
    bool upper;
    tl_point2 from, to;
} face_chain;

typedef struct chain_pair {
    uint32_t first, second;
    int side;     // of the first seen from the second, when last clear: above 1, below -1
    bool touched; // since then a corner of one lay on the other
} chain_pair;

typedef struct face_sweep {
    tl_patch *patch;
    const tl_patch_heights *heights;
    face_outline outlines[2];
    face_chain chains[CHAINS];
    chain_pair pairs[4];
    double y[CHAINS]; // at x
} face_sweep;

static tl_point2 outline_point(const face_outline *o, uint32_t handle)
{
    return o->count > 0 ? o->points[handle] : tl_patch_project(o->patch, tl_face_corner(o->face, handle));
}

static uint32_t outline_step(const face_outline *o, uint32_t handle, bool forward)
{
    if (o->count > 0) {
        return forward ? (handle + 1 < o->count ? handle + 1 : 0) : (handle > 0 ? handle : o->count) - 1;
    }
    return forward != o->backwards ? tl_face_next(o->face, handle) : tl_face_previous(o->face, handle);
}

// Of the edge from a corner to the next one, counter-clockwise.
static uint32_t edge_feature(const face_outline *o, uint32_t handle)
{
    uint32_t at = o->backwards ? outline_step(o, handle, true) : handle;
    return tl_face_edge_feature(o->face, o->count > 0 ? o->corners[at] : at);
}

static uint32_t corner_feature(const face_outline *o, uint32_t handle)
{
    return tl_face_vertex_feature(o->face, o->count > 0 ? o->corners[handle] : handle);
}

static void load_points(face_outline *o)
{
    uint32_t at = o->face->first;
    do {
        if (o->count == OUTLINE_CORNERS) {
            o->count = 0;
            return;
        }
        o->corners[o->count++] = at;
        at = o->backwards ? tl_face_previous(o->face, at) : tl_face_next(o->face, at);
    } while (at != o->face->first);
    for (uint32_t i = 0; i < o->count; i++) {
        o->points[i] = tl_patch_project(o->patch, tl_face_corner(o->face, o->corners[i]));
    }
}

static void find_ends(face_outline *o)
{
    uint32_t first = o->count > 0 ? 0 : o->face->first, at = first;
    o->low_left = o->high_left = o->low_right = o->high_right = at;
    tl_point2 p = outline_point(o, at), ll = p, hl = p, lr = p, hr = p;
    for (at = outline_step(o, at, true); at != first; at = outline_step(o, at, true)) {
        p = outline_point(o, at);
        if (p.x < ll.x || (p.x == ll.x && p.y < ll.y)) {
            ll = p;
            o->low_left = at;
        }
        if (p.x < hl.x || (p.x == hl.x && p.y > hl.y)) {
            hl = p;
            o->high_left = at;
        }
        if (p.x > lr.x || (p.x == lr.x && p.y < lr.y)) {
            lr = p;
            o->low_right = at;
        }
        if (p.x > hr.x || (p.x == hr.x && p.y > hr.y)) {
            hr = p;
            o->high_right = at;
        }
    }
}

static void chain_start(face_chain *c, const face_outline *o, bool upper)
{
    c->of = o;
    c->upper = upper;
    c->at = upper ? o->high_left : o->low_left;
    c->end = upper ? o->high_right : o->low_right;
    c->from = outline_point(o, c->at);
    c->to = c->at == c->end ? c->from : outline_point(o, outline_step(o, c->at, !upper));
}

static void chain_advance(face_chain *c, double x)
{
    while (c->at != c->end && c->to.x <= x) {
        c->at = outline_step(c->of, c->at, !c->upper);
        c->from = c->to;
        c->to = c->at == c->end ? c->from : outline_point(c->of, outline_step(c->of, c->at, !c->upper));
    }
}

static double chain_y(const face_chain *c, double x)
{
    double width = c->to.x - c->from.x, share = width > 0.0 ? (x - c->from.x) / width : 0.0;
    return c->from.y + (c->to.y - c->from.y) * (share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share);
}

static uint32_t chain_feature(const face_chain *c)
{
    uint32_t at = c->at == c->end ? outline_step(c->of, c->at, c->upper) : c->at; // at the end: the last edge
    return edge_feature(c->of, c->upper ? outline_step(c->of, at, false) : at);
}

static void add_point(face_sweep *s, double x, double y, uint32_t feature_a, uint32_t feature_b)
{
    const tl_point2 p = { x, y };
    tl_patch_point point = {
        x, y, tl_patch_height(&s->heights[0], p), tl_patch_height(&s->heights[1], p), { feature_a, feature_b }, 0
    };
    tl_patch_add(s->patch, &point);
}

// A corner of chain k at this x is one of the patch when the other polygon holds it.
static void visit_corner(face_sweep *s, uint32_t k, uint32_t handle, tl_point2 p)
{
    uint32_t other = k < LOW_B ? LOW_B : LOW_A; // its low chain; the high one follows
    double gap = s->patch->gap;
    for (uint32_t i = 0; i < 4; i++) {
        chain_pair *pair = &s->pairs[i];
        uint32_t across = pair->first == k ? pair->second : pair->second == k ? pair->first : k;
        if (across != k && fabs(p.y - s->y[across]) <= gap) {
            pair->touched = true;
        }
    }
    if (p.y >= s->y[other] - gap && p.y <= s->y[other + 1] + gap) {
        uint32_t vertex = corner_feature(s->chains[k].of, handle), face = s->outlines[k < LOW_B ? 1 : 0].face->feature;
        add_point(s, p.x, p.y, k < LOW_B ? vertex : face, k < LOW_B ? face : vertex);
    }
}

// Where the vertical edge that polygon `side` begins or ends with, between y of its own chains, meets the other's.
static void cross_vertical(face_sweep *s, uint32_t side, double x, uint32_t edge_feature)
{
    uint32_t low = side == 0 ? LOW_A : LOW_B, other = side == 0 ? LOW_B : LOW_A;
    for (uint32_t k = other; k < other + 2; k++) {
        double y = s->y[k], gap = s->patch->gap;
        if (y > s->y[low] + gap && y < s->y[low + 1] - gap && s->chains[k].from.x != x && s->chains[k].to.x != x) {
            uint32_t crossed = chain_feature(&s->chains[k]);
            add_point(s, x, y, side == 0 ? edge_feature : crossed, side == 0 ? crossed : edge_feature);
        }
    }
}

static double min_y(double p, double q)
{
    return p < q ? p : q;
}

// What happens to a pair between x and next_x, where y was and will be.
static void cross_pair(face_sweep *s, chain_pair *pair, double x, double next_x, const double next_y[CHAINS])
{
    double before = s->y[pair->first] - s->y[pair->second], after = next_y[pair->first] - next_y[pair->second];
    double gap = s->patch->gap;
    int side = after > gap ? 1 : after < -gap ? -1 : 0;
    if (side == 0 || side == pair->side) {
        pair->touched = pair->touched && side == 0;
        return;
    }
    bool crossed = pair->side != 0 && !pair->touched;
    pair->side = side;
    pair->touched = false;
    if (!crossed) {
        return;
    }
    double share = (before > 0.0) == (after > 0.0) ? 0.0 : before / (before - after);
    const face_chain *first = &s->chains[pair->first], *second = &s->chains[pair->second];
    // The y of the flatter one is the more exact.
    uint32_t flat = fabs(next_y[pair->first] - s->y[pair->first]) < fabs(next_y[pair->second] - s->y[pair->second])
                        ? pair->first
                        : pair->second;
    double y = s->y[flat] + (next_y[flat] - s->y[flat]) * share;
    // Two low chains may cross above the intersection, two high ones below.
    double ys[CHAINS];
    for (int k = 0; k < CHAINS; k++) {
        ys[k] = s->y[k] + (next_y[k] - s->y[k]) * share;
    }
    bool lows = pair->first == LOW_A && pair->second == LOW_B, highs = pair->first == HIGH_A && pair->second == HIGH_B;
    if ((lows && y > min_y(ys[HIGH_A], ys[HIGH_B]) + gap) || (highs && y < -min_y(-ys[LOW_A], -ys[LOW_B]) - gap)) {
        return;
    }
    add_point(s, x + (next_x - x) * share, y, chain_feature(first), chain_feature(second));
}

static double chain_next(const face_chain *c, double x, double end)
{
    return c->at != c->end && c->to.x > x && c->to.x < end ? c->to.x : end;
}

static void heights_at(const face_sweep *s, double x, double y[CHAINS])
{
    for (int k = 0; k < CHAINS; k++) {
        y[k] = chain_y(&s->chains[k], x);
    }
}

static void visit_start(face_sweep *s, double x)
{
    for (uint32_t k = 0; k < CHAINS; k++) {
        if (s->chains[k].from.x == x) {
            visit_corner(s, k, s->chains[k].at, s->chains[k].from);
        }
    }
    for (uint32_t side = 0; side < 2; side++) {
        const face_outline *o = &s->outlines[side];
        if (o->low_left != o->high_left && s->chains[2 * side].from.x == x && s->chains[2 * side].at == o->low_left) {
            cross_vertical(s, side, x, edge_feature(o, outline_step(o, o->low_left, false)));
        }
    }
}

static void visit_end(face_sweep *s, double x)
{
    for (uint32_t k = 0; k < CHAINS; k++) {
        const face_chain *c = &s->chains[k];
        if (c->at != c->end && c->to.x == x) {
            visit_corner(s, k, outline_step(c->of, c->at, !c->upper), c->to);
        }
    }
    for (uint32_t side = 0; side < 2; side++) {
        const face_outline *o = &s->outlines[side];
        if (o->low_right != o->high_right && outline_point(o, o->low_right).x == x) {
            cross_vertical(s, side, x, edge_feature(o, o->low_right));
        }
    }
}

static void run_sweep(face_sweep *s, double x, double end)
{
    for (int k = 0; k < CHAINS; k++) {
        chain_advance(&s->chains[k], x);
    }
    heights_at(s, x, s->y);
    visit_start(s, x);
    for (int i = 0; i < 4; i++) {
        double apart = s->y[s->pairs[i].first] - s->y[s->pairs[i].second];
        s->pairs[i].side = apart > s->patch->gap ? 1 : apart < -s->patch->gap ? -1 : 0;
    }
    while (x < end) {
        double next_x = end, next_y[CHAINS];
        for (int k = 0; k < CHAINS; k++) {
            next_x = chain_next(&s->chains[k], x, next_x);
        }
        heights_at(s, next_x, next_y);
        for (int i = 0; i < 4; i++) {
            cross_pair(s, &s->pairs[i], x, next_x, next_y);
        }
        for (int k = 0; k < CHAINS; k++) {
            s->y[k] = next_y[k];
        }
        x = next_x;
        for (uint32_t k = 0; k < CHAINS && x < end; k++) {
            uint32_t at = s->chains[k].at;
            chain_advance(&s->chains[k], x);
            if (s->chains[k].at != at) {
                visit_corner(s, k, s->chains[k].at, s->chains[k].from);
            }
        }
    }
    visit_end(s, end);
}

static void start_outline(face_sweep *s, int side, const tl_face *face)
{
    face_outline *o = &s->outlines[side];
    o->face = face;
    o->patch = s->patch;
    o->backwards = side == 1; // B is seen from behind
    o->count = 0;
    load_points(o);
    find_ends(o);
    chain_start(&s->chains[2 * side], o, false);
    chain_start(&s->chains[2 * side + 1], o, true);
}

void tl_face_sweep(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch)
{
    static const chain_pair pairs[4] = { { LOW_A, LOW_B, 0, false },
                                         { HIGH_A, HIGH_B, 0, false },
                                         { LOW_A, HIGH_B, 0, false },
                                         { HIGH_A, LOW_B, 0, false } };
    face_sweep s;
    s.patch = patch;
    s.heights = heights;
    start_outline(&s, 0, a);
    start_outline(&s, 1, b);
    for (int i = 0; i < 4; i++) {
        s.pairs[i] = pairs[i];
    }
    double left_a = s.chains[LOW_A].from.x, left_b = s.chains[LOW_B].from.x;
    double right_a = outline_point(&s.outlines[0], s.outlines[0].low_right).x,
           right_b = outline_point(&s.outlines[1], s.outlines[1].low_right).x;
    double begin = left_a > left_b ? left_a : left_b, end = right_a < right_b ? right_a : right_b;
    if (begin <= end + patch->gap) {
        run_sweep(&s, begin < end ? begin : end, end);
    }
}
