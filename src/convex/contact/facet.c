// SPDX-License-Identifier: MIT
//
// Facets. A hull's faces are exactly plane, so the square that a turned box had becomes two triangles once its corners
// are floats, and a rock's flat side a dozen. Contacts want the whole side.
//
// A face belongs to the facet when all its corners lie in the plane of the one given, or below by no more than the
// rounding of coordinates explains. The hull is convex: what lies so high on it is one piece without holes. Nothing is
// stored; the outline is walked from half-edge to half-edge, and each face met is tested again.

#include "convex/contact/facet.h"

#include "math/tolerance.h"
#include "math/vec3d.h"

// A corner is off by half an ulp of the largest coordinate in each component, and so are the three that the plane goes
// through; eight roundings cover a plane whose points were rounded to floats, as in tl_hull_def.flatness.
#define FLAT_GAP (8.0 * (double)TL_FLOAT_ROUNDING)

static double height_above(const tl_facet *facet, uint32_t vertex)
{
    tl_vec3 v = tl_hull_vertices(facet->hull)[vertex];
    const double *n = facet->plane.normal;
    return n[0] * (double)v.x + n[1] * (double)v.y + n[2] * (double)v.z - facet->plane.offset;
}

static bool facet_holds(const tl_facet *facet, uint32_t face)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    tl_hull_face f = tl_hull_faces(facet->hull)[face];
    for (uint32_t i = 0; face != facet->face && i < f.count; i++) {
        if (height_above(facet, half_edges[f.first + i].origin) < -facet->gap) {
            return false;
        }
    }
    return true;
}

// The same of the face beside a half-edge; a corner that lies off the edge mostly tells.
static bool holds_beside(const tl_facet *facet, uint32_t edge)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    tl_hull_half_edge twin = half_edges[half_edges[edge].twin];
    return height_above(facet, half_edges[half_edges[twin.next].next].origin) >= -facet->gap &&
           facet_holds(facet, twin.face);
}

static bool is_alone(const tl_facet *facet)
{
    tl_hull_face face = tl_hull_faces(facet->hull)[facet->face];
    for (uint32_t i = 0; i < face.count; i++) {
        if (holds_beside(facet, face.first + i)) {
            return false;
        }
    }
    return true;
}

// A half-edge of the outline that starts at the vertex, which the facet has a face at; TL_NO_VERTEX when it is inside.
static uint32_t outline_at(const tl_facet *facet, uint32_t vertex)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    uint32_t start = tl_hull_vertex_edges(facet->hull)[vertex], edge = start;
    do {
        if (facet_holds(facet, half_edges[edge].face) && !facet_holds(facet, half_edges[half_edges[edge].twin].face)) {
            return edge;
        }
        edge = half_edges[half_edges[edge].twin].next;
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
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    uint32_t start = tl_hull_vertex_edges(facet->hull)[vertex], edge = start, best = vertex;
    do {
        uint32_t other = half_edges[half_edges[edge].twin].origin;
        best = along(facet, direction, other) > along(facet, direction, best) ? other : best;
        edge = half_edges[half_edges[edge].twin].next;
    } while (edge != start);
    return best;
}

void tl_facet_around(const tl_hull *hull, uint32_t face, tl_facet *facet)
{
    tl_vec3 size = tl_max(tl_abs(hull->bounds.min), tl_abs(hull->bounds.max));
    facet->hull = hull;
    facet->face = face;
    facet->plane = tl_hull_face_plane(hull, face);
    facet->first = tl_hull_faces(hull)[face].first;
    facet->gap = FLAT_GAP * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    facet->alone = is_alone(facet);
    if (facet->alone || !holds_beside(facet, facet->first)) {
        return;
    }
    // Go straight on in the plane until the outline: inside of it some neighbour is always farther.
    const double *n = facet->plane.normal;
    tl_vec3d direction = tl_vec3d_perpendicular(tl_vec3d_make(n[0], n[1], n[2]));
    uint32_t vertex = tl_hull_half_edges(hull)[facet->first].origin, edge = outline_at(facet, vertex);
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
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    uint32_t edge = half_edges[half_edge].next;
    while (!facet->alone && holds_beside(facet, edge)) {
        edge = half_edges[half_edges[edge].twin].next;
    }
    return edge;
}

uint32_t tl_facet_previous(const tl_facet *facet, uint32_t half_edge)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(facet->hull);
    uint32_t edge = half_edge;
    for (;;) {
        tl_hull_face face = tl_hull_faces(facet->hull)[half_edges[edge].face];
        edge = edge == face.first ? face.first + face.count - 1 : edge - 1;
        uint32_t twin = half_edges[edge].twin;
        if (facet->alone || !holds_beside(facet, edge)) {
            return edge;
        }
        edge = twin;
    }
}
