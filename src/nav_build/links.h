// SPDX-License-Identifier: MIT
//
// All four links of a floor at once.

#ifndef TALUS_SRC_NAV_BUILD_LINKS_H
#define TALUS_SRC_NAV_BUILD_LINKS_H

#include <talus/nav_build.h>

#include <string.h>

typedef struct tl_links {
    uint32_t to[4]; ///< by direction; TL_NAV_NO_SPAN: none
} tl_links;

static inline tl_links tl_nav_links(const tl_nav_compact *compact, uint32_t span)
{
    tl_links links;
    for (uint32_t d = 0; d < 4; d++) {
        links.to[d] = tl_nav_beside(compact, span, d);
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
