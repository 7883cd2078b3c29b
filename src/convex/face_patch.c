// SPDX-License-Identifier: MIT
//
// The corners of what two convex faces have in common: each edge of one is cut to what lies within the other (Cyrus and
// Beck, Generalized Two- and Three-Dimensional Clipping, 1978), and the ends of all pieces are the corners. Against
// clipping the whole polygon edge by edge (Sutherland and Hodgman) this needs no room for the polygon, so faces of any
// number of corners do, without allocation.

#include "convex/face_patch.h"

#include "math/tolerance.h"

// Faces whose edges coincide are cut at the same place: to four float roundings of their size.
#define EDGE_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

// A face that is steeper than 60 degrees to the normal is no face to rest on.
#define MIN_COSINE 0.5

enum { PATCH_BUFFER = 32 };

typedef struct point2 {
    double x, y;
} point2;

typedef struct clipper {
    const tl_face *a, *b;
    tl_patch *patch;
    double limit, gap;
    tl_patch_point buffer[PATCH_BUFFER];
    uint32_t count;
} clipper;

static point2 project(const clipper *c, const tl_face *face, uint32_t i)
{
    tl_vec3d p = tl_face_corner(face, i % face->count);
    point2 q = { tl_vec3d_dot(c->patch->u, p), tl_vec3d_dot(c->patch->v, p) };
    return q;
}

static double height(const clipper *c, const tl_face *face, point2 p)
{
    tl_vec3d flat = tl_vec3d_mul_add(tl_vec3d_scale(c->patch->u, p.x), c->patch->v, p.y);
    return (face->offset - tl_vec3d_dot(face->normal, flat)) / tl_vec3d_dot(face->normal, c->patch->normal);
}

static double distance_sq(tl_patch_point p, tl_patch_point q)
{
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
}

// Twice the area of a triangle, signed.
static double area(tl_patch_point p, tl_patch_point q, tl_patch_point r)
{
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Keeps the deepest point, the one farthest from it, and the farthest from their line to either side.
static void reduce(clipper *c)
{
    uint32_t deepest = 0, far = 0, left = 0, right = 0;
    const tl_patch_point *b = c->buffer;
    for (uint32_t i = 1; i < c->count; i++) {
        deepest = b[i].on_b - b[i].on_a < b[deepest].on_b - b[deepest].on_a ? i : deepest;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        far = distance_sq(b[i], b[deepest]) > distance_sq(b[far], b[deepest]) ? i : far;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        left = area(b[deepest], b[far], b[i]) > area(b[deepest], b[far], b[left]) ? i : left;
        right = area(b[deepest], b[far], b[i]) < area(b[deepest], b[far], b[right]) ? i : right;
    }
    tl_patch_point kept[TL_PATCH_POINTS];
    uint32_t kept_count = 0, chosen[TL_PATCH_POINTS] = { deepest, far, left, right };
    double length = sqrt(distance_sq(b[deepest], b[far]));
    for (int i = 0; i < TL_PATCH_POINTS; i++) {
        bool wide = i < 2 || fabs(area(b[deepest], b[far], b[chosen[i]])) > c->gap * length;
        bool apart = i == 0 || distance_sq(b[chosen[i]], b[deepest]) > c->gap * c->gap;
        if (wide && apart) {
            kept[kept_count++] = b[chosen[i]];
        }
    }
    for (uint32_t i = 0; i < kept_count; i++) {
        c->buffer[i] = kept[i];
    }
    c->count = kept_count;
}

static void emit(clipper *c, point2 p)
{
    tl_patch_point point = { p.x, p.y, height(c, c->a, p), height(c, c->b, p) };
    if (point.on_b - point.on_a > c->limit) {
        return;
    }
    c->buffer[c->count++] = point;
    if (c->count == PATCH_BUFFER) {
        reduce(c);
    }
}

// `turn` is 1 when `within` runs counter-clockwise seen against the normal, else -1.
static void clip_edge(clipper *c, point2 p, point2 q, const tl_face *within, double turn)
{
    double low = 0.0, high = 1.0;
    point2 from = project(c, within, within->count - 1);
    for (uint32_t i = 0; i < within->count; i++) {
        point2 to = project(c, within, i);
        double ex = (to.x - from.x) * turn, ey = (to.y - from.y) * turn, length = sqrt(ex * ex + ey * ey);
        // How far inside the ends are.
        double at_p = ex * (p.y - from.y) - ey * (p.x - from.x), at_q = ex * (q.y - from.y) - ey * (q.x - from.x);
        double gap = c->gap * length;
        if (at_p < -gap && at_q < -gap) {
            return;
        }
        if (at_p < -gap) {
            low = fmax(low, at_p / (at_p - at_q));
        } else if (at_q < -gap) {
            high = fmin(high, at_p / (at_p - at_q));
        }
        from = to;
    }
    if (low <= high) {
        point2 begin = { p.x + (q.x - p.x) * low, p.y + (q.y - p.y) * low },
               end = { p.x + (q.x - p.x) * high, p.y + (q.y - p.y) * high };
        emit(c, begin);
        emit(c, end);
    }
}

static void clip_face(clipper *c, const tl_face *face, const tl_face *within, double turn)
{
    point2 from = project(c, face, face->count - 1);
    for (uint32_t i = 0; i < face->count; i++) {
        point2 to = project(c, face, i);
        clip_edge(c, from, to, within, turn);
        from = to;
    }
}

static double extent(const clipper *c, const tl_face *face)
{
    point2 first = project(c, face, 0);
    double most = fabs(first.x) + fabs(first.y);
    for (uint32_t i = 1; i < face->count; i++) {
        point2 p = project(c, face, i);
        most = fmax(most, fabs(p.x) + fabs(p.y));
    }
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
    if (tl_vec3d_dot(a->normal, normal) < MIN_COSINE || tl_vec3d_dot(b->normal, normal) > -MIN_COSINE) {
        return;
    }
    patch->normal = normal;
    patch->u = tl_vec3d_perpendicular(normal);
    patch->v = tl_vec3d_cross(normal, patch->u);
    c.gap = EDGE_GAP * fmax(extent(&c, a), extent(&c, b));
    clip_face(&c, a, b, -1.0);
    clip_face(&c, b, a, 1.0);
    if (c.count > 0) {
        reduce(&c);
    }
    for (uint32_t i = 0; i < c.count; i++) {
        patch->points[i] = c.buffer[i];
    }
    patch->count = c.count;
}
