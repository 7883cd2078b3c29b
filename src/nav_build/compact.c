// SPDX-License-Identifier: MIT
//
// The open space above walkable spans, and which floor lies beside which.
// Source: Mikko Mononen, Recast (rcBuildCompactHeightfield).
//
// A neighbour is kept as an index into the floors, not as a number within the next column: all later stages walk from
// floor to floor, and so do it without looking at columns.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_build/column.h"

#include <string.h>

static uint32_t count_floors(const tl_nav_heightfield *field)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < field->span_count; i++) {
        count += field->spans[i].area != TL_NAV_NULL_AREA;
    }
    return count;
}

static tl_result allocate_floors(tl_nav_compact *compact)
{
    const uint64_t columns = (uint64_t)compact->width * compact->height, count = compact->span_count;
    compact->first_span = tl_allocate_array(compact->allocator, columns + 1, sizeof *compact->first_span);
    compact->floor = tl_allocate_array(compact->allocator, count, sizeof *compact->floor);
    compact->clearance = tl_allocate_array(compact->allocator, count, sizeof *compact->clearance);
    compact->area = tl_allocate_array(compact->allocator, count, sizeof *compact->area);
    compact->neighbour = tl_allocate_array(compact->allocator, 4 * count, sizeof *compact->neighbour);
    return compact->first_span && compact->floor && compact->clearance && compact->area && compact->neighbour
               ? TL_OK
               : TL_ERR_MEMORY;
}

static void fill_floors(const tl_nav_heightfield *field, tl_nav_compact *compact)
{
    const uint32_t columns = field->width * field->height;
    uint32_t at = 0;
    for (uint32_t c = 0; c < columns; c++) {
        const uint32_t end = field->first_span[c + 1];
        compact->first_span[c] = at;
        for (uint32_t i = field->first_span[c]; i < end; i++) {
            if (field->spans[i].area == TL_NAV_NULL_AREA) {
                continue;
            }
            uint32_t clearance = tl_nav_ceiling(field->spans, i, end) - field->spans[i].max;
            compact->floor[at] = field->spans[i].max;
            compact->clearance[at] = (uint16_t)(clearance < 0xffff ? clearance : 0xffff);
            compact->area[at] = (uint8_t)field->spans[i].area;
            for (uint32_t direction = 0; direction < 4; direction++) {
                compact->neighbour[4 * (size_t)at + direction] = TL_NAV_NO_SPAN;
            }
            at++;
        }
    }
    compact->first_span[columns] = at;
}

// Whether one can step between two floors: close enough in height, and with room above both.
static inline bool can_step(const tl_nav_compact *compact, uint32_t a, uint32_t b)
{
    const int32_t floor_a = compact->floor[a], floor_b = compact->floor[b];
    const int32_t ceiling_a = floor_a + compact->clearance[a], ceiling_b = floor_b + compact->clearance[b];
    const int32_t bottom = floor_a > floor_b ? floor_a : floor_b,
                  step = floor_a > floor_b ? floor_a - floor_b : floor_b - floor_a;
    const int32_t top = ceiling_a < ceiling_b ? ceiling_a : ceiling_b;
    return step <= (int32_t)compact->walkable_climb && top - bottom >= (int32_t)compact->walkable_height;
}

// Links the floors of a column with those of the column beside it in a direction, bottom up and in pairs: each with the
// lowest one that it can step to and that is not taken. So links are mutual and do not cross.
//
// One floor can step to two of a column only where twice the climb exceeds the agent's height: between those two lie
// a solid voxel and the room to pass, and both are within a climb. In all other settings these are Recast's links.
static void link_columns(tl_nav_compact *compact, uint32_t column, uint32_t beside, uint32_t direction)
{
    const uint16_t *floors = compact->floor;
    const uint32_t end = compact->first_span[column + 1], beside_end = compact->first_span[beside + 1];
    uint32_t next = compact->first_span[beside];
    for (uint32_t i = compact->first_span[column]; i < end; i++) {
        // Floors rise within a column: what lies too deep for this one does so for those above it.
        const int32_t lowest = (int32_t)floors[i] - (int32_t)compact->walkable_climb;
        const int32_t highest = (int32_t)floors[i] + (int32_t)compact->walkable_climb;
        while (next < beside_end && (int32_t)floors[next] < lowest) {
            next++;
        }
        for (uint32_t k = next; k < beside_end && (int32_t)floors[k] <= highest; k++) {
            if (can_step(compact, i, k)) {
                compact->neighbour[4 * (size_t)i + direction] = k;
                compact->neighbour[4 * (size_t)k + (direction ^ 2)] = i;
                next = k + 1;
                break;
            }
        }
    }
}

// Each column with the one after it on x and on z: that is every pair once.
static void link_row(tl_nav_compact *compact, uint32_t z)
{
    const uint32_t width = compact->width;
    const bool last_row = z + 1 == compact->height;
    for (uint32_t x = 0; x < width; x++) {
        const uint32_t column = z * width + x;
        if (compact->first_span[column] == compact->first_span[column + 1]) {
            continue;
        }
        if (x + 1 < width) {
            link_columns(compact, column, column + 1, 2);
        }
        if (!last_row) {
            link_columns(compact, column, column + width, 1);
        }
    }
}

enum { ROWS_PER_TASK = 32, BATCHES_PER_WORKER = 16 };

typedef struct link_job {
    tl_nav_compact *compact;
    uint32_t first_band;
} link_job;

static void link_rows_task(uint32_t index, uint32_t worker, void *task_user)
{
    (void)worker;
    const link_job *job = task_user;
    uint32_t z = (job->first_band + index) * ROWS_PER_TASK;
    uint32_t end = job->compact->height - z < ROWS_PER_TASK ? job->compact->height : z + ROWS_PER_TASK;
    for (; z < end; z++) {
        link_row(job->compact, z);
    }
}

static tl_result link_floors(tl_nav_compact *compact, const tl_host *host)
{
    const uint32_t bands = (compact->height - 1) / ROWS_PER_TASK + 1;
    uint32_t batch = host != NULL && host->progress != NULL ? tl_worker_count(host) * BATCHES_PER_WORKER : bands;
    link_job job = { compact, 0 };
    while (job.first_band < bands) {
        TL_TRY(tl_progress_update(host, "compact", job.first_band, bands));
        uint32_t left = bands - job.first_band, count = left < batch ? left : batch;
        tl_run_tasks(host, link_rows_task, count, &job);
        job.first_band += count;
    }
    return tl_progress_update(host, "compact", bands, bands);
}

tl_result tl_nav_compact_build(const tl_nav_config *config, const tl_nav_heightfield *heightfield, const tl_host *host,
                               tl_nav_compact *compact_out, tl_report *report_out)
{
    tl_nav_compact *compact = compact_out;
    tl_report_begin(report_out, "compact");
    memset(compact, 0, sizeof *compact);
    compact->width = heightfield->width;
    compact->height = heightfield->height;
    compact->border_size = config->border_size;
    compact->walkable_height = config->walkable_height;
    compact->walkable_climb = config->walkable_climb;
    compact->lattice = heightfield->lattice;
    compact->bounds = heightfield->bounds;
    compact->cell_size = heightfield->cell_size;
    compact->cell_height = heightfield->cell_height;
    compact->allocator = host != NULL ? host->allocator : NULL;
    compact->span_count = count_floors(heightfield);
    // TL_NAV_NO_SPAN, and four neighbours a floor, must not meet an index: 2^32 - 1 spans of a heightfield at most.
    tl_result result = allocate_floors(compact);
    if (result == TL_OK) {
        fill_floors(heightfield, compact);
        result = link_floors(compact, host);
    }
    if (result != TL_OK) {
        tl_nav_compact_free(compact);
    }
    return result;
}

void tl_nav_compact_free(tl_nav_compact *compact)
{
    if (compact == NULL) {
        return;
    }
    const tl_allocator *allocator = compact->allocator;
    const uint64_t columns = (uint64_t)compact->width * compact->height, count = compact->span_count;
    tl_release_array(allocator, compact->first_span, columns + 1, sizeof *compact->first_span);
    tl_release_array(allocator, compact->floor, count, sizeof *compact->floor);
    tl_release_array(allocator, compact->clearance, count, sizeof *compact->clearance);
    tl_release_array(allocator, compact->area, count, sizeof *compact->area);
    tl_release_array(allocator, compact->neighbour, 4 * count, sizeof *compact->neighbour);
    tl_release_array(allocator, compact->distance, count, sizeof *compact->distance);
    tl_release_array(allocator, compact->region, count, sizeof *compact->region);
    memset(compact, 0, sizeof *compact);
}
