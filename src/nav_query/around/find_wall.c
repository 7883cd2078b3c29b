// SPDX-License-Identifier: MIT
//
// The nearest wall: polygons are visited in the order of the distance to the edge by which they are entered, until none
// is nearer than the nearest wall. That is Dijkstra's order, but the distance to an edge needs no path.
//
// Up to the nearest wall there is no wall, so all that lies nearer can be reached in a straight line and is visited in
// that order: a polygon entered at a distance has nothing nearer. Where it seems to, the way there has turned around
// the end of a wall and come back above or below the place, as a ramp to the next floor does: that does not count.

#include "nav_query/plane/nearest_on_edge.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/local_search.h"
#include "nav_query/search/open_items.h"
#include "nav_query/search/query_memory.h"

#include <math.h>
#include <string.h>

typedef struct wall_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    double x, z;
    double best_sq;
    double best_t;
    const tl_vec3 *start, *end; // of the nearest wall; NULL: none yet
    uint32_t slot, polygon;     // that it belongs to
    bool full;
    bool all_pass;   // the filter refuses nothing
    double rounding; // metres in the plane by which two edges over one place may differ
} wall_search;

// Offers a way into a polygon at a distance: the polygon is visited again where that is nearer than all before.
static void offer_polygon(wall_search *search, tl_nav_ring_seam to, double distance_sq)
{
    tl_nav_query *query = search->query;
    bool found = false;
    const uint64_t number = tl_nav_polygon_number(to.slot, to.polygon);
    tl_nav_root *root = tl_nav_probe_roots(query, number, &found);
    if (found && (float)distance_sq >= root->cost) {
        return;
    }
    if (query->wedge_count == query->max_nodes) {
        search->full = true;
        return;
    }
    // There are no more polygons in the table than nodes: it is never full.
    root = tl_nav_find_root(query, number, &found);
    root->cost = (float)distance_sq;
    tl_nav_local_node *node = &query->local_nodes[query->wedge_count];
    node->slot = to.slot;
    node->polygon = to.polygon;
    node->cost = distance_sq;
    tl_nav_open_push(query, root->cost, query->wedge_count++);
}

static void look_for_wall(wall_search *search, uint32_t node)
{
    uint32_t slot = search->query->local_nodes[node].slot;
    uint32_t polygon = search->query->local_nodes[node].polygon;
    double entry = sqrt(search->query->local_nodes[node].cost) - search->rounding;
    double min_sq = entry > 0.0 ? entry * entry : 0.0;
    const tl_nav_ring ring = tl_nav_ring_at(search->navmesh, slot, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        tl_nav_plan_point nearest = tl_nav_nearest_on_edge(&ring.points[i], end, search->x, search->z);
        if (nearest.distance_sq >= search->best_sq || nearest.distance_sq < min_sq ||
            tl_nav_ring_to(&ring, i) == TL_NAV_RING_BACK) {
            continue;
        }
        if (tl_nav_ring_to(&ring, i) != TL_NAV_RING_WALL) {
            tl_nav_ring_seam to = tl_nav_ring_across(search->navmesh, slot, tl_nav_ring_to(&ring, i));
            if (search->all_pass || tl_nav_passes(search->filter, search->navmesh->slots[to.slot].tile, to.polygon)) {
                offer_polygon(search, to, nearest.distance_sq);
                continue;
            }
        }
        search->best_sq = nearest.distance_sq;
        search->best_t = nearest.t;
        search->start = &ring.points[i];
        search->end = end;
        search->slot = slot;
        search->polygon = polygon;
    }
}

// Within the nodes that the query has now.
static tl_result find_wall_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_around_request *request,
                                  tl_nav_wall *wall_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || wall_out == NULL ||
        !tl_nav_filter_is_begun(request->filter)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_filter *filter = request->filter;
    const tl_nav_location *center = &request->center;
    const float max_radius = request->radius;
    memset(wall_out, 0, sizeof *wall_out);
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_is_finite(center->point) || !isfinite(max_radius)) {
        return TL_ERR_NOT_FINITE;
    }
    if (max_radius < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, center->polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    double radius_sq = (double)max_radius * (double)max_radius;
    wall_search search = { query,
                           navmesh,
                           filter,
                           (double)center->point.x,
                           (double)center->point.z,
                           radius_sq,
                           0.0,
                           NULL,
                           NULL,
                           slot,
                           polygon,
                           false,
                           tl_nav_all_pass(navmesh, filter),
                           0.0 };
    search.rounding = (double)TL_FLOAT_GAMMA(6) * (fabs(search.x) + fabs(search.z) + (double)max_radius);
    tl_nav_local_begin(query);
    tl_nav_ring_seam home = { slot, polygon };
    offer_polygon(&search, home, 0.0);
    while (query->open_count > 0) {
        tl_nav_open_item next = tl_nav_open_pop(query);
        // Keys are rounded: one more polygon may be visited than need be, never one less.
        if ((double)next.total * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING) >= search.best_sq) {
            break;
        }
        look_for_wall(&search, next.index);
    }
    wall_out->distance = max_radius;
    wall_out->polygon = tl_nav_make_ref(navmesh, search.slot, search.polygon);
    if (search.start != NULL) {
        wall_out->hit = true;
        wall_out->distance = (float)sqrt(search.best_sq);
        wall_out->point = tl_nav_point_on_edge(search.start, search.end, search.best_t);
        // Towards the inside, which is left of the edge.
        wall_out->normal =
            tl_normalize(tl_vec3_make(search.end->z - search.start->z, 0.0f, search.start->x - search.end->x));
    }
    return search.full ? TL_ERR_NODES : TL_OK;
}

tl_result tl_nav_query_find_wall(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_around_request *request,
                                 tl_nav_wall *wall_out)
{
    tl_result result;
    do {
        result = find_wall_within(query, navmesh, request, wall_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
