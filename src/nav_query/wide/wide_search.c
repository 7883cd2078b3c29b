// SPDX-License-Identifier: MIT
//
// Paths with clearance: A* over the free pieces of portals.
//
// A node is a piece of a portal, crossed in one direction. Its successors are the pieces that are connected with it in
// the polygon behind it (free_pieces.c): not all pieces, as a polygon may be free on both sides of a passage that is
// too narrow; and pieces of the same portal too, as the way around may lead back through it. So a goal is reached
// exactly when there is a free path to it. Pieces are entered where that is shortest (crossing.h), and ways within
// polygons are counted as if they were straight: the path is near the shortest, but not proven to be it. Source: Hart,
// Nilsson, Raphael, A Formal Basis for the Heuristic Determination of Minimum Cost Paths, 1968.

#include "nav_query/wide/wide_search.h"
#include "nav_query/wide/free_pieces.h"

#include "base/min_max.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/plane/crossing.h"

#include <string.h>

// Keys of the two nodes that are no pieces. Edges of a slot are fewer than 2^32 - 1, so no piece has them.
#define WIDE_START_KEY UINT64_MAX
#define WIDE_GOAL_KEY  (UINT64_MAX - 1u)

// Bits of a key for a piece's number on its edge.
enum { ORDINAL_BITS = 12 };

// A polygon with its free pieces.
typedef struct cut_polygon {
    tl_nav_wall_cell cell;
    tl_nav_pieces pieces;
} cut_polygon;

static bool cut_polygon_of(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, cut_polygon *out)
{
    return tl_nav_wall_cell_of(clearance, slot, polygon, clearance->reach, &out->cell) &&
           tl_nav_cut_cell(clearance, &out->cell, &out->pieces);
}

// The component of a piece that a straight free way leads to, as it mostly does, or TL_NAV_NO_COMPONENT.
static uint32_t straight_component(const tl_nav_clearance *clearance, const cut_polygon *cut, tl_nav_spot spot)
{
    for (uint32_t i = 0; i < cut->pieces.count; i++) {
        const tl_nav_piece *piece = &cut->pieces.pieces[i];
        tl_nav_spot p = cut->cell.corners[piece->edge];
        tl_nav_spot q = cut->cell.corners[piece->edge + 1 < cut->cell.count ? piece->edge + 1 : 0];
        tl_nav_spot middle = tl_nav_spot_lerp(p, q, 0.5 * (piece->from + piece->to));
        if (tl_nav_is_clear(&cut->cell.near, spot, middle, clearance->reach)) {
            return piece->component;
        }
    }
    return TL_NAV_NO_COMPONENT;
}

bool tl_nav_wide_place_end(tl_nav_wide_search *search, tl_nav_wide_end *end)
{
    tl_nav_clearance *clearance = search->clearance;
    tl_nav_scratch scratch = clearance->scratch;
    cut_polygon cut;
    bool is_same = search->start.slot == search->goal.slot && search->start.polygon == search->goal.polygon;
    tl_nav_spot other = !is_same ? end->spot : end == &search->start ? search->goal.spot : search->start.spot;
    bool stands = cut_polygon_of(clearance, end->slot, end->polygon, &cut) &&
                  tl_nav_is_clear(&cut.cell.near, end->spot, end->spot, clearance->reach - clearance->slack);
    end->component = stands ? straight_component(clearance, &cut, end->spot) : TL_NAV_NO_COMPONENT;
    if (stands && end->component == TL_NAV_NO_COMPONENT) {
        bool joined = false;
        stands = tl_nav_component_at(clearance, &cut.cell, &cut.pieces, end->spot, other, &end->component, &joined);
        search->is_joined = search->is_joined || (joined && is_same);
    }
    clearance->scratch = scratch;
    return stands;
}

static void relax_portal(tl_nav_wide_search *search, uint64_t key, tl_nav_met to, tl_nav_segment portal,
                         tl_nav_spot spot, float cost, uint32_t from)
{
    tl_nav_query *query = search->clearance->query;
    const tl_vec3 point = tl_vec3_make((float)spot.x, 0.0f, (float)spot.z);
    const tl_nav_way_in way = { key, to.slot, to.polygon, point, cost, from };
    tl_nav_node *node = tl_nav_pool_relax(query, way, &search->clearance->is_full);
    if (node != NULL) {
        const uint32_t index = (uint32_t)(node - query->nodes);
        node->total = cost + (float)sqrt(tl_nav_spot_distance_sq(spot, search->goal.spot));
        tl_nav_wide_portal piece = { (float)portal.a.x, (float)portal.a.z, (float)portal.b.x, (float)portal.b.z };
        search->portals[index] = piece;
        tl_nav_heap_improve(query, index);
    }
}

static tl_nav_spot node_spot(const tl_nav_node *node)
{
    return tl_nav_spot_make((double)node->point.x, (double)node->point.z);
}

static float step_cost(const tl_nav_node *node, tl_nav_spot to)
{
    return node->cost + (float)sqrt(tl_nav_spot_distance_sq(node_spot(node), to));
}

// The share of an outline's edge from p to q at which a spot lies.
static double share_of(tl_nav_spot p, tl_nav_spot q, tl_nav_spot at)
{
    double x = q.x - p.x;
    double z = q.z - p.z;
    return ((at.x - p.x) * x + (at.z - p.z) * z) / (x * x + z * z);
}

// Whether a polygon is the one that the way to a node came from.
static bool leads_back(const tl_nav_wide_search *search, const tl_nav_node *node, tl_nav_ring_seam across)
{
    const tl_nav_node *before = &search->clearance->query->nodes[node->parent];
    return before->slot == across.slot && before->polygon == across.polygon;
}

// How many pieces of an outline's edge lie between two shares of it.
static uint32_t count_pieces(const tl_nav_pieces *pieces, uint32_t edge, double first, double last)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pieces->count; i++) {
        const tl_nav_piece *piece = &pieces->pieces[i];
        count += piece->edge == edge && tl_max_f64(first, piece->from) < tl_min_f64(last, piece->to) ? 1 : 0;
    }
    return count;
}

// A way out of a polygon: an edge of its ring, which lies on the outline's edge `side`.
typedef struct way_out {
    uint32_t to;    // of the ring's edge
    uint32_t place; // of that among all of the tile's
    tl_vec3 start, end;
    uint32_t side;
} way_out;

// Goes over an edge of the ring by all pieces of a component. `entry` is the piece by which the polygon was entered, or
// NULL.
static void cross_wide_edge(tl_nav_wide_search *search, uint32_t index, const cut_polygon *cut, uint32_t component,
                            const tl_nav_piece *entry, const way_out *way)
{
    const tl_nav_clearance *clearance = search->clearance;
    const tl_nav_node node = clearance->query->nodes[index];
    uint32_t side = way->side;
    tl_nav_ring_seam across = tl_nav_ring_across(clearance->navmesh, node.slot, way->to);
    if (clearance->filter != NULL &&
        !tl_nav_passes(clearance->filter, clearance->navmesh->slots[across.slot].tile, across.polygon)) {
        return;
    }
    tl_nav_met to = { across.slot, across.polygon };
    tl_nav_spot p = cut->cell.corners[side];
    tl_nav_spot q = cut->cell.corners[side + 1 < cut->cell.count ? side + 1 : 0];
    // It may be cut from the outline's edge at a seam.
    double first = share_of(p, q, tl_nav_spot_of(way->start));
    double last = share_of(p, q, tl_nav_spot_of(way->end));
    bool is_back = entry != NULL && entry->edge == side && leads_back(search, &node, across);
    double entry_share = is_back ? share_of(p, q, node_spot(&node)) : 0.0;
    // What lies behind it hangs by this edge alone. By a single piece of it the path would come back where it went.
    const tl_nav_ring_seam here = { node.slot, node.polygon }, goal = { search->goal.slot, search->goal.polygon };
    if (tl_nav_leads_astray(clearance->navmesh, here, across, goal) &&
        count_pieces(&cut->pieces, side, first, last) < 2) {
        return;
    }
    uint64_t ordinal = 0;
    for (uint32_t i = 0; i < cut->pieces.count; i++) {
        const tl_nav_piece *piece = &cut->pieces.pieces[i];
        double from = tl_max_f64(first, piece->from);
        double until = tl_min_f64(last, piece->to);
        if (piece->edge != side || !(from < until)) {
            continue;
        }
        if (ordinal >> ORDINAL_BITS != 0) {
            search->clearance->is_full = true;
            return;
        }
        uint64_t key = ((uint64_t)node.slot << 32 | way->place) << ORDINAL_BITS | ordinal++;
        // To go back through the piece of entry leads only to what is connected with it there: no shorter.
        bool is_entry = is_back && piece == entry && from <= entry_share && entry_share <= until;
        if (piece->component == component && !is_entry) {
            // The polygon across may see the piece's ends otherwise, by a rounding.
            double margin = tl_min_f64(clearance->slack / sqrt(tl_nav_spot_distance_sq(p, q)), 0.25 * (until - from));
            from += margin;
            until -= margin;
            tl_nav_segment portal = { tl_nav_spot_lerp(p, q, from), tl_nav_spot_lerp(p, q, until) };
            double share = tl_nav_crossing_share(node_spot(&node), search->goal.spot, portal);
            tl_nav_spot spot = tl_nav_spot_lerp(portal.a, portal.b, share);
            relax_portal(search, key, to, portal, spot, step_cost(&node, spot), index);
        }
    }
}

static void expand_portal(tl_nav_wide_search *search, uint32_t index)
{
    tl_nav_clearance *clearance = search->clearance;
    const tl_nav_node *node = &clearance->query->nodes[index];
    tl_nav_scratch scratch = clearance->scratch;
    cut_polygon cut;
    if (!cut_polygon_of(clearance, node->slot, node->polygon, &cut)) {
        return;
    }
    uint32_t component = search->start.component;
    const tl_nav_piece *entry = NULL;
    if (node->key != WIDE_START_KEY) {
        entry = tl_nav_piece_at(&cut.pieces, cut.cell.corners, cut.cell.count, node_spot(node), clearance->slack);
        component = entry != NULL ? entry->component : TL_NAV_NO_COMPONENT;
    }
    bool is_goals = node->slot == search->goal.slot && node->polygon == search->goal.polygon;
    if (is_goals && component != TL_NAV_NO_COMPONENT && component == search->goal.component) {
        tl_nav_met at = { node->slot, node->polygon };
        tl_nav_segment spot = { search->goal.spot, search->goal.spot };
        relax_portal(search, WIDE_GOAL_KEY, at, spot, search->goal.spot, step_cost(node, search->goal.spot), index);
    }
    const tl_nav_ring ring = tl_nav_ring_at(clearance->navmesh, node->slot, node->polygon);
    uint32_t side = 0;
    for (uint32_t i = 0; i < ring.count && component != TL_NAV_NO_COMPONENT; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        // A ring's edge starts at the outline's next corner when that side is done; an edge that runs back is not.
        if (i > 0 && side + 1 < cut.cell.count && tl_nav_ring_to(&ring, i) != TL_NAV_RING_BACK &&
            (double)ring.points[i].x == cut.cell.corners[side + 1].x &&
            (double)ring.points[i].z == cut.cell.corners[side + 1].z) {
            side++;
        }
        if (tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            way_out way = { tl_nav_ring_to(&ring, i), ring.first + i, ring.points[i], *end, side };
            cross_wide_edge(search, index, &cut, component, entry, &way);
        }
    }
    clearance->scratch = scratch;
}

bool tl_nav_wide_run(tl_nav_wide_search *search)
{
    tl_nav_query *query = search->clearance->query;
    tl_nav_met start = { search->start.slot, search->start.polygon };
    tl_nav_segment from = { search->start.spot, search->start.spot };
    relax_portal(search, WIDE_START_KEY, start, from, search->start.spot, 0.0f, TL_NAV_NO_NODE);
    if (search->is_joined) {
        tl_nav_met goal = { search->goal.slot, search->goal.polygon };
        tl_nav_segment to = { search->goal.spot, search->goal.spot };
        relax_portal(search, WIDE_GOAL_KEY, goal, to, search->goal.spot, step_cost(&query->nodes[0], search->goal.spot),
                     0);
    }
    while (!search->clearance->is_full) {
        search->last = tl_nav_heap_pop(query);
        if (search->last == TL_NAV_NO_NODE || query->nodes[search->last].key == WIDE_GOAL_KEY) {
            return search->last != TL_NAV_NO_NODE;
        }
        expand_portal(search, search->last);
    }
    return false;
}
