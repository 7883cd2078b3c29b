// SPDX-License-Identifier: MIT
//
// Moving along the surface: to the target, or to the point nearest to it on a wall around the way there.
//
// A breadth-first search from the start visits the polygons that touch the circle whose diameter runs from start to
// target. So a short step slides along walls and around their corners, and never slips through to a place that is near
// but a long way off. Almost all steps end in the first polygon or the second. Source: Mikko Mononen, Detour,
// dtNavMeshQuery::moveAlongSurface, for the circle.

#include "nav_query/plane/nearest_on_edge.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/local_search.h"
#include "nav_query/search/query_memory.h"

#include <math.h>
#include <string.h>

typedef struct move_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    double x, z;               // the target
    double middle_x, middle_z; // of the way there
    double reach_sq;           // of the circle around it
    double best_sq;
    double best_t;
    const tl_vec3 *start, *end; // of the nearest wall
    uint32_t best;              // node
    bool full;
    bool all_pass; // the filter refuses nothing
} move_search;

// Whether the target lies over a ring, its outline included.
static bool ring_holds(const tl_nav_ring *ring, double x, double z)
{
    for (uint32_t i = 0; i < ring->count; i++) {
        const tl_vec3 *end = &ring->points[i + 1 < ring->count ? i + 1 : 0];
        double p = ((double)end->x - (double)ring->points[i].x) * (z - (double)ring->points[i].z);
        double q = ((double)end->z - (double)ring->points[i].z) * (x - (double)ring->points[i].x);
        if (p - q > TL_CROSS_ERROR * (fabs(p) + fabs(q)) && tl_nav_ring_to(ring, i) != TL_NAV_RING_BACK) {
            return false;
        }
    }
    return true;
}

// Looks at a polygon's edges; true when it holds the target.
static bool look_for_target(move_search *search, uint32_t node)
{
    uint32_t slot = search->query->local_nodes[node].slot;
    uint32_t polygon = search->query->local_nodes[node].polygon;
    const tl_nav_ring ring = tl_nav_ring_at(search->navmesh, slot, polygon);
    if (ring_holds(&ring, search->x, search->z)) {
        search->start = NULL;
        search->best = node;
        return true;
    }
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        if (tl_nav_ring_to(&ring, i) == TL_NAV_RING_BACK) {
            continue;
        }
        if (tl_nav_ring_to(&ring, i) != TL_NAV_RING_WALL) {
            tl_nav_ring_seam to = tl_nav_ring_across(search->navmesh, slot, tl_nav_ring_to(&ring, i));
            if (search->all_pass || tl_nav_passes(search->filter, search->navmesh->slots[to.slot].tile, to.polygon)) {
                if (tl_nav_nearest_on_edge(&ring.points[i], end, search->middle_x, search->middle_z).distance_sq <=
                    search->reach_sq) {
                    tl_nav_local_add(search->query, to.slot, to.polygon, node, &search->full);
                }
                continue;
            }
        }
        tl_nav_plan_point nearest = tl_nav_nearest_on_edge(&ring.points[i], end, search->x, search->z);
        if (nearest.distance_sq < search->best_sq) {
            search->best_sq = nearest.distance_sq;
            search->best_t = nearest.t;
            search->start = &ring.points[i];
            search->end = end;
            search->best = node;
        }
    }
    return false;
}

// The polygons from the start's to the one where the move ends; returns how many there are.
static uint32_t write_way(const move_search *search, tl_nav_ref *polygons, uint32_t capacity)
{
    const tl_nav_local_node *nodes = search->query->local_nodes;
    uint32_t count = 0;
    for (uint32_t i = search->best; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        count++;
    }
    uint32_t at = count;
    for (uint32_t i = search->best; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        at--;
        if (at < capacity) {
            polygons[at] = tl_nav_make_ref(search->navmesh, nodes[i].slot, nodes[i].polygon);
        }
    }
    return count;
}

// Within the nodes that the query has now.
static tl_result move_along_surface_within(tl_nav_query *query, const tl_navmesh *navmesh,
                                           const tl_nav_move_request *request, tl_nav_ref *polygons_out,
                                           uint32_t capacity, tl_nav_move *move_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || move_out == NULL ||
        (polygons_out == NULL && capacity > 0) || !tl_nav_filter_is_begun(request->filter)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_filter *filter = request->filter;
    const tl_nav_location *start = &request->start;
    const tl_vec3 target = request->target;
    memset(move_out, 0, sizeof *move_out);
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_is_finite(start->point) || !tl_nav_is_finite(target)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, start->polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    double dx = (double)target.x - (double)start->point.x;
    double dz = (double)target.z - (double)start->point.z;
    // A start on an edge must not lose its neighbour to rounding.
    double size =
        fabs((double)target.x) + fabs((double)target.z) + fabs((double)start->point.x) + fabs((double)start->point.z);
    double reach = 0.5 * sqrt(dx * dx + dz * dz) + (double)TL_FLOAT_GAMMA(6) * size;
    move_search search = { query,
                           navmesh,
                           filter,
                           (double)target.x,
                           (double)target.z,
                           (double)start->point.x + 0.5 * dx,
                           (double)start->point.z + 0.5 * dz,
                           reach * reach,
                           (double)INFINITY,
                           0.0,
                           NULL,
                           NULL,
                           TL_NAV_NO_NODE,
                           false,
                           tl_nav_all_pass(navmesh, filter) };
    tl_nav_local_begin(query);
    tl_nav_local_add(query, slot, polygon, TL_NAV_NO_NODE, &search.full);
    for (uint32_t node = 0; node < query->wedge_count && !look_for_target(&search, node); node++) {
    }
    if (search.best != TL_NAV_NO_NODE) {
        const tl_nav_local_node *last = &query->local_nodes[search.best];
        tl_vec3 point = search.start == NULL ? target : tl_nav_point_on_edge(search.start, search.end, search.best_t);
        move_out->end.polygon = tl_nav_make_ref(navmesh, last->slot, last->polygon);
        move_out->end.point = point;
    } else { // no wall was seen with so few nodes
        search.best = 0;
        move_out->end = *start;
    }
    move_out->polygon_count = write_way(&search, polygons_out, capacity);
    if (search.full) {
        return TL_ERR_NODES;
    }
    return move_out->polygon_count <= capacity || capacity == 0 ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_nav_query_move_along_surface(tl_nav_query *query, const tl_navmesh *navmesh,
                                          const tl_nav_move_request *request, tl_nav_ref *polygons_out,
                                          uint32_t capacity, tl_nav_move *move_out)
{
    tl_result result;
    do {
        result = move_along_surface_within(query, navmesh, request, polygons_out, capacity, move_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
