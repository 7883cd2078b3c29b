// SPDX-License-Identifier: MIT
//
// The portal between two neighbours: all stretches of edge that they share, as one.
//
// Two convex polygons share stretches of one line only, and each contains the line between any two of its points. So
// the hull of all stretches is inside both, and the path may cross anywhere on it.

#include "nav_query/search/portal_between.h"

#include "nav_query/navmesh/ring_step.h"

bool tl_nav_portal_between(const tl_navmesh *navmesh, tl_nav_ref from, uint32_t to_slot, uint32_t to_polygon,
                           tl_vec3 *left_out, tl_vec3 *right_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_split_ref(navmesh, from, &slot, &polygon)) {
        return false;
    }
    uint32_t count = 0;
    const tl_nav_ring_edge *ring = tl_nav_ring_at(navmesh, slot, polygon, &count);
    bool found = false;
    double leftmost = 0.0;
    double rightmost = 0.0;
    double dx = 0.0;
    double dz = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_ring_seam to = { 0, 0 };
        if (tl_nav_ring_is_open(&ring[i])) {
            to = tl_nav_ring_across(navmesh, slot, ring[i].to);
        }
        if (!tl_nav_ring_is_open(&ring[i]) || to.slot != to_slot || to.polygon != to_polygon) {
            continue;
        }
        const tl_nav_ring_edge *end = &ring[i + 1 < count ? i + 1 : 0];
        if (!found) {
            dx = (double)end->x - (double)ring[i].x;
            dz = (double)end->z - (double)ring[i].z;
        }
        double left = dx * (double)end->x + dz * (double)end->z;
        double right = dx * (double)ring[i].x + dz * (double)ring[i].z;
        if (!found || left > leftmost) {
            leftmost = left;
            *left_out = tl_vec3_make(end->x, end->y, end->z);
        }
        if (!found || right < rightmost) {
            rightmost = right;
            *right_out = tl_vec3_make(ring[i].x, ring[i].y, ring[i].z);
        }
        found = true;
    }
    return found;
}
