// SPDX-License-Identifier: MIT
//
// One triangle to the voxels that it touches, within a band of rows.

#ifndef TALUS_SRC_NAV_BAKE_VOXELIZE_H
#define TALUS_SRC_NAV_BAKE_VOXELIZE_H

#include "nav_bake/voxels/triangle_block.h"

/// Adds the spans of the block's triangle i, which was placed in the band, of the given area, to the band's buffer.
/// TL_ERR_MEMORY or TL_ERR_LIMIT when that can't grow.
tl_result tl_voxelize_triangle(const tl_voxel_band *band, const tl_triangle_block *block, uint32_t i, uint32_t area);

#endif
