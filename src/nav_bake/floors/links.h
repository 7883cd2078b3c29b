// SPDX-License-Identifier: MIT
//
// All four links of a floor at once.

#ifndef TALUS_SRC_NAV_BAKE_LINKS_H
#define TALUS_SRC_NAV_BAKE_LINKS_H

#include <talus/nav_bake.h>

#include <string.h>

typedef struct tl_links {
    uint32_t to[4]; ///< by direction; TL_NAV_NO_SPAN: none
} tl_links;

static inline tl_links tl_floor_links(const tl_nav_compact *compact, uint32_t span)
{
    tl_links links;
    if (compact->step != NULL) { // asked once, and not for each direction
        const int16_t *step = compact->step + 4 * (size_t)span;
        for (uint32_t d = 0; d < 4; d++) {
            const int32_t to = step[d];
            links.to[d] = to != 0 ? span + (uint32_t)to : TL_NAV_NO_SPAN;
        }
    } else {
        for (uint32_t d = 0; d < 4; d++) {
            links.to[d] = compact->neighbour[4 * (size_t)span + d];
        }
    }
    return links;
}

/// The same with the span itself where nothing lies beside it: for questions that a span answers with no of itself.
static inline tl_links tl_nav_links_or_self(const tl_nav_compact *compact, uint32_t span)
{
    tl_links links;
    if (compact->step != NULL) {
        const int16_t *step = compact->step + 4 * (size_t)span;
        for (uint32_t d = 0; d < 4; d++) {
            const int32_t to = step[d];
            links.to[d] = span + (uint32_t)to;
        }
    } else {
        for (uint32_t d = 0; d < 4; d++) {
            const uint32_t beside = compact->neighbour[4 * (size_t)span + d];
            links.to[d] = beside != TL_NAV_NO_SPAN ? beside : span;
        }
    }
    return links;
}

/// How many floors from `first` on, up to `most` >= 1, all step alike: then the floors beside them follow one another
/// too, in each direction. `compact` has steps.
static inline uint32_t tl_nav_steps_alike(const tl_nav_compact *compact, uint32_t first, uint32_t most)
{
    const int16_t *steps = compact->step + 4 * (size_t)first;
    uint64_t four, next; // steps of one floor
    memcpy(&four, steps, sizeof four);
    for (uint32_t k = 1; k < most; k++) {
        memcpy(&next, steps + 4 * (size_t)k, sizeof next);
        if (next != four) {
            return k;
        }
    }
    return most;
}

#endif
