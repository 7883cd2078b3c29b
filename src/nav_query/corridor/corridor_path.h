// SPDX-License-Identifier: MIT
//
// A corridor's list of polygons: what its files share.

#ifndef TALUS_SRC_NAV_QUERY_CORRIDOR_PATH_H
#define TALUS_SRC_NAV_QUERY_CORRIDOR_PATH_H

#include <talus/nav_corridor.h>

/// Puts `count` entries in the place of the corridor's first `replaced` ones. What does not fit any more is cut off.
void tl_nav_corridor_replace(tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_ref *entries,
                             uint32_t count, uint32_t replaced);

/// Entries before the first off-mesh link.
uint32_t tl_nav_corridor_before_link(const tl_nav_corridor *corridor);

#endif
