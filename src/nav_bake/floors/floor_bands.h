// SPDX-License-Identifier: MIT
//
// The floors of a compact heightfield in bands of rows, one for each of the host's workers, with their plain runs.

#ifndef TALUS_SRC_NAV_BAKE_FLOOR_BANDS_H
#define TALUS_SRC_NAV_BAKE_FLOOR_BANDS_H

#include "nav_bake/floors/plain_runs.h"

typedef struct tl_floor_band {
    uint32_t first_row, end_row;
    uint32_t begin, end; ///< floors
    tl_plain_runs runs;
    tl_result result; ///< of the search for them
} tl_floor_band;

typedef struct tl_floor_bands {
    tl_floor_band *bands; ///< [count] in the order of the rows
    uint32_t count;       ///< >= 1
    const tl_allocator *allocator;
} tl_floor_bands;

/// Bands of about the same number of floors, one for a small field; their runs are found as tasks. `host` may be NULL.
tl_result tl_floor_bands_make(const tl_nav_compact *compact, const tl_host *host, tl_floor_bands *bands_out);
void tl_floor_bands_free(tl_floor_bands *bands);

/// Where the floors of row z begin; z may be compact->height.
static inline uint32_t tl_first_floor_of_row(const tl_nav_compact *compact, uint32_t z)
{
    return compact->first_span[(size_t)z * compact->width];
}

#endif
