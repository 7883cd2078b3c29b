// SPDX-License-Identifier: MIT
//
// Low obstacles that an agent steps over, such as kerbs and the risers of stairs, become walkable.
// Source: Mikko Mononen, Recast (rcFilterLowHangingWalkableObstacles).

#include "base/assert.h"

#include <talus/nav_bake.h>

void tl_nav_filter_low_hanging_obstacles(const tl_nav_config *config, tl_nav_heightfield *heightfield)
{
    TL_ASSERT(config != NULL && heightfield != NULL);
    const uint32_t columns = heightfield->width * heightfield->height;
    tl_nav_span *spans = heightfield->spans;
    for (uint32_t c = 0; c < columns; c++) {
        // Whether the span below was walkable by itself: one obstacle may be stepped on, not a pile of them.
        bool below_walkable = false;
        uint16_t below_area = TL_NAV_NULL_AREA;
        uint32_t below_top = 0;
        for (uint32_t i = heightfield->first_span[c]; i < heightfield->first_span[c + 1]; i++) {
            tl_nav_span *span = &spans[i];
            bool walkable = span->area != TL_NAV_NULL_AREA;
            if (!walkable && below_walkable && span->max - below_top <= config->walkable_climb) {
                span->area = below_area;
            }
            below_walkable = walkable;
            below_area = span->area;
            below_top = span->max;
        }
    }
}
