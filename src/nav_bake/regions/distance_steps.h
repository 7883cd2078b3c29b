// SPDX-License-Identifier: MIT
//
// The three steps of the distance field: a sweep forward, one backward, and the blur.

#ifndef TALUS_SRC_NAV_BAKE_DISTANCE_STEPS_H
#define TALUS_SRC_NAV_BAKE_DISTANCE_STEPS_H

#include "nav_bake/floors/chamfer.h"

enum { TL_BLUR_THRESHOLD = 2 }; // half columns; floors this near a border keep their distance, so that walls stay sharp

/// From the floors that come before this one, which have theirs. Borders have 0.
static inline uint16_t tl_distance_forward(const tl_nav_compact *compact, const uint16_t *distance, uint32_t floor)
{
    return tl_chamfer_forward(compact, distance, floor, TL_BORDER_OF_AREAS, TL_FAR_AWAY);
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

/// The distances, of all floors, that the sweeps have to fill.
static inline tl_chamfer tl_distance_chamfer(const tl_nav_compact *compact, const tl_floor_bands *bands,
                                             uint16_t *distance)
{
    return (tl_chamfer){ compact, bands, TL_BORDER_OF_AREAS, TL_FAR_AWAY, distance };
}

/// The blur of all floors, as the host's tasks.
void tl_distance_blur(const tl_chamfer *sharp, const tl_host *host, uint16_t *blurred);

static inline uint16_t tl_largest_distance(const uint16_t *values, size_t count)
{
    uint16_t largest = 0;
    for (size_t i = 0; i < count; i++) {
        largest = values[i] > largest ? values[i] : largest;
    }
    return largest;
}

#endif
