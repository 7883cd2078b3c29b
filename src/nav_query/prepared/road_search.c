// SPDX-License-Identifier: MIT
//
// Shortest paths over roads: A*, from the start's bends to the goal's.
//
// Views (bend_views.c) tell which bends the start and the goal see, but for rounding: when one is taken up the line is
// walked, and what is not seen is crossed out. A road is gone only where the path turns around the bend's walls.
// Estimates are the straight line and landmarks (landmarks.c). Measured on a city of 25,000 polygons: 340 bends are
// taken up where the search over polygons takes up 10,000 wedges.
// Source: Hart, Nilsson, Raphael 1968; Goldberg and Harrelson 2005; Oh and Leong, Edge N-Level Sparse Visibility
// Graphs, 2017 (why only taut turns need be looked at).

#include "nav_query/prepared/roads.h"

#include "nav_query/exact/wedge_heap.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/search/root_table.h"
#include "nav_query/search/straight_line.h"

#define GOAL_BEND UINT32_MAX

typedef struct road_search {
    tl_nav_shortest_search *in;
    tl_nav_query *query;
    const tl_nav_roads *roads;
    double start_x, start_z, goal_x, goal_z;
    double rounding;
    const tl_nav_ends *ends;
    tl_nav_end_marks goal_marks;
    bool is_marked; // these are known
    bool is_unclear;
} road_search;

// Metres from a bend to the goal, at least, by landmarks.
static float guess_by_marks(road_search *s, uint32_t bend)
{
    if (!s->is_marked) {
        tl_nav_mark_end(s->roads, s->ends->goals, s->ends->goal_count, &s->goal_marks);
        s->is_marked = true;
    }
    return tl_nav_least_by_marks(s->roads, &s->goal_marks, bend);
}

// The same by the straight line, from where the bend is.
static float guess_straight(const road_search *s, float bend_x, float bend_z)
{
    double x = s->goal_x - (double)bend_x;
    double z = s->goal_z - (double)bend_z;
    return (float)sqrt(x * x + z * z) * (1.0f - TL_FLOAT_GAMMA(2));
}

static uint32_t new_stop(road_search *s, uint32_t bend)
{
    tl_nav_query *query = s->query;
    if (query->stop_count == query->max_nodes) {
        s->is_unclear = true;
        return TL_NAV_NO_NODE;
    }
    tl_nav_stop stop = { (double)INFINITY, -1.0, INFINITY, -1.0f, bend, TL_NAV_NO_NODE, false, false };
    query->stops[query->stop_count] = stop;
    return query->stop_count++;
}

// The stop of a bend in this search.
static uint32_t stop_at(road_search *s, uint32_t bend)
{
    bool found = false;
    tl_nav_root *root = tl_nav_find_root(s->query, bend, &found);
    if (!found) {
        root->stop = new_stop(s, bend);
    }
    return root->stop;
}

static void open_stop(road_search *s, uint32_t index)
{
    if (s->query->open_count == s->query->max_nodes) {
        s->is_unclear = true;
        return;
    }
    tl_nav_wedge_push(s->query, s->query->stops[index].total, index);
}

// Offers a way to a bend, which is at (x, z). The bend's stop when that is better than what was known.
static uint32_t relax(road_search *s, uint32_t bend, float x, float z, double cost, uint32_t parent)
{
    uint32_t index = stop_at(s, bend);
    if (index == TL_NAV_NO_NODE) {
        return index;
    }
    tl_nav_stop *stop = &s->query->stops[index];
    if (!(cost < stop->cost)) {
        return TL_NAV_NO_NODE;
    }
    stop->guess = stop->guess < 0.0f ? guess_straight(s, x, z) : stop->guess;
    stop->cost = cost;
    stop->parent = parent;
    stop->total = (float)(cost + (double)stop->guess);
    return index;
}

static tl_nav_line make_line(const road_search *s, double x, double z, double to_x, double to_z)
{
    const tl_nav_shortest_search *in = s->in;
    tl_nav_line line = { in->navmesh, x, z, to_x - x, to_z - z, 0, in->goal_slot, in->goal_polygon, s->rounding };
    return line;
}

static bool sees(road_search *s, const tl_nav_line *line, uint32_t slot, uint32_t polygon)
{
    tl_nav_line_end end = tl_nav_walk_line(line, slot, polygon, NULL);
    s->is_unclear = s->is_unclear || end == TL_NAV_LINE_UNCLEAR;
    return end == TL_NAV_LINE_ARRIVES;
}

// The bends from which the last leg may go, each with its length.
static void prepare_goal(road_search *s)
{
    for (uint32_t i = 0; i < s->ends->goal_count && !s->is_unclear; i++) {
        const tl_nav_bend *bend = &s->roads->bends[s->ends->goals[i].bend];
        uint32_t stop = stop_at(s, s->ends->goals[i].bend);
        if (stop != TL_NAV_NO_NODE) {
            double x = (double)bend->x - s->goal_x;
            double z = (double)bend->z - s->goal_z;
            double length = sqrt(x * x + z * z);
            s->query->stops[stop].to_goal = length;
            s->query->stops[stop].guess = (float)length * (1.0f - TL_FLOAT_GAMMA(2));
        }
    }
}

static void open_start(road_search *s)
{
    for (uint32_t i = 0; i < s->ends->start_count && !s->is_unclear; i++) {
        const tl_nav_bend *bend = &s->roads->bends[s->ends->starts[i].bend];
        // Not the bend's own stop: whether it is seen is not known for certain yet.
        uint32_t index = new_stop(s, s->ends->starts[i].bend);
        if (index != TL_NAV_NO_NODE) {
            tl_nav_stop *stop = &s->query->stops[index];
            double x = (double)bend->x - s->start_x;
            double z = (double)bend->z - s->start_z;
            stop->cost = sqrt(x * x + z * z);
            stop->guess = guess_straight(s, bend->x, bend->z);
            stop->is_start = true;
            stop->total = (float)(stop->cost + (double)stop->guess);
            open_stop(s, index);
        }
    }
}

// A path that came along (x, z) and may turn to these hands: whether it may go on along (to_x, to_z).
static bool goes_on(const road_search *s, uint32_t hands, double x, double z, double to_x, double to_z)
{
    double turn = x * to_z - z * to_x;
    double slack = 2.0 * s->rounding * (fabs(x) + fabs(z) + fabs(to_x) + fabs(to_z));
    return (turn >= -slack || (hands & TL_NAV_ROAD_LEFT) != 0) && (turn <= slack || (hands & TL_NAV_ROAD_RIGHT) != 0);
}

static void expand(road_search *s, uint32_t index)
{
    const tl_nav_stop stop = s->query->stops[index];
    const tl_nav_bend *bend = &s->roads->bends[stop.bend];
    const tl_nav_bend *from =
        stop.parent != TL_NAV_NO_NODE ? &s->roads->bends[s->query->stops[stop.parent].bend] : NULL;
    double x = (double)bend->x - (from != NULL ? (double)from->x : s->start_x);
    double z = (double)bend->z - (from != NULL ? (double)from->z : s->start_z);
    uint32_t hands = tl_nav_hands_at(bend, x, z, s->rounding);
    for (uint32_t k = bend[0].first_road; k < bend[1].first_road; k++) {
        const tl_nav_road *road = &s->roads->roads[k];
        double on_x = (double)road->x - (double)bend->x;
        double on_z = (double)road->z - (double)bend->z;
        if (!goes_on(s, hands, x, z, on_x, on_z)) {
            continue;
        }
        uint32_t next = relax(s, road->to, road->x, road->z, stop.cost + sqrt(on_x * on_x + on_z * on_z), index);
        if (next != TL_NAV_NO_NODE) {
            open_stop(s, next);
        }
    }
    if (stop.to_goal >= 0.0 && goes_on(s, hands, x, z, s->goal_x - (double)bend->x, s->goal_z - (double)bend->z)) {
        uint32_t goal = new_stop(s, GOAL_BEND);
        if (goal != TL_NAV_NO_NODE) {
            tl_nav_stop *last = &s->query->stops[goal];
            last->cost = stop.cost + stop.to_goal;
            last->total = (float)last->cost;
            last->parent = index;
            open_stop(s, goal);
        }
    }
}

// Whether the last leg leads from its bend to the goal.
static bool arrives(road_search *s, const tl_nav_stop *goal)
{
    const tl_nav_bend *bend = &s->roads->bends[s->query->stops[goal->parent].bend];
    tl_nav_line line = make_line(s, (double)bend->x, (double)bend->z, s->goal_x, s->goal_z);
    tl_nav_ring_place fan[TL_NAV_MAX_FAN];
    uint32_t count = tl_nav_fan_of(s->in->navmesh, bend, fan);
    for (uint32_t i = 0; i < count; i++) {
        if (tl_nav_line_enters(&line, &fan[i]) && sees(s, &line, fan[i].slot, fan[i].polygon)) {
            return true;
        }
    }
    return false;
}

// Whether the start sees the bend of a stop that was opened for it.
static bool departs(road_search *s, const tl_nav_stop *stop)
{
    const tl_nav_bend *bend = &s->roads->bends[stop->bend];
    tl_nav_line line = make_line(s, s->start_x, s->start_z, (double)bend->x, (double)bend->z);
    line.turn = bend->turn;
    return sees(s, &line, s->in->start_slot, s->in->start_polygon);
}

// Landmarks are looked at for stops that come to the top only. Whether they say more than the straight line does.
static bool guess_better(road_search *s, uint32_t index)
{
    tl_nav_stop *stop = &s->query->stops[index];
    if (stop->is_guessed) {
        return false;
    }
    stop->is_guessed = true;
    float better = guess_by_marks(s, stop->bend);
    if (!(better > stop->guess)) {
        return false;
    }
    stop->guess = better;
    stop->total = (float)(stop->cost + (double)better);
    return true;
}

// Takes up stops, the least total first, until the goal is one. TL_NAV_NO_NODE: it gave up.
static uint32_t run(road_search *s)
{
    tl_nav_query *query = s->query;
    while (query->open_count > 0 && !s->is_unclear) {
        tl_nav_heap_entry next = tl_nav_wedge_pop(query);
        const tl_nav_stop *stop = &query->stops[next.wedge];
        if (next.total != stop->total) {
            continue; // it was reached in a shorter way since
        }
        if (stop->bend == GOAL_BEND) {
            if (arrives(s, stop)) {
                return next.wedge;
            }
        } else if (guess_better(s, next.wedge)) {
            open_stop(s, next.wedge);
        } else if (stop->is_start) {
            if (departs(s, stop)) {
                const tl_nav_bend *bend = &s->roads->bends[stop->bend];
                uint32_t seen = relax(s, stop->bend, bend->x, bend->z, stop->cost, TL_NAV_NO_NODE);
                if (seen != TL_NAV_NO_NODE) {
                    expand(s, seen);
                }
            }
        } else {
            expand(s, next.wedge);
        }
    }
    return TL_NAV_NO_NODE;
}

bool tl_nav_search_roads(tl_nav_shortest_search *search, const tl_nav_roads *roads, const tl_nav_ends *ends,
                         const tl_nav_path_room *room, tl_nav_shortest_path *path_out)
{
    road_search s;
    tl_nav_query *query = search->query;
    s.in = search;
    s.query = query;
    s.roads = roads;
    s.start_x = (double)search->start.x;
    s.start_z = (double)search->start.z;
    s.goal_x = (double)search->goal.x;
    s.goal_z = (double)search->goal.z;
    s.is_unclear = false;
    s.is_marked = false;
    s.ends = ends;
    s.rounding = tl_nav_line_rounding(search, roads);
    query->stop_count = 0;
    query->open_count = 0;
    prepare_goal(&s);
    open_start(&s);
    uint32_t last = run(&s);
    if (last == TL_NAV_NO_NODE || s.is_unclear) {
        return false;
    }
    search->lower_bound = (double)query->stops[last].total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING);
    // The search is over: the room of its heap holds the bends, the last one first.
    uint32_t count = 0;
    for (uint32_t stop = query->stops[last].parent; stop != TL_NAV_NO_NODE; stop = query->stops[stop].parent) {
        query->wedge_heap[count++] = query->stops[stop].bend;
    }
    bool is_written = tl_nav_write_roads(search, roads, query->wedge_heap, count, room, path_out) == UINT32_MAX;
    path_out->node_count = query->stop_count;
    return is_written;
}
