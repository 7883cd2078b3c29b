// SPDX-License-Identifier: MIT
//
// The check of the caller's triangles, and the walkable slope.

#ifndef TALUS_SRC_NAV_BAKE_LEVEL_MESH_H
#define TALUS_SRC_NAV_BAKE_LEVEL_MESH_H

#include <talus/nav_bake.h>

#include <math.h>

/// Checks indices and coordinates, and measures the bounds of the vertices that triangles use, as the host's tasks.
/// `host` and `bounds_out` may be NULL.
tl_result tl_level_mesh_check(const tl_mesh_view *mesh, const tl_host *host, tl_aabb *bounds_out, tl_report *report);

/// tl_triangle_is_walkable for triangles that floats are too short for, below 1e-10 m2 or above 1e15 m2.
bool tl_triangle_is_walkable_in_double(tl_vec3 a, tl_vec3 b, tl_vec3 c, float slope_cos);

/// Whether the unit normal's y, in floats, is above the limit: Recast's question, in the order of its operations. Of a
/// slope of exactly the limit the rounding of coordinates decides, whatever is asked; so only who rounds alike has the
/// same walkable triangles. Rejected: to call all of them walkable, within a bound of the rounding. A level of slabs
/// with bevels of 45 degrees then has 74% more floor than with Recast.
///
/// What is flat is walkable at any limit. Most triangles are clearly on one side of the limit, by their squares, and
/// the answer takes no branch that could be predicted wrong.
static inline bool tl_triangle_is_walkable(tl_vec3 a, tl_vec3 b, tl_vec3 c, float slope_cos)
{
    const tl_vec3 u = tl_sub(b, a), v = tl_sub(c, a);
    const float nx = u.y * v.z - u.z * v.y, ny = u.z * v.x - u.x * v.z, nz = u.x * v.y - u.y * v.x;
    const float square = nx * nx + ny * ny + nz * nz;
    if (!(square >= 1e-20f && square <= 1e30f)) { // so that squares neither overflow nor lose digits
        return tl_triangle_is_walkable_in_double(a, b, c, slope_cos);
    }
    const float have = ny * ny, needed = slope_cos * slope_cos * square;
    const float noise = 1e-5f * needed; // of a few roundings, and some more
    if (have > needed - noise && have < needed + noise) {
        return ny * (1.0f / sqrtf(square)) > slope_cos || (ny > 0.0f && nx == 0.0f && nz == 0.0f);
    }
    return (have > needed) & (ny > 0.0f);
}

#endif
