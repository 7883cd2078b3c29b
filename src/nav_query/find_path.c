// SPDX-License-Identifier: MIT
//
// Paths as polygons: the shortest where every metre costs the same (shortest_search.c), else A* over the ways into
// polygons.
//
// A node is a way into a polygon (a portal, crossed in one direction), not a polygon: where a polygon is entered
// decides what crossing it costs. A portal is entered where the way from the point before, over the portal, to the goal
// is shortest. The middle of the portal is the usual choice; it makes the graph fixed and the path provably the
// cheapest in it, but that graph knows little of real lengths where polygons are large. Measured on eight levels
// against Detour, which takes the middles too: paths through middles are 0.05% longer on average than Detour's, these
// are 0.4% shorter, and 6 to 12% shorter at the best hundredth. What is given up is the proof: a point depends on the
// path that led there, so a node that is closed may have been reachable by a slightly cheaper one. Source: Hart,
// Nilsson, Raphael, A Formal Basis for the Heuristic Determination of Minimum Cost Paths, 1968. The crossing is
// Heron's: reflect the goal in the portal's line and go straight.

#include "base/assert.h"
#include "nav_query/filter.h"
#include "nav_query/navmesh.h"
#include "nav_query/node_pool.h"
#include "nav_query/shortest_search.h"
#include "nav_query/surface.h"

// Keys of the two nodes that are no ways. A slot is below 2^20, so no way has them.
#define START_KEY UINT64_MAX
#define GOAL_KEY  (UINT64_MAX - 1u)

typedef struct path_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    float least_cost; // of a metre
    uint32_t goal_slot, goal_polygon;
    tl_vec3 goal;
    bool out_of_nodes;
} path_search;

// Offers a way to reach a node. `from` is TL_NAV_NO_NODE for the start.
static void relax(path_search *search, uint64_t key, uint32_t slot, uint32_t polygon, tl_vec3 point, float cost,
                  uint32_t from)
{
    uint32_t index = tl_nav_pool_get(search->query, key);
    if (index == TL_NAV_NO_NODE) {
        search->out_of_nodes = true;
        return;
    }
    tl_nav_node *node = &search->query->nodes[index];
    if (node->heap_at == TL_NAV_NODE_CLOSED || (node->heap_at != TL_NAV_NODE_NEW && cost >= node->cost)) {
        return;
    }
    node->slot = slot;
    node->polygon = polygon;
    node->point = point;
    node->cost = cost;
    node->total = cost + search->least_cost * tl_distance(point, search->goal);
    node->parent = from;
    tl_nav_heap_improve(search->query, index);
}

// Where the shortest way from `from` over the portal to `goal` crosses it, in the plane. With both on the line of the
// portal that is the point of it nearest to the goal.
static tl_vec3 crossing_point(tl_vec3 from, tl_vec3 goal, const tl_nav_way *way)
{
    double ux = (double)way->left.x - (double)way->right.x;
    double uz = (double)way->left.z - (double)way->right.z;
    double from_x = (double)from.x - (double)way->right.x;
    double from_z = (double)from.z - (double)way->right.z;
    double goal_x = (double)goal.x - (double)way->right.x;
    double goal_z = (double)goal.z - (double)way->right.z;
    // Places along the portal and distances from its line, all times its length.
    double from_along = from_x * ux + from_z * uz;
    double goal_along = goal_x * ux + goal_z * uz;
    double from_off = fabs(from_x * uz - from_z * ux);
    double goal_off = fabs(goal_x * uz - goal_z * ux);
    double off = from_off + goal_off;
    double along = off > 0.0 ? from_along + (goal_along - from_along) * (from_off / off) : goal_along;
    double length_sq = ux * ux + uz * uz;
    if (!(along > 0.0)) {
        return way->right;
    }
    return along >= length_sq ? way->left : tl_lerp(way->right, way->left, (float)(along / length_sq));
}

static void expand(path_search *search, uint32_t index)
{
    const tl_nav_node node = search->query->nodes[index];
    const tl_nav_tile *tile = search->navmesh->slots[node.slot].tile;
    float metre = search->filter != NULL ? search->filter->area_cost[tl_nav_tile_area(tile, node.polygon)] : 1.0f;
    if (node.slot == search->goal_slot && node.polygon == search->goal_polygon) {
        relax(search, GOAL_KEY, node.slot, node.polygon, search->goal,
              node.cost + metre * tl_distance(node.point, search->goal), index);
    }
    const tl_nav_node *parent = node.parent != TL_NAV_NO_NODE ? &search->query->nodes[node.parent] : NULL;
    tl_nav_ways ways = tl_nav_ways_of(search->navmesh, node.slot, node.polygon);
    tl_nav_way way;
    while (tl_nav_ways_next(&ways, &way)) {
        // Polygons are convex: to go back to the one we come from never pays.
        if (parent != NULL && way.polygon == parent->polygon && way.slot == parent->slot) {
            continue;
        }
        if (!tl_nav_passes(search->filter, search->navmesh->slots[way.slot].tile, way.polygon)) {
            continue;
        }
        tl_vec3 point = crossing_point(node.point, search->goal, &way);
        relax(search, way.key, way.slot, way.polygon, point, node.cost + metre * tl_distance(node.point, point), index);
    }
}

// The squared distance in the plane from the goal to the box of a polygon's corners.
static float bound_to_goal(const path_search *search, const tl_nav_node *node)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(search->navmesh->slots[node->slot].tile, node->polygon, &count);
    tl_aabb box = { corners[0], corners[0] };
    for (uint32_t i = 1; i < count; i++) {
        box = tl_aabb_add_point(box, corners[i]);
    }
    tl_vec3 gap = tl_sub(tl_min(tl_max(search->goal, box.min), box.max), search->goal);
    return gap.x * gap.x + gap.z * gap.z;
}

// The node whose polygon comes nearest to the goal, by the distance to its closest point; ties to the cheaper one, then
// to the lower index.
static uint32_t nearest_to_goal(const path_search *search, tl_vec3 *point_out)
{
    const tl_nav_node *nodes = search->query->nodes;
    uint32_t best = 0;
    float best_sq = INFINITY;
    for (uint32_t i = 0; i < search->query->node_count; i++) {
        const tl_nav_node *node = &nodes[i];
        if (i > 0 && node->slot == nodes[best].slot && node->polygon == nodes[best].polygon) {
            best = node->cost < nodes[best].cost ? i : best;
            continue;
        }
        if (bound_to_goal(search, node) > best_sq) {
            continue;
        }
        bool inside = false;
        tl_vec3 point =
            tl_nav_closest_on_surface(search->navmesh->slots[node->slot].tile, node->polygon, search->goal, &inside);
        float distance_sq = tl_distance_sq(point, search->goal);
        if (distance_sq < best_sq || (distance_sq == best_sq && node->cost < nodes[best].cost)) {
            best = i;
            best_sq = distance_sq;
            *point_out = point;
        }
    }
    return best;
}

static tl_result write_path(const path_search *search, uint32_t last, tl_nav_ref *polygons_out, uint32_t capacity,
                            tl_nav_path *path_out)
{
    const tl_nav_node *nodes = search->query->nodes;
    // The goal's node stands in the polygon of its parent.
    uint32_t end = nodes[last].key == GOAL_KEY ? nodes[last].parent : last;
    uint32_t count = 0;
    for (uint32_t i = end; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        count++;
    }
    uint32_t at = count;
    for (uint32_t i = end; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        at--;
        if (at < capacity) {
            polygons_out[at] = tl_nav_make_ref(search->navmesh, nodes[i].slot, nodes[i].polygon);
        }
    }
    path_out->polygon_count = count;
    path_out->cost = nodes[last].cost;
    path_out->end.polygon = tl_nav_make_ref(search->navmesh, nodes[end].slot, nodes[end].polygon);
    path_out->node_count = search->query->node_count;
    return count <= capacity ? TL_OK : TL_ERR_CAPACITY;
}

// Runs to the goal's node, or until nothing is open or the pool is used up (TL_NAV_NO_NODE).
static uint32_t run(path_search *search)
{
    for (;;) {
        uint32_t index = tl_nav_heap_pop(search->query);
        if (index == TL_NAV_NO_NODE || search->query->nodes[index].key == GOAL_KEY) {
            return index;
        }
        expand(search, index);
        if (search->out_of_nodes) {
            return TL_NAV_NO_NODE;
        }
    }
}

static tl_result find_by_ways(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                              const tl_nav_location *start, const tl_nav_location *goal, float least_cost,
                              tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_path *path_out)
{
    path_search search = { query, navmesh, filter, least_cost, 0, 0, goal->point, false };
    uint32_t start_slot = 0;
    uint32_t start_polygon = 0;
    tl_nav_split_ref(navmesh, start->polygon, &start_slot, &start_polygon);
    tl_nav_split_ref(navmesh, goal->polygon, &search.goal_slot, &search.goal_polygon);
    tl_nav_pool_reset(query);
    relax(&search, START_KEY, start_slot, start_polygon, start->point, 0.0f, TL_NAV_NO_NODE);
    uint32_t last = run(&search);
    if (last != TL_NAV_NO_NODE) {
        path_out->status = TL_NAV_PATH_COMPLETE;
        path_out->end.point = goal->point;
    } else {
        path_out->status = search.out_of_nodes ? TL_NAV_PATH_OUT_OF_NODES : TL_NAV_PATH_UNREACHABLE;
        last = nearest_to_goal(&search, &path_out->end.point);
    }
    return write_path(&search, last, polygons_out, capacity, path_out);
}

// The start's polygon alone.
static tl_result write_stay(const tl_nav_location *start, tl_nav_ref *polygons_out, uint32_t capacity,
                            tl_nav_path *path_out)
{
    path_out->polygon_count = 1;
    path_out->end = *start;
    if (capacity == 0) {
        return TL_ERR_CAPACITY;
    }
    polygons_out[0] = start->polygon;
    return TL_OK;
}

static tl_result write_shortest(const tl_nav_shortest_search *search, const tl_nav_location *goal, float metre,
                                tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_path *path_out)
{
    path_out->status = TL_NAV_PATH_COMPLETE;
    path_out->end = *goal;
    path_out->cost = metre * (float)tl_nav_shortest_length(search);
    path_out->node_count = search->query->wedge_count;
    path_out->polygon_count = tl_nav_write_wedges(search, polygons_out, capacity);
    return path_out->polygon_count <= capacity ? TL_OK : TL_ERR_CAPACITY;
}

tl_result tl_nav_query_find_path(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                 const tl_nav_location *start, const tl_nav_location *goal, tl_nav_ref *polygons_out,
                                 uint32_t capacity, tl_nav_path *path_out)
{
    tl_nav_path none = { TL_NAV_PATH_UNREACHABLE, 0, { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } }, 0.0f, 0 };
    *path_out = none;
    float least = 1.0f;
    bool is_uniform = true;
    tl_nav_shortest_search search;
    TL_TRY(tl_nav_prepare_shortest(query, navmesh, filter, start, goal, &search));
    if (filter != NULL && !tl_nav_filter_costs(filter, &least, &is_uniform)) {
        return TL_ERR_ARGUMENT;
    }
    if (tl_nav_is_cut_off(&search)) {
        return write_stay(start, polygons_out, capacity, path_out);
    }
    if (is_uniform && tl_nav_search_shortest(&search) == TL_NAV_SEARCH_FOUND) {
        return write_shortest(&search, goal, least, polygons_out, capacity, path_out);
    }
    // Also where the search above has found none: the flags forbid it, and this one tells how far they let go; or it
    // was out of nodes, of which this one needs fewer.
    return find_by_ways(query, navmesh, filter, start, goal, least, polygons_out, capacity, path_out);
}

const char *tl_nav_path_status_name(tl_nav_path_status status)
{
    static const char *const NAMES[] = { "complete", "unreachable", "out of nodes" };
    return (unsigned)status < TL_COUNT_OF(NAMES) ? NAMES[status] : "unknown";
}
