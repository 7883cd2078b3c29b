// SPDX-License-Identifier: MIT
//
// Filters, inlined for the queries.

#ifndef TALUS_SRC_NAV_QUERY_NAV_FILTER_H
#define TALUS_SRC_NAV_QUERY_NAV_FILTER_H

#include <math.h>
#include <talus/nav_query.h>

/// Whether a filter was begun with its defaults, for which NULL stands too.
static inline bool tl_nav_filter_is_begun(const tl_nav_filter *filter)
{
    return filter == NULL || filter->cookie == TL_DEF_COOKIE;
}

/// Whether a filter's slack is one that searches of paths take.
static inline bool tl_nav_filter_has_slack(const tl_nav_filter *filter)
{
    return filter == NULL || (filter->slack >= 0.0f && filter->slack <= TL_NAV_MAX_SLACK);
}

/// NULL passes all but polygons without any flag, as the default filter does.
static inline bool tl_nav_passes(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon)
{
    uint64_t flags = tl_nav_tile_flags(tile, polygon);
    if (filter == NULL) {
        return flags != 0;
    }
    return (flags & filter->include_flags) != 0 && (flags & filter->exclude_flags) == 0 &&
           (filter->pass == NULL || filter->pass(tile, polygon, filter->user));
}

/// What it costs to go straight through a polygon; infinite when it cannot be done.
static inline float tl_nav_cost_between(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon,
                                        tl_vec3 from, tl_vec3 to)
{
    float metres = tl_distance(from, to);
    if (filter == NULL) {
        return metres;
    }
    float cost = filter->area_cost[tl_nav_tile_area(tile, polygon)] * metres;
    if (filter->cost != NULL) {
        cost = filter->cost(tile, polygon, from, to, cost, filter->user);
        cost = cost >= 0.0f ? cost : INFINITY;
    }
    return cost;
}

/// Whether all area costs are finite and above 0; the lowest of them, and whether every metre costs the same.
bool tl_nav_filter_costs(const tl_nav_filter *filter, float *min_out, bool *uniform_out);

/// The costs that were looked through last, zeroed at first: comparing all areas takes a tenth of looking through them.
typedef struct tl_nav_known_costs {
    float area_cost[TL_NAV_MAX_AREA + 1];
    float min, max;
    bool is_good;
} tl_nav_known_costs;

/// tl_nav_filter_costs, by what is known.
bool tl_nav_filter_costs_again(tl_nav_known_costs *known, const tl_nav_filter *filter, float *min_out,
                               bool *uniform_out);

#endif
