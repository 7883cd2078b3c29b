// SPDX-License-Identifier: MIT
//
// Places along borders. A polygon's edge that no other polygon shares is a ledge or the foot of a wall. The navmesh
// does not know which; the sweeps find out.

#include "nav_links/ledges.h"

#include "base/assert.h"
#include "base/exact_floats.h"

#include <math.h>

enum { MAX_POLYGON_LINKS = 256 };

// Points and polygons between two calls of progress: at some 100 ns each.
enum { WORK_PER_CALL = 1 << 15 };

typedef struct ledge_walk {
    const tl_navmesh *navmesh;
    float spacing;
    tl_nav_ledge_point *points;
    uint64_t capacity, count, edges;
    uint64_t budget;  // points that may still be looked at
    tl_result result; // TL_ERR_LIMIT: it was not enough
    tl_stage *stage;
    uint32_t work;                        // points and polygons since progress was called
    tl_nav_link links[MAX_POLYGON_LINKS]; // of the polygon at hand
    uint32_t link_count;
} ledge_walk;

// Whether another polygon shares an edge at a point of it.
static bool is_open_at(const ledge_walk *walk, uint32_t edge, tl_vec3 a, tl_vec3 b, tl_vec3 point)
{
    float x = b.x - a.x;
    float z = b.z - a.z;
    float at = (point.x - a.x) * x + (point.z - a.z) * z;
    for (uint32_t i = 0; i < walk->link_count; i++) {
        const tl_nav_link *link = &walk->links[i];
        float right = (link->right.x - a.x) * x + (link->right.z - a.z) * z;
        float left = (link->left.x - a.x) * x + (link->left.z - a.z) * z;
        if (link->edge == edge && at >= right && at <= left) {
            return true;
        }
    }
    return false;
}

// Calls progress now and then. False: cancelled.
static bool count_ledge_work(ledge_walk *walk)
{
    if (++walk->work >= WORK_PER_CALL && walk->result == TL_OK) {
        walk->work = 0;
        walk->result = tl_stage_add(walk->stage, 0);
    }
    return walk->result == TL_OK;
}

static void sample_ledge(ledge_walk *walk, tl_nav_ref polygon, uint32_t edge, tl_vec3 a, tl_vec3 b)
{
    float x = b.x - a.x;
    float z = b.z - a.z;
    float length = sqrtf(x * x + z * z);
    if (!(length > 0.0f)) {
        return;
    }
    // Outward is to the right of a to b: polygons run counter-clockwise as seen from above.
    tl_vec3 out = tl_vec3_make(-z / length, 0.0f, x / length);
    double steps = ceil((double)length / (double)walk->spacing);
    if (steps > (double)walk->budget) {
        walk->result = TL_ERR_LIMIT;
        return;
    }
    const uint32_t count = (uint32_t)steps;
    bool is_border = false;
    walk->budget -= count;
    for (uint32_t i = 0; i < count && count_ledge_work(walk); i++) {
        float t = ((float)i + 0.5f) / (float)count;
        tl_vec3 point = tl_lerp(a, b, t);
        if (is_open_at(walk, edge, a, b, point)) {
            continue;
        }
        is_border = true;
        if (walk->count < walk->capacity) {
            tl_nav_ledge_point place = { polygon, point, out, fabsf(t - 0.5f) * length };
            tl_navmesh_height(walk->navmesh, polygon, point.x, point.z, &place.point.y);
            walk->points[walk->count] = place;
        }
        walk->count++;
    }
    walk->edges += is_border ? 1 : 0;
}

static void sample_polygon_edges(ledge_walk *walk, const tl_nav_tile *tile, uint32_t slot, uint32_t polygon)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    tl_nav_ref ref = tl_navmesh_polygon_ref(walk->navmesh, slot, polygon);
    tl_result result = tl_navmesh_links(walk->navmesh, ref, walk->links, MAX_POLYGON_LINKS, &walk->link_count);
    // Links beyond the buffer count as borders: candidates there turn out to be walkable without a link.
    walk->link_count = result == TL_OK ? walk->link_count : MAX_POLYGON_LINKS;
    for (uint32_t k = 0; k < count && walk->result == TL_OK; k++) {
        const bool may_be_border = tl_nav_tile_edge_link(tile, polygon, k) >= TL_NAV_LINK_PORTAL;
        if (may_be_border) {
            sample_ledge(walk, ref, k, corners[k], corners[k + 1 < count ? k + 1 : 0]);
        }
    }
}

tl_result tl_nav_sample_ledges(const tl_navmesh *navmesh, float spacing, tl_stage *stage, tl_nav_ledge_point *points,
                               uint64_t capacity, uint64_t *count_out, uint64_t *edge_count_out)
{
    ledge_walk walk;
    walk.navmesh = navmesh;
    walk.spacing = spacing;
    walk.points = points;
    walk.capacity = capacity;
    walk.count = 0;
    walk.edges = 0;
    walk.budget = 4 * (uint64_t)TL_NAV_LINKS_MAX_PLACES;
    walk.result = TL_OK;
    walk.stage = stage;
    walk.work = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            sample_polygon_edges(&walk, tile, slot, p);
            (void)count_ledge_work(&walk);
            TL_TRY(walk.result);
        }
    }
    *edge_count_out = walk.edges;
    *count_out = walk.count;
    return walk.count > TL_NAV_LINKS_MAX_PLACES ? TL_ERR_LIMIT : TL_OK;
}
