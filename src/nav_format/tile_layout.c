// SPDX-License-Identifier: MIT
//
// Where the arrays of a tile lie: behind the header, in the header's order, each at the next multiple of 8. The nodes
// come first, where they are aligned to their own size: searches go from one to another that is far away.

#include "nav_format/tile_layout.h"

#include "base/arena.h"
#include "base/exact_floats.h"

#include <string.h>

_Static_assert(sizeof(tl_nav_tile) == 208, "the header has no hidden padding");
_Static_assert(sizeof(tl_nav_portal) == 20 && sizeof(tl_nav_profile_point) == 8, "no hidden padding");
_Static_assert(sizeof(tl_nav_tile_node) == 16, "no hidden padding");
_Static_assert(offsetof(tl_nav_tile, profile) - offsetof(tl_nav_tile, nodes) ==
                   (TL_NAV_TILE_ARRAYS - 1) * sizeof(uint32_t),
               "the offsets stand side by side, one an array");

static uint64_t align_up(uint64_t value, uint64_t alignment)
{
    return (value + alignment - 1) & ~(alignment - 1);
}

void tl_nav_tile_extents(const tl_nav_tile *tile, tl_nav_extent extents_out[TL_NAV_TILE_ARRAYS])
{
    uint64_t polygons = tile->polygon_count;
    uint64_t corners = tile->corner_count;
    const uint32_t link_size = (tile->wide & TL_NAV_WIDE_LINKS) != 0 ? 4 : 2;
    const uint32_t first_size = (tile->wide & TL_NAV_WIDE_FIRSTS) != 0 ? 4 : 2;
    const uint32_t flags_size = (tile->wide & TL_NAV_WIDE_FLAGS) != 0 ? 8 : 1;
    const uint32_t corner_size = (tile->wide & TL_NAV_WIDE_CORNERS) != 0 ? 4 : 2;
    const uint32_t coordinate_size = (tile->wide & TL_NAV_WIDE_LATTICE) != 0 ? 4 : 2;
    const uint32_t triangle_size = (tile->wide & TL_NAV_WIDE_TRIANGLES) != 0 ? 8 : 4;
    const uint64_t sizes[TL_NAV_TILE_ARRAYS] = {
        (uint64_t)tile->node_count * sizeof(tl_nav_tile_node),        // nodes
        (polygons + 1) * first_size,                                  // first_corner
        corners * link_size,                                          // links
        corners * corner_size,                                        // corner_vertices
        3 * (uint64_t)tile->vertex_count * coordinate_size,           // vertices
        polygons * flags_size,                                        // flags
        polygons,                                                     // areas
        (polygons + 1) * first_size,                                  // detail_first_vertex
        (polygons + 1) * first_size,                                  // detail_first_triangle
        (uint64_t)tile->detail_vertex_count * sizeof(tl_vec3),        // detail_vertices
        (uint64_t)tile->detail_triangle_count * triangle_size,        // detail_triangles
        (uint64_t)tile->portal_count * sizeof(tl_nav_portal),         // portals
        (uint64_t)tile->profile_count * sizeof(tl_nav_profile_point), // profile
    };
    uint64_t offset = sizeof(tl_nav_tile);
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        extents_out[i].offset = offset;
        extents_out[i].size = sizes[i];
        extents_out[i].end = align_up(offset + sizes[i], i + 1 < TL_NAV_TILE_ARRAYS ? 8 : TL_BLOB_ALIGNMENT);
        offset = extents_out[i].end;
    }
}

void tl_nav_tile_set_offsets(tl_nav_tile *tile, const tl_nav_extent extents[TL_NAV_TILE_ARRAYS])
{
    uint32_t offsets[TL_NAV_TILE_ARRAYS];
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        offsets[i] = (uint32_t)(extents[i].offset / 8);
    }
    memcpy(&tile->nodes, offsets, sizeof offsets);
}

tl_result tl_nav_tile_copy(const tl_nav_tile *tile, bool has_wide_flags, const tl_allocator *allocator,
                           tl_nav_tile **copy_out)
{
    if (copy_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *copy_out = NULL;
    if (tile == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_tile header = *tile;
    header.wide |= has_wide_flags ? TL_NAV_WIDE_FLAGS : 0;
    tl_nav_extent from[TL_NAV_TILE_ARRAYS], to[TL_NAV_TILE_ARRAYS];
    tl_nav_tile_extents(tile, from);
    tl_nav_tile_extents(&header, to);
    tl_nav_tile_set_offsets(&header, to);
    tl_nav_tile *copy =
        tl_blob_allocate(allocator, TL_NAV_TILE_MAGIC, TL_NAV_TILE_VERSION, to[TL_NAV_TILE_ARRAYS - 1].end);
    if (copy == NULL) {
        return TL_ERR_MEMORY;
    }
    header.blob = copy->blob;
    *copy = header;
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        if (from[i].size == to[i].size) {
            memcpy((char *)copy + to[i].offset, (const char *)tile + from[i].offset, (size_t)to[i].size);
        }
    }
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        tl_nav_tile_set_flags(copy, p, tl_nav_tile_flags(tile, p));
    }
    *copy_out = copy;
    return TL_OK;
}
