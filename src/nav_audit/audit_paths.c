// SPDX-License-Identifier: MIT
//
// Random shortest paths: what agents do, around corners and along walls. Both ends are uniform by area, the goal on the
// start's island. Path number i depends on the seed and i alone, so that tasks may take them in any order.

#include "nav_audit/audit.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

// A point counts as on a polygon when it lies within this share of a cell from it in the plane: corners are rounded to
// floats, and points between them once more.
#define ON_POLYGON_CELLS 0.001f

typedef struct audit_searcher {
    tl_nav_query *query;
    tl_nav_corner *corners;
    tl_nav_ref *polygons;
    uint32_t corner_capacity, polygon_capacity;
} audit_searcher;

typedef struct path_job {
    audit_searcher *path_searchers; ///< one a worker
    const tl_allocator *allocator;
} path_job;

// ---- Random places -----------------------------------------------------------------------------------------

// The last polygon in [low, high) that begins at or before an area.
static uint32_t polygon_of_area(const tl_audit_polygon *polygons, uint32_t low, uint32_t high, double area)
{
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (polygons[middle].area_before <= area) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static double fan_area(const tl_vec3 *c, uint32_t k)
{
    return fabs(((double)c[k].x - (double)c[0].x) * ((double)c[k + 1].z - (double)c[0].z) -
                ((double)c[k].z - (double)c[0].z) * ((double)c[k + 1].x - (double)c[0].x));
}

// Uniform over the polygon: a triangle of its fan by area, then a point of it.
static tl_vec3 random_point_in(const tl_audit_polygon *at, uint64_t *state)
{
    uint32_t count;
    const tl_vec3 *c = tl_nav_tile_corners(at->tile, at->polygon, &count);
    double area = 0.0;
    for (uint32_t k = 1; k + 1 < count; k++) {
        area += fan_area(c, k);
    }
    double left = area * tl_random_unit(state);
    uint32_t k = 1;
    for (; k + 2 < count && left >= fan_area(c, k); k++) {
        left -= fan_area(c, k);
    }
    const float root = (float)sqrt(tl_random_unit(state)), share = (float)tl_random_unit(state);
    return tl_lerp(c[0], tl_lerp(c[k], c[k + 1], share), root);
}

static tl_nav_location location_in(const tl_audit_job *job, uint32_t index, uint64_t *state)
{
    tl_nav_location location = { job->polygons.polygons[index].ref,
                                 random_point_in(&job->polygons.polygons[index], state) };
    return location;
}

static void random_ends(const tl_audit_job *job, uint64_t number, tl_nav_location *start, tl_nav_location *goal)
{
    const tl_audit_polygon_list *list = &job->polygons;
    uint64_t state = tl_hash_mix(job->def->seed + number * 0x9e3779b97f4a7c15u);
    const uint32_t from = polygon_of_area(list->polygons, 0, list->count, list->area * tl_random_unit(&state));
    uint32_t low;
    const uint32_t high = tl_audit_island_around(list, from, &low);
    const double begin = tl_audit_area_before(list, low), area = tl_audit_area_before(list, high) - begin;
    const uint32_t to = polygon_of_area(list->polygons, low, high, begin + area * tl_random_unit(&state));
    *start = location_in(job, from, &state);
    *goal = location_in(job, to, &state);
}

// ---- Walking a path ----------------------------------------------------------------------------------------

// The polygon of the path, from number `at` on, on which a point lies; the nearest one when rounding left it beside
// all.
static uint32_t polygon_under(const tl_audit_scene *scene, const tl_nav_ref *polygons, uint32_t count, uint32_t at,
                              tl_vec3 point)
{
    const float close = ON_POLYGON_CELLS * scene->config.cell_size;
    float nearest = INFINITY;
    uint32_t best = at;
    for (uint32_t i = at; i < count && !tl_nav_is_offmesh(polygons[i]); i++) {
        tl_vec3 closest;
        bool inside = false;
        if (tl_navmesh_closest_point(scene->navmesh, polygons[i], point, &closest, &inside) != TL_OK) {
            continue;
        }
        const float dx = closest.x - point.x, dz = closest.z - point.z, distance = dx * dx + dz * dz;
        if (inside || distance <= close * close) {
            return i;
        }
        if (distance < nearest) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

// The place in the path behind its next off-mesh link.
static uint32_t behind_link(const tl_nav_ref *polygons, uint32_t count, uint32_t at)
{
    while (at + 1 < count && !tl_nav_is_offmesh(polygons[at])) {
        at++;
    }
    return at + 1 < count ? at + 1 : at;
}

static bool walk_to_corner(tl_audit_walker *walker, const audit_searcher *s, uint32_t polygon_count, tl_vec3 from,
                           tl_vec3 to, uint32_t *at)
{
    const tl_audit_scene *scene = walker->scene;
    const uint64_t count = tl_audit_line_steps(scene, from, to);
    for (uint64_t k = 0; k <= count; k++) {
        const tl_vec3 point = tl_lerp(from, to, (float)k / (float)count);
        *at = polygon_under(scene, s->polygons, polygon_count, *at, point);
        if (!tl_audit_walk_to(walker, s->polygons[*at], point.x, point.z)) {
            return false;
        }
    }
    return true;
}

// Off-mesh links leave the surface, so they are not walked: the walk begins anew behind each.
static bool walk_path(tl_audit_walker *walker, const audit_searcher *s, const tl_nav_shortest_path *path)
{
    uint32_t at = 0;
    tl_audit_walk_begin(walker);
    for (uint32_t i = 0; i + 1 < path->corner_count; i++) {
        if ((s->corners[i].flags & TL_NAV_CORNER_LINK) != 0) {
            at = behind_link(s->polygons, path->polygon_count, at);
            tl_audit_walk_begin(walker);
        } else if (!walk_to_corner(walker, s, path->polygon_count, s->corners[i].point, s->corners[i + 1].point, &at)) {
            return false;
        }
    }
    return true;
}

static tl_result find_path(const tl_audit_job *job, const path_job *paths, audit_searcher *s,
                           const tl_nav_location *start, const tl_nav_location *goal, tl_nav_shortest_path *path)
{
    tl_result result = TL_INCOMPLETE;
    for (int trial = 0; trial < 2 && result == TL_INCOMPLETE; trial++) {
        const tl_nav_path_request request = { .start = *start, .goal = *goal };
        const tl_nav_path_buffers buffers = { s->polygons, s->polygon_capacity, s->corners, s->corner_capacity };
        result = tl_nav_query_find_shortest_path(s->query, job->scene.navmesh, &request, &buffers, path);
        if (result != TL_INCOMPLETE) {
            break;
        }
        tl_release_array(paths->allocator, s->corners, s->corner_capacity, sizeof *s->corners);
        tl_release_array(paths->allocator, s->polygons, s->polygon_capacity, sizeof *s->polygons);
        s->corner_capacity = path->corner_count;
        s->polygon_capacity = path->polygon_count;
        s->corners = tl_allocate_array(paths->allocator, s->corner_capacity, sizeof *s->corners);
        s->polygons = tl_allocate_array(paths->allocator, s->polygon_capacity, sizeof *s->polygons);
        if (s->corners == NULL || s->polygons == NULL) {
            return TL_ERR_MEMORY;
        }
    }
    return result;
}

static void walk_path_between(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user)
{
    const path_job *paths = user;
    audit_searcher *s = &paths->path_searchers[worker];
    tl_audit_walker walker = tl_audit_walker_make(&job->scene, job->queries[worker], &share->records);
    tl_nav_location start, goal;
    tl_nav_shortest_path path;
    random_ends(job, index, &start, &goal);
    share->result = find_path(job, paths, s, &start, &goal, &path);
    if (share->result == TL_OK && path.status == TL_NAV_PATH_COMPLETE) {
        // Whether this path alone is too long: then it is not walked, and add_share refuses.
        const uint64_t most = job->def->max_steps - job->steps;
        const bool fits = path.length / (double)job->scene.stride <= (double)most;
        share->paths++;
        share->metres += path.length;
        share->result = !fits || walk_path(&walker, s, &path) ? TL_OK : TL_ERR_MEMORY;
        walker.steps += fits ? 0 : most + 1;
    }
    share->steps = walker.steps;
    share->sweeps = walker.sweeps;
    share->tolerated = walker.tolerated;
}

static tl_result create_path_searcher(const path_job *paths, audit_searcher *s)
{
    enum { FIRST_CORNERS = 256 };
    s->corner_capacity = s->polygon_capacity = FIRST_CORNERS;
    s->corners = tl_allocate_array(paths->allocator, FIRST_CORNERS, sizeof *s->corners);
    s->polygons = tl_allocate_array(paths->allocator, FIRST_CORNERS, sizeof *s->polygons);
    return s->corners != NULL && s->polygons != NULL ? TL_OK : TL_ERR_MEMORY;
}

static void free_path_searcher(const path_job *paths, audit_searcher *s)
{
    tl_release_array(paths->allocator, s->corners, s->corner_capacity, sizeof *s->corners);
    tl_release_array(paths->allocator, s->polygons, s->polygon_capacity, sizeof *s->polygons);
}

tl_result tl_audit_paths(tl_audit_job *job)
{
    if (job->polygons.count == 0 || job->def->path_count == 0) {
        return TL_OK;
    }
    const uint32_t workers = tl_worker_count(job->host);
    path_job paths = { NULL, job->host->allocator };
    paths.path_searchers = tl_allocate_array(paths.allocator, workers, sizeof *paths.path_searchers);
    if (paths.path_searchers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(paths.path_searchers, 0, workers * sizeof *paths.path_searchers);
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < workers && result == TL_OK; i++) {
        paths.path_searchers[i].query = job->queries[i];
        result = create_path_searcher(&paths, &paths.path_searchers[i]);
    }
    if (result == TL_OK) {
        result = tl_audit_run_shares(job, "audit paths", job->def->path_count, walk_path_between, &paths);
    }
    for (uint32_t i = 0; i < workers; i++) {
        free_path_searcher(&paths, &paths.path_searchers[i]);
    }
    tl_release_array(paths.allocator, paths.path_searchers, workers, sizeof *paths.path_searchers);
    return result;
}
