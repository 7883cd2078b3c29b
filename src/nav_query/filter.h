// SPDX-License-Identifier: MIT
//
// Filters, inlined for the queries.

#ifndef TALUS_SRC_NAV_QUERY_FILTER_H
#define TALUS_SRC_NAV_QUERY_FILTER_H

#include <talus/nav_query.h>

/// NULL passes all but polygons without any flag, as the default filter does.
static inline bool tl_nav_passes(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon)
{
    uint64_t flags = tl_nav_tile_flags(tile, polygon);
    if (filter == NULL) {
        return flags != 0;
    }
    return (flags & filter->include_flags) != 0 && (flags & filter->exclude_flags) == 0;
}

/// Whether all costs are finite and above 0; the least of them, and whether they are all the same.
bool tl_nav_filter_costs(const tl_nav_filter *filter, float *least_out, bool *uniform_out);

#endif
