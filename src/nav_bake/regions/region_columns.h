// SPDX-License-Identifier: MIT
//
// Which columns of each region hold other floors too: the question "does a lie over b" asks these alone, and in a
// level of one storey there are none.

#ifndef TALUS_SRC_NAV_BAKE_REGION_COLUMNS_H
#define TALUS_SRC_NAV_BAKE_REGION_COLUMNS_H

#include "nav_bake/regions/regions.h"

/// Finds work->stacked, unless it is known.
tl_result tl_stacked_columns_find(tl_region_work *work);

/// Region r has the columns column[first[r]] .. column[first[r + 1] - 1], one entry a floor, ascending; of
/// work->stacked only.
typedef struct tl_region_columns {
    const tl_nav_compact *compact;
    const uint32_t *region;
    uint32_t *first; ///< [region_count + 1]
    uint32_t *column;
} tl_region_columns;

tl_result tl_region_columns_make(tl_region_work *work, tl_region_columns *columns_out);

#endif
