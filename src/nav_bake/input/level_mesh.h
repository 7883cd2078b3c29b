// SPDX-License-Identifier: MIT
//
// The check of the caller's triangles, and the walkable slope.

#ifndef TALUS_SRC_NAV_BAKE_LEVEL_MESH_H
#define TALUS_SRC_NAV_BAKE_LEVEL_MESH_H

#include <talus/nav_bake.h>

/// Checks indices and coordinates, and measures the bounds of the vertices that triangles use. `bounds_out` may be
/// NULL.
tl_result tl_level_mesh_check(const tl_mesh_view *mesh, tl_aabb *bounds_out, tl_report *report);

/// Whether the triangle faces up and is less steep than a slope of that cosine, or flat.
bool tl_triangle_is_walkable(tl_vec3 a, tl_vec3 b, tl_vec3 c, float slope_cos);

#endif
