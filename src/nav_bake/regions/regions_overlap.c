// SPDX-License-Identifier: MIT
//
// Regions that overlap themselves in the plane are divided.
//
// On a spiral stair or a ramp that winds under a bridge a watershed region can meet its own column again, one storey
// up. Its outline then crosses itself and cannot be triangulated. Recast reports this and goes on; here such a region
// is flooded again, breadth first from its lowest index, and the flood stays out of columns that it already holds.
// What is left becomes further regions. Regions that do not overlap are not touched.

#include "base/assert.h"
#include "nav_bake/floors/links.h"
#include "nav_bake/regions/region_columns.h"
#include "nav_bake/voxels/column.h"

#include <string.h>

typedef struct placed_floor {
    uint32_t floor, column;
} placed_floor;

typedef struct region_splitter {
    const tl_nav_compact *compact;
    uint32_t *region;
    placed_floor *queue; // room for all floors of regions that overlap
} region_splitter;

// Marks the regions that have two floors in a column, and counts them. `last_column` is zeroed.
static tl_result find_overlaps(tl_region_work *work, uint32_t *last_column, uint8_t *overlaps, uint32_t *found_out)
{
    const tl_nav_compact *compact = work->compact;
    TL_TRY(tl_stacked_columns_find(work));
    const tl_stacked_columns stacked = work->stacked;
    uint32_t found = 0;
    for (uint32_t k = 0; k < stacked.count; k++) {
        const uint32_t c = stacked.columns[k];
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            uint32_t region = work->region[i];
            if (region == 0 || tl_region_is_border(region)) {
                continue;
            }
            if (last_column[region] == c + 1 && overlaps[region] == 0) {
                overlaps[region] = 1;
                found++;
            }
            last_column[region] = c + 1;
        }
    }
    *found_out = found;
    return TL_OK;
}

static bool column_holds(const region_splitter *s, uint32_t column, uint32_t region)
{
    for (uint32_t i = s->compact->first_span[column]; i < s->compact->first_span[column + 1]; i++) {
        if (s->region[i] == region) {
            return true;
        }
    }
    return false;
}

static void flood_piece(region_splitter *s, placed_floor seed, uint32_t piece)
{
    uint32_t whole = s->region[seed.floor], head = 0, tail = 0;
    s->region[seed.floor] = piece;
    s->queue[tail++] = seed;
    while (head < tail) {
        const placed_floor from = s->queue[head++];
        const tl_links links = tl_floor_links(s->compact, from.floor);
        for (uint32_t d = 0; d < 4; d++) {
            const placed_floor to = { links.to[d], from.column + tl_nav_column_step(s->compact->width, d) };
            if (to.floor != TL_NAV_NO_SPAN && s->region[to.floor] == whole && !column_holds(s, to.column, piece)) {
                s->region[to.floor] = piece;
                s->queue[tail++] = to;
            }
        }
    }
}

static tl_result split_region(tl_region_work *work, const uint8_t *overlaps)
{
    const tl_nav_compact *compact = work->compact;
    const uint32_t whole_count = work->region_count;
    uint32_t floors = 0;
    for (uint32_t i = 0; i < compact->span_count; i++) {
        floors += work->region[i] < whole_count && overlaps[work->region[i]] != 0;
    }
    region_splitter s = { compact, work->region, TL_PUSH(work->arena, placed_floor, floors) };
    if (s.queue == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            uint32_t region = work->region[i];
            if (region != 0 && region < whole_count && overlaps[region] != 0) {
                flood_piece(&s, (placed_floor){ i, c }, work->region_count++);
            }
        }
    }
    return TL_OK;
}

tl_result tl_regions_split_overlaps(tl_region_work *work)
{
    uint32_t *last_column = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    uint8_t *overlaps = TL_PUSH_ZERO(work->arena, uint8_t, work->region_count);
    if (last_column == NULL || overlaps == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(find_overlaps(work, last_column, overlaps, &work->stats.split));
    if (work->stats.split == 0) {
        return TL_OK;
    }
    work->stacked.are_known = false;
    return split_region(work, overlaps);
}
