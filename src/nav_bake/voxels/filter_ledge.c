// SPDX-License-Identifier: MIT
//
// Floors beside a drop, or among neighbours that differ in height by more than a step, are not walkable.
// Source: Mikko Mononen, Recast (rcFilterLedgeSpans).
//
// The rule reads only heights, never areas, so the spans may be judged in any order.

#include "base/assert.h"
#include "nav_bake/voxels/column.h"

typedef struct floor_range {
    int32_t lowest, highest; ///< floors within a step, the span's own included
} floor_range;

// An agent that stands on a floor. All in voxels.
typedef struct standing_agent {
    int32_t floor, ceiling;
    int32_t height, climb;
} standing_agent;

// Whether the agent can fall more than its climb into the column of the spans [begin, end). Widens the range of the
// floors that it can step to.
static bool drops_into(const standing_agent *agent, const tl_nav_span *spans, uint32_t begin, uint32_t end,
                       floor_range *range)
{
    const int32_t floor = agent->floor, ceiling = agent->ceiling;
    const int32_t walkable_height = agent->height, climb = agent->climb;
    // Below the column's first span there is no floor at all: room enough to go there is room to fall.
    int32_t first_bottom = begin < end ? spans[begin].min : (int32_t)TL_NAV_OPEN_SKY;
    if ((first_bottom < ceiling ? first_bottom : ceiling) - floor >= walkable_height) {
        return true;
    }
    for (uint32_t i = begin; i < end; i++) {
        int32_t beside_floor = spans[i].max, beside_ceiling = (int32_t)tl_nav_ceiling(spans, i, end);
        if (beside_floor > floor + climb) {
            return false; // and so are all above it: neither a drop nor a step
        }
        int32_t top = beside_ceiling < ceiling ? beside_ceiling : ceiling;
        int32_t bottom = beside_floor > floor ? beside_floor : floor;
        if (top - bottom < walkable_height) {
            continue;
        }
        if (beside_floor < floor - climb) {
            return true;
        }
        range->lowest = beside_floor < range->lowest ? beside_floor : range->lowest;
        range->highest = beside_floor > range->highest ? beside_floor : range->highest;
    }
    return false;
}

static bool is_ledge(const tl_nav_config *config, const tl_nav_heightfield *field, uint32_t column, uint32_t span)
{
    const int32_t floor = field->spans[span].max;
    const int32_t ceiling = (int32_t)tl_nav_ceiling(field->spans, span, field->first_span[column + 1]);
    const int32_t climb = (int32_t)config->walkable_climb;
    const standing_agent agent = { floor, ceiling, (int32_t)config->walkable_height, climb };
    floor_range range = { floor, floor };
    for (uint32_t direction = 0; direction < 4; direction++) {
        uint32_t beside = column + tl_nav_column_step(field->width, direction);
        if (drops_into(&agent, field->spans, field->first_span[beside], field->first_span[beside + 1], &range)) {
            return true;
        }
    }
    return range.highest - range.lowest > climb;
}

void tl_nav_filter_ledge_spans(const tl_nav_config *config, tl_nav_heightfield *heightfield)
{
    TL_ASSERT(config != NULL && heightfield != NULL);
    tl_nav_heightfield *field = heightfield;
    for (uint32_t z = 0; z < field->height; z++) {
        for (uint32_t x = 0; x < field->width; x++) {
            const uint32_t column = z * field->width + x;
            // Beyond the field nothing is known: its rim counts as a ledge.
            const bool rim = x == 0 || z == 0 || x + 1 == field->width || z + 1 == field->height;
            for (uint32_t i = field->first_span[column]; i < field->first_span[column + 1]; i++) {
                if (field->spans[i].area != TL_NAV_NULL_AREA && (rim || is_ledge(config, field, column, i))) {
                    field->spans[i].area = TL_NAV_NULL_AREA;
                }
            }
        }
    }
}
