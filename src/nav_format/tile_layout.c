// SPDX-License-Identifier: MIT
//
// Where the arrays of a tile lie: behind the header, in the header's order, each at the next multiple of 64.

#include "nav_format/tile_layout.h"

#include "base/exact_floats.h"

#include <string.h>

_Static_assert(sizeof(tl_nav_tile) == 256, "the header has no hidden padding");
_Static_assert(sizeof(tl_nav_portal) == 24 && sizeof(tl_nav_profile_point) == 8, "no hidden padding");
_Static_assert(sizeof(tl_nav_tile_node) == 32 && sizeof(tl_nav_detail_triangle) == 8, "no hidden padding");
_Static_assert(offsetof(tl_nav_tile, profile) - offsetof(tl_nav_tile, first_corner) ==
                   (TL_NAV_TILE_ARRAYS - 1) * sizeof(uint64_t),
               "the offsets stand side by side, one an array");

static uint64_t align_up(uint64_t value)
{
    return (value + TL_BLOB_ALIGNMENT - 1) & ~(uint64_t)(TL_BLOB_ALIGNMENT - 1);
}

void tl_nav_tile_extents(const tl_nav_tile *tile, tl_nav_extent extents_out[TL_NAV_TILE_ARRAYS])
{
    uint64_t polygons = tile->polygon_count;
    uint64_t corners = tile->corner_count;
    const uint64_t sizes[TL_NAV_TILE_ARRAYS] = {
        (polygons + 1) * sizeof(uint32_t),                                      // first_corner
        corners * sizeof(tl_vec3),                                              // corners
        corners * sizeof(uint32_t),                                             // links
        corners * sizeof(uint32_t),                                             // corner_vertices
        3 * (uint64_t)tile->vertex_count * sizeof(int32_t),                     // vertices
        polygons * sizeof(uint64_t),                                            // flags
        polygons,                                                               // areas
        (polygons + 1) * sizeof(uint32_t),                                      // detail_first_vertex
        (polygons + 1) * sizeof(uint32_t),                                      // detail_first_triangle
        (uint64_t)tile->detail_vertex_count * sizeof(tl_vec3),                  // detail_vertices
        (uint64_t)tile->detail_triangle_count * sizeof(tl_nav_detail_triangle), // detail_triangles
        (uint64_t)tile->node_count * sizeof(tl_nav_tile_node),                  // nodes
        (uint64_t)tile->portal_count * sizeof(tl_nav_portal),                   // portals
        (uint64_t)tile->profile_count * sizeof(tl_nav_profile_point),           // profile
    };
    uint64_t offset = sizeof(tl_nav_tile);
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        extents_out[i].offset = offset;
        extents_out[i].size = sizes[i];
        extents_out[i].end = align_up(offset + sizes[i]);
        offset = extents_out[i].end;
    }
}

void tl_nav_tile_set_offsets(tl_nav_tile *tile, const tl_nav_extent extents[TL_NAV_TILE_ARRAYS])
{
    uint64_t offsets[TL_NAV_TILE_ARRAYS];
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        offsets[i] = extents[i].offset;
    }
    memcpy(&tile->first_corner, offsets, sizeof offsets);
}
