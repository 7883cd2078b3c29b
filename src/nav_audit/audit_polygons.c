// SPDX-License-Identifier: MIT
//
// Systematic coverage: every polygon's outline, where a path may turn around any corner, and from its middle through
// each portal to the neighbour's.

#include "base/assert.h"
#include "nav_audit/audit.h"

#include "base/arena.h"
#include "base/host.h"
#include "base/min_max.h"

#include <string.h>

enum { FEW_LINKS = 64, POLYGONS_PER_CALL = 4096 };

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

// The lines of a polygon are one row of steps. What is walked of it at a time is [begin, end), so that a share is a few
// milliseconds long on the largest polygon too.
typedef struct step_range {
    uint64_t begin, end;
    uint64_t at; // where the next line begins
} step_range;

static bool walk_in_range(tl_audit_walker *walker, step_range *range, tl_nav_ref polygon, tl_vec3 from, tl_vec3 to)
{
    const uint64_t count = tl_audit_line_steps(walker->scene, from, to), at = range->at;
    range->at += count;
    if (range->at <= range->begin || at >= range->end) {
        return true;
    }
    return tl_audit_walk_line(walker, polygon, from, to, tl_max_u64(at, range->begin) - at,
                              tl_min_u64(range->at, range->end) - at);
}

static bool walk_outline(tl_audit_walker *walker, step_range *range, const tl_audit_polygon *at)
{
    uint32_t count;
    const tl_vec3 *corners = tl_nav_tile_corners(at->tile, at->polygon, &count);
    tl_audit_walk_begin(walker);
    for (uint32_t i = 0; i < count; i++) {
        if (!walk_in_range(walker, range, at->ref, corners[i], corners[(i + 1) % count])) {
            return false;
        }
    }
    return walk_in_range(walker, range, at->ref, corners[0], corner_mean(at->tile, at->polygon));
}

// From the polygon's middle to that of the neighbour, once for the two of them.
static bool cross_to_neighbour(tl_audit_walker *walker, step_range *range, const tl_audit_polygon *at,
                               const tl_nav_link *link)
{
    const tl_nav_tile *tile;
    uint32_t polygon;
    if (tl_navmesh_resolve(walker->scene->navmesh, link->to, &tile, &polygon) != TL_OK) {
        return true;
    }
    const tl_vec3 door = tl_lerp(link->left, link->right, 0.5f);
    tl_audit_walk_begin(walker);
    return walk_in_range(walker, range, at->ref, corner_mean(at->tile, at->polygon), door) &&
           walk_in_range(walker, range, link->to, door, corner_mean(tile, polygon));
}

static bool cross_portals_of(tl_audit_walker *walker, step_range *range, const tl_audit_polygon *at,
                             const tl_nav_link *links, uint32_t count, tl_audit_share *share)
{
    for (uint32_t i = 0; i < count; i++) {
        if (at->ref < links[i].to) {
            share->portals += range->at >= range->begin && range->at < range->end;
            if (!cross_to_neighbour(walker, range, at, &links[i])) {
                return false;
            }
        }
    }
    return true;
}

static bool cross_portals(tl_audit_walker *walker, step_range *range, const tl_audit_polygon *at, tl_audit_share *share)
{
    const tl_navmesh *navmesh = walker->scene->navmesh;
    const tl_allocator *allocator = walker->records->allocator;
    tl_nav_link few[FEW_LINKS];
    uint32_t count = 0;
    if (tl_navmesh_links(navmesh, at->ref, few, FEW_LINKS, &count) != TL_INCOMPLETE) {
        return cross_portals_of(walker, range, at, few, count, share);
    }
    const uint32_t room = count; // along the side of a tile there may be any number
    tl_nav_link *many = tl_allocate_array(allocator, room, sizeof *many);
    bool done = many != NULL;
    if (done) {
        (void)tl_navmesh_links(navmesh, at->ref, many, room, &count);
        done = cross_portals_of(walker, range, at, many, count, share);
    }
    tl_release_array(allocator, many, room, sizeof *many);
    return done;
}

// The steps of a polygon's lines, by walking none of them.
static uint64_t count_steps(tl_audit_walker *walker, const tl_audit_polygon *at)
{
    step_range nothing = { UINT64_MAX, UINT64_MAX, 0 };
    tl_audit_share share;
    memset(&share, 0, sizeof share);
    return walk_outline(walker, &nothing, at) && cross_portals(walker, &nothing, at, &share) ? nothing.at : UINT64_MAX;
}

// Where each polygon's steps begin in the row of all of them.
static tl_result lay_out_steps(tl_audit_job *job, uint64_t *total_out)
{
    tl_audit_walker walker = tl_audit_walker_make(&job->scene, job->queries[0], &job->records);
    uint64_t total = 0;
    for (uint32_t i = 0; i < job->polygons.count; i++) {
        if (i % POLYGONS_PER_CALL == 0) {
            TL_TRY(tl_progress_update(job->host, "audit polygons", 0, job->polygons.count));
        }
        const uint64_t steps = count_steps(&walker, &job->polygons.polygons[i]);
        if (steps == UINT64_MAX) {
            return TL_ERR_MEMORY;
        }
        job->polygons.polygons[i].steps_before = total;
        total += steps;
        TL_TRY(tl_audit_expect_steps(job, total));
    }
    *total_out = total;
    return TL_OK;
}

// The last polygon whose steps begin at or before `step`.
static uint32_t polygon_of_step(const tl_audit_polygon_list *list, uint64_t step)
{
    uint32_t low = 0, high = list->count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (list->polygons[middle].steps_before <= step) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// A polygon whose steps fit a share is walked whole, by the share in which they begin.
static void walk_polygons(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user)
{
    const uint64_t total = *(const uint64_t *)user, begin = (uint64_t)index * TL_AUDIT_SHARE_STEPS;
    const uint64_t end = tl_min_u64(begin + TL_AUDIT_SHARE_STEPS, total);
    const tl_audit_polygon_list *list = &job->polygons;
    tl_audit_walker walker = tl_audit_walker_make(&job->scene, job->queries[worker], &share->records);
    for (uint32_t i = polygon_of_step(list, begin); i < list->count && share->result == TL_OK; i++) {
        const tl_audit_polygon *at = &list->polygons[i];
        const uint64_t next = i + 1 < list->count ? at[1].steps_before : total, first = at->steps_before;
        if (first >= end) {
            break;
        }
        step_range range = { 0, UINT64_MAX, 0 };
        if (next - first > TL_AUDIT_SHARE_STEPS) {
            range.begin = begin > first ? begin - first : 0;
            range.end = end - first;
        } else if (first < begin) {
            continue;
        }
        const bool done = walk_outline(&walker, &range, at) && cross_portals(&walker, &range, at, share);
        share->result = done ? TL_OK : TL_ERR_MEMORY;
    }
    share->steps = walker.steps;
    share->sweeps = walker.sweeps;
    share->tolerated = walker.tolerated;
}

tl_result tl_audit_polygons(tl_audit_job *job)
{
    uint64_t total;
    job->audit->polygon_count = job->polygons.count;
    TL_TRY(lay_out_steps(job, &total));
    const uint64_t shares = (total + TL_AUDIT_SHARE_STEPS - 1) / TL_AUDIT_SHARE_STEPS;
    return shares < UINT32_MAX / 2 ? tl_audit_run_shares(job, "audit polygons", (uint32_t)shares, walk_polygons, &total)
                                   : TL_ERR_LIMIT;
}
