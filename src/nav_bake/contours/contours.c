// SPDX-License-Identifier: MIT
//
// Contours: the driver. Traces, simplifies and repairs all outlines, bridges each region's holes, and packs the result
// into one block.

#include "nav_bake/contours/contours.h"

#include "base/assert.h"
#include "base/host.h"

#include <string.h>

// The loops of each region, and the contour that each outline becomes.
typedef struct assembly {
    tl_contour_work *work;
    uint32_t *path_space; // all contours' vertices, one after the other
    uint32_t *hole_space;
    tl_contour_path *contours; // [outline_count]
    tl_contour_path *holes;    // scratch for one contour's
    tl_sort_item *order, *scratch;
    uint32_t outline_count, hole_count, slit_count, unbridged_count;
} assembly;

static void count_outlines(assembly *a)
{
    const tl_contour_work *work = a->work;
    for (uint32_t l = 0; l < work->loop_count; l++) {
        a->outline_count += work->loops[l].area2 > 0;
        a->hole_count += work->loops[l].area2 < 0;
        a->slit_count += work->loops[l].area2 == 0;
    }
}

// Whether a traced outline runs round a point, by the crossings of a ray to the left, half a cell above the point.
static bool loop_contains(const tl_contour_work *work, const tl_contour_loop *loop, const tl_contour_vertex *p)
{
    bool inside = false;
    for (uint32_t k = loop->first; k < loop->first + loop->count; k++) {
        const tl_contour_vertex *a = &work->vertices[k], *b = &work->vertices[tl_contour_next(work, k)];
        if (a->x == b->x && a->x <= p->x && (a->z <= p->z) != (b->z <= p->z)) {
            inside = !inside;
        }
    }
    return inside;
}

// Whether a hole belongs to an outline of its region: the region's only one, or else the last one round it.
static bool is_hole_of(const assembly *a, uint32_t hole, uint32_t outline, uint32_t outlines_in_region)
{
    const tl_contour_work *work = a->work;
    if (outlines_in_region == 1) {
        return true;
    }
    uint32_t region = work->loops[hole].region, found = UINT32_MAX;
    for (uint32_t k = a->work->region_first[region]; k < a->work->region_first[region + 1]; k++) {
        uint32_t loop = a->work->by_region[k];
        if (work->loops[loop].area2 > 0 &&
            (found == UINT32_MAX ||
             loop_contains(work, &work->loops[loop], &work->vertices[work->loops[hole].first]))) {
            found = loop;
        }
    }
    return found == outline;
}

// Builds the contour of one outline. Its path has room for all vertices of the region's loops.
static void assemble_contour(assembly *a, uint32_t outline, tl_contour_path *contour)
{
    const tl_contour_work *work = a->work;
    uint32_t region = work->loops[outline].region, outlines = 0, hole_count = 0, used = 0;
    tl_contours_simplified(work, outline, contour);
    for (uint32_t k = a->work->region_first[region]; k < a->work->region_first[region + 1]; k++) {
        outlines += work->loops[a->work->by_region[k]].area2 > 0;
    }
    for (uint32_t k = a->work->region_first[region]; k < a->work->region_first[region + 1]; k++) {
        uint32_t loop = a->work->by_region[k];
        if (work->loops[loop].area2 < 0 && is_hole_of(a, loop, outline, outlines)) {
            tl_contour_path *hole = &a->holes[hole_count++];
            hole->vertices = a->hole_space + used;
            tl_contours_simplified(work, loop, hole);
            used += hole->count;
        }
    }
    a->unbridged_count += tl_contours_bridge_holes(work, contour, a->holes, hole_count, a->order, a->scratch);
}

static tl_result assemble_contours(assembly *a)
{
    tl_contour_work *work = a->work;
    count_outlines(a);
    // A contour takes its own vertices, its holes' and two more a hole.
    uint64_t room = (uint64_t)work->vertex_count + 2 * (uint64_t)a->hole_count;
    a->path_space = TL_PUSH(work->arena, uint32_t, room);
    a->hole_space = TL_PUSH(work->arena, uint32_t, work->vertex_count);
    a->contours = TL_PUSH(work->arena, tl_contour_path, a->outline_count);
    a->holes = TL_PUSH(work->arena, tl_contour_path, a->hole_count);
    a->order = TL_PUSH(work->arena, tl_sort_item, a->hole_count);
    a->scratch = TL_PUSH(work->arena, tl_sort_item, a->hole_count);
    if (!a->path_space || !a->hole_space || !a->contours || !a->holes || !a->order || !a->scratch) {
        return TL_ERR_MEMORY;
    }
    uint64_t used = 0;
    uint32_t count = 0;
    for (uint32_t l = 0; l < work->loop_count; l++) {
        if (work->loops[l].area2 > 0) {
            tl_contour_path *contour = &a->contours[count++];
            contour->vertices = a->path_space + used;
            assemble_contour(a, l, contour);
            used += contour->count;
        }
    }
    return used + work->vertex_count < UINT32_MAX ? TL_OK : TL_ERR_LIMIT;
}

// ---------------------------------------------------------------------------------------------------------

static void describe_set(const tl_contour_work *work, tl_contour_set *set)
{
    const tl_nav_compact *compact = work->compact;
    const tl_nav_lattice *lattice = &compact->lattice;
    int64_t border = compact->border_size, first_x = lattice->first_x + border, first_z = lattice->first_z + border;
    set->width = (int32_t)((int64_t)compact->width - 2 * border);
    set->height = (int32_t)((int64_t)compact->height - 2 * border);
    set->bounds = compact->bounds;
    if (border > 0) {
        set->bounds.min.x = tl_nav_lattice_to_world(lattice->origin.x, first_x, compact->cell_size);
        set->bounds.min.z = tl_nav_lattice_to_world(lattice->origin.z, first_z, compact->cell_size);
        set->bounds.max.x = tl_nav_lattice_to_world(lattice->origin.x, first_x + set->width, compact->cell_size);
        set->bounds.max.z = tl_nav_lattice_to_world(lattice->origin.z, first_z + set->height, compact->cell_size);
    }
    set->cell_size = compact->cell_size;
    set->cell_height = compact->cell_height;
    set->border_size = (int32_t)border;
    set->max_error = work->config->max_simplification_error;
}

// Copies the loops whose area has the given sign behind those already in the raw set.
static void copy_raw(const tl_contour_work *work, int sign, tl_contour_set *raw, tl_contour *contours)
{
    for (uint32_t l = 0; l < work->loop_count; l++) {
        const tl_contour_loop *loop = &work->loops[l];
        if ((loop->area2 > 0) - (loop->area2 < 0) == sign) {
            tl_contour *contour = &contours[raw->contour_count++];
            contour->first_vertex = loop->first; // raw vertices stay where they were traced
            contour->vertex_count = loop->count;
            contour->region = loop->region;
            contour->area = loop->area;
        }
    }
}

static void copy_set(const assembly *a, tl_contour_set *set, tl_contour *contours, tl_contour_vertex *vertices)
{
    const tl_contour_work *work = a->work;
    for (uint32_t c = 0; c < a->outline_count; c++) {
        const tl_contour_path *path = &a->contours[c];
        contours[c] = (tl_contour){ set->vertex_count, path->count, 0, 0 };
        const tl_contour_loop *loop = &work->loops[work->loop_of[path->vertices[0]]];
        contours[c].region = loop->region;
        contours[c].area = loop->area;
        for (uint32_t k = 0; k < path->count; k++) {
            vertices[set->vertex_count++] = work->vertices[path->vertices[k]];
        }
    }
    set->contour_count = a->outline_count;
}

static tl_result pack_contours(const assembly *a, tl_nav_contours *out)
{
    const tl_contour_work *work = a->work;
    uint64_t set_vertices = 0;
    for (uint32_t c = 0; c < a->outline_count; c++) {
        set_vertices += a->contours[c].count;
    }
    uint64_t vertex_bytes = (set_vertices + work->vertex_count) * sizeof(tl_contour_vertex);
    uint64_t size = vertex_bytes + ((uint64_t)a->outline_count + work->loop_count) * sizeof(tl_contour);
    if (size > SIZE_MAX - TL_BLOB_ALIGNMENT) {
        return TL_ERR_LIMIT;
    }
    out->block_size = (size_t)size + 1; // never empty
    out->block = tl_allocate(&out->allocator, out->block_size, TL_BLOB_ALIGNMENT);
    if (out->block == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_contour_vertex *vertices = out->block;
    tl_contour *contours = (tl_contour *)(void *)((char *)out->block + vertex_bytes);
    describe_set(work, &out->set);
    copy_set(a, &out->set, contours, vertices);
    out->set.vertices = vertices;
    out->set.contours = contours;

    describe_set(work, &out->raw);
    memcpy(vertices + set_vertices, work->vertices, work->vertex_count * sizeof *vertices);
    out->raw.vertices = vertices + set_vertices;
    out->raw.vertex_count = work->vertex_count;
    out->raw.contours = contours + a->outline_count;
    copy_raw(work, 1, &out->raw, contours + a->outline_count);
    copy_raw(work, -1, &out->raw, contours + a->outline_count);
    copy_raw(work, 0, &out->raw, contours + a->outline_count);

    out->hole_count = a->hole_count;
    out->slit_count = a->slit_count;
    out->unbridged_count = a->unbridged_count;
    out->repaired_count = work->repaired_count;
    return TL_OK;
}

static tl_result build_contour_set(tl_contour_work *work, const tl_host *host, tl_nav_contours *out)
{
    TL_TRY(tl_progress_update(host, "contours", 0, 3));
    TL_TRY(tl_contours_find_guarded(work));
    TL_TRY(tl_contours_trace(work));
    TL_TRY(tl_progress_update(host, "contours", 1, 3));
    TL_TRY(tl_contours_simplify(work));
    TL_TRY(tl_contours_repair(work));
    TL_TRY(tl_progress_update(host, "contours", 2, 3));
    assembly a = { .work = work };
    TL_TRY(assemble_contours(&a));
    TL_TRY(pack_contours(&a, out));
    return tl_progress_update(host, "contours", 3, 3);
}

tl_result tl_nav_bake_contours(const tl_nav_config *config, const tl_nav_compact *compact, const tl_host *host,
                               tl_nav_contours *contours_out, tl_report *report_out)
{
    tl_report_begin(report_out, "contours");
    TL_REFUSE_NULL(contours_out, report_out);
    memset(contours_out, 0, sizeof *contours_out);
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(compact, report_out);
    if (compact->region == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "region", "call tl_nav_bake_regions");
    }
    contours_out->allocator = tl_allocator_or_default(host != NULL ? host->allocator : NULL);
    tl_arena arena;
    tl_arena_init(&arena, &contours_out->allocator);
    tl_contour_work work = { .config = config, .compact = compact, .host = host, .arena = &arena };
    tl_result result = build_contour_set(&work, host, contours_out);
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + contours_out->block_size;
    }
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_nav_contours_free(contours_out);
    }
    return result == TL_ERR_CORRUPT
               ? tl_report_fail(report_out, result, "span", TL_NO_ELEMENT, "neighbour links must be mutual")
               : result;
}

void tl_nav_contours_free(tl_nav_contours *contours)
{
    if (contours != NULL) {
        tl_release(&contours->allocator, contours->block, contours->block_size);
        memset(contours, 0, sizeof *contours);
    }
}
