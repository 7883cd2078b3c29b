// SPDX-License-Identifier: MIT
//
// Visiting the triangles of a region, each once.

#ifndef TALUS_SRC_SOUP_REGION_WALK_H
#define TALUS_SRC_SOUP_REGION_WALK_H

#include "soup/query/bvh_walk.h"

/// Which children of a node may meet the region: a bit a lane. Must answer the same for the same boxes.
typedef uint32_t tl_region_enter_fn(const tl_walk_boxes *boxes, const void *region);

/// Whether a triangle of an entered leaf belongs to the region. Called for copies too.
typedef bool tl_region_belongs_fn(const tl_walk_triangle *triangle, void *user);

/// Called once for each triangle that belongs and has a point in a box that is entered; false ends the walk.
typedef bool tl_region_found_fn(const tl_walk_triangle *triangle, void *user);

/// Memory of a walk for long answers: with it the triangles behind the first ones are found in passes, a share of them
/// each.
enum { TL_REGION_SLOTS = 1024 };
typedef struct tl_region_memory {
    uint32_t slots[TL_REGION_SLOTS];
} tl_region_memory;

typedef struct tl_region {
    /// The region is a box: only triangles whose own boxes share a point with it are asked about. NULL: `enter` tells.
    const tl_aabb *box;
    tl_region_enter_fn *enter;
    const void *region; ///< for `enter`
    /// NULL: all belong. Geometry alone decides: the same answer for each copy of a triangle.
    tl_region_belongs_fn *belongs;
    tl_region_found_fn *found;
    void *user;
    tl_region_memory *memory; ///< may be NULL
} tl_region;

/// Returns false when `found` ended the walk. The order is not specified, but always the same. `scale` may be NULL.
bool tl_region_walk_scaled(const tl_soup *soup, const tl_walk_scale *scale, const tl_region *region);

static inline bool tl_region_walk(const tl_soup *soup, const tl_region *region)
{
    return tl_region_walk_scaled(soup, NULL, region);
}

#endif
