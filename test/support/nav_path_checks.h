// SPDX-License-Identifier: MIT
//
// What must hold of the polygons of a path.

#ifndef TALUS_TEST_NAV_PATH_CHECKS_H
#define TALUS_TEST_NAV_PATH_CHECKS_H

#include "talus_test.h"

#include <talus/nav_query.h>

/// Whether b is beside a: there is a link from a to it.
static inline bool test_are_linked(const tl_navmesh *navmesh, tl_nav_ref a, tl_nav_ref b)
{
    tl_nav_link links[64];
    uint32_t count = 0;
    bool found = false;
    if (tl_navmesh_links(navmesh, a, links, 64, &count) == TL_OK) {
        for (uint32_t i = 0; i < count; i++) {
            found = found || links[i].to == b;
        }
    }
    return found;
}

static inline bool test_offmesh_leads(const tl_navmesh *navmesh, tl_nav_ref from, tl_nav_ref link, tl_nav_ref to)
{
    tl_nav_offmesh_state state;
    int end = (link & TL_NAV_OFFMESH_BACKWARD) != 0 ? 1 : 0;
    return tl_navmesh_offmesh_state(navmesh, link, &state) == TL_OK && state.anchored &&
           (end == 0 || state.offmesh.both_ways) && state.ends[end].polygon == from &&
           state.ends[1 - end].polygon == to;
}

/// Whether each polygon is in the navmesh, and beside the last or behind an off-mesh link. *links: how many of these.
static inline bool test_path_is_whole(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t count,
                                      uint32_t *links)
{
    *links = 0;
    for (uint32_t i = 0; i + 1 < count;) {
        bool crosses = tl_nav_is_offmesh(polygons[i + 1]);
        bool fits = crosses
                        ? i + 2 < count && test_offmesh_leads(navmesh, polygons[i], polygons[i + 1], polygons[i + 2])
                        : test_are_linked(navmesh, polygons[i], polygons[i + 1]);
        if (!fits) {
            return false;
        }
        *links += crosses;
        i += crosses ? 2 : 1;
    }
    return count > 0 && tl_navmesh_resolve(navmesh, polygons[count - 1], NULL, NULL) == TL_OK;
}

#endif
