// SPDX-License-Identifier: MIT
//
// The rows of a field that triangles are voxelized into together.

#ifndef TALUS_SRC_NAV_BAKE_VOXEL_BAND_H
#define TALUS_SRC_NAV_BAKE_VOXEL_BAND_H

#include "nav_bake/voxels/span_buffer.h"

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

// voxelize_rows.c
void tl_voxel_heights_init(double *heights, uint32_t line);

#endif
