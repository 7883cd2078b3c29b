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

enum { STRIDE_COLUMNS = 2, MAX_SIDE_SAMPLES = 4096, FIRST_HITS = 64, SAMPLES_PER_SHARE = 64 };

typedef struct column_hits {
    tl_ray_hit *hits;
    uint32_t capacity;
} column_hits;

// How much farther than the agent's radius an erosion may have to reach, in steps of its distance, per column: a
// distance of one column is at most 1.5 / sqrt 2 steps in a diagonal, and sqrt 5 / 2 in between.
#define STEPS_PER_COLUMN 1.1180340f

// Columns of certain floor from a missing place to navmesh beside it, beyond what the outline may cut.
enum { COLUMNS_TO_NAVMESH = 3, MAX_MARGINS = 3 };

typedef struct floor_job {
    uint32_t stride; ///< columns between two samples
    uint32_t width, height;
    float slack; ///< metres up or down within which navmesh is looked for
    float cut;   ///< metres in the plane by which the outline may lie inside of the traced one
    /// For places without navmesh right there, within half of `cut`, and within all of it: of the last, the agent's.
    tl_audit_window windows[MAX_MARGINS];
    column_hits *buffers; ///< one a worker
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

static bool is_missing(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    int margin = 0;
    while (margin < MAX_MARGINS &&
           !has_navmesh(job, floors, point, floors->cut * (float)margin / (float)(MAX_MARGINS - 1))) {
        margin++;
    }
    const tl_audit_window *window = &floors->windows[margin - (margin > 0)];
    return margin > 0 && is_within_bounds(job, window->reach, point) && !is_near_volume(job, floors, point) &&
           tl_audit_is_certain(job, window, point);
}

// Whether so many columns of floor can lead to navmesh at all: in the middle of what is missing, none is so near.
static bool is_near_navmesh(const tl_audit_job *job, tl_vec3 point, uint32_t columns, float slack)
{
    const tl_nav_config *config = &job->scene.config;
    const float steps = (float)(columns + 1), side = config->cell_size * steps;
    const float height = slack + config->cell_height * (float)config->walkable_climb * steps;
    tl_nav_location location;
    return job->scene.navmesh != NULL && tl_navmesh_find_nearest(job->scene.navmesh, NULL, point,
                                                                 tl_vec3_make(side, height, side), &location) == TL_OK;
}

// The polygon to which columns of certain floor lead straight from a missing place, or TL_NAV_NO_REF.
static tl_nav_ref find_polygon_beside(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    static const float directions[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    const tl_nav_config *config = &job->scene.config;
    const tl_audit_window *agent = &floors->windows[MAX_MARGINS - 1];
    const uint32_t columns = (uint32_t)ceilf(floors->cut / config->cell_size) + COLUMNS_TO_NAVMESH;
    // Not of another storey.
    const tl_vec3 right_there = { 0.0f, tl_minf(floors->slack, 0.5f * config->agent_height), 0.0f };
    if (!is_near_navmesh(job, point, columns, right_there.y)) {
        return TL_NAV_NO_REF;
    }
    for (int d = 0; d < 4; d++) {
        tl_vec3 at = point;
        bool goes_on = true;
        for (uint32_t i = 0; i < columns && goes_on; i++) {
            tl_nav_location location;
            at.x += directions[d][0] * config->cell_size;
            at.z += directions[d][1] * config->cell_size;
            goes_on = tl_audit_follow_floor(job, &at) && is_within_bounds(job, agent->reach, at) &&
                      tl_audit_is_certain(job, agent, at);
            if (goes_on && tl_navmesh_find_nearest(job->scene.navmesh, NULL, at, right_there, &location) == TL_OK) {
                return location.polygon;
            }
        }
    }
    return TL_NAV_NO_REF;
}

static tl_result add_missing(const tl_audit_job *job, const floor_job *floors, tl_audit_share *share, tl_vec3 point,
                             uint32_t triangle, const int32_t column[2])
{
    tl_audit_record record;
    memset(&record, 0, sizeof record);
    record.kind = TL_NAV_FINDING_MISSING;
    record.polygon = find_polygon_beside(job, floors, point);
    record.triangle = triangle;
    record.point = record.contact = point;
    record.cube[0] = column[0];
    record.cube[1] =
        (int32_t)floor(((double)point.y - (double)job->scene.config.bounds.min.y) / (double)job->audit->sample_spacing);
    record.cube[2] = column[1];
    return tl_audit_records_add(&share->records, &record);
}

// A missing sample, and the columns up to the next samples that are missing too: so areas are counted by columns.
static tl_result add_missing_block(const tl_audit_job *job, const floor_job *floors, tl_audit_share *share,
                                   tl_vec3 point, uint32_t triangle, const int32_t sample[2])
{
    const int32_t stride = (int32_t)floors->stride;
    const float cell = job->scene.config.cell_size;
    for (int32_t i = 0; i < stride * stride; i++) {
        const int32_t column[2] = { sample[0] * stride + i % stride, sample[1] * stride + i / stride };
        tl_vec3 at = { point.x + cell * (float)(i % stride), point.y, point.z + cell * (float)(i / stride) };
        if (i == 0 || (tl_audit_follow_floor(job, &at) && is_missing(job, floors, at))) {
            TL_TRY(add_missing(job, floors, share, at, triangle, column));
        }
    }
    return TL_OK;
}

// All that a ray meets, in a buffer that grows.
static tl_result cast_all(const tl_audit_job *job, const tl_ray *ray, column_hits *buffer, uint32_t *count_out)
{
    const tl_allocator *allocator = job->host->allocator;
    if (buffer->hits != NULL && tl_soup_cast_ray_all(job->scene.soup, ray, TL_HITS_TOUCHED, NULL, buffer->hits,
                                                     buffer->capacity, count_out) != TL_INCOMPLETE) {
        return TL_OK;
    }
    const uint32_t capacity = buffer->hits == NULL ? FIRST_HITS : *count_out;
    tl_release_array(allocator, buffer->hits, buffer->capacity, sizeof *buffer->hits);
    buffer->hits = tl_allocate_array(allocator, capacity, sizeof *buffer->hits);
    buffer->capacity = capacity;
    return buffer->hits != NULL ? cast_all(job, ray, buffer, count_out) : TL_ERR_MEMORY;
}

static tl_result sample_column(tl_audit_job *job, const floor_job *floors, int32_t x, int32_t z, uint32_t worker,
                               tl_audit_share *share)
{
    const tl_nav_config *config = &job->scene.config;
    const tl_vec3 origin = config->lattice.origin;
    const float half = 0.5f * config->cell_size;
    const float top = config->bounds.max.y, reach = top - config->bounds.min.y;
    const tl_ray ray = { { tl_nav_lattice_to_world(origin.x, (int64_t)x * floors->stride, config->cell_size) + half,
                           top,
                           tl_nav_lattice_to_world(origin.z, (int64_t)z * floors->stride, config->cell_size) + half },
                         { 0.0f, -1.0f, 0.0f },
                         reach };
    uint32_t count = 0;
    column_hits *buffer = &floors->buffers[worker];
    TL_TRY(cast_all(job, &ray, buffer, &count));
    for (uint32_t i = 0; i < count; i++) {
        const tl_ray_hit *hit = &buffer->hits[i];
        if (hit->back || tl_audit_is_null_area(job, hit->triangle) || !(hit->normal.y > config->walkable_slope_cos) ||
            (i > 0 && hit->t == hit[-1].t)) {
            continue;
        }
        share->samples++;
        const tl_vec3 point = { ray.origin.x, top - hit->t, ray.origin.z };
        if (is_missing(job, floors, point)) {
            const int32_t place[2] = { x, z };
            TL_TRY(add_missing_block(job, floors, share, point, hit->triangle, place));
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
    const uint32_t parts = shares_per_row(floors), row = index / parts;
    const uint32_t begin = index % parts * SAMPLES_PER_SHARE;
    const uint32_t end = tl_min_u32(begin + SAMPLES_PER_SHARE, floors->width);
    for (uint32_t x = begin; x < end && share->result == TL_OK; x++) {
        share->steps++;
        share->result = sample_column(job, floors, (int32_t)x, (int32_t)row, worker, share);
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

static void free_floor_job(const tl_audit_job *job, floor_job *floors, uint32_t workers)
{
    const tl_allocator *allocator = job->host->allocator;
    for (int i = 0; i < MAX_MARGINS; i++) {
        tl_audit_window_free(&floors->windows[i], allocator);
    }
    for (uint32_t i = 0; floors->buffers != NULL && i < workers; i++) {
        tl_release_array(allocator, floors->buffers[i].hits, floors->buffers[i].capacity,
                         sizeof *floors->buffers[i].hits);
    }
    tl_release_array(allocator, floors->buffers, workers, sizeof *floors->buffers);
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
    floors.buffers = tl_allocate_array(job->host->allocator, workers, sizeof *floors.buffers);
    tl_result result = floors.buffers != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        memset(floors.buffers, 0, workers * sizeof *floors.buffers);
        result = create_windows(job, &floors);
    }
    if (result == TL_OK) {
        result =
            tl_audit_run_shares(job, "audit floors", floors.height * shares_per_row(&floors), sample_columns, &floors);
    }
    free_floor_job(job, &floors, workers);
    return result;
}
