// SPDX-License-Identifier: MIT
//
// The portal between two neighbours: all stretches of edge that they share, as one.
//
// Two convex polygons share stretches of one line only, and each contains the line between any two of its points. So
// the hull of all stretches is inside both, and the path may cross anywhere on it.

#include "nav_query/portal_between.h"

bool tl_nav_portal_between(const tl_navmesh *navmesh, tl_nav_ref from, uint32_t to_slot, uint32_t to_polygon,
                           tl_vec3 *left_out, tl_vec3 *right_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_split_ref(navmesh, from, &slot, &polygon)) {
        return false;
    }
    tl_nav_ways ways = tl_nav_ways_of(navmesh, slot, polygon);
    tl_nav_way way;
    bool found = false;
    double leftmost = 0.0;
    double rightmost = 0.0;
    double dx = 0.0;
    double dz = 0.0;
    while (tl_nav_ways_next(&ways, &way)) {
        if (way.slot != to_slot || way.polygon != to_polygon) {
            continue;
        }
        if (!found) {
            dx = (double)way.left.x - (double)way.right.x;
            dz = (double)way.left.z - (double)way.right.z;
        }
        double left = dx * (double)way.left.x + dz * (double)way.left.z;
        double right = dx * (double)way.right.x + dz * (double)way.right.z;
        if (!found || left > leftmost) {
            leftmost = left;
            *left_out = way.left;
        }
        if (!found || right < rightmost) {
            rightmost = right;
            *right_out = way.right;
        }
        found = true;
    }
    return found;
}
