// SPDX-License-Identifier: MIT
//
// The baked tile of a navmesh: what nav_build writes and nav_query reads. An immutable blob.
// It has a header of its own because building and querying never include each other.

#ifndef TALUS_NAV_TILE_H
#define TALUS_NAV_TILE_H

#include <talus/base.h>
#include <talus/polygon.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_nav_tile tl_nav_tile;

/// One polygon's share of the detail mesh.
typedef struct tl_nav_detail_patch {
    uint32_t first_vertex;
    uint32_t vertex_count; ///< the polygon's own corners first, then added ones
    uint32_t first_triangle;
    uint32_t triangle_count;
} tl_nav_detail_patch;

/// Corners are local to the patch. Bit k of edge_flags: the edge from corner k to k + 1 lies on the polygon's outline.
typedef struct tl_nav_detail_triangle {
    uint16_t corner[3];
    uint16_t edge_flags;
} tl_nav_detail_triangle;

/// Heights inside the polygons. One patch a polygon.
typedef struct tl_nav_detail {
    uint32_t patch_count;
    uint32_t vertex_count;
    uint32_t triangle_count;
    tl_nav_detail_patch *patches;
    tl_vec3 *vertices; ///< metres, in the world
    tl_nav_detail_triangle *triangles;
    void *block; ///< one block holds all arrays
    size_t block_size;
} tl_nav_detail;

TL_API void tl_nav_detail_free(tl_nav_detail *detail, const tl_allocator *allocator);

#ifdef __cplusplus
}
#endif

#endif
