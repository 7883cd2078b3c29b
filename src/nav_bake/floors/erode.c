// SPDX-License-Identifier: MIT
//
// Erosion: floors nearer to a wall or ledge than the agent's radius are not walkable. A chamfer distance transform.
// Source: Mikko Mononen, Recast (rcErodeWalkableArea); Gunilla Borgefors, Distance transformations in digital images,
// 1986: two sweeps, a straight step counts 2, a diagonal 3.
//
// The sweeps run over the floors in their order of storage: a floor's neighbours at -x and -z come before it, those at
// +x and +z after it. Where the ground is plain (plain_runs.h) a sweep first takes what the row beside gives, in a loop
// without branches, then what each floor gives to the next one.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "nav_bake/floors/links.h"
#include "nav_bake/floors/plain_runs.h"

#include <string.h>

enum { STRAIGHT = 2, DIAGONAL = 3 };

// Whether a floor lacks a neighbour.
static inline bool is_at_edge(const tl_nav_compact *compact, uint32_t i)
{
    if (compact->step != NULL) { // asked once, and not for each direction: whether one of four 16-bit steps is zero
        uint64_t steps;
        memcpy(&steps, compact->step + 4 * (size_t)i, sizeof steps);
        return ((steps - 0x0001000100010001u) & ~steps & 0x8000800080008000u) != 0;
    }
    const uint32_t *neighbour = compact->neighbour + 4 * (size_t)i;
    return neighbour[0] == TL_NAV_NO_SPAN || neighbour[1] == TL_NAV_NO_SPAN || neighbour[2] == TL_NAV_NO_SPAN ||
           neighbour[3] == TL_NAV_NO_SPAN;
}

// A floor that is not walkable, or lacks a walkable neighbour. `holes`: some floors are not walkable.
static inline bool is_area_border(const tl_nav_compact *compact, uint32_t i, bool holes)
{
    if (is_at_edge(compact, i)) {
        return true;
    }
    if (!holes) {
        return false;
    }
    const tl_links links = tl_nav_links_or_self(compact, i);
    const uint8_t *area = compact->area;
    return area[i] == TL_NAV_NULL_AREA || area[links.to[0]] == TL_NAV_NULL_AREA ||
           area[links.to[1]] == TL_NAV_NULL_AREA || area[links.to[2]] == TL_NAV_NULL_AREA ||
           area[links.to[3]] == TL_NAV_NULL_AREA;
}

// The least of `nearest` and what a floor beside, and the one beside that in `turn`, give.
static inline uint32_t nearest_over(const tl_nav_compact *compact, const uint16_t *distance, uint32_t beside,
                                    uint32_t turn, uint32_t nearest)
{
    nearest = tl_min_u32(nearest, (uint32_t)distance[beside] + STRAIGHT);
    const uint32_t across = tl_nav_compact_neighbour(compact, beside, turn);
    return across != TL_NAV_NO_SPAN ? tl_min_u32(nearest, (uint32_t)distance[across] + DIAGONAL) : nearest;
}

// ---- Floor by floor ----------------------------------------------------------------------------------------

typedef struct erosion {
    tl_nav_compact *compact;
    uint16_t *distance; ///< [span_count]
    uint32_t limit;     ///< no distance is larger
    bool holes;         ///< some floors are not walkable
} erosion;

// Borders get 0, all others the distance from what comes before them, at most `limit`. Those have all four neighbours.
static void sweep_forward(const erosion *e, uint32_t begin, uint32_t end)
{
    const tl_nav_compact *compact = e->compact;
    const uint32_t limit = e->limit;
    uint16_t *distance = e->distance;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t nearest = 0;
        if (!is_area_border(compact, i, e->holes)) {
            const uint32_t left = tl_nav_compact_neighbour(compact, i, 0), up = tl_nav_compact_neighbour(compact, i, 3);
            nearest = limit;
            if (distance[left] < limit) { // else the floor across is at least `limit` - 2 away, a straight step from it
                nearest = nearest_over(compact, distance, left, 3, limit);
            }
            nearest = nearest_over(compact, distance, up, 2, nearest);
        }
        distance[i] = (uint16_t)nearest;
    }
}

// The same from what comes after.
static void sweep_backward(const erosion *e, uint32_t begin, uint32_t end)
{
    const tl_nav_compact *compact = e->compact;
    uint16_t *distance = e->distance;
    for (uint32_t i = end; i-- > begin;) {
        uint32_t nearest = distance[i];
        if (nearest > STRAIGHT) { // nothing but a border is nearer
            const uint32_t right = tl_nav_compact_neighbour(compact, i, 2);
            if (distance[right] < e->limit) { // as above
                nearest = nearest_over(compact, distance, right, 1, nearest);
            }
            nearest = nearest_over(compact, distance, tl_nav_compact_neighbour(compact, i, 1), 0, nearest);
            distance[i] = (uint16_t)nearest;
        }
    }
}

// ---- Plain ground ------------------------------------------------------------------------------------------

// What the floors of the row beside give to those of a run, at most `limit`: `own` is their distance so far. Bounded
// before the steps are added, so that 16 bits are enough.
static void take_from_row(uint16_t *restrict own, const uint16_t *restrict beside, const tl_plain_run *run,
                          uint32_t limit)
{
    const uint16_t *beside_left = beside - run->stride, *beside_right = beside + run->stride;
    const uint16_t straight = (uint16_t)(limit - STRAIGHT),
                   across = (uint16_t)(limit > DIAGONAL ? limit - DIAGONAL : 0);
    for (uint32_t k = 0; k < run->count; k++) {
        uint16_t along = beside[k], corner = beside_right[k] < beside_left[k] ? beside_right[k] : beside_left[k];
        along = (uint16_t)((along < straight ? along : straight) + STRAIGHT);
        corner = (uint16_t)((corner < across ? corner : across) + DIAGONAL);
        const uint16_t nearest = along < corner ? along : corner;
        own[k] = nearest < own[k] ? nearest : own[k];
    }
}

// Floors beside one that is not walkable, and such ones, have 0.
static void mark_holes(uint16_t *restrict own, const uint8_t *area, const tl_plain_run *run)
{
    const uint8_t *before = area + run->before, *after = area + run->after;
    const uint8_t *area_left = area - run->stride, *area_right = area + run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        const bool walkable = (area[k] != TL_NAV_NULL_AREA) & (area_left[k] != TL_NAV_NULL_AREA) &
                              (area_right[k] != TL_NAV_NULL_AREA) & (before[k] != TL_NAV_NULL_AREA) &
                              (after[k] != TL_NAV_NULL_AREA);
        own[k] = walkable ? own[k] : 0;
    }
}

static void erode_run_forward(const erosion *e, const tl_plain_run *run)
{
    uint16_t *own = e->distance + run->first;
    for (uint32_t k = 0; k < run->count; k++) {
        own[k] = (uint16_t)e->limit;
    }
    take_from_row(own, own + run->before, run, e->limit);
    if (e->holes) {
        mark_holes(own, e->compact->area + run->first, run);
    }
    const uint16_t *left = own - run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        own[k] = (uint16_t)tl_min_u32(own[k], (uint32_t)left[k] + STRAIGHT);
    }
}

static void erode_run_backward(const erosion *e, const tl_plain_run *run)
{
    uint16_t *own = e->distance + run->first;
    take_from_row(own, own + run->after, run, e->limit);
    const uint16_t *right = own + run->stride;
    for (uint32_t k = run->count; k-- > 0;) {
        own[k] = (uint16_t)tl_min_u32(own[k], (uint32_t)right[k] + STRAIGHT);
    }
}

// ---- All floors --------------------------------------------------------------------------------------------

static void sweep_all(const erosion *e, const tl_plain_runs *runs)
{
    const uint32_t count = e->compact->span_count;
    for (uint32_t k = 0, i = 0; k <= runs->count; k++) {
        const uint32_t end = tl_plain_runs_begin(runs, k, count);
        sweep_forward(e, i, end);
        if (k < runs->count) {
            erode_run_forward(e, &runs->runs[k]);
            i = end + runs->runs[k].count;
        }
    }
    for (uint32_t k = runs->count, end = count; k-- > 0; end = runs->runs[k].first) {
        sweep_backward(e, runs->runs[k].first + runs->runs[k].count, end);
        erode_run_backward(e, &runs->runs[k]);
    }
    sweep_backward(e, 0, tl_plain_runs_begin(runs, 0, count));
}

// Floors nearer than the limit are no longer walkable.
static void drop_near_floors(const erosion *e)
{
    uint8_t *restrict area = e->compact->area;
    const uint16_t *restrict distance = e->distance;
    const uint16_t limit = (uint16_t)e->limit;
    for (uint32_t i = 0; i < e->compact->span_count; i++) {
        area[i] = distance[i] < limit ? TL_NAV_NULL_AREA : area[i];
    }
}

static tl_result erode(tl_nav_compact *compact, uint32_t limit, const tl_allocator *allocator)
{
    const uint32_t count = compact->span_count;
    tl_plain_runs runs;
    TL_TRY(tl_plain_runs_find(compact, allocator, &runs));
    uint16_t *distance = tl_allocate_array(allocator, count, sizeof *distance);
    if (distance != NULL) {
        const bool holes = count > 0 && memchr(compact->area, TL_NAV_NULL_AREA, count) != NULL;
        const erosion e = { compact, distance, limit, holes };
        sweep_all(&e, &runs);
        drop_near_floors(&e);
    }
    tl_release_array(allocator, distance, count, sizeof *distance);
    tl_plain_runs_free(&runs);
    return distance != NULL ? TL_OK : TL_ERR_MEMORY;
}

tl_result tl_nav_erode(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact, tl_report *report_out)
{
    tl_report_begin(report_out, "erode");
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    TL_TRY(tl_progress_update(host, "erode", 0, 1));
    if (config->walkable_radius > 0) {
        // walkable_radius <= TL_NAV_MAX_VOXELS, so its double fits 16 bits; farther floors need no exact distance.
        TL_TRY(erode(compact, config->walkable_radius * STRAIGHT, host != NULL ? host->allocator : NULL));
    }
    return tl_progress_update(host, "erode", 1, 1);
}
