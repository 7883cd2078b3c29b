// SPDX-License-Identifier: MIT
//
// Floors without room for the agent are not walkable.
// Source: Mikko Mononen, Recast (rcFilterWalkableLowHeightSpans).

#include "base/assert.h"
#include "nav_bake/voxels/column.h"

void tl_nav_filter_walkable_low_height_spans(const tl_nav_config *config, tl_nav_heightfield *heightfield)
{
    TL_ASSERT(config != NULL && heightfield != NULL);
    const uint32_t columns = heightfield->width * heightfield->height;
    tl_nav_span *spans = heightfield->spans;
    for (uint32_t c = 0; c < columns; c++) {
        const uint32_t end = heightfield->first_span[c + 1];
        for (uint32_t i = heightfield->first_span[c]; i < end; i++) {
            if (tl_nav_ceiling(spans, i, end) - spans[i].max < config->walkable_height) {
                spans[i].area = TL_NAV_NULL_AREA;
            }
        }
    }
}
