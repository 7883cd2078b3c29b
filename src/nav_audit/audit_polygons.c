// SPDX-License-Identifier: MIT
//
// Systematic coverage: every polygon's outline, where a path may turn around any corner, and from its middle through
// each portal to the neighbour's.

#include "nav_audit/audit.h"

#include "base/arena.h"

enum { POLYGONS_PER_SHARE = 64, FEW_LINKS = 64 };

static tl_vec3 corner_mean(const tl_nav_tile *tile, uint32_t polygon)
{
    uint32_t count;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    tl_vec3 sum = { 0.0f, 0.0f, 0.0f };
    for (uint32_t i = 0; i < count; i++) {
        sum = tl_add(sum, tl_sub(corners[i], corners[0]));
    }
    return tl_mul_add(corners[0], sum, 1.0f / (float)count);
}

static bool walk_outline(tl_audit_walker *walker, const tl_audit_polygon *at)
{
    uint32_t count;
    const tl_vec3 *corners = tl_nav_tile_corners(at->tile, at->polygon, &count);
    tl_audit_walk_begin(walker);
    for (uint32_t i = 0; i < count; i++) {
        if (!tl_audit_walk_line(walker, at->ref, corners[i], corners[(i + 1) % count])) {
            return false;
        }
    }
    return tl_audit_walk_line(walker, at->ref, corners[0], corner_mean(at->tile, at->polygon));
}

// From the polygon's middle to that of the neighbour, once for the two of them.
static bool cross_to_neighbour(tl_audit_walker *walker, const tl_audit_polygon *at, const tl_nav_link *link)
{
    const tl_nav_tile *tile;
    uint32_t polygon;
    if (tl_navmesh_resolve(walker->scene->navmesh, link->to, &tile, &polygon) != TL_OK) {
        return true;
    }
    const tl_vec3 door = tl_lerp(link->left, link->right, 0.5f);
    tl_audit_walk_begin(walker);
    return tl_audit_walk_line(walker, at->ref, corner_mean(at->tile, at->polygon), door) &&
           tl_audit_walk_line(walker, link->to, door, corner_mean(tile, polygon));
}

static bool cross_portals_of(tl_audit_walker *walker, const tl_audit_polygon *at, const tl_nav_link *links,
                             uint32_t count, tl_audit_share *share)
{
    for (uint32_t i = 0; i < count; i++) {
        if (at->ref < links[i].to) {
            share->portals++;
            if (!cross_to_neighbour(walker, at, &links[i])) {
                return false;
            }
        }
    }
    return true;
}

static bool cross_portals(tl_audit_walker *walker, const tl_audit_polygon *at, tl_audit_share *share)
{
    const tl_navmesh *navmesh = walker->scene->navmesh;
    const tl_allocator *allocator = walker->records->allocator;
    tl_nav_link few[FEW_LINKS];
    uint32_t count = 0;
    if (tl_navmesh_links(navmesh, at->ref, few, FEW_LINKS, &count) != TL_INCOMPLETE) {
        return cross_portals_of(walker, at, few, count, share);
    }
    const uint32_t room = count; // along the side of a tile there may be any number
    tl_nav_link *many = tl_allocate_array(allocator, room, sizeof *many);
    bool done = many != NULL;
    if (done) {
        (void)tl_navmesh_links(navmesh, at->ref, many, room, &count);
        done = cross_portals_of(walker, at, many, count, share);
    }
    tl_release_array(allocator, many, room, sizeof *many);
    return done;
}

static void walk_polygons(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user)
{
    (void)user;
    tl_audit_walker walker = tl_audit_walker_make(&job->scene, job->queries[worker], &share->records);
    const uint32_t begin = index * POLYGONS_PER_SHARE, left = job->polygons.count - begin;
    const uint32_t end = begin + (left < POLYGONS_PER_SHARE ? left : POLYGONS_PER_SHARE);
    for (uint32_t i = begin; i < end && share->result == TL_OK; i++) {
        const bool done = walk_outline(&walker, &job->polygons.polygons[i]) &&
                          cross_portals(&walker, &job->polygons.polygons[i], share);
        share->result = done ? TL_OK : TL_ERR_MEMORY;
    }
    share->sweeps = walker.sweeps;
    share->tolerated = walker.tolerated;
}

tl_result tl_audit_polygons(tl_audit_job *job)
{
    job->audit->polygon_count = job->polygons.count;
    const uint32_t shares = (job->polygons.count + POLYGONS_PER_SHARE - 1) / POLYGONS_PER_SHARE;
    return tl_audit_run_shares(job, "audit polygons", shares, walk_polygons, NULL);
}
