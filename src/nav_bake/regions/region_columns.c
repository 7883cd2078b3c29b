// SPDX-License-Identifier: MIT
//
// Columns with several floors, by region: a counting sort.
//
// Neighbouring columns mostly hold the same regions: under a roof all hold the same two. A column with the regions of
// the one before it tells nothing new and is left out, so that those at the regions' borders are left.
//
// Rejected: a set of overlapping regions for each region, as Recast keeps. It has a pair for each two floors of a
// column, and has to be merged and renamed with the regions; a list of columns stays true under any renaming.

#include "nav_bake/regions/region_columns.h"

#include "base/assert.h"

#include <string.h>

// Whether the `count` floors from a and from b on have the same regions.
static inline bool same_regions(const uint32_t *region, uint32_t a, uint32_t b, uint32_t count)
{
    uint32_t k = 0;
    while (k < count && region[a + k] == region[b + k]) {
        k++;
    }
    return k == count;
}

static tl_result append_column(tl_region_work *work, uint32_t *capacity, uint32_t column)
{
    tl_stacked_columns *stacked = &work->stacked;
    if (stacked->count == *capacity) {
        uint32_t *grown = tl_arena_grow(work->arena, stacked->columns, capacity, 256, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        stacked->columns = grown;
    }
    stacked->columns[stacked->count++] = column;
    return TL_OK;
}

tl_result tl_stacked_columns_find(tl_region_work *work)
{
    const tl_nav_compact *compact = work->compact;
    const uint32_t *region = work->region, *first = compact->first_span, border = compact->border_size;
    uint32_t capacity = 0, before = 0, before_count = 0; // the floors of the column of several floors before this one
    if (work->stacked.are_known) {
        return TL_OK;
    }
    work->stacked = (tl_stacked_columns){ NULL, 0, false };
    for (uint32_t z = border; z + border < compact->height; z++) {
        const uint32_t end = (z + 1) * compact->width - border;
        for (uint32_t c = z * compact->width + border; c < end; c++) {
            const uint32_t begin = first[c], count = first[c + 1] - begin;
            if (count <= 1) {
                continue;
            }
            if (count != before_count || !same_regions(region, before, begin, count)) {
                TL_TRY(append_column(work, &capacity, c));
            }
            before = begin;
            before_count = count;
        }
    }
    work->stacked.are_known = true;
    return TL_OK;
}

tl_result tl_region_columns_make(tl_region_work *work, tl_region_columns *columns_out)
{
    const tl_nav_compact *compact = work->compact;
    const uint32_t *region = work->region;
    TL_TRY(tl_stacked_columns_find(work));
    const tl_stacked_columns stacked = work->stacked;
    uint32_t *first = TL_PUSH_ZERO(work->arena, uint32_t, (uint64_t)work->region_count + 2);
    if (first == NULL) {
        return TL_ERR_MEMORY;
    }
    // next[r + 1] counts region r, then is where r begins, then where it ends: first[r + 1].
    uint32_t *next = first + 1;
    for (uint32_t k = 0; k < stacked.count; k++) {
        const uint32_t c = stacked.columns[k];
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            if (region[i] != 0 && !tl_region_is_border(region[i])) {
                next[region[i] + 1]++;
            }
        }
    }
    for (uint32_t r = 1; r <= work->region_count; r++) {
        next[r] += next[r - 1];
    }
    uint32_t *column = TL_PUSH(work->arena, uint32_t, next[work->region_count]);
    if (column == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t k = 0; k < stacked.count; k++) {
        const uint32_t c = stacked.columns[k];
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            if (region[i] != 0 && !tl_region_is_border(region[i])) {
                column[next[region[i]]++] = c;
            }
        }
    }
    columns_out->compact = compact;
    columns_out->region = region;
    columns_out->first = first;
    columns_out->column = column;
    return TL_OK;
}
