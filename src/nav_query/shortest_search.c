// SPDX-License-Identifier: MIT
//
// Exact shortest paths in the plane, over polygons, tiles and floors: Polyanya.
//
// A node is a wedge: a root (the start, or a vertex where the path has turned) and what is seen from it through the
// edge by which a polygon is entered. To go on from a polygon, each of its edges takes its part of the wedge; where the
// wedge ends in a vertex of a wall, the parts beyond become wedges of that vertex, for a path that turns there. The
// estimate to the goal is the shortest way through the wedge's opening, with the goal mirrored where it lies on the
// near side: a lower bound, so the first wedge that is taken up in the goal's polygon has the shortest path of all.
//
// What is our own: an end of a wedge is not the point where a ray crosses an edge, which would be rounded from edge to
// edge, but the direction from the root to a vertex, the same doubles all the way. Two wedges side by side share their
// border bit by bit, a vertex on it belongs to both, and no path slips through between. Edges that are seen edge-on
// (walls and doors in line, on a lattice the rule) are gone along to their nearer vertex. Dead ends are left out,
// vertices that no shortest path turns at are known beforehand (fans.c), and the best wedge of a step goes on at once
// without a turn in the heap.
//
// The end of an off-mesh link is gone to as if it were the goal, and its other end is a root from which all is open
// (wedge_links.h). A link costs no less than the straight way, so estimates hold. Where one does, a short cut, an
// estimate is at most the way to the goal from the nearest end of a short cut. A wedge in the goal's polygon is then
// taken up twice: for what lies behind it, and for its own true length.
// Source: Cui, Harabor, Grastien, Compromise-free Pathfinding on a Navigation Mesh, IJCAI 2017.

#include "nav_query/shortest_search.h"

#include "nav_query/wedge_links.h"

#include <string.h>

// What a step goes on from.
typedef struct step_from {
    uint32_t wedge; // that is taken up
    uint32_t slot, polygon;
    const tl_nav_ring_edge *ring;
    uint32_t count;
} step_from;

// The least length of a path through a wedge.
static float total_of(const wedge_search *s, const tl_nav_wedge *wedge, const seen_edge *edge)
{
    tl_nav_direction goal = { s->goal_x - (double)wedge->root_x, s->goal_z - (double)wedge->root_z };
    double rest = least_through(edge, wedge->left, wedge->right, goal);
    return (float)(wedge->cost + (rest < s->detour ? rest : s->detour));
}

// A wedge through edge i of the polygon. `root_*`, `cost`: its root. The first one of a step is kept as it is: where it
// stays the only one the search goes on with it at once, and its total is not asked for.
static void add_wedge(wedge_search *s, const step_from *from, uint32_t i, float root_x, float root_z, double cost,
                      const seen_edge *edge, tl_nav_direction left, tl_nav_direction right)
{
    tl_nav_ring_place twin = tl_nav_ring_twin(s->navmesh, from->slot, from->polygon, from->ring, from->count, i);
    if (!may_enter(s, twin.slot, twin.polygon)) {
        return;
    }
    uint32_t index = new_wedge(s);
    if (index == TL_NAV_NO_NODE) {
        return;
    }
    tl_nav_wedge *wedge = &s->query->wedges[index];
    wedge->left = left;
    wedge->right = right;
    wedge->cost = cost;
    wedge->root_x = root_x;
    wedge->root_z = root_z;
    wedge->slot = twin.slot;
    wedge->polygon = twin.polygon;
    wedge->edge = twin.edge;
    wedge->parent = from->wedge;
    if (s->sight != NULL) {
        return;
    }
    if (s->only == TL_NAV_NO_NODE && s->best == TL_NAV_NO_NODE) {
        s->only = index;
        s->only_edge = *edge;
        return;
    }
    if (s->only != TL_NAV_NO_NODE) {
        uint32_t first = s->only;
        s->only = TL_NAV_NO_NODE;
        offer(s, first, total_of(s, &s->query->wedges[first], &s->only_edge));
    }
    offer(s, index, total_of(s, wedge, edge));
}

static seen_edge see(const step_from *from, uint32_t i, float root_x, float root_z)
{
    const tl_nav_ring_edge *a = &from->ring[i];
    const tl_nav_ring_edge *b = &from->ring[i + 1 < from->count ? i + 1 : 0];
    seen_edge edge = { { (double)a->x - (double)root_x, (double)a->z - (double)root_z },
                       { (double)b->x - (double)root_x, (double)b->z - (double)root_z } };
    return edge;
}

// How an edge is seen: whether it shows its inner side, and whether edge-on, as far as rounding can tell.
typedef struct edge_view {
    bool facing, edge_on;
} edge_view;

static edge_view view_of(const wedge_search *s, const seen_edge *edge)
{
    double area = cross(edge->right, edge->left);
    double size = fabs(edge->left.x - edge->right.x) + fabs(edge->left.z - edge->right.z);
    edge_view v = { area < 0.0, fabs(area) <= s->rounding * size };
    return v;
}

// Numbers of corners of polygons, beside those of fans.
#define CORNER_NUMBER  ((uint64_t)1 << 63)
#define TURNING_NUMBER ((uint64_t)1 << 62)

static uint64_t corner_number(const wedge_search *s, uint32_t slot, uint32_t polygon, uint32_t vertex)
{
    const tl_nav_rings *rings = &s->navmesh->slots[slot].rings;
    return CORNER_NUMBER | (uint64_t)slot << 32 | (rings->cells[polygon].first + vertex);
}

// The number of a vertex of the ring in this search, or 0 when no shortest path turns there.
static uint64_t turn_of(const wedge_search *s, const step_from *from, uint32_t vertex)
{
    if (s->in->filter == NULL) {
        return from->ring[vertex].turn;
    }
    // Walls are where the filter says, so the fan is sought anew. Where floors fork each corner stands for itself.
    tl_nav_ring_place place = { from->slot, from->polygon, vertex };
    bool is_walled = tl_nav_find_fan(s->navmesh, s->in->filter, &place);
    if (!is_walled && !s->navmesh->slots[from->slot].rings.has_back) {
        return 0;
    }
    return corner_number(s, place.slot, place.polygon, place.edge);
}

// Whether a wedge that turns around a vertex of edge i may go on over the edge: where there is no wall to end it, only
// once.
static bool may_turn_on(wedge_search *s, const step_from *from, uint32_t vertex, double cost)
{
    const tl_nav_rings *rings = &s->navmesh->slots[from->slot].rings;
    const tl_nav_ring_walls *walls = &rings->walls[rings->cells[from->polygon].first + vertex];
    bool is_walled = walls->first_x != 0.0f || walls->first_z != 0.0f;
    return (is_walled && s->in->filter == NULL) ||
           tl_nav_root_is_first(s->query, TURNING_NUMBER | corner_number(s, from->slot, from->polygon, vertex), cost);
}

static void note_bend(const wedge_search *s, uint64_t turn)
{
    if (turn != 0) {
        s->sight->note(s->sight->user, (uint32_t)turn);
    }
}

// Turns at a vertex of edge i into the polygon behind. `to_vertex` leads there from the root.
static void turn_into(wedge_search *s, const step_from *from, uint32_t i, uint32_t vertex, double cost,
                      tl_nav_direction to_vertex)
{
    const tl_nav_direction open = { 0.0, 0.0 };
    uint64_t turn = turn_of(s, from, vertex);
    if (s->sight != NULL) {
        note_bend(s, turn);
        return;
    }
    cost += length_of(to_vertex);
    if (turn != 0 && tl_nav_root_improves(s->query, turn, cost)) {
        float x = from->ring[vertex].x;
        float z = from->ring[vertex].z;
        seen_edge edge = see(from, i, x, z);
        add_wedge(s, from, i, x, z, cost, &edge, open, open);
    }
}

// Goes along edge i, which is seen edge-on from the root, to its vertices, and turns there into the polygon behind. A
// root that is a vertex of the edge sees all of that polygon.
static void add_edge_on(wedge_search *s, const step_from *from, uint32_t i, float root_x, float root_z, double cost,
                        const seen_edge *edge)
{
    uint32_t next = i + 1 < from->count ? i + 1 : 0;
    if (is_open(edge->left) || is_open(edge->right)) {
        const tl_nav_direction open = { 0.0, 0.0 };
        if (!may_turn_on(s, from, is_open(edge->left) ? next : i, cost)) {
            return;
        }
        add_wedge(s, from, i, root_x, root_z, cost, edge, open, open);
        return;
    }
    turn_into(s, from, i, i, cost, edge->right);
    turn_into(s, from, i, next, cost, edge->left);
}

// Whether a path that comes along `limit` to a vertex may turn there to one hand.
static bool has_walls_on(const wedge_search *s, const step_from *from, uint32_t vertex, tl_nav_direction limit,
                         int hand)
{
    const tl_nav_rings *rings = &s->navmesh->slots[from->slot].rings;
    return may_turn(&rings->walls[rings->cells[from->polygon].first + vertex], limit, hand, s->rounding);
}

// The edges that are reached by turning at a vertex of the edge of entry: `hand` is 1 for the left one, -1 for the
// right one. They lie beyond the wedge's `limit` on that hand, in the part of the ring from `begin` to `end` (counted
// from the edge of entry).
static void turn_at(wedge_search *s, const step_from *from, const tl_nav_wedge *wedge, int hand, uint32_t begin,
                    uint32_t end)
{
    uint32_t vertex = hand > 0 ? wedge->edge : wedge->edge + 1 < from->count ? wedge->edge + 1 : 0;
    tl_nav_direction limit = hand > 0 ? wedge->left : wedge->right;
    uint64_t turn = turn_of(s, from, vertex);
    if (turn == 0 || (s->in->filter == NULL && !has_walls_on(s, from, vertex, limit, hand))) {
        return;
    }
    if (s->sight != NULL) {
        note_bend(s, turn);
        return;
    }
    float x = from->ring[vertex].x;
    float z = from->ring[vertex].z;
    double cost = wedge->cost + length_of(limit); // the limit leads to the vertex
    bool is_new = true;
    for (uint32_t k = begin; k < end; k++) {
        uint32_t i = wedge->edge + k < from->count ? wedge->edge + k : wedge->edge + k - from->count;
        if (!tl_nav_ring_is_open(&from->ring[i])) {
            continue;
        }
        seen_edge edge = see(from, i, x, z);
        double left = side(limit, edge.left);
        double right = side(limit, edge.right);
        bool is_beyond = hand > 0 ? left < 0.0 : right > 0.0;
        bool is_near = hand > 0 ? right <= 0.0 : left >= 0.0;
        if (!is_beyond && !is_near) {
            continue;
        }
        edge_view v = view_of(s, &edge);
        bool touches = v.edge_on && is_near;
        if (!(is_beyond && v.facing) && !touches) {
            continue;
        }
        if (is_new && !tl_nav_root_improves(s->query, turn, cost)) {
            return;
        }
        is_new = false;
        if (touches) {
            // It may turn a second time at once, at the end of the edge: the first turn needs a wedge of its own.
            step_from turned = *from;
            turned.wedge = add_turn(s, from->wedge, x, z, cost);
            add_edge_on(s, &turned, i, x, z, cost, &edge);
        } else if (hand > 0) {
            add_wedge(s, from, i, x, z, cost, &edge, edge.left, right > 0.0 ? limit : edge.right);
        } else {
            add_wedge(s, from, i, x, z, cost, &edge, left < 0.0 ? limit : edge.left, edge.right);
        }
    }
}

// Goes around the ring from the right end of the edge of entry to its left end, which is from right to left as it is
// seen from the root. Edges right of the wedge are reached by turning right, those left of it by turning left.
static void expand(wedge_search *s, uint32_t index)
{
    const tl_nav_wedge wedge = s->query->wedges[index];
    const wedge_view view = make_view(&wedge);
    if (s->navmesh->slots[wedge.slot].anchor_count > 0) {
        cross_links(s, index);
    }
    step_from from = { index, wedge.slot, wedge.polygon, NULL, 0 };
    from.ring = tl_nav_ring_at(s->navmesh, wedge.slot, wedge.polygon, &from.count);
    uint32_t first_seen = from.count; // the first way that ends left of the wedge's right side
    uint32_t last_seen = 1;           // the last one that begins right of its left side
    uint32_t i = wedge.edge;
    seen_vertex right, left;
    uint32_t left_is = UINT32_MAX; // the vertex that was looked at last
    for (uint32_t k = 1; k < from.count; k++) {
        i = i + 1 < from.count ? i + 1 : 0;
        if (!tl_nav_ring_is_open(&from.ring[i])) {
            continue;
        }
        uint32_t next = i + 1 < from.count ? i + 1 : 0;
        right = left_is == i ? left : look_at(&view, &from.ring[i]);
        if (right.left_of_left) {
            break; // and so are all that follow
        }
        left = look_at(&view, &from.ring[next]);
        left_is = next;
        if (left.right_of_right) {
            continue;
        }
        last_seen = right.right_of_left ? k : last_seen;
        first_seen = left.left_of_right && k < first_seen ? k : first_seen;
        seen_edge edge = { right.at, left.at };
        edge_view v = view_of(s, &edge);
        if (v.facing && right.right_of_left && left.left_of_right) {
            add_wedge(s, &from, i, wedge.root_x, wedge.root_z, wedge.cost, &edge,
                      left.left_of_left ? wedge.left : left.at, right.right_of_right ? wedge.right : right.at);
        }
        if (v.edge_on) {
            add_edge_on(s, &from, i, wedge.root_x, wedge.root_z, wedge.cost, &edge);
        }
    }
    // Looking in, the edge of entry starts at its left end.
    const tl_nav_ring_edge *entry_left = &from.ring[wedge.edge];
    const tl_nav_ring_edge *entry_right = &from.ring[wedge.edge + 1 < from.count ? wedge.edge + 1 : 0];
    if (!view.left_open && wedge.left.x == (double)entry_left->x - view.root_x &&
        wedge.left.z == (double)entry_left->z - view.root_z) {
        turn_at(s, &from, &wedge, 1, last_seen, from.count);
    }
    if (!view.right_open && wedge.right.x == (double)entry_right->x - view.root_x &&
        wedge.right.z == (double)entry_right->z - view.root_z) {
        turn_at(s, &from, &wedge, -1, 1, first_seen < from.count ? first_seen + 1 : from.count);
    }
}

// ---------------------------------------------------------------------------------------------------------
// A root from which all is open, the start or where a link lands: all polygons that hold it, on an edge or in a vertex
// several, one found from another.

enum { MAX_AROUND = 64 };

// Whether the root, which lies on the line of an edge, is between its ends.
static bool is_within(const wedge_search *s, const seen_edge *edge)
{
    double x = edge->left.x - edge->right.x;
    double z = edge->left.z - edge->right.z;
    double along = -(x * edge->right.x + z * edge->right.z);
    double slack = s->rounding * sqrt(x * x + z * z);
    return along >= -slack && along <= x * x + z * z + slack;
}

// The wedges that hold a root: `first`, and others that follow one another.
typedef struct root_holders {
    uint32_t first, others;
    uint32_t count;
} root_holders;

static uint32_t holder_at(const root_holders *holders, uint32_t i)
{
    return i == 0 ? holders->first : holders->others + i - 1;
}

static void add_holder(wedge_search *s, root_holders *holders, uint32_t slot, uint32_t polygon, uint32_t parent)
{
    for (uint32_t i = 0; i < holders->count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(holders, i)];
        if (wedge->slot == slot && wedge->polygon == polygon) {
            return;
        }
    }
    uint32_t index = holders->count < MAX_AROUND ? new_wedge(s) : TL_NAV_NO_NODE;
    if (index != TL_NAV_NO_NODE) {
        s->query->wedges[index] = s->query->wedges[parent];
        s->query->wedges[index].slot = slot;
        s->query->wedges[index].polygon = polygon;
        s->query->wedges[index].edge = TL_NAV_WEDGE_HOLDS;
        s->query->wedges[index].parent = parent;
        holders->count++;
    }
}

// Goes through the edges of a polygon that holds the root: adds the polygons behind those it lies on, or else looks
// through all others.
static void look_out(wedge_search *s, uint32_t index, root_holders *gathered)
{
    const tl_nav_wedge wedge = s->query->wedges[index];
    step_from from = { index, wedge.slot, wedge.polygon, NULL, 0 };
    from.ring = tl_nav_ring_at(s->navmesh, from.slot, from.polygon, &from.count);
    for (uint32_t i = 0; i < from.count; i++) {
        if (!tl_nav_ring_is_open(&from.ring[i])) {
            continue;
        }
        seen_edge edge = see(&from, i, wedge.root_x, wedge.root_z);
        edge_view v = view_of(s, &edge);
        bool on_edge = v.edge_on && is_within(s, &edge);
        if (gathered != NULL && on_edge) {
            tl_nav_ring_seam to = tl_nav_ring_across(s->navmesh, from.slot, from.ring[i].to);
            if (may_enter(s, to.slot, to.polygon)) {
                add_holder(s, gathered, to.slot, to.polygon, index);
            }
        } else if (gathered == NULL && !on_edge && v.edge_on) {
            add_edge_on(s, &from, i, wedge.root_x, wedge.root_z, wedge.cost, &edge);
        } else if (gathered == NULL && !on_edge && v.facing) {
            add_wedge(s, &from, i, wedge.root_x, wedge.root_z, wedge.cost, &edge, edge.left, edge.right);
        }
    }
}

// Looks from the root of wedge `first`, which lies in its polygon, through all edges around it. Where a polygon that
// holds it holds the goal too, and no short cut beats the straight way, that wedge is returned, and there is nothing
// else to look for.
static uint32_t look_around(wedge_search *s, uint32_t first)
{
    root_holders holders = { first, s->query->wedge_count, 1 };
    for (uint32_t i = 0; i < holders.count; i++) {
        look_out(s, holder_at(&holders, i), &holders);
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(&holders, i)];
        if (wedge->slot == s->in->goal_slot && wedge->polygon == s->in->goal_polygon) {
            double straight = way_to(s, wedge, s->goal_x, s->goal_z).length;
            if (straight <= s->detour) {
                return holder_at(&holders, i);
            }
            offer(s, holder_at(&holders, i), (float)(wedge->cost + straight));
        }
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(&holders, i)];
        if (s->navmesh->slots[wedge->slot].anchor_count > 0) {
            cross_links(s, holder_at(&holders, i));
        }
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        look_out(s, holder_at(&holders, i), NULL);
    }
    return TL_NAV_NO_NODE;
}

// From where a link lands. A way straight to the goal is one among others here.
static void land(wedge_search *s, uint32_t index)
{
    uint32_t last = look_around(s, index);
    if (last != TL_NAV_NO_NODE) {
        const tl_nav_wedge *wedge = &s->query->wedges[last];
        offer(s, last, (float)(wedge->cost + way_to(s, wedge, s->goal_x, s->goal_z).length));
    }
}

// The wedge to go on with: the only one of the step before, or the best of all.
static uint32_t next_wedge(wedge_search *s, float *total_out)
{
    tl_nav_query *query = s->query;
    uint32_t only = s->only;
    s->only = TL_NAV_NO_NODE;
    if (only != TL_NAV_NO_NODE) {
        const tl_nav_wedge *wedge = &query->wedges[only];
        if (wedge->polygon != s->in->goal_polygon || wedge->slot != s->in->goal_slot) {
            return only;
        }
        offer(s, only, total_of(s, wedge, &s->only_edge));
    }
    tl_nav_heap_entry next = { s->best_total, s->best };
    if (s->best == TL_NAV_NO_NODE) {
        if (query->open_count == 0) {
            return TL_NAV_NO_NODE;
        }
        next = tl_nav_wedge_pop(query);
    } else if (query->open_count > 0 && query->wedge_heap[0] < tl_nav_heap_key(next.total, next.wedge)) {
        tl_nav_heap_entry top = tl_nav_heap_entry_of(query->wedge_heap[0]);
        tl_nav_wedge_sink(query, tl_nav_heap_key(next.total, next.wedge));
        next = top;
    }
    s->best = TL_NAV_NO_NODE;
    *total_out = next.total;
    return next.wedge;
}

// What a total that was rounded to float says for certain.
static double bound_of(float total)
{
    return (double)total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING);
}

// The wedge that holds the goal: the one that entered its polygon, or, where the goal lies beside that wedge's end in a
// vertex, one that turns there. TL_NAV_NO_NODE where that end is no vertex: then another wedge lies beside it, which
// leads to the goal in a way that is straight, and this one came first by rounding only.
static uint32_t end_in(wedge_search *s, uint32_t entered)
{
    wedge_way way = way_to(s, &s->query->wedges[entered], s->goal_x, s->goal_z);
    return way.reaches ? turn_on(s, entered, &way) : TL_NAV_NO_NODE;
}

// Where there are short cuts: takes up what lies behind a wedge in the goal's polygon, unless its total is its true
// one.
static bool goes_on(wedge_search *s, uint32_t index, float total)
{
    const tl_nav_wedge *wedge = &s->query->wedges[index];
    wedge_way way = way_to(s, wedge, s->goal_x, s->goal_z);
    float true_total = (float)(wedge->cost + way.length);
    if (way.reaches && total >= true_total) {
        return false;
    }
    if (wedge->edge >= TL_NAV_WEDGE_LANDS) {
        land(s, index);
        return true;
    }
    if (way.reaches) {
        offer(s, index, true_total);
    }
    expand(s, index);
    return true;
}

// Takes up wedges, the least total first, until one has entered the goal's polygon or the steps are used up.
static tl_nav_search_end run(wedge_search *s, uint64_t *steps)
{
    float total = 0.0f;
    for (; *steps > 0; --*steps) {
        uint32_t next = next_wedge(s, &total);
        if (s->trouble != TL_NAV_SEARCH_FOUND || next == TL_NAV_NO_NODE) {
            return s->trouble != TL_NAV_SEARCH_FOUND ? s->trouble : TL_NAV_SEARCH_EXHAUSTED;
        }
        const tl_nav_wedge *wedge = &s->query->wedges[next];
        if (wedge->polygon == s->in->goal_polygon && wedge->slot == s->in->goal_slot) {
            if (s->detour != (double)INFINITY && goes_on(s, next, total)) {
                continue;
            }
            s->in->lower_bound = s->in->lower_bound > 0.0 ? s->in->lower_bound : bound_of(total);
            s->in->last = end_in(s, next);
            if (s->in->last == TL_NAV_NO_NODE) {
                continue;
            }
            return TL_NAV_SEARCH_FOUND;
        }
        if (wedge->edge >= TL_NAV_WEDGE_LANDS) {
            land(s, next);
        } else {
            expand(s, next);
        }
    }
    return s->trouble != TL_NAV_SEARCH_FOUND ? s->trouble : TL_NAV_SEARCH_PAUSED;
}

static double largest_of(double a, double b)
{
    return fabs(a) > fabs(b) ? fabs(a) : fabs(b);
}

// The search as its last step left it.
static wedge_search take_up(tl_nav_shortest_search *search)
{
    const tl_navmesh *navmesh = search->navmesh;
    wedge_search s = { search,
                       search->query,
                       navmesh,
                       (double)search->goal.x,
                       (double)search->goal.z,
                       0.0,
                       (double)INFINITY,
                       { navmesh->slots[search->goal_slot].rings.cells[search->goal_polygon].dead_end,
                         navmesh->slots[search->start_slot].rings.cells[search->start_polygon].dead_end },
                       TL_NAV_SEARCH_FOUND,
                       search->only,
                       { search->only_right, search->only_left },
                       search->best,
                       search->best_total,
                       NULL };
    double start_size = largest_of((double)search->start.x, (double)search->start.z);
    s.rounding = TL_NAV_ON_LINE * largest_of(start_size, largest_of(s.goal_x, s.goal_z));
    s.detour = shortest_detour(&s);
    return s;
}

static void lay_down(const wedge_search *s, tl_nav_shortest_search *search)
{
    search->only = s->only;
    search->only_right = s->only_edge.right;
    search->only_left = s->only_edge.left;
    search->best = s->best;
    search->best_total = s->best_total;
}

// The wedge of the start's polygon. There is always room for the first.
static uint32_t add_start(wedge_search *s)
{
    const tl_nav_shortest_search *in = s->in;
    tl_nav_wedge start = { { 0.0, 0.0 },      { 0.0, 0.0 },       0.0,
                           in->start.x,       in->start.z,        in->start_slot,
                           in->start_polygon, TL_NAV_WEDGE_HOLDS, TL_NAV_NO_NODE };
    uint32_t first = new_wedge(s);
    s->query->wedges[first] = start;
    return first;
}

tl_nav_search_end tl_nav_begin_shortest(tl_nav_shortest_search *search)
{
    tl_nav_query *query = search->query;
    query->wedge_count = 0;
    query->open_count = 0;
    tl_nav_next_generation(query);
    search->only = TL_NAV_NO_NODE;
    search->best = TL_NAV_NO_NODE;
    wedge_search s = take_up(search);
    search->last = look_around(&s, add_start(&s));
    lay_down(&s, search);
    if (search->last != TL_NAV_NO_NODE) {
        search->lower_bound = tl_nav_shortest_length(search);
        return TL_NAV_SEARCH_FOUND;
    }
    return s.trouble != TL_NAV_SEARCH_FOUND ? s.trouble : TL_NAV_SEARCH_PAUSED;
}

tl_nav_search_end tl_nav_step_shortest(tl_nav_shortest_search *search, uint64_t *steps)
{
    wedge_search s = take_up(search);
    tl_nav_search_end end = run(&s, steps);
    lay_down(&s, search);
    return end;
}

tl_nav_search_end tl_nav_search_shortest(tl_nav_shortest_search *search)
{
    uint64_t steps = UINT64_MAX;
    tl_nav_search_end end = tl_nav_begin_shortest(search);
    return end == TL_NAV_SEARCH_PAUSED ? tl_nav_step_shortest(search, &steps) : end;
}

bool tl_nav_see(tl_nav_shortest_search *from, const tl_nav_sight *sight)
{
    wedge_search s;
    memset(&s, 0, sizeof s);
    s.in = from;
    s.query = from->query;
    s.navmesh = from->navmesh;
    s.trouble = TL_NAV_SEARCH_FOUND;
    s.sight = sight;
    s.detour = (double)INFINITY;
    s.rounding = TL_NAV_ON_LINE * largest_of((double)from->start.x, (double)from->start.z);
    from->goal_slot = TL_NAV_NO_SLOT; // no polygon ends it
    s.query->wedge_count = 0;
    tl_nav_next_generation(s.query);
    look_around(&s, add_start(&s));
    for (uint32_t i = 0; i < s.query->wedge_count && s.trouble == TL_NAV_SEARCH_FOUND; i++) {
        if (s.query->wedges[i].edge < TL_NAV_WEDGE_LANDS) {
            expand(&s, i);
        }
    }
    return s.trouble == TL_NAV_SEARCH_FOUND;
}
