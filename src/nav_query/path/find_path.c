// SPDX-License-Identifier: MIT
//
// Paths as polygons: the shortest one where every metre costs the same (Polyanya, shortest_search.c), else A* over the
// ways into polygons.
//
// A node is a way into a polygon (a portal, crossed in one direction), not a polygon: where a polygon is entered
// decides what crossing it costs. A portal is entered where the way from the point before, over the portal, to the goal
// is shortest (crossing.h). The middle of the portal is the usual choice; it makes the graph fixed and the path
// provably the cheapest in it, but that graph knows little of real lengths where polygons are large. Measured on eight
// levels against Detour, which takes the middles too: paths through middles are 0.05% longer on average than Detour's,
// these are 0.4% shorter, and 6 to 12% shorter at the best hundredth. The price is the proof: a point depends on the
// path that led there, so a closed node may have been reachable by a slightly cheaper one. Source: Hart, Nilsson,
// Raphael, A Formal Basis for the Heuristic Determination of Minimum Cost Paths, 1968.

#include "base/assert.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/navmesh/ways.h"
#include "nav_query/path/path_run.h"
#include "nav_query/plane/crossing.h"
#include "nav_query/plane/surface.h"
#include "nav_query/prepared/graph_query.h"
#include "nav_query/search/node_pool.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// Keys of the two nodes that are not ways. A slot is below 2^20, so no way has them.
#define PATH_START_KEY UINT64_MAX
#define PATH_GOAL_KEY  (UINT64_MAX - 1u)
// Off-mesh links that were crossed: | the number of the end that was left.
#define CROSSED_KEY ((uint64_t)1 << 62)

// Offers a way to reach a node, which is `known` already, or not (TL_NAV_NO_NODE). Its parent is TL_NAV_NO_NODE for the
// start.
static inline void relax_known(tl_nav_way_search *search, uint32_t known, tl_nav_way_in way)
{
    if (way.cost == INFINITY) {
        return; // it cannot be crossed
    }
    tl_nav_node *node = tl_nav_pool_relax_known(search->query, known, way, &search->out_of_nodes);
    if (node != NULL) {
        const float straight = tl_distance(way.point, search->goal);
        const float rest = search->min_cost * (straight < search->detour ? straight : search->detour);
        // The order of the exact search (total_by, wedge_search.h); here ways that were closed stay as they are.
        const float proof = search->weight * (way.cost + rest);
        const float hurry = way.cost + (2.0f * search->weight - 1.0f) * rest;
        node->total = proof < hurry ? proof : hurry;
        tl_nav_heap_improve(search->query, (uint32_t)(node - search->query->nodes));
    }
}

static void relax_way(tl_nav_way_search *search, uint64_t key, uint32_t slot, uint32_t polygon, tl_vec3 point,
                      float cost, uint32_t from)
{
    const tl_nav_way_in way = { key, slot, polygon, point, cost, from };
    relax_known(search, tl_nav_pool_find(search->query, key), way);
}

// Where a straight way to the goal over a portal would cross it.
static inline tl_vec3 crossing_point(tl_nav_spot from, tl_nav_spot goal, tl_vec3 right, tl_vec3 left)
{
    const tl_nav_segment portal = { tl_nav_spot_of(right), tl_nav_spot_of(left) };
    return tl_lerp(right, left, (float)tl_nav_crossing_share(from, goal, portal));
}

// Crosses the off-mesh links that can be taken from a node's polygon.
static void relax_links(tl_nav_way_search *search, uint32_t index)
{
    const tl_navmesh *navmesh = search->navmesh;
    const tl_nav_node node = search->query->nodes[index];
    const tl_nav_tile *tile = navmesh->slots[node.slot].tile;
    for (uint32_t end = tl_nav_first_anchor(navmesh, node.slot, node.polygon); end != TL_NAV_NO_END;) {
        const tl_nav_offmesh_entry *link = &navmesh->offmesh.entries[end / 2];
        const tl_nav_anchor *from = &link->ends[end % 2];
        const tl_nav_anchor *to = &link->ends[1 - end % 2];
        if (from->slot == node.slot && from->polygon == node.polygon &&
            tl_nav_may_cross(link, end % 2, search->filter) &&
            tl_nav_passes(search->filter, navmesh->slots[to->slot].tile, to->polygon)) {
            float factor = search->filter != NULL ? search->filter->area_cost[link->offmesh.area] : 1.0f;
            float cost = tl_nav_cost_between(search->filter, tile, node.polygon, node.point, from->point);
            relax_way(search, CROSSED_KEY | end, to->slot, to->polygon, to->point,
                      node.cost + cost + factor * (float)link->cost, index);
        }
        end = from->next;
    }
}

static bool is_crossing(const tl_nav_node *node)
{
    return node->key >> 62 == CROSSED_KEY >> 62;
}

// A path that takes a short cut (a link that costs less than its length) still has the way from its end to the goal
// ahead.
static float min_shortcut_distance(const tl_nav_way_search *search)
{
    const tl_nav_offmesh_table *table = &search->navmesh->offmesh;
    float least = INFINITY;
    for (uint32_t i = 0; i < table->short_count; i++) {
        const tl_nav_offmesh_entry *link = &table->entries[table->short_cuts[i]];
        for (int end = link->offmesh.both_ways ? 0 : 1; end < 2; end++) {
            least = fminf(least, tl_distance(link->ends[end].point, search->goal));
        }
    }
    return least;
}

// What all ways out of a node's polygon over its edges have in common.
typedef struct way_step {
    uint32_t index;
    tl_nav_ring_seam here, before, goal_at; // before: from where it was entered
    tl_vec3 point;
    tl_nav_spot from, goal; // in the plane
    float cost;             // up to the point
    float metre_cost;       // in the polygon; where the filter has a function it is asked instead
    const tl_nav_filter *asked;
} way_step;

static inline way_step step_from_node(const tl_nav_way_search *search, uint32_t index)
{
    const tl_nav_node *node = &search->query->nodes[index];
    const tl_nav_filter *filter = search->filter;
    way_step step = { index,
                      { node->slot, node->polygon },
                      { TL_NAV_NO_SLOT, TL_NO_POLYGON },
                      { search->goal_slot, search->goal_polygon },
                      node->point,
                      tl_nav_spot_of(node->point),
                      tl_nav_spot_of(search->goal),
                      node->cost,
                      1.0f,
                      filter != NULL && filter->cost != NULL ? filter : NULL };
    // Polygons are convex: to go back to the one we come from never pays.
    if (node->parent != TL_NAV_NO_NODE && !is_crossing(node)) {
        step.before.slot = search->query->nodes[node->parent].slot;
        step.before.polygon = search->query->nodes[node->parent].polygon;
    }
    if (filter != NULL) {
        step.metre_cost = filter->area_cost[tl_nav_tile_area(search->navmesh->slots[node->slot].tile, node->polygon)];
    }
    return step;
}

static inline bool may_step(const tl_nav_way_search *search, const way_step *step, tl_nav_ring_seam to)
{
    return (to.polygon != step->before.polygon || to.slot != step->before.slot) &&
           !(search->leaves_out_branches && tl_nav_leads_astray(search->navmesh, step->here, to, step->goal_at)) &&
           (search->refuses == NULL ||
            tl_nav_passes(search->refuses, search->navmesh->slots[to.slot].tile, to.polygon));
}

// Goes over an edge of the node's polygon.
static inline void step_over_edge(tl_nav_way_search *search, const way_step *step, const tl_nav_ring *ring,
                                  uint32_t edge, uint64_t key)
{
    const tl_nav_ring_seam to = tl_nav_ring_across(search->navmesh, step->here.slot, tl_nav_ring_to(ring, edge));
    if (!may_step(search, step, to)) {
        return;
    }
    const uint32_t known = tl_nav_pool_find(search->query, key);
    // No way from here costs less than nothing.
    if (known != TL_NAV_NO_NODE &&
        (search->query->nodes[known].heap_at == TL_NAV_NODE_CLOSED || search->query->nodes[known].cost <= step->cost)) {
        return;
    }
    const tl_vec3 left = ring->points[edge + 1 < ring->count ? edge + 1 : 0];
    const tl_vec3 point = crossing_point(step->from, step->goal, ring->points[edge], left);
    const float across = step->asked == NULL
                             ? step->metre_cost * tl_distance(step->point, point)
                             : tl_nav_cost_between(step->asked, search->navmesh->slots[step->here.slot].tile,
                                                   step->here.polygon, step->point, point);
    const tl_nav_way_in way = { key, to.slot, to.polygon, point, step->cost + across, step->index };
    relax_known(search, known, way);
}

static void expand_way(tl_nav_way_search *search, uint32_t index)
{
    const way_step step = step_from_node(search, index);
    const tl_nav_slot *slot = &search->navmesh->slots[step.here.slot];
    if (step.here.slot == search->goal_slot && step.here.polygon == search->goal_polygon) {
        const float cost = tl_nav_cost_between(search->filter, slot->tile, step.here.polygon, step.point, search->goal);
        relax_way(search, PATH_GOAL_KEY, step.here.slot, step.here.polygon, search->goal, step.cost + cost, index);
    }
    if (slot->anchor_count > 0) {
        relax_links(search, index);
    }
    const tl_nav_ring ring = tl_nav_ring_of(&slot->rings, step.here.polygon);
    const uint64_t first = tl_nav_way_key(step.here.slot, ring.first);
    for (uint32_t i = 0; i < ring.count; i++) {
        if (tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            step_over_edge(search, &step, &ring, i, first + i);
        }
    }
}

// Continues until the goal is closed, or nothing is open, or the pool or the steps are used up.
static tl_nav_path_status step_by_ways(tl_nav_way_search *search, uint64_t *steps)
{
    for (; *steps > 0; --*steps) {
        uint32_t index = tl_nav_heap_pop(search->query);
        if (index == TL_NAV_NO_NODE) {
            return TL_NAV_PATH_UNREACHABLE;
        }
        if (search->query->nodes[index].key == PATH_GOAL_KEY) {
            search->last = index;
            return TL_NAV_PATH_COMPLETE;
        }
        expand_way(search, index);
        if (search->out_of_nodes) {
            return TL_NAV_PATH_OUT_OF_NODES;
        }
    }
    return TL_NAV_PATH_UNFINISHED;
}

static void begin_by_ways(tl_nav_path_run *run, bool leaves_out_branches)
{
    tl_nav_way_search *search = &run->ways;
    search->detour = min_shortcut_distance(search);
    search->out_of_nodes = false;
    search->leaves_out_branches = leaves_out_branches;
    tl_nav_pool_reset(search->query);
    relax_way(search, PATH_START_KEY, run->exact.start_slot, run->exact.start_polygon, run->start.point, 0.0f,
              TL_NAV_NO_NODE);
    run->stage = TL_NAV_RUN_WAYS;
}

// ---------------------------------------------------------------------------------------------------------
// As near to the goal as a search has come: nodes of either search, by number.

typedef struct seen_polygon {
    uint32_t slot, polygon;
    double cost; // metres times area costs from the start, at least
} seen_polygon;

static seen_polygon seen_at(const tl_nav_path_run *run, uint32_t i)
{
    const tl_nav_query *query = run->ways.query;
    seen_polygon seen;
    if (run->stage == TL_NAV_RUN_EXACT) {
        seen.slot = query->wedges[i].slot;
        seen.polygon = query->wedges[i].polygon;
        seen.cost = query->wedges[i].cost;
    } else {
        seen.slot = query->nodes[i].slot;
        seen.polygon = query->nodes[i].polygon;
        seen.cost = (double)query->nodes[i].cost;
    }
    return seen;
}

// The squared distance in the plane from the goal to the box of a polygon's corners.
static float bound_to_goal(const tl_nav_path_run *run, const seen_polygon *seen)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(run->ways.navmesh->slots[seen->slot].tile, seen->polygon, &count);
    tl_aabb box = { corners[0], corners[0] };
    for (uint32_t i = 1; i < count; i++) {
        box = tl_aabb_add_point(box, corners[i]);
    }
    tl_vec3 gap = tl_sub(tl_min(tl_max(run->goal.point, box.min), box.max), run->goal.point);
    return gap.x * gap.x + gap.z * gap.z;
}

// The node whose polygon comes nearest to the goal, by the distance to its closest point; ties to the cheaper one, then
// to the lower index.
static uint32_t nearest_to_goal(const tl_nav_path_run *run, tl_vec3 *point_out)
{
    const tl_nav_query *query = run->ways.query;
    uint32_t count = run->stage == TL_NAV_RUN_EXACT ? query->wedge_count : query->node_count;
    uint32_t best = 0;
    float best_sq = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        seen_polygon seen = seen_at(run, i);
        seen_polygon best_seen = seen_at(run, best);
        if (i > 0 && seen.slot == best_seen.slot && seen.polygon == best_seen.polygon) {
            best = seen.cost < best_seen.cost ? i : best;
            continue;
        }
        if (bound_to_goal(run, &seen) > best_sq) {
            continue;
        }
        bool inside = false;
        tl_vec3 point =
            tl_nav_closest_on_surface(run->ways.navmesh->slots[seen.slot].tile, seen.polygon, run->goal.point, &inside);
        float distance_sq = tl_distance_sq(point, run->goal.point);
        if (distance_sq < best_sq || (distance_sq == best_sq && seen.cost < best_seen.cost)) {
            best = i;
            best_sq = distance_sq;
            *point_out = point;
        }
    }
    return best;
}

// ---------------------------------------------------------------------------------------------------------
// What the caller gets.

static void write_ways(const tl_nav_way_search *search, uint32_t last, tl_nav_ref *polygons_out, uint32_t capacity,
                       tl_nav_path *path_out)
{
    const tl_nav_node *nodes = search->query->nodes;
    // The goal's node stands in the polygon of its parent.
    uint32_t end = nodes[last].key == PATH_GOAL_KEY ? nodes[last].parent : last;
    uint32_t count = 0;
    for (uint32_t i = end; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        count += is_crossing(&nodes[i]) ? 2 : 1;
    }
    uint32_t at = count;
    for (uint32_t i = end; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        at--;
        if (at < capacity) {
            polygons_out[at] = tl_nav_make_ref(search->navmesh, nodes[i].slot, nodes[i].polygon);
        }
        if (is_crossing(&nodes[i]) && --at < capacity) {
            polygons_out[at] = tl_nav_offmesh_ref(&search->navmesh->offmesh, (uint32_t)nodes[i].key);
        }
    }
    path_out->polygon_count = count;
    path_out->cost = nodes[last].cost;
    path_out->end.polygon = tl_nav_make_ref(search->navmesh, nodes[end].slot, nodes[end].polygon);
    path_out->node_count = search->query->node_count;
}

static void write_exact(const tl_nav_path_run *run, uint32_t last, tl_nav_ref *polygons_out, uint32_t capacity,
                        tl_nav_path *path_out)
{
    tl_nav_shortest_search search = run->exact;
    const tl_nav_wedge *wedge = &search.query->wedges[last];
    if (run->status != TL_NAV_PATH_COMPLETE) {
        // As if the root saw the point: no path there is shorter.
        search.last = last;
        search.goal = path_out->end.point;
        path_out->end.polygon = tl_nav_make_ref(search.navmesh, wedge->slot, wedge->polygon);
    }
    path_out->cost = run->ways.min_cost * (float)tl_nav_shortest_length(&search);
    path_out->node_count = search.query->wedge_count;
    path_out->polygon_count = tl_nav_write_wedge_polygons(&search, polygons_out, capacity);
}

tl_result tl_nav_run_write(const tl_nav_path_run *run, tl_nav_ref *polygons_out, uint32_t capacity,
                           tl_nav_path *path_out)
{
    path_out->status = run->status;
    path_out->end = run->goal;
    if (run->stage == TL_NAV_RUN_CUT_OFF) {
        path_out->polygon_count = 1;
        path_out->end = run->start;
        if (capacity > 0) {
            polygons_out[0] = run->start.polygon;
        }
    } else if (run->stage == TL_NAV_RUN_EXACT) {
        bool found = run->status == TL_NAV_PATH_COMPLETE;
        uint32_t last = found ? run->exact.last : nearest_to_goal(run, &path_out->end.point);
        write_exact(run, last, polygons_out, capacity, path_out);
    } else {
        bool found = run->status == TL_NAV_PATH_COMPLETE;
        uint32_t last = found ? run->ways.last : nearest_to_goal(run, &path_out->end.point);
        write_ways(&run->ways, last, polygons_out, capacity, path_out);
    }
    return path_out->polygon_count <= capacity ? TL_OK : TL_INCOMPLETE;
}

// ---------------------------------------------------------------------------------------------------------
// The run: the shortest path where every metre costs the same. Then, or where that has found none (the flags forbid it,
// and A* tells how far they let go; or it was out of nodes, of which A* needs fewer), A*.

static void note_exact_end(tl_nav_path_run *run, tl_nav_search_end end)
{
    while (end == TL_NAV_SEARCH_OUT_OF_NODES && tl_nav_query_grow(run->exact.query)) {
        end = tl_nav_begin_shortest(&run->exact);
    }
    if (end == TL_NAV_SEARCH_FOUND) {
        run->status = TL_NAV_PATH_COMPLETE;
    } else if (end != TL_NAV_SEARCH_PAUSED) {
        begin_by_ways(run, false);
    }
}

static void note_ways_end(tl_nav_path_run *run, tl_nav_path_status end)
{
    const bool leaves_out_branches = run->ways.leaves_out_branches;
    if (end == TL_NAV_PATH_OUT_OF_NODES && tl_nav_query_grow(run->ways.query)) {
        begin_by_ways(run, leaves_out_branches);
    } else if (end == TL_NAV_PATH_UNREACHABLE && leaves_out_branches) {
        begin_by_ways(run, false); // how far it can be gone, into branches too
    } else {
        run->status = end;
    }
}

static tl_result set_up(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                        tl_nav_path_run *run, bool *is_uniform_out)
{
    const tl_nav_filter *filter = request->filter;
    float least = 1.0f;
    *is_uniform_out = true;
    run->stage = TL_NAV_RUN_NONE;
    TL_TRY(tl_nav_prepare_shortest(query, navmesh, request, &run->exact));
    if (filter != NULL && !tl_nav_filter_costs_again(&query->known_costs, filter, &least, is_uniform_out)) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_way_search ways = { query,
                               navmesh,
                               filter,
                               run->exact.filter,
                               least,
                               (float)run->exact.weight,
                               run->exact.goal_slot,
                               run->exact.goal_polygon,
                               request->goal.point,
                               INFINITY,
                               false,
                               TL_NAV_NO_NODE,
                               false };
    run->ways = ways;
    run->start = request->start;
    run->goal = request->goal;
    run->status = TL_NAV_PATH_UNFINISHED;
    run->edits = navmesh->edit.number;
    return TL_OK;
}

static void begin_run(tl_nav_path_run *run, bool is_uniform)
{
    if (tl_nav_is_cut_off(&run->exact)) {
        run->stage = TL_NAV_RUN_CUT_OFF;
        run->status = TL_NAV_PATH_UNREACHABLE;
    } else if (is_uniform) {
        run->stage = TL_NAV_RUN_EXACT;
        note_exact_end(run, tl_nav_begin_shortest(&run->exact));
    } else {
        begin_by_ways(run, true);
    }
}

tl_result tl_nav_run_begin(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                           tl_nav_path_run *run)
{
    bool is_uniform = true;
    TL_TRY(set_up(query, navmesh, request, run, &is_uniform));
    begin_run(run, is_uniform);
    return TL_OK;
}

void tl_nav_run_step(tl_nav_path_run *run, uint64_t *steps)
{
    while (*steps > 0 && run->status == TL_NAV_PATH_UNFINISHED) {
        if (run->stage == TL_NAV_RUN_EXACT) {
            note_exact_end(run, tl_nav_step_shortest(&run->exact, steps));
        } else {
            note_ways_end(run, step_by_ways(&run->ways, steps));
        }
    }
}

// The path by the visibility graph, where there is one.
static bool find_over_graph(tl_nav_path_run *run, tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_path *path_out)
{
    const tl_nav_visibility_graph *graph = tl_nav_visibility_graph_for(&run->exact);
    const tl_nav_path_buffers buffers = { polygons_out, capacity, NULL, 0 };
    tl_nav_shortest_path path;
    memset(&path, 0, sizeof path);
    if (graph == NULL || !tl_nav_find_over_graph(&run->exact, graph, &buffers, &path)) {
        return false;
    }
    path_out->status = TL_NAV_PATH_COMPLETE;
    path_out->end = run->goal;
    path_out->cost = run->ways.min_cost * (float)path.length;
    path_out->node_count = path.node_count;
    path_out->polygon_count = path.polygon_count;
    return true;
}

tl_result tl_nav_query_find_path(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                                 tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_path *path_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || path_out == NULL ||
        (polygons_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    tl_nav_path_run run;
    bool is_uniform = true;
    TL_TRY(set_up(query, navmesh, request, &run, &is_uniform));
    if (is_uniform && !tl_nav_is_cut_off(&run.exact) && find_over_graph(&run, polygons_out, capacity, path_out)) {
        return path_out->polygon_count <= capacity ? TL_OK : TL_INCOMPLETE;
    }
    begin_run(&run, is_uniform);
    uint64_t steps = UINT64_MAX;
    tl_nav_run_step(&run, &steps);
    return tl_nav_run_write(&run, polygons_out, capacity, path_out);
}

const char *tl_nav_path_status_name(tl_nav_path_status status)
{
    static const char *const NAMES[] = { "none", "complete", "unreachable", "out of nodes", "unfinished", "stale" };
    return (unsigned)status < TL_COUNT_OF(NAMES) ? NAMES[status] : "unknown";
}
