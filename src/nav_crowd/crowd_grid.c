// SPDX-License-Identifier: MIT
//
// The neighbours' grid: a counting sort of all agents by cell, and a copy of what they show in that order, so that the
// cells of a row are one run of memory.
//
// The grid repeats itself in both directions (a torus): it takes memory for the agents, not for the world, its cells
// stay fine wherever agents are, and cells of different places that fall together cost a distance that is compared in
// vain. A hash of cells would do the same but scatter the rows; a k-d tree, as RVO2 has one, is slower to build and
// to walk than a sort that is linear.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"
#include "nav_crowd/crowd_neighbors.h"

#include <math.h>
#include <string.h>

// Cells across the distance at which agents see one another: few agents stand in the cells around one, and a row of
// them is one run.
enum { CELLS_PER_REACH = 2 };

static uint32_t grid_cell(const crowd_grid *grid, float x, float z)
{
    return ((uint32_t)tl_crowd_place_in_grid(z, grid->cell_size).cell & grid->mask_z) << grid->shift_z |
           ((uint32_t)tl_crowd_place_in_grid(x, grid->cell_size).cell & grid->mask_x);
}

// Seconds after which others see that an agent is held up.
#define SEEN_STALLED_AFTER 0.5f

static uint32_t kind_of(const crowd_fields *a, uint32_t i)
{
    const uint32_t status = a->status[i];
    if (status == TL_NAV_AGENT_FIXED || status == TL_NAV_AGENT_ON_LINK || status == TL_NAV_AGENT_OFF_MESH) {
        return CROWD_SEEN_FIXED;
    }
    uint32_t kind = tl_crowd_stands(status) ? CROWD_SEEN_STILL : 0;
    kind |= (a->flags[i] & CROWD_YIELDS) != 0 ? CROWD_SEEN_YIELDS : 0;
    kind |= status == TL_NAV_AGENT_WALKING && a->stalled[i] > SEEN_STALLED_AFTER ? CROWD_SEEN_STALLED : 0;
    return kind;
}

static void copy_agent(tl_nav_crowd *crowd, uint32_t i, uint32_t to)
{
    const crowd_fields *a = &crowd->a;
    crowd_snapshot *seen = &crowd->seen;
    seen->x[to] = a->x[i];
    seen->y[to] = a->y[i];
    seen->z[to] = a->z[i];
    seen->vx[to] = a->vx[i];
    seen->vz[to] = a->vz[i];
    seen->radius[to] = a->radius[i];
    seen->height[to] = a->height[i];
    seen->priority[to] = a->priority[i];
    seen->wanted_x[to] = a->wanted_x[i];
    seen->wanted_z[to] = a->wanted_z[i];
    seen->agent[to] = i;
    seen->kind[to] = kind_of(a, i) | (a->flags[i] & CROWD_TRAVEL_MASK);
}

void tl_crowd_fill_grid(tl_nav_crowd *crowd)
{
    crowd_grid *grid = &crowd->grid;
    const crowd_fields *a = &crowd->a;
    const uint32_t used = crowd->head->used;
    memset(grid->first, 0, ((size_t)grid->cell_count + 1) * sizeof *grid->first);
    grid->cell_size = crowd->def.neighbor_distance / (float)CELLS_PER_REACH;
    crowd->seen.count = crowd->head->count;
    crowd->seen.max_radius = 0.0f;
    for (uint32_t i = 0; i < used; i++) {
        if (a->status[i] != CROWD_FREE) {
            grid->cell[i] = grid_cell(grid, a->x[i], a->z[i]);
            grid->first[grid->cell[i] + 1]++;
            crowd->seen.max_radius = tl_max_f32(crowd->seen.max_radius, a->radius[i]);
        }
    }
    for (uint32_t c = 0; c < grid->cell_count; c++) {
        grid->first[c + 1] += grid->first[c];
    }
    // Each cell's entry moves to its end, so that it is the next one's begin.
    for (uint32_t i = 0; i < used; i++) {
        if (a->status[i] != CROWD_FREE) {
            copy_agent(crowd, i, grid->first[grid->cell[i]]++);
        }
    }
    memmove(grid->first + 1, grid->first, (size_t)grid->cell_count * sizeof *grid->first);
    grid->first[0] = 0;
}
