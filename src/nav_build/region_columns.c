// SPDX-License-Identifier: MIT
//
// Columns with several floors, by region: a counting sort.
//
// Rejected: a set of overlapping regions for each region, as Recast keeps. It has a pair for each two floors of a
// column, and has to be merged and renamed with the regions; a list of columns stays true under any renaming.

#include "nav_build/region_columns.h"

tl_result tl_region_columns_make(const tl_region_work *work, tl_region_columns *columns_out)
{
    const tl_nav_compact *compact = work->compact;
    const uint32_t *region = work->region;
    size_t column_count = (size_t)compact->width * compact->height;
    uint32_t *first = TL_PUSH_ZERO(work->arena, uint32_t, (uint64_t)work->region_count + 2);
    if (first == NULL) {
        return TL_ERR_MEMORY;
    }
    // next[r + 1] counts region r, then is where r begins, then where it ends: first[r + 1].
    uint32_t *next = first + 1;
    for (size_t c = 0; c < column_count; c++) {
        uint32_t begin = compact->first_span[c], end = compact->first_span[c + 1];
        for (uint32_t i = begin; end - begin > 1 && i < end; i++) {
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
    for (size_t c = 0; c < column_count; c++) {
        uint32_t begin = compact->first_span[c], end = compact->first_span[c + 1];
        for (uint32_t i = begin; end - begin > 1 && i < end; i++) {
            if (region[i] != 0 && !tl_region_is_border(region[i])) {
                column[next[region[i]]++] = (uint32_t)c;
            }
        }
    }
    columns_out->compact = compact;
    columns_out->region = region;
    columns_out->first = first;
    columns_out->column = column;
    return TL_OK;
}
