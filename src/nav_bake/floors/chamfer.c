// SPDX-License-Identifier: MIT
//
// A chamfer distance transform in two sweeps, in bands of rows as the host's tasks.
// Source: Azriel Rosenfeld, John Pfaltz, Distance functions on digital pictures, 1968; Gunilla Borgefors, Distance
// transformations in digital images, 1986.
//
// The sweeps run over the floors in their order of storage: a floor's neighbours at -x and -z come before it, those at
// +x and +z after it. Where the ground is plain (plain_runs.h) a sweep first takes what the row beside gives, in a loop
// without branches, then what each floor gives to the next one. 16 bits are enough: going straight along the shorter
// side of the lattice, a border comes after at most half of it, and width * height <= TL_NAV_MAX_COLUMNS = 2^30 makes
// the shorter side at most 2^15 columns, the distance 2^15.
//
// A sweep is a chain of minima of sums, so it may be cut: each band is swept as if nothing came over its seam, and then
// what does come is taken in row by row, until a row gains nothing by it. The values are those of one sweep.

#include "nav_bake/floors/chamfer.h"

#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

// ---- Plain ground ------------------------------------------------------------------------------------------

// What the floors of the row beside give to those of a run: `own` is their distance so far. Returns 0 where that is
// nothing.
static inline uint16_t take_from_row(uint16_t *restrict own, const uint16_t *restrict beside, const tl_plain_run *run)
{
    const uint16_t *beside_left = beside - run->stride, *beside_right = beside + run->stride;
    uint16_t changed = 0;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint16_t corner = beside_right[k] < beside_left[k] ? beside_right[k] : beside_left[k];
        const uint16_t along = (uint16_t)(beside[k] + TL_EDGE_STEP), across = (uint16_t)(corner + TL_CORNER_STEP);
        uint16_t nearest = along < across ? along : across;
        nearest = nearest < own[k] ? nearest : own[k];
        changed |= (uint16_t)(nearest ^ own[k]);
        own[k] = nearest;
    }
    return changed;
}

static inline void pass_on_forward(uint16_t *own, const tl_plain_run *run)
{
    const uint16_t *left = own - run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        own[k] = (uint16_t)tl_min_u32(own[k], (uint32_t)left[k] + TL_EDGE_STEP);
    }
}

static inline void pass_on_backward(uint16_t *own, const tl_plain_run *run)
{
    const uint16_t *right = own + run->stride;
    for (uint32_t k = run->count; k-- > 0;) {
        own[k] = (uint16_t)tl_min_u32(own[k], (uint32_t)right[k] + TL_EDGE_STEP);
    }
}

// Borders have 0; `own` is left to all others.
static inline void clear_borders(uint16_t *restrict own, const uint8_t *area, const tl_plain_run *run,
                                 tl_chamfer_border border)
{
    const uint8_t *before = area + run->before, *after = area + run->after;
    const uint8_t *area_left = area - run->stride, *area_right = area + run->stride;
    for (uint32_t k = 0; k < run->count; k++) {
        const uint8_t kind = tl_chamfer_kind(area[k], border);
        const uint8_t different =
            (uint8_t)((tl_chamfer_kind(area_left[k], border) ^ kind) | (tl_chamfer_kind(area_right[k], border) ^ kind) |
                      (tl_chamfer_kind(before[k], border) ^ kind) | (tl_chamfer_kind(after[k], border) ^ kind));
        const bool inside = (different == 0) & (kind != 0);
        own[k] = inside ? own[k] : 0;
    }
}

static void run_forward(const tl_chamfer *c, const tl_plain_run *run)
{
    uint16_t *own = c->distance + run->first;
    const uint8_t *area = c->compact->area + run->first;
    for (uint32_t k = 0; k < run->count; k++) {
        own[k] = c->far_away;
    }
    take_from_row(own, own + run->before, run);
    if (c->border == TL_BORDER_OF_AREAS) {
        clear_borders(own, area, run, TL_BORDER_OF_AREAS);
    } else if (c->border == TL_BORDER_OF_WALKABLE) {
        clear_borders(own, area, run, TL_BORDER_OF_WALKABLE);
    }
    pass_on_forward(own, run);
}

static void run_backward(const tl_chamfer *c, const tl_plain_run *run)
{
    uint16_t *own = c->distance + run->first;
    take_from_row(own, own + run->after, run);
    pass_on_backward(own, run);
}

// ---- Floor by floor ----------------------------------------------------------------------------------------

static inline void floors_forward_to(const tl_chamfer *c, uint32_t begin, uint32_t end, tl_chamfer_border border)
{
    for (uint32_t i = begin; i < end; i++) {
        c->distance[i] = tl_chamfer_forward(c->compact, c->distance, i, border, c->far_away);
    }
}

static void floors_forward(const tl_chamfer *c, uint32_t begin, uint32_t end)
{
    switch (c->border) {
    case TL_BORDER_OF_GROUND:
        floors_forward_to(c, begin, end, TL_BORDER_OF_GROUND);
        break;
    case TL_BORDER_OF_WALKABLE:
        floors_forward_to(c, begin, end, TL_BORDER_OF_WALKABLE);
        break;
    case TL_BORDER_OF_AREAS:
        floors_forward_to(c, begin, end, TL_BORDER_OF_AREAS);
        break;
    }
}

static void floors_backward(const tl_chamfer *c, uint32_t begin, uint32_t end)
{
    for (uint32_t i = end; i-- > begin;) {
        c->distance[i] = tl_chamfer_backward(c->compact, c->distance, i, c->distance[i]);
    }
}

// ---- Bands -------------------------------------------------------------------------------------------------

// The first of the runs that does not begin before a floor.
static uint32_t first_run_from(const tl_plain_runs *runs, uint32_t floor)
{
    uint32_t low = 0, high = runs->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (runs->runs[middle].first < floor) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// The first row of a band that follows another one, from what lies beside each floor in that row.
static void open_row_forward(const tl_chamfer *c, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; i++) {
        const tl_links links = tl_floor_links(c->compact, i);
        const bool is_border = tl_chamfer_is_border(c->compact, &links, i, c->border);
        c->distance[i] =
            is_border ? 0 : (uint16_t)tl_min_u32(c->far_away, (uint32_t)c->distance[links.to[0]] + TL_EDGE_STEP);
    }
}

static void open_row_backward(const tl_chamfer *c, uint32_t begin, uint32_t end)
{
    for (uint32_t i = end; i-- > begin;) {
        if (c->distance[i] > TL_EDGE_STEP) {
            const uint32_t right = tl_nav_compact_neighbour(c->compact, i, 2);
            c->distance[i] = (uint16_t)tl_min_u32(c->distance[i], (uint32_t)c->distance[right] + TL_EDGE_STEP);
        }
    }
}

static void band_forward(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_chamfer *c = user;
    const tl_floor_band *band = &c->bands->bands[index];
    const tl_plain_runs *runs = &band->runs;
    uint32_t i = band->begin;
    if (index > 0) {
        i = tl_first_floor_of_row(c->compact, band->first_row + 1);
        open_row_forward(c, band->begin, i);
    }
    for (uint32_t k = first_run_from(runs, i); k < runs->count; k++) {
        floors_forward(c, i, runs->runs[k].first);
        run_forward(c, &runs->runs[k]);
        i = runs->runs[k].first + runs->runs[k].count;
    }
    floors_forward(c, i, band->end);
}

static void band_backward(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tl_chamfer *c = user;
    const tl_floor_band *band = &c->bands->bands[index];
    const tl_plain_runs *runs = &band->runs;
    uint32_t end = band->end;
    if (index + 1 < c->bands->count) {
        end = tl_first_floor_of_row(c->compact, band->end_row - 1);
        open_row_backward(c, end, band->end);
    }
    for (uint32_t k = first_run_from(runs, end); k-- > 0;) {
        floors_backward(c, runs->runs[k].first + runs->runs[k].count, end);
        run_backward(c, &runs->runs[k]);
        end = runs->runs[k].first;
    }
    floors_backward(c, band->begin, end);
}

// ---- Seams -------------------------------------------------------------------------------------------------

// Floors of a row take what the row before gives, and pass it on. Returns whether any gained by it.
static bool mend_row_forward(const tl_chamfer *c, const tl_plain_runs *runs, uint32_t begin, uint32_t end)
{
    uint16_t changed = 0;
    uint32_t k = first_run_from(runs, begin);
    for (uint32_t i = begin; i < end;) {
        if (k < runs->count && runs->runs[k].first == i) {
            const tl_plain_run *run = &runs->runs[k++];
            uint16_t *own = c->distance + i;
            changed |= take_from_row(own, own + run->before, run);
            pass_on_forward(own, run);
            i += run->count;
            continue;
        }
        const uint16_t before = c->distance[i];
        if (before > TL_EDGE_STEP) {
            const uint32_t left = tl_nav_compact_neighbour(c->compact, i, 0);
            const uint32_t best = tl_chamfer_over(c->compact, c->distance, left, 3, before);
            const uint32_t up = tl_nav_compact_neighbour(c->compact, i, 3);
            c->distance[i] = (uint16_t)tl_chamfer_over(c->compact, c->distance, up, 2, best);
            changed |= (uint16_t)(c->distance[i] ^ before);
        }
        i++;
    }
    return changed != 0;
}

static bool mend_row_backward(const tl_chamfer *c, const tl_plain_runs *runs, uint32_t begin, uint32_t end)
{
    uint16_t changed = 0;
    uint32_t k = first_run_from(runs, end);
    for (uint32_t i = end; i > begin;) {
        if (k > 0 && runs->runs[k - 1].first + runs->runs[k - 1].count == i) {
            const tl_plain_run *run = &runs->runs[--k];
            uint16_t *own = c->distance + run->first;
            changed |= take_from_row(own, own + run->after, run);
            pass_on_backward(own, run);
            i = run->first;
            continue;
        }
        i--;
        const uint16_t before = c->distance[i];
        c->distance[i] = tl_chamfer_backward(c->compact, c->distance, i, before);
        changed |= (uint16_t)(c->distance[i] ^ before);
    }
    return changed != 0;
}

void tl_chamfer_sweep_forward(const tl_chamfer *chamfer, const tl_host *host)
{
    const tl_nav_compact *compact = chamfer->compact;
    tl_chamfer c = *chamfer;
    tl_run_tasks(host, band_forward, c.bands->count, &c);
    for (uint32_t k = 1; k < c.bands->count; k++) {
        const tl_floor_band *band = &c.bands->bands[k];
        for (uint32_t z = band->first_row; z < band->end_row; z++) {
            const uint32_t begin = tl_first_floor_of_row(compact, z), end = tl_first_floor_of_row(compact, z + 1);
            if (!mend_row_forward(&c, &band->runs, begin, end)) {
                break;
            }
        }
    }
}

void tl_chamfer_sweep_backward(const tl_chamfer *chamfer, const tl_host *host)
{
    const tl_nav_compact *compact = chamfer->compact;
    tl_chamfer c = *chamfer;
    tl_run_tasks(host, band_backward, c.bands->count, &c);
    for (uint32_t k = c.bands->count - 1; k-- > 0;) {
        const tl_floor_band *band = &c.bands->bands[k];
        for (uint32_t z = band->end_row; z-- > band->first_row;) {
            const uint32_t begin = tl_first_floor_of_row(compact, z), end = tl_first_floor_of_row(compact, z + 1);
            if (!mend_row_backward(&c, &band->runs, begin, end)) {
                break;
            }
        }
    }
}
