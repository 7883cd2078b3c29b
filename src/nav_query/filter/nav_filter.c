// SPDX-License-Identifier: MIT
//
// Filters: which polygons count, and what a metre in them costs.

#include "nav_query/filter/nav_filter.h"

#include "base/exact_floats.h"

#include <string.h>

tl_nav_filter tl_default_nav_filter(void)
{
    tl_nav_filter filter;
    filter.include_flags = UINT64_MAX;
    filter.exclude_flags = 0;
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        filter.area_cost[area] = 1.0f;
    }
    filter.pass = NULL;
    filter.cost = NULL;
    filter.user = NULL;
    filter.slack = 0.0f;
    filter.cookie = TL_DEF_COOKIE;
    return filter;
}

bool tl_nav_filter_passes(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon)
{
    return tl_nav_passes(filter, tile, polygon);
}

// The lowest and the highest cost of an area. False: one is not finite, or not > 0.
//
// Floats above 0 are ordered as their bits are. What is not above 0 has bits that are none or negative, infinity and
// NaN have those from INFINITY_BITS on. So the lowest and the highest of the bits tell all, without a branch.
static bool cost_range(const tl_nav_filter *filter, float *min_out, float *max_out)
{
    enum { INFINITY_BITS = 0x7f800000 };
    int32_t min = INT32_MAX;
    int32_t max = INT32_MIN;
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        int32_t bits;
        memcpy(&bits, &filter->area_cost[area], sizeof bits);
        min = bits < min ? bits : min;
        max = bits > max ? bits : max;
    }
    memcpy(min_out, &min, sizeof min);
    memcpy(max_out, &max, sizeof max);
    return min > 0 && max < INFINITY_BITS;
}

bool tl_nav_filter_costs(const tl_nav_filter *filter, float *min_out, bool *uniform_out)
{
    float max;
    const bool is_good = cost_range(filter, min_out, &max);
    *uniform_out = *min_out == max && filter->cost == NULL;
    return is_good;
}

bool tl_nav_filter_costs_again(tl_nav_known_costs *known, const tl_nav_filter *filter, float *min_out,
                               bool *uniform_out)
{
    if (!known->is_good || memcmp(known->area_cost, filter->area_cost, sizeof known->area_cost) != 0) {
        known->is_good = cost_range(filter, &known->min, &known->max);
        memcpy(known->area_cost, filter->area_cost, sizeof known->area_cost);
    }
    *min_out = known->min;
    *uniform_out = known->min == known->max && filter->cost == NULL;
    return known->is_good;
}
