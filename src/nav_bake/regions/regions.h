// SPDX-License-Identifier: MIT
//
// What the partitions share. Each writes provisional regions 1 .. region_count - 1, 0 is none; border floors have
// TL_NAV_BORDER_REGION and do not change.

#ifndef TALUS_SRC_NAV_BAKE_REGIONS_H
#define TALUS_SRC_NAV_BAKE_REGIONS_H

#include <talus/nav_bake.h>

#include "base/arena.h"

/// The columns of several floors that tests of overlaps read. One whose floors have, one by one, the same regions as
/// those of the column of several floors before it tells nothing new and is left out.
typedef struct tl_stacked_columns {
    uint32_t *columns; ///< ascending
    uint32_t count;
    bool are_known; ///< for the regions as they are
} tl_stacked_columns;

typedef struct tl_region_work {
    const tl_nav_compact *compact;
    tl_arena *arena;
    uint32_t *region;      ///< [span_count]
    uint32_t region_count; ///< largest id without the border's + 1
    tl_nav_region_stats stats;
    const tl_host *host; ///< whose tasks may share the work; NULL: none
    uint16_t *scrap;     ///< compact->distance where it may be overwritten, else NULL
    tl_stacked_columns stacked;
} tl_region_work;

/// tl_nav_bake_regions that frees the distance field as soon as it is no longer needed: with `keep_distance` false it
/// is used up on the way.
tl_result tl_nav_divide_regions(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact,
                                bool keep_distance, tl_report *report);

/// Watershed: floods downhill from the floors that are farthest from any border.
tl_result tl_regions_watershed(tl_region_work *work);

/// Monotone: runs of a row, each joined with the one run that it touches in the row before.
/// No region has a hole, or lies over itself.
tl_result tl_regions_monotone(tl_region_work *work);

/// Layers: monotone regions, grown together as long as they do not lie over one another.
tl_result tl_regions_layers(tl_region_work *work);

/// Divides each region that lies over itself into connected ones that do not.
tl_result tl_regions_split_overlaps(tl_region_work *work);

/// Drops islands of fewer than min_area columns, unless they touch the tile's border. `merge_area` UINT32_MAX: that is
/// all; else small regions, and those that touch no wall, are merged into a neighbour. Region ids become compact.
tl_result tl_regions_filter_and_merge(tl_region_work *work, uint32_t min_area, uint32_t merge_area);

#define TL_REGIONS_NO_MERGE UINT32_MAX

/// The floors of a row but for the border's: from `begin` on, up to `end`.
typedef struct tl_inner_floors {
    uint32_t begin, end;
} tl_inner_floors;

static inline tl_inner_floors tl_inner_floors_of_row(const tl_nav_compact *compact, uint32_t z)
{
    const uint32_t border = compact->border_size, *row = compact->first_span + (size_t)z * compact->width;
    const bool is_inner = z >= border && z + border < compact->height && compact->width > 2 * border;
    return is_inner ? (tl_inner_floors){ row[border], row[compact->width - border] } : (tl_inner_floors){ 0, 0 };
}

static inline bool tl_region_is_border(uint32_t region)
{
    return (region & TL_NAV_BORDER_REGION) != 0;
}

#endif
