// SPDX-License-Identifier: MIT
//
// One triangle to the voxels that it touches, within a band of rows.

#ifndef TALUS_SRC_NAV_BAKE_VOXELIZE_H
#define TALUS_SRC_NAV_BAKE_VOXELIZE_H

#include "nav_bake/voxels/span_buffer.h"

/// A point in lattice units relative to a field's first column: one unit is a column on x and z, a voxel on y.
typedef struct tl_lattice_point {
    double x, y, z;
} tl_lattice_point;

/// From metres to a field's lattice.
typedef struct tl_lattice_map {
    double origin_x, origin_y, origin_z; ///< metres
    double per_cell, per_height;         ///< 1 / cell_size, 1 / cell_height
    double first_x, first_z;             ///< columns
} tl_lattice_map;

tl_lattice_map tl_lattice_map_make(const tl_nav_lattice *lattice, float cell_size, float cell_height);

/// Parts of a cell and of a voxel that coordinates are rounded to.
#define TL_SUBDIVISIONS 1024
/// 1.5 * 2^(52 - 10): to add and subtract it rounds a double to a multiple of 2^-10, ties to even, when it is below
/// 2^41 in size. Larger values keep their own, coarser ulp: such points are far outside any field.
#define TL_SUBDIVISION_ROUNDER (6755399441055744.0 / TL_SUBDIVISIONS)

static inline double tl_round_to_subdivision(double value)
{
    return (value + TL_SUBDIVISION_ROUNDER) - TL_SUBDIVISION_ROUNDER;
}

// x and z are rounded to a fine grid within the cell, so that data modelled on the lattice lies on it: in the level's
// lattice, then moved by whole columns, so that every tile gets the same point. All three are monotone.

static inline double tl_lattice_map_x(const tl_lattice_map *map, float x)
{
    return tl_round_to_subdivision(((double)x - map->origin_x) * map->per_cell) - map->first_x;
}

static inline double tl_lattice_map_z(const tl_lattice_map *map, float z)
{
    return tl_round_to_subdivision(((double)z - map->origin_z) * map->per_cell) - map->first_z;
}

static inline tl_lattice_point tl_lattice_map_point(const tl_lattice_map *map, tl_vec3 point)
{
    tl_lattice_point mapped = { tl_lattice_map_x(map, point.x), ((double)point.y - map->origin_y) * map->per_height,
                                tl_lattice_map_z(map, point.z) };
    return mapped;
}

/// A band of rows of a field, and the buffer that its spans go to.
typedef struct tl_voxel_band {
    uint32_t width;         ///< columns
    uint32_t first_row;     ///< in the field
    uint32_t row_count;     ///< width * row_count <= TL_SPAN_ITEM_MAX_COLUMNS
    uint32_t field_height;  ///< rows of the field
    uint32_t height_voxels; ///< spans are cut to [0, height_voxels]
    bool closed_far_side;   ///< a wall that lies exactly on the field's far side belongs to its last column or row
    uint32_t line;          ///< >= width and row_count: cells of each scratch array
    double *heights;        ///< [4 * line] scratch, set up by tl_voxel_heights_init; each call leaves it so
    tl_span_buffer *buffer;
} tl_voxel_band;

#define TL_VOXEL_HEIGHTS_PER_CELL 4

void tl_voxel_heights_init(double *heights, uint32_t line);

/// Adds the spans of the triangle abc, of the given area, to the band's buffer. TL_ERR_MEMORY or TL_ERR_LIMIT when that
/// can't grow.
tl_result tl_voxelize_triangle(const tl_voxel_band *band, tl_lattice_point a, tl_lattice_point b, tl_lattice_point c,
                               uint32_t area);

#endif
