// SPDX-License-Identifier: MIT
//
// What all triangles of a band are asked first, many at a time: where their corners lie in the lattice, whether their
// slope is walkable, which cells and voxels their box overlaps.
//
// In a detailed level most triangles lie within one cell, and these questions are most of what rasterizing takes. So
// they are loops without branches over arrays, which compilers make as wide as the machine's registers; for x86-64 they
// are compiled for AVX2 too. All levels give the same bits: nothing is fused.

#ifndef TALUS_SRC_NAV_BAKE_TRIANGLE_BLOCK_H
#define TALUS_SRC_NAV_BAKE_TRIANGLE_BLOCK_H

#include "base/cpu.h"
#include "nav_bake/input/lattice_map.h"
#include "nav_bake/input/triangle_bins.h"
#include "nav_bake/voxels/voxel_band.h"

enum { TL_TRIANGLE_BLOCK = 32 };

/// Of triangles that are not clearly on one side of the walkable slope, tl_triangle_is_walkable decides.
enum { TL_SLOPE_STEEP, TL_SLOPE_WALKABLE, TL_SLOPE_UNDECIDED };

/// What is known of a triangle's place, as bits.
enum {
    TL_PLACE_ONE_COLUMN = 1, ///< it lies within one column of cells of the lattice, sides included
    TL_PLACE_ONE_ROW = 2,
    TL_PLACE_ONE_CELL = TL_PLACE_ONE_COLUMN | TL_PLACE_ONE_ROW,
    TL_PLACE_LEVEL = 4,   ///< each piece of it has its voxels [min, max)
    TL_PLACE_INSIDE = 8,  ///< no height is outside the field
    TL_PLACE_BEFORE = 16, ///< it reaches over the band's left side
    TL_PLACE_BEHIND = 32, ///< over its right one
};

/// Triangles side by side; all lanes hold numbers.
typedef struct tl_triangle_block {
    float metres[3][3][TL_TRIANGLE_BLOCK];   ///< [axis][corner] as given
    double lattice[3][3][TL_TRIANGLE_BLOCK]; ///< [axis][corner] as tl_lattice_map_point has them
    int32_t slope[TL_TRIANGLE_BLOCK];
    int32_t first_x[TL_TRIANGLE_BLOCK], last_x[TL_TRIANGLE_BLOCK]; ///< columns of the band that its box overlaps
    int32_t first_z[TL_TRIANGLE_BLOCK], last_z[TL_TRIANGLE_BLOCK]; ///< rows, counted from the band's first
    int32_t min[TL_TRIANGLE_BLOCK], max[TL_TRIANGLE_BLOCK];        ///< voxels of its heights; none when max <= min
    int32_t place[TL_TRIANGLE_BLOCK];
} tl_triangle_block;

/// The questions, compiled for a level of instructions.
typedef struct tl_block_questions {
    /// `lattice` and `slope` from `metres`.
    void (*map)(const tl_lattice_map *map, float slope_cos, tl_triangle_block *block);
    /// All else from `lattice`, of which walls on a closed far side are moved half a cell inwards.
    void (*place)(const tl_voxel_band *band, tl_triangle_block *block);
} tl_block_questions;

extern const tl_block_questions tl_block_questions_scalar;
#if TL_CPU_LEVELS >= 2
extern const tl_block_questions tl_block_questions_avx2;
#endif

/// The widest that the machine runs.
const tl_block_questions *tl_block_questions_best(void);

/// The corners of the list's triangles from `first` on, as many as there are; other lanes repeat the last of them.
/// `first` < list->count. Returns how many.
uint32_t tl_triangle_block_fill(tl_triangle_block *block, const tl_mesh_view *mesh, const tl_triangle_list *list,
                                uint32_t first);

static inline tl_voxel_point tl_triangle_block_corner(const tl_triangle_block *block, uint32_t corner, uint32_t i)
{
    return (tl_voxel_point){ block->lattice[0][corner][i], block->lattice[1][corner][i], block->lattice[2][corner][i] };
}

#endif
