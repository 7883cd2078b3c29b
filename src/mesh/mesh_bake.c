// SPDX-License-Identifier: MIT
//
// From a loose triangle list to a mesh: check, weld, clean, then number the vertices by first use.

#include "base/arena.h"
#include "base/assert.h"
#include "mesh/clean.h"
#include "mesh/weld.h"

#include <string.h>

tl_mesh_def tl_default_mesh_def(void)
{
    tl_mesh_def def = { 0.0f, false, { NULL, NULL, NULL }, TL_DEF_COOKIE };
    return def;
}

static tl_result check_mesh_def(const tl_mesh_view *view, const tl_mesh_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_mesh_def()", report));
    if (!(def->weld_tolerance >= 0.0f) || def->weld_tolerance > TL_MAX_COORDINATE) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "weld_tolerance", "give metres, 0 to TL_MAX_COORDINATE");
    }
    TL_TRY(tl_mesh_view_check(view, report));
    if (view->triangle_count == 0 || view->vertex_count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, NULL, TL_NO_ELEMENT, "give at least one triangle");
    }
    return TL_OK;
}

// One block for all arrays of the mesh; each part's bytes are a multiple of 16.
static tl_result allocate_mesh(uint32_t vertex_count, uint32_t triangle_count, const tl_allocator *allocator,
                               tl_mesh *mesh)
{
    const uint64_t align = 15;
    uint64_t vertex_bytes = ((uint64_t)vertex_count * sizeof(tl_vec3) + align) & ~align;
    uint64_t index_bytes = ((uint64_t)triangle_count * 3 * sizeof(uint32_t) + align) & ~align;
    uint64_t source_bytes = ((uint64_t)triangle_count * sizeof(uint32_t) + align) & ~align;
    uint64_t material_bytes = ((uint64_t)triangle_count * sizeof(uint16_t) + align) & ~align;
    uint64_t size = vertex_bytes + index_bytes + source_bytes + material_bytes;
    if (size > SIZE_MAX) {
        return TL_ERR_MEMORY;
    }
    char *block = tl_allocate(allocator, (size_t)size, 64);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    mesh->allocator = tl_allocator_or_default(allocator);
    mesh->block = block;
    mesh->block_size = (size_t)size;
    mesh->vertices = (tl_vec3 *)(void *)block;
    mesh->indices = (uint32_t *)(void *)(block + vertex_bytes);
    mesh->source_triangles = (uint32_t *)(void *)(block + vertex_bytes + index_bytes);
    mesh->materials = (uint16_t *)(void *)(block + vertex_bytes + index_bytes + source_bytes);
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    return TL_OK;
}

// Gives each kept vertex its new number, in order of first use.
static tl_result number_mesh_vertices(const tl_cleaning *cleaning, const uint32_t *kept, uint32_t kept_count,
                                      uint32_t *number, uint32_t *count_out)
{
    const tl_mesh_view *view = cleaning->view;
    const uint32_t *representative = cleaning->representative;
    memset(number, 0xff, (size_t)view->vertex_count * sizeof *number);
    uint32_t count = 0;
    for (uint32_t i = 0; i < kept_count; i++) {
        TL_TRY(tl_stage_tick(cleaning->stage, i));
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t vertex = representative[view->indices[3 * (size_t)kept[i] + k]];
            if (number[vertex] == UINT32_MAX) {
                number[vertex] = count++;
            }
        }
    }
    *count_out = count;
    return TL_OK;
}

// What tasks fill the mesh from, block by block.
enum { BLOCK_ITEMS = 1 << 14, FILL_BATCH = 32 };

// Of a block of vertices.
typedef struct block_sum {
    tl_aabb bounds;
    uint32_t welded, unused;
} block_sum;

typedef struct filler {
    const tl_mesh_view *view;
    const uint32_t *representative;
    const uint32_t *kept;
    const uint32_t *number;
    tl_mesh *mesh;
    uint32_t vertex_blocks;
    block_sum *sums;
} filler;

static void fill_mesh_vertices(const filler *f, uint32_t block)
{
    block_sum sum = { tl_aabb_empty(), 0, 0 };
    uint32_t end = tl_block_end(block, BLOCK_ITEMS, f->view->vertex_count);
    for (uint32_t vertex = block * BLOCK_ITEMS; vertex < end; vertex++) {
        if (f->number[vertex] != UINT32_MAX) {
            f->mesh->vertices[f->number[vertex]] = f->view->vertices[vertex];
            sum.bounds = tl_aabb_add_point(sum.bounds, f->view->vertices[vertex]);
        } else if (f->representative[vertex] != TL_WELD_UNUSED && f->representative[vertex] != vertex) {
            sum.welded++;
        } else {
            sum.unused++;
        }
    }
    f->sums[block] = sum;
}

static void fill_mesh_triangles(const filler *f, uint32_t block)
{
    uint32_t end = tl_block_end(block, BLOCK_ITEMS, f->mesh->triangle_count);
    for (uint32_t i = block * BLOCK_ITEMS; i < end; i++) {
        uint32_t triangle = f->kept[i];
        for (uint32_t k = 0; k < 3; k++) {
            f->mesh->indices[3 * (size_t)i + k] =
                f->number[f->representative[f->view->indices[3 * (size_t)triangle + k]]];
        }
        f->mesh->source_triangles[i] = triangle;
        f->mesh->materials[i] = f->view->materials != NULL ? f->view->materials[triangle] : 0;
    }
}

static void fill_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const filler *f = user;
    if (block < f->vertex_blocks) {
        fill_mesh_vertices(f, block);
    } else {
        fill_mesh_triangles(f, block - f->vertex_blocks);
    }
}

static tl_result fill_mesh(filler *f, tl_stage *stage, tl_arena *arena, tl_mesh_report *report)
{
    f->vertex_blocks = tl_block_count(f->view->vertex_count, BLOCK_ITEMS);
    f->sums = TL_PUSH(arena, block_sum, f->vertex_blocks);
    if (f->sums == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_run(stage, fill_block, f->vertex_blocks + tl_block_count(f->mesh->triangle_count, BLOCK_ITEMS), f,
                        FILL_BATCH, f->view->triangle_count));
    f->mesh->bounds = tl_aabb_empty();
    for (uint32_t block = 0; block < f->vertex_blocks; block++) {
        f->mesh->bounds = tl_aabb_union(f->mesh->bounds, f->sums[block].bounds);
        report->welded_vertices += f->sums[block].welded;
        report->unused_vertices += f->sums[block].unused;
    }
    return TL_OK;
}

static tl_result weld_and_clean(const tl_mesh_view *view, const tl_mesh_def *def, tl_arena *arena, tl_mesh *mesh,
                                tl_mesh_report *report)
{
    const tl_host *host = &def->host;
    uint32_t *representative = TL_PUSH(arena, uint32_t, view->vertex_count);
    uint32_t *number = TL_PUSH(arena, uint32_t, view->vertex_count);
    uint32_t *kept = TL_PUSH(arena, uint32_t, view->triangle_count);
    if (representative == NULL || number == NULL || kept == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_stage stage;
    TL_TRY(tl_stage_begin(&stage, host, "weld", view->vertex_count));
    TL_TRY(tl_check_triangles(view, &stage, representative, &report->base));
    report->base.stage = "weld";
    TL_TRY(def->weld_tolerance > 0.0f ? tl_weld(view, def->weld_tolerance, &stage, arena, representative)
                                      : tl_weld_points(view, &stage, arena, representative));
    TL_TRY(tl_stage_end(&stage));

    report->base.stage = "clean";
    TL_TRY(tl_stage_begin(&stage, host, "clean", view->triangle_count));
    uint32_t kept_count = 0, vertex_count = 0;
    const tl_cleaning cleaning = { view, representative, def->keep_duplicates, &stage };
    TL_TRY(tl_clean_triangles(&cleaning, arena, kept, &kept_count, report));
    if (kept_count == 0) {
        return tl_report_fail(&report->base, TL_ERR_EMPTY, NULL, TL_NO_ELEMENT,
                              "all triangles are degenerate: check the unit and the weld tolerance");
    }
    TL_TRY(number_mesh_vertices(&cleaning, kept, kept_count, number, &vertex_count));
    TL_TRY(allocate_mesh(vertex_count, kept_count, def->host.allocator, mesh));
    filler f = { view, representative, kept, number, mesh, 0, NULL };
    TL_TRY(fill_mesh(&f, &stage, arena, report));
    return tl_stage_end(&stage);
}

tl_result tl_mesh_bake(const tl_mesh_view *view, const tl_mesh_def *def, tl_mesh *mesh_out, tl_mesh_report *report_out)
{
    const tl_mesh_def defaults = tl_default_mesh_def();
    def = def != NULL ? def : &defaults;
    tl_mesh_report unread;
    tl_mesh_report *report = report_out != NULL ? report_out : &unread;
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, "check");
    if (mesh_out == NULL) {
        return tl_report_field(&report->base, TL_ERR_ARGUMENT, "mesh_out", "give where the mesh goes");
    }
    memset(mesh_out, 0, sizeof *mesh_out);
    TL_TRY(check_mesh_def(view, def, &report->base));

    tl_arena arena;
    tl_arena_init(&arena, def->host.allocator);
    tl_result result = weld_and_clean(view, def, &arena, mesh_out, report);
    report->base.peak_bytes = arena.peak_bytes + mesh_out->block_size;
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_mesh_free(mesh_out);
    }
    return result;
}

void tl_mesh_free(tl_mesh *mesh)
{
    if (mesh != NULL) {
        tl_release(&mesh->allocator, mesh->block, mesh->block_size);
        memset(mesh, 0, sizeof *mesh);
    }
}

tl_mesh_view tl_mesh_as_view(const tl_mesh *mesh)
{
    tl_mesh_view view = { mesh->vertices, mesh->vertex_count, mesh->indices, mesh->triangle_count, mesh->materials };
    return view;
}
