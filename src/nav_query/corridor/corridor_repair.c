// SPDX-License-Identifier: MIT
//
// Whether a corridor is valid, and repairing it after tiles were added or removed.
//
// References into a tile that was replaced are stale for ever, so checking them suffices; whether each polygon still
// leads to the next is looked up in the navmesh. A broken corridor is searched anew from end to end: its far part may
// already have been the longer way, and a search that finds its goal soon costs little.

#include "base/assert.h"
#include "base/min_max.h"
#include "nav_query/corridor/corridor_path.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/path/funnel.h"
#include "nav_query/search/portal_between.h"

#include <string.h>

// Whether entry i, a polygon, is there, passes, and is led to by the entry before.
static bool is_whole(const tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                     uint32_t i)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    const tl_nav_ref *entry = &corridor->path[i];
    tl_vec3 ends[2];
    if (!tl_nav_split_ref(navmesh, *entry, &slot, &polygon)) {
        return false;
    }
    if (i == 0) {
        return true; // the agent stands there, whatever the filter says
    }
    if (!tl_nav_passes(filter, navmesh->slots[slot].tile, polygon)) {
        return false;
    }
    return tl_nav_is_offmesh(entry[-1]) ? i >= 2 && tl_nav_find_link(navmesh, entry - 2, ends) == TL_OK
                                        : tl_nav_portal_between(navmesh, entry[-1], slot, polygon, &ends[0], &ends[1]);
}

uint32_t tl_nav_corridor_check(const tl_nav_corridor *corridor, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                               uint32_t max_count)
{
    TL_ASSERT(corridor != NULL && navmesh != NULL);
    uint32_t count = tl_min_u32(max_count, corridor->count);
    uint32_t whole = 0;
    for (uint32_t i = 0; i < count; i++) {
        // A link is checked with the polygon that it leads to.
        if (tl_nav_is_offmesh(corridor->path[i])) {
            continue;
        }
        if (!is_whole(corridor, navmesh, filter, i)) {
            return whole;
        }
        whole = i + 1;
    }
    return count;
}

tl_result tl_nav_corridor_repair(tl_nav_corridor *corridor, tl_nav_query *query, const tl_navmesh *navmesh,
                                 const tl_nav_filter *filter, tl_vec3 half_extents, tl_nav_path *path_out)
{
    if (corridor == NULL || query == NULL || navmesh == NULL || path_out == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    if (corridor->count == 0) {
        return TL_ERR_ARGUMENT;
    }
    if (tl_nav_corridor_check(corridor, navmesh, filter, UINT32_MAX) == corridor->count) {
        path_out->status = TL_NAV_PATH_COMPLETE;
        path_out->polygon_count = corridor->count;
        path_out->end.polygon = corridor->path[corridor->count - 1];
        path_out->end.point = corridor->target;
        return TL_OK;
    }
    tl_nav_location agent = { corridor->path[0], corridor->position };
    tl_nav_location goal;
    if (tl_navmesh_resolve(navmesh, agent.polygon, NULL, NULL) != TL_OK) {
        TL_TRY(tl_navmesh_find_nearest(navmesh, filter, corridor->position, half_extents, &agent));
    }
    tl_vec3 wanted = corridor->goal;
    tl_result result = tl_navmesh_find_nearest(navmesh, filter, wanted, half_extents, &goal);
    if (result != TL_OK && result != TL_NOT_FOUND) {
        return result;
    }
    tl_nav_corridor_reset(corridor, &agent);
    if (result == TL_OK) {
        result = tl_nav_corridor_find(corridor, query, navmesh, filter, &goal, path_out);
    } else {
        path_out->status = TL_NAV_PATH_UNREACHABLE;
        path_out->polygon_count = 1;
        path_out->end = agent;
        corridor->reaches = false;
        result = TL_OK;
    }
    corridor->goal = wanted;
    return result;
}
