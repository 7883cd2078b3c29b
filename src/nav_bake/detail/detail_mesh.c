// SPDX-License-Identifier: MIT
//
// Detail mesh: the driver. Samples all edges once, then builds patch by patch in scratch memory that is as large as the
// largest patch needs, groups of patches as the host's tasks, and packs the result into one block.

#include "nav_bake/detail/detail.h"

#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "nav_bake/voxels/batches.h"

#include <string.h>

enum { PATCHES_PER_GROUP = 256, GROUPS_PER_WORKER = 4 };

// The patches of some polygons that follow one another: a task.
typedef struct patch_group {
    tl_vec3 *vertices;
    tl_nav_detail_triangle *triangles;
    uint32_t vertex_count, vertex_capacity, triangle_count, triangle_capacity;
} patch_group;

// What a worker builds patches with.
typedef struct patch_builder {
    const tl_detail_work *work;
    tl_arena arena; // of its scratch, and of the groups it builds
    tl_detail_mesh mesh;
    tl_detail_heap heap;
    tl_detail_point *samples;
    uint32_t sample_capacity;
    tl_detail_extent extent; // of the polygon at hand
    patch_group *group;      // at hand
    double max_error;
    uint32_t limited_patches;
} patch_builder;

typedef struct detail_job {
    tl_detail_work *work;
    uint32_t sample_capacity, point_capacity; // of the largest patch
    uint32_t group_size, group_count;
    tl_nav_detail_patch *patches; // [polygon_count] positions within their group
    patch_group *groups;
    patch_builder *builders; // [worker_count]
    uint32_t worker_count;
} detail_job;

static uint32_t corner_count_of(const tl_polygon_mesh *polygons, uint32_t polygon)
{
    return polygons->first[polygon + 1] - polygons->first[polygon];
}

static uint32_t outline_count_of(const tl_detail_work *work, uint32_t polygon)
{
    uint32_t count = 0;
    for (uint32_t k = work->polygons->first[polygon]; k < work->polygons->first[polygon + 1]; k++) {
        count += 1u + work->edges.edges[k].count;
    }
    return count;
}

// Finds what the largest patch needs.
static tl_result measure_patches(detail_job *job, tl_report *report)
{
    const tl_polygon_mesh *polygons = job->work->polygons;
    uint64_t samples = 0, points = 0;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        tl_detail_extent e = tl_detail_polygon_extent(polygons, p);
        if ((int64_t)e.max_x - e.min_x > TL_DETAIL_MAX_EXTENT || (int64_t)e.max_z - e.min_z > TL_DETAIL_MAX_EXTENT) {
            return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p, "it spans over 2^20 columns: use tiles");
        }
        uint64_t inside = tl_detail_sample_bound(job->work, p), outline = outline_count_of(job->work, p);
        if (outline > TL_DETAIL_MAX_VERTICES) {
            return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p,
                                  "it has too many corners: use max_verts_per_poly");
        }
        samples = inside > samples ? inside : samples;
        points = outline + inside > points ? outline + inside : points;
    }
    if (samples >= TL_DETAIL_NONE) {
        return tl_report_fail(report, TL_ERR_LIMIT, "sample", samples, "use tiles or a larger detail_sample_dist");
    }
    job->sample_capacity = (uint32_t)samples;
    job->point_capacity = (uint32_t)(points < TL_DETAIL_MAX_VERTICES ? points : TL_DETAIL_MAX_VERTICES);
    return TL_OK;
}

// A worker's scratch, when it builds its first patch.
static tl_result prepare_builder(const detail_job *job, patch_builder *b)
{
    if (b->work != NULL) {
        return TL_OK;
    }
    // A triangulation of n points on and in a convex outline has at most 2 n - 5 triangles. While one point is put in,
    // each flip adds an edge to it: fewer than n flips, which write 2 triangles each, after 4 at the start.
    const uint64_t points = job->point_capacity, triangles = 2 * points;
    tl_arena *arena = &b->arena;
    tl_arena_init(arena, &job->work->arena->allocator);
    b->work = job->work;
    b->sample_capacity = job->sample_capacity;
    b->mesh.points = TL_PUSH(arena, tl_detail_point, points);
    b->mesh.triangle_of = TL_PUSH(arena, uint32_t, points);
    b->mesh.triangles = TL_PUSH(arena, tl_detail_triangle, triangles);
    b->mesh.changed = TL_PUSH(arena, uint32_t, triangles + 4);
    b->mesh.stack = TL_PUSH(arena, uint32_t, points + 4);
    b->mesh.next_sample = TL_PUSH(arena, uint32_t, b->sample_capacity);
    b->samples = TL_PUSH(arena, tl_detail_point, b->sample_capacity);
    b->heap.triangles = TL_PUSH(arena, uint32_t, triangles);
    b->heap.place = TL_PUSH(arena, uint32_t, triangles);
    b->heap.error = TL_PUSH(arena, double, triangles);
    b->heap.worst = TL_PUSH(arena, uint32_t, triangles);
    b->mesh.samples = b->samples;
    return b->mesh.points && b->mesh.triangle_of && b->mesh.triangles && b->mesh.changed && b->mesh.stack &&
                   b->mesh.next_sample && b->samples && b->heap.triangles && b->heap.place && b->heap.error &&
                   b->heap.worst
               ? TL_OK
               : TL_ERR_MEMORY;
}

// A larger array with the same content, or NULL.
static void *grow_store(tl_arena *arena, const void *array, uint32_t count, uint32_t needed, uint32_t *capacity,
                        size_t size)
{
    uint64_t wanted = 2 * (uint64_t)*capacity > needed ? 2 * (uint64_t)*capacity : (uint64_t)needed + 1024;
    wanted = wanted < UINT32_MAX ? wanted : UINT32_MAX;
    void *grown = tl_arena_push(arena, wanted, size);
    if (grown != NULL) {
        if (count > 0) {
            memcpy(grown, array, count * size);
        }
        *capacity = (uint32_t)wanted;
    }
    return grown;
}

static tl_detail_point local_corner(const patch_builder *b, uint32_t k)
{
    const tl_polygon_mesh *polygons = b->work->polygons;
    const int32_t *v = polygons->vertices + 3 * (size_t)polygons->indices[k];
    tl_detail_point p = { (v[0] - b->extent.min_x) * TL_DETAIL_ONE, (v[2] - b->extent.min_z) * TL_DETAIL_ONE, v[1] };
    return p;
}

// Puts an edge's samples between its corners, in the order of the outline. `from` and `to` are patch corners.
static void insert_edge(patch_builder *b, const tl_detail_edge *edge, uint32_t from, uint32_t to)
{
    tl_detail_mesh *mesh = &b->mesh;
    const tl_detail_point *a = &mesh->points[from], *z = &mesh->points[to];
    bool forward = a->x < z->x || (a->x == z->x && a->z < z->z);
    tl_detail_point low = forward ? *a : *z, high = forward ? *z : *a;
    int32_t steps = 1 << edge->bits; // divides TL_DETAIL_ONE, and so the corners' difference
    uint32_t before = from;
    for (uint32_t k = 0; k < edge->count; k++) {
        const tl_detail_edge_sample *s = &b->work->edges.samples[edge->first + (forward ? k : edge->count - 1u - k)];
        tl_detail_point p = { low.x + (high.x - low.x) / steps * s->step, low.z + (high.z - low.z) / steps * s->step,
                              s->y };
        mesh->points[mesh->point_count++] = p;
        tl_detail_insert_on_outline(mesh, before);
        mesh->changed_count = 0;
        before = mesh->point_count - 1;
    }
}

static void place_samples(tl_detail_mesh *mesh, uint32_t sample_count)
{
    uint32_t t = 0;
    for (uint32_t s = 0; s < sample_count; s++) {
        t = tl_detail_locate(mesh, &mesh->samples[s], t);
        mesh->next_sample[s] = mesh->triangles[t].first_sample;
        mesh->triangles[t].first_sample = s;
    }
}

// Triangulates one polygon. `b->mesh` holds the result.
static void build_patch(patch_builder *b, uint32_t polygon)
{
    const tl_detail_work *work = b->work;
    uint32_t begin = work->polygons->first[polygon], corner_count = corner_count_of(work->polygons, polygon);
    bool coarse = false;
    b->extent = tl_detail_polygon_extent(work->polygons, polygon);
    for (uint32_t k = 0; k < corner_count; k++) {
        b->mesh.points[k] = local_corner(b, begin + k);
    }
    tl_detail_start(&b->mesh, corner_count);
    for (uint32_t k = 0; k < corner_count; k++) {
        const tl_detail_edge *edge = &work->edges.edges[begin + k];
        insert_edge(b, edge, k, k + 1 < corner_count ? k + 1 : 0);
        coarse |= edge->coarse != 0;
    }
    double left = 0;
    if (work->spacing > 0) {
        uint32_t sample_count = tl_detail_sample_inside(work, polygon, b->samples, b->sample_capacity);
        place_samples(&b->mesh, sample_count);
        left = tl_detail_refine(&b->mesh, &b->heap, sample_count, work->max_error);
    }
    b->max_error = left > b->max_error ? left : b->max_error;
    b->limited_patches += coarse || left > work->max_error;
}

static tl_vec3 to_world(const patch_builder *b, const tl_detail_point *p)
{
    const tl_nav_compact *compact = b->work->compact;
    const tl_nav_lattice *lattice = &compact->lattice;
    double first_x = (double)((int64_t)lattice->first_x + compact->border_size + b->extent.min_x);
    double first_z = (double)((int64_t)lattice->first_z + compact->border_size + b->extent.min_z);
    // The formula of tl_nav_lattice_to_world, for lines between the lattice's; at these the bits are the same.
    double x =
        (double)lattice->origin.x + (first_x + (double)p->x / (double)TL_DETAIL_ONE) * (double)compact->cell_size;
    double z =
        (double)lattice->origin.z + (first_z + (double)p->z / (double)TL_DETAIL_ONE) * (double)compact->cell_size;
    return tl_vec3_make((float)x, tl_nav_lattice_to_world(lattice->origin.y, p->y, compact->cell_height), (float)z);
}

static tl_result make_patch_room(patch_builder *b)
{
    patch_group *group = b->group;
    const uint64_t vertices = (uint64_t)group->vertex_count + b->mesh.point_count;
    const uint64_t triangles = (uint64_t)group->triangle_count + b->mesh.triangle_count;
    if (vertices >= UINT32_MAX || triangles >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    if (vertices > group->vertex_capacity) {
        group->vertices = grow_store(&b->arena, group->vertices, group->vertex_count, (uint32_t)vertices,
                                     &group->vertex_capacity, sizeof *group->vertices);
    }
    if (triangles > group->triangle_capacity) {
        group->triangles = grow_store(&b->arena, group->triangles, group->triangle_count, (uint32_t)triangles,
                                      &group->triangle_capacity, sizeof *group->triangles);
    }
    return group->vertices != NULL && group->triangles != NULL ? TL_OK : TL_ERR_MEMORY;
}

static tl_result store_patch(patch_builder *b, tl_nav_detail_patch *patch)
{
    const tl_detail_mesh *mesh = &b->mesh;
    patch_group *group = b->group;
    TL_TRY(make_patch_room(b));
    *patch =
        (tl_nav_detail_patch){ group->vertex_count, mesh->point_count, group->triangle_count, mesh->triangle_count };
    for (uint32_t k = 0; k < mesh->point_count; k++) {
        group->vertices[group->vertex_count++] = to_world(b, &mesh->points[k]);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const tl_detail_triangle *from = &mesh->triangles[t];
        tl_nav_detail_triangle *to = &group->triangles[group->triangle_count++];
        to->edge_flags = 0;
        for (int k = 0; k < 3; k++) {
            to->corner[k] = (uint16_t)from->corner[k];
            to->edge_flags = (uint16_t)(to->edge_flags | (from->across[k] == TL_DETAIL_NONE ? 1u << k : 0));
        }
    }
    return TL_OK;
}

static tl_result build_group(uint32_t index, uint32_t worker, void *user)
{
    const detail_job *job = user;
    patch_builder *b = &job->builders[worker];
    TL_TRY(prepare_builder(job, b));
    b->group = &job->groups[index];
    const uint32_t end = tl_block_end(index, job->group_size, job->work->polygons->polygon_count);
    for (uint32_t p = index * job->group_size; p < end; p++) {
        build_patch(b, p);
        TL_TRY(store_patch(b, &job->patches[p]));
    }
    return TL_OK;
}

static tl_result allocate_detail(uint64_t vertices, uint64_t triangles, uint32_t patches, const tl_allocator *allocator,
                                 tl_nav_detail *out)
{
    if (vertices >= UINT32_MAX || triangles >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    const uint64_t vertex_bytes = vertices * sizeof *out->vertices, patch_bytes = patches * sizeof *out->patches;
    const uint64_t size = vertex_bytes + patch_bytes + triangles * sizeof *out->triangles + 1; // never empty
    if (size > SIZE_MAX) {
        return TL_ERR_LIMIT;
    }
    char *block = tl_allocate(allocator, (size_t)size, TL_BLOB_ALIGNMENT);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    out->allocator = tl_allocator_or_default(allocator);
    out->block = block;
    out->block_size = (size_t)size;
    out->patches = (tl_nav_detail_patch *)(void *)block;
    out->vertices = (tl_vec3 *)(void *)(block + patch_bytes);
    out->triangles = (tl_nav_detail_triangle *)(void *)(block + patch_bytes + vertex_bytes);
    out->patch_count = patches;
    return TL_OK;
}

// All groups in order; positions in a group become positions among all.
static tl_result pack_detail(const detail_job *job, const tl_allocator *allocator, tl_nav_detail *out)
{
    const uint32_t patch_count = job->work->polygons->polygon_count;
    uint64_t vertices = 0, triangles = 0;
    for (uint32_t g = 0; g < job->group_count; g++) {
        vertices += job->groups[g].vertex_count;
        triangles += job->groups[g].triangle_count;
    }
    TL_TRY(allocate_detail(vertices, triangles, patch_count, allocator, out));
    for (uint32_t g = 0; g < job->group_count; g++) {
        const patch_group *group = &job->groups[g];
        const uint32_t end = tl_block_end(g, job->group_size, patch_count);
        for (uint32_t p = g * job->group_size; p < end; p++) {
            out->patches[p] = job->patches[p];
            out->patches[p].first_vertex += out->vertex_count;
            out->patches[p].first_triangle += out->triangle_count;
        }
        memcpy(out->vertices + out->vertex_count, group->vertices, group->vertex_count * sizeof *group->vertices);
        memcpy(out->triangles + out->triangle_count, group->triangles,
               group->triangle_count * sizeof *group->triangles);
        out->vertex_count += group->vertex_count;
        out->triangle_count += group->triangle_count;
    }
    double max_error = 0;
    for (uint32_t w = 0; w < job->worker_count; w++) {
        max_error = tl_max_f64(max_error, job->builders[w].max_error);
        out->limited_patches += job->builders[w].limited_patches;
    }
    out->max_error = (float)(max_error * (double)job->work->compact->cell_height);
    return TL_OK;
}

static tl_result allocate_detail_job(detail_job *job, const tl_host *host)
{
    tl_arena *arena = job->work->arena;
    const uint32_t patch_count = job->work->polygons->polygon_count;
    job->worker_count = tl_worker_count(host);
    const uint32_t share = patch_count / (GROUPS_PER_WORKER * job->worker_count) + 1;
    job->group_size = job->worker_count > 1 && share < PATCHES_PER_GROUP ? share : PATCHES_PER_GROUP;
    job->group_count = tl_block_count(patch_count, job->group_size);
    job->patches = TL_PUSH(arena, tl_nav_detail_patch, patch_count);
    job->groups = TL_PUSH_ZERO(arena, patch_group, job->group_count);
    job->builders = TL_PUSH_ZERO(arena, patch_builder, job->worker_count);
    return job->patches != NULL && job->groups != NULL && job->builders != NULL ? TL_OK : TL_ERR_MEMORY;
}

static tl_result build_patches(detail_job *job, const tl_host *host, tl_nav_detail *out, tl_report *report)
{
    TL_TRY(allocate_detail_job(job, host));
    TL_TRY(tl_progress_update(host, "detail", 0, job->group_count));
    TL_TRY(tl_detail_sample_edges(job->work));
    TL_TRY(measure_patches(job, report));
    TL_TRY(tl_run_batches(host, "detail", build_group, job->group_count, 1, job));
    return pack_detail(job, host != NULL ? host->allocator : NULL, out);
}

tl_result tl_nav_bake_detail(const tl_nav_config *config, const tl_nav_compact *compact,
                             const tl_polygon_mesh *polygons, const tl_host *host, tl_nav_detail *detail_out,
                             tl_report *report_out)
{
    tl_report_begin(report_out, "detail");
    TL_REFUSE_NULL(detail_out, report_out);
    memset(detail_out, 0, sizeof *detail_out);
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    TL_REFUSE_NULL(polygons, report_out);
    if (compact->region == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "region", "call tl_nav_bake_regions");
    }
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_detail_work work = { .config = config, .compact = compact, .polygons = polygons, .arena = &arena };
    work.spacing = (double)config->detail_sample_dist / (double)compact->cell_size;
    work.max_error = (double)config->detail_sample_max_error / (double)compact->cell_height;
    detail_job job = { .work = &work };
    const tl_result result = build_patches(&job, host, detail_out, report_out);
    uint64_t peak = arena.peak_bytes + detail_out->block_size;
    for (uint32_t w = 0; job.builders != NULL && w < job.worker_count; w++) {
        peak += job.builders[w].arena.peak_bytes;
        tl_arena_free(&job.builders[w].arena);
    }
    if (report_out != NULL) {
        report_out->peak_bytes = peak;
    }
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_nav_detail_free(detail_out);
    }
    return result;
}

void tl_nav_detail_free(tl_nav_detail *detail)
{
    if (detail != NULL) {
        tl_release(&detail->allocator, detail->block, detail->block_size);
        memset(detail, 0, sizeof *detail);
    }
}
