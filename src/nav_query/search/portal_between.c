// SPDX-License-Identifier: MIT
//
// The portal between two neighbours: all stretches of edge that they share, as one.
//
// Two convex polygons share stretches of one line only, and each contains the line between any two of its points. So
// the hull of all stretches is inside both, and the path may cross anywhere on it.

#include "nav_query/search/portal_between.h"

#include "nav_query/navmesh/ring_step.h"

// Whether an edge leads to a polygon: one of the same tile, or, over a seam, of another.
static inline bool leads_to(const tl_nav_slot *slot, const tl_nav_ring_edge *edge, const tl_nav_portal_ends *ends)
{
    if (edge->to < TL_NAV_RING_SEAM) {
        return edge->to == ends->to_polygon && ends->to_slot == ends->slot;
    }
    if (!tl_nav_ring_is_open(edge)) {
        return false;
    }
    const tl_nav_ring_seam *seam = &slot->rings.seams[edge->to & ~TL_NAV_RING_SEAM];
    return seam->slot == ends->to_slot && seam->polygon == ends->to_polygon;
}

static tl_vec3 start_of(const tl_nav_ring_edge *edge)
{
    return tl_vec3_make(edge->x, edge->y, edge->z);
}

bool tl_nav_find_portal(const tl_navmesh *navmesh, const tl_nav_portal_ends *ends, tl_vec3 *left_out,
                        tl_vec3 *right_out)
{
    const tl_nav_slot *slot = &navmesh->slots[ends->slot];
    uint32_t count = 0;
    const tl_nav_ring_edge *ring = tl_nav_ring_of(&slot->rings, ends->polygon, &count);
    uint32_t first = 0;
    while (first < count && !leads_to(slot, &ring[first], ends)) {
        first++;
    }
    if (first == count) {
        return false;
    }
    const tl_nav_ring_edge *begin = &ring[first];
    const tl_nav_ring_edge *end = &ring[first + 1 < count ? first + 1 : 0];
    *right_out = start_of(begin);
    *left_out = start_of(end);
    // Two polygons share more than one edge where a vertex lies between, or a seam is cut there: all of them are one.
    const double dx = (double)end->x - (double)begin->x;
    const double dz = (double)end->z - (double)begin->z;
    double leftmost = dx * (double)end->x + dz * (double)end->z;
    double rightmost = dx * (double)begin->x + dz * (double)begin->z;
    for (uint32_t i = first + 1; i < count; i++) {
        if (!leads_to(slot, &ring[i], ends)) {
            continue;
        }
        const tl_nav_ring_edge *next = &ring[i + 1 < count ? i + 1 : 0];
        const double left = dx * (double)next->x + dz * (double)next->z;
        const double right = dx * (double)ring[i].x + dz * (double)ring[i].z;
        *left_out = left > leftmost ? start_of(next) : *left_out;
        *right_out = right < rightmost ? start_of(&ring[i]) : *right_out;
        leftmost = left > leftmost ? left : leftmost;
        rightmost = right < rightmost ? right : rightmost;
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
