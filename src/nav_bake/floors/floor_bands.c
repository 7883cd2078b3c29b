// SPDX-License-Identifier: MIT
//
// Cuts a compact heightfield into bands of rows.

#include "nav_bake/floors/floor_bands.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>

enum { MIN_BAND_FLOORS = 2048, LOWEST_BAND = 16 }; // rows: what is done twice at a seam is little beside them

typedef struct band_search {
    const tl_nav_compact *compact;
    tl_floor_bands *bands;
} band_search;

static void find_runs_of_band(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const band_search *search = user;
    tl_floor_band *band = &search->bands->bands[index];
    band->result = tl_plain_runs_find(search->compact, band->begin, band->end, search->bands->allocator, &band->runs);
}

static uint32_t count_bands(const tl_nav_compact *compact, uint32_t workers)
{
    const uint32_t by_floors = compact->span_count / MIN_BAND_FLOORS, by_rows = compact->height / LOWEST_BAND;
    const uint32_t most = by_floors < by_rows ? by_floors : by_rows;
    return most < 1 ? 1 : most < workers ? most : workers;
}

// Each band ends with the row in which its share of the floors is full, but leaves a row to each band after it.
static void divide_floors(const tl_nav_compact *compact, const tl_floor_bands *bands)
{
    uint32_t z = 0;
    for (uint32_t k = 0; k < bands->count; k++) {
        const uint32_t after = bands->count - 1 - k;
        const uint64_t full = (uint64_t)compact->span_count * (k + 1) / bands->count;
        tl_floor_band *band = &bands->bands[k];
        band->first_row = z++;
        while (z < compact->height - after && (after == 0 || tl_first_floor_of_row(compact, z) < full)) {
            z++;
        }
        band->end_row = z;
        band->begin = tl_first_floor_of_row(compact, band->first_row);
        band->end = tl_first_floor_of_row(compact, z);
    }
}

tl_result tl_floor_bands_make(const tl_nav_compact *compact, const tl_host *host, tl_floor_bands *bands_out)
{
    tl_floor_bands *bands = bands_out;
    bands->allocator = host != NULL ? host->allocator : NULL;
    bands->count = count_bands(compact, tl_worker_count(host));
    bands->bands = tl_allocate_array(bands->allocator, bands->count, sizeof *bands->bands);
    if (bands->bands == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(bands->bands, 0, bands->count * sizeof *bands->bands);
    divide_floors(compact, bands);
    band_search search = { compact, bands };
    tl_run_tasks(host, find_runs_of_band, bands->count, &search);
    for (uint32_t k = 0; k < bands->count; k++) {
        if (bands->bands[k].result != TL_OK) {
            const tl_result result = bands->bands[k].result;
            tl_floor_bands_free(bands);
            return result;
        }
    }
    return TL_OK;
}

void tl_floor_bands_free(tl_floor_bands *bands)
{
    for (uint32_t k = 0; bands->bands != NULL && k < bands->count; k++) {
        tl_plain_runs_free(&bands->bands[k].runs);
    }
    tl_release_array(bands->allocator, bands->bands, bands->count, sizeof *bands->bands);
    bands->bands = NULL;
    bands->count = 0;
}
