// SPDX-License-Identifier: MIT
//
// From a ring into the one across an edge.

#ifndef TALUS_SRC_NAV_QUERY_RING_STEP_H
#define TALUS_SRC_NAV_QUERY_RING_STEP_H

#include "nav_query/navmesh/navmesh.h"

/// More polygons around a vertex than any bake makes.
enum { TL_NAV_MAX_FAN = 64 };

/// An edge of a polygon's ring.
typedef struct tl_nav_ring_place {
    uint32_t slot, polygon;
    uint32_t edge;
} tl_nav_ring_place;

static inline tl_nav_ring tl_nav_ring_at(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    return tl_nav_ring_of(&navmesh->slots[slot].rings, polygon);
}

/// The polygon across an open edge of a slot's rings.
static inline tl_nav_ring_seam tl_nav_ring_across(const tl_navmesh *navmesh, uint32_t slot, uint32_t to)
{
    tl_nav_ring_seam target = { slot, to };
    return (to & TL_NAV_RING_SEAM) == 0 ? target : tl_nav_ring_seam_of(&navmesh->slots[slot].rings, to);
}

/// The same edge as the polygon across it has it. `edge` stands in polygon's ring.
static inline tl_nav_ring_place tl_nav_ring_twin(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon,
                                                 const tl_nav_ring *ring, uint32_t edge)
{
    const tl_nav_ring_edge from = tl_nav_ring_edge_at(ring, edge);
    const tl_nav_ring_seam to = tl_nav_ring_across(navmesh, slot, from.to);
    tl_nav_ring_place twin = { to.slot, to.polygon, tl_nav_ring_twin_hint(from) };
    if ((from.to & TL_NAV_RING_SEAM) != 0 || twin.edge == TL_NAV_RING_FAR_TWIN) {
        // Rings of other tiles change as tiles come and go. A seam's ends have the same bits in both. Where nothing
        // runs back no two edges of a ring start in one place: the search may begin anywhere.
        const tl_vec3 *end = &ring->points[edge + 1 < ring->count ? edge + 1 : 0];
        const tl_nav_ring across = tl_nav_ring_at(navmesh, to.slot, to.polygon);
        if ((from.to & TL_NAV_RING_SEAM) != 0) {
            twin.edge = tl_nav_seam_twin_hint(&navmesh->slots[slot].rings, from, across.count);
        }
        uint32_t k = !navmesh->slots[to.slot].rings.has_back && twin.edge < across.count ? twin.edge : 0;
        for (uint32_t i = 0; i < across.count; i++, k = k + 1 < across.count ? k + 1 : 0) {
            const uint32_t back_to = tl_nav_ring_to(&across, k);
            if (across.points[k].x != end->x || across.points[k].z != end->z || !tl_nav_ring_is_open(back_to)) {
                continue;
            }
            tl_nav_ring_seam back = tl_nav_ring_across(navmesh, to.slot, back_to);
            if (back.slot == slot && back.polygon == polygon) {
                twin.edge = k;
                break;
            }
        }
    }
    return twin;
}

/// The same as tl_nav_leads_astray for a step over a seam (branches.c).
bool tl_nav_leads_astray_over_seam(const tl_navmesh *navmesh, tl_nav_ring_seam from, tl_nav_ring_seam to,
                                   tl_nav_ring_seam goal);

/// Whether a step from a polygon into one across an edge leads away from the goal over the only edge that leads back:
/// into a branch that does not hold it, or out of one that does. Where off-mesh links end on a tile's polygons its
/// branches have other ways.
static inline bool tl_nav_leads_astray(const tl_navmesh *navmesh, tl_nav_ring_seam from, tl_nav_ring_seam to,
                                       tl_nav_ring_seam goal)
{
    const tl_nav_slot *slot = &navmesh->slots[from.slot];
    const uint32_t branch = tl_nav_branch_of(&slot->rings, from.polygon);
    const uint32_t into = tl_nav_branch_of(&navmesh->slots[to.slot].rings, to.polygon);
    if (from.slot != to.slot) {
        return (branch | into) != 0 && tl_nav_leads_astray_over_seam(navmesh, from, to, goal);
    }
    if (branch == into || slot->anchor_count > 0) {
        return false;
    }
    // Of two branches side by side that of the higher number hangs on the other.
    const bool is_out = branch > into;
    return is_out ==
           (goal.slot == from.slot && tl_nav_is_on_branch(&slot->rings, is_out ? branch : into, goal.polygon));
}

/// Goes around the vertex where the edge at `at` starts to the wall where its fan begins; what the filter (NULL: none)
/// refuses is wall. False: there is none, and `at` is where it was.
bool tl_nav_find_fan(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ring_place *at);

#endif
