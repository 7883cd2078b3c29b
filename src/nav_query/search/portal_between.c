// SPDX-License-Identifier: MIT
//
// The portal between two neighbours: all stretches of edge that they share, as one.
//
// Two convex polygons share stretches of one line only, and each contains the line between any two of its points. So
// the hull of all stretches is inside both, and the path may cross anywhere on it.

#include "nav_query/search/portal_between.h"

#include "nav_query/navmesh/ring_step.h"

// The first of a ring's edges from `edge` on that leads to a polygon; ring->count: none does.
static inline uint32_t next_to(const tl_nav_slot *slot, const tl_nav_ring *ring, uint32_t edge,
                               const tl_nav_portal_ends *ends)
{
    if (ends->to_slot == ends->slot) {
        while (edge < ring->count && tl_nav_ring_to(ring, edge) != ends->to_polygon) {
            edge++;
        }
        return edge;
    }
    for (; edge < ring->count; edge++) {
        if (tl_nav_ring_to(ring, edge) >= TL_NAV_RING_SEAM && tl_nav_ring_is_open(tl_nav_ring_to(ring, edge))) {
            const tl_nav_ring_seam seam = tl_nav_ring_seam_of(&slot->rings, tl_nav_ring_to(ring, edge));
            if (seam.slot == ends->to_slot && seam.polygon == ends->to_polygon) {
                break;
            }
        }
    }
    return edge;
}

// Where the portal goes on behind its first edge: two polygons share more than one edge where a vertex lies between, or
// a seam is cut there. All of them are one.
static void add_edges(const tl_nav_slot *slot, const tl_nav_ring *ring, uint32_t first, const tl_nav_portal_ends *ends,
                      tl_vec3 *left, tl_vec3 *right)
{
    const double dx = (double)left->x - (double)right->x;
    const double dz = (double)left->z - (double)right->z;
    double leftmost = dx * (double)left->x + dz * (double)left->z;
    double rightmost = dx * (double)right->x + dz * (double)right->z;
    for (uint32_t i = first; i < ring->count; i = next_to(slot, ring, i + 1, ends)) {
        const tl_vec3 *start = &ring->points[i], *next = &ring->points[i + 1 < ring->count ? i + 1 : 0];
        const double to_left = dx * (double)next->x + dz * (double)next->z;
        const double to_right = dx * (double)start->x + dz * (double)start->z;
        *left = to_left > leftmost ? *next : *left;
        *right = to_right < rightmost ? *start : *right;
        leftmost = to_left > leftmost ? to_left : leftmost;
        rightmost = to_right < rightmost ? to_right : rightmost;
    }
}

bool tl_nav_find_portal(const tl_navmesh *navmesh, const tl_nav_portal_ends *ends, tl_vec3 *left_out,
                        tl_vec3 *right_out)
{
    const tl_nav_slot *slot = &navmesh->slots[ends->slot];
    const tl_nav_ring ring = tl_nav_ring_of(&slot->rings, ends->polygon);
    const uint32_t first = next_to(slot, &ring, 0, ends);
    if (first == ring.count) {
        return false;
    }
    *right_out = ring.points[first];
    *left_out = ring.points[first + 1 < ring.count ? first + 1 : 0];
    const uint32_t second = next_to(slot, &ring, first + 1, ends);
    if (second < ring.count) {
        add_edges(slot, &ring, second, ends, left_out, right_out);
    }
    return true;
}

bool tl_nav_portal_between(const tl_navmesh *navmesh, tl_nav_ref from, uint32_t to_slot, uint32_t to_polygon,
                           tl_vec3 *left_out, tl_vec3 *right_out)
{
    tl_nav_portal_ends ends = { 0, 0, to_slot, to_polygon };
    return tl_nav_split_ref(navmesh, from, &ends.slot, &ends.polygon) &&
           tl_nav_find_portal(navmesh, &ends, left_out, right_out);
}
