// SPDX-License-Identifier: MIT
//
// Filters: which polygons count, and what a metre in them costs.

#include "nav_query/filter.h"

tl_nav_filter tl_default_nav_filter(void)
{
    tl_nav_filter filter;
    filter.include_flags = UINT64_MAX;
    filter.exclude_flags = 0;
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        filter.area_cost[area] = 1.0f;
    }
    return filter;
}

bool tl_nav_filter_passes(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon)
{
    return tl_nav_passes(filter, tile, polygon);
}

bool tl_nav_filter_costs(const tl_nav_filter *filter, float *least_out, bool *uniform_out)
{
    float least = filter->area_cost[0];
    float most = least;
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        float cost = filter->area_cost[area];
        if (!(cost > 0.0f) || !isfinite(cost)) {
            return false;
        }
        least = cost < least ? cost : least;
        most = cost > most ? cost : most;
    }
    *uniform_out = least == most;
    *least_out = least;
    return true;
}
