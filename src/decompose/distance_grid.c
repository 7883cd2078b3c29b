// SPDX-License-Identifier: MIT
//
// Distances from the body, sampled at the centres of cubic cells.
//
// Voxels of the surface, as V-HACD has them, say only that a cell is touched; a distance at its centre bounds all of
// the cell, since distances change by no more than the way between two points. So the same grid guides the cuts, sorts
// out what encloses what, and proves most of a part's concavity. Each distance is measured by the soup's nearest query,
// whose search is bounded by the distance of the cell before and one step.
//
// What is enclosed: two neighbouring centres that are both farther than half a cell from the surface have nothing
// between them. A flood over such cells from the grid's rim finds what can be reached from outside; the rest is body.

#include "decompose/distance_grid.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "math/tolerance.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    CELLS_PER_TOLERANCE = 2, // their half diagonal is below the tolerance then, so most cells need no closer look
    FEWEST_CELLS = 16,       // along the longest side, where the tolerance is large
    RIM_CELLS = 2,           // around the body, for the flood
};

// Room beyond a limit of search, against its own rounding.
#define LIMIT_GROWTH 1.0001

// The share of the tolerance that counts as no excess. Below 1, as the farthest points lie between the cells' centres.
#define FREE_SHARE 0.75f

typedef struct grid_job {
    tl_distance_grid *grid;
    double tolerance;
} grid_job;

static double cells_along(double extent, double cell)
{
    return ceil(extent / cell) + 2.0 * (double)RIM_CELLS;
}

// The side of the cells: as the tolerance asks, or as many as there may be.
static double choose_cell(tl_vec3d extent, double tolerance, uint32_t max_cells)
{
    const double longest = tl_max_f64(extent.x, tl_max_f64(extent.y, extent.z));
    double cell = tl_min_f64(tolerance / (double)CELLS_PER_TOLERANCE, longest / (double)FEWEST_CELLS);
    while (cells_along(extent.x, cell) * cells_along(extent.y, cell) * cells_along(extent.z, cell) >
           (double)max_cells) {
        cell *= 1.03125;
    }
    return cell;
}

void tl_distance_grid_cell(const tl_distance_grid *grid, tl_vec3 point, uint32_t cell_out[3])
{
    const tl_vec3d at = tl_vec3d_sub(tl_vec3d_from(point), grid->origin);
    const double along[3] = { at.x / grid->cell, at.y / grid->cell, at.z / grid->cell };
    for (uint32_t axis = 0; axis < 3; axis++) {
        cell_out[axis] = (uint32_t)tl_clamp_f64(along[axis], 0.0, (double)(grid->size[axis] - 1));
    }
}

double tl_surface_distance(const tl_distance_grid *grid, tl_vec3 point, float limit)
{
    tl_soup_point nearest;
    return tl_soup_nearest(grid->soup, point, limit, NULL, &nearest) == TL_OK ? (double)nearest.distance
                                                                              : (double)INFINITY;
}

// The distances of one layer of cells.
static void measure_layer(uint32_t z, uint32_t worker, void *user)
{
    (void)worker;
    tl_distance_grid *grid = ((const grid_job *)user)->grid;
    const double step = grid->cell + 2.0 * grid->noise;
    for (uint32_t y = 0; y < grid->size[1]; y++) {
        float *row = grid->distance + tl_distance_grid_index(grid, 0, y, z);
        double limit = (double)FLT_MAX;
        for (uint32_t x = 0; x < grid->size[0]; x++) {
            row[x] = (float)tl_surface_distance(grid, tl_distance_grid_center(grid, x, y, z), (float)limit);
            limit = ((double)row[x] + step) * LIMIT_GROWTH;
        }
    }
}

typedef struct grid_flood {
    const tl_distance_grid *grid;
    uint8_t *reached;
    uint32_t *waiting;
    uint32_t waiting_count;
    float open; // centres farther than this from the surface have nothing between them and such a neighbour
} grid_flood;

static void reach_cell(grid_flood *flood, size_t at)
{
    if (flood->reached[at] == 0 && flood->grid->distance[at] > flood->open) {
        flood->reached[at] = 1;
        flood->waiting[flood->waiting_count++] = (uint32_t)at;
    }
}

static void reach_neighbours(grid_flood *flood, uint32_t at)
{
    const uint32_t *size = flood->grid->size;
    const uint32_t strides[3] = { 1, size[0], size[0] * size[1] };
    const uint32_t place[3] = { at % size[0], at / size[0] % size[1], at / strides[2] };
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (place[axis] > 0) {
            reach_cell(flood, at - strides[axis]);
        }
        if (place[axis] + 1 < size[axis]) {
            reach_cell(flood, at + strides[axis]);
        }
    }
}

// Cells that the flood does not reach get negative distances. The rim is all open, so one of its corners reaches it.
static tl_result find_enclosed(tl_distance_grid *grid, size_t cell_count, tl_arena *arena, tl_stage *stage)
{
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    grid_flood flood = { grid, TL_PUSH_ZERO(arena, uint8_t, cell_count), TL_PUSH(arena, uint32_t, cell_count), 0,
                         (float)((grid->cell / 2.0 + 2.0 * grid->noise) * LIMIT_GROWTH) };
    if (flood.reached == NULL || flood.waiting == NULL) {
        return TL_ERR_MEMORY;
    }
    reach_cell(&flood, 0);
    for (uint64_t visited = 0; flood.waiting_count > 0; visited++) {
        TL_TRY(tl_stage_tick(stage, visited));
        reach_neighbours(&flood, flood.waiting[--flood.waiting_count]);
    }
    for (size_t i = 0; i < cell_count; i++) {
        if (flood.reached[i] == 0 && grid->distance[i] > flood.open) {
            grid->distance[i] = -grid->distance[i];
        }
    }
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

// The sums of one layer.
static void sum_layer(uint32_t z, uint32_t worker, void *user)
{
    (void)worker;
    const grid_job *job = user;
    tl_distance_grid *grid = job->grid;
    const float free_distance = FREE_SHARE * (float)job->tolerance,
                scale = (float)((double)TL_EXCESS_STEPS / grid->cell);
    for (uint32_t y = 0; y < grid->size[1]; y++) {
        const size_t line = (size_t)z * grid->size[1] + y;
        const float *distance = grid->distance + line * grid->size[0];
        uint32_t *sums = grid->excess + line * (grid->size[0] + 1);
        sums[0] = 0;
        for (uint32_t x = 0; x < grid->size[0]; x++) {
            const float beyond = distance[x] - free_distance;
            sums[x + 1] = sums[x] + (beyond > 0.0f ? (uint32_t)(beyond * scale) + 1u : 0u);
        }
    }
}

tl_result tl_distance_grid_build(const tl_soup *soup, const tl_decompose_def *def, double tolerance, float thickness,
                                 tl_arena *arena, tl_stage *stage, tl_distance_grid *grid)
{
    const tl_aabb bounds = tl_soup_bounds(soup);
    const double aside = (double)thickness / 2.0;
    const tl_vec3d margin = { aside, aside, aside }, low = tl_vec3d_sub(tl_vec3d_from(bounds.min), margin);
    const tl_vec3d extent = tl_vec3d_sub(tl_vec3d_add(tl_vec3d_from(bounds.max), margin), low);
    const double extents[3] = { extent.x, extent.y, extent.z };
    const tl_vec3 size = tl_max(tl_abs(bounds.min), tl_abs(bounds.max));
    grid->soup = soup;
    grid->cell = choose_cell(extent, tolerance, def->max_cells);
    grid->noise = 4.0 * (double)TL_FLOAT_ROUNDING * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    for (uint32_t axis = 0; axis < 3; axis++) {
        grid->size[axis] = (uint32_t)cells_along(extents[axis], grid->cell);
    }
    const tl_vec3d spare =
        tl_vec3d_make((double)grid->size[0] * grid->cell - extent.x, (double)grid->size[1] * grid->cell - extent.y,
                      (double)grid->size[2] * grid->cell - extent.z);
    grid->origin = tl_vec3d_mul_add(low, spare, -0.5);
    const size_t lines = (size_t)grid->size[1] * grid->size[2], cell_count = lines * grid->size[0];
    grid->distance = TL_PUSH(arena, float, cell_count);
    grid->excess = TL_PUSH(arena, uint32_t, cell_count + lines);
    if (grid->distance == NULL || grid->excess == NULL) {
        return TL_ERR_MEMORY;
    }
    grid_job job = { grid, tolerance };
    TL_TRY(tl_stage_run(stage, measure_layer, grid->size[2], &job, 1, grid->size[2]));
    if (def->solid == TL_SOLID_ENCLOSED) {
        TL_TRY(find_enclosed(grid, cell_count, arena, stage));
    }
    return tl_stage_run(stage, sum_layer, grid->size[2], &job, 16, 0);
}

// Whether the centre of a cell lies in the body and sees the point.
static bool body_sees(const tl_distance_grid *grid, const uint32_t cell[3], tl_vec3 point)
{
    if (grid->distance[tl_distance_grid_index(grid, cell[0], cell[1], cell[2])] >= 0.0f) {
        return false;
    }
    const tl_vec3 center = tl_distance_grid_center(grid, cell[0], cell[1], cell[2]);
    return tl_soup_line_of_sight(grid->soup, center, point, NULL);
}

// Neighbours of a cell that may see a point in it: 0 here, 1 one higher, 2 one lower.
static bool neighbour_cell(const tl_distance_grid *grid, const uint32_t cell[3], const uint32_t shift[3],
                           uint32_t out[3])
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        if ((shift[axis] == 2 && cell[axis] == 0) || (shift[axis] == 1 && cell[axis] + 1 == grid->size[axis])) {
            return false;
        }
        out[axis] = shift[axis] == 2 ? cell[axis] - 1 : cell[axis] + shift[axis];
    }
    return true;
}

bool tl_distance_grid_is_inside(const tl_distance_grid *grid, tl_vec3 point, double surface_distance)
{
    uint32_t cell[3], other[3];
    tl_distance_grid_cell(grid, point, cell);
    const float here = grid->distance[tl_distance_grid_index(grid, cell[0], cell[1], cell[2])];
    // The whole cell may lie within reach of its centre, or of the point: then the sign is that of the centre.
    const double diagonal = grid->cell * 0.8660254037844387 + grid->noise;
    if ((double)fabsf(here) > diagonal || (here < 0.0f && surface_distance > diagonal)) {
        return here < 0.0f;
    }
    for (uint32_t i = 0; i < 27; i++) {
        const uint32_t shift[3] = { i % 3, i / 3 % 3, i / 9 };
        if (neighbour_cell(grid, cell, shift, other) && body_sees(grid, other, point)) {
            return true;
        }
    }
    return false;
}
