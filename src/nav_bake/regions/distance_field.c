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
// Floors that are not walkable get 0 (Recast measures them too; nothing reads that).
//
// 16 bits are enough: going straight along the shorter side of the lattice, a border comes after at most half of it,
// and width * height <= TL_NAV_MAX_COLUMNS = 2^30 makes the shorter side at most 2^15 columns, the distance 2^15.

#include "nav_bake/regions/distance_steps.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

void tl_distance_sweep_forward(const tl_nav_compact *compact, uint16_t *distance)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        distance[i] = tl_distance_forward(compact, distance, i);
    }
}

uint16_t tl_distance_sweep_backward(const tl_nav_compact *compact, uint16_t *distance)
{
    uint16_t largest = 0;
    for (uint32_t i = compact->span_count; i-- > 0;) {
        if (distance[i] != 0) {
            distance[i] = tl_distance_backward(compact, distance, i, distance[i]);
            largest = distance[i] > largest ? distance[i] : largest;
        }
    }
    return largest;
}

void tl_distance_blur(const tl_nav_compact *compact, const uint16_t *sharp, uint16_t *blurred)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        blurred[i] = tl_distance_blurred(compact, sharp, i);
    }
}

tl_result tl_nav_distance_field(const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "distance field");
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "distance field", 0, 1));
    const tl_allocator *scratch = host != NULL ? host->allocator : NULL;
    uint32_t count = compact->span_count;
    uint16_t *sharp = tl_allocate_array(scratch, count, sizeof *sharp);
    uint16_t *blurred = tl_allocate_array(&compact->allocator, count, sizeof *blurred);
    if (sharp == NULL || blurred == NULL) {
        tl_release_array(scratch, sharp, count, sizeof *sharp);
        tl_release_array(&compact->allocator, blurred, count, sizeof *blurred);
        return TL_ERR_MEMORY;
    }
    tl_distance_sweep_forward(compact, sharp);
    compact->max_distance = tl_distance_sweep_backward(compact, sharp);
    tl_distance_blur(compact, sharp, blurred);
    tl_release_array(scratch, sharp, count, sizeof *sharp);
    tl_release_array(&compact->allocator, compact->distance, count, sizeof *compact->distance);
    compact->distance = blurred;
    if (report_out != NULL) {
        report_out->peak_bytes = (uint64_t)count * (sizeof *sharp + sizeof *blurred);
    }
    return tl_progress_update(host, "distance field", 1, 1);
}
