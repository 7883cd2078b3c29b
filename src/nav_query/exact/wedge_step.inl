// SPDX-License-Identifier: MIT
//
// One step of the exact search: a wedge goes on through a polygon, over its edges and around the ends of its edge of
// entry.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_STEP_INL
#define TALUS_SRC_NAV_QUERY_WEDGE_STEP_INL

#include "base/compiler.h"
#include "nav_query/exact/wedge_links.inl"

// What a step goes on from.
typedef struct step_from {
    uint32_t wedge; // that is expanded
    uint32_t slot, polygon;
    const tl_nav_rings *rings; // of the slot
    tl_nav_ring ring;          // of the polygon
} step_from;

static inline step_from step_from_polygon(const wedge_search *s, uint32_t wedge, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &s->navmesh->slots[slot].rings;
    const step_from from = { wedge, slot, polygon, rings, tl_nav_ring_of(rings, polygon) };
    return from;
}

// The vertex behind another of a ring: by a mask, as where a ring ends is in no order that a processor could foresee.
static inline uint32_t vertex_behind(uint32_t vertex, uint32_t count)
{
    return (vertex + 1) & (0u - (uint32_t)(vertex + 1 < count));
}

// A wedge's total. In the goal's polygon nothing is left to hurry for.
static inline float total_of(const wedge_search *s, const tl_nav_wedge *wedge, const seen_edge *edge)
{
    tl_nav_direction goal = { s->goal_x - (double)wedge->root_x, s->goal_z - (double)wedge->root_z };
    double rest = min_length_through(edge, wedge->left, wedge->right, goal);
    rest = rest < s->detour ? rest : s->detour;
    const bool is_least =
        s->weight == 1.0 || (wedge->polygon == s->in->goal_polygon && wedge->slot == s->in->goal_slot);
    return is_least ? (float)(wedge->cost + rest) : total_by(s, wedge->cost, rest);
}

// Where a wedge's root lies, and metres from the start to it.
typedef struct wedge_origin {
    float x, z;
    double cost;
} wedge_origin;

// Offers the first wedge of a step: it is not the only one.
static inline void offer_first(wedge_search *s)
{
    if (s->only != TL_NAV_NO_NODE) {
        const uint32_t first = s->only;
        const bool puts_off = s->puts_off;
        s->only = TL_NAV_NO_NODE;
        s->puts_off = false; // it was not
        offer_wedge(s, first, total_of(s, &s->query->wedges[first], &s->only_edge));
        s->puts_off = puts_off;
    }
}

// Adds a wedge through edge i of the polygon. The first one of a step is kept as it is: where it stays the only one the
// search goes on with it at once, and its total is not asked for.
static inline void add_wedge(wedge_search *s, const step_from *from, uint32_t i, wedge_origin root,
                             const seen_edge *edge, tl_nav_direction left, tl_nav_direction right)
{
    const tl_nav_ring_seam here = { from->slot, from->polygon };
    if (!may_go(s, here, tl_nav_ring_across(s->navmesh, from->slot, tl_nav_ring_to(&from->ring, i)))) {
        return;
    }
    tl_nav_ring_place twin = tl_nav_ring_twin(s->navmesh, from->slot, from->polygon, &from->ring, i);
    uint32_t index = new_wedge(s);
    if (index == TL_NAV_NO_NODE) {
        return;
    }
    tl_nav_wedge *wedge = &s->query->wedges[index];
    wedge->left = left;
    wedge->right = right;
    wedge->cost = root.cost;
    wedge->root_x = root.x;
    wedge->root_z = root.z;
    wedge->slot = twin.slot;
    wedge->polygon = twin.polygon;
    wedge->edge = twin.edge;
    wedge->parent = from->wedge;
    if (s->sight != NULL) {
        return;
    }
    if (s->only == TL_NAV_NO_NODE && !s->puts_off && s->best == TL_NAV_NO_NODE) {
        s->only = index;
        s->only_edge = *edge;
        return;
    }
    offer_first(s);
    offer_wedge(s, index, total_of(s, wedge, edge));
}

static inline seen_edge see_edge(const step_from *from, uint32_t i, float root_x, float root_z)
{
    const tl_vec3 *a = &from->ring.points[i];
    const tl_vec3 *b = &from->ring.points[i + 1 < from->ring.count ? i + 1 : 0];
    seen_edge edge = { { (double)a->x - (double)root_x, (double)a->z - (double)root_z },
                       { (double)b->x - (double)root_x, (double)b->z - (double)root_z } };
    return edge;
}

// How an edge is seen: whether it shows its inner side, and whether edge-on, as far as rounding can tell.
typedef struct edge_view {
    bool facing, edge_on;
} edge_view;

static inline edge_view view_of(const wedge_search *s, const seen_edge *edge)
{
    double area = wedge_cross(edge->right, edge->left);
    double size = fabs(edge->left.x - edge->right.x) + fabs(edge->left.z - edge->right.z);
    edge_view v = { area < 0.0, fabs(area) <= s->rounding * size };
    return v;
}

// Numbers of corners of polygons, beside those of fans.
#define CORNER_NUMBER  ((uint64_t)1 << 63)
#define TURNING_NUMBER ((uint64_t)1 << 62)

static inline uint64_t corner_number(const step_from *from, uint32_t vertex)
{
    return CORNER_NUMBER | (uint64_t)from->slot << 32 | (from->ring.first + vertex);
}

// The number of a vertex of the ring in this search, or 0 when no shortest path turns there.
static inline uint64_t turn_of(const wedge_search *s, const step_from *from, uint32_t vertex)
{
    if (s->in->filter == NULL) {
        return tl_nav_turn_of(from->rings, tl_nav_ring_edge_at(&from->ring, vertex));
    }
    // Walls are where the filter says, so the fan is sought anew. Where floors fork each corner stands for itself.
    tl_nav_ring_place place = { from->slot, from->polygon, vertex };
    bool is_walled = tl_nav_find_fan(s->navmesh, s->in->filter, &place);
    if (!is_walled && !s->navmesh->slots[from->slot].rings.has_back) {
        return 0;
    }
    const step_from fan = step_from_polygon(s, from->wedge, place.slot, place.polygon);
    return corner_number(&fan, place.edge);
}

// Whether a wedge that turns around a vertex of edge i may go on over the edge: where there is no wall to end it, only
// once. Where links run back and forth a polygon has more than one way on from there, and each counts for itself.
static inline bool may_turn_on(wedge_search *s, const step_from *from, uint32_t i, uint32_t vertex, double cost)
{
    const tl_nav_ring_walls *walls = tl_nav_walls_of(from->rings, tl_nav_ring_edge_at(&from->ring, vertex));
    bool is_walled = walls->first_x != 0.0f || walls->first_z != 0.0f;
    const uint64_t end = from->rings->has_back && vertex != i ? TURNING_NUMBER >> 3 : 0;
    const uint64_t number = TURNING_NUMBER | end | corner_number(from, from->rings->has_back ? i : vertex);
    return (is_walled && s->in->filter == NULL && !from->rings->has_back) || is_first_root(s, number, cost);
}

// Notes a vertex that the start sees. `to_vertex` leads there from the root, which is the start, or where the way bent
// for the root's rounding (is_on_wall_to_limit): there only what lies in line is seen by the start itself.
static inline void note_corner(const wedge_search *s, const step_from *from, uint32_t vertex, uint64_t turn,
                               tl_nav_direction to_vertex)
{
    const double x = (double)from->ring.points[vertex].x, z = (double)from->ring.points[vertex].z;
    const tl_nav_direction to_root = { x - to_vertex.x - (double)s->in->start.x,
                                       z - to_vertex.z - (double)s->in->start.z };
    const double size = fabs(to_root.x) + fabs(to_root.z) + fabs(to_vertex.x) + fabs(to_vertex.z);
    const double rounding = fmax(s->rounding, TL_NAV_ON_LINE * fmax(fabs(x), fabs(z)));
    if (turn != 0 && fabs(wedge_cross(to_root, to_vertex)) <= 2.0 * rounding * size) {
        s->sight->note(s->sight->user, (uint32_t)turn);
    }
}

// Relative error of the length of a path of a thousand legs, each of four roundings, summed in double, twice.
#define SUM_ROUNDING TL_DOUBLE_GAMMA(8192)

// Whether a way to a vertex that is as cheap as another shows nothing new: one as cheap has turned at this corner to
// this hand, and came in farther from the wall. In a city of equal blocks there are two ways around each, as long as
// one another; the searches behind their ends would be the same, and twice as many at each block.
static inline bool is_repeated(wedge_search *s, const step_from *from, uint32_t vertex, int hand, double cost,
                               float from_x, float from_z)
{
    if (s->query->repeat_count >= s->query->max_nodes / 2) {
        return false; // the table has room for others
    }
    uint64_t number = TURNING_NUMBER >> (hand > 0 ? 1 : 2) | corner_number(from, vertex);
    bool found = false;
    tl_nav_root *root = tl_nav_find_root(s->query, number, &found);
    if (root == NULL) {
        return false;
    }
    double x = (double)from->ring.points[vertex].x, z = (double)from->ring.points[vertex].z;
    tl_nav_direction known = { x - (double)root->from_x, z - (double)root->from_z };
    tl_nav_direction limit = { x - (double)from_x, z - (double)from_z };
    double known_cost = (double)root->cost + (double)root->cost_rest;
    if (found && cost >= known_cost * (1.0 - SUM_ROUNDING) &&
        (hand > 0 ? side_of_direction(known, limit) <= 0.0 : side_of_direction(known, limit) >= 0.0)) {
        return true;
    }
    s->query->repeat_count += !found;
    root->cost = (float)cost;
    root->cost_rest = (float)(cost - (double)root->cost);
    root->from_x = from_x;
    root->from_z = from_z;
    return false;
}

// Turns at a vertex of edge i into the polygon behind. `to_vertex` leads there from the root.
static inline void turn_into(wedge_search *s, const step_from *from, uint32_t i, uint32_t vertex, double cost,
                             tl_nav_direction to_vertex)
{
    const tl_nav_direction open = { 0.0, 0.0 };
    uint64_t turn = turn_of(s, from, vertex);
    if (s->sight != NULL) {
        note_corner(s, from, vertex, turn, to_vertex);
        return;
    }
    cost += length_of(to_vertex);
    if (turn != 0 && rank_root(s, turn, cost) != TL_NAV_ROOT_WORSE &&
        (!from->rings->has_back || may_turn_on(s, from, i, vertex, cost))) {
        const wedge_origin root = { from->ring.points[vertex].x, from->ring.points[vertex].z, cost };
        seen_edge edge = see_edge(from, i, root.x, root.z);
        add_wedge(s, from, i, root, &edge, open, open);
    }
}

// Goes along edge i, which is seen edge-on from the root, to its vertices, and turns there into the polygon behind. A
// root that is a vertex of the edge sees all of that polygon.
static inline void add_edge_on(wedge_search *s, const step_from *from, uint32_t i, wedge_origin root,
                               const seen_edge *edge)
{
    uint32_t next = i + 1 < from->ring.count ? i + 1 : 0;
    if (is_open_direction(edge->left) || is_open_direction(edge->right)) {
        const tl_nav_direction open = { 0.0, 0.0 };
        if (!may_turn_on(s, from, i, is_open_direction(edge->left) ? next : i, root.cost)) {
            return;
        }
        add_wedge(s, from, i, root, edge, open, open);
        return;
    }
    turn_into(s, from, i, i, root.cost, edge->right);
    turn_into(s, from, i, next, root.cost, edge->left);
}

// Whether a path that comes along `limit` to a vertex may turn there to one hand.
static inline bool has_walls_on(const wedge_search *s, const step_from *from, uint32_t vertex, tl_nav_direction limit,
                                int hand)
{
    return may_turn(tl_nav_walls_of(from->rings, tl_nav_ring_edge_at(&from->ring, vertex)), limit, hand, s->rounding);
}

// Whether the root, which lies on the line of an edge, is between its ends.
static inline bool is_root_within(const wedge_search *s, const seen_edge *edge)
{
    double x = edge->left.x - edge->right.x;
    double z = edge->left.z - edge->right.z;
    double along = -(x * edge->right.x + z * edge->right.z);
    double slack = s->rounding * sqrt(x * x + z * z);
    return along >= -slack && along <= x * x + z * z + slack;
}

// The first of the wedges from an open root to this one, which have the same limit; NULL where the root is a vertex, or
// the limit is younger.
static inline const tl_nav_wedge *first_with_limit(const wedge_search *s, const tl_nav_wedge *wedge, int hand)
{
    for (;;) {
        const tl_nav_wedge *parent = &s->query->wedges[wedge->parent];
        if (parent->edge >= TL_NAV_WEDGE_LANDS) {
            return wedge;
        }
        const tl_nav_direction limit = hand > 0 ? wedge->left : wedge->right;
        const tl_nav_direction before = hand > 0 ? parent->left : parent->right;
        if (limit.x != before.x || limit.z != before.z || wedge->root_x != parent->root_x ||
            wedge->root_z != parent->root_z) {
            return NULL;
        }
        wedge = parent;
    }
}

// Whether a wall that holds the wedge's root ends where its limit leads to; `first` is the first wedge with that limit.
static TL_NOINLINE bool is_wall_beside(const wedge_search *s, const tl_nav_wedge *first, const tl_nav_wedge *wedge,
                                       int hand)
{
    const tl_nav_ring ring = tl_nav_ring_at(s->navmesh, first->slot, first->polygon);
    const tl_nav_ring_place way = tl_nav_ring_twin(s->navmesh, first->slot, first->polygon, &ring, first->edge);
    const step_from holder = step_from_polygon(s, first->parent, way.slot, way.polygon);
    const uint32_t before = way.edge > 0 ? way.edge - 1 : holder.ring.count - 1;
    const uint32_t beside = hand > 0 ? vertex_behind(way.edge, holder.ring.count) : before;
    const seen_edge wall = see_edge(&holder, beside, wedge->root_x, wedge->root_z);
    return !tl_nav_ring_is_open(tl_nav_ring_to(&holder.ring, beside)) && view_of(s, &wall).edge_on &&
           is_root_within(s, &wall);
}

// Whether the root lies on a wall that ends in the vertex which a wedge's limit leads to. It does not lie there
// exactly: its coordinates were rounded. Behind the wall's line by that, it would see nothing that the wall's
// continuation runs to, and where walls run on in line no vertex is one to turn at. So paths may bend there, by the
// rounding.
static inline bool is_on_wall_to_limit(const wedge_search *s, const tl_nav_wedge *wedge, int hand)
{
    const tl_nav_wedge *first = first_with_limit(s, wedge, hand);
    return first != NULL && is_wall_beside(s, first, wedge, hand);
}

// Where a path may turn that comes along a wedge's limit to a vertex of its edge of entry; 0: nowhere.
static inline uint64_t turn_at_end(const wedge_search *s, const step_from *from, const tl_nav_wedge *wedge, int hand,
                                   uint32_t vertex)
{
    uint64_t turn = turn_of(s, from, vertex);
    if (s->in->filter != NULL) {
        return turn;
    }
    if (turn != 0) {
        return has_walls_on(s, from, vertex, hand > 0 ? wedge->left : wedge->right, hand) ? turn : 0;
    }
    return is_on_wall_to_limit(s, wedge, hand) ? corner_number(from, vertex) : 0;
}

// The edges that are reached by turning at a vertex of the edge of entry: `hand` is 1 for the left one, -1 for the
// right one. They lie beyond the wedge's `limit` on that hand, in the part of the ring from `begin` to `end` (counted
// from the edge of entry).
static TL_ALWAYS_INLINE void turn_at_limit(wedge_search *s, const step_from *from, const tl_nav_wedge *wedge, int hand,
                                           uint32_t begin, uint32_t end)
{
    uint32_t vertex = hand > 0 ? wedge->edge : wedge->edge + 1 < from->ring.count ? wedge->edge + 1 : 0;
    tl_nav_direction limit = hand > 0 ? wedge->left : wedge->right;
    uint64_t turn = turn_at_end(s, from, wedge, hand, vertex);
    if (turn == 0) {
        return;
    }
    if (s->sight != NULL && (turn & CORNER_NUMBER) == 0) {
        note_corner(s, from, vertex, turn, limit);
        return;
    }
    float x = from->ring.points[vertex].x;
    float z = from->ring.points[vertex].z;
    double cost = wedge->cost + length_of(limit); // the limit leads to the vertex
    const wedge_origin root = { x, z, cost };
    bool is_new = true;
    for (uint32_t k = begin; k < end; k++) {
        uint32_t i = wedge->edge + k < from->ring.count ? wedge->edge + k : wedge->edge + k - from->ring.count;
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&from->ring, i))) {
            continue;
        }
        seen_edge edge = see_edge(from, i, x, z);
        double left = side_of_direction(limit, edge.left);
        double right = side_of_direction(limit, edge.right);
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
        if (is_new && s->sight == NULL) {
            tl_nav_root_rank rank = rank_root(s, turn, cost);
            if (rank == TL_NAV_ROOT_WORSE || (rank == TL_NAV_ROOT_AS_CHEAP &&
                                              is_repeated(s, from, vertex, hand, cost, wedge->root_x, wedge->root_z))) {
                return;
            }
            s->puts_off = s->weight > 1.0 && rank != TL_NAV_ROOT_FIRST;
        }
        is_new = false;
        if (touches) {
            // It may turn a second time at once, at the end of the edge: the first turn needs a wedge of its own.
            step_from turned = *from;
            turned.wedge = add_turn(s, from->wedge, x, z, cost);
            add_edge_on(s, &turned, i, root, &edge);
        } else {
            const tl_nav_direction *from_right = hand > 0 && right > 0.0 ? &limit : &edge.right;
            const tl_nav_direction *to_left = hand < 0 && left < 0.0 ? &limit : &edge.left;
            add_wedge(s, from, i, root, &edge, *to_left, *from_right);
        }
    }
    s->puts_off = false;
}

// The ends of the edge by which a wedge entered its polygon. Looking in, the edge starts at its left end.
typedef struct entry_ends {
    uint32_t left_turn, right_turn;
    seen_edge at;               // from the root
    bool sees_left, sees_right; // the wedge reaches to that end
} entry_ends;

static inline entry_ends ends_of_entry(const step_from *from, const tl_nav_wedge *wedge)
{
    const uint32_t behind = vertex_behind(wedge->edge, from->ring.count);
    const tl_vec3 *left = &from->ring.points[wedge->edge], *right = &from->ring.points[behind];
    const double x = (double)wedge->root_x, z = (double)wedge->root_z;
    const seen_edge at = { { (double)right->x - x, (double)right->z - z },
                           { (double)left->x - x, (double)left->z - z } };
    const bool left_is_end = (wedge->left.x == at.left.x) & (wedge->left.z == at.left.z);
    const bool right_is_end = (wedge->right.x == at.right.x) & (wedge->right.z == at.right.z);
    const entry_ends ends = { tl_nav_turn_of(from->rings, tl_nav_ring_edge_at(&from->ring, wedge->edge)),
                              tl_nav_turn_of(from->rings, tl_nav_ring_edge_at(&from->ring, behind)), at, left_is_end,
                              right_is_end };
    return ends;
}

// Whether paths by way of `from`, an end of the edge of entry at which some path has turned at that cost, are shorter
// to all that a wedge sees of the edge. `to`: what it sees of it that is the farthest from there. Directions are from
// the root.
static inline bool is_outrun_from(const tl_nav_wedge *wedge, double cost, tl_nav_direction from, tl_nav_direction to)
{
    const tl_nav_direction along = { to.x - from.x, to.z - from.z };
    const double slack = 1.0 + 2.0 * (double)TL_FLOAT_ROUNDING; // far more than is rounded here
    return (cost + length_of(along)) * slack < wedge->cost + length_of(to);
}

// Whether shorter paths lead to all of the edge of entry that a wedge sees: c(v) + |v b| < cost + |root b| for an end v
// of the edge and the point b that the wedge sees of it the farthest from v. Then the same holds for any x before b, as
// |root b| <= |root x| + |x b| and |v b| = |v x| + |x b|, and no shortest path leads through the wedge. So where two
// paths lead around an obstacle, the search behind the longer one ends soon after they have met. Else it would go over
// all that lies behind the obstacle once more; roots alone do not tell, as what a wedge sees has none.
// Source: Xin, Wang, Improving Chen and Han's Algorithm on the Discrete Geodesic Problem, ACM ToG 2009: the filtering
// of windows, of surfaces of triangles there.
static inline bool is_outrun(const wedge_search *s, const tl_nav_wedge *wedge, const entry_ends *ends)
{
    const tl_nav_direction left = ends->at.left, right = ends->at.right;
    const double none = (double)INFINITY;
    const double by_left = ends->left_turn != 0 ? tl_nav_known_root_cost(s->query, ends->left_turn) : none;
    const double by_right = ends->right_turn != 0 ? tl_nav_known_root_cost(s->query, ends->right_turn) : none;
    // No end helps that the root is as near to in a straight line.
    if (by_left < none && by_left < wedge->cost + length_of(left) &&
        is_outrun_from(wedge, by_left, left, ends->sees_right ? right : meet_edge_line(wedge->right, right, left))) {
        return true;
    }
    return by_right < none && by_right < wedge->cost + length_of(right) &&
           is_outrun_from(wedge, by_right, right, ends->sees_left ? left : meet_edge_line(wedge->left, right, left));
}

// Where links of two floors lie over one another along a seam, one may lie within another, by which a wedge has
// entered. Paths turn at its ends, straight back over the seam.
static TL_NOINLINE void turn_within_entry(wedge_search *s, const step_from *from, const tl_nav_wedge *wedge,
                                          const wedge_view *view)
{
    for (uint32_t i = 0; i < from->ring.count; i++) {
        const uint32_t ends[2] = { i, vertex_behind(i, from->ring.count) };
        for (uint32_t k = 0; k < 2 && i != wedge->edge && tl_nav_ring_is_open(tl_nav_ring_to(&from->ring, i)); k++) {
            const tl_vec3 *vertex = &from->ring.points[ends[k]];
            const seen_vertex seen = look_at(view, vertex);
            const seen_edge entry = see_edge(from, wedge->edge, vertex->x, vertex->z);
            const bool is_within = entry.right.x * entry.left.x + entry.right.z * entry.left.z < 0.0;
            if (is_within && view_of(s, &entry).edge_on && (seen.left_of & LEFT_LIMIT) == 0 &&
                (seen.right_of & RIGHT_LIMIT) == 0 && !is_open_direction(seen.at)) {
                turn_into(s, from, i, ends[k], wedge->cost, seen.at);
            }
        }
    }
}

// Goes around the ring from the right end of the edge of entry to its left end, which is from right to left as it is
// seen from the root. Edges right of the wedge are reached by turning right, those left of it by turning left.
static inline void expand_wedge(wedge_search *s, uint32_t index)
{
    const tl_nav_wedge *wedge = &s->query->wedges[index];
    const wedge_origin root = { wedge->root_x, wedge->root_z, wedge->cost };
    const wedge_view view = make_view(wedge);
    const step_from from = step_from_polygon(s, index, wedge->slot, wedge->polygon);
    const entry_ends ends = ends_of_entry(&from, wedge);
    const bool in_order = !from.rings->has_back; // the edges, as they are seen
    // With a filter a vertex's number says nothing of its walls.
    if (s->in->filter == NULL && s->sight == NULL && is_outrun(s, wedge, &ends)) {
        return;
    }
    if (s->navmesh->slots[wedge->slot].anchor_count > 0) {
        cross_wedge_links(s, index);
    }
    uint32_t first_seen = from.ring.count; // the first way that ends left of the wedge's right side
    uint32_t last_seen = 1;                // the last one that begins right of its left side
    uint32_t i = wedge->edge;
    seen_vertex right, left;
    uint32_t left_is = UINT32_MAX; // the vertex that was looked at last
    for (uint32_t k = 1; k < from.ring.count; k++) {
        i = vertex_behind(i, from.ring.count);
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&from.ring, i))) {
            continue;
        }
        const uint32_t next = vertex_behind(i, from.ring.count);
        right = left_is == i ? left : look_at(&view, &from.ring.points[i]);
        if ((right.left_of & LEFT_LIMIT) != 0) {
            if (in_order) {
                break; // and so are all that follow
            }
            continue;
        }
        left = look_at(&view, &from.ring.points[next]);
        left_is = next;
        if ((left.right_of & RIGHT_LIMIT) != 0) {
            continue;
        }
        const bool begins_right = (right.right_of & LEFT_LIMIT) != 0, ends_left = (left.left_of & RIGHT_LIMIT) != 0;
        last_seen = begins_right && in_order ? k : last_seen;
        first_seen = ends_left && in_order && k < first_seen ? k : first_seen;
        seen_edge edge = { right.at, left.at };
        edge_view v = view_of(s, &edge);
        if (v.facing && begins_right && ends_left) {
            // Chosen by index: as branches they would go one way as often as the other.
            const tl_nav_direction *lefts[2] = { &left.at, &wedge->left };
            const tl_nav_direction *rights[2] = { &right.at, &wedge->right };
            add_wedge(s, &from, i, root, &edge, *lefts[left.left_of & LEFT_LIMIT],
                      *rights[(right.right_of & RIGHT_LIMIT) / RIGHT_LIMIT]);
        }
        if (v.edge_on) {
            add_edge_on(s, &from, i, root, &edge);
        }
    }
    if (!in_order) {
        turn_within_entry(s, &from, wedge, &view);
    }
    if (view.open_right_of == 0 && ends.sees_left) {
        turn_at_limit(s, &from, wedge, 1, last_seen, from.ring.count);
    }
    if (view.open_left_of == 0 && ends.sees_right) {
        turn_at_limit(s, &from, wedge, -1, 1, first_seen < from.ring.count ? first_seen + 1 : from.ring.count);
    }
}

#endif
