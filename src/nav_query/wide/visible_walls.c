// SPDX-License-Identifier: MIT
//
// The walls visible from a convex shape in straight lines over the surface.
//
// Only a wall that a straight line from some spot of the shape reaches within the distance counts: a floor above,
// below, or behind another wall does not. So from each polygon that the shape touches beams go out through its open
// edges, each as wide as the lines that cross all edges on its way may be. Straight lines never turn back, so no beam
// comes back above the floor that it came from by a stair beside it, as a plain search over all polygons near the shape
// does. A beam is bounded by the outermost directions and by lines through the ends of its last edge: a little more
// than what is visible, never less. So no wall is missed; and an additional one, hidden behind another, forbids nothing
// that the other does not.
//
// Each wall is kept with the distance that a search must cover to find it, and the list is sorted by that: so the walls
// within a shorter distance are its first ones, the very same list that a search of that distance makes
// (prepared_walls.c relies on this).

#include "nav_query/wide/walls_near_shape.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/search/local_search.h"

#include <string.h>

// The chord between two neighbours of 32 points on a circle comes this near to its middle: cos(pi / 32).
static const double CHORD_SHARE = 0.99518472667219688;

double tl_nav_touch_of(const tl_navmesh *navmesh)
{
    int exponent = 0;
    frexp((double)navmesh->extent, &exponent);
    double touch = TL_NAV_PLACE_ROUNDINGS * (double)TL_FLOAT_ROUNDING * ldexp(1.0, exponent);
    return touch * touch;
}

void tl_nav_clearance_begin(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter, double reach,
                            tl_nav_clearance *clearance_out)
{
    static const tl_nav_filter any = { UINT64_MAX, 0, { 0 }, NULL, NULL, NULL, 0.0f, TL_DEF_COOKIE };
    memset(clearance_out, 0, sizeof *clearance_out);
    clearance_out->query = query;
    clearance_out->navmesh = navmesh;
    clearance_out->filter = tl_nav_all_pass(navmesh, filter) ? NULL : filter != NULL ? filter : &any;
    clearance_out->slack = TL_NAV_PLACE_ROUNDINGS * (double)TL_FLOAT_ROUNDING * ((double)navmesh->extent + reach);
    clearance_out->touch = tl_nav_touch_of(navmesh);
    clearance_out->reach = tl_max_f64(0.0, reach - clearance_out->slack);
    clearance_out->least = tl_max_f64(0.0, CHORD_SHARE * clearance_out->reach - clearance_out->slack);
    clearance_out->scratch.low = query->wide_memory;
    clearance_out->scratch.high = clearance_out->scratch.low + query->item_bytes;
}

void *tl_nav_take_scratch(tl_nav_clearance *clearance, uint64_t count, uint64_t size)
{
    uint64_t left = (uint64_t)(clearance->scratch.high - clearance->scratch.low);
    uint64_t bytes = (count * size + 7) / 8 * 8;
    if (bytes > left) {
        clearance->is_full = true;
        return NULL;
    }
    void *at = clearance->scratch.low;
    clearance->scratch.low += bytes;
    return at;
}

uint32_t tl_nav_corner_spots(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon,
                             tl_nav_spot corners[TL_NAV_MAX_CORNERS])
{
    uint32_t count = 0;
    const tl_vec3 *from = tl_nav_tile_corners(navmesh->slots[slot].tile, polygon, &count);
    for (uint32_t i = 0; i < count; i++) {
        corners[i] = tl_nav_spot_make((double)from[i].x, (double)from[i].z);
    }
    return count;
}

double tl_nav_outside_by(const tl_nav_spot *corners, uint32_t count, tl_nav_spot spot)
{
    double most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_spot p = corners[i];
        tl_nav_spot q = corners[i + 1 < count ? i + 1 : 0];
        most = tl_max_f64(tl_nav_spot_turn(p, q, spot) / sqrt(tl_nav_spot_distance_sq(p, q)), most);
    }
    return most;
}

bool tl_nav_is_clear(const tl_nav_near_walls *near, tl_nav_spot a, tl_nav_spot b, double distance)
{
    const tl_nav_spot ends[2] = { a, b };
    tl_nav_segment segment = { a, b };
    tl_nav_shape reach = tl_nav_shape_make(ends, 2, distance, distance * (double)TL_FLOAT_ROUNDING);
    for (uint32_t i = 0; i < near->wall_count; i++) {
        tl_nav_segment wall = tl_nav_segment_of_wall(&near->walls[i]);
        if (!tl_nav_shape_is_far(&reach, wall) && tl_nav_segments_distance_sq(segment, wall) < reach.distance_sq) {
            return false;
        }
    }
    return true;
}

// Beams that one look follows: as many as the query has nodes, and these. Of the levels that the tests know none takes
// more than 2,000, over a hundred metres of terrain. Among many small polygons that lie over one another, as only bytes
// from strangers have them, beams part and meet again for millions.
enum { SPARE_BEAMS = 1 << 14 };

// What is seen of the surface from a shape through a window: an edge, or the part of it that earlier ones let see.
typedef struct beam {
    tl_nav_met from, at;                 // polygons before and behind the window
    tl_nav_spot left, right;             // its ends, seen looking out
    tl_nav_spot left_ahead, right_ahead; // the outermost directions
    float distance_sq;                   // of the farthest window on the way, this one included
} beam;

// Where a walk over beams keeps what it has found. Walls grow upwards in the scratch memory, open beams downwards.
typedef struct wall_walk {
    tl_nav_clearance *clearance;
    tl_nav_shape *reach;
    double distance; // of `reach`, metres
    tl_nav_near_wall *walls;
    uint32_t count;
    beam *top; // of the beams that wait
    bool is_covered;
} wall_walk;

static double pass_window(tl_nav_spot a, tl_nav_spot b)
{
    return a.x * b.z - a.z * b.x;
}

static tl_nav_spot minus(tl_nav_spot a, tl_nav_spot b)
{
    return tl_nav_spot_make(a.x - b.x, a.z - b.z);
}

// The outermost direction from the shape through an end of a window, on the end's side; `along` leads along the window
// to that end. `hand` is 1 for the left end, -1 for the right one.
static tl_nav_spot outermost(const tl_nav_shape *reach, tl_nav_spot end, tl_nav_spot along, double hand)
{
    // Of each ray, how far it leads along the window and out of it. Of two the first is the outer one when
    // along / out is larger.
    tl_nav_spot best = along;
    double best_along = 0.0;
    double best_out = 0.0;
    bool is_known = false;
    for (uint32_t i = 0; i < reach->count; i++) {
        tl_nav_spot ray = minus(end, reach->corners[i]);
        tl_nav_spot next = minus(end, reach->corners[i + 1 < reach->count ? i + 1 : 0]);
        double ray_along = ray.x * along.x + ray.z * along.z;
        double ray_out = hand * pass_window(along, ray);
        double next_along = next.x * along.x + next.z * along.z;
        double next_out = hand * pass_window(along, next);
        // Where the shape crosses the window's line, it sees the window edge-on: from behind its other end, or not.
        bool crosses = (ray_out < 0.0 && next_out > 0.0) || (ray_out > 0.0 && next_out < 0.0);
        if (crosses && ray_along * fabs(next_out) + next_along * fabs(ray_out) > 0.0) {
            return along;
        }
        if (ray_out >= 0.0 && (!is_known || ray_along * best_out > best_along * ray_out)) {
            best_along = ray_along;
            best_out = ray_out;
            best = ray;
            is_known = true;
        }
    }
    return best;
}

// Of the directions of a beam and of the one before, those of both. `along` leads along the window to its left end.
// False: there are none.
static bool narrow_beam(beam *next, const beam *before, tl_nav_spot along)
{
    double left_out = pass_window(along, before->left_ahead);
    double right_out = pass_window(along, before->right_ahead);
    // A beam as wide as a half plane passes another window in line or parallel, if that leads on and not back.
    bool leads_on = pass_window(before->left_ahead, before->right_ahead) == 0.0 &&
                    along.x * before->left_ahead.x + along.z * before->left_ahead.z > 0.0;
    if (left_out <= 0.0 && right_out <= 0.0 && !leads_on) {
        return false;
    }
    // A side that does not leave through the window bounds nothing.
    if (left_out > 0.0 && pass_window(next->left_ahead, before->left_ahead) > 0.0) {
        next->left_ahead = before->left_ahead;
    }
    if (right_out > 0.0 && pass_window(next->right_ahead, before->right_ahead) < 0.0) {
        next->right_ahead = before->right_ahead;
    }
    double width = pass_window(next->left_ahead, next->right_ahead);
    double ahead = next->left_ahead.x * next->right_ahead.x + next->left_ahead.z * next->right_ahead.z;
    return width > 0.0 || (width == 0.0 && ahead < 0.0);
}

// Adds the beam behind a window. `before` is the beam that sees it, NULL from the polygon of the shape itself.
static bool add_beam(wall_walk *walk, const beam *before, beam next)
{
    tl_nav_spot along = minus(next.left, next.right);
    next.left_ahead = along;
    next.right_ahead = tl_nav_spot_make(-along.x, -along.z);
    if ((double)next.distance_sq > walk->clearance->touch) {
        next.left_ahead = outermost(walk->reach, next.left, next.left_ahead, 1.0);
        next.right_ahead = outermost(walk->reach, next.right, next.right_ahead, -1.0);
    }
    if (before != NULL && !narrow_beam(&next, before, along)) {
        return true;
    }
    if ((char *)(walk->top - 1) < (char *)(walk->walls + walk->count)) {
        return false;
    }
    *--walk->top = next;
    return true;
}

// Agents that keep a distance from a wall at which it forbids all of the shape, and see it, need no others: nothing
// farther counts. `distance_sq` is how far they must look to see it.
static void end_reach_at_cover(wall_walk *walk, tl_nav_segment wall, float distance_sq)
{
    const tl_nav_shape *reach = walk->reach;
    double farthest_sq = 0.0;
    for (uint32_t i = 0; i < reach->count; i++) {
        tl_nav_spot nearest;
        farthest_sq = tl_max_f64(tl_nav_nearest_of_segment(wall, reach->corners[i], &nearest), farthest_sq);
    }
    // What is forbidden lies within CHORD_SHARE of the distance, less what rounding may do to places.
    const double slack = 4.0 * walk->clearance->slack;
    const double covers_from = (sqrt(farthest_sq) + slack) / CHORD_SHARE + slack;
    const double distance =
        (double)(float)(tl_max_f64(sqrt((double)distance_sq), covers_from) * (1.0 + 0x1p-20)); // kept as a float
    if (distance < walk->distance) {
        walk->distance = distance;
        *walk->reach = tl_nav_shape_make(reach->corners, reach->count, distance, walk->clearance->slack);
    }
}

// A wall is known by its place in its tile's rings. Each is taken once, at the least distance by which a beam sees it.
static bool add_wall(wall_walk *walk, uint32_t slot, uint32_t place, tl_nav_segment wall, bool is_end,
                     float distance_sq)
{
    bool found = false;
    if (walk->count == walk->clearance->query->max_nodes ||
        (char *)(walk->walls + walk->count + 1) > (char *)walk->top) {
        return false;
    }
    tl_nav_root *known =
        tl_nav_find_root(walk->clearance->query, (uint64_t)is_end << 62 | (uint64_t)slot << 32 | place, &found);
    if (known == NULL) {
        return false;
    }
    if (!found) {
        walk->is_covered = walk->is_covered ||
                           tl_nav_wall_covers(wall, walk->reach->corners, walk->reach->count, walk->clearance->cover);
        tl_nav_near_wall fresh = { distance_sq, (float)wall.a.x, (float)wall.a.z, (float)wall.b.x, (float)wall.b.z };
        if (walk->clearance->is_enough) {
            end_reach_at_cover(walk, wall, distance_sq);
        }
        known->stop = walk->count;
        walk->walls[walk->count++] = fresh;
    } else if (distance_sq < walk->walls[known->stop].distance_sq) {
        walk->walls[known->stop].distance_sq = distance_sq;
    }
    return true;
}

// Cuts a segment to what lies between the two sides of a beam. False: nothing does.
static bool cut_to_beam(const beam *b, tl_nav_segment *segment)
{
    double first = 0.0;
    double last = 1.0;
    const tl_nav_spot ends[2] = { b->left, b->right };
    const tl_nav_spot aheads[2] = { b->left_ahead, b->right_ahead };
    for (int side = 0; side < 2; side++) {
        double hand = side == 0 ? 1.0 : -1.0;
        double from = hand * pass_window(aheads[side], minus(segment->a, ends[side]));
        double to = hand * pass_window(aheads[side], minus(segment->b, ends[side]));
        if (from < 0.0 && to < 0.0) {
            return false;
        }
        if (from < 0.0) {
            first = tl_max_f64(from / (from - to), first);
        } else if (to < 0.0) {
            last = tl_min_f64(from / (from - to), last);
        }
    }
    tl_nav_segment whole = *segment;
    segment->a = first > 0.0 ? tl_nav_spot_lerp(whole.a, whole.b, first) : whole.a;
    segment->b = last < 1.0 ? tl_nav_spot_lerp(whole.a, whole.b, last) : whole.b;
    return first < last;
}

static bool is_in_beam(const beam *b, tl_nav_spot spot)
{
    return pass_window(b->left_ahead, minus(spot, b->left)) >= 0.0 &&
           pass_window(b->right_ahead, minus(spot, b->right)) <= 0.0;
}

// Around most ends of walls less than a full turn is free, and one of the two walls there is seen whenever the end is.
// Not so where a stair winds around it: its end is a wall by itself.
static bool add_winding_end(wall_walk *walk, const tl_nav_ring_place *place, const beam *seen)
{
    const tl_nav_clearance *clearance = walk->clearance;
    const tl_nav_rings *rings = &clearance->navmesh->slots[place->slot].rings;
    const tl_nav_ring ring = tl_nav_ring_of(rings, place->polygon);
    const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, place->edge);
    const tl_nav_ring_walls *walls = tl_nav_walls_of(rings, edge);
    tl_nav_spot spot = tl_nav_spot_of(ring.points[place->edge]);
    tl_nav_segment end = { spot, spot };
    tl_nav_ring_place fan = *place;
    if (tl_nav_turn_of(rings, edge) == 0 || walls->first_x != 0.0f || walls->first_z != 0.0f ||
        (seen != NULL && !is_in_beam(seen, spot))) {
        return true;
    }
    float distance_sq = (float)tl_nav_shape_distance_sq(walk->reach, end);
    if (!((double)distance_sq < walk->reach->distance_sq) ||
        !tl_nav_find_fan(clearance->navmesh, clearance->filter, &fan)) {
        return true;
    }
    distance_sq = tl_maxf(distance_sq, seen != NULL ? seen->distance_sq : 0.0f);
    return add_wall(walk, place->slot, ring.first + place->edge, end, true, distance_sq);
}

// Looks at the edges of a polygon: of the one behind a beam, or, without one, of one that the shape touches.
static bool cast_beams(wall_walk *walk, tl_nav_met at, const beam *seen)
{
    const tl_nav_clearance *clearance = walk->clearance;
    const tl_nav_ring ring = tl_nav_ring_at(clearance->navmesh, at.slot, at.polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        tl_nav_segment edge = { tl_nav_spot_of(ring.points[i]), tl_nav_spot_of(*end) };
        tl_nav_segment window = edge;
        tl_nav_ring_place place = { at.slot, at.polygon, i };
        if (!add_winding_end(walk, &place, seen)) {
            return false;
        }
        if (tl_nav_ring_to(&ring, i) == TL_NAV_RING_BACK || (seen != NULL && !cut_to_beam(seen, &window))) {
            continue;
        }
        // As floats, so that it means the same when it is kept.
        float distance_sq = (float)tl_nav_shape_distance_sq(walk->reach, window);
        if (!((double)distance_sq < walk->reach->distance_sq)) {
            continue;
        }
        distance_sq = tl_maxf(distance_sq, seen != NULL ? seen->distance_sq : 0.0f);
        bool is_open = tl_nav_ring_is_open(tl_nav_ring_to(&ring, i));
        beam next = { at, { 0, 0 }, window.b, window.a, { 0.0, 0.0 }, { 0.0, 0.0 }, distance_sq };
        if (is_open) {
            tl_nav_ring_seam to = tl_nav_ring_across(clearance->navmesh, at.slot, tl_nav_ring_to(&ring, i));
            next.at.slot = to.slot;
            next.at.polygon = to.polygon;
            is_open = clearance->filter == NULL ||
                      tl_nav_passes(clearance->filter, clearance->navmesh->slots[to.slot].tile, to.polygon);
        }
        // Two polygons share one line: what lies across it again is the window by which the beam came in.
        bool is_back =
            seen != NULL && is_open && next.at.slot == seen->from.slot && next.at.polygon == seen->from.polygon;
        if (!is_back && !(is_open ? add_beam(walk, seen, next)
                                  : add_wall(walk, at.slot, ring.first + i, edge, false, distance_sq))) {
            return false;
        }
    }
    return true;
}

bool tl_nav_add_visible_walls(tl_nav_clearance *clearance, tl_nav_met at, const tl_nav_spot *shape, uint32_t count,
                              double distance, tl_nav_near_walls *near)
{
    tl_nav_shape reach = tl_nav_shape_make(shape, count, distance, clearance->slack);
    beam *bottom = (beam *)(void *)clearance->scratch.high;
    wall_walk walk = { clearance,        &reach, distance, (tl_nav_near_wall *)(void *)clearance->scratch.low,
                       near->wall_count, bottom, false };
    uint32_t beams_left = clearance->query->max_nodes + SPARE_BEAMS;
    bool fits = cast_beams(&walk, at, NULL);
    while (fits && !walk.is_covered && walk.top < bottom && beams_left > 0) {
        const beam next = *walk.top++;
        fits = !((double)next.distance_sq < reach.distance_sq) || cast_beams(&walk, next.at, &next);
        beams_left--;
    }
    if (fits && !walk.is_covered && walk.top < bottom) {
        clearance->is_out_of_beams = true;
        fits = false;
    }
    near->wall_count = walk.count;
    near->within = walk.distance;
    near->is_covered = near->is_covered || walk.is_covered;
    clearance->is_full = clearance->is_full || !fits;
    return fits;
}

void tl_nav_begin_walls(tl_nav_clearance *clearance, tl_nav_near_walls *near)
{
    memset(near, 0, sizeof *near);
    near->walls = (tl_nav_near_wall *)(void *)clearance->scratch.low;
    near->met = (tl_nav_met *)(void *)clearance->scratch.high - 1;
    tl_nav_next_generation(clearance->query);
}

static bool is_wall_before(const tl_nav_near_wall *a, const tl_nav_near_wall *b)
{
    const float keys[2][5] = { { a->distance_sq, a->a_x, a->a_z, a->b_x, a->b_z },
                               { b->distance_sq, b->a_x, b->a_z, b->b_x, b->b_z } };
    for (int i = 0; i < 5; i++) {
        if (keys[0][i] != keys[1][i]) {
            return keys[0][i] < keys[1][i];
        }
    }
    return false;
}

void tl_nav_end_walls(tl_nav_clearance *clearance, const tl_nav_near_walls *near)
{
    // Shell's sort: a polygon has a dozen walls around it, a wide shape a few hundred. Equal walls are the same bytes.
    tl_nav_near_wall *walls = (tl_nav_near_wall *)(void *)clearance->scratch.low;
    static const uint32_t GAPS[] = { 701, 301, 132, 57, 23, 10, 4, 1 };
    for (uint32_t g = 0; g < TL_COUNT_OF(GAPS); g++) {
        uint32_t gap = GAPS[g];
        for (uint32_t i = gap; i < near->wall_count; i++) {
            const tl_nav_near_wall wall = walls[i];
            uint32_t at = i;
            for (; at >= gap && is_wall_before(&wall, &walls[at - gap]); at -= gap) {
                walls[at] = walls[at - gap];
            }
            walls[at] = wall;
        }
    }
    tl_nav_take_scratch(clearance, near->wall_count, sizeof *walls);
}

bool tl_nav_find_visible_walls(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, const tl_nav_spot *corners,
                               uint32_t count, double distance, tl_nav_near_walls *near_out)
{
    tl_nav_met at = { slot, polygon };
    tl_nav_begin_walls(clearance, near_out);
    bool fits = tl_nav_add_visible_walls(clearance, at, corners, count, distance, near_out);
    tl_nav_end_walls(clearance, near_out);
    return fits;
}

uint32_t tl_nav_count_within(const tl_nav_near_wall *walls, uint32_t count, double distance)
{
    uint32_t low = 0;
    while (low < count) {
        uint32_t middle = low + (count - low) / 2;
        if ((double)walls[middle].distance_sq < distance * distance) {
            low = middle + 1;
        } else {
            count = middle;
        }
    }
    return low;
}
