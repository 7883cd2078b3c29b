// SPDX-License-Identifier: MIT
//
// Making the compact heightfield.

#ifndef TALUS_SRC_NAV_BAKE_COMPACT_H
#define TALUS_SRC_NAV_BAKE_COMPACT_H

#include "nav_bake/voxels/rasterize.h"

/// The same floors as rasterization, filters and compaction one after the other, without a heightfield in between.
/// Adds the number of spans to *span_count.
tl_result tl_nav_open_triangles(const tl_nav_config *config, const tl_nav_input *input, tl_triangle_list list,
                                const tl_host *host, tl_nav_compact *compact_out, uint64_t *span_count,
                                tl_report *report);

/// Allocates and fills the links between floors.
tl_result tl_nav_link_floors(const tl_host *host, tl_nav_compact *compact);

#endif
