// SPDX-License-Identifier: MIT
//
// Monotone partition: each row's floors are cut into runs. A run continues a region of the row before where the two
// touch each other alone; else it begins a new one. One pass over the floors, two labels a run.
//
// A region then has at most one run a row, so it has no hole and does not lie over itself.
// Source: Mononen, Recast, after the monotone partition of polygons.
//
// Why it is fast here: the floors of a row are one stretch of the arrays, and the counts of what a row touches are
// cleared by walking what was touched. (Recast clears one for each region so far, at each row.)

#include "nav_bake/floors/links.h"
#include "nav_bake/regions/regions.h"

#include <string.h>

typedef struct row_sweep {
    uint32_t first; // the region that the run touches first in the row before; 0: none
    uint32_t above; // the one region that it touches there; 0 none, MANY several
    uint32_t links; // floors through which it touches the first, before it touches another
    uint32_t region;
} row_sweep;

#define MANY UINT32_MAX

typedef struct monotone {
    const tl_nav_compact *compact;
    uint32_t *region;
    row_sweep *sweeps;     // [row_capacity + 1], from 1
    uint32_t *touched;     // [touched_capacity] floors of this row that lie beside each region of the row before
    uint32_t region_count; // largest id + 1
} monotone;

// The region of what lies beside a floor, or of the floor itself where nothing does; 0 when it has another area or is
// the border's.
static inline uint32_t region_if_same(const monotone *m, uint32_t beside, uint8_t area)
{
    const uint32_t region = m->region[beside];
    return m->compact->area[beside] == area && !tl_region_is_border(region) ? region : 0;
}

// How many floors from `first` on lie as it does: they step as it does, have its area, and what lies before them has
// one area and one region. Of a row they are one run, which touches the row before in one region.
static uint32_t count_alike(const monotone *m, uint32_t first, uint32_t end)
{
    if (m->compact->step == NULL || m->compact->step[4 * (size_t)first] != -1) {
        return 1; // others begin a run, or follow a floor that is not the one before them
    }
    const int32_t step = m->compact->step[4 * (size_t)first + 3];
    const uint32_t above = first + (uint32_t)step;
    const uint8_t *area = m->compact->area;
    const uint32_t most = tl_nav_steps_alike(m->compact, first, end - first);
    uint32_t k = 1;
    while (k < most && area[first + k] == area[first] && area[above + k] == area[above] &&
           m->region[above + k] == m->region[above]) {
        k++;
    }
    return k;
}

// A run goes on over `count` floors that lie beside a region of the row before. Past its first region it counts
// nowhere: that one may still go on in another run.
static inline void touch_above(row_sweep *s, uint32_t above, uint32_t count)
{
    if (s->above == above) {
        s->links += count;
    } else if (s->above == 0) {
        *s = (row_sweep){ above, above, count, 0 };
    } else {
        s->above = MANY;
    }
}

// Labels the row's floors with runs 1 .. and returns their number + 1. They have no region before.
static uint32_t make_runs(monotone *m, uint32_t begin, uint32_t end)
{
    uint32_t next = 1;
    for (uint32_t i = begin, count; i < end; i += count) {
        const uint8_t area = m->compact->area[i];
        count = 1;
        if (area == TL_NAV_NULL_AREA) {
            continue;
        }
        const tl_links links = tl_nav_links_or_self(m->compact, i);
        uint32_t run = region_if_same(m, links.to[0], area);
        const uint32_t above = region_if_same(m, links.to[3], area);
        if (run == 0) {
            run = next++;
            m->sweeps[run] = (row_sweep){ 0, 0, 0, 0 };
        } else {
            count = count_alike(m, i, end);
        }
        if (above != 0) {
            touch_above(&m->sweeps[run], above, count);
        }
        for (uint32_t k = 0; k < count; k++) {
            m->region[i + k] = run;
        }
    }
    return next;
}

// Turns runs into regions, and clears the counts.
static void name_runs(monotone *m, uint32_t begin, uint32_t end, uint32_t run_count)
{
    for (uint32_t k = 1; k < run_count; k++) {
        m->touched[m->sweeps[k].first] += m->sweeps[k].links;
    }
    for (uint32_t k = 1; k < run_count; k++) {
        row_sweep *s = &m->sweeps[k];
        bool continues = s->above != 0 && s->above != MANY && m->touched[s->above] == s->links;
        s->region = continues ? s->above : m->region_count++;
    }
    for (uint32_t k = 1; k < run_count; k++) {
        m->touched[m->sweeps[k].first] = 0;
    }
    m->sweeps[0].region = 0; // of floors that are not walkable
    for (uint32_t i = begin; i < end; i++) {
        m->region[i] = m->sweeps[m->region[i]].region;
    }
}

static uint32_t largest_row(const tl_nav_compact *compact, uint32_t first_x, uint32_t end_x)
{
    uint32_t largest = 0;
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width;
        uint32_t count = row[end_x] - row[first_x];
        largest = count > largest ? count : largest;
    }
    return largest;
}

tl_result tl_regions_monotone(tl_region_work *work)
{
    const tl_nav_compact *compact = work->compact;
    uint32_t border = compact->border_size;
    work->region_count = 1;
    if (compact->width <= 2 * border || compact->height <= 2 * border) {
        return TL_OK;
    }
    uint32_t first_x = border, end_x = compact->width - border;
    uint32_t row_capacity = largest_row(compact, first_x, end_x);
    monotone m = { compact, work->region, NULL, NULL, 1 };
    m.sweeps = TL_PUSH(work->arena, row_sweep, (uint64_t)row_capacity + 1);
    // A new region takes at least one floor, so ids stay within the floors.
    m.touched = TL_PUSH_ZERO(work->arena, uint32_t, (uint64_t)compact->span_count + 1);
    if (m.sweeps == NULL || m.touched == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t z = border; z < compact->height - border; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width;
        uint32_t run_count = make_runs(&m, row[first_x], row[end_x]);
        name_runs(&m, row[first_x], row[end_x], run_count);
    }
    work->region_count = m.region_count;
    return TL_OK;
}
