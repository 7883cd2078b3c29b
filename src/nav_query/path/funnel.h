// SPDX-License-Identifier: MIT
//
// Straight paths of which only the beginning is wanted.

#ifndef TALUS_SRC_NAV_QUERY_FUNNEL_H
#define TALUS_SRC_NAV_QUERY_FUNNEL_H

#include <talus/nav_query.h>

/// Whether two points are one in the plane.
static inline bool tl_nav_is_same_place(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.z == b.z;
}

/// The first corners of what tl_navmesh_straight_path finds: it stops when there are more than `capacity`, and the
/// count is then capacity.
tl_result tl_nav_first_corners(const tl_navmesh *navmesh, const tl_nav_polygon_path *path, tl_nav_corner *corners_out,
                               uint32_t capacity, uint32_t *count_out);

/// The two anchors of the off-mesh link corridor[1], that leads from corridor[0] to corridor[2]. TL_ERR_STALE: it
/// is gone. TL_ERR_ARGUMENT: it leads elsewhere.
tl_result tl_nav_find_link(const tl_navmesh *navmesh, const tl_nav_ref *corridor, tl_vec3 ends_out[2]);

#endif
