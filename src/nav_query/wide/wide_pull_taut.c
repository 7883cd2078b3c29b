// SPDX-License-Identifier: MIT
//
// Pulling a free path taut, to the shortest one of its homotopy class: at each vertex the triangle over it is emptied.
// The two sides that meet in the vertex are replaced by the hull, on their side, of all corners of caps in the
// triangle: the shortest way there that passes each obstacle on the same side. No obstacle lies between the old path
// and the new one, so the path stays free, and one that cannot be shortened so is the shortest of its class, over tiles
// and floors. Every other vertex is taken first, so that a long straight stretch is joined in a few sweeps of small
// triangles. Source: Hershberger and Snoeyink, Computing Minimum Length Paths of a Given Homotopy Class, 1994, for the
// proof that such a path is unique; the steps are those of a rubber band.

#include "nav_query/wide/wide_search.h"

#include "nav_query/plane/circle_corners.h"

#include "math/tolerance.h"

#include <string.h>

// Far more sweeps than the doubling of stretches and the settling of vertices take. A path is free after each.
enum { MAX_SWEEPS = 64 };

// Share of its length that a step must gain: many roundings, so that steps cannot go around in a circle.
static const double MIN_GAIN = 1024.0 * TL_DOUBLE_ROUNDING;

// A corner of the cap around a wall's end.
typedef struct cap_corner {
    tl_nav_spot spot, center;
} cap_corner;

// The triangle over a vertex, and the new way.
typedef struct triangle {
    tl_nav_spot a, b, c;
    double hand; // the sign of the turn from a over c to b
    tl_nav_near_walls near;
    cap_corner *corners; // in the triangle
    uint32_t count;
} triangle;

static double length(tl_nav_spot a, tl_nav_spot b)
{
    return sqrt(tl_nav_spot_distance_sq(a, b));
}

// In the triangle or on its outline, but not at the ends of the way.
static bool triangle_holds(const triangle *t, tl_nav_spot spot)
{
    return t->hand * tl_nav_spot_turn(t->a, t->c, spot) >= 0.0 && t->hand * tl_nav_spot_turn(t->c, t->b, spot) >= 0.0 &&
           t->hand * tl_nav_spot_turn(t->b, t->a, spot) >= 0.0 && !tl_nav_is_same_spot(spot, t->a) &&
           !tl_nav_is_same_spot(spot, t->c);
}

// Whether the way turns around a cap of which the vertex itself is a corner. A cap on the other side of the vertex
// touches the triangle there and does not hold it: the way is free, so a cap lies on one side or the other.
static bool turns_around(const triangle *t, tl_nav_spot center)
{
    return t->hand * tl_nav_spot_turn(t->c, t->b, center) >= 0.0 &&
           t->hand * tl_nav_spot_turn(t->b, t->a, center) >= 0.0;
}

// Whether a circle has a part on the inner side of all sides of the triangle.
static bool may_hold(const triangle *t, tl_nav_spot center, double radius)
{
    const tl_nav_spot ring[4] = { t->a, t->c, t->b, t->a };
    for (int i = 0; i < 3; i++) {
        double turn = t->hand * tl_nav_spot_turn(ring[i], ring[i + 1], center);
        if (turn < 0.0 && turn * turn > radius * radius * tl_nav_spot_distance_sq(ring[i], ring[i + 1])) {
            return false;
        }
    }
    return true;
}

static bool gather_caps(tl_nav_clearance *clearance, triangle *t)
{
    t->corners =
        tl_nav_take_scratch(clearance, 2 * (uint64_t)t->near.wall_count * TL_NAV_CIRCLE_CORNERS, sizeof *t->corners);
    if (t->corners == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < 2 * t->near.wall_count; i++) {
        tl_nav_segment wall = tl_nav_segment_of_wall(&t->near.walls[i / 2]);
        tl_nav_spot center = i % 2 == 0 ? wall.a : wall.b;
        for (uint32_t k = 0; k < TL_NAV_CIRCLE_CORNERS && may_hold(t, center, clearance->reach + clearance->slack);
             k++) {
            cap_corner corner = { tl_nav_circle_corner(center, clearance->reach, k), center };
            if (triangle_holds(t, corner.spot) &&
                (!tl_nav_is_same_spot(corner.spot, t->b) || turns_around(t, center))) {
                t->corners[t->count++] = corner;
            }
        }
    }
    return true;
}

// The next corner of the hull behind `at`: the one with all others on its inner side, the farthest of those in line.
static cap_corner next_of_hull(const triangle *t, tl_nav_spot at)
{
    cap_corner best = { t->c, t->c };
    for (uint32_t i = 0; i < t->count; i++) {
        tl_nav_spot spot = t->corners[i].spot;
        double turn = t->hand * tl_nav_spot_turn(at, best.spot, spot);
        bool is_farther = tl_nav_spot_distance_sq(at, spot) > tl_nav_spot_distance_sq(at, best.spot);
        if (!tl_nav_is_same_spot(spot, at) &&
            (turn > 0.0 || (turn == 0.0 && is_farther && !tl_nav_is_same_spot(best.spot, t->c)))) {
            best = t->corners[i];
        }
    }
    return best;
}

// The polygon among those that were met which holds a spot, or misses it by least.
static tl_nav_met home_of(const tl_nav_clearance *clearance, const tl_nav_near_walls *near, tl_nav_spot spot)
{
    tl_nav_met best = near->met[0];
    double best_miss = (double)INFINITY;
    for (uint32_t i = 0; i < near->met_count && best_miss > 0.0; i++) {
        tl_nav_met met = *(near->met - i);
        tl_nav_spot corners[TL_NAV_MAX_CORNERS];
        uint32_t count = tl_nav_corner_spots(clearance->navmesh, met.slot, met.polygon, corners);
        double miss = tl_nav_outside_by(corners, count, spot);
        if (miss < best_miss) {
            best = met;
            best_miss = miss;
        }
    }
    return best;
}

// Whether the hull is free, and shorter than the way over the vertex or without any.
static bool hull_is_better(const triangle *t, double least)
{
    double sum = 0.0;
    tl_nav_spot at = t->a;
    for (uint32_t i = 0; i <= t->count && !tl_nav_is_same_spot(at, t->c); i++) {
        tl_nav_spot next = next_of_hull(t, at).spot;
        sum += length(at, next);
        if (!tl_nav_is_clear(&t->near, at, next, least)) {
            return false;
        }
        at = next;
    }
    bool is_straight = tl_nav_is_same_spot(next_of_hull(t, t->a).spot, t->c);
    return tl_nav_is_same_spot(at, t->c) &&
           (is_straight || sum < (length(t->a, t->b) + length(t->b, t->c)) * (1.0 - MIN_GAIN));
}

// Takes a vertex out of the list; its memory stays unused.
static void drop_vertex(tl_nav_polyline *path, uint32_t vertex)
{
    const tl_nav_polyline_vertex *b = &path->vertices[vertex];
    path->vertices[b->before].is_taut = false;
    path->vertices[b->next].is_taut = false;
    path->vertices[b->before].next = b->next;
    path->vertices[b->next].before = b->before;
}

// Puts the hull in the place of a vertex, whose own memory serves its first corner.
static bool put_hull(const tl_nav_clearance *clearance, const triangle *t, tl_nav_polyline *path, uint32_t vertex)
{
    uint32_t behind = path->vertices[vertex].before;
    bool is_used = false;
    path->vertices[behind].is_taut = false;
    path->vertices[path->vertices[vertex].next].is_taut = false;
    for (cap_corner at = next_of_hull(t, t->a); !tl_nav_is_same_spot(at.spot, t->c); at = next_of_hull(t, at.spot)) {
        tl_nav_met home = home_of(clearance, &t->near, at.spot);
        if (is_used) {
            behind = tl_nav_polyline_insert(path, behind, at.spot, home.slot, home.polygon);
        } else {
            path->vertices[vertex].spot = at.spot;
            path->vertices[vertex].slot = home.slot;
            path->vertices[vertex].polygon = home.polygon;
            is_used = true;
            behind = vertex;
        }
        if (behind == TL_NAV_NO_NODE) {
            return false;
        }
        path->vertices[behind].is_cap = true;
        path->vertices[behind].is_taut = false;
        path->vertices[behind].center = at.center;
    }
    if (!is_used) {
        drop_vertex(path, vertex);
    }
    return true;
}

// Empties the triangle over a vertex. `*moved_out` is set when that has changed the path.
static bool pull_vertex(tl_nav_clearance *clearance, tl_nav_polyline *path, uint32_t vertex, bool *moved_out)
{
    const tl_nav_polyline_vertex *b = &path->vertices[vertex];
    triangle t;
    memset(&t, 0, sizeof t);
    t.a = path->vertices[b->before].spot;
    t.b = b->spot;
    t.c = path->vertices[b->next].spot;
    if (tl_nav_is_same_spot(t.a, t.b) || tl_nav_is_same_spot(t.b, t.c)) {
        drop_vertex(path, vertex);
        *moved_out = true;
        return true;
    }
    double turn = tl_nav_spot_turn(t.a, t.c, t.b);
    t.hand = turn < 0.0 ? -1.0 : 1.0;
    if (b->is_taut || (b->is_cap && turns_around(&t, b->center))) {
        return true;
    }
    path->vertices[vertex].is_taut = true;
    tl_nav_scratch scratch = clearance->scratch;
    tl_nav_spot shape[3] = { t.a, t.b, t.c };
    bool fits = tl_nav_find_kept_walls_near_shape(clearance, b->slot, b->polygon, shape, 3, &t.near) &&
                gather_caps(clearance, &t);
    if (fits && hull_is_better(&t, clearance->least)) {
        *moved_out = true;
        fits = put_hull(clearance, &t, path, vertex);
    }
    clearance->scratch = scratch;
    clearance->is_full = clearance->is_full || !fits;
    return fits;
}

bool tl_nav_wide_pull_taut(tl_nav_clearance *clearance, tl_nav_polyline *path)
{
    bool moved = true;
    for (uint32_t sweep = 0; sweep < MAX_SWEEPS && moved; sweep++) {
        moved = false;
        // Odd sweeps begin one vertex later.
        uint32_t at = path->vertices[0].next;
        for (bool takes = true; at != path->last; takes = !takes) {
            uint32_t next = path->vertices[at].next;
            bool moves = false;
            if ((takes || sweep % 2 == 1) && !pull_vertex(clearance, path, at, &moves)) {
                return false;
            }
            moved = moved || moves || (!takes && sweep % 2 == 0);
            at = next;
        }
    }
    return true;
}
