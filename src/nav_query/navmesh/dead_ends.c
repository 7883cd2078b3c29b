// SPDX-License-Identifier: MIT
//
// Dead ends: polygons that a shortest path enters only when its goal lies there, or leaves when its start does.
//
// A polygon with one way out is peeled off, then those that it leaves with one, until none is left to peel: what was
// peeled are trees that hang by one edge. A path into a tree comes back over that same edge, and is no shorter for it.
// Ways over seams count as open, so the answer holds whatever tiles come and go around this one.

#include "nav_query/navmesh/rings.h"

#include "base/exact_floats.h"

// The neighbour that a peeled polygon hangs on: its only one that was not peeled before it; itself when there is none.
static uint32_t hangs_on(const tl_nav_rings *rings, uint32_t polygon, const uint32_t *degree)
{
    uint32_t count = 0;
    const tl_nav_ring_edge *ring = tl_nav_ring_of(rings, polygon, &count);
    for (uint32_t i = 0; i < count; i++) {
        if (ring[i].to < TL_NAV_RING_SEAM && degree[ring[i].to] != 0) {
            return ring[i].to;
        }
    }
    return polygon;
}

void tl_nav_mark_dead_ends(tl_nav_rings *rings, uint32_t *scratch)
{
    uint32_t *degree = scratch; // of polygons that are not peeled; 0 once they are
    uint32_t *order = scratch + rings->polygon_count;
    uint32_t peeled = 0;
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        uint32_t count = 0;
        const tl_nav_ring_edge *ring = tl_nav_ring_of(rings, p, &count);
        rings->cells[p].dead_end = 0;
        degree[p] = 0;
        for (uint32_t i = 0; i < count; i++) {
            degree[p] += tl_nav_ring_is_open(&ring[i]) ? 1 : 0;
        }
        if (degree[p] == 1) {
            order[peeled++] = p;
        }
    }
    for (uint32_t k = 0; k < peeled; k++) {
        uint32_t polygon = order[k];
        // The two last polygons of a tree that is an island of its own may both stand in the queue.
        degree[polygon] = 0;
        uint32_t holder = hangs_on(rings, polygon, degree);
        if (holder != polygon && --degree[holder] == 1) {
            order[peeled++] = holder;
        }
        rings->cells[polygon].dead_end = 1 + holder;
    }
    // Back from the holder outward: whatever hangs on a peeled polygon belongs to the same dead end.
    for (uint32_t k = peeled; k > 0; k--) {
        uint32_t polygon = order[k - 1];
        uint32_t holder = rings->cells[polygon].dead_end - 1;
        bool holder_is_peeled = holder != polygon && rings->cells[holder].dead_end != 0;
        rings->cells[polygon].dead_end = holder_is_peeled ? rings->cells[holder].dead_end : 1 + polygon;
    }
}
