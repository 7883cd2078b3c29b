// SPDX-License-Identifier: MIT
//
// Wall segments: of one polygon, and of all polygons connected around a place, the nearest first.
//
// Rings (polygon outlines cut where links begin and end) know them: each of their edges is a wall or a portal as a
// whole. The caller's buffer is kept sorted by insertion: it is short where this is called often (steering), and a wall
// farther than its last entry costs one comparison.

#include "nav_query/plane/nearest_on_edge.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/local_search.h"
#include "nav_query/search/query_memory.h"

#include <math.h>
#include <talus/nav_around.h>

// Whether a ring's edge is wall; then what the filter refuses behind it.
static bool is_wall(const tl_navmesh *navmesh, const tl_nav_filter *filter, uint32_t slot, tl_nav_ring_edge edge,
                    tl_nav_ring_seam *to_out, bool *has_polygon_out)
{
    *has_polygon_out = tl_nav_ring_is_open(edge.to);
    if (!*has_polygon_out) {
        return edge.to == TL_NAV_RING_WALL;
    }
    *to_out = tl_nav_ring_across(navmesh, slot, edge.to);
    return !tl_nav_passes(filter, navmesh->slots[to_out->slot].tile, to_out->polygon);
}

static tl_nav_wall_segment make_segment(const tl_navmesh *navmesh, tl_vec3 start, tl_vec3 end, tl_nav_ref polygon,
                                        tl_nav_ring_seam to, bool has_polygon)
{
    tl_nav_wall_segment segment = { start, end, polygon,
                                    has_polygon ? tl_nav_make_ref(navmesh, to.slot, to.polygon) : TL_NAV_NO_REF, 0.0f };
    return segment;
}

tl_result tl_navmesh_polygon_walls(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref polygon,
                                   tl_nav_wall_segment *segments_out, uint32_t capacity, uint32_t *count_out)
{
    if (navmesh == NULL || count_out == NULL || (segments_out == NULL && capacity > 0) ||
        !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    uint32_t slot = 0;
    uint32_t local = 0;
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &local)) {
        return TL_ERR_STALE;
    }
    const tl_nav_ring ring = tl_nav_ring_at(navmesh, slot, local);
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        tl_nav_ring_seam to = { 0, 0 };
        bool has_polygon = false;
        if (is_wall(navmesh, filter, slot, tl_nav_ring_edge_at(&ring, i), &to, &has_polygon)) {
            if (*count_out < capacity) {
                segments_out[*count_out] = make_segment(navmesh, ring.points[i], *end, polygon, to, has_polygon);
            }
            ++*count_out;
        }
    }
    return *count_out <= capacity ? TL_OK : TL_INCOMPLETE;
}

typedef struct wall_gathering {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    double x, z, radius_sq;
    tl_nav_wall_segment *segments;
    uint32_t capacity, count;
    bool full; // the pool
} wall_gathering;

// Puts a piece in its place among the nearest; ties stay in the order in which they came.
static void insert(wall_gathering *walls, const tl_nav_wall_segment *segment)
{
    uint32_t kept = walls->count < walls->capacity ? walls->count : walls->capacity;
    walls->count++;
    if (kept == walls->capacity && (kept == 0 || segment->distance >= walls->segments[kept - 1].distance)) {
        return;
    }
    uint32_t at = kept < walls->capacity ? kept : kept - 1;
    for (; at > 0 && walls->segments[at - 1].distance > segment->distance; at--) {
        walls->segments[at] = walls->segments[at - 1];
    }
    walls->segments[at] = *segment;
}

static void gather_polygon_walls(wall_gathering *walls, uint32_t node)
{
    uint32_t slot = walls->query->local_nodes[node].slot;
    uint32_t polygon = walls->query->local_nodes[node].polygon;
    const tl_nav_ring ring = tl_nav_ring_at(walls->navmesh, slot, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        double distance_sq = tl_nav_nearest_on_edge(&ring.points[i], end, walls->x, walls->z).distance_sq;
        if (distance_sq > walls->radius_sq) {
            continue;
        }
        tl_nav_ring_seam to = { 0, 0 };
        bool has_polygon = false;
        if (is_wall(walls->navmesh, walls->filter, slot, tl_nav_ring_edge_at(&ring, i), &to, &has_polygon)) {
            tl_nav_wall_segment segment = make_segment(walls->navmesh, ring.points[i], *end,
                                                       tl_nav_make_ref(walls->navmesh, slot, polygon), to, has_polygon);
            segment.distance = (float)sqrt(distance_sq);
            insert(walls, &segment);
        } else if (has_polygon) {
            tl_nav_local_add(walls->query, to.slot, to.polygon, node, &walls->full);
        }
    }
}

// Within the nodes that the query has now.
static tl_result find_walls_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_around_request *request,
                                   tl_nav_wall_segment *segments_out, uint32_t capacity, uint32_t *count_out)
{
    if (query == NULL || navmesh == NULL || request == NULL || count_out == NULL ||
        (segments_out == NULL && capacity > 0) || !tl_nav_filter_is_begun(request->filter)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_filter *filter = request->filter;
    const tl_nav_location *center = &request->center;
    const float radius = request->radius;
    *count_out = 0;
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_is_finite(center->point) || !isfinite(radius)) {
        return TL_ERR_NOT_FINITE;
    }
    if (radius < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, center->polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    wall_gathering walls = { query,
                             navmesh,
                             filter,
                             (double)center->point.x,
                             (double)center->point.z,
                             (double)radius * (double)radius,
                             segments_out,
                             capacity,
                             0,
                             false };
    tl_nav_local_begin(query);
    tl_nav_local_add(query, slot, polygon, TL_NAV_NO_NODE, &walls.full);
    for (uint32_t node = 0; node < query->wedge_count; node++) {
        gather_polygon_walls(&walls, node);
    }
    *count_out = walls.count;
    if (walls.full) {
        return TL_ERR_NODES;
    }
    return walls.count <= capacity ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_nav_query_find_walls(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_around_request *request,
                                  tl_nav_wall_segment *segments_out, uint32_t capacity, uint32_t *count_out)
{
    tl_result result;
    do {
        result = find_walls_within(query, navmesh, request, segments_out, capacity, count_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
