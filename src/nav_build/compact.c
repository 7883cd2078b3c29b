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
            at++;
        }
    }
    compact->first_span[columns] = at;
}

// Links the floors of one column to the lowest fitting floor of the column [begin, end) beside it.
static void link_column(tl_nav_compact *compact, uint32_t column, uint32_t direction, uint32_t begin, uint32_t end)
{
    const uint16_t *floors = compact->floor, *clearances = compact->clearance;
    const int32_t climb = (int32_t)compact->walkable_climb, room = (int32_t)compact->walkable_height;
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        const int32_t floor = floors[i], ceiling = floor + clearances[i];
        uint32_t found = TL_NAV_NO_SPAN;
        // Floors rise within a column: what lies too deep for this one does so for those above it.
        while (begin < end && (int32_t)floors[begin] < floor - climb) {
            begin++;
        }
        for (uint32_t k = begin; k < end && (int32_t)floors[k] <= floor + climb; k++) {
            int32_t beside_floor = floors[k], beside_ceiling = beside_floor + clearances[k];
            int32_t top = beside_ceiling < ceiling ? beside_ceiling : ceiling;
            int32_t bottom = beside_floor > floor ? beside_floor : floor;
            if (top - bottom >= room) {
                found = k;
                break;
            }
        }
        compact->neighbour[4 * (size_t)i + direction] = found;
    }
}

static void link_row(tl_nav_compact *compact, uint32_t z)
{
    for (uint32_t x = 0; x < compact->width; x++) {
        const uint32_t column = z * compact->width + x;
        if (compact->first_span[column] == compact->first_span[column + 1]) {
            continue;
        }
        for (uint32_t direction = 0; direction < 4; direction++) {
            uint32_t begin = 0, end = 0;
            if (tl_nav_has_column(compact->width, compact->height, x, z, direction)) {
                uint32_t beside = column + tl_nav_column_step(compact->width, direction);
                begin = compact->first_span[beside];
                end = compact->first_span[beside + 1];
            }
            link_column(compact, column, direction, begin, end);
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

// Of two floors of one column that both fit a third one beside them, that one takes the lower, but both may take it.
// Links that are not returned are dropped, so that outlines can be walked.
static void drop_one_sided_links(tl_nav_compact *compact)
{
    // Between two such floors lie a solid voxel and the room to pass: more than walkable_height. Both are within a
    // climb of the third.
    if (2 * compact->walkable_climb <= compact->walkable_height) {
        return;
    }
    uint32_t *neighbour = compact->neighbour;
    for (uint32_t i = 0; i < compact->span_count; i++) {
        for (uint32_t direction = 0; direction < 4; direction++) {
            uint32_t beside = neighbour[4 * (size_t)i + direction];
            if (beside != TL_NAV_NO_SPAN && neighbour[4 * (size_t)beside + (direction ^ 2)] != i) {
                // Whether another link is returned does not depend on this one: it is returned by none.
                neighbour[4 * (size_t)i + direction] = TL_NAV_NO_SPAN;
            }
        }
    }
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
    if (result == TL_OK) {
        drop_one_sided_links(compact);
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
