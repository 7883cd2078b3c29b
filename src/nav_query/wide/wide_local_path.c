// SPDX-License-Identifier: MIT
//
// The shortest free path between two places of one polygon: straight, or over corners of caps.
//
// A cap is the polygon of 32 corners inscribed in the circle around a wall's end; the convex hull of a wall's two caps
// approximates what the wall forbids (its Minkowski sum with the disc). The hull contains all that is nearer to the
// wall than 0.995 of the reach and lies within the reach: so where there is a free way at the reach there is one around
// the hulls, it turns at corners of caps only, and it keeps 0.995 of the reach from every wall.
//
// Few walls are in the way, and mostly by one end alone. So the shortest way is found around no obstacles first, by A*
// over the corners of caps in the polygon, then around those ends and walls that it has met, until it meets no other.
// Around fewer obstacles no way is longer: the one that is free of all is the shortest around all of them.

#include "nav_query/wide/wall_cell.h"
#include "nav_query/wide/wide_search.h"

#include "nav_query/plane/circle_corners.h"

#include <string.h>

// A place where a way may turn.
typedef struct detour_stop {
    tl_nav_spot spot, center;
    double cost, total; // metres from the first stop, and with those that are left at least
    uint32_t before;
    bool is_closed, is_dead; // dead: a wall that was met later forbids it
} detour_stop;

// The line of a side of the polygon: unit, outward.
typedef struct side_line {
    double x, z, offset;
} side_line;

// A wall in the way, or an end of one: then a and b are the same.
typedef struct obstacle {
    tl_nav_segment wall;
    bool is_end;
} obstacle;

typedef struct detour {
    tl_nav_clearance *clearance;
    const tl_nav_wall_cell *cell;
    side_line sides[TL_NAV_MAX_CORNERS];
    obstacle *met; // [3 * cell->near.wall_count]: each wall and its ends
    uint32_t met_count;
    detour_stop *stops; // [0] and [1]: the ends
    uint32_t count;
} detour;

static void set_side_lines(detour *d)
{
    for (uint32_t i = 0; i < d->cell->count; i++) {
        tl_nav_spot p = d->cell->corners[i];
        tl_nav_spot q = d->cell->corners[i + 1 < d->cell->count ? i + 1 : 0];
        double length = sqrt(tl_nav_spot_distance_sq(p, q));
        side_line side = { -(q.z - p.z) / length, (q.x - p.x) / length, 0.0 };
        side.offset = side.x * p.x + side.z * p.z;
        d->sides[i] = side;
    }
}

static bool is_in_polygon(const detour *d, tl_nav_spot spot)
{
    for (uint32_t i = 0; i < d->cell->count; i++) {
        if (d->sides[i].x * spot.x + d->sides[i].z * spot.z - d->sides[i].offset > d->clearance->slack) {
            return false;
        }
    }
    return true;
}

static bool is_met_end(const detour *d, tl_nav_spot end)
{
    for (uint32_t i = 0; i < d->met_count; i++) {
        tl_nav_segment other = d->met[i].wall;
        if ((other.a.x == end.x && other.a.z == end.z) || (other.b.x == end.x && other.b.z == end.z)) {
            return true;
        }
    }
    return false;
}

static bool add_stop(detour *d, tl_nav_spot spot, tl_nav_spot center)
{
    // Stops are contiguous in the scratch memory, as nothing else is taken meanwhile.
    detour_stop *fresh = tl_nav_take_scratch(d->clearance, 1, sizeof *fresh);
    if (fresh == NULL) {
        return false;
    }
    memset(fresh, 0, sizeof *fresh);
    fresh->spot = spot;
    fresh->center = center;
    d->count++;
    return true;
}

static bool is_free_of_met(const detour *d, tl_nav_spot a, tl_nav_spot b)
{
    const tl_nav_segment leg = { a, b };
    for (uint32_t i = 0; i < d->met_count; i++) {
        tl_nav_spot nearest;
        double distance_sq = d->met[i].is_end ? tl_nav_nearest_of_segment(leg, d->met[i].wall.a, &nearest)
                                              : tl_nav_segments_distance_sq(leg, d->met[i].wall);
        if (distance_sq < d->clearance->least * d->clearance->least) {
            return false;
        }
    }
    return true;
}

// Adds an obstacle with the corners of its caps that are free and in the polygon. False: out of scratch memory.
static bool add_obstacle(detour *d, const obstacle *met)
{
    const tl_nav_spot ends[2] = { met->wall.a, met->wall.b };
    const bool is_known[2] = { is_met_end(d, ends[0]), met->is_end || is_met_end(d, ends[1]) };
    d->met[d->met_count++] = *met;
    for (uint32_t i = 2; i < d->count; i++) {
        d->stops[i].is_dead = d->stops[i].is_dead || !is_free_of_met(d, d->stops[i].spot, d->stops[i].spot);
    }
    for (int e = 0; e < 2; e++) {
        for (uint32_t k = 0; k < TL_NAV_CIRCLE_CORNERS && !is_known[e]; k++) {
            tl_nav_spot spot = tl_nav_circle_corner(ends[e], d->clearance->reach, k);
            if (is_in_polygon(d, spot) && is_free_of_met(d, spot, spot) && !add_stop(d, spot, ends[e])) {
                return false;
            }
        }
    }
    return true;
}

static uint32_t cheapest_stop(const detour *d)
{
    uint32_t best = UINT32_MAX;
    double total = (double)INFINITY;
    for (uint32_t i = 0; i < d->count; i++) {
        if (!d->stops[i].is_closed && d->stops[i].total < total) {
            best = i;
            total = d->stops[i].total;
        }
    }
    return best;
}

// A* from stop 0 to stop 1 around the walls that were met. False: there is no way, which rounding alone can do.
static bool connect_stops(detour *d)
{
    for (uint32_t i = 0; i < d->count; i++) {
        d->stops[i].is_closed = d->stops[i].is_dead;
        d->stops[i].cost = d->stops[i].total = i == 0 ? 0.0 : (double)INFINITY;
    }
    for (uint32_t i = cheapest_stop(d); i != UINT32_MAX; i = cheapest_stop(d)) {
        detour_stop *from = &d->stops[i];
        from->is_closed = true;
        if (i == 1) {
            return true;
        }
        for (uint32_t k = 1; k < d->count; k++) {
            detour_stop *to = &d->stops[k];
            double cost = from->cost + sqrt(tl_nav_spot_distance_sq(from->spot, to->spot));
            if (!to->is_closed && cost < to->cost && is_free_of_met(d, from->spot, to->spot)) {
                to->cost = cost;
                to->total = cost + sqrt(tl_nav_spot_distance_sq(to->spot, d->stops[1].spot));
                to->before = i;
            }
        }
    }
    return false;
}

// What a leg comes too near to of a wall: the end that is nearest to it, or all of it where that is no end. False:
// nothing.
static bool is_in_the_way(tl_nav_segment leg, tl_nav_segment wall, double least, obstacle *out)
{
    tl_nav_spot nearest;
    double distance_sq = tl_nav_segments_distance_sq(leg, wall);
    if (!(distance_sq < least * least)) {
        return false;
    }
    obstacle met = { wall, true };
    if (tl_nav_nearest_of_segment(leg, wall.a, &nearest) == distance_sq) {
        met.wall.b = wall.a;
    } else if (tl_nav_nearest_of_segment(leg, wall.b, &nearest) == distance_sq) {
        met.wall.a = wall.b;
    } else {
        met.is_end = false;
    }
    *out = met;
    return true;
}

// What the way found comes too near to. False: nothing.
static bool find_obstacle(const detour *d, obstacle *out)
{
    for (uint32_t i = 1; i != 0; i = d->stops[i].before) {
        tl_nav_segment leg = { d->stops[d->stops[i].before].spot, d->stops[i].spot };
        for (uint32_t w = 0; w < d->cell->near.wall_count; w++) {
            if (is_in_the_way(leg, tl_nav_segment_of_wall(&d->cell->near.walls[w]), d->clearance->least, out)) {
                return true;
            }
        }
    }
    return false;
}

static bool is_met(const detour *d, const obstacle *o)
{
    for (uint32_t i = 0; i < d->met_count; i++) {
        tl_nav_segment met = d->met[i].wall;
        if (met.a.x == o->wall.a.x && met.a.z == o->wall.a.z && met.b.x == o->wall.b.x && met.b.z == o->wall.b.z) {
            return true;
        }
    }
    return false;
}

// Finds the way; `*found_out`: whether there is one. False: out of scratch memory.
static bool find_way(detour *d, bool *found_out)
{
    for (;;) {
        *found_out = connect_stops(d);
        obstacle next;
        bool is_blocked = *found_out && find_obstacle(d, &next);
        // There is no way around what is too near to an end by a rounding.
        *found_out = *found_out && !(is_blocked && is_met(d, &next));
        if (!is_blocked || !*found_out) {
            return true;
        }
        if (!add_obstacle(d, &next)) {
            return false;
        }
    }
}

bool tl_nav_wide_local_path(tl_nav_clearance *clearance, tl_nav_polyline *path, uint32_t behind)
{
    const tl_nav_polyline_vertex from = path->vertices[behind];
    const tl_nav_polyline_vertex to = path->vertices[from.next];
    tl_nav_scratch scratch = clearance->scratch;
    tl_nav_wall_cell cell;
    if (!tl_nav_wall_cell_of(clearance, from.slot, from.polygon, clearance->reach, &cell)) {
        return false;
    }
    if (tl_nav_is_clear(&cell.near, from.spot, to.spot, clearance->least)) {
        clearance->scratch = scratch;
        return true;
    }
    detour d;
    memset(&d, 0, sizeof d);
    d.clearance = clearance;
    d.cell = &cell;
    set_side_lines(&d);
    d.met = tl_nav_take_scratch(clearance, 3 * (uint64_t)cell.near.wall_count, sizeof *d.met);
    d.stops = (detour_stop *)(void *)clearance->scratch.low;
    bool is_found = false;
    bool fits = d.met != NULL && add_stop(&d, from.spot, from.spot) && add_stop(&d, to.spot, to.spot) &&
                find_way(&d, &is_found);
    for (uint32_t i = is_found ? d.stops[1].before : 0; i != 0 && fits; i = d.stops[i].before) {
        uint32_t vertex = tl_nav_polyline_insert(path, behind, d.stops[i].spot, from.slot, from.polygon);
        fits = vertex != TL_NAV_NO_NODE;
        if (fits) {
            path->vertices[vertex].is_cap = true;
            path->vertices[vertex].center = d.stops[i].center;
        }
    }
    clearance->scratch = scratch;
    clearance->is_full = clearance->is_full || !fits;
    return fits;
}
