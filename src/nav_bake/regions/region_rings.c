// SPDX-License-Identifier: MIT
//
// Rings: one walk round each region's outer outline.
//
// The walk keeps the region on its right hand: along an edge that leads out of the region it turns clockwise, through
// one that does not it steps and turns back. Source: Mononen, Recast; Moore-neighbour tracing.
//
// A region's first floor by index has the least z, and of those the least x, so what lies beyond its -x edge is not of
// the region: the walk that starts there goes round the outer outline and not round a hole.

#include "nav_bake/regions/region_rings.h"

#include "base/assert.h"

#include <string.h>

typedef struct ring_walk {
    const tl_region_work *work;
    tl_region_rings *rings;
    uint32_t capacity;
    uint64_t steps_left; // each step leaves a pair (floor, direction) for good, so there are at most 4 a floor
} ring_walk;

static inline uint32_t region_across(const tl_region_work *work, uint32_t floor, uint32_t direction)
{
    uint32_t beside = tl_nav_compact_neighbour(work->compact, floor, direction);
    return beside != TL_NAV_NO_SPAN ? work->region[beside] : 0;
}

// Entries are kept as a plain stretch while a ring is walked, and linked at its end.
static tl_result append_ring_entry(ring_walk *walk, uint32_t region)
{
    tl_region_rings *rings = walk->rings;
    if (rings->entry_count == walk->capacity) {
        if (walk->capacity > UINT32_MAX / 2) {
            return TL_ERR_LIMIT;
        }
        tl_ring_entry *grown = tl_arena_grow(walk->work->arena, rings->entries, &walk->capacity, 256, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        rings->entries = grown;
    }
    rings->entries[rings->entry_count].region = region;
    rings->entries[rings->entry_count].next = rings->entry_count + 1;
    rings->entry_count++;
    return TL_OK;
}

static tl_result walk_ring(ring_walk *walk, uint32_t floor)
{
    const tl_nav_compact *compact = walk->work->compact;
    const uint32_t *region = walk->work->region;
    tl_region_rings *rings = walk->rings;
    const uint32_t own = region[floor], start = floor, begin = rings->entry_count;
    uint32_t direction = 0, last = own; // of the entries; none is of its own region
    do {
        if (walk->steps_left-- == 0) {
            return TL_ERR_CORRUPT;
        }
        const uint32_t beside = tl_nav_compact_neighbour(compact, floor, direction);
        const uint32_t across = beside != TL_NAV_NO_SPAN ? region[beside] : 0;
        if (across == own) {
            floor = beside;
            direction = (direction + 3) & 3;
            continue;
        }
        if (across != last) {
            TL_TRY(append_ring_entry(walk, across));
            last = across;
        }
        direction = (direction + 1) & 3;
    } while (floor != start || direction != 0);
    // The last stretch may continue into the first.
    if (rings->entry_count - begin > 1 &&
        rings->entries[rings->entry_count - 1].region == rings->entries[begin].region) {
        rings->entry_count--;
    }
    rings->entries[rings->entry_count - 1].next = begin;
    rings->head[own] = begin;
    return TL_OK;
}

// Counts the floors of a run, and walks the ring of a region that is met first.
static tl_result add_region_run(ring_walk *walk, uint32_t first, uint32_t end)
{
    const tl_region_work *work = walk->work;
    tl_region_rings *rings = walk->rings;
    const uint32_t region = work->region[first];
    if (region == 0 || tl_region_is_border(region)) {
        return TL_OK;
    }
    const bool is_first = rings->span_count[region] == 0;
    rings->span_count[region] += end - first;
    if (!is_first) {
        return TL_OK;
    }
    rings->area[region] = work->compact->area[first];
    return region_across(work, first, 0) != region ? walk_ring(walk, first) : TL_ERR_CORRUPT;
}

tl_result tl_region_rings_make(const tl_region_work *work, tl_region_rings *rings_out)
{
    const tl_nav_compact *compact = work->compact;
    memset(rings_out, 0, sizeof *rings_out);
    rings_out->head = TL_PUSH(work->arena, uint32_t, work->region_count);
    rings_out->span_count = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    rings_out->area = TL_PUSH_ZERO(work->arena, uint8_t, work->region_count);
    if (rings_out->head == NULL || rings_out->span_count == NULL || rings_out->area == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t r = 0; r < work->region_count; r++) {
        rings_out->head[r] = TL_NO_REGION_RING;
    }
    ring_walk walk = { work, rings_out, 0, 4 * (uint64_t)compact->span_count };
    for (uint32_t z = 0; z < compact->height; z++) {
        const tl_inner_floors row = tl_inner_floors_of_row(compact, z);
        for (uint32_t i = row.begin, end; i < row.end; i = end) {
            for (end = i + 1; end < row.end && work->region[end] == work->region[i]; end++) {
            }
            TL_TRY(add_region_run(&walk, i, end));
        }
    }
    return TL_OK;
}
