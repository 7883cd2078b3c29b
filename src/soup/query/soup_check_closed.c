// SPDX-License-Identifier: MIT
//
// Whether a soup is closed: every edge is used as often in one direction as in the other. Then it is the boundary of a
// volume, however many surfaces it has and whatever they intersect, and winding numbers are the same for every ray.
//
// Corners at equal positions are one corner. The triangles are welded again, because a soup keeps corners and no
// vertices; edges are sorted, so that those of the same two vertices are adjacent.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "base/stage.h"

#include <string.h>
#include <talus/soup.h>

typedef struct loose_triangles {
    tl_vec3 *vertices;
    uint32_t *indices;
    uint32_t *triangles; // of the view
    uint32_t count;
} loose_triangles;

static tl_result unpack_triangles(const tl_soup *soup, tl_arena *arena, tl_stage *stage, loose_triangles *loose)
{
    uint64_t count = tl_soup_get_stats(soup).triangle_count;
    loose->vertices = TL_PUSH(arena, tl_vec3, 3 * count);
    loose->indices = TL_PUSH(arena, uint32_t, 3 * count);
    loose->triangles = TL_PUSH(arena, uint32_t, count);
    if (loose->vertices == NULL || loose->indices == NULL || loose->triangles == NULL) {
        return TL_ERR_MEMORY;
    }
    uint64_t cursor = 0;
    tl_soup_triangle triangle;
    loose->count = 0;
    while (tl_soup_next_triangle(soup, &cursor, &triangle)) {
        TL_TRY(tl_stage_tick(stage, loose->count));
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t at = 3 * loose->count + k;
            loose->vertices[at] = triangle.corners[k];
            loose->indices[at] = at;
        }
        loose->triangles[loose->count++] = triangle.triangle;
    }
    return TL_OK;
}

// `extra`: 1 when the edge runs from its lower vertex to its higher; `value`: the triangle.
static tl_result sort_directed_edges(const tl_mesh *mesh, tl_arena *arena, tl_stage *stage, tl_sort_item **edges_out)
{
    uint64_t count = 3 * (uint64_t)mesh->triangle_count;
    tl_sort_item *edges = TL_PUSH(arena, tl_sort_item, count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, count);
    if (edges == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    *edges_out = edges;
    for (uint32_t i = 0; i < count; i++) {
        TL_TRY(tl_stage_tick(stage, i));
        uint32_t a = mesh->indices[i], b = mesh->indices[i - i % 3 + (i + 1) % 3];
        edges[i].key = (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a);
        edges[i].value = i / 3;
        edges[i].extra = a < b;
    }
    return tl_radix_sort_in_stage(edges, scratch, (uint32_t)count, stage);
}

// The triangle with the lowest index on an unbalanced edge; TL_NO_TRIANGLE when there is none.
static tl_result check_directed_edges(const tl_mesh *mesh, const loose_triangles *loose, const tl_sort_item *edges,
                                      tl_stage *stage, uint32_t *triangle_out)
{
    uint32_t count = 3 * mesh->triangle_count, ticked = 0;
    tl_result result = TL_OK;
    *triangle_out = TL_NO_TRIANGLE;
    for (uint32_t first = 0, end; first < count; first = end) {
        int64_t sum = 0;
        uint32_t lowest = TL_NO_TRIANGLE;
        if (first - ticked >= TL_STAGE_STEP) {
            TL_TRY(tl_stage_add(stage, (first - ticked) / 3));
            ticked = first;
        }
        for (end = first; end < count && edges[end].key == edges[first].key; end++) {
            uint32_t triangle = loose->triangles[mesh->source_triangles[edges[end].value]];
            sum += edges[end].extra ? 1 : -1;
            lowest = triangle < lowest ? triangle : lowest;
        }
        // An odd number of triangles cannot balance; an even number would if one were reversed.
        tl_result found = sum == 0 ? TL_OK : (end - first) % 2 != 0 ? TL_ERR_NOT_CLOSED : TL_ERR_WINDING;
        if (found == TL_ERR_NOT_CLOSED ? result != TL_ERR_NOT_CLOSED || lowest < *triangle_out
                                       : found != TL_OK && result != TL_ERR_NOT_CLOSED && lowest < *triangle_out) {
            result = found;
            *triangle_out = lowest;
        }
    }
    return result;
}

static tl_result weld_and_check(const tl_soup *soup, const tl_host *host, tl_arena *arena, tl_mesh *mesh,
                                tl_report *report)
{
    loose_triangles loose;
    tl_stage stage;
    const uint64_t total = tl_soup_get_stats(soup).triangle_count;
    TL_TRY(tl_stage_begin(&stage, host, "check closed", total));
    TL_TRY(unpack_triangles(soup, arena, &stage, &loose));
    tl_mesh_view view = { loose.vertices, 3 * loose.count, loose.indices, loose.count, NULL };
    tl_mesh_def def = tl_default_mesh_def();
    def.keep_duplicates = true;
    def.host = *host;
    TL_TRY(tl_mesh_bake(&view, &def, mesh, NULL));
    tl_sort_item *edges;
    TL_TRY(tl_stage_begin(&stage, host, "check closed", total));
    TL_TRY(sort_directed_edges(mesh, arena, &stage, &edges));
    uint32_t triangle;
    tl_result result = check_directed_edges(mesh, &loose, edges, &stage, &triangle);
    if (result == TL_ERR_CANCELLED) {
        return result;
    }
    TL_TRY(tl_stage_end(&stage));
    if (result == TL_ERR_NOT_CLOSED) {
        return tl_report_fail(report, result, "triangle", triangle, "close the hole or the rim at one of its edges");
    }
    if (result == TL_ERR_WINDING) {
        return tl_report_fail(report, result, "triangle", triangle, "turn it or its neighbour around");
    }
    return result;
}

tl_result tl_soup_check_closed(const tl_soup *soup, const tl_host *host, tl_report *report_out)
{
    tl_report report;
    tl_report_begin(&report, "check closed");
    if (soup == NULL) {
        if (report_out != NULL) {
            *report_out = report;
        }
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "soup", "give a soup");
    }
    tl_host used = { NULL, NULL, NULL };
    used = host != NULL ? *host : used;
    tl_arena arena;
    tl_arena_init(&arena, used.allocator);
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_result result = weld_and_check(soup, &used, &arena, &mesh, &report);
    report.peak_bytes = arena.peak_bytes + mesh.block_size;
    tl_mesh_free(&mesh);
    tl_arena_free(&arena);
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}
