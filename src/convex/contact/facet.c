// SPDX-License-Identifier: MIT
//
// Facets. A hull's faces are exactly plane, so the square that a turned box had becomes two triangles once its corners
// are floats, and a rock's flat side a dozen. Contacts want the whole side.
//
// A face belongs to the facet when all its corners lie in the plane of the one given, or below by no more than the
// rounding of coordinates explains; a hull's flags tell that none does. The hull is convex: what lies so high on it is
// one piece without holes. Nothing is stored; the outline is walked from half-edge to half-edge, and each face met is
// tested again.

#include "convex/contact/facet.h"

#include "math/vec3d.h"

static double height_above(const tl_facet *facet, uint32_t vertex)
{
    tl_vec3 v = tl_hull_vertices(facet->hull)[vertex];
    const double *n = facet->plane.normal;
    return n[0] * (double)v.x + n[1] * (double)v.y + n[2] * (double)v.z - facet->plane.offset;
}

static bool facet_holds(const tl_facet *facet, uint32_t face)
{
    if (face == facet->face) {
        return true;
    }
    const uint32_t end = tl_hull_face_first(facet->hull, face + 1);
    for (uint32_t at = tl_hull_face_first(facet->hull, face); at < end; at++) {
        if (height_above(facet, tl_hull_edge_origin(facet->hull, at)) < -facet->gap) {
            return false;
        }
    }
    return true;
}

// The same of the face beside a half-edge; a corner that lies off the edge mostly tells.
static bool holds_beside(const tl_facet *facet, uint32_t edge)
{
    const tl_hull *hull = facet->hull;
    const uint32_t twin = tl_hull_edge_twin(hull, edge), face = tl_hull_edge_face(hull, twin);
    const uint32_t first = tl_hull_face_first(hull, face), end = tl_hull_face_first(hull, face + 1);
    const uint32_t off = twin + 2 < end ? twin + 2 : twin + 2 - (end - first); // a face has three corners or more
    return height_above(facet, tl_hull_edge_origin(hull, off)) >= -facet->gap && facet_holds(facet, face);
}

static bool is_alone(const tl_facet *facet)
{
    const uint32_t end = tl_hull_face_first(facet->hull, facet->face + 1);
    for (uint32_t edge = facet->first; edge < end; edge++) {
        if (holds_beside(facet, edge)) {
            return false;
        }
    }
    return true;
}

// A half-edge of the outline that starts at the vertex, which the facet has a face at; TL_NO_VERTEX when it is inside.
static uint32_t outline_at(const tl_facet *facet, uint32_t vertex)
{
    const tl_hull *hull = facet->hull;
    uint32_t start = tl_hull_vertex_edge(hull, vertex), edge = start;
    do {
        const uint32_t twin = tl_hull_edge_twin(hull, edge);
        if (facet_holds(facet, tl_hull_edge_face(hull, edge)) && !facet_holds(facet, tl_hull_edge_face(hull, twin))) {
            return edge;
        }
        edge = tl_hull_edge_next(hull, twin);
    } while (edge != start);
    return TL_NO_VERTEX;
}

static double along(const tl_facet *facet, tl_vec3d direction, uint32_t vertex)
{
    return tl_vec3d_dot(direction, tl_vec3d_from(tl_hull_vertices(facet->hull)[vertex]));
}

// The neighbour that is farthest along the direction; the vertex itself when none is farther.
static uint32_t farther_neighbour(const tl_facet *facet, tl_vec3d direction, uint32_t vertex)
{
    uint32_t start = tl_hull_vertex_edge(facet->hull, vertex), edge = start, best = vertex;
    do {
        const uint32_t twin = tl_hull_edge_twin(facet->hull, edge), other = tl_hull_edge_origin(facet->hull, twin);
        best = along(facet, direction, other) > along(facet, direction, best) ? other : best;
        edge = tl_hull_edge_next(facet->hull, twin);
    } while (edge != start);
    return best;
}

void tl_facet_around(const tl_hull *hull, uint32_t face, tl_facet *facet)
{
    facet->hull = hull;
    facet->face = face;
    facet->first = tl_hull_face_first(hull, face);
    facet->alone = (hull->flags & TL_HULL_HAS_SIDES) == 0;
    if (facet->alone) {
        return;
    }
    tl_vec3 size = tl_max(tl_abs(hull->bounds.min), tl_abs(hull->bounds.max));
    facet->plane = tl_hull_face_plane(hull, face);
    facet->gap = TL_HULL_SIDE_GAP * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    facet->alone = is_alone(facet);
    if (facet->alone || !holds_beside(facet, facet->first)) {
        return;
    }
    // Go straight on in the plane until the outline: inside of it some neighbour is always farther.
    const double *n = facet->plane.normal;
    tl_vec3d direction = tl_vec3d_perpendicular(tl_vec3d_make(n[0], n[1], n[2]));
    uint32_t vertex = tl_hull_edge_origin(hull, facet->first), edge = outline_at(facet, vertex);
    while (edge == TL_NO_VERTEX) {
        uint32_t next = farther_neighbour(facet, direction, vertex);
        if (next == vertex) {
            facet->gap = -(double)INFINITY; // rounding: the face alone
            facet->alone = true;
            return;
        }
        vertex = next;
        edge = outline_at(facet, vertex);
    }
    facet->first = edge;
    return;
}

uint32_t tl_facet_next(const tl_facet *facet, uint32_t half_edge)
{
    uint32_t edge = tl_hull_edge_next(facet->hull, half_edge);
    while (!facet->alone && holds_beside(facet, edge)) {
        edge = tl_hull_edge_next(facet->hull, tl_hull_edge_twin(facet->hull, edge));
    }
    return edge;
}

uint32_t tl_facet_previous(const tl_facet *facet, uint32_t half_edge)
{
    uint32_t edge = half_edge;
    for (;;) {
        const tl_hull_face face = tl_hull_face_at(facet->hull, tl_hull_edge_face(facet->hull, edge));
        edge = edge == face.first ? face.first + face.count - 1 : edge - 1;
        const uint32_t twin = tl_hull_edge_twin(facet->hull, edge);
        if (facet->alone || !holds_beside(facet, edge)) {
            return edge;
        }
        edge = twin;
    }
}
