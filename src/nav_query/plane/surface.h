// SPDX-License-Identifier: MIT
//
// Points and polygons of one tile.

#ifndef TALUS_SRC_NAV_QUERY_SURFACE_H
#define TALUS_SRC_NAV_QUERY_SURFACE_H

#include <talus/nav_tile.h>

/// The height of a polygon's surface at x and z; where no triangle holds the point, that of the nearest one.
float tl_nav_surface_height(const tl_nav_tile *tile, uint32_t polygon, float x, float z);

/// The height where a triangle of the polygon's surface holds x and z. False: none does.
bool tl_nav_find_surface_height(const tl_nav_tile *tile, uint32_t polygon, float x, float z, float *height_out);

/// Whether x and z lie over the polygon, its outline included. Exact.
bool tl_nav_is_over(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point);

/// The point of the edge from a to b closest in the plane: exact at its ends, and within its box.
tl_vec3 tl_nav_closest_on_edge(tl_vec3 a, tl_vec3 b, tl_vec3 point);

/// The polygon's point closest in the plane, on its edges' own height; `point` itself (its y too) when it is over the
/// polygon.
tl_vec3 tl_nav_clamp_to_polygon(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point, bool *inside_out);

/// The same, lifted to the surface.
tl_vec3 tl_nav_closest_on_surface(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point, bool *inside_out);

static inline bool tl_nav_is_finite(tl_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

#endif
