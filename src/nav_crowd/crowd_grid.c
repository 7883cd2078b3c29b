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

// Seconds after which others see that an agent is held up; and that it has the right of way.
#define SEEN_STALLED_AFTER 0.5f
#define CLAIM_AFTER        16.0f

static uint32_t kind_of(const crowd_fields *a, uint32_t i)
{
    const uint32_t status = a->status[i];
    if (status == TL_NAV_AGENT_FIXED || status == TL_NAV_AGENT_ON_LINK || status == TL_NAV_AGENT_OFF_MESH) {
        return CROWD_SEEN_FIXED;
    }
    uint32_t kind = tl_crowd_stands(status) ? CROWD_SEEN_STILL : 0;
    kind |= (a->flags[i] & CROWD_YIELDS) != 0 ? CROWD_SEEN_YIELDS : 0;
    kind |= status == TL_NAV_AGENT_WALKING && a->stalled[i] > SEEN_STALLED_AFTER ? CROWD_SEEN_STALLED : 0;
    kind |= status == TL_NAV_AGENT_WALKING && a->stalled[i] > CLAIM_AFTER ? CROWD_SEEN_CLAIMS : 0;
    kind |= (a->flags[i] & CROWD_PARTIAL) != 0 ? CROWD_SEEN_CUT_OFF : 0;
    return kind;
}

// Agents of one task of these passes: each takes little time.
enum { GRID_BLOCK = 1024 };

static void find_agent_cells(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const crowd_step *step = (const crowd_step *)user;
    const crowd_grid *grid = &step->crowd->grid;
    const crowd_fields *a = &step->crowd->a;
    const uint32_t end = tl_block_end(block, GRID_BLOCK, step->crowd->head->used);
    for (uint32_t i = block * GRID_BLOCK; i < end; i++) {
        if (a->status[i] != CROWD_FREE) {
            grid->cell[i] = grid_cell(grid, a->x[i], a->z[i]);
        }
    }
}

static void copy_seen_agents(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const crowd_step *step = (const crowd_step *)user;
    const crowd_fields *a = &step->crowd->a;
    const crowd_snapshot *seen = &step->crowd->seen;
    const uint32_t end = tl_block_end(block, GRID_BLOCK, seen->count);
    for (uint32_t k = block * GRID_BLOCK; k < end; k++) {
        crowd_seen_agent *one = &seen->agents[k];
        const uint32_t i = one->agent;
        one->x = a->x[i];
        one->z = a->z[i];
        one->radius = a->radius[i];
        one->bottom = a->y[i];
        one->top = a->y[i] + a->height[i];
        one->vx = a->vx[i];
        one->vz = a->vz[i];
        one->wanted_x = a->wanted_x[i];
        one->wanted_z = a->wanted_z[i];
        one->priority = a->priority[i];
        one->kind = kind_of(a, i) | (a->flags[i] & CROWD_TRAVEL_MASK);
    }
}

// A counting sort by cell. `cell` holds the place in the snapshot then. From the last agent back, so that each cell's
// entry moves from its end to its begin: that leaves the agents of a cell in the order of their places.
static void sort_agents(tl_nav_crowd *crowd)
{
    const crowd_grid *grid = &crowd->grid;
    const crowd_fields *a = &crowd->a;
    const uint32_t used = crowd->head->used;
    uint32_t *first = grid->first, *cell = grid->cell;
    memset(first, 0, (size_t)grid->cell_count * sizeof *first);
    float max_radius = 0.0f;
    for (uint32_t i = 0; i < used; i++) {
        if (a->status[i] != CROWD_FREE) {
            first[cell[i]]++;
            max_radius = tl_max_f32(max_radius, a->radius[i]);
        }
    }
    crowd->seen.max_radius = max_radius;
    uint32_t end = 0;
    for (uint32_t c = 0; c < grid->cell_count; c++) {
        end += first[c];
        first[c] = end;
    }
    first[grid->cell_count] = end;
    for (uint32_t i = used; i-- > 0;) {
        if (a->status[i] != CROWD_FREE) {
            const uint32_t k = --first[cell[i]];
            crowd->seen.agents[k].agent = i;
            cell[i] = k;
        }
    }
}

void tl_crowd_fill_grid(const crowd_step *step)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd->grid.cell_size = crowd->def.neighbor_distance / (float)CELLS_PER_REACH;
    crowd->seen.count = crowd->head->count;
    tl_crowd_run_tasks(step, find_agent_cells, tl_block_count(crowd->head->used, GRID_BLOCK));
    sort_agents(crowd);
    tl_crowd_run_tasks(step, copy_seen_agents, tl_block_count(crowd->seen.count, GRID_BLOCK));
}
