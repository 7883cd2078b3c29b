// SPDX-License-Identifier: MIT
//
// Regions: the floors divided into connected patches of one area that do not overlap themselves in the plane.
//
// The driver: gives the tile's border regions of its own, calls the partition, filters and merges. The compact
// heightfield gets the result only when all of it has succeeded.

#include "nav_bake/regions/regions.h"

#include "base/assert.h"
#include "base/host.h"

#include <string.h>

static void paint_floors(const tl_nav_compact *compact, uint32_t begin, uint32_t end, uint32_t side, uint32_t *region)
{
    for (uint32_t i = begin; i < end; i++) {
        region[i] = compact->area[i] != TL_NAV_NULL_AREA ? TL_NAV_BORDER_REGION | side : 0;
    }
}

// The border of a tile belongs to its neighbours. Its four sides are regions of their own, so that contours know
// where they meet it: 1 x-, 2 x+, 3 z-, 4 z+; a corner belongs to the later side.
static void paint_border(const tl_nav_compact *compact, uint32_t *region)
{
    const uint32_t width = compact->width, height = compact->height, border = compact->border_size;
    for (uint32_t z = 0; z < height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * width;
        const uint32_t before = border < width ? border : width;
        if (z + border >= height || z < border) {
            paint_floors(compact, row[0], row[width], z + border >= height ? 4 : 3, region);
        } else {
            paint_floors(compact, row[0], row[before], 1, region);
            paint_floors(compact, row[width - before], row[width], 2, region);
        }
    }
}

// Watershed basins. What only they need is given back before the regions are merged.
static tl_result divide_by_watershed(tl_region_work *work)
{
    const tl_arena_mark mark = tl_arena_get_mark(work->arena);
    TL_TRY(tl_regions_watershed(work));
    tl_arena_rollback(work->arena, mark);
    TL_TRY(tl_regions_split_overlaps(work));
    if (!work->stacked.are_known) {
        tl_arena_rollback(work->arena, mark);
    }
    return TL_OK;
}

static tl_result divide_by_method(const tl_nav_config *config, tl_region_work *work)
{
    uint32_t merge_area = config->merge_region_area;
    merge_area = merge_area < TL_REGIONS_NO_MERGE ? merge_area : TL_REGIONS_NO_MERGE - 1;
    switch (config->partition) {
    case TL_NAV_WATERSHED:
        TL_TRY(divide_by_watershed(work));
        return tl_regions_filter_and_merge(work, config->min_region_area, merge_area);
    case TL_NAV_MONOTONE:
        TL_TRY(tl_regions_monotone(work));
        return tl_regions_filter_and_merge(work, config->min_region_area, merge_area);
    case TL_NAV_LAYERS:
        TL_TRY(tl_regions_layers(work));
        return tl_regions_filter_and_merge(work, config->min_region_area, TL_REGIONS_NO_MERGE);
    }
    return TL_ERR_ARGUMENT;
}

tl_result tl_nav_divide_regions(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact,
                                bool keep_distance, tl_report *report_out)
{
    tl_report_begin(report_out, "regions");
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    if ((unsigned)config->partition > (unsigned)TL_NAV_LAYERS) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "partition", "use a tl_nav_partition");
    }
    if (config->partition == TL_NAV_WATERSHED && compact->distance == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "distance", "call tl_nav_distance_field");
    }
    if (compact->span_count >= TL_NAV_BORDER_REGION) { // a region a span must be possible
        return tl_report_fail(report_out, TL_ERR_LIMIT, "span", compact->span_count, "use tiles or larger cells");
    }
    TL_TRY(tl_progress_update(host, "regions", 0, 1));

    uint32_t *region = tl_allocate_array(&compact->allocator, compact->span_count, sizeof *region);
    if (region == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(region, 0, compact->span_count * sizeof *region);
    if (compact->border_size > 0) {
        paint_border(compact, region);
    }
    tl_arena arena;
    tl_arena_init(&arena, host != NULL ? host->allocator : NULL);
    tl_region_work work = { .compact = compact,
                            .arena = &arena,
                            .region = region,
                            .region_count = 1,
                            .host = host,
                            .scrap = keep_distance ? NULL : compact->distance };
    tl_result result = divide_by_method(config, &work);
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + (uint64_t)compact->span_count * sizeof *region;
    }
    tl_arena_free(&arena);
    if (result == TL_OK) {
        result = tl_progress_update(host, "regions", 1, 1);
    }
    if (result != TL_OK) {
        tl_release_array(&compact->allocator, region, compact->span_count, sizeof *region);
        return result == TL_ERR_CORRUPT
                   ? tl_report_fail(report_out, result, "span", TL_NO_ELEMENT, "neighbour links must be mutual")
                   : result;
    }
    tl_release_array(&compact->allocator, compact->region, compact->span_count, sizeof *compact->region);
    compact->region = region;
    compact->region_count = work.region_count;
    compact->region_stats = work.stats;
    if (!keep_distance) {
        tl_release_array(&compact->allocator, compact->distance, compact->span_count, sizeof *compact->distance);
        compact->distance = NULL;
    }
    return TL_OK;
}

tl_result tl_nav_bake_regions(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact,
                              tl_report *report_out)
{
    return tl_nav_divide_regions(config, host, compact, true, report_out);
}
