// SPDX-License-Identifier: MIT
//
// Rasterization of some of a mesh's triangles, already checked.

#ifndef TALUS_SRC_NAV_BUILD_RASTERIZE_H
#define TALUS_SRC_NAV_BUILD_RASTERIZE_H

#include "nav_build/triangle_bins.h"

/// tl_nav_rasterize for the triangles of a list, without checking the mesh.
tl_result tl_nav_rasterize_list(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                                tl_triangle_list list, const tl_host *host, tl_nav_heightfield *heightfield_out,
                                tl_report *report);

#endif
