// SPDX-License-Identifier: MIT
//
// The 2-3 chamfer distance of floors from borders, in half columns: 2 for a straight step, 3 for a diagonal one.

#ifndef TALUS_SRC_NAV_BAKE_CHAMFER_H
#define TALUS_SRC_NAV_BAKE_CHAMFER_H

#include "nav_bake/floors/floor_bands.h"
#include "nav_bake/floors/links.h"

enum {
    TL_EDGE_STEP = 2,
    TL_CORNER_STEP = 3,
    TL_FAR_AWAY = 0xffff - TL_CORNER_STEP ///< farther than any floor is from a border: that is 2^15 at most
};

/// Which floors are borders: those that lack one of their four neighbours,
typedef enum tl_chamfer_border {
    TL_BORDER_OF_GROUND,   ///< and no others;
    TL_BORDER_OF_WALKABLE, ///< those that are not walkable, or beside such a one;
    TL_BORDER_OF_AREAS     ///< those that are not walkable, or beside another area
} tl_chamfer_border;

typedef struct tl_chamfer {
    const tl_nav_compact *compact;
    const tl_floor_bands *bands;
    tl_chamfer_border border;
    uint16_t far_away;  ///< no distance is larger: at most TL_FAR_AWAY
    uint16_t *distance; ///< [span_count]
} tl_chamfer;

/// The two sweeps, as the host's tasks: what comes before each floor, then what comes after it, in place. The same
/// distances for any number of bands.
void tl_chamfer_sweep_forward(const tl_chamfer *chamfer, const tl_host *host);
void tl_chamfer_sweep_backward(const tl_chamfer *chamfer, const tl_host *host);

// A floor at a time.

/// What areas differ by.
static inline uint8_t tl_chamfer_kind(uint8_t area, tl_chamfer_border border)
{
    return border == TL_BORDER_OF_AREAS ? area : border == TL_BORDER_OF_WALKABLE ? area != TL_NAV_NULL_AREA : 1;
}

static inline bool tl_chamfer_is_border(const tl_nav_compact *compact, const tl_links *links, uint32_t floor,
                                        tl_chamfer_border border)
{
    const uint8_t own = tl_chamfer_kind(compact->area[floor], border);
    for (int d = 0; d < 4; d++) {
        if (links->to[d] == TL_NAV_NO_SPAN || tl_chamfer_kind(compact->area[links->to[d]], border) != own) {
            return true;
        }
    }
    return own == 0;
}

/// The nearest of what lies beside, and round the corner from there in direction `corner`.
static inline uint32_t tl_chamfer_over(const tl_nav_compact *compact, const uint16_t *distance, uint32_t beside,
                                       uint32_t corner, uint32_t best)
{
    const uint32_t straight = distance[beside] + (uint32_t)TL_EDGE_STEP;
    best = straight < best ? straight : best;
    const uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, corner);
    const uint32_t round = diagonal != TL_NAV_NO_SPAN ? distance[diagonal] + (uint32_t)TL_CORNER_STEP : best;
    return round < best ? round : best;
}

/// From the floors that come before this one, which have theirs. Borders have 0.
static inline uint16_t tl_chamfer_forward(const tl_nav_compact *compact, const uint16_t *distance, uint32_t floor,
                                          tl_chamfer_border border, uint32_t far_away)
{
    const tl_links links = tl_floor_links(compact, floor);
    if (tl_chamfer_is_border(compact, &links, floor, border)) {
        return 0;
    }
    const uint32_t best = tl_chamfer_over(compact, distance, links.to[0], 3, far_away);
    return (uint16_t)tl_chamfer_over(compact, distance, links.to[3], 2, best);
}

/// From the floors that come after this one, and what the forward sweep gave. A floor of distance > 0 has all four
/// neighbours, and no other floor than a border is nearer than a step.
static inline uint16_t tl_chamfer_backward(const tl_nav_compact *compact, const uint16_t *distance, uint32_t floor,
                                           uint16_t forward)
{
    if (forward <= TL_EDGE_STEP) {
        return forward;
    }
    const uint32_t best = tl_chamfer_over(compact, distance, tl_nav_compact_neighbour(compact, floor, 2), 1, forward);
    return (uint16_t)tl_chamfer_over(compact, distance, tl_nav_compact_neighbour(compact, floor, 1), 0, best);
}

#endif
