// SPDX-License-Identifier: MIT
//
// From metres to voxels: the coordinates of a point in a field's lattice.

#ifndef TALUS_SRC_NAV_BAKE_LATTICE_MAP_H
#define TALUS_SRC_NAV_BAKE_LATTICE_MAP_H

#include <talus/nav_bake.h>

/// A point in lattice units relative to a field's first column: one unit is a column on x and z, a voxel on y.
typedef struct tl_voxel_point {
    double x, y, z;
} tl_voxel_point;

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

static inline tl_voxel_point tl_lattice_map_point(const tl_lattice_map *map, tl_vec3 point)
{
    tl_voxel_point mapped = { tl_lattice_map_x(map, point.x), ((double)point.y - map->origin_y) * map->per_height,
                              tl_lattice_map_z(map, point.z) };
    return mapped;
}

#endif
