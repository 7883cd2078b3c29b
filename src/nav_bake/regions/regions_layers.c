// SPDX-License-Identifier: MIT
//
// Layers partition: monotone regions are joined, breadth first, as long as they do not overlap in the plane.
//
// The result has few, large regions, possibly with holes.
// Source: Mononen, Recast (heightfield layers).
//
// Why it is fast here: what a layer lies over is stamped on the regions, and asked in one load; neighbours are
// collected by a counting sort. (Recast searches growing lists for each pair.) Only regions of one area join.

#include "nav_bake/regions/region_columns.h"
#include "nav_bake/regions/regions.h"

#include "base/assert.h"

#include <string.h>

// Region r touches to[first[r]] .. to[first[r + 1] - 1], in the order of the floors; repeats are possible.
typedef struct adjacency {
    uint32_t *first; // [region_count + 2]
    uint32_t *to;
} adjacency;

static bool is_other_region(const tl_region_work *work, uint32_t floor, uint32_t beside)
{
    return beside != TL_NAV_NO_SPAN && work->region[beside] != 0 && work->region[beside] != work->region[floor] &&
           !tl_region_is_border(work->region[beside]) && work->compact->area[beside] == work->compact->area[floor];
}

// Visits each pair of regions that touch, skipping what repeats the region's last one. Counts them at
// count[region + 1], or with `to` stores them at to[count[region]++].
static void visit_pairs(const tl_region_work *work, uint32_t *last, uint32_t *count, uint32_t *to)
{
    memset(last, 0, work->region_count * sizeof *last);
    for (uint32_t i = 0; i < work->compact->span_count; i++) {
        uint32_t own = work->region[i];
        if (own == 0 || tl_region_is_border(own)) {
            continue;
        }
        for (uint32_t d = 0; d < 4; d++) {
            uint32_t beside = tl_nav_compact_neighbour(work->compact, i, d);
            if (!is_other_region(work, i, beside) || last[own] == work->region[beside]) {
                continue;
            }
            last[own] = work->region[beside];
            if (to == NULL) {
                count[own + 1]++;
            } else {
                to[count[own]++] = work->region[beside];
            }
        }
    }
}

static tl_result make_adjacency(const tl_region_work *work, adjacency *out)
{
    uint32_t *last = TL_PUSH(work->arena, uint32_t, work->region_count);
    out->first = TL_PUSH_ZERO(work->arena, uint32_t, (uint64_t)work->region_count + 2);
    if (last == NULL || out->first == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t *next = out->first + 1; // becomes first[r + 1] when region r is full
    visit_pairs(work, last, next, NULL);
    for (uint32_t r = 1; r <= work->region_count; r++) {
        next[r] += next[r - 1];
    }
    out->to = TL_PUSH(work->arena, uint32_t, next[work->region_count]);
    if (out->to == NULL) {
        return TL_ERR_MEMORY;
    }
    visit_pairs(work, last, next, out->to);
    return TL_OK;
}

// All regions that share a column with `region` are now under or over the layer.
static void stamp_layers_below(const tl_region_columns *columns, uint32_t region, uint32_t layer,
                               uint32_t *overlapped_by)
{
    const tl_nav_compact *compact = columns->compact;
    for (uint32_t k = columns->first[region]; k < columns->first[region + 1]; k++) {
        uint32_t column = columns->column[k];
        for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
            uint32_t other = columns->region[i];
            if (other != region && other != 0 && !tl_region_is_border(other)) {
                overlapped_by[other] = layer;
            }
        }
    }
}

tl_result tl_regions_layers(tl_region_work *work)
{
    TL_TRY(tl_regions_monotone(work));
    tl_region_columns columns;
    adjacency touching;
    TL_TRY(tl_region_columns_make(work, &columns));
    TL_TRY(make_adjacency(work, &touching));
    uint32_t *layer_of = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    uint32_t *overlapped_by = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    uint32_t *queue = TL_PUSH(work->arena, uint32_t, work->region_count);
    if (layer_of == NULL || overlapped_by == NULL || queue == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t layer_count = 1;
    for (uint32_t root = 1; root < work->region_count; root++) {
        if (layer_of[root] != 0) {
            continue;
        }
        uint32_t layer = layer_count++, head = 0, tail = 0;
        queue[tail++] = root;
        layer_of[root] = layer;
        stamp_layers_below(&columns, root, layer, overlapped_by);
        while (head < tail) {
            uint32_t region = queue[head++];
            for (uint32_t k = touching.first[region]; k < touching.first[region + 1]; k++) {
                uint32_t other = touching.to[k];
                if (layer_of[other] == 0 && overlapped_by[other] != layer) {
                    layer_of[other] = layer;
                    stamp_layers_below(&columns, other, layer, overlapped_by);
                    queue[tail++] = other;
                }
            }
        }
    }
    for (uint32_t i = 0; i < work->compact->span_count; i++) {
        if (!tl_region_is_border(work->region[i])) {
            work->region[i] = layer_of[work->region[i]];
        }
    }
    work->stacked.are_known = false;
    work->region_count = layer_count;
    return TL_OK;
}
