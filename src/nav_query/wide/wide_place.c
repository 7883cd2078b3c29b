// SPDX-License-Identifier: MIT
//
// The nearest place where a wide agent fits: polygons are visited in the order of their distance, and in each of them
// all candidates for the nearest free place.
//
// Those are few. The nearest free place is the place asked for itself, or lies on a free piece of the outline, or on
// the border of what a wall forbids: at the foot of the perpendicular on one of its two sides, at the point of its
// circle nearest to the place, or where it meets the border of another wall. Each of them that is free is a candidate;
// the nearest is taken.

#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/query_memory.h"
#include "nav_query/wide/free_pieces.h"

#include "base/min_max.h"
#include "math/tolerance.h"

#include <talus/nav_wide.h>

#include <string.h>

typedef struct place_search {
    tl_nav_clearance *clearance;
    tl_nav_spot spot;
    double reach; // between the exact one and the one with slack: what is found stands rounding
    // The polygon that is visited.
    uint32_t slot, polygon;
    tl_nav_wall_cell cell;
    // The nearest so far.
    double best_sq;
    tl_nav_spot best;
    uint32_t best_slot, best_polygon;
    bool is_found;
} place_search;

// As a float place it must be free.
static void offer_place(place_search *search, tl_nav_spot exact)
{
    tl_nav_spot spot = { (double)(float)exact.x, (double)(float)exact.z };
    double distance_sq = tl_nav_spot_distance_sq(spot, search->spot);
    if ((distance_sq < search->best_sq || (!search->is_found && distance_sq == search->best_sq)) &&
        tl_nav_outside_by(search->cell.corners, search->cell.count, spot) <= search->clearance->slack &&
        tl_nav_is_clear(&search->cell.near, spot, spot, search->clearance->reach)) {
        search->best_sq = distance_sq;
        search->best = spot;
        search->best_slot = search->slot;
        search->best_polygon = search->polygon;
        search->is_found = true;
    }
}

// A border of what a wall forbids: the circle around an end, or the line along one side.
typedef struct border {
    tl_nav_spot at;    // the circle's middle, or a point of the line
    tl_nav_spot ahead; // along the line, unit; both 0: a circle
} border;

static bool is_circle(const border *b)
{
    return b->ahead.x == 0.0 && b->ahead.z == 0.0;
}

// The borders of a wall; returns their number, 4, or 1 for a wall without length.
static uint32_t borders_of(tl_nav_segment wall, double reach, border out[4])
{
    double x = wall.b.x - wall.a.x;
    double z = wall.b.z - wall.a.z;
    double length = sqrt(x * x + z * z);
    memset(out, 0, 4 * sizeof *out);
    out[0].at = wall.a;
    if (!(length > 0.0)) {
        return 1;
    }
    out[1].at = wall.b;
    for (int side = 0; side < 2; side++) {
        double aside = side == 0 ? reach / length : -reach / length;
        out[2 + side].at = tl_nav_spot_make(wall.a.x + z * aside, wall.a.z - x * aside);
        out[2 + side].ahead = tl_nav_spot_make(x / length, z / length);
    }
    return 4;
}

static void offer_on_line(place_search *search, const border *line, double along)
{
    offer_place(search, tl_nav_spot_make(line->at.x + along * line->ahead.x, line->at.z + along * line->ahead.z));
}

static void offer_nearest(place_search *search, const border *b)
{
    double x = search->spot.x - b->at.x;
    double z = search->spot.z - b->at.z;
    double distance = sqrt(x * x + z * z);
    if (!is_circle(b)) {
        offer_on_line(search, b, x * b->ahead.x + z * b->ahead.z);
    } else if (distance > 0.0) {
        offer_place(search, tl_nav_spot_make(b->at.x + x * (search->reach / distance),
                                             b->at.z + z * (search->reach / distance)));
    } else {
        offer_place(search, tl_nav_spot_make(b->at.x + search->reach, b->at.z));
    }
}

static void offer_crossings(place_search *search, const border *a, const border *b)
{
    if (is_circle(a) && !is_circle(b)) {
        const border *swap = a;
        a = b;
        b = swap;
    }
    double x = b->at.x - a->at.x;
    double z = b->at.z - a->at.z;
    if (!is_circle(b)) {
        double turn = a->ahead.x * b->ahead.z - a->ahead.z * b->ahead.x;
        if (turn != 0.0) {
            offer_on_line(search, a, (x * b->ahead.z - z * b->ahead.x) / turn);
        }
        return;
    }
    // Two circles of one size meet on the line midway, a line and a circle around its foot.
    bool circles = is_circle(a);
    double distance = circles ? sqrt(x * x + z * z) : 1.0;
    double aside = circles ? 0.5 * distance : a->ahead.x * z - a->ahead.z * x;
    double half = search->reach * search->reach - aside * aside;
    if (!(half >= 0.0) || !(distance > 0.0)) {
        return;
    }
    border line = *a;
    double foot = 0.0;
    if (circles) {
        line.at = tl_nav_spot_lerp(a->at, b->at, 0.5);
        line.ahead = tl_nav_spot_make(-z / distance, x / distance);
    } else {
        foot = x * a->ahead.x + z * a->ahead.z;
    }
    offer_on_line(search, &line, foot - sqrt(half));
    offer_on_line(search, &line, foot + sqrt(half));
}

// A circle around the polygon that is visited, so much larger that what rounds stays within.
typedef struct cell_circle {
    tl_nav_spot middle;
    double radius;
} cell_circle;

static cell_circle circle_of_cell(const place_search *search)
{
    const tl_nav_wall_cell *cell = &search->cell;
    cell_circle circle = { cell->corners[0], 0.0 };
    double far_sq = 0.0;
    for (uint32_t i = 1; i < cell->count; i++) {
        far_sq = fmax(far_sq, tl_nav_spot_distance_sq(circle.middle, cell->corners[i]));
    }
    const double size = fabs(circle.middle.x) + fabs(circle.middle.z) + search->reach + sqrt(far_sq);
    circle.radius = sqrt(far_sq) + 2.0 * search->clearance->slack + TL_CULLING_MARGIN * size;
    return circle;
}

// The borders of a wall that come near the cell: no candidate lies on another. Where many small polygons lie close
// together none does, and the walls need not be taken in pairs.
static uint32_t near_borders_of(const place_search *search, uint32_t wall, cell_circle circle, border out[4])
{
    uint32_t near = 0, count = borders_of(tl_nav_segment_of_wall(&search->cell.near.walls[wall]), search->reach, out);
    for (uint32_t i = 0; i < count; i++) {
        const double x = circle.middle.x - out[i].at.x, z = circle.middle.z - out[i].at.z;
        const double off =
            is_circle(&out[i]) ? sqrt(x * x + z * z) - search->reach : out[i].ahead.x * z - out[i].ahead.z * x;
        if (fabs(off) <= circle.radius) {
            out[near++] = out[i];
        }
    }
    return near;
}

// A border that comes near the cell, and its wall.
typedef struct near_border {
    border line;
    uint32_t wall;
} near_border;

// All borders that come near the cell, wall by wall, in scratch memory; each wall is looked at twice, and not with each
// other wall once more. NULL where there are none, or no memory, which the clearance tells.
static near_border *take_near_borders(const place_search *search, uint32_t *count_out)
{
    const cell_circle circle = circle_of_cell(search);
    const uint32_t walls = search->cell.near.wall_count;
    border own[4];
    uint32_t count = 0;
    for (uint32_t i = 0; i < walls; i++) {
        count += near_borders_of(search, i, circle, own);
    }
    near_border *borders = count > 0 ? tl_nav_take_scratch(search->clearance, count, sizeof *borders) : NULL;
    *count_out = borders != NULL ? count : 0;
    for (uint32_t i = 0, at = 0; i < walls && borders != NULL; i++) {
        const uint32_t own_count = near_borders_of(search, i, circle, own);
        for (uint32_t b = 0; b < own_count; b++, at++) {
            borders[at].line = own[b];
            borders[at].wall = i;
        }
    }
    return borders;
}

// Where the borders of one wall end that begin at `begin`.
static uint32_t end_of_wall(const near_border *borders, uint32_t count, uint32_t begin)
{
    uint32_t end = begin;
    while (end < count && borders[end].wall == borders[begin].wall) {
        end++;
    }
    return end;
}

static void offer_borders(place_search *search)
{
    uint32_t count = 0;
    const near_border *borders = take_near_borders(search, &count);
    for (uint32_t begin = 0, end = 0; begin < count; begin = end) {
        end = end_of_wall(borders, count, begin);
        for (uint32_t own = begin; own < end; own++) {
            offer_nearest(search, &borders[own].line);
        }
        for (uint32_t k = 0, k_end = 0; k < begin; k = k_end) {
            k_end = end_of_wall(borders, count, k);
            for (uint32_t own = begin; own < end; own++) {
                for (uint32_t other = k; other < k_end; other++) {
                    offer_crossings(search, &borders[own].line, &borders[other].line);
                }
            }
        }
    }
}

// Of a polygon that not one wall alone forbids.
static bool offer_places(place_search *search)
{
    tl_nav_pieces pieces;
    if (!tl_nav_cut_cell(search->clearance, &search->cell, &pieces)) {
        return false;
    }
    offer_place(search, search->spot);
    for (uint32_t i = 0; i < pieces.count; i++) {
        const tl_nav_piece *piece = &pieces.pieces[i];
        tl_nav_spot p = search->cell.corners[piece->edge];
        tl_nav_spot q = search->cell.corners[piece->edge + 1 < search->cell.count ? piece->edge + 1 : 0];
        tl_nav_segment stretch = { tl_nav_spot_lerp(p, q, piece->from), tl_nav_spot_lerp(p, q, piece->to) };
        tl_nav_spot nearest;
        tl_nav_nearest_of_segment(stretch, search->spot, &nearest);
        offer_place(search, nearest);
    }
    offer_borders(search);
    return !search->clearance->is_full;
}

// All places of the polygon that may be the nearest. False: out of scratch memory.
static bool visit_polygon(place_search *search)
{
    tl_nav_clearance *clearance = search->clearance;
    tl_nav_scratch scratch = clearance->scratch;
    bool fits = tl_nav_wall_cell_of(clearance, search->slot, search->polygon, search->reach, &search->cell);
    fits = fits && (search->cell.near.is_covered || offer_places(search));
    clearance->scratch = scratch;
    return fits;
}

static void relax_polygon(place_search *search, uint32_t slot, uint32_t polygon, double distance_sq)
{
    tl_nav_query *query = search->clearance->query;
    uint32_t index = tl_nav_pool_get(query, (uint64_t)slot << 32 | polygon);
    if (index == TL_NAV_NO_NODE) {
        search->clearance->is_full = true;
        return;
    }
    tl_nav_node *node = &query->nodes[index];
    if (node->heap_at == TL_NAV_NODE_NEW || (node->heap_at != TL_NAV_NODE_CLOSED && (float)distance_sq < node->total)) {
        node->slot = slot;
        node->polygon = polygon;
        node->total = (float)distance_sq;
        tl_nav_heap_improve(query, index);
    }
}

static void visit_neighbours(place_search *search)
{
    const tl_nav_clearance *clearance = search->clearance;
    const tl_nav_ring ring = tl_nav_ring_at(clearance->navmesh, search->slot, search->polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            continue;
        }
        tl_nav_ring_seam to = tl_nav_ring_across(clearance->navmesh, search->slot, tl_nav_ring_to(&ring, i));
        tl_nav_segment edge = { tl_nav_spot_of(ring.points[i]), tl_nav_spot_of(*end) };
        tl_nav_spot nearest;
        double distance_sq = tl_nav_nearest_of_segment(edge, search->spot, &nearest);
        bool passes = clearance->filter == NULL ||
                      tl_nav_passes(clearance->filter, clearance->navmesh->slots[to.slot].tile, to.polygon);
        if (distance_sq <= search->best_sq && passes) {
            relax_polygon(search, to.slot, to.polygon, distance_sq);
        }
    }
}

static void search_outward(place_search *search)
{
    tl_nav_query *query = search->clearance->query;
    tl_nav_pool_reset(query);
    relax_polygon(search, search->slot, search->polygon, 0.0);
    while (!search->clearance->is_full) {
        uint32_t index = tl_nav_heap_pop(query);
        // Keys are rounded: one more polygon may be visited than need be, never one less.
        if (index == TL_NAV_NO_NODE ||
            (double)query->nodes[index].total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING) > search->best_sq) {
            return;
        }
        search->slot = query->nodes[index].slot;
        search->polygon = query->nodes[index].polygon;
        if (!visit_polygon(search)) {
            return;
        }
        visit_neighbours(search);
    }
}

// Within the nodes that the query has now.
static tl_result find_wide_place_within(tl_nav_query *query, const tl_navmesh *navmesh,
                                        const tl_nav_around_request *request, float agent_radius,
                                        tl_nav_location *place_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || place_out == NULL ||
        !tl_nav_filter_is_begun(request->filter)) {
        return TL_ERR_ARGUMENT;
    }
    memset(place_out, 0, sizeof *place_out);
    const tl_nav_location *near = &request->center;
    const float max_distance = request->radius;
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_is_finite(near->point) || !isfinite(agent_radius) || !isfinite(max_distance)) {
        return TL_ERR_NOT_FINITE;
    }
    if (agent_radius < 0.0f || max_distance < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, near->polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    tl_nav_clearance clearance;
    double reach = tl_nav_extra_reach(navmesh->slots[slot].tile, agent_radius);
    tl_nav_clearance_begin(query, navmesh, request->filter, reach, &clearance);
    // Most polygons without a free place are forbidden by one wall alone. Where many lie over one another in less room
    // than the agent takes, each has hundreds of walls around it, seen along ten thousands of lines.
    clearance.cover = tl_max_f64(0.0, clearance.reach - 2.0 * clearance.slack);
    place_search search;
    memset(&search, 0, sizeof search);
    search.clearance = &clearance;
    search.spot = tl_nav_spot_make((double)near->point.x, (double)near->point.z);
    search.reach = clearance.reach > 0.0 ? clearance.reach + 0.5 * clearance.slack : 0.0;
    search.slot = slot;
    search.polygon = polygon;
    search.best_sq = (double)max_distance * (double)max_distance * (1.0 + TL_DOUBLE_GAMMA(4));
    search_outward(&search);
    if (clearance.is_full) {
        return TL_ERR_NODES;
    }
    if (!search.is_found) {
        return TL_NOT_FOUND;
    }
    tl_nav_met home = { search.best_slot, search.best_polygon };
    *place_out = tl_nav_spot_on_surface(&clearance, home, search.best);
    return TL_OK;
}

tl_result tl_nav_query_find_wide_place(tl_nav_query *query, const tl_navmesh *navmesh,
                                       const tl_nav_around_request *request, float agent_radius,
                                       tl_nav_location *place_out)
{
    tl_result result;
    do {
        result = find_wide_place_within(query, navmesh, request, agent_radius, place_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
