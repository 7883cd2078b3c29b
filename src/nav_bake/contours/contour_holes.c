// SPDX-License-Identifier: MIT
//
// Hole merge: each hole is joined to its outline by a bridge, so that one closed path runs round the floor.
//
// Holes are taken from left to right. A bridge runs from the hole's leftmost vertex, or else from its other ones in
// turn, to the nearest outline vertex that sees it: within the wedge of floor there, and crossing neither the outline
// nor any hole that is still to come, its own included. What was bridged is part of the outline for the next hole.
// Source: Eberly, Triangulation by Ear Clipping; Mononen, Recast.
//
// All tests are exact in integers. The nearest candidate is found anew for each try and nothing is sorted: one try is
// nearly always enough, and testing it costs as much as finding it.

#include "nav_bake/contours/contours.h"

#include <string.h>

typedef struct bridging {
    const tl_contour_vertex *vertices;
    tl_contour_path *outline;
    const tl_contour_path *holes;
    const tl_sort_item *order; // holes, from left to right
    uint32_t hole_count;
} bridging;

static bool is_left_of_line(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *c)
{
    return tl_contour_area2(a, b, c) < 0;
}

// Whether p lies strictly within the floor's wedge at the outline's place j.
static bool sees_from_corner(const bridging *b, uint32_t j, const tl_contour_vertex *p)
{
    const tl_contour_path *path = b->outline;
    const tl_contour_vertex *at = &b->vertices[path->vertices[j]];
    const tl_contour_vertex *next = &b->vertices[path->vertices[j + 1 < path->count ? j + 1 : 0]];
    const tl_contour_vertex *previous = &b->vertices[path->vertices[j > 0 ? j - 1 : path->count - 1]];
    if (tl_contour_area2(previous, at, next) <= 0) { // convex or straight
        return is_left_of_line(at, p, previous) && is_left_of_line(p, at, next);
    }
    return !(tl_contour_area2(at, p, next) <= 0 && tl_contour_area2(p, at, previous) <= 0);
}

static bool is_within_outline(const tl_contour_vertex *p, const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    bool along_x = a->x != b->x;
    int32_t low = along_x ? (a->x < b->x ? a->x : b->x) : (a->z < b->z ? a->z : b->z);
    int32_t high = along_x ? (a->x < b->x ? b->x : a->x) : (a->z < b->z ? b->z : a->z);
    int32_t value = along_x ? p->x : p->z;
    return low <= value && value <= high;
}

// Whether two segments share a point.
static bool bridge_meets_edge(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *c,
                              const tl_contour_vertex *d)
{
    int64_t c_side = tl_contour_area2(a, b, c), d_side = tl_contour_area2(a, b, d);
    int64_t a_side = tl_contour_area2(c, d, a), b_side = tl_contour_area2(c, d, b);
    if (c_side != 0 && d_side != 0 && a_side != 0 && b_side != 0) {
        return (c_side < 0) != (d_side < 0) && (a_side < 0) != (b_side < 0);
    }
    return (c_side == 0 && is_within_outline(c, a, b)) || (d_side == 0 && is_within_outline(d, a, b)) ||
           (a_side == 0 && is_within_outline(a, c, d)) || (b_side == 0 && is_within_outline(b, c, d));
}

// Whether the bridge meets an edge of the path that it shares no end with.
static bool meets_path(const bridging *b, const tl_contour_vertex *p, const tl_contour_vertex *q,
                       const tl_contour_path *path)
{
    const tl_contour_vertex *before = &b->vertices[path->vertices[path->count - 1]];
    for (uint32_t k = 0; k < path->count; k++) {
        const tl_contour_vertex *after = &b->vertices[path->vertices[k]];
        bool shares_end = tl_contour_same_xz(p, before) || tl_contour_same_xz(p, after) ||
                          tl_contour_same_xz(q, before) || tl_contour_same_xz(q, after);
        if (!shares_end && bridge_meets_edge(p, q, before, after)) {
            return true;
        }
        before = after;
    }
    return false;
}

static bool is_clear(const bridging *b, uint32_t place, const tl_contour_vertex *p, uint32_t rank)
{
    const tl_contour_vertex *at = &b->vertices[b->outline->vertices[place]];
    if (meets_path(b, at, p, b->outline)) {
        return false;
    }
    for (uint32_t k = rank; k < b->hole_count; k++) {
        if (meets_path(b, at, p, &b->holes[b->order[k].value])) {
            return false;
        }
    }
    return true;
}

static int64_t hole_distance_sq(const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    int64_t dx = (int64_t)b->x - a->x, dz = (int64_t)b->z - a->z;
    return dx * dx + dz * dz;
}

// The nearest place of the outline that sees p, ties to the lower one; outline->count when none does.
static uint32_t find_bridge(const bridging *b, const tl_contour_vertex *p, uint32_t rank)
{
    const tl_contour_path *path = b->outline;
    int64_t tried_distance = -1;
    uint32_t tried = 0;
    for (;;) { // each round tries a place that comes later by (distance, place)
        uint32_t best = path->count;
        int64_t best_distance = INT64_MAX;
        for (uint32_t j = 0; j < path->count; j++) {
            int64_t d = hole_distance_sq(&b->vertices[path->vertices[j]], p);
            bool later = d > tried_distance || (d == tried_distance && j > tried);
            if (d < best_distance && later && sees_from_corner(b, j, p)) {
                best = j;
                best_distance = d;
            }
        }
        if (best == path->count || is_clear(b, best, p, rank)) {
            return best;
        }
        tried = best;
        tried_distance = best_distance;
    }
}

// Inserts the hole, from `corner` round to `corner`, and the way back to `place`.
static void insert_hole(tl_contour_path *outline, uint32_t place, const tl_contour_path *hole, uint32_t corner)
{
    uint32_t *gap = outline->vertices + place + 1;
    uint32_t added = hole->count + 2;
    memmove(gap + added, gap, (outline->count - place - 1) * sizeof *gap);
    for (uint32_t k = 0; k <= hole->count; k++) {
        gap[k] = hole->vertices[(corner + k) % hole->count];
    }
    gap[hole->count + 1] = outline->vertices[place];
    outline->count += added;
}

static bool bridge_hole(const bridging *b, uint32_t rank)
{
    const tl_contour_path *hole = &b->holes[b->order[rank].value];
    uint32_t leftmost = b->order[rank].extra;
    for (uint32_t k = 0; k < hole->count; k++) {
        uint32_t corner = (leftmost + k) % hole->count;
        uint32_t place = find_bridge(b, &b->vertices[hole->vertices[corner]], rank);
        if (place < b->outline->count) {
            insert_hole(b->outline, place, hole, corner);
            return true;
        }
    }
    return false;
}

uint32_t tl_contours_bridge_holes(const tl_contour_work *work, tl_contour_path *outline, const tl_contour_path *holes,
                                  uint32_t hole_count, tl_sort_item *order, tl_sort_item *scratch)
{
    bridging b = { work->vertices, outline, holes, order, hole_count };
    for (uint32_t h = 0; h < hole_count; h++) {
        uint32_t leftmost = 0;
        for (uint32_t k = 1; k < holes[h].count; k++) {
            const tl_contour_vertex *p = &work->vertices[holes[h].vertices[k]];
            const tl_contour_vertex *q = &work->vertices[holes[h].vertices[leftmost]];
            leftmost = p->x < q->x || (p->x == q->x && p->z < q->z) ? k : leftmost;
        }
        const tl_contour_vertex *p = &work->vertices[holes[h].vertices[leftmost]];
        order[h].key = ((uint64_t)((int64_t)p->x - INT32_MIN) << 32) | (uint64_t)((int64_t)p->z - INT32_MIN);
        order[h].value = h;
        order[h].extra = leftmost;
    }
    tl_radix_sort(order, scratch, hole_count);
    uint32_t unbridged = 0;
    for (uint32_t rank = 0; rank < hole_count; rank++) {
        unbridged += !bridge_hole(&b, rank);
    }
    return unbridged;
}
