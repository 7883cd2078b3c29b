// SPDX-License-Identifier: MIT
//
// Edge adjacency: all directed edges sorted by their undirected name; each group of equal names is one edge of the
// mesh.
//
// A radix sort keeps this linear for any mesh. A hash table or per-vertex buckets are quadratic on a fan of a million
// triangles around one vertex, which exported terrain skirts and cones really have.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "base/radix_sort.h"
#include "base/stage.h"
#include "mesh/clean.h"

#include <talus/mesh.h>

#include <string.h>

static void edge_corners(const tl_mesh_view *view, uint32_t edge, uint32_t *from, uint32_t *to)
{
    uint32_t triangle = edge / 3;
    *from = view->indices[edge];
    *to = view->indices[3 * triangle + (edge + 1) % 3];
}

static void link_group(const tl_mesh_view *view, const tl_sort_item *group, uint32_t count, tl_adjacency *adjacency)
{
    uint32_t from[2];
    uint32_t to[2];
    for (uint32_t i = 0; i < count && i < 2; i++) {
        edge_corners(view, group[i].value, &from[i], &to[i]);
    }
    if (count == 1) {
        adjacency->across[group[0].value] = TL_EDGE_BORDER;
        adjacency->border_edges++;
    } else if (count == 2 && from[0] == to[1] && from[0] != to[0]) {
        adjacency->across[group[0].value] = group[1].value;
        adjacency->across[group[1].value] = group[0].value;
        adjacency->paired_edges++;
    } else {
        for (uint32_t i = 0; i < count; i++) {
            adjacency->across[group[i].value] = TL_EDGE_NON_MANIFOLD;
        }
        adjacency->non_manifold_edges++;
    }
}

static tl_result link_triangle_edges(const tl_mesh_view *view, tl_arena *arena, tl_stage *stage,
                                     tl_adjacency *adjacency)
{
    uint32_t edge_count = 3 * view->triangle_count;
    tl_sort_item *edges = TL_PUSH(arena, tl_sort_item, edge_count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, edge_count);
    if (edges == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t edge = 0; edge < edge_count; edge++) {
        TL_TRY(tl_stage_tick(stage, edge));
        uint32_t from;
        uint32_t to;
        edge_corners(view, edge, &from, &to);
        tl_sort_item item = { (uint64_t)tl_min_u32(from, to) << 32 | tl_max_u32(from, to), edge, 0 };
        edges[edge] = item;
    }
    TL_TRY(tl_radix_sort_in_stage(edges, scratch, edge_count, stage));
    uint32_t ticked = 0;
    for (uint32_t begin = 0; begin < edge_count;) {
        if (begin - ticked >= TL_STAGE_STEP) {
            TL_TRY(tl_stage_add(stage, begin - ticked));
            ticked = begin;
        }
        uint32_t end = begin + 1;
        while (end < edge_count && edges[end].key == edges[begin].key) {
            end++;
        }
        link_group(view, edges + begin, end - begin, adjacency);
        begin = end;
    }
    return TL_OK;
}

tl_result tl_adjacency_bake(const tl_mesh_view *view, const tl_host *host, tl_adjacency *adjacency_out,
                            tl_report *report_out)
{
    tl_report_begin(report_out, "adjacency");
    if (adjacency_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "adjacency_out", "give where the adjacency goes");
    }
    memset(adjacency_out, 0, sizeof *adjacency_out);
    TL_TRY(tl_mesh_view_check_indices(view, report_out));
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    adjacency_out->allocator = tl_allocator_or_default(allocator);
    adjacency_out->across = tl_allocate_array(allocator, 3 * (uint64_t)view->triangle_count, sizeof(uint32_t));
    adjacency_out->triangle_count = view->triangle_count;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_stage stage;
    tl_result result = adjacency_out->across != NULL
                           ? tl_stage_begin(&stage, host, "adjacency", 3 * (uint64_t)view->triangle_count)
                           : TL_ERR_MEMORY;
    result = result == TL_OK ? link_triangle_edges(view, &arena, &stage, adjacency_out) : result;
    result = result == TL_OK ? tl_stage_end(&stage) : result;
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + 3 * (uint64_t)view->triangle_count * sizeof(uint32_t);
    }
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_adjacency_free(adjacency_out);
    }
    return result;
}

void tl_adjacency_free(tl_adjacency *adjacency)
{
    if (adjacency != NULL) {
        tl_release_array(&adjacency->allocator, adjacency->across, 3 * (uint64_t)adjacency->triangle_count,
                         sizeof(uint32_t));
        memset(adjacency, 0, sizeof *adjacency);
    }
}
