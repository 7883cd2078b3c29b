// SPDX-License-Identifier: MIT
//
// Nearly flat regions of an exact hull: which faces lie within a distance of one plane, and the hull's polygons when
// each region is one face.

#ifndef TALUS_SRC_HULL_FLAT_REGIONS_H
#define TALUS_SRC_HULL_FLAT_REGIONS_H

#include "hull/bake/hull_polygons.h"

// For an exact hull, whose vertex v is points[fine->points[v]]: sets `spare` [vertex_count] for vertices that lie
// inside a region, or in the middle of a nearly straight border between two, and so could be left out. TL_ERR_MEMORY,
// TL_ERR_CANCELLED.
tl_result tl_hull_find_spare_vertices(const tl_hull_polygons *fine, const tl_vec3 *points, double distance,
                                      tl_arena *arena, tl_stage *stage, bool *spare);

// The same hull with faces merged where their corners lie within `distance` behind the plane of one of them. All
// vertices stay, each with three edges or more, and every face is strictly convex, seen along that plane's normal.
tl_result tl_hull_merge_flat_regions(const tl_hull_polygons *fine, const tl_vec3 *points, float distance,
                                     tl_arena *arena, tl_stage *stage, tl_hull_polygons *merged_out);

#endif
