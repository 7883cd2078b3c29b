// SPDX-License-Identifier: MIT
//
// The polytope that proved a depth proves it again after the pair has moved.
//
// Its points are pairs of vertices, so they can be placed anew: whatever the motion, they lie in A - B. When all its
// triangles still look away from the origin, each ray from there meets one of them, so the ball that touches the
// nearest of their planes lies in the hull of the points: the depth is no less. For that the surface need not be
// convex. Mostly the same triangle is the nearest again, and the support along its normal proves that the depth is no
// more: EPA ends without a step. Else it goes on from here.
//
// Where there are many points not all are kept, but those that the bound needs: the nearest triangle and the point
// opposite, grown within the polytope's own points until no triangle is nearer.

#include "convex/depth/polytope.h"

#include <string.h>

static_assert(TL_KEPT_FACES == 2 * TL_KEPT_POINTS - 4, "Euler");

enum { NO_EDGE = UINT8_MAX };

static tl_minkowski_point kept_point(const tl_polytope *p, uint32_t vertex)
{
    tl_minkowski_point point = { p->vertices[vertex].w, p->vertices[vertex].a, p->ids[vertex][0], p->ids[vertex][1] };
    return point;
}

static void swap_vertices(tl_polytope *p, uint32_t i, uint32_t j)
{
    const tl_polytope_vertex vertex = p->vertices[i];
    const uint16_t a = p->ids[i][0], b = p->ids[i][1];
    p->vertices[i] = p->vertices[j];
    p->ids[i][0] = p->ids[j][0];
    p->ids[i][1] = p->ids[j][1];
    p->vertices[j] = vertex;
    p->ids[j][0] = a;
    p->ids[j][1] = b;
}

// Of the points from `from` on the one farthest along a direction.
static uint32_t farthest_vertex(const tl_polytope *p, uint32_t from, uint32_t count, tl_vec3d direction)
{
    uint32_t best = from;
    for (uint32_t i = from + 1; i < count; i++) {
        best = tl_vec3d_dot(direction, p->vertices[i].w) > tl_vec3d_dot(direction, p->vertices[best].w) ? i : best;
    }
    return best;
}

// Begins anew with a face's corners and the point opposite, which become the first of the points.
static void start_from_face(tl_polytope *p, uint32_t face)
{
    uint8_t corners[3];
    memcpy(corners, &p->origins[4 * (size_t)face], 3);
    const tl_vec3d inward = tl_vec3d_neg(tl_polytope_plane_of(p, face).normal);
    const uint32_t count = p->vertex_count;
    for (uint32_t i = 0; i < 3; i++) {
        swap_vertices(p, i, corners[i]);
        for (uint32_t k = i + 1; k < 3; k++) { // where what was swapped away has gone
            corners[k] = corners[k] == i ? corners[i] : corners[k];
        }
    }
    swap_vertices(p, 3, farthest_vertex(p, 3, count, inward));
    tl_minkowski_point points[4];
    for (uint32_t i = 0; i < 4; i++) {
        points[i] = kept_point(p, i);
    }
    tl_polytope_init(p, points, p->scale);
}

// Makes the polytope one of few points that proves as much. False when it cannot.
static bool thin_polytope(tl_polytope *p, uint32_t nearest, double lower)
{
    const uint32_t count = p->vertex_count;
    const double noise = 2.0 * TL_POLYTOPE_ERROR * p->scale;
    start_from_face(p, nearest);
    for (;;) {
        const uint32_t face = tl_polytope_nearest_face(p);
        if (p->keys[face] >= lower - noise) {
            return true;
        }
        if (p->vertex_count == TL_KEPT_POINTS || p->vertex_count == count) {
            return false;
        }
        const tl_polytope_plane plane = tl_polytope_plane_of(p, face);
        const uint32_t next = farthest_vertex(p, p->vertex_count, count, plane.normal);
        const double beyond = tl_vec3d_dot(plane.normal, p->vertices[next].w) - plane.offset;
        swap_vertices(p, p->vertex_count, next);
        const tl_minkowski_point point = kept_point(p, p->vertex_count);
        if (!(beyond * beyond > noise * noise * plane.normal_sq) || !tl_polytope_add(p, face, &point, p->scale)) {
            return false;
        }
    }
}

static bool is_alive(const tl_polytope *p, uint32_t face)
{
    for (uint32_t i = 0; i < p->free_count; i++) {
        if (p->free_faces[i] == face) {
            return false;
        }
    }
    return true;
}

void tl_polytope_keep(tl_polytope *p, uint32_t nearest, double lower, tl_polytope_cache *cache)
{
    cache->point_count = cache->face_count = 0;
    if (p->vertex_count > TL_KEPT_POINTS && !thin_polytope(p, nearest, lower)) {
        return;
    }
    uint32_t count = 0;
    memset(cache->corners, 0, sizeof cache->corners); // epa.c looks at all of them
    for (uint32_t f = 0; f < p->face_count && count < TL_KEPT_FACES; f++) {
        if (is_alive(p, f)) {
            memcpy(cache->corners[count++], &p->origins[4 * (size_t)f], 3);
        }
    }
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        if (p->ids[i][0] == TL_POLYTOPE_NO_ID || p->ids[i][1] == TL_POLYTOPE_NO_ID) {
            return;
        }
        cache->vertices[i][0] = p->ids[i][0];
        cache->vertices[i][1] = p->ids[i][1];
    }
    cache->point_count = (uint16_t)p->vertex_count;
    cache->face_count = (uint16_t)count;
}

bool tl_polytope_resume(tl_minkowski *pair, const tl_polytope_cache *cache, tl_polytope *p)
{
    tl_minkowski_point points[TL_KEPT_POINTS];
    if (!tl_minkowski_vertices(pair, cache->vertices, cache->point_count, points)) {
        return false;
    }
    for (uint32_t i = 0; i < cache->point_count; i++) {
        p->vertices[i].w = points[i].w;
        p->vertices[i].a = points[i].a;
        p->ids[i][0] = cache->vertices[i][0];
        p->ids[i][1] = cache->vertices[i][1];
    }
    p->vertex_count = cache->point_count;
    p->face_count = cache->face_count;
    p->free_count = 0;
    p->linked = false;
    p->scale = pair->scale;
    for (uint32_t f = 0; f < p->face_count; f++) {
        for (uint32_t i = 0; i < 3; i++) {
            p->origins[4 * f + i] = cache->corners[f][i];
        }
        tl_polytope_set_key(p, f, tl_polytope_plane_of(p, f));
        if (!(p->keys[f] > 0.0)) {
            return false;
        }
    }
    return true;
}

// Half-edges are 4 f + 0, 1 and 2.
static uint32_t kept_edge_after(uint32_t edge)
{
    return (edge & 3u) == 2 ? edge + 2 : edge + 1;
}

static uint8_t end_of(const tl_polytope *p, uint32_t edge)
{
    return p->origins[(edge & 3u) == 2 ? edge - 2 : edge + 1];
}

bool tl_polytope_link(tl_polytope *p)
{
    uint8_t edges[TL_KEPT_POINTS][TL_KEPT_POINTS];
    memset(edges, NO_EDGE, sizeof edges);
    for (uint32_t edge = 0; edge < 4 * p->face_count; edge = kept_edge_after(edge)) {
        uint8_t *at = &edges[p->origins[edge]][end_of(p, edge)];
        if (*at != NO_EDGE) {
            return false;
        }
        *at = (uint8_t)edge;
    }
    for (uint32_t edge = 0; edge < 4 * p->face_count; edge = kept_edge_after(edge)) {
        p->twins[edge] = edges[end_of(p, edge)][p->origins[edge]];
        if (p->twins[edge] == NO_EDGE) {
            return false;
        }
    }
    p->linked = true;
    return true;
}
