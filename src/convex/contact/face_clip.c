// SPDX-License-Identifier: MIT
//
// The intersection of two faces of few corners: one is cut by the line of each edge of the other (Sutherland and
// Hodgman, Reentrant Polygon Clipping, 1974). It is quadratic, but between two rectangles half of the work of a sweep,
// and most edges cut nothing, which one row of products shows. Each corner knows the features it lies on, and which
// edge leads on from it.

#include "convex/contact/face_patch.h"

enum { MOST = 2 * TL_SMALL_FACE, NOT_OF_B = MOST };

typedef struct clip_corner {
    double x, y;
    uint32_t features[2];
    uint32_t edge; // the feature of A's edge that leads on
    uint32_t of_b; // or which edge of B leads on; NOT_OF_B
} clip_corner;

typedef struct face_cut {
    const tl_face *a, *b;
    clip_corner corners[2][MOST + 1];
    uint32_t count, now; // of the corners in use
    tl_point2 outline[TL_SMALL_FACE];
    uint32_t edges[TL_SMALL_FACE], vertices[TL_SMALL_FACE];
    double gap;
} face_cut;

static void load_faces(face_cut *c, const tl_patch *patch)
{
    const tl_face *a = c->a, *b = c->b;
    for (uint32_t i = 0; i < a->count; i++) {
        tl_point2 p = tl_patch_project(patch, a->corners[i]);
        clip_corner corner = { p.x, p.y, { a->vertices[i], b->feature }, a->edges[i], NOT_OF_B };
        c->corners[0][i] = corner;
    }
    c->count = a->count;
    c->now = 0;
    // B is seen from behind: against its order.
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t at = b->count - 1 - i;
        c->outline[i] = tl_patch_project(patch, b->corners[at]);
        c->vertices[i] = b->vertices[at];
        c->edges[i] = b->edges[at > 0 ? at - 1 : b->count - 1];
    }
}

// Where the edge from a corner to the next is cut by edge `by` of B.
static clip_corner cut_between(const face_cut *c, const clip_corner *from, const clip_corner *to, double share,
                               uint32_t by)
{
    uint32_t count = c->b->count, after = by + 1 < count ? by + 1 : 0;
    clip_corner cut = { from->x + (to->x - from->x) * share,
                        from->y + (to->y - from->y) * share,
                        { from->edge, c->edges[by] },
                        from->edge,
                        from->of_b };
    if (from->of_b != NOT_OF_B) {
        // Two edges of B that meet: its corner.
        uint32_t next = from->of_b + 1 < count ? from->of_b + 1 : 0;
        cut.features[0] = c->a->feature;
        cut.features[1] = next == by ? c->vertices[by] : after == from->of_b ? c->vertices[after] : c->edges[by];
    }
    return cut;
}

static void cut_by(face_cut *c, uint32_t by)
{
    tl_point2 p = c->outline[by], q = c->outline[by + 1 < c->b->count ? by + 1 : 0];
    const double ex = q.x - p.x, ey = q.y - p.y, gap = c->gap * (fabs(ex) + fabs(ey));
    const clip_corner *old = c->corners[c->now];
    clip_corner *out = c->corners[1 - c->now];
    double inside[MOST + 1], least = (double)INFINITY;
    for (uint32_t i = 0; i < c->count; i++) {
        inside[i] = ex * (old[i].y - p.y) - ey * (old[i].x - p.x);
        least = inside[i] < least ? inside[i] : least;
    }
    if (least >= -gap) {
        return;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->count && count < MOST; i++) {
        uint32_t next = i + 1 < c->count ? i + 1 : 0;
        bool in = inside[i] >= -gap, next_in = inside[next] >= -gap;
        if (in) {
            out[count++] = old[i];
        }
        if (in != next_in) {
            double share = inside[i] / (inside[i] - inside[next]);
            share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
            out[count] = cut_between(c, &old[i], &old[next], share, by);
            out[count++].of_b = in ? by : old[i].of_b;
        }
    }
    c->count = count;
    c->now = 1 - c->now;
}

void tl_face_clip(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch)
{
    face_cut c;
    c.a = a;
    c.b = b;
    c.gap = patch->gap;
    load_faces(&c, patch);
    for (uint32_t by = 0; by < b->count && c.count > 0; by++) {
        cut_by(&c, by);
    }
    patch->in_order = true;
    // Those that coincide are neighbours; the first of them stays.
    const clip_corner *corners = c.corners[c.now], *first = corners, *last = NULL;
    for (uint32_t i = 0; i < c.count; i++) {
        const clip_corner *at = &corners[i];
        if (last != NULL && (tl_same_place(patch, at->x, at->y, last->x, last->y) ||
                             tl_same_place(patch, at->x, at->y, first->x, first->y))) {
            continue;
        }
        tl_point2 p = { at->x, at->y };
        tl_patch_point point = { p.x,
                                 p.y,
                                 tl_patch_height(&heights[0], p),
                                 tl_patch_height(&heights[1], p),
                                 { at->features[0], at->features[1] },
                                 0 };
        tl_patch_add_new(patch, &point);
        last = at;
    }
}
