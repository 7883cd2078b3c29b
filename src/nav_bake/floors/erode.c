// SPDX-License-Identifier: MIT
//
// Erosion: floors nearer to a wall or ledge than the agent's radius are not walkable. A chamfer distance transform.
// Source: Mikko Mononen, Recast (rcErodeWalkableArea); Gunilla Borgefors, Distance transformations in digital images,
// 1986: two sweeps, a straight step counts 2, a diagonal 3.
//
// The sweeps run over the floors in their order of storage: a floor's neighbours at -x and -z come before it, those at
// +x and +z after it.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum { STRAIGHT = 2, DIAGONAL = 3 };

// Whether a floor lacks a neighbour.
static inline bool is_at_edge(const tl_nav_compact *compact, uint32_t i)
{
    if (compact->step != NULL) { // asked once, and not for each direction: whether one of four 16-bit steps is zero
        uint64_t steps;
        memcpy(&steps, compact->step + 4 * (size_t)i, sizeof steps);
        return ((steps - 0x0001000100010001u) & ~steps & 0x8000800080008000u) != 0;
    }
    const uint32_t *neighbour = compact->neighbour + 4 * (size_t)i;
    return neighbour[0] == TL_NAV_NO_SPAN || neighbour[1] == TL_NAV_NO_SPAN || neighbour[2] == TL_NAV_NO_SPAN ||
           neighbour[3] == TL_NAV_NO_SPAN;
}

// A floor that is not walkable, or lacks a walkable neighbour. `holes`: some floors are not walkable.
static inline bool is_area_border(const tl_nav_compact *compact, uint32_t i, bool holes)
{
    if (is_at_edge(compact, i)) {
        return true;
    }
    if (!holes) {
        return false;
    }
    const tl_links links = tl_nav_links_or_self(compact, i);
    const uint8_t *area = compact->area;
    return area[i] == TL_NAV_NULL_AREA || area[links.to[0]] == TL_NAV_NULL_AREA ||
           area[links.to[1]] == TL_NAV_NULL_AREA || area[links.to[2]] == TL_NAV_NULL_AREA ||
           area[links.to[3]] == TL_NAV_NULL_AREA;
}

// The least of `nearest` and what a floor beside, and the one beside that in `turn`, give.
static inline uint32_t nearest_over(const tl_nav_compact *compact, const uint16_t *distance, uint32_t beside,
                                    uint32_t turn, uint32_t nearest)
{
    nearest = tl_min_u32(nearest, (uint32_t)distance[beside] + STRAIGHT);
    const uint32_t across = tl_nav_compact_neighbour(compact, beside, turn);
    return across != TL_NAV_NO_SPAN ? tl_min_u32(nearest, (uint32_t)distance[across] + DIAGONAL) : nearest;
}

// Borders get 0, all others the distance from what comes before them, at most `limit`. Those have all four neighbours.
static void sweep_forward(const tl_nav_compact *compact, uint32_t limit, bool holes, uint16_t *distance)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        uint32_t nearest = 0;
        if (!is_area_border(compact, i, holes)) {
            const uint32_t left = tl_nav_compact_neighbour(compact, i, 0), up = tl_nav_compact_neighbour(compact, i, 3);
            nearest = limit;
            if (distance[left] < limit) { // else the floor across is at least `limit` - 2 away, a straight step from it
                nearest = nearest_over(compact, distance, left, 3, limit);
            }
            nearest = nearest_over(compact, distance, up, 2, nearest);
        }
        distance[i] = (uint16_t)nearest;
    }
}

// The same from what comes after. Floors nearer than `limit` are no longer walkable.
static void sweep_backward(tl_nav_compact *compact, uint32_t limit, uint16_t *distance)
{
    for (uint32_t i = compact->span_count; i-- > 0;) {
        uint32_t nearest = distance[i];
        if (nearest > STRAIGHT) { // nothing but a border is nearer
            const uint32_t right = tl_nav_compact_neighbour(compact, i, 2);
            if (distance[right] < limit) { // as above
                nearest = nearest_over(compact, distance, right, 1, nearest);
            }
            nearest = nearest_over(compact, distance, tl_nav_compact_neighbour(compact, i, 1), 0, nearest);
            distance[i] = (uint16_t)nearest;
        }
        compact->area[i] = nearest < limit ? TL_NAV_NULL_AREA : compact->area[i];
    }
}

tl_result tl_nav_erode(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "erode");
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "erode", 0, 1));
    if (config->walkable_radius > 0) {
        // walkable_radius <= TL_NAV_MAX_VOXELS, so its double fits 16 bits; farther floors need no exact distance.
        const uint32_t limit = config->walkable_radius * STRAIGHT;
        const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
        uint16_t *distance = tl_allocate_array(allocator, compact->span_count, sizeof *distance);
        if (distance == NULL) {
            return TL_ERR_MEMORY;
        }
        const bool holes =
            compact->span_count > 0 && memchr(compact->area, TL_NAV_NULL_AREA, compact->span_count) != NULL;
        sweep_forward(compact, limit, holes, distance);
        sweep_backward(compact, limit, distance);
        tl_release_array(allocator, distance, compact->span_count, sizeof *distance);
    }
    return tl_progress_update(host, "erode", 1, 1);
}
