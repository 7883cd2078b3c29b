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

#include "nav_build/links.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

enum {
    EDGE_STEP = 2,
    CORNER_STEP = 3,
    BLUR_THRESHOLD = 2, // half columns; floors this near a border keep their distance, so that walls stay sharp
    FAR_AWAY = 0xffff - CORNER_STEP
};

static inline bool is_border(const tl_nav_compact *compact, const tl_links *links, uint8_t area)
{
    for (int d = 0; d < 4; d++) {
        if (links->to[d] == TL_NAV_NO_SPAN || compact->area[links->to[d]] != area) {
            return true;
        }
    }
    return false;
}

static inline uint32_t min_u32(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// The nearest of what lies straight in direction `side` and round the corner from there in direction `corner`.
static inline uint32_t nearest_of(const tl_nav_compact *compact, const uint16_t *distance, uint32_t beside,
                                  uint32_t corner, uint32_t best)
{
    best = min_u32(best, distance[beside] + (uint32_t)EDGE_STEP);
    uint32_t diagonal = tl_nav_beside(compact, beside, corner);
    return diagonal != TL_NAV_NO_SPAN ? min_u32(best, distance[diagonal] + (uint32_t)CORNER_STEP) : best;
}

static void sweep_forward(const tl_nav_compact *compact, uint16_t *distance)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        const tl_links links = tl_nav_links(compact, i);
        uint8_t area = compact->area[i];
        if (area == TL_NAV_NULL_AREA || is_border(compact, &links, area)) {
            distance[i] = 0;
            continue;
        }
        uint32_t best = nearest_of(compact, distance, links.to[0], 3, FAR_AWAY);
        distance[i] = (uint16_t)nearest_of(compact, distance, links.to[3], 2, best);
    }
}

// Returns the largest distance.
static uint16_t sweep_backward(const tl_nav_compact *compact, uint16_t *distance)
{
    uint16_t largest = 0;
    for (uint32_t i = compact->span_count; i-- > 0;) {
        if (distance[i] == 0) {
            continue;
        }
        const tl_links links = tl_nav_links(compact, i); // all four exist: this is no border floor
        uint32_t best = nearest_of(compact, distance, links.to[2], 1, distance[i]);
        distance[i] = (uint16_t)nearest_of(compact, distance, links.to[1], 0, best);
        largest = distance[i] > largest ? distance[i] : largest;
    }
    return largest;
}

// The mean of a floor and its eight neighbours, rounded; one that is missing counts as the floor itself.
static void blur(const tl_nav_compact *compact, const uint16_t *sharp, uint16_t *blurred)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        uint32_t own = sharp[i];
        uint16_t value = (uint16_t)own;
        if (own > BLUR_THRESHOLD) {
            uint32_t sum = own;
            for (uint32_t d = 0; d < 4; d++) {
                uint32_t beside = tl_nav_beside(compact, i, d); // exists: distance > 0
                uint32_t diagonal = tl_nav_beside(compact, beside, (d + 1) & 3);
                sum += sharp[beside] + (diagonal != TL_NAV_NO_SPAN ? sharp[diagonal] : own);
            }
            value = (uint16_t)((sum + 5) / 9);
        }
        blurred[i] = value;
    }
}

tl_result tl_nav_distance_field(const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    TL_ASSERT(compact != NULL);
    tl_report_begin(report_out, "distance field");
    TL_TRY(tl_progress_update(host, "distance field", 0, 1));
    const tl_allocator *scratch = host != NULL ? host->allocator : NULL;
    uint32_t count = compact->span_count;
    uint16_t *sharp = tl_allocate_array(scratch, count, sizeof *sharp);
    uint16_t *blurred = tl_allocate_array(compact->allocator, count, sizeof *blurred);
    if (sharp == NULL || blurred == NULL) {
        tl_release_array(scratch, sharp, count, sizeof *sharp);
        tl_release_array(compact->allocator, blurred, count, sizeof *blurred);
        return TL_ERR_MEMORY;
    }
    sweep_forward(compact, sharp);
    compact->max_distance = sweep_backward(compact, sharp);
    blur(compact, sharp, blurred);
    tl_release_array(scratch, sharp, count, sizeof *sharp);
    tl_release_array(compact->allocator, compact->distance, count, sizeof *compact->distance);
    compact->distance = blurred;
    if (report_out != NULL) {
        report_out->peak_bytes = (uint64_t)count * (sizeof *sharp + sizeof *blurred);
    }
    return tl_progress_update(host, "distance field", 1, 1);
}
