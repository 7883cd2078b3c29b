// SPDX-License-Identifier: MIT
//
// Detail mesh: the driver. Samples all edges once, then builds patch by patch in scratch memory that is as large as the
// largest patch needs, and packs the result into one block.

#include "nav_bake/detail/detail.h"

#include "base/assert.h"
#include "base/host.h"

#include <string.h>

typedef struct patch_builder {
    tl_detail_work *work;
    tl_detail_mesh mesh;
    tl_detail_heap heap;
    tl_detail_point *samples;
    uint32_t sample_capacity, point_capacity;
    tl_detail_extent extent; // of the polygon at hand
    // The patches so far.
    tl_nav_detail_patch *patches;
    tl_vec3 *vertices;
    tl_nav_detail_triangle *triangles;
    uint32_t vertex_count, vertex_capacity, triangle_count, triangle_capacity;
    double max_error;
    uint32_t limited_patches;
} patch_builder;

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
static tl_result measure_patches(patch_builder *b, tl_report *report)
{
    const tl_polygon_mesh *polygons = b->work->polygons;
    uint64_t samples = 0, points = 0;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        tl_detail_extent e = tl_detail_polygon_extent(polygons, p);
        if ((int64_t)e.max_x - e.min_x > TL_DETAIL_MAX_EXTENT || (int64_t)e.max_z - e.min_z > TL_DETAIL_MAX_EXTENT) {
            return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p, "it spans over 2^20 columns: use tiles");
        }
        uint64_t inside = tl_detail_sample_bound(b->work, p), outline = outline_count_of(b->work, p);
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
    b->sample_capacity = (uint32_t)samples;
    b->point_capacity = (uint32_t)(points < TL_DETAIL_MAX_VERTICES ? points : TL_DETAIL_MAX_VERTICES);
    return TL_OK;
}

static tl_result allocate_scratch(patch_builder *b)
{
    tl_arena *arena = b->work->arena;
    // A triangulation of n points on and in a convex outline has at most 2 n - 5 triangles. While one point is put in,
    // each flip adds an edge to it: fewer than n flips, which write 2 triangles each, after 4 at the start.
    uint64_t points = b->point_capacity, triangles = 2 * points;
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
    b->patches = TL_PUSH(arena, tl_nav_detail_patch, b->work->polygons->polygon_count);
    b->mesh.samples = b->samples;
    return b->mesh.points && b->mesh.triangle_of && b->mesh.triangles && b->mesh.changed && b->mesh.stack &&
                   b->mesh.next_sample && b->samples && b->heap.triangles && b->heap.place && b->heap.error &&
                   b->heap.worst && b->patches
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
    tl_detail_work *work = b->work;
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

static tl_result store_patch(patch_builder *b, uint32_t polygon)
{
    tl_detail_mesh *mesh = &b->mesh;
    uint64_t vertices = (uint64_t)b->vertex_count + mesh->point_count;
    uint64_t triangles = (uint64_t)b->triangle_count + mesh->triangle_count;
    if (vertices >= UINT32_MAX || triangles >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    if (vertices > b->vertex_capacity) {
        b->vertices = grow_store(b->work->arena, b->vertices, b->vertex_count, (uint32_t)vertices, &b->vertex_capacity,
                                 sizeof *b->vertices);
    }
    if (triangles > b->triangle_capacity) {
        b->triangles = grow_store(b->work->arena, b->triangles, b->triangle_count, (uint32_t)triangles,
                                  &b->triangle_capacity, sizeof *b->triangles);
    }
    if (b->vertices == NULL || b->triangles == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_nav_detail_patch patch = { b->vertex_count, mesh->point_count, b->triangle_count, mesh->triangle_count };
    b->patches[polygon] = patch;
    for (uint32_t k = 0; k < mesh->point_count; k++) {
        b->vertices[b->vertex_count++] = to_world(b, &mesh->points[k]);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const tl_detail_triangle *from = &mesh->triangles[t];
        tl_nav_detail_triangle *to = &b->triangles[b->triangle_count++];
        to->edge_flags = 0;
        for (int k = 0; k < 3; k++) {
            to->corner[k] = (uint16_t)from->corner[k];
            to->edge_flags = (uint16_t)(to->edge_flags | (from->across[k] == TL_DETAIL_NONE ? 1u << k : 0));
        }
    }
    return TL_OK;
}

static tl_result pack_detail(const patch_builder *b, const tl_allocator *allocator, tl_nav_detail *out)
{
    uint32_t patch_count = b->work->polygons->polygon_count;
    uint64_t vertex_bytes = (uint64_t)b->vertex_count * sizeof *b->vertices;
    uint64_t patch_bytes = (uint64_t)patch_count * sizeof *b->patches;
    uint64_t size = vertex_bytes + patch_bytes + (uint64_t)b->triangle_count * sizeof *b->triangles + 1; // never empty
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
    out->patch_count = patch_count;
    out->vertex_count = b->vertex_count;
    out->triangle_count = b->triangle_count;
    out->max_error = (float)(b->max_error * (double)b->work->compact->cell_height);
    out->limited_patches = b->limited_patches;
    if (patch_count > 0) {
        memcpy(out->patches, b->patches, (size_t)patch_bytes);
        memcpy(out->vertices, b->vertices, (size_t)vertex_bytes);
        memcpy(out->triangles, b->triangles, b->triangle_count * sizeof *b->triangles);
    }
    return TL_OK;
}

enum { PATCHES_PER_UPDATE = 256 };

static tl_result build_patches(tl_detail_work *work, const tl_host *host, tl_nav_detail *out, tl_report *report)
{
    uint32_t patch_count = work->polygons->polygon_count;
    TL_TRY(tl_progress_update(host, "detail", 0, patch_count));
    TL_TRY(tl_detail_sample_edges(work));
    patch_builder b = { .work = work };
    TL_TRY(measure_patches(&b, report));
    TL_TRY(allocate_scratch(&b));
    for (uint32_t p = 0; p < patch_count; p++) {
        if (p > 0 && p % PATCHES_PER_UPDATE == 0) {
            TL_TRY(tl_progress_update(host, "detail", p, patch_count));
        }
        build_patch(&b, p);
        TL_TRY(store_patch(&b, p));
    }
    TL_TRY(pack_detail(&b, host != NULL ? host->allocator : NULL, out));
    return tl_progress_update(host, "detail", patch_count, patch_count);
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
    tl_result result = build_patches(&work, host, detail_out, report_out);
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + detail_out->block_size;
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
