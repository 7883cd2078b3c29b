// SPDX-License-Identifier: MIT
//
// The walkable area is taken back from walls and ledges by the agent's radius.
// Source: Mikko Mononen, Recast (rcErodeWalkableArea); Gunilla Borgefors, Distance transformations in digital images,
// 1986: two sweeps, a straight step counts 2, a diagonal 3.
//
// The sweeps run over the floors in their order of storage: a floor's neighbours at -x and -z come before it, those at
// +x and +z after it.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_build/links.h"

#include <string.h>

enum { STRAIGHT = 2, DIAGONAL = 3 };

// 0 at floors that are not walkable or lack a walkable neighbour, else `far`.
static void seed_borders(const tl_nav_compact *compact, uint16_t far, uint16_t *distance)
{
    const uint8_t *area = compact->area;
    for (uint32_t i = 0; i < compact->span_count; i++) {
        const tl_links links = tl_nav_links(compact, i);
        bool inside = area[i] != TL_NAV_NULL_AREA;
        for (uint32_t d = 0; inside && d < 4; d++) {
            inside = links.to[d] != TL_NAV_NO_SPAN && area[links.to[d]] != TL_NAV_NULL_AREA;
        }
        distance[i] = inside ? far : 0;
    }
}

// The least of `nearest` and what the floor beside i in a direction, and the one beside that in `turn`, give it.
static uint32_t nearest_over(const tl_nav_compact *compact, const uint16_t *distance, uint32_t i, uint32_t direction,
                             uint32_t turn, uint32_t nearest)
{
    uint32_t beside = tl_nav_beside(compact, i, direction);
    if (beside == TL_NAV_NO_SPAN) {
        return nearest;
    }
    uint32_t straight = (uint32_t)distance[beside] + STRAIGHT;
    nearest = straight < nearest ? straight : nearest;
    uint32_t across = tl_nav_beside(compact, beside, turn);
    if (across == TL_NAV_NO_SPAN) {
        return nearest;
    }
    uint32_t diagonal = (uint32_t)distance[across] + DIAGONAL;
    return diagonal < nearest ? diagonal : nearest;
}

static void sweep(const tl_nav_compact *compact, uint16_t *distance)
{
    const uint32_t count = compact->span_count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t nearest = distance[i];
        if (nearest > 0) {
            nearest = nearest_over(compact, distance, i, 0, 3, nearest);
            nearest = nearest_over(compact, distance, i, 3, 2, nearest);
            distance[i] = (uint16_t)nearest;
        }
    }
    for (uint32_t i = count; i-- > 0;) {
        uint32_t nearest = distance[i];
        if (nearest > 0) {
            nearest = nearest_over(compact, distance, i, 2, 1, nearest);
            nearest = nearest_over(compact, distance, i, 1, 0, nearest);
            distance[i] = (uint16_t)nearest;
        }
    }
}

tl_result tl_nav_erode(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact)
{
    TL_TRY(tl_progress_update(host, "erode", 0, 1));
    if (config->walkable_radius > 0) {
        // walkable_radius <= TL_NAV_MAX_VOXELS, so its double fits 16 bits; farther floors need no exact distance.
        const uint16_t limit = (uint16_t)(config->walkable_radius * STRAIGHT);
        const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
        uint16_t *distance = tl_allocate_array(allocator, compact->span_count, sizeof *distance);
        if (distance == NULL) {
            return TL_ERR_MEMORY;
        }
        seed_borders(compact, limit, distance);
        sweep(compact, distance);
        for (uint32_t i = 0; i < compact->span_count; i++) {
            compact->area[i] = distance[i] < limit ? TL_NAV_NULL_AREA : compact->area[i];
        }
        tl_release_array(allocator, distance, compact->span_count, sizeof *distance);
    }
    return tl_progress_update(host, "erode", 1, 1);
}
