// SPDX-License-Identifier: MIT
//
// The three steps of the distance field, a floor at a time: a sweep forward, one backward, and the blur.

#ifndef TALUS_SRC_NAV_BAKE_DISTANCE_STEPS_H
#define TALUS_SRC_NAV_BAKE_DISTANCE_STEPS_H

#include "nav_bake/floors/links.h"
#include "nav_bake/floors/plain_runs.h"

enum {
    TL_EDGE_STEP = 2,
    TL_CORNER_STEP = 3,
    TL_BLUR_THRESHOLD = 2, // half columns; floors this near a border keep their distance, so that walls stay sharp
    TL_FAR_AWAY = 0xffff - TL_CORNER_STEP
};

static inline bool tl_distance_is_border(const tl_nav_compact *compact, const tl_links *links, uint8_t area)
{
    for (int d = 0; d < 4; d++) {
        if (links->to[d] == TL_NAV_NO_SPAN || compact->area[links->to[d]] != area) {
            return true;
        }
    }
    return false;
}

/// The nearest of what lies beside, and round the corner from there in direction `corner`.
static inline uint32_t tl_distance_over(const tl_nav_compact *compact, const uint16_t *distance, uint32_t beside,
                                        uint32_t corner, uint32_t best)
{
    const uint32_t straight = distance[beside] + (uint32_t)TL_EDGE_STEP;
    best = straight < best ? straight : best;
    const uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, corner);
    const uint32_t round = diagonal != TL_NAV_NO_SPAN ? distance[diagonal] + (uint32_t)TL_CORNER_STEP : best;
    return round < best ? round : best;
}

/// From the floors that come before this one, which have theirs. Borders have 0.
static inline uint16_t tl_distance_forward(const tl_nav_compact *compact, const uint16_t *distance, uint32_t floor)
{
    const tl_links links = tl_floor_links(compact, floor);
    const uint8_t area = compact->area[floor];
    if (area == TL_NAV_NULL_AREA || tl_distance_is_border(compact, &links, area)) {
        return 0;
    }
    const uint32_t best = tl_distance_over(compact, distance, links.to[0], 3, TL_FAR_AWAY);
    return (uint16_t)tl_distance_over(compact, distance, links.to[3], 2, best);
}

/// From the floors that come after this one, and what the forward sweep gave. A floor of distance > 0 has all four
/// neighbours.
static inline uint16_t tl_distance_backward(const tl_nav_compact *compact, const uint16_t *distance, uint32_t floor,
                                            uint16_t forward)
{
    if (forward == 0) {
        return 0;
    }
    const uint32_t best = tl_distance_over(compact, distance, tl_nav_compact_neighbour(compact, floor, 2), 1, forward);
    return (uint16_t)tl_distance_over(compact, distance, tl_nav_compact_neighbour(compact, floor, 1), 0, best);
}

/// The mean of a floor and its eight neighbours, rounded; one that is missing counts as the floor itself.
static inline uint16_t tl_distance_blurred(const tl_nav_compact *compact, const uint16_t *sharp, uint32_t floor)
{
    const uint32_t own = sharp[floor];
    if (own <= TL_BLUR_THRESHOLD) {
        return (uint16_t)own;
    }
    uint32_t sum = own;
    for (uint32_t d = 0; d < 4; d++) {
        const uint32_t beside = tl_nav_compact_neighbour(compact, floor, d); // exists: distance > 0
        const uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, (d + 1) & 3);
        sum += sharp[beside] + (diagonal != TL_NAV_NO_SPAN ? sharp[diagonal] : own);
    }
    return (uint16_t)((sum + 5) / 9);
}

// Each step over all floors, those of the plain runs by rows: distance_field.c. The backward sweep works in place, and
// returns the largest distance.

void tl_distance_sweep_forward(const tl_nav_compact *compact, const tl_plain_runs *runs, uint16_t *distance);
uint16_t tl_distance_sweep_backward(const tl_nav_compact *compact, const tl_plain_runs *runs, uint16_t *distance);
void tl_distance_blur(const tl_nav_compact *compact, const tl_plain_runs *runs, const uint16_t *sharp,
                      uint16_t *blurred);

#endif
