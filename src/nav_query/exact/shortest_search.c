// SPDX-License-Identifier: MIT
//
// Polyanya: exact shortest paths in the plane, over polygons, tiles and floors.
//
// A node is a wedge: a root (the start, or a vertex where the path has turned) and what is seen from it through the
// edge by which a polygon is entered. To go on from a polygon, each of its edges takes its part of the wedge; where the
// wedge ends in a vertex of a wall, the parts beyond become wedges of that vertex, for a path that turns there. The
// estimate to the goal is the shortest way through the wedge's opening, with the goal mirrored where it lies on the
// near side: a lower bound, so the first wedge that is expanded in the goal's polygon has the shortest path of all.
//
// What is our own: an end of a wedge is not the point where a ray crosses an edge, which would be rounded from edge to
// edge, but the direction from the root to a vertex, the same doubles all the way. Two wedges side by side share their
// border bit by bit, a vertex on it belongs to both, and no path slips through between. Edges that are seen edge-on
// (walls and doors in line, on a lattice the rule) are gone along to their nearer vertex. Dead ends are left out,
// vertices that no shortest path turns at are known beforehand (fans.c), and the best wedge of a step goes on at once
// without a turn in the heap.
//
// The end of an off-mesh link is gone to as if it were the goal, and its other end is a root from which all is open
// (wedge_links.inl). A link costs no less than the straight way, so estimates hold. Where one does, a short cut, an
// estimate is at most the way to the goal from the nearest end of a short cut. A wedge in the goal's polygon is then
// expanded twice: for what lies behind it, and for its own true length.
// Source: Cui, Harabor, Grastien, Compromise-free Pathfinding on a Navigation Mesh, IJCAI 2017.

#include "nav_query/exact/shortest_search.h"

#include "nav_query/exact/wedge_root.inl"
#include "nav_query/exact/wedge_straight.inl"
#include "nav_query/plane/surface.h"

#include <string.h>

// From where a link lands. A way straight to the goal is one among others here.
static void land_wedge(wedge_search *s, uint32_t index)
{
    uint32_t last = look_from_root(s, index);
    if (last != TL_NAV_NO_NODE) {
        const tl_nav_wedge *wedge = &s->query->wedges[last];
        offer_wedge(s, last, (float)(wedge->cost + way_to(s, wedge, s->goal_x, s->goal_z).length));
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
        offer_wedge(s, only, total_of(s, wedge, &s->only_edge));
    }
    tl_nav_open_item next = { s->best_total, s->best };
    if (s->best == TL_NAV_NO_NODE) {
        if (query->open_count == 0) {
            return TL_NAV_NO_NODE;
        }
        next = tl_nav_open_pop(query);
    } else if (query->open_count > 0 && query->open[0] < tl_nav_open_key(next.total, next.index)) {
        next = tl_nav_open_swap_top(query, next.total, next.index);
    }
    s->best = TL_NAV_NO_NODE;
    *total_out = next.total;
    return next.index;
}

// What a total that was rounded to float says for certain.
static double certain_length(float total)
{
    return (double)total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING);
}

// No path is shorter, when a wedge of this total has come to the goal: neither one through it, nor one through any that
// waits.
static double proven_length(const wedge_search *s, float total)
{
    const double found = certain_length(total);
    if (s->weight == 1.0 || s->query->open_count == 0) {
        return found;
    }
    const tl_nav_direction to_goal = { s->goal_x - (double)s->in->start.x, s->goal_z - (double)s->in->start.z };
    const double straight = fmin(length_of(to_goal), s->detour);
    const double others = (double)tl_nav_open_item_of(s->query->open[0]).total / s->weight;
    return fmin(found, certain_length((float)fmax(others, straight)));
}

// The wedge that holds the goal: the one that entered its polygon, or, where the goal lies beside that wedge's end in a
// vertex, one that turns there. TL_NAV_NO_NODE where that end is no vertex: then another wedge lies beside it, which
// leads to the goal in a way that is straight, and this one came first by rounding only.
static uint32_t end_in(wedge_search *s, uint32_t entered)
{
    wedge_way way = way_to(s, &s->query->wedges[entered], s->goal_x, s->goal_z);
    return way.reaches ? turn_on(s, entered, &way) : TL_NAV_NO_NODE;
}

// Where there are short cuts: expands what lies behind a wedge in the goal's polygon, unless its total is its true
// one.
static bool goes_on_past_goal(wedge_search *s, uint32_t index, float total)
{
    const tl_nav_wedge *wedge = &s->query->wedges[index];
    wedge_way way = way_to(s, wedge, s->goal_x, s->goal_z);
    float true_total = (float)(wedge->cost + way.length);
    if (way.reaches && total >= true_total) {
        return false;
    }
    if (wedge->edge >= TL_NAV_WEDGE_LANDS) {
        land_wedge(s, index);
        return true;
    }
    if (way.reaches) {
        offer_wedge(s, index, true_total);
    }
    expand_wedge(s, index);
    return true;
}

// Expands wedges, the lowest total first, until one has entered the goal's polygon or the steps are used up.
static tl_nav_search_end run_wedges(wedge_search *s, uint64_t *steps)
{
    float total = 0.0f;
    for (; *steps > 0; --*steps) {
        uint32_t next = next_wedge(s, &total);
        if (s->trouble != TL_NAV_SEARCH_FOUND || next == TL_NAV_NO_NODE) {
            return s->trouble != TL_NAV_SEARCH_FOUND ? s->trouble : TL_NAV_SEARCH_EXHAUSTED;
        }
        const tl_nav_wedge *wedge = &s->query->wedges[next];
        if (wedge->polygon == s->in->goal_polygon && wedge->slot == s->in->goal_slot) {
            if (s->detour != (double)INFINITY && goes_on_past_goal(s, next, total)) {
                continue;
            }
            s->in->last = end_in(s, next);
            const bool is_found = s->in->last != TL_NAV_NO_NODE;
            const double proven = is_found ? proven_length(s, total) : certain_length(total);
            s->in->lower_bound = s->in->lower_bound > 0.0 ? fmin(s->in->lower_bound, proven) : proven;
            if (!is_found) {
                continue;
            }
            return TL_NAV_SEARCH_FOUND;
        }
        if (wedge->edge >= TL_NAV_WEDGE_LANDS) {
            land_wedge(s, next);
        } else {
            expand_wedge(s, next);
        }
    }
    return s->trouble != TL_NAV_SEARCH_FOUND ? s->trouble : TL_NAV_SEARCH_PAUSED;
}

static double larger_magnitude(double a, double b)
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
                       search->weight,
                       (double)INFINITY,
                       TL_NAV_SEARCH_FOUND,
                       search->only,
                       { search->only_right, search->only_left },
                       search->best,
                       search->best_total,
                       false,
                       NULL };
    double start_size = larger_magnitude((double)search->start.x, (double)search->start.z);
    s.rounding = TL_NAV_ON_LINE * larger_magnitude(start_size, larger_magnitude(s.goal_x, s.goal_z));
    s.detour = min_wedge_detour(&s);
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

tl_result tl_nav_prepare_shortest(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                                  tl_nav_shortest_search *search_out)
{
    const tl_nav_filter *filter = request->filter;
    const tl_nav_location *start = &request->start;
    const tl_nav_location *goal = &request->goal;
    memset(search_out, 0, sizeof *search_out);
    if (!tl_nav_filter_is_begun(filter) || !tl_nav_filter_has_slack(filter)) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(start->point) || !tl_nav_is_finite(goal->point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, start->polygon, &search_out->start_slot, &search_out->start_polygon) ||
        !tl_nav_split_ref(navmesh, goal->polygon, &search_out->goal_slot, &search_out->goal_polygon)) {
        return TL_ERR_STALE;
    }
    search_out->query = query;
    search_out->navmesh = navmesh;
    bool all_pass = tl_nav_all_pass(navmesh, filter);
    static const tl_nav_filter any = { UINT64_MAX, 0, { 0 }, NULL, NULL, NULL, 0.0f, TL_DEF_COOKIE };
    search_out->weight = 1.0 + (double)(filter != NULL ? filter->slack : 0.0f);
    search_out->filter = all_pass ? NULL : filter != NULL ? filter : &any;
    bool inside = false;
    search_out->start = tl_nav_clamp_to_polygon(navmesh->slots[search_out->start_slot].tile, search_out->start_polygon,
                                                start->point, &inside);
    search_out->goal = tl_nav_clamp_to_polygon(navmesh->slots[search_out->goal_slot].tile, search_out->goal_polygon,
                                               goal->point, &inside);
    return TL_OK;
}

bool tl_nav_is_cut_off(const tl_nav_shortest_search *search)
{
    return tl_nav_island_of(search->navmesh, search->start_slot, search->start_polygon) !=
           tl_nav_island_of(search->navmesh, search->goal_slot, search->goal_polygon);
}

tl_nav_search_end tl_nav_begin_shortest(tl_nav_shortest_search *search)
{
    tl_nav_query *query = search->query;
    query->wedge_count = 0;
    query->open_count = 0;
    tl_nav_next_generation(query);
    search->only = TL_NAV_NO_NODE;
    search->best = TL_NAV_NO_NODE;
    search->lower_bound = 0.0; // that of a path over the graph is of no use, where it could not be walked
    wedge_search s = take_up(search);
    const uint32_t start = add_start(&s);
    search->last = find_line_from_start(&s, start);
    if (search->last != TL_NAV_NO_NODE) {
        search->lower_bound = certain_length((float)tl_nav_shortest_length(search));
        return TL_NAV_SEARCH_FOUND;
    }
    search->last = look_from_root(&s, start);
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
    tl_nav_search_end end = run_wedges(&s, steps);
    lay_down(&s, search);
    return end;
}

tl_nav_search_end tl_nav_search_shortest(tl_nav_shortest_search *search)
{
    uint64_t steps = UINT64_MAX;
    tl_nav_search_end end = tl_nav_begin_shortest(search);
    return end == TL_NAV_SEARCH_PAUSED ? tl_nav_step_shortest(search, &steps) : end;
}

// Whether some direction of a wedge lies on one hand of a wall: on the left (1) or the right (-1). Far more than
// rounding is allowed for, as who is told of what is seen asks more closely.
static bool reaches_hand_of(const tl_nav_wedge *wedge, tl_nav_direction wall, int hand, double rounding)
{
    const double wall_size = fabs(wall.x) + fabs(wall.z), slack = 32.0 * rounding;
    return hand * wedge_cross(wall, wedge->left) <= slack * (wall_size + fabs(wedge->left.x) + fabs(wedge->left.z)) ||
           hand * wedge_cross(wall, wedge->right) <= slack * (wall_size + fabs(wedge->right.x) + fabs(wedge->right.z));
}

// Whether a path that comes back from somewhere in a wedge may turn at the place that is looked from: to a hand on
// which both walls lie. No direction of a wedge lies on one hand of a line if neither of its ends does.
static bool may_turn_before(const tl_nav_wedge *wedge, const tl_nav_ring_walls *walls, double rounding)
{
    const tl_nav_direction first = { (double)walls->first_x, (double)walls->first_z };
    const tl_nav_direction last = { (double)walls->last_x, (double)walls->last_z };
    return (reaches_hand_of(wedge, first, 1, rounding) && reaches_hand_of(wedge, last, 1, rounding)) ||
           (reaches_hand_of(wedge, first, -1, rounding) && reaches_hand_of(wedge, last, -1, rounding));
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
    s.weight = 1.0;
    s.detour = (double)INFINITY;
    s.rounding = TL_NAV_ON_LINE * larger_magnitude((double)from->start.x, (double)from->start.z);
    from->goal_slot = TL_NAV_NO_SLOT; // no polygon ends it
    s.query->wedge_count = 0;
    tl_nav_next_generation(s.query);
    look_from_root(&s, add_start(&s));
    for (uint32_t i = 0; i < s.query->wedge_count && s.trouble == TL_NAV_SEARCH_FOUND; i++) {
        const tl_nav_wedge *wedge = &s.query->wedges[i];
        if (wedge->edge < TL_NAV_WEDGE_LANDS && (sight->looks == NULL || sight->looks(sight->user, wedge)) &&
            may_turn_before(wedge, sight->walls, s.rounding)) {
            expand_wedge(&s, i);
        }
    }
    return s.trouble == TL_NAV_SEARCH_FOUND;
}
