// SPDX-License-Identifier: MIT
//
// The corners of the intersection of two convex faces, or of a face and an edge: each edge of one is clipped against
// the other (Cyrus and Beck, Generalized Two- and Three-Dimensional Clipping, 1978), and the ends of all pieces
// are the corners. Unlike clipping the whole polygon edge by edge (Sutherland and Hodgman) this needs no buffer for the
// polygon, so faces may have any number of corners, without allocation: a few edges of one face at a time are clipped
// against all of the other.

#include "convex/face_patch.h"

#include "math/tolerance.h"

// Faces whose edges coincide are clipped at the same place: to four float roundings of their size.
#define EDGE_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

enum { PATCH_BUFFER = 32, PIECES = 32 };

typedef struct point2 {
    double x, y;
} point2;

typedef struct clipper {
    const tl_face *a, *b;
    tl_patch *patch;
    double limit;
    tl_patch_point buffer[PATCH_BUFFER];
    uint32_t count;
} clipper;

static point2 project_corner(const clipper *c, const tl_face *face, uint32_t at)
{
    tl_vec3d p = tl_face_corner(face, at);
    point2 q = { tl_vec3d_dot(c->patch->u, p), tl_vec3d_dot(c->patch->v, p) };
    return q;
}

static double height_on_face(const clipper *c, const tl_face *face, point2 p)
{
    tl_vec3d flat = tl_vec3d_mul_add(tl_vec3d_scale(c->patch->u, p.x), c->patch->v, p.y);
    return (face->offset - tl_vec3d_dot(face->normal, flat)) / tl_vec3d_dot(face->normal, c->patch->normal);
}

static double patch_distance_sq(tl_patch_point p, tl_patch_point q)
{
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
}

// Twice the area of a triangle, signed.
static double area(tl_patch_point p, tl_patch_point q, tl_patch_point r)
{
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Keeps the deepest point, the one farthest from it, and the farthest from their line to either side. Returns how many.
static uint32_t reduce_to_four(tl_patch_point *b, uint32_t count, double gap)
{
    uint32_t deepest = 0, far = 0, left = 0, right = 0;
    for (uint32_t i = 1; i < count; i++) {
        deepest = b[i].on_b - b[i].on_a < b[deepest].on_b - b[deepest].on_a ? i : deepest;
    }
    for (uint32_t i = 0; i < count; i++) {
        far = patch_distance_sq(b[i], b[deepest]) > patch_distance_sq(b[far], b[deepest]) ? i : far;
    }
    for (uint32_t i = 0; i < count; i++) {
        left = area(b[deepest], b[far], b[i]) > area(b[deepest], b[far], b[left]) ? i : left;
        right = area(b[deepest], b[far], b[i]) < area(b[deepest], b[far], b[right]) ? i : right;
    }
    tl_patch_point kept[TL_PATCH_POINTS];
    uint32_t kept_count = 0, chosen[TL_PATCH_POINTS] = { deepest, far, left, right };
    double length = sqrt(patch_distance_sq(b[deepest], b[far]));
    for (int i = 0; i < TL_PATCH_POINTS; i++) {
        bool wide = i < 2 || fabs(area(b[deepest], b[far], b[chosen[i]])) > gap * length;
        bool apart = i == 0 || patch_distance_sq(b[chosen[i]], b[deepest]) > gap * gap;
        if (wide && apart) {
            kept[kept_count++] = b[chosen[i]];
        }
    }
    for (uint32_t i = 0; i < kept_count; i++) {
        b[i] = kept[i];
    }
    return kept_count;
}

static void add_patch_point(clipper *c, point2 p)
{
    tl_patch_point point = { p.x, p.y, height_on_face(c, c->a, p), height_on_face(c, c->b, p) };
    if (point.on_b - point.on_a > c->limit) {
        return;
    }
    c->buffer[c->count++] = point;
    if (c->count == PATCH_BUFFER) {
        c->count = reduce_to_four(c->buffer, c->count, c->patch->gap);
    }
}

// What is left of an edge from p to q: between the shares low and high.
typedef struct piece {
    point2 p, q;
    double low, high;
} piece;

// Cuts off what lies to the right of the line, or, when `turn` is -1, to the left.
static void clip_piece(const clipper *c, piece *e, point2 from, point2 to, double turn)
{
    double ex = (to.x - from.x) * turn, ey = (to.y - from.y) * turn, length = sqrt(ex * ex + ey * ey);
    // How far inside the ends are.
    double at_p = ex * (e->p.y - from.y) - ey * (e->p.x - from.x),
           at_q = ex * (e->q.y - from.y) - ey * (e->q.x - from.x);
    double gap = c->patch->gap * length;
    if (at_p < -gap && at_q < -gap) {
        e->high = -1.0;
    } else if (at_p < -gap) {
        e->low = fmax(e->low, at_p / (at_p - at_q));
    } else if (at_q < -gap) {
        e->high = fmin(e->high, at_p / (at_p - at_q));
    }
}

static void clip_pieces(clipper *c, piece *pieces, uint32_t count, const tl_face *within, double turn)
{
    uint32_t at = within->first;
    point2 from = project_corner(c, within, at);
    do {
        at = tl_face_next(within, at);
        point2 to = project_corner(c, within, at);
        for (uint32_t i = 0; i < count; i++) {
            clip_piece(c, &pieces[i], from, to, turn);
        }
        from = to;
    } while (at != within->first);
    for (uint32_t i = 0; i < count; i++) {
        const piece *e = &pieces[i];
        if (e->low <= e->high) {
            point2 begin = { e->p.x + (e->q.x - e->p.x) * e->low, e->p.y + (e->q.y - e->p.y) * e->low },
                   end = { e->p.x + (e->q.x - e->p.x) * e->high, e->p.y + (e->q.y - e->p.y) * e->high };
            add_patch_point(c, begin);
            add_patch_point(c, end);
        }
    }
}

// `turn` is 1 when `within` runs counter-clockwise seen against the normal, else -1.
static void clip_face(clipper *c, const tl_face *face, const tl_face *within, double turn)
{
    piece pieces[PIECES];
    uint32_t count = 0, at = face->first;
    point2 from = project_corner(c, face, at);
    do {
        at = tl_face_next(face, at);
        piece next = { from, project_corner(c, face, at), 0.0, 1.0 };
        pieces[count++] = next;
        from = next.q;
        if (count == PIECES || at == face->first) {
            clip_pieces(c, pieces, count, within, turn);
            count = 0;
        }
    } while (at != face->first);
}

static double extent(const clipper *c, const tl_face *face)
{
    double most = 0.0;
    uint32_t at = face->first;
    do {
        point2 p = project_corner(c, face, at);
        most = fmax(most, fabs(p.x) + fabs(p.y));
        at = tl_face_next(face, at);
    } while (at != face->first);
    return most;
}

void tl_patch_find(const tl_face *a, const tl_face *b, tl_vec3d normal, double limit, tl_patch *patch)
{
    clipper c;
    c.a = a;
    c.b = b;
    c.patch = patch;
    c.limit = limit;
    c.count = patch->count = 0;
    patch->normal = normal;
    patch->u = tl_vec3d_perpendicular(normal);
    patch->v = tl_vec3d_cross(normal, patch->u);
    patch->gap = EDGE_GAP * fmax(extent(&c, a), extent(&c, b));
    // Nothing lies within an edge.
    if (b->count != 2) {
        clip_face(&c, a, b, -1.0);
    }
    if (a->count != 2) {
        clip_face(&c, b, a, 1.0);
    }
    if (c.count > 0) {
        c.count = reduce_to_four(c.buffer, c.count, patch->gap);
    }
    for (uint32_t i = 0; i < c.count; i++) {
        patch->points[i] = c.buffer[i];
    }
    patch->count = c.count;
}

void tl_patch_add_deepest(tl_patch *patch, tl_vec3d on_a, tl_vec3d on_b)
{
    tl_patch_point points[TL_PATCH_POINTS + 1];
    tl_patch_point deepest = { tl_vec3d_dot(patch->u, on_a), tl_vec3d_dot(patch->v, on_a),
                               tl_vec3d_dot(patch->normal, on_a), tl_vec3d_dot(patch->normal, on_b) };
    points[0] = deepest;
    for (uint32_t i = 0; i < patch->count; i++) {
        points[i + 1] = patch->points[i];
    }
    patch->count = reduce_to_four(points, patch->count + 1, patch->gap);
    for (uint32_t i = 0; i < patch->count; i++) {
        patch->points[i] = points[i];
    }
}
