// SPDX-License-Identifier: MIT
//
// Missing floor, found without the navmesh's voxels: rays straight down through the middles of columns hit every floor.
// One that must outlive filters and erosion (certain_floor.c), and that the simplified outline cannot have cut off,
// must have navmesh.
//
// How far the outline may cut: it lies within max_simplification_error of the traced one. So a place farther than that
// from any navmesh is missing; a nearer one only when all columns within the rest of that distance outlive erosion too,
// which they do when the place outlives an erosion by a larger radius.
//
// An island smaller than region_min_size is left out on purpose. What is missing beside navmesh is no island: from
// there, column by column of certain floor, one comes to navmesh.

#include "nav_audit/certain_floor.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

#include <math.h>
#include <string.h>

enum { STRIDE_COLUMNS = 2, MAX_SIDE_SAMPLES = 4096, SAMPLES_PER_SHARE = 64 };

// How much farther than the agent's radius an erosion may have to reach, in steps of its distance, per column: a
// distance of one column is at most 1.5 / sqrt 2 steps in a diagonal, and sqrt 5 / 2 in between.
#define STEPS_PER_COLUMN 1.1180340f

// Columns of certain floor from a missing place to navmesh beside it, beyond what the outline may cut.
enum { COLUMNS_TO_NAVMESH = 3, MAX_MARGINS = 3 };

// What a worker keeps.
typedef struct floor_worker {
    tl_audit_columns columns;
    tl_audit_hits sample;
} floor_worker;

typedef struct floor_job {
    uint32_t stride; ///< columns between two samples
    uint32_t width, height;
    float slack; ///< metres up or down within which navmesh is looked for
    float cut;   ///< metres in the plane by which the outline may lie inside of the traced one
    /// For places without navmesh right there, within half of `cut`, and within all of it: of the last, the agent's.
    tl_audit_window windows[MAX_MARGINS];
    floor_worker *workers;
} floor_job;

// Whether polygons lie within a distance of a point along x and z: of the navmesh, or of what was pruned from it.
static bool has_navmesh(const tl_audit_job *job, const floor_job *floors, tl_vec3 point, float distance)
{
    const tl_navmesh *meshes[] = { job->scene.navmesh, job->def->pruned };
    const tl_vec3 extents = { distance, floors->slack, distance };
    bool found = false;
    for (int i = 0; i < 2 && !found; i++) {
        tl_nav_location location;
        found = meshes[i] != NULL && tl_navmesh_find_nearest(meshes[i], NULL, point, extents, &location) == TL_OK;
    }
    return found;
}

static tl_aabb volume_box(const tl_nav_volume *volume)
{
    tl_aabb box = volume->box;
    if (volume->kind == TL_NAV_VOLUME_CYLINDER) {
        const tl_vec3 reach = { volume->radius, 0.0f, volume->radius };
        box.min = tl_sub(volume->base, reach);
        box.max = tl_add(volume->base, reach);
        box.max.y += volume->height;
    }
    for (uint32_t i = 0; volume->kind == TL_NAV_VOLUME_POLYGON && i < volume->point_count; i++) {
        const tl_vec3 p = volume->points[i];
        box.min.x = i == 0 ? p.x : tl_minf(box.min.x, p.x);
        box.min.z = i == 0 ? p.z : tl_minf(box.min.z, p.z);
        box.max.x = i == 0 ? p.x : tl_maxf(box.max.x, p.x);
        box.max.z = i == 0 ? p.z : tl_maxf(box.max.z, p.z);
    }
    return box;
}

// Whether a volume of area 0 is near: then it may be the reason.
static bool is_near_volume(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    const float room = floors->windows[0].reach;
    const tl_vec3 reach = { room, floors->slack, room };
    const tl_aabb around = { tl_sub(point, reach), tl_add(point, reach) };
    for (uint32_t i = 0; i < job->def->volume_count; i++) {
        const tl_nav_volume *volume = &job->def->volumes[i];
        if (volume->area == TL_NAV_NULL_AREA && tl_aabb_overlaps(volume_box(volume), around)) {
            return true;
        }
    }
    return false;
}

// The rim of what was baked counts as a ledge.
static bool is_within_bounds(const tl_audit_job *job, float reach, tl_vec3 point)
{
    const tl_aabb box = job->scene.config.bounds;
    return point.x - reach >= box.min.x && point.x + reach <= box.max.x && point.z - reach >= box.min.z &&
           point.z + reach <= box.max.z && point.y >= box.min.y && point.y <= box.max.y;
}

static tl_result is_missing(const floor_job *floors, tl_audit_columns *columns, const int32_t column[2], float y,
                            bool *is_missing_out)
{
    const tl_audit_job *job = columns->job;
    const tl_vec3 point = tl_audit_column_point(job, column, y);
    int margin = 0;
    while (margin < MAX_MARGINS &&
           !has_navmesh(job, floors, point, floors->cut * (float)margin / (float)(MAX_MARGINS - 1))) {
        margin++;
    }
    const tl_audit_window *window = &floors->windows[margin - (margin > 0)];
    *is_missing_out = false;
    return margin > 0 && is_within_bounds(job, window->reach, point) && !is_near_volume(job, floors, point)
               ? tl_audit_is_certain(columns, window, column, y, is_missing_out)
               : TL_OK;
}

// Whether so many columns of floor can lead to navmesh at all: in the middle of what is missing, none is so near.
static bool is_near_navmesh(const tl_audit_job *job, tl_vec3 point, uint32_t count, float slack)
{
    const tl_nav_config *config = &job->scene.config;
    const float steps = (float)(count + 1), side = config->cell_size * steps;
    const float height = slack + config->cell_height * (float)config->walkable_climb * steps;
    tl_nav_location location;
    return job->scene.navmesh != NULL && tl_navmesh_find_nearest(job->scene.navmesh, NULL, point,
                                                                 tl_vec3_make(side, height, side), &location) == TL_OK;
}

// The polygon to which so many columns of certain floor lead straight from a missing place, or TL_NAV_NO_REF.
static tl_result follow_columns(const floor_job *floors, tl_audit_columns *columns, const int32_t from[2], float y,
                                const int32_t step[2], uint32_t count, tl_nav_ref *polygon_out)
{
    const tl_audit_job *job = columns->job;
    const tl_audit_window *agent = &floors->windows[MAX_MARGINS - 1];
    // Not of another storey.
    const float slack = tl_minf(floors->slack, 0.5f * job->scene.config.agent_height);
    *polygon_out = TL_NAV_NO_REF;
    bool goes_on = true;
    for (int32_t i = 1; i <= (int32_t)count && *polygon_out == TL_NAV_NO_REF; i++) {
        const int32_t column[2] = { from[0] + i * step[0], from[1] + i * step[1] };
        TL_TRY(tl_audit_follow_floor(columns, column, &y, &goes_on));
        const tl_vec3 at = tl_audit_column_point(job, column, y);
        if (!goes_on || !is_within_bounds(job, agent->reach, at)) {
            return TL_OK;
        }
        TL_TRY(tl_audit_is_certain(columns, agent, column, y, &goes_on));
        if (!goes_on) {
            return TL_OK;
        }
        tl_nav_location location;
        if (tl_navmesh_find_nearest(job->scene.navmesh, NULL, at, tl_vec3_make(0, slack, 0), &location) == TL_OK) {
            *polygon_out = location.polygon;
        }
    }
    return TL_OK;
}

static tl_result find_polygon_beside(const floor_job *floors, tl_audit_columns *columns, const int32_t column[2],
                                     float y, tl_nav_ref *polygon_out)
{
    static const int32_t directions[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    const tl_audit_job *job = columns->job;
    const uint32_t count = (uint32_t)ceilf(floors->cut / job->scene.config.cell_size) + COLUMNS_TO_NAVMESH;
    *polygon_out = TL_NAV_NO_REF;
    if (is_near_navmesh(job, tl_audit_column_point(job, column, y), count, floors->slack)) {
        for (int d = 0; d < 4 && *polygon_out == TL_NAV_NO_REF; d++) {
            TL_TRY(follow_columns(floors, columns, column, y, directions[d], count, polygon_out));
        }
    }
    return TL_OK;
}

static tl_result add_missing(const floor_job *floors, tl_audit_columns *columns, tl_audit_share *share,
                             const int32_t column[2], float y, uint32_t triangle)
{
    const tl_audit_job *job = columns->job;
    tl_audit_record record;
    memset(&record, 0, sizeof record);
    record.kind = TL_NAV_FINDING_MISSING;
    record.triangle = triangle;
    record.point = record.contact = tl_audit_column_point(job, column, y);
    record.cube[0] = column[0];
    record.cube[1] =
        (int32_t)floor(((double)y - (double)job->scene.config.bounds.min.y) / (double)job->audit->sample_spacing);
    record.cube[2] = column[1];
    TL_TRY(find_polygon_beside(floors, columns, column, y, &record.polygon));
    return tl_audit_records_add(&share->records, &record);
}

// A missing sample, and the columns up to the next samples that are missing too: so areas are counted by columns.
static tl_result add_missing_block(const floor_job *floors, tl_audit_columns *columns, tl_audit_share *share,
                                   const int32_t first[2], float y, uint32_t triangle)
{
    const int32_t stride = (int32_t)floors->stride;
    TL_TRY(add_missing(floors, columns, share, first, y, triangle));
    for (int32_t i = 1; i < stride * stride; i++) {
        const int32_t column[2] = { first[0] + i % stride, first[1] + i / stride };
        float there = y;
        bool found, missing = false;
        TL_TRY(tl_audit_follow_floor(columns, column, &there, &found));
        if (found) {
            TL_TRY(is_missing(floors, columns, column, there, &missing));
        }
        if (missing) {
            TL_TRY(add_missing(floors, columns, share, column, there, triangle));
        }
    }
    return TL_OK;
}

static tl_result sample_column(const floor_job *floors, floor_worker *worker, const int32_t column[2],
                               tl_audit_share *share)
{
    tl_audit_columns *columns = &worker->columns;
    const tl_audit_job *job = columns->job;
    const float top = job->scene.config.bounds.max.y;
    TL_TRY(tl_audit_hit_column(job, column, &worker->sample));
    for (uint32_t i = 0; i < worker->sample.count; i++) {
        const tl_ray_hit *hit = &worker->sample.hits[i];
        if (!tl_audit_is_floor(job, hit) || (i > 0 && hit->t == hit[-1].t)) {
            continue;
        }
        share->samples++;
        bool missing;
        TL_TRY(is_missing(floors, columns, column, top - hit->t, &missing));
        if (missing) {
            TL_TRY(add_missing_block(floors, columns, share, column, top - hit->t, hit->triangle));
        }
    }
    return TL_OK;
}

static uint32_t shares_per_row(const floor_job *floors)
{
    return (floors->width - 1) / SAMPLES_PER_SHARE + 1;
}

// Part of a row.
static void sample_columns(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user)
{
    const floor_job *floors = user;
    (void)job;
    const uint32_t parts = shares_per_row(floors), row = index / parts;
    const uint32_t begin = index % parts * SAMPLES_PER_SHARE;
    const uint32_t end = tl_min_u32(begin + SAMPLES_PER_SHARE, floors->width);
    for (uint32_t x = begin; x < end && share->result == TL_OK; x++) {
        const int32_t column[2] = { (int32_t)(x * floors->stride), (int32_t)(row * floors->stride) };
        share->steps++;
        share->result = sample_column(floors, &floors->workers[worker], column, share);
    }
}

static tl_result create_windows(tl_audit_job *job, floor_job *floors)
{
    const tl_nav_config *config = &job->scene.config;
    for (int i = 0; i < MAX_MARGINS; i++) {
        const float rest = config->max_simplification_error * (float)(MAX_MARGINS - 1 - i) / (float)(MAX_MARGINS - 1);
        const uint32_t more = (uint32_t)ceilf(rest * STEPS_PER_COLUMN);
        TL_TRY(tl_audit_window_create(config->walkable_radius + more, config->cell_size, job->host->allocator,
                                      &floors->windows[i]));
    }
    return TL_OK;
}

static tl_result create_workers(const tl_audit_job *job, floor_job *floors, uint32_t workers)
{
    floors->workers = tl_allocate_array(job->host->allocator, workers, sizeof *floors->workers);
    if (floors->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(floors->workers, 0, workers * sizeof *floors->workers);
    for (uint32_t i = 0; i < workers; i++) {
        TL_TRY(tl_audit_columns_create(job, &floors->workers[i].columns));
    }
    return TL_OK;
}

static void free_floor_job(const tl_audit_job *job, floor_job *floors, uint32_t workers)
{
    const tl_allocator *allocator = job->host->allocator;
    for (int i = 0; i < MAX_MARGINS; i++) {
        tl_audit_window_free(&floors->windows[i], allocator);
    }
    for (uint32_t i = 0; floors->workers != NULL && i < workers; i++) {
        tl_audit_columns_free(&floors->workers[i].columns);
        tl_audit_hits_free(job, &floors->workers[i].sample);
    }
    tl_release_array(allocator, floors->workers, workers, sizeof *floors->workers);
}

tl_result tl_audit_floors(tl_audit_job *job)
{
    const tl_nav_config *config = &job->scene.config;
    const uint32_t side = config->width > config->height ? config->width : config->height;
    const uint32_t workers = tl_worker_count(job->host);
    floor_job floors;
    memset(&floors, 0, sizeof floors);
    floors.stride = side > STRIDE_COLUMNS * MAX_SIDE_SAMPLES ? (side - 1) / MAX_SIDE_SAMPLES + 1 : STRIDE_COLUMNS;
    floors.width = (config->width - 1) / floors.stride + 1;
    floors.height = (config->height - 1) / floors.stride + 1;
    floors.cut = config->cell_size * config->max_simplification_error;
    floors.slack = job->scene.probe.step + job->scene.probe.surface;
    job->audit->sample_spacing = config->cell_size * (float)floors.stride;
    tl_result result = create_workers(job, &floors, workers);
    if (result == TL_OK) {
        result = create_windows(job, &floors);
    }
    if (result == TL_OK) {
        result =
            tl_audit_run_shares(job, "audit floors", floors.height * shares_per_row(&floors), sample_columns, &floors);
    }
    free_floor_job(job, &floors, workers);
    return result;
}
