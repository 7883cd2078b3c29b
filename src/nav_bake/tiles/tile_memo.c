// SPDX-License-Identifier: MIT
//
// What is kept of a tile between rebakes, so that one in which few floors have changed their area is cheap.
//
// The memo keeps the distance field of the floors' base areas, and a rebake updates a copy of it where areas differ. So
// nothing depends on earlier rebakes, and the tile has the bytes of one that is baked at once.

#include "nav_bake/tiles/tile_bake.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/regions/distance_update.h"

#include <string.h>

struct tl_nav_tile_memo {
    tl_allocator allocator;
    uint32_t span_count;
    tl_distance_stages distance; // of the base areas; none unless the regions are watershed
};

static tl_result make_memo(const tl_nav_config *config, const tl_nav_compact *compact, const uint8_t *base_area,
                           const tl_allocator *allocator, tl_nav_tile_memo **memo_out)
{
    tl_nav_tile_memo *memo = tl_allocate_array(allocator, 1, sizeof *memo);
    if (memo == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(memo, 0, sizeof *memo);
    memo->allocator = *allocator;
    memo->span_count = compact->span_count;
    if (config->partition == TL_NAV_WATERSHED) {
        tl_nav_compact bare = *compact;
        bare.area = (uint8_t *)(uintptr_t)base_area; // is only read
        if (tl_distance_stages_make(&bare, allocator, &memo->distance) != TL_OK) {
            tl_nav_tile_memo_free(memo);
            return TL_ERR_MEMORY;
        }
    }
    *memo_out = memo;
    return TL_OK;
}

static tl_result rebake_with_memo(const tl_nav_config *config, tl_nav_compact *compact, const uint8_t *base_area,
                                  const tl_nav_tile_memo *memo, const tl_host *host, tl_nav_tile_stack *stack_out,
                                  tl_nav_bake_report *report_out)
{
    const bool watershed = config->partition == TL_NAV_WATERSHED;
    if (watershed) {
        tl_release_array(&compact->allocator, compact->distance, compact->span_count, sizeof *compact->distance);
        compact->distance = NULL;
        TL_TRY(tl_distance_field_update(base_area, &memo->distance, &memo->allocator, compact));
    }
    return tl_nav_tile_bake_from_distance(config, compact, watershed, host, stack_out, report_out);
}

// Without a branch, and told that the arrays are apart: compilers take 16 floors at once.
static bool find_taken(const uint8_t *base_area, const uint8_t *area, uint32_t count, uint8_t *restrict taken)
{
    uint8_t any = 0;
    for (uint32_t i = 0; i < count; i++) {
        taken[i] = (uint8_t)((base_area[i] != TL_NAV_NULL_AREA) & (area[i] == TL_NAV_NULL_AREA));
        any |= taken[i];
    }
    return any != 0;
}

// Obstacles' floors: contours keep away from these.
static tl_result mark_taken(tl_nav_compact *compact, const uint8_t *base_area, const tl_allocator *allocator)
{
    uint8_t *taken = tl_allocate_array(allocator, compact->span_count, sizeof *taken);
    if (taken == NULL) {
        return TL_ERR_MEMORY;
    }
    if (find_taken(base_area, compact->area, compact->span_count, taken)) {
        compact->taken = taken;
    } else {
        tl_release_array(allocator, taken, compact->span_count, sizeof *taken);
    }
    return TL_OK;
}

static void free_taken(tl_nav_compact *compact, const tl_allocator *allocator)
{
    union {
        const uint8_t *read;
        uint8_t *write;
    } taken = { compact->taken };
    tl_release_array(allocator, taken.write, compact->span_count, sizeof *taken.write);
    compact->taken = NULL;
}

tl_result tl_nav_tile_rebake(const tl_nav_config *config, tl_nav_compact *compact, const uint8_t *base_area,
                             tl_nav_tile_memo **memo, const tl_host *host, tl_nav_tile_stack *stack_out,
                             tl_nav_bake_report *report_out)
{
    tl_report *base = tl_nav_bake_report_begin(report_out, "regions");
    TL_REFUSE_NULL(stack_out, base);
    memset(stack_out, 0, sizeof *stack_out);
    TL_REFUSE_NULL(config, base);
    TL_REFUSE_NULL(compact, base);
    TL_REFUSE_NULL(base_area, base);
    TL_REFUSE_NULL(memo, base);
    TL_ASSERT(*memo == NULL || (*memo)->span_count == compact->span_count);
    const tl_allocator allocator = tl_allocator_or_default(host != NULL ? host->allocator : NULL);
    const bool first_time = *memo == NULL;
    if (first_time && memcmp(compact->area, base_area, compact->span_count) == 0) {
        return tl_nav_tile_bake_from_compact(config, compact, host, stack_out, report_out); // it may never be marked
    }
    if (first_time) {
        TL_TRY(make_memo(config, compact, base_area, &allocator, memo));
    }
    tl_result result = mark_taken(compact, base_area, &allocator);
    if (result == TL_OK) {
        result = rebake_with_memo(config, compact, base_area, *memo, host, stack_out, report_out);
    }
    free_taken(compact, &allocator);
    if (result != TL_OK && first_time) {
        tl_nav_tile_memo_free(*memo);
        *memo = NULL;
    }
    return result;
}

void tl_nav_tile_memo_free(tl_nav_tile_memo *memo)
{
    if (memo != NULL) {
        const tl_allocator allocator = memo->allocator;
        tl_distance_stages_free(&memo->distance, memo->span_count, &allocator);
        tl_release_array(&allocator, memo, 1, sizeof *memo);
    }
}

uint64_t tl_nav_tile_memo_bytes(const tl_nav_tile_memo *memo)
{
    if (memo == NULL) {
        return 0;
    }
    return sizeof *memo + tl_distance_stages_bytes(&memo->distance, memo->span_count);
}
