// SPDX-License-Identifier: MIT
//
// Constrained Delaunay triangulation by flipping edges.
// Source: Lawson, "Transforming Triangulations", 1972; Lee and Lin, "Generalized Delaunay Triangulation for Planar
// Graphs", 1986.
//
// A triangulation of the outline is at hand, and on the outlines of levels a few flips for each ten vertices mend it,
// so no divide and conquer is worth its code. A queue instead of a stack keeps the number of flips near-linear on long
// thin outlines; each flip raises the triangulation under a paraboloid, so none comes back and the loop ends.

#include "polygon/triangulate/delaunay.h"

#include "polygon/triangulate/triangulate.h"

// |a| * |b| of two numbers below 2^62, as high and low halves.
typedef struct wide {
    uint64_t high, low;
} wide;

static wide multiply(int64_t x, int64_t y)
{
    uint64_t a = x < 0 ? 0 - (uint64_t)x : (uint64_t)x;
    uint64_t b = y < 0 ? 0 - (uint64_t)y : (uint64_t)y;
    uint64_t a_low = a & UINT32_MAX, a_high = a >> 32;
    uint64_t b_low = b & UINT32_MAX, b_high = b >> 32;
    uint64_t low = a_low * b_low;
    uint64_t middle = a_high * b_low + (low >> 32); // below 2^63: a_high is below 2^30
    uint64_t other = a_low * b_high + (middle & UINT32_MAX);
    wide result = { a_high * b_high + (middle >> 32) + (other >> 32), other << 32 | (low & UINT32_MAX) };
    return result;
}

// The angles at b and d of the quadrilateral a, b, c, d sum to more than 180 degrees just where d lies in the circle:
// sin(B + D) = sin B cos D + cos B sin D < 0. Sines are turns, > 0 here, and cosines dot products, both within 2^61
// (lattice.h), so their signs mostly decide, and else two products of 122 bits do.
bool tl_in_circle(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c, tl_lattice_point d)
{
    int64_t cos_b = tl_dot2(b, a, c);
    int64_t cos_d = tl_dot2(d, a, c);
    if (cos_b >= 0 && cos_d >= 0) {
        return false;
    }
    if (cos_b <= 0 && cos_d <= 0) {
        return true;
    }
    wide at_b = multiply(cos_b, tl_turn(a, c, d));
    wide at_d = multiply(cos_d, tl_turn(a, b, c));
    bool b_is_larger = at_b.high != at_d.high ? at_b.high > at_d.high : at_b.low > at_d.low;
    bool d_is_larger = at_b.high != at_d.high ? at_b.high < at_d.high : at_b.low < at_d.low;
    return cos_b < 0 ? b_is_larger : d_is_larger;
}

static void link(uint32_t *twins, uint32_t edge, uint32_t twin)
{
    twins[edge] = twin;
    if (twin != TL_NO_EDGE) {
        twins[twin] = edge;
    }
}

// Edges that wait, each at most once, in a ring.
typedef struct edge_queue {
    uint32_t *edges;
    uint8_t *waits; // [edge]
    uint32_t head, count, capacity;
} edge_queue;

static void enqueue(edge_queue *q, const uint32_t *twins, uint32_t edge)
{
    if (twins[edge] == TL_NO_EDGE) {
        return;
    }
    uint32_t key = edge < twins[edge] ? edge : twins[edge];
    if (q->waits[key]) {
        return;
    }
    q->waits[key] = 1;
    uint32_t place = q->capacity - q->head > q->count ? q->head + q->count : q->count - (q->capacity - q->head);
    q->edges[place] = key;
    q->count++;
}

static uint32_t dequeue(edge_queue *q)
{
    uint32_t edge = q->edges[q->head];
    q->head = q->head + 1 < q->capacity ? q->head + 1 : 0;
    q->count--;
    q->waits[edge] = 0;
    return edge;
}

// The edge a to c between the triangles a, c, d and c, a, b becomes the edge b to d. The sides of the quadrilateral get
// other numbers, so one that waits under its old number is found there no more; the caller enqueues all four.
static void flip_diagonal(uint32_t *corners, uint32_t *twins, uint32_t edge)
{
    uint32_t twin = twins[edge];
    uint32_t cd = tl_triangle_edge_next(edge), da = tl_triangle_edge_next(cd);
    uint32_t ab = tl_triangle_edge_next(twin), bc = tl_triangle_edge_next(ab);
    uint32_t beyond_cd = twins[cd], beyond_ab = twins[ab];
    uint32_t b = corners[bc], d = corners[da];
    // Triangle of `edge`: b, d, a -> at edge: b to d, at cd: d to a, at da: a to b. The other: d, b, c.
    uint32_t a = corners[edge], c = corners[twin];
    uint32_t beyond_da = twins[da], beyond_bc = twins[bc];
    corners[edge] = b;
    corners[cd] = d;
    corners[da] = a;
    corners[twin] = d;
    corners[ab] = b;
    corners[bc] = c;
    link(twins, cd, beyond_da);
    link(twins, da, beyond_ab);
    link(twins, ab, beyond_bc);
    link(twins, bc, beyond_cd);
}

tl_result tl_make_delaunay(tl_arena *scratch, const tl_lattice_point *points, uint32_t *corners, uint32_t *twins,
                           uint32_t triangle_count)
{
    edge_queue q = { NULL, NULL, 0, 0, 3 * triangle_count };
    q.edges = TL_PUSH(scratch, uint32_t, q.capacity);
    q.waits = TL_PUSH_ZERO(scratch, uint8_t, q.capacity);
    if (q.edges == NULL || q.waits == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t edge = 0; edge < q.capacity; edge++) {
        enqueue(&q, twins, edge);
    }
    while (q.count > 0) {
        uint32_t edge = dequeue(&q);
        uint32_t twin = twins[edge];
        if (twin == TL_NO_EDGE) { // a flip has put an edge of the outline here
            continue;
        }
        uint32_t c = tl_triangle_edge_next(edge), a = tl_triangle_edge_next(twin);
        tl_lattice_point d = points[corners[tl_triangle_edge_next(c)]];
        tl_lattice_point b = points[corners[tl_triangle_edge_next(a)]];
        if (!tl_in_circle(points[corners[a]], b, points[corners[c]], d)) {
            continue;
        }
        flip_diagonal(corners, twins, edge);
        enqueue(&q, twins, c);
        enqueue(&q, twins, tl_triangle_edge_next(c));
        enqueue(&q, twins, a);
        enqueue(&q, twins, tl_triangle_edge_next(a));
    }
    return TL_OK;
}
