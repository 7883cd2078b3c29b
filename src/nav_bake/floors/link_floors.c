// SPDX-License-Identifier: MIT
//
// Links between the floors of neighbouring columns: each column with the next one on x and on z.

#include "nav_bake/floors/compact.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/voxels/batches.h"

#include <string.h>

enum { ROWS_PER_TASK = 32, LINK_TASKS_PER_WORKER = 16 };

// What linking reads and writes, without the compact heightfield around it.
typedef struct linker {
    const uint16_t *floor, *clearance;
    int32_t climb, room;
    int16_t *step;
    uint32_t *neighbour; ///< instead of step
} linker;

// Whether one can step between two floors: close enough in height, and with room above both.
static inline bool can_step(const linker *l, uint32_t a, uint32_t b)
{
    const int32_t floor_a = l->floor[a], floor_b = l->floor[b];
    const int32_t ceiling_a = floor_a + l->clearance[a], ceiling_b = floor_b + l->clearance[b];
    const int32_t bottom = floor_a > floor_b ? floor_a : floor_b, below = floor_a > floor_b ? floor_b : floor_a;
    const int32_t top = ceiling_a < ceiling_b ? ceiling_a : ceiling_b;
    return bottom - below <= l->climb && top - bottom >= l->room;
}

// b lies beside a in a direction, and after it.
static inline void set_link(const linker *l, uint32_t a, uint32_t b, uint32_t direction)
{
    if (l->step != NULL) {
        const int32_t step = (int32_t)(b - a);
        l->step[4 * (size_t)a + direction] = (int16_t)step;
        l->step[4 * (size_t)b + (direction ^ 2)] = (int16_t)-step;
    } else {
        l->neighbour[4 * (size_t)a + direction] = b;
        l->neighbour[4 * (size_t)b + (direction ^ 2)] = a;
    }
}

// Links the floors of a column with those of the column beside it in a direction, bottom up and in pairs: each with the
// lowest one that it can step to and that is not taken. So links are mutual and do not cross.
//
// One floor can step to two of a column only where twice the climb exceeds the agent's height: between those two lie
// a solid voxel and the room to pass, and both are within a climb. In all other settings these are Recast's links.
static inline void link_columns(const linker *l, uint32_t begin, uint32_t end, uint32_t beside, uint32_t beside_end,
                                uint32_t direction)
{
    for (uint32_t i = begin; i < end; i++) {
        // Floors rise within a column: what lies too deep for this one does so for those above it.
        const int32_t lowest = (int32_t)l->floor[i] - l->climb, highest = (int32_t)l->floor[i] + l->climb;
        while (beside < beside_end && (int32_t)l->floor[beside] < lowest) {
            beside++;
        }
        for (uint32_t k = beside; k < beside_end && (int32_t)l->floor[k] <= highest; k++) {
            if (can_step(l, i, k)) {
                set_link(l, i, k, direction);
                beside = k + 1;
                break;
            }
        }
    }
}

// Columns with one floor each, as most are, need no loop.
static inline void link_pair(const linker *l, uint32_t begin, uint32_t end, uint32_t beside, uint32_t beside_end,
                             uint32_t direction)
{
    if (end - begin != 1 || beside_end - beside != 1) {
        link_columns(l, begin, end, beside, beside_end, direction);
    } else if (can_step(l, begin, beside)) {
        set_link(l, begin, beside, direction);
    }
}

static linker linker_of(const tl_nav_compact *compact)
{
    return (linker){
        compact->floor, compact->clearance, (int32_t)compact->walkable_climb, (int32_t)compact->walkable_height,
        compact->step,  compact->neighbour
    };
}

// Each column with the one after it on x, and on z where `next_row` is not NULL: that is every pair once.
static void link_row(const linker *l, const uint32_t *row, const uint32_t *next_row, uint32_t width)
{
    for (uint32_t x = 0; x < width; x++) {
        const uint32_t begin = row[x], end = row[x + 1];
        if (begin == end) {
            continue;
        }
        if (x + 1 < width && row[x + 2] > end) {
            link_pair(l, begin, end, end, row[x + 2], 2);
        }
        if (next_row != NULL && next_row[x + 1] > next_row[x]) {
            link_pair(l, begin, end, next_row[x], next_row[x + 1], 1);
        }
    }
}

// Each column of a row with the one after it on z.
static void link_to_next_row(const tl_nav_compact *compact, uint32_t z)
{
    const linker l = linker_of(compact);
    const uint32_t width = compact->width;
    const uint32_t *row = compact->first_span + (size_t)z * width, *next_row = row + width;
    for (uint32_t x = 0; x < width; x++) {
        if (row[x + 1] > row[x] && next_row[x + 1] > next_row[x]) {
            link_pair(&l, row[x], row[x + 1], next_row[x], next_row[x + 1], 1);
        }
    }
}

// No floor of these steps anywhere yet.
static void clear_links(const tl_nav_compact *compact, uint32_t begin, uint32_t end)
{
    const size_t first = 4 * (size_t)begin, count = 4 * (size_t)(end - begin);
    if (compact->step != NULL) {
        memset(compact->step + first, 0, count * sizeof *compact->step);
    } else {
        memset(compact->neighbour + first, 0xff, count * sizeof *compact->neighbour); // TL_NAV_NO_SPAN
    }
}

// The links within a run of rows. Those to the next run come when all runs are cleared.
static tl_result link_rows(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_nav_compact *compact = user;
    const linker l = linker_of(compact);
    const uint32_t begin = index * ROWS_PER_TASK, end = tl_block_end(index, ROWS_PER_TASK, compact->height);
    const size_t width = compact->width;
    clear_links(compact, compact->first_span[begin * width], compact->first_span[end * width]);
    for (uint32_t z = begin; z < end; z++) {
        const uint32_t *row = compact->first_span + z * width;
        link_row(&l, row, z + 1 < end ? row + width : NULL, compact->width);
    }
    return TL_OK;
}

// No step is longer than the floors of two rows that follow one another.
static bool steps_fit(const tl_nav_compact *compact)
{
    const size_t width = compact->width;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + z * width;
        const uint32_t end = z + 1 < compact->height ? row[2 * width] : row[width];
        if (end - row[0] > (uint32_t)INT16_MAX) {
            return false;
        }
    }
    return true;
}

tl_result tl_nav_link_floors(const tl_host *host, tl_nav_compact *compact)
{
    const uint64_t count = 4 * (uint64_t)compact->span_count;
    if (steps_fit(compact)) {
        compact->step = tl_allocate_array(&compact->allocator, count, sizeof *compact->step);
    } else {
        compact->neighbour = tl_allocate_array(&compact->allocator, count, sizeof *compact->neighbour);
    }
    if (compact->step == NULL && compact->neighbour == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint32_t runs = tl_block_count(compact->height, ROWS_PER_TASK);
    TL_TRY(tl_run_batches(host, "compact", link_rows, runs, LINK_TASKS_PER_WORKER, compact));
    for (uint32_t run = 1; run < runs; run++) {
        link_to_next_row(compact, run * ROWS_PER_TASK - 1);
    }
    return TL_OK;
}
