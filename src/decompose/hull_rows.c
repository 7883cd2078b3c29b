// SPDX-License-Identifier: MIT
//
// Scan conversion of a hull into the cells of a grid: in each row its planes bound x from above or below, so a row
// takes one pass over the planes, not one a cell. Two intervals come of it: of cells that the hull may touch, widened
// by the reach of a cube along each normal, and of cells whose centre it holds.

#include "decompose/hull_rows.h"

#include "base/min_max.h"

#include <math.h>

// Of unit normals, no unit. A plane that leans less along x bounds no x: it decides on whole rows. What is lost along
// a row, this times its length, is counted as noise below.
static const double LEAST_LEAN = 1e-9;

static void put_row_plane(tl_row_plane *out, const tl_hull_plane *plane, double half, double noise)
{
    const double *n = plane->normal;
    const double reach = half * (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) + noise;
    const double lean = fabs(n[0]) < LEAST_LEAN ? 1.0 : n[0];
    *out = (tl_row_plane){ -n[1] / lean, -n[2] / lean, plane->offset / lean, reach / fabs(lean) };
}

// 0: bounds x from above, 1: from below, 2: not at all.
static uint32_t plane_kind(const tl_hull_plane *plane)
{
    return fabs(plane->normal[0]) < LEAST_LEAN ? 2 : plane->normal[0] > 0.0 ? 0 : 1;
}

tl_result tl_hull_rows_make(const tl_hull *hull, const tl_distance_grid *grid, tl_arena *arena, tl_hull_rows *rows)
{
    rows->grid = grid;
    rows->planes = TL_PUSH(arena, tl_row_plane, hull->face_count);
    if (rows->planes == NULL) {
        return TL_ERR_MEMORY;
    }
    // Where a plane counts as along x, its lean may still move it by so much within the grid.
    const double noise = 2.0 * grid->noise + LEAST_LEAN * grid->cell * (double)grid->size[0];
    uint32_t ends[3], count = 0;
    for (uint32_t kind = 0; kind < 3; kind++) {
        for (uint32_t i = 0; i < hull->face_count; i++) {
            const tl_hull_plane plane = tl_hull_face_plane(hull, i);
            if (plane_kind(&plane) == kind) {
                put_row_plane(&rows->planes[count++], &plane, grid->cell / 2.0, noise);
            }
        }
        ends[kind] = count;
    }
    rows->upper_end = ends[0];
    rows->lower_end = ends[1];
    rows->plane_count = ends[2];
    tl_distance_grid_cell(grid, hull->bounds.min, rows->low);
    tl_distance_grid_cell(grid, hull->bounds.max, rows->high);
    return TL_OK;
}

// The cells whose centres lie between two places.
static void cells_between(const tl_hull_rows *rows, double low, double high, int32_t *first, int32_t *last)
{
    const tl_distance_grid *grid = rows->grid;
    const double begin = (double)rows->low[0], end = (double)rows->high[0];
    const double from = (low - grid->origin.x) / grid->cell - 0.5, to = (high - grid->origin.x) / grid->cell - 0.5;
    *first = (int32_t)ceil(tl_clamp_f64(from, begin, end + 1.0));
    *last = (int32_t)floor(tl_clamp_f64(to, begin - 1.0, end));
}

tl_cell_run tl_hull_rows_run(const tl_hull_rows *rows, uint32_t y, uint32_t z)
{
    const tl_distance_grid *grid = rows->grid;
    const double at_y = grid->origin.y + ((double)y + 0.5) * grid->cell;
    const double at_z = grid->origin.z + ((double)z + 0.5) * grid->cell;
    const tl_cell_run nothing = { 0, -1, 0, -1 };
    double high = (double)INFINITY, high_inside = high, low = -high, low_inside = low;
    for (uint32_t i = rows->lower_end; i < rows->plane_count; i++) {
        const tl_row_plane *p = &rows->planes[i];
        const double room = p->c + p->a * at_y + p->b * at_z;
        if (room + p->wider < 0.0) {
            return nothing;
        }
        high_inside = room - grid->noise < 0.0 ? -(double)INFINITY : high_inside;
    }
    for (uint32_t i = 0; i < rows->upper_end; i++) {
        const tl_row_plane *p = &rows->planes[i];
        const double bound = p->c + p->a * at_y + p->b * at_z;
        high_inside = tl_min_f64(high_inside, bound);
        high = tl_min_f64(high, bound + p->wider);
    }
    for (uint32_t i = rows->upper_end; i < rows->lower_end; i++) {
        const tl_row_plane *p = &rows->planes[i];
        const double bound = p->c + p->a * at_y + p->b * at_z;
        low_inside = tl_max_f64(low_inside, bound);
        low = tl_max_f64(low, bound - p->wider);
    }
    tl_cell_run run;
    cells_between(rows, low, high, &run.first, &run.last);
    cells_between(rows, low_inside + grid->noise, high_inside - grid->noise, &run.first_inside, &run.last_inside);
    return run;
}
