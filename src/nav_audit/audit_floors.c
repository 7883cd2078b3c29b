// SPDX-License-Identifier: MIT
//
// Missing floor, found without the navmesh's voxels: rays straight down through the soup hit every floor; one that
// faces up, is walkable by its slope, and has more free space all around than the agent needs must have navmesh.
//
// "More than the agent needs" is the most that erosion and the outline may remove: the radius in columns; one for the
// column that an obstacle only touches; half a diagonal, from a column's middle to the point in question; and what the
// outline may move beyond the one cell within which navmesh counts as present. Steps may rise by half a climb a column,
// less a voxel, because the ledge filter compares a column with both of its neighbours when it judges a stair.

#include "nav_audit/audit.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <math.h>
#include <string.h>

enum { STRIDE_COLUMNS = 2, MAX_SIDE_SAMPLES = 4096, DIRECTIONS = 8, FIRST_HITS = 64 };

typedef struct column_hits {
    tl_ray_hit *hits;
    uint32_t capacity;
} column_hits;

typedef struct floor_job {
    uint32_t stride; ///< columns between two samples
    uint32_t width, height;
    float room;           ///< metres around a point that must be free
    float slack;          ///< metres up or down within which navmesh is looked for
    column_hits *buffers; ///< one a worker
} floor_job;

// On the unit circle: eight directions, exact where they can be.
static const float DIRECTION_X[DIRECTIONS] = { 1.0f,  0.70710678f,  0.0f, -0.70710678f,
                                               -1.0f, -0.70710678f, 0.0f, 0.70710678f };
static const float DIRECTION_Z[DIRECTIONS] = { 0.0f, 0.70710678f,  1.0f,  0.70710678f,
                                               0.0f, -0.70710678f, -1.0f, -0.70710678f };

// Whether polygons lie near a point: of the navmesh, or of what was pruned from it.
static bool has_navmesh(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    const tl_navmesh *meshes[] = { job->scene.navmesh, job->def->pruned };
    const float cell = job->scene.config.cell_size;
    const tl_vec3 extents = { cell, floors->slack, cell };
    bool found = false;
    for (int i = 0; i < 2 && !found; i++) {
        tl_nav_location location;
        found = meshes[i] != NULL && tl_navmesh_find_nearest(meshes[i], NULL, point, extents, &location) == TL_OK;
    }
    return found;
}

// Whether the floor of a triangle was given area 0.
static bool is_null_area(const tl_audit_job *job, uint32_t triangle)
{
    return job->def->areas != NULL && job->def->areas[triangle] == TL_NAV_NULL_AREA;
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
    const tl_vec3 reach = { floors->room, floors->slack, floors->room };
    const tl_aabb around = { tl_sub(point, reach), tl_add(point, reach) };
    for (uint32_t i = 0; i < job->def->volume_count; i++) {
        const tl_nav_volume *volume = &job->def->volumes[i];
        if (volume->area == TL_NAV_NULL_AREA && tl_aabb_overlaps(volume_box(volume), around)) {
            return true;
        }
    }
    return false;
}

// Whether the space around a point is free: a capsule from a step above it to above the agent's head.
static bool has_room(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    const tl_nav_config *config = &job->scene.config;
    const float voxel = config->cell_height;
    const float low = voxel * (float)config->walkable_climb + floors->room;
    const float high = voxel * (float)(config->walkable_height + 2) - floors->room;
    const tl_convex capsule =
        tl_convex_capsule(tl_vec3_make(point.x, point.y + low, point.z),
                          tl_vec3_make(point.x, point.y + tl_maxf(low, high), point.z), floors->room);
    bool blocked = true;
    (void)tl_soup_overlaps(job->scene.soup, &capsule, tl_transform_identity(), NULL, &blocked);
    return !blocked;
}

// Whether walkable floor continues in a direction for that distance, with free height for the agent above it.
static bool floor_goes_on(const tl_audit_job *job, const floor_job *floors, tl_vec3 point, int direction)
{
    const tl_nav_config *config = &job->scene.config;
    const float voxel = config->cell_height, cell = config->cell_size;
    const float climb = 0.5f * (voxel * (float)config->walkable_climb - voxel);
    const float headroom = voxel * (float)(config->walkable_height + 2);
    const uint32_t strides = (uint32_t)ceilf(floors->room / cell);
    float y = point.y;
    for (uint32_t i = 1; i <= strides; i++) {
        const float away = floors->room * (float)i / (float)strides;
        const tl_vec3 above = { point.x + DIRECTION_X[direction] * away, y + climb,
                                point.z + DIRECTION_Z[direction] * away };
        const tl_ray down = { above, { 0.0f, -1.0f, 0.0f }, 2.0f * climb };
        tl_ray_hit hit;
        if (!(climb > 0.0f) || !tl_soup_cast_ray(job->scene.soup, &down, NULL, &hit) || hit.back ||
            is_null_area(job, hit.triangle) || !(hit.normal.y > config->walkable_slope_cos)) {
            return false;
        }
        y = above.y - hit.t;
        const tl_ray up = { tl_vec3_make(above.x, y + voxel, above.z), { 0.0f, 1.0f, 0.0f }, headroom - voxel };
        if (tl_soup_occluded(job->scene.soup, &up, NULL)) {
            return false;
        }
    }
    return true;
}

// The rim of what was baked counts as a ledge.
static bool is_within_bounds(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    const tl_aabb box = job->scene.config.bounds;
    const float room = floors->room;
    return point.x - room >= box.min.x && point.x + room <= box.max.x && point.z - room >= box.min.z &&
           point.z + room <= box.max.z && point.y >= box.min.y && point.y <= box.max.y;
}

static bool is_missing(const tl_audit_job *job, const floor_job *floors, tl_vec3 point)
{
    if (!is_within_bounds(job, floors, point) || is_near_volume(job, floors, point) ||
        has_navmesh(job, floors, point) || !has_room(job, floors, point)) {
        return false;
    }
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        if (!floor_goes_on(job, floors, point, direction)) {
            return false;
        }
    }
    return true;
}

static tl_result add_missing(const tl_audit_job *job, tl_audit_share *share, tl_vec3 point, uint32_t triangle,
                             int32_t x, int32_t z)
{
    tl_audit_record record;
    memset(&record, 0, sizeof record);
    record.kind = TL_NAV_FINDING_MISSING;
    record.triangle = triangle;
    record.point = record.contact = point;
    record.cube[0] = x;
    record.cube[1] =
        (int32_t)floor(((double)point.y - (double)job->scene.config.bounds.min.y) / (double)job->audit->sample_spacing);
    record.cube[2] = z;
    return tl_audit_records_add(&share->records, &record);
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
        if (hit->back || is_null_area(job, hit->triangle) || !(hit->normal.y > config->walkable_slope_cos) ||
            (i > 0 && hit->t == hit[-1].t)) {
            continue;
        }
        share->samples++;
        const tl_vec3 point = { ray.origin.x, top - hit->t, ray.origin.z };
        if (is_missing(job, floors, point)) {
            TL_TRY(add_missing(job, share, point, hit->triangle, x, z));
        }
    }
    return TL_OK;
}

static void sample_row(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user)
{
    const floor_job *floors = user;
    for (uint32_t x = 0; x < floors->width && share->result == TL_OK; x++) {
        share->result = sample_column(job, floors, (int32_t)x, (int32_t)index, worker, share);
    }
}

tl_result tl_audit_floors(tl_audit_job *job)
{
    const tl_nav_config *config = &job->scene.config;
    const uint32_t side = config->width > config->height ? config->width : config->height;
    const float across = config->max_simplification_error > 1.0f ? config->max_simplification_error - 1.0f : 0.0f;
    const uint32_t workers = tl_worker_count(job->host);
    floor_job floors;
    memset(&floors, 0, sizeof floors);
    floors.stride = side > STRIDE_COLUMNS * MAX_SIDE_SAMPLES ? (side - 1) / MAX_SIDE_SAMPLES + 1 : STRIDE_COLUMNS;
    floors.width = (config->width - 1) / floors.stride + 1;
    floors.height = (config->height - 1) / floors.stride + 1;
    floors.room = config->cell_size * ((float)config->walkable_radius + 1.0f + 0.70710678f + across);
    floors.slack = job->scene.probe.step + job->scene.probe.surface;
    job->audit->sample_spacing = config->cell_size * (float)floors.stride;
    floors.buffers = tl_allocate_array(job->host->allocator, workers, sizeof *floors.buffers);
    if (floors.buffers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(floors.buffers, 0, workers * sizeof *floors.buffers);
    tl_result result = tl_audit_run_shares(job, "audit floors", floors.height, sample_row, &floors);
    for (uint32_t i = 0; i < workers; i++) {
        tl_release_array(job->host->allocator, floors.buffers[i].hits, floors.buffers[i].capacity,
                         sizeof *floors.buffers[i].hits);
    }
    tl_release_array(job->host->allocator, floors.buffers, workers, sizeof *floors.buffers);
    return result;
}
