// SPDX-License-Identifier: MIT

#include "cli/level/navmesh_query.h"

#include "cli/level/load_level.h"
#include "cli/options/parse_value.h"

bool tl_extents_read(tl_cli *cli, const char *text, tl_vec3 *extents, tl_exit *exit_out)
{
    if (text == NULL) {
        return true;
    }
    const char *reason = tl_parse_point_value(text, extents);
    if (reason == NULL && (extents->x < 0 || extents->y < 0 || extents->z < 0)) {
        reason = "is negative";
    }
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--extents: '%s' %s; write it as X,Y,Z", text, reason);
    }
    *extents = reason == NULL ? tl_level_enter_half(cli, *extents) : *extents;
    return reason == NULL;
}

tl_nav_query_def tl_whole_query_def(const tl_navmesh *navmesh)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    uint64_t nodes = tl_navmesh_link_count(navmesh) + 2;
    def.max_nodes = nodes < UINT32_MAX ? (uint32_t)nodes : UINT32_MAX;
    return def;
}

tl_aabb tl_navmesh_bounds(const tl_navmesh *navmesh)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        bounds = tile != NULL ? tl_aabb_union(bounds, tile->bounds) : bounds;
    }
    return bounds;
}
