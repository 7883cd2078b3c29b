// SPDX-License-Identifier: MIT
//
// Distance field: how far each floor is from the border of its area, in half columns, then blurred.
//
// A border floor is one that lacks one of its four neighbours, or whose neighbour has another area. Two sweeps spread
// the distance with the 2-3 chamfer mask (chamfer.c), then a 3 by 3 box blur smooths it so that the watershed does not
// split a floor at every notch of its wall. Source: Mononen, Recast (weights, blur).
//
// Where the ground is plain (plain_runs.h) the blur is a loop over rows, without links or branches. Floors that are not
// walkable get 0 (Recast measures them too; nothing reads that).

#include "nav_bake/regions/distance_field.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/regions/distance_steps.h"

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

typedef struct blur_job {
    const tl_chamfer *sharp;
    uint16_t *blurred;
} blur_job;

static void blur_band(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const blur_job *job = user;
    const tl_floor_band *band = &job->sharp->bands->bands[index];
    const uint16_t *sharp = job->sharp->distance;
    uint32_t i = band->begin;
    for (uint32_t k = 0; k <= band->runs.count; k++) {
        const uint32_t end = k < band->runs.count ? band->runs.runs[k].first : band->end;
        for (; i < end; i++) {
            job->blurred[i] = tl_distance_blurred(job->sharp->compact, sharp, i);
        }
        if (k < band->runs.count) {
            run_blur(&band->runs.runs[k], sharp, job->blurred);
            i += band->runs.runs[k].count;
        }
    }
}

void tl_distance_blur(const tl_chamfer *sharp, const tl_host *host, uint16_t *blurred)
{
    blur_job job = { sharp, blurred };
    tl_run_tasks(host, blur_band, sharp->bands->count, &job);
}

tl_result tl_nav_distance_of_bands(const tl_host *host, const tl_floor_bands *bands, tl_nav_compact *compact)
{
    const uint32_t count = compact->span_count;
    uint16_t *sharp = tl_allocate_array(bands->allocator, count, sizeof *sharp);
    uint16_t *blurred = tl_allocate_array(&compact->allocator, count, sizeof *blurred);
    if (sharp == NULL || blurred == NULL) {
        tl_release_array(bands->allocator, sharp, count, sizeof *sharp);
        tl_release_array(&compact->allocator, blurred, count, sizeof *blurred);
        return TL_ERR_MEMORY;
    }
    const tl_chamfer chamfer = tl_distance_chamfer(compact, bands, sharp);
    tl_chamfer_sweep_forward(&chamfer, host);
    tl_chamfer_sweep_backward(&chamfer, host);
    tl_distance_blur(&chamfer, host, blurred);
    compact->max_distance = tl_largest_distance(sharp, count);
    tl_release_array(bands->allocator, sharp, count, sizeof *sharp);
    tl_release_array(&compact->allocator, compact->distance, count, sizeof *compact->distance);
    compact->distance = blurred;
    return TL_OK;
}

tl_result tl_nav_distance_field(const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "distance field");
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "distance field", 0, 1));
    tl_floor_bands bands;
    TL_TRY(tl_floor_bands_make(compact, host, &bands));
    const tl_result result = tl_nav_distance_of_bands(host, &bands, compact);
    tl_floor_bands_free(&bands);
    TL_TRY(result);
    if (report_out != NULL) {
        report_out->peak_bytes = (uint64_t)compact->span_count * 2 * sizeof *compact->distance;
    }
    return tl_progress_update(host, "distance field", 1, 1);
}
