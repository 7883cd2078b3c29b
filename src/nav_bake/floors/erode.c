// SPDX-License-Identifier: MIT
//
// Erosion: floors nearer to a wall or ledge than the agent's radius are not walkable, by chamfer distance (chamfer.c).
// Source: Mikko Mononen, Recast (rcErodeWalkableArea).

#include "nav_bake/floors/erode.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/floors/chamfer.h"

#include <string.h>

// Floors of a band nearer than the limit are no longer walkable.
static void drop_near_floors(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_chamfer *c = user;
    const tl_floor_band *band = &c->bands->bands[index];
    uint8_t *restrict area = c->compact->area;
    const uint16_t *restrict distance = c->distance;
    for (uint32_t i = band->begin; i < band->end; i++) {
        area[i] = distance[i] < c->far_away ? TL_NAV_NULL_AREA : area[i];
    }
}

tl_result tl_nav_erode_bands(const tl_nav_config *config, const tl_host *host, const tl_floor_bands *bands,
                             tl_nav_compact *compact)
{
    if (config->walkable_radius == 0 || compact->span_count == 0) {
        return TL_OK;
    }
    // Farther floors need no exact distance.
    const uint32_t limit = TL_EDGE_STEP * config->walkable_radius, count = compact->span_count;
    const bool holes = memchr(compact->area, TL_NAV_NULL_AREA, count) != NULL;
    tl_chamfer c = { compact, bands, holes ? TL_BORDER_OF_WALKABLE : TL_BORDER_OF_GROUND,
                     (uint16_t)(limit < TL_FAR_AWAY ? limit : TL_FAR_AWAY),
                     tl_allocate_array(bands->allocator, count, sizeof *c.distance) };
    if (c.distance == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_chamfer_sweep_forward(&c, host);
    tl_chamfer_sweep_backward(&c, host);
    tl_run_tasks(host, drop_near_floors, bands->count, &c);
    tl_release_array(bands->allocator, c.distance, count, sizeof *c.distance);
    return TL_OK;
}

tl_result tl_nav_erode(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "erode");
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "erode", 0, 1));
    tl_floor_bands bands;
    TL_TRY(tl_floor_bands_make(compact, host, &bands));
    const tl_result result = tl_nav_erode_bands(config, host, &bands, compact);
    tl_floor_bands_free(&bands);
    return result == TL_OK ? tl_progress_update(host, "erode", 1, 1) : result;
}
