// SPDX-License-Identifier: MIT
//
// Areas that change far out in a tile's border, where the tile does not see them.
//
// Of the border's areas monotone regions and layers, their outlines and the detail mesh read the first ring of columns
// around the tile only, corners included. What reaches farther is the guard of outlines (contour_guard.c): an
// obstacle's floors forbid outlines along walls to draw nearer within some steps. So where no floor within those steps
// has a wall, the tile keeps its bytes. An obstacle marks floors up to its radius and the agent's away, and the border
// is as wide as the agent: a third of the tiles of 32 columns that edits reach are only touched out there.
//
// Watershed regions follow from distances, which carry a change inwards as far as it is open: never told to be the
// same.

#include "nav_bake/contours/contours.h"

#include "base/min_max.h"

#include <string.h>

enum { SEEN_RINGS = 1 };

// Columns [min_x, max_x] x [min_z, max_z]; min > max: none.
typedef struct column_box {
    uint32_t min_x, min_z, max_x, max_z;
} column_box;

static bool same_areas(const tl_nav_compact *compact, const uint8_t *before, uint32_t begin, uint32_t end)
{
    return memcmp(compact->area + begin, before + begin, end - begin) == 0;
}

// Makes a box reach the first and the last column of a row in which floors have changed; there is one.
static void add_changed_of_row(const tl_nav_compact *compact, const uint8_t *before, uint32_t z, column_box *changed)
{
    const uint32_t *row = compact->first_span + (size_t)z * compact->width;
    uint32_t first = row[0], last = row[compact->width] - 1, first_x = 0, last_x = compact->width - 1;
    while (compact->area[first] == before[first]) {
        first++;
    }
    while (compact->area[last] == before[last]) {
        last--;
    }
    while (row[first_x + 1] <= first) {
        first_x++;
    }
    while (row[last_x] > last) {
        last_x--;
    }
    changed->min_x = tl_min_u32(first_x, changed->min_x);
    changed->max_x = tl_max_u32(last_x, changed->max_x);
    changed->min_z = tl_min_u32(z, changed->min_z);
    changed->max_z = z;
}

// Whether a box of columns is beyond the rings of the border that a tile sees. A box that reaches around the tile on
// two sides is not.
static bool is_out_of_sight(const tl_nav_compact *compact, const column_box *box)
{
    const uint32_t border = compact->border_size;
    return box->max_x + SEEN_RINGS < border || box->max_z + SEEN_RINGS < border ||
           box->min_x >= compact->width - border + SEEN_RINGS || box->min_z >= compact->height - border + SEEN_RINGS;
}

// Whether an outline of a wall runs along the floor.
static bool has_wall(const tl_nav_compact *compact, uint32_t floor)
{
    for (uint32_t d = 0; d < 4 && compact->area[floor] != TL_NAV_NULL_AREA; d++) {
        const uint32_t beside = tl_nav_compact_neighbour(compact, floor, d);
        if (beside == TL_NAV_NO_SPAN || compact->area[beside] == TL_NAV_NULL_AREA) {
            return true;
        }
    }
    return false;
}

// Whether one of the tile's floors within so many columns of a box has a wall. Steps go from column to column, so no
// floor within as many steps is farther.
static bool is_wall_near(const tl_nav_compact *compact, const column_box *box, uint32_t steps)
{
    const uint32_t border = compact->border_size;
    const uint32_t first_x = tl_max_u32(border, box->min_x - tl_min_u32(box->min_x, steps));
    const uint32_t first_z = tl_max_u32(border, box->min_z - tl_min_u32(box->min_z, steps));
    const uint32_t end_x = tl_min_u32(compact->width - border, box->max_x + 1 + tl_min_u32(steps, compact->width));
    const uint32_t end_z = tl_min_u32(compact->height - border, box->max_z + 1 + tl_min_u32(steps, compact->height));
    for (uint32_t z = first_z; z < end_z && first_x < end_x; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width;
        for (uint32_t i = row[first_x]; i < row[end_x]; i++) {
            if (has_wall(compact, i)) {
                return true;
            }
        }
    }
    return false;
}

bool tl_nav_tile_keeps_bytes(const tl_nav_config *config, const tl_nav_compact *compact, const uint8_t *area_before)
{
    column_box changed = { UINT32_MAX, UINT32_MAX, 0, 0 };
    for (uint32_t z = 0; z < compact->height; z++) {
        const uint32_t *row = compact->first_span + (size_t)z * compact->width;
        if (same_areas(compact, area_before, row[0], row[compact->width])) {
            continue;
        }
        add_changed_of_row(compact, area_before, z, &changed);
        if (config->partition == TL_NAV_WATERSHED || !is_out_of_sight(compact, &changed)) {
            return false;
        }
    }
    return changed.min_x > changed.max_x || !is_wall_near(compact, &changed, tl_contours_guard_steps(config));
}
