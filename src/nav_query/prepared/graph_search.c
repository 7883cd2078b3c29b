// SPDX-License-Identifier: MIT
//
// A* over the visibility graph, from the corner vertices that the start may see to those that the goal may see.
//
// Visibility cones (corner_cones.c) tell which those are, but for rounding: when one is expanded its line is walked,
// and dropped if it is blocked. An edge is followed only where the path turns around the vertex's walls. Estimates are
// the straight line and landmarks (landmarks.c). On a city of 25,000 polygons 340 vertices are expanded where the
// search over polygons expands 10,000 wedges. Source: Hart, Nilsson, Raphael 1968; Goldberg and Harrelson 2005; Oh and
// Leong, Edge N-Level Sparse Visibility Graphs, 2017 (why only taut turns need be looked at).

#include "nav_query/prepared/graph_search.h"

#include "base/compiler.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/prepared/graph_path.h"
#include "nav_query/prepared/landmarks.h"
#include "nav_query/search/open_items.h"
#include "nav_query/search/root_table.h"
#include "nav_query/search/straight_line.h"

#define GOAL_VERTEX UINT32_MAX

// Bytes that are fetched at once.
enum { CACHE_LINE = 64 };

typedef struct graph_search {
    tl_nav_shortest_search *in;
    tl_nav_query *query;
    const tl_nav_visibility_graph *graph;
    double start_x, start_z, goal_x, goal_z;
    double rounding;
    const tl_nav_ends *ends;
    tl_nav_landmark_bounds goal_bounds;
    bool has_goal_bounds; // these are known
    bool is_unclear;
} graph_search;

// Metres from a corner vertex to the goal, at least, by landmarks.
static float estimate_by_landmarks(graph_search *s, uint32_t vertex)
{
    if (!s->has_goal_bounds) {
        tl_nav_bound_by_landmarks(s->graph, s->ends->goals, s->ends->goal_count, &s->goal_bounds);
        s->has_goal_bounds = true;
    }
    return tl_nav_min_by_landmarks(s->graph, &s->goal_bounds, vertex);
}

// The same by the straight line, from where the corner vertex is.
static float estimate_straight(const graph_search *s, float vertex_x, float vertex_z)
{
    double x = s->goal_x - (double)vertex_x;
    double z = s->goal_z - (double)vertex_z;
    return (float)sqrt(x * x + z * z) * (1.0f - TL_FLOAT_GAMMA(2));
}

static uint32_t new_stop(graph_search *s, uint32_t vertex)
{
    tl_nav_query *query = s->query;
    if (query->stop_count == query->max_nodes) {
        query->is_short = true;
        s->is_unclear = true;
        return TL_NAV_NO_NODE;
    }
    tl_nav_stop stop = { (double)INFINITY, -1.0, INFINITY, -1.0f, vertex, TL_NAV_NO_NODE, false, false };
    query->stops[query->stop_count] = stop;
    return query->stop_count++;
}

// The stop of a corner vertex in this search.
static uint32_t stop_at(graph_search *s, uint32_t vertex)
{
    bool found = false;
    tl_nav_root *root = tl_nav_find_root(s->query, vertex, &found);
    if (root == NULL) {
        s->query->is_short = true;
        s->is_unclear = true;
        return TL_NAV_NO_NODE;
    }
    if (!found) {
        root->stop = new_stop(s, vertex);
    }
    return root->stop;
}

static void open_stop(graph_search *s, uint32_t index)
{
    if (s->query->open_count == s->query->max_nodes) {
        s->query->is_short = true;
        s->is_unclear = true;
        return;
    }
    tl_nav_open_push(s->query, s->query->stops[index].total, index);
}

// Offers a way to a corner vertex, which is at (x, z). The corner vertex's stop when that is better than what was
// known.
static uint32_t relax_stop(graph_search *s, uint32_t vertex, float x, float z, double cost, uint32_t parent)
{
    uint32_t index = stop_at(s, vertex);
    if (index == TL_NAV_NO_NODE) {
        return index;
    }
    tl_nav_stop *stop = &s->query->stops[index];
    if (!(cost < stop->cost)) {
        return TL_NAV_NO_NODE;
    }
    stop->estimate = stop->estimate < 0.0f ? estimate_straight(s, x, z) : stop->estimate;
    stop->cost = cost;
    stop->parent = parent;
    stop->total = (float)(cost + (double)stop->estimate);
    // What is asked of it when it is its turn.
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k += CACHE_LINE / sizeof **s->graph->landmarks) {
        tl_prefetch(&s->graph->landmarks[vertex][k]);
    }
    tl_prefetch(&s->graph->vertices[vertex]);
    return index;
}

static tl_nav_line make_line(const graph_search *s, double x, double z, double to_x, double to_z)
{
    const tl_nav_shortest_search *in = s->in;
    tl_nav_line line = { in->navmesh, x, z, to_x - x, to_z - z, 0, in->goal_slot, in->goal_polygon, s->rounding };
    return line;
}

static bool sees_end(graph_search *s, const tl_nav_line *line, uint32_t slot, uint32_t polygon)
{
    tl_nav_line_end end = tl_nav_walk_line(line, slot, polygon, NULL);
    s->is_unclear = s->is_unclear || end == TL_NAV_LINE_UNCLEAR;
    return end == TL_NAV_LINE_ARRIVES;
}

// The corner vertices from which the last leg may go, each with its length.
static void prepare_goal(graph_search *s)
{
    for (uint32_t i = 0; i < s->ends->goal_count && !s->is_unclear; i++) {
        const tl_nav_corner_vertex *vertex = &s->graph->vertices[s->ends->goals[i].vertex];
        uint32_t stop = stop_at(s, s->ends->goals[i].vertex);
        if (stop != TL_NAV_NO_NODE) {
            double x = (double)vertex->x - s->goal_x;
            double z = (double)vertex->z - s->goal_z;
            double length = sqrt(x * x + z * z);
            s->query->stops[stop].to_goal = length;
            s->query->stops[stop].estimate = (float)length * (1.0f - TL_FLOAT_GAMMA(2));
        }
    }
}

static void open_start(graph_search *s)
{
    for (uint32_t i = 0; i < s->ends->start_count && !s->is_unclear; i++) {
        const tl_nav_corner_vertex *vertex = &s->graph->vertices[s->ends->starts[i].vertex];
        // Not the corner vertex's own stop: whether it is seen is not known for certain yet.
        uint32_t index = new_stop(s, s->ends->starts[i].vertex);
        if (index != TL_NAV_NO_NODE) {
            tl_nav_stop *stop = &s->query->stops[index];
            double x = (double)vertex->x - s->start_x;
            double z = (double)vertex->z - s->start_z;
            stop->cost = sqrt(x * x + z * z);
            stop->estimate = estimate_straight(s, vertex->x, vertex->z);
            stop->is_start = true;
            stop->total = (float)(stop->cost + (double)stop->estimate);
            open_stop(s, index);
        }
    }
}

// A path that came along (x, z) and may turn to these turns: whether it may go on along (to_x, to_z).
static bool may_go_on(const graph_search *s, uint32_t turns, double x, double z, double to_x, double to_z)
{
    double turn = x * to_z - z * to_x;
    double slack = 2.0 * s->rounding * (fabs(x) + fabs(z) + fabs(to_x) + fabs(to_z));
    return (turn >= -slack || (turns & TL_NAV_TURN_LEFT) != 0) && (turn <= slack || (turns & TL_NAV_TURN_RIGHT) != 0);
}

static void expand_stop(graph_search *s, uint32_t index)
{
    const tl_nav_stop stop = s->query->stops[index];
    const tl_nav_corner_vertex *vertex = &s->graph->vertices[stop.vertex];
    const tl_nav_corner_vertex *from =
        stop.parent != TL_NAV_NO_NODE ? &s->graph->vertices[s->query->stops[stop.parent].vertex] : NULL;
    double x = (double)vertex->x - (from != NULL ? (double)from->x : s->start_x);
    double z = (double)vertex->z - (from != NULL ? (double)from->z : s->start_z);
    uint32_t turns = tl_nav_turns_at(vertex, x, z, s->rounding);
    for (uint32_t k = 0; k < vertex->edge_count; k++) {
        const tl_nav_visibility_edge *edge = &vertex->edges[k];
        double on_x = (double)edge->x - (double)vertex->x;
        double on_z = (double)edge->z - (double)vertex->z;
        if (!may_go_on(s, turns, x, z, on_x, on_z)) {
            continue;
        }
        uint32_t next = relax_stop(s, edge->to, edge->x, edge->z, stop.cost + sqrt(on_x * on_x + on_z * on_z), index);
        if (next != TL_NAV_NO_NODE) {
            open_stop(s, next);
        }
    }
    if (stop.to_goal >= 0.0 &&
        may_go_on(s, turns, x, z, s->goal_x - (double)vertex->x, s->goal_z - (double)vertex->z)) {
        uint32_t goal = new_stop(s, GOAL_VERTEX);
        if (goal != TL_NAV_NO_NODE) {
            tl_nav_stop *last = &s->query->stops[goal];
            last->cost = stop.cost + stop.to_goal;
            last->total = (float)last->cost;
            last->parent = index;
            open_stop(s, goal);
        }
    }
}

// Whether the last leg leads from its corner vertex to the goal.
static bool arrives(graph_search *s, const tl_nav_stop *goal)
{
    const tl_nav_corner_vertex *vertex = &s->graph->vertices[s->query->stops[goal->parent].vertex];
    tl_nav_line line = make_line(s, (double)vertex->x, (double)vertex->z, s->goal_x, s->goal_z);
    tl_nav_ring_place fan[TL_NAV_MAX_FAN];
    uint32_t count = tl_nav_fan_of(s->in->navmesh, vertex, fan);
    for (uint32_t i = 0; i < count; i++) {
        if (tl_nav_line_enters(&line, &fan[i]) && sees_end(s, &line, fan[i].slot, fan[i].polygon)) {
            return true;
        }
    }
    return false;
}

// Whether the start sees the corner vertex of a stop that was opened for it.
static bool departs(graph_search *s, const tl_nav_stop *stop)
{
    const tl_nav_corner_vertex *vertex = &s->graph->vertices[stop->vertex];
    tl_nav_line line = make_line(s, s->start_x, s->start_z, (double)vertex->x, (double)vertex->z);
    line.turn = vertex->turn;
    return sees_end(s, &line, s->in->start_slot, s->in->start_polygon);
}

static void prefetch_edges(const tl_nav_corner_vertex *vertex)
{
    for (uint32_t k = 0; k < vertex->edge_count; k += CACHE_LINE / sizeof *vertex->edges) {
        tl_prefetch(&vertex->edges[k]);
    }
}

// Raises a stop's estimate by landmarks, which are asked when it comes to the top. Whether it was raised.
static bool raise_estimate(graph_search *s, uint32_t index)
{
    tl_nav_stop *stop = &s->query->stops[index];
    if (stop->has_asked_landmarks) {
        return false;
    }
    stop->has_asked_landmarks = true;
    float better = estimate_by_landmarks(s, stop->vertex);
    if (!(better > stop->estimate)) {
        return false;
    }
    stop->estimate = better;
    stop->total = (float)(stop->cost + (double)better);
    prefetch_edges(&s->graph->vertices[stop->vertex]);
    return true;
}

// Expands stops, the lowest total first, until the goal is one. TL_NAV_NO_NODE: it gave up.
static uint32_t run_stops(graph_search *s)
{
    tl_nav_query *query = s->query;
    while (query->open_count > 0 && !s->is_unclear) {
        tl_nav_open_item next = tl_nav_open_pop(query);
        const tl_nav_stop *stop = &query->stops[next.index];
        if (next.total != stop->total) {
            continue; // it was reached in a shorter way since
        }
        if (stop->vertex == GOAL_VERTEX) {
            if (arrives(s, stop)) {
                return next.index;
            }
        } else if (raise_estimate(s, next.index)) {
            open_stop(s, next.index);
        } else if (stop->is_start) {
            if (departs(s, stop)) {
                const tl_nav_corner_vertex *vertex = &s->graph->vertices[stop->vertex];
                uint32_t seen = relax_stop(s, stop->vertex, vertex->x, vertex->z, stop->cost, TL_NAV_NO_NODE);
                if (seen != TL_NAV_NO_NODE) {
                    expand_stop(s, seen);
                }
            }
        } else {
            expand_stop(s, next.index);
        }
    }
    return TL_NAV_NO_NODE;
}

bool tl_nav_search_graph(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph, const tl_nav_ends *ends,
                         const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out)
{
    graph_search s;
    tl_nav_query *query = search->query;
    s.in = search;
    s.query = query;
    s.graph = graph;
    s.start_x = (double)search->start.x;
    s.start_z = (double)search->start.z;
    s.goal_x = (double)search->goal.x;
    s.goal_z = (double)search->goal.z;
    s.is_unclear = false;
    s.has_goal_bounds = false;
    s.ends = ends;
    s.rounding = tl_nav_line_rounding(search, graph);
    query->stop_count = 0;
    query->open_count = 0;
    prepare_goal(&s);
    open_start(&s);
    uint32_t last = run_stops(&s);
    if (last == TL_NAV_NO_NODE || s.is_unclear) {
        return false;
    }
    search->lower_bound = (double)query->stops[last].total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING);
    // The search is over: its heap gives way to the path.
    uint32_t count = 0;
    for (uint32_t stop = query->stops[last].parent; stop != TL_NAV_NO_NODE; stop = query->stops[stop].parent) {
        query->on_path[count++] = query->stops[stop].vertex;
    }
    bool is_written = tl_nav_write_graph_path(search, graph, query->on_path, count, room, path_out) == UINT32_MAX;
    path_out->node_count = query->stop_count;
    return is_written;
}
