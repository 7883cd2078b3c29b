// SPDX-License-Identifier: MIT
//
// A triangulation of what is left of an outline, kept while ears are cut off.
//
// The triangles around a corner b, from its edge to c over v1, v2, ... to its edge from a, cover all that b sees near
// by. So the triangle (a, b, c) is free just where all of v1, v2, ... lie beyond the line from a to c: then these
// triangles cover it, and else one of v1, v2, ... lies in it. And to cut it off, the edges from b are flipped until
// only that triangle is left: a Graham scan over v1, v2, ..., whose hull is the edge from a to c. A test and a cut cost
// as many steps as b has edges, which is below 6 for a mean vertex, wherever all other vertices are.
//
// A search in space was the way before, a k-d tree of reflex vertices that skips what lies outside one of the ear's
// three edges. It is as fast where ears are as wide as long, and for the few dozen vertices that contours have it still
// is the better one. But a random star of n vertices has ears n times as long as wide: each crosses the square root of
// n cells of the tree and finds nothing in them, n^1.4 in all. Boxes of other shapes only move the problem to other
// outlines, and Seidel's or Chazelle's trapezoids answer where a point lies, not what a triangle holds.
// Source: the fan of a vertex as its visible neighbourhood, and its retriangulation by flips: de Berg et al.,
// Computational Geometry, chapters 3 and 9; Graham, 1972.

#include "polygon/triangulate/ear_mesh.h"

#include "base/assert.h"

bool tl_ear_mesh_is_free(const tl_ear_vertex *vertices, uint32_t a, uint32_t b, tl_lattice_point from,
                         tl_lattice_point to)
{
    for (uint32_t edge = vertices[b].outer;;) {
        const uint32_t back = tl_ear_edge_previous(edge), v = tl_ear_edge_origin(vertices, back);
        if (v == a) {
            return true;
        }
        if (tl_turn(from, to, vertices[v].position) <= 0) {
            return false;
        }
        edge = tl_ear_edge_twin(vertices, back);
    }
}

// Makes `twin` the far side of `edge`, or the outline.
static void join_ear_edge(tl_ear_vertex *vertices, uint32_t edge, uint32_t twin)
{
    tl_ear_edge *e = tl_ear_edge_at(vertices, edge);
    e->twin = twin;
    if (twin != TL_NO_EAR_EDGE) {
        tl_ear_edge_at(vertices, twin)->twin = edge;
    } else {
        vertices[e->origin].outer = edge;
    }
}

// The triangles (b, u, v) and (b, v, w) become (b, u, w) and (v, w, u); `edge` runs from b to u before and after.
static void flip_ear_edge(tl_ear_vertex *vertices, uint32_t edge)
{
    const uint32_t uv = tl_ear_edge_next(edge), vb = tl_ear_edge_previous(edge);
    const uint32_t bv = tl_ear_edge_twin(vertices, vb), wb = tl_ear_edge_previous(bv);
    const uint32_t beyond_uv = tl_ear_edge_twin(vertices, uv), beyond_wb = tl_ear_edge_twin(vertices, wb);
    tl_ear_edge_at(vertices, vb)->origin = tl_ear_edge_origin(vertices, wb);
    tl_ear_edge_at(vertices, bv)->origin = tl_ear_edge_origin(vertices, uv);
    join_ear_edge(vertices, vb, beyond_wb);
    join_ear_edge(vertices, bv, beyond_uv);
    tl_ear_edge_at(vertices, uv)->twin = wb;
    tl_ear_edge_at(vertices, wb)->twin = uv;
}

void tl_ear_mesh_cut(tl_ear_vertex *vertices, uint32_t a, uint32_t b)
{
    uint32_t edge = vertices[b].outer;
    for (;;) {
        const uint32_t back = tl_ear_edge_previous(edge), v = tl_ear_edge_origin(vertices, back);
        if (v == a) {
            break;
        }
        const uint32_t u = tl_ear_edge_origin(vertices, tl_ear_edge_next(edge));
        const uint32_t beyond = tl_ear_edge_twin(vertices, back);
        const uint32_t w = tl_ear_edge_origin(vertices, tl_ear_edge_previous(beyond));
        if (tl_turn(vertices[u].position, vertices[v].position, vertices[w].position) <= 0) {
            edge = beyond;
            continue;
        }
        flip_ear_edge(vertices, edge);
        if (edge != vertices[b].outer) { // the vertex before may go now
            edge = tl_ear_edge_next(tl_ear_edge_twin(vertices, edge));
        }
    }
    TL_ASSERT(edge == vertices[b].outer);
    const uint32_t inner = tl_ear_edge_twin(vertices, tl_ear_edge_next(edge));
    TL_ASSERT(inner != TL_NO_EAR_EDGE);
    join_ear_edge(vertices, inner, TL_NO_EAR_EDGE);
}
