// SPDX-License-Identifier: MIT
//
// Distance field: how far each floor is from the border of its area, in half columns, then blurred.
//
// A border floor is one that lacks one of its four neighbours, or whose neighbour has another area. Two sweeps spread
// the distance with the 2-3 chamfer mask (2 across an edge, 3 across a corner), then a 3 by 3 box blur smooths it so
// that the watershed does not split a floor at every notch of its wall.
// Source: Rosenfeld, Pfaltz, "Distance functions on digital pictures", 1968; Mononen, Recast (weights, blur).
//
// Why it is fast here: neighbours are indices, so a corner costs two loads; every floor that the first sweep reads
// comes before it in memory, so the search for border floors is part of that sweep and not a pass of its own.
// Where the ground is plain (plain_runs.h) the sweeps and the blur are loops over rows, without links or branches.
// Floors that are not walkable get 0 (Recast measures them too; nothing reads that).
//
// 16 bits are enough: going straight along the shorter side of the lattice, a border comes after at most half of it,
// and width * height <= TL_NAV_MAX_COLUMNS = 2^30 makes the shorter side at most 2^15 columns, the distance 2^15.

#include "nav_bake/regions/distance_steps.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

// ---- Plain ground ------------------------------------------------------------------------------------------

// What the floors of the row beside give to those of a run: `own` is their distance so far.
static void distance_from_row(uint16_t *restrict own, const uint16_t *restrict beside, const tl_plain_run *run)
{
    const uint16_t *beside_left = beside - run->stride, *beside_right = beside + run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint16_t corner = beside_right[k] < beside_left[k] ? beside_right[k] : beside_left[k];
        const uint16_t along = (uint16_t)(beside[k] + TL_EDGE_STEP), across = (uint16_t)(corner + TL_CORNER_STEP);
        const uint16_t nearest = along < across ? along : across;
        own[k] = nearest < own[k] ? nearest : own[k];
    }
}

// Borders of areas have 0, and so have floors that are not walkable; `own` is left to all others.
static void clear_borders(uint16_t *restrict own, const uint8_t *area, const tl_plain_run *run)
{
    const uint8_t *before = area + run->before, *after = area + run->after;
    const uint8_t *area_left = area - run->stride, *area_right = area + run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint8_t different = (uint8_t)((area_left[k] ^ area[k]) | (area_right[k] ^ area[k]) |
                                            (before[k] ^ area[k]) | (after[k] ^ area[k]));
        const bool inside = (different == 0) & (area[k] != TL_NAV_NULL_AREA);
        own[k] = inside ? own[k] : 0;
    }
}

static void run_forward(const tl_nav_compact *compact, const tl_plain_run *run, uint16_t *distance)
{
    uint16_t *own = distance + run->first;
    for (uint32_t k = 0; k < run->count; k++) {
        own[k] = TL_FAR_AWAY;
    }
    distance_from_row(own, own + run->before, run);
    clear_borders(own, compact->area + run->first, run);
    const uint16_t *left = own - run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint32_t step = (uint32_t)left[k] + TL_EDGE_STEP;
        own[k] = step < own[k] ? (uint16_t)step : own[k];
    }
}

static uint16_t run_backward(const tl_plain_run *run, uint16_t *distance)
{
    uint16_t *own = distance + run->first;
    distance_from_row(own, own + run->after, run);
    const uint16_t *right = own + run->stride;
    uint16_t largest = 0;
    for (uint32_t k = run->count; k-- > 0;) {
        const uint32_t step = (uint32_t)right[k] + TL_EDGE_STEP;
        own[k] = step < own[k] ? (uint16_t)step : own[k];
        largest = own[k] > largest ? own[k] : largest;
    }
    return largest;
}

static void run_blur(const tl_plain_run *run, const uint16_t *sharp, uint16_t *blurred)
{
    const uint16_t *own = sharp + run->first, *before = own + run->before, *after = own + run->after;
    const size_t stride = run->stride;
    const uint16_t *own_left = own - stride, *own_right = own + stride, *before_left = before - stride,
                   *before_right = before + stride, *after_left = after - stride, *after_right = after + stride;
    uint16_t *restrict to = blurred + run->first;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint32_t row = (uint32_t)own_left[k] + own[k] + own_right[k];
        const uint32_t rows =
            (uint32_t)before_left[k] + before[k] + before_right[k] + after_left[k] + after[k] + after_right[k];
        const uint16_t mean = (uint16_t)((row + rows + 5) / 9);
        to[k] = own[k] <= TL_BLUR_THRESHOLD ? own[k] : mean;
    }
}

// ---- All floors --------------------------------------------------------------------------------------------

void tl_distance_sweep_forward(const tl_nav_compact *compact, const tl_plain_runs *runs, uint16_t *distance)
{
    for (uint32_t k = 0, i = 0; k <= runs->count; k++) {
        const uint32_t end = tl_plain_runs_begin(runs, k, compact->span_count);
        for (; i < end; i++) {
            distance[i] = tl_distance_forward(compact, distance, i);
        }
        if (k < runs->count) {
            run_forward(compact, &runs->runs[k], distance);
            i += runs->runs[k].count;
        }
    }
}

uint16_t tl_distance_sweep_backward(const tl_nav_compact *compact, const tl_plain_runs *runs, uint16_t *distance)
{
    uint16_t largest = 0;
    for (uint32_t k = runs->count, i = compact->span_count;; k--) {
        const uint32_t begin = k > 0 ? runs->runs[k - 1].first + runs->runs[k - 1].count : 0;
        while (i-- > begin) {
            if (distance[i] != 0) {
                distance[i] = tl_distance_backward(compact, distance, i, distance[i]);
                largest = distance[i] > largest ? distance[i] : largest;
            }
        }
        if (k == 0) {
            return largest;
        }
        const uint16_t of_run = run_backward(&runs->runs[k - 1], distance);
        largest = of_run > largest ? of_run : largest;
        i = runs->runs[k - 1].first;
    }
}

void tl_distance_blur(const tl_nav_compact *compact, const tl_plain_runs *runs, const uint16_t *sharp,
                      uint16_t *blurred)
{
    for (uint32_t k = 0, i = 0; k <= runs->count; k++) {
        const uint32_t end = tl_plain_runs_begin(runs, k, compact->span_count);
        for (; i < end; i++) {
            blurred[i] = tl_distance_blurred(compact, sharp, i);
        }
        if (k < runs->count) {
            run_blur(&runs->runs[k], sharp, blurred);
            i += runs->runs[k].count;
        }
    }
}

tl_result tl_nav_distance_field(const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "distance field");
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "distance field", 0, 1));
    const tl_allocator *scratch = host != NULL ? host->allocator : NULL;
    uint32_t count = compact->span_count;
    tl_plain_runs runs;
    TL_TRY(tl_plain_runs_find(compact, scratch, &runs));
    uint16_t *sharp = tl_allocate_array(scratch, count, sizeof *sharp);
    uint16_t *blurred = tl_allocate_array(&compact->allocator, count, sizeof *blurred);
    if (sharp == NULL || blurred == NULL) {
        tl_release_array(scratch, sharp, count, sizeof *sharp);
        tl_release_array(&compact->allocator, blurred, count, sizeof *blurred);
        tl_plain_runs_free(&runs);
        return TL_ERR_MEMORY;
    }
    tl_distance_sweep_forward(compact, &runs, sharp);
    compact->max_distance = tl_distance_sweep_backward(compact, &runs, sharp);
    tl_distance_blur(compact, &runs, sharp, blurred);
    tl_plain_runs_free(&runs);
    tl_release_array(scratch, sharp, count, sizeof *sharp);
    tl_release_array(&compact->allocator, compact->distance, count, sizeof *compact->distance);
    compact->distance = blurred;
    if (report_out != NULL) {
        report_out->peak_bytes = (uint64_t)count * (sizeof *sharp + sizeof *blurred);
    }
    return tl_progress_update(host, "distance field", 1, 1);
}
