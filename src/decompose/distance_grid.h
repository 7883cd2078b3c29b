// SPDX-License-Identifier: MIT
//
// Distances from the body on a grid: exact at the cells' centres, so bounded in between.

#ifndef TALUS_SRC_DECOMPOSE_DISTANCE_GRID_H
#define TALUS_SRC_DECOMPOSE_DISTANCE_GRID_H

#include "base/arena.h"
#include "base/stage.h"
#include "math/vec3d.h"

#include <talus/decompose.h>
#include <talus/soup.h>

/// Steps of excess per cell's side: distances beyond the tolerance are weighed in integers, so that sums are exact.
#define TL_EXCESS_STEPS 16.0f

typedef struct tl_distance_grid {
    const tl_soup *soup;
    tl_vec3d origin; ///< corner of the grid
    double cell;     ///< metres, side of a cell
    double noise;    ///< metres: rounding of a point to floats, and of a distance from it
    uint32_t size[3];
    float *distance; ///< [size z][size y][size x] metres from a cell's centre to the surface, negative in the body
    /// [size z][size y][size x + 1] sums along x of what lies before a cell: how far cells are beyond the tolerance
    uint32_t *excess;
} tl_distance_grid;

/// Measures a grid around a soup, and around hulls that reach `thickness` beyond it. The arrays are the arena's.
/// TL_ERR_MEMORY, TL_ERR_CANCELLED.
tl_result tl_distance_grid_build(const tl_soup *soup, const tl_decompose_def *def, double tolerance, float thickness,
                                 tl_arena *arena, tl_stage *stage, tl_distance_grid *grid);

static inline size_t tl_distance_grid_index(const tl_distance_grid *grid, uint32_t x, uint32_t y, uint32_t z)
{
    return ((size_t)z * grid->size[1] + y) * grid->size[0] + x;
}

/// A cell's centre, as its distance was measured there.
static inline tl_vec3 tl_distance_grid_center(const tl_distance_grid *grid, uint32_t x, uint32_t y, uint32_t z)
{
    return tl_vec3_make((float)(grid->origin.x + ((double)x + 0.5) * grid->cell),
                        (float)(grid->origin.y + ((double)y + 0.5) * grid->cell),
                        (float)(grid->origin.z + ((double)z + 0.5) * grid->cell));
}

/// The cell of a point, clamped to the grid.
void tl_distance_grid_cell(const tl_distance_grid *grid, tl_vec3 point, uint32_t cell_out[3]);

/// Distance from a point to the surface: exact, but for noise. At most `limit`, or INFINITY.
double tl_surface_distance(const tl_distance_grid *grid, tl_vec3 point, float limit);

/// Whether a point belongs to the body for certain: its cell's centre, or a neighbour's, does so, and sees the point.
bool tl_distance_grid_is_inside(const tl_distance_grid *grid, tl_vec3 point, double surface_distance);

#endif
